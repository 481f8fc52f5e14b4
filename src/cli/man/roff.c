#include "roff.h"

#include <sprayplan/sprayplan.h>

#include <ctype.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

enum { WIDTH = 78 }; /* of a source line, before escapes */

/* One character of UTF-8, as every device has it; returns how many bytes it takes. */
static int put_character(FILE *to, const char *text)
{
    const unsigned char *at = (const unsigned char *)text;
    int more = *at < 0x80 ? 0 : *at < 0xE0 ? 1 : *at < 0xF0 ? 2 : 3;
    uint32_t code = more == 0 ? *at : *at & (0x3Fu >> more);
    for (int i = 1; i <= more; i++)
        code = code << 6 | (at[i] & 0x3F);
    static const char *const names[128] = {
        ['\\'] = "\\(rs", ['-'] = "\\-", ['~'] = "\\(ti", ['^'] = "\\(ha", ['"'] = "\\(dq", ['\''] = "\\(aq",
    };
    if (more)
        fprintf(to, "\\[u%04X]", (unsigned)code);
    else if (names[code])
        fputs(names[code], to);
    else
        fputc((int)code, to);
    return more + 1;
}

static void put_word(FILE *to, const char *word, int length, bool *bold)
{
    for (int i = 0; i < length;) {
        if (word[i] == '`') {
            *bold = !*bold;
            fputs(*bold ? "\\fB" : "\\fR", to);
            i++;
        } else {
            i += put_character(to, word + i);
        }
    }
}

static bool ends_sentence(const char *word, int length)
{
    return length > 1 && strchr(".!?", word[length - 1]) && word[length - 2] != '.' && word[length] == ' ' &&
           !islower((unsigned char)word[length + 1]);
}

/* The column after it. */
static int end_line(FILE *to)
{
    fputc('\n', to);
    return 0;
}

/* A line a sentence, and long ones broken between words. Only what stands first in a line could be taken for a request.
 */
static void put_paragraph(FILE *to, const char *text, const char *end)
{
    bool bold = false;
    int at = 0;
    for (const char *word = text; word < end;) {
        int length = (int)strcspn(word, " \n");
        length = word + length > end ? (int)(end - word) : length;
        if (at && at + 1 + length > WIDTH)
            at = end_line(to);
        if (at)
            fputc(' ', to);
        else if (*word == '.' || *word == '\'')
            fputs("\\&", to);
        put_word(to, word, length, &bold);
        at += length + (at > 0);
        if (ends_sentence(word, length))
            at = end_line(to);
        word += length;
        word += strspn(word, " \n");
    }
    fputc('\n', to);
}

void roff_text(FILE *to, const char *text)
{
    put_paragraph(to, text, text + strlen(text));
}

void roff_title(FILE *to, const char *name, int section, const char *date, const char *manual)
{
    /* Names of files and options are not to be hyphenated. */
    fprintf(to, ".TH \"%s\" \"%d\" \"%s\" \"sprayplan %s\" \"%s\"\n.nh\n", name, section, date, SP_VERSION, manual);
}

void roff_section(FILE *to, const char *title)
{
    fprintf(to, ".SH %s\n", title);
}

void roff_subsection(FILE *to, const char *title)
{
    fprintf(to, ".SS ");
    roff_text(to, title);
}

void roff_paragraphs(FILE *to, const char *text)
{
    for (bool first = true; *text; first = false) {
        const char *end = strstr(text, "\n\n");
        if (!first)
            fprintf(to, ".PP\n");
        put_paragraph(to, text, end ? end : text + strlen(text));
        text = end ? end + 2 : text + strlen(text);
    }
}

void roff_tagged(FILE *to, const char *term, const char *text)
{
    fprintf(to, ".TP\n.B ");
    roff_text(to, term);
    roff_text(to, text);
}

void roff_example(FILE *to, const char *text)
{
    bool bold = false;
    fprintf(to, ".PP\n.nf\n.RS\n");
    put_word(to, text, (int)strlen(text), &bold);
    fprintf(to, "\n.RE\n.fi\n");
}
