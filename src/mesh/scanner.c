#include "mesh/scanner.h"
#include "mesh/grow.h"
#include "mesh/utf8.h"

#include <ctype.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

sp_scanner sp_scanner_open(const char *path, const char *text, size_t size, bool obj)
{
    static const char byte_order_mark[] = "\xEF\xBB\xBF";
    size_t skip = size >= 3 && memcmp(text, byte_order_mark, 3) == 0 ? 3 : 0;
    return (sp_scanner){path, text + skip, text + size, text + skip, 1, obj};
}

/* Length of the line end at `at`: CR LF, LF or CR; 0 where there is none. */
static size_t line_end(const sp_scanner *scanner, const char *at)
{
    if (at == scanner->end || (*at != '\n' && *at != '\r'))
        return 0;
    return *at == '\r' && at + 1 < scanner->end && at[1] == '\n' ? 2 : 1;
}

static void step_over_line_end(sp_scanner *scanner, size_t length)
{
    scanner->at += length;
    scanner->line_start = scanner->at;
    if (scanner->line < INT_MAX)
        scanner->line++;
}

/* Length of a backslash with a line end behind it at `at`, or 0. */
static size_t continuation(const sp_scanner *scanner, const char *at)
{
    if (!scanner->obj || at == scanner->end || *at != '\\')
        return 0;
    size_t length = line_end(scanner, at + 1);
    return length ? 1 + length : 0;
}

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}

static void skip_blanks(sp_scanner *scanner)
{
    for (;;) {
        while (scanner->at < scanner->end && is_blank(*scanner->at))
            scanner->at++;
        size_t length = continuation(scanner, scanner->at);
        if (!length)
            break;
        step_over_line_end(scanner, length);
    }
    if (scanner->obj && scanner->at < scanner->end && *scanner->at == '#')
        while (scanner->at < scanner->end && !line_end(scanner, scanner->at))
            scanner->at++;
}

bool sp_scan_token(sp_scanner *scanner, sp_token *token)
{
    skip_blanks(scanner);
    const char *at = scanner->at;
    while (at < scanner->end && !is_blank(*at) && !line_end(scanner, at) && !continuation(scanner, at))
        at++;
    ptrdiff_t column = scanner->at - scanner->line_start + 1;
    *token =
        (sp_token){scanner->at, (size_t)(at - scanner->at), scanner->line, column < INT_MAX ? (int)column : INT_MAX};
    scanner->at = at;
    return token->length > 0;
}

bool sp_scan_next_line(sp_scanner *scanner)
{
    while (scanner->at < scanner->end) {
        size_t length = continuation(scanner, scanner->at);
        if (length) {
            step_over_line_end(scanner, length);
            continue;
        }
        length = line_end(scanner, scanner->at);
        if (length) {
            step_over_line_end(scanner, length);
            return scanner->at < scanner->end;
        }
        scanner->at++;
    }
    return false;
}

bool sp_scan_blank_lines(sp_scanner *scanner)
{
    do {
        skip_blanks(scanner);
        if (scanner->at < scanner->end && !line_end(scanner, scanner->at))
            return true;
    } while (sp_scan_next_line(scanner));
    return false;
}

bool sp_scan_any_token(sp_scanner *scanner, sp_token *token)
{
    return sp_scan_blank_lines(scanner) && sp_scan_token(scanner, token);
}

bool sp_token_is(const sp_scanner *scanner, const sp_token *token, const char *word)
{
    for (size_t i = 0; i < token->length; i++) {
        char c = scanner->obj ? token->text[i] : (char)tolower((unsigned char)token->text[i]);
        if (!word[i] || c != word[i]) /* a token may hold a zero byte */
            return false;
    }
    return word[token->length] == '\0';
}

/* A token as it may stand in a message: short and printable. */
static void printable(const sp_token *token, char text[48])
{
    size_t length = token->length < 40 ? token->length : 40;
    for (size_t i = 0; i < length; i++) {
        unsigned char c = (unsigned char)token->text[i];
        text[i] = c >= ' ' && c < 127 ? (char)c : '?';
    }
    memcpy(text + length, token->length > length ? "..." : "", token->length > length ? 4 : 1);
}

bool sp_token_unexpected(const sp_scanner *scanner, const sp_token *token, const char *expected, sp_error *error)
{
    char text[48];
    printable(token, text);
    return sp_fail(error, SP_ERROR_INPUT, scanner->path, token->line, token->column, "found '%s', expected %s", text,
                   expected);
}

bool sp_scanner_ended(const sp_scanner *scanner, const char *expected, sp_error *error)
{
    const char *what = scanner->at == scanner->end ? "file" : "line";
    return sp_fail(error, SP_ERROR_INPUT, scanner->path, scanner->line, 0, "found the end of the %s, expected %s", what,
                   expected);
}

static const char *skip_digits(const char *at, const char *end)
{
    while (at < end && *at >= '0' && *at <= '9')
        at++;
    return at;
}

/* [+-] digits [. digits] [e [+-] digits], a digit at least before or after the point: strtod alone would also take
 * hexadecimal notation, "nan" and "infinity". */
static bool is_decimal(const char *at, const char *end)
{
    if (at < end && (*at == '+' || *at == '-'))
        at++;
    const char *whole = at;
    at = skip_digits(at, end);
    ptrdiff_t digits = at - whole;
    if (at < end && *at == '.') {
        const char *fraction = ++at;
        at = skip_digits(at, end);
        digits += at - fraction;
    }
    if (digits == 0)
        return false;
    if (at < end && (*at == 'e' || *at == 'E')) {
        at++;
        if (at < end && (*at == '+' || *at == '-'))
            at++;
        const char *exponent = at;
        at = skip_digits(at, end);
        if (at == exponent)
            return false;
    }
    return at == end;
}

bool sp_token_number(const sp_scanner *scanner, const sp_token *token, double *number, sp_error *error)
{
    if (!is_decimal(token->text, token->text + token->length))
        return sp_token_unexpected(scanner, token, "a number", error);
    *number = strtod(token->text, NULL);
    return isfinite(*number) || sp_token_unexpected(scanner, token, "a number that a double can hold", error);
}

static bool has_control_character(const sp_token *token)
{
    for (size_t i = 0; i < token->length; i++)
        if ((unsigned char)token->text[i] < ' ' || token->text[i] == 127)
            return true;
    return false;
}

char *sp_scan_name(sp_scanner *scanner, const char *fallback, sp_error *error)
{
    char *name = NULL;
    size_t length = 0, room = 0;
    sp_token token;
    while (sp_scan_token(scanner, &token)) {
        if (has_control_character(&token)) {
            sp_token_unexpected(scanner, &token, "a name without control characters", error);
            free(name);
            return NULL;
        }
        if (!sp_grow(&name, &room, length + 2 * token.length + 2, 1)) {
            free(name);
            return sp_fail_memory(error);
        }
        if (length)
            name[length++] = ' ';
        length += sp_utf8_append(name + length, token.text, token.length);
        name[length] = '\0';
    }
    if (!name && !(name = strdup(fallback)))
        return sp_fail_memory(error);
    return name;
}
