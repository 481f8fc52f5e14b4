#include "wrapped.h"

#include <stdbool.h>
#include <string.h>

enum { WIDTH = 80, INDENT = 2, COLUMN = 25 };

const char *cli_print_wrapped(FILE *to, const char *text, int at, int left)
{
    const char *word = text;
    while (*word && strncmp(word, "\n\n", 2) != 0) {
        int length = (int)strcspn(word, " \n");
        bool first = word == text;
        if (!first && at + 1 + length > WIDTH) {
            fprintf(to, "\n%*s", left, "");
            at = left;
        } else if (!first) {
            fputc(' ', to);
            at++;
        }
        fprintf(to, "%.*s", length, word);
        at += length;
        word += length;
        word += *word == ' ' || (*word == '\n' && word[1] != '\n');
    }
    fputc('\n', to);
    return word + strspn(word, "\n");
}

void cli_print_term(FILE *to, const char *term, const char *text)
{
    int used = fprintf(to, "%*s%s", INDENT, "", term);
    if (used + 2 > COLUMN)
        fprintf(to, "\n%*s", COLUMN, "");
    else
        fprintf(to, "%*s", COLUMN - used, "");
    cli_print_wrapped(to, text, COLUMN, COLUMN);
}
