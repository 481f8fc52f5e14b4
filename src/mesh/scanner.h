/* The text of a mesh file, token by token, with the place of each. */
#ifndef SPRAYPLAN_MESH_SCANNER_H
#define SPRAYPLAN_MESH_SCANNER_H

#include <sprayplan/error.h>

#include <stddef.h>

typedef struct {
    const char *text; /* in the file's text, not terminated */
    size_t length;
    int line, column; /* from 1 */
} sp_token;

typedef struct {
    const char *path;
    const char *at, *end; /* *end is '\0' */
    const char *line_start;
    int line;
    bool obj; /* '#' starts a comment, a backslash before the line's end continues the line */
} sp_scanner;

/* `text` has `size` bytes and a '\0' behind them; both are borrowed. */
sp_scanner sp_scanner_open(const char *path, const char *text, size_t size, bool obj);
/* The next token of this line; false at the line's or the file's end. */
bool sp_scan_token(sp_scanner *scanner, sp_token *token);
/* Steps over lines without a token; false at the file's end. */
bool sp_scan_blank_lines(sp_scanner *scanner);
/* The next token whatever the line; false at the file's end. */
bool sp_scan_any_token(sp_scanner *scanner, sp_token *token);
/* Leaves what is left of this line behind; false at the file's end. */
bool sp_scan_next_line(sp_scanner *scanner);

/* Whether the token is `word`, lower case; in any case but in OBJ. */
bool sp_token_is(const sp_scanner *scanner, const sp_token *token, const char *word);
/* The token as a finite number, decimal notation only. Needs the "C" locale. */
bool sp_token_number(const sp_scanner *scanner, const sp_token *token, double *number, sp_error *error);
/* Fails at the token: "found 'token', expected ...". Returns false. */
bool sp_token_unexpected(const sp_scanner *scanner, const sp_token *token, const char *expected, sp_error *error);
/* Fails where the scanner stands: "found the end of the line (or file), expected ...". Returns false. */
bool sp_scanner_ended(const sp_scanner *scanner, const char *expected, sp_error *error);
/* The rest of the line as a name: tokens joined by single spaces, as UTF-8, without control characters; `fallback`
 * where the line holds no more. NULL on error; the caller frees. */
char *sp_scan_name(sp_scanner *scanner, const char *fallback, sp_error *error);

#endif
