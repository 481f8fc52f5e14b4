/* Text for a terminal of 80 columns. */
#ifndef CLI_WRAPPED_H
#define CLI_WRAPPED_H

#include <stdio.h>

/* One paragraph, its lines broken between words, the first of which begins at column `at`, the others at `left`; up to
 * an empty line, behind which it returns. */
const char *cli_print_wrapped(FILE *to, const char *text, int at, int left);
/* A term, and beside it what it means, or below where the term is long. */
void cli_print_term(FILE *to, const char *term, const char *text);

#endif
