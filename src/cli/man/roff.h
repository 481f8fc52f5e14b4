/* Manual pages in roff's man macros, as groff and mandoc read them. Texts are UTF-8, may begin with anything, and have
 * what stands between ` and ` in bold. */
#ifndef MAN_ROFF_H
#define MAN_ROFF_H

#include <stdio.h>

/* `name` in capitals; `date` as 2026-11-26; `manual` is what the head of a page calls it, "User Commands". */
void roff_title(FILE *to, const char *name, int section, const char *date, const char *manual);
void roff_section(FILE *to, const char *title);
void roff_subsection(FILE *to, const char *title);
/* One, or several with an empty line between them. */
void roff_paragraphs(FILE *to, const char *text);
/* A term in bold, and beside or below it what it means. */
void roff_tagged(FILE *to, const char *term, const char *text);
/* A line to be typed, as it stands. */
void roff_example(FILE *to, const char *text);
/* Text within a line of its own. */
void roff_text(FILE *to, const char *text);

#endif
