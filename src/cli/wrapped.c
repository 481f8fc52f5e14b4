#include "wrapped.h"

#include <stdbool.h>
#include <string.h>

enum { WIDTH = 80, INDENT = 2, COLUMN = 25 };

void cli_print_wrapped(FILE *to, const char *text, int at, int left)
{
    for (const char *word = text; *word;) {
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
        word += strspn(word, " \n");
    }
    fputc('\n', to);
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
