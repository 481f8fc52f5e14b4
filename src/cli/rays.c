#include "rays.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

#define LEAST 1e-150 /* m/s, m/s2: squares are numbers still */

static const char *skip_blanks(const char *text)
{
    return text + strspn(text, " \t");
}

/* Fails at a place of the line; `format` takes what stands there. */
static bool fail_at(const cli_rays *reader, const char *at, const char *format, sp_error *error)
{
    ptrdiff_t column = at - reader->text + 1;
    return sp_fail(error, SP_ERROR_INPUT, reader->path, reader->line, column < INT_MAX ? (int)column : INT_MAX, format,
                   at);
}

static bool parse_ray(const cli_rays *reader, const char *at, sp_ray *ray, sp_error *error)
{
    double number[6];
    for (int i = 0; i < 6; i++) {
        char *end;
        at = skip_blanks(at);
        number[i] = strtod(at, &end);
        if (end == at || !(fabs(number[i]) <= CLI_RAYS_LARGEST))
            return fail_at(reader, at, "found \"%.40s\", expected a number up to 1e30 (ox,oy,oz,vx,vy,vz)", error);
        at = skip_blanks(end);
        if (i < 5 && *at++ != ',')
            return fail_at(reader, at - 1, "found \"%.40s\", expected a comma and six numbers (ox,oy,oz,vx,vy,vz)",
                           error);
    }
    if (*at && *at != '#')
        return fail_at(reader, at, "found \"%.40s\" after 6 numbers, expected the end of the line", error);
    *ray = (sp_ray){.origin = sp_v(number[0], number[1], number[2]),
                    .velocity = sp_v(number[3], number[4], number[5]),
                    .t_max = INFINITY,
                    .skip = SP_NONE};
    return sp_length(ray->velocity) >= LEAST || sp_length(reader->gravity) >= LEAST ||
           fail_at(reader, reader->text,
                   "found a velocity below 1e-150 m/s in \"%.40s\", expected more where no --gravity lets it fall",
                   error);
}

/* Takes the line's end off; NULL where zero bytes or carriage returns are left, behind which no more would be read. */
static const char *check_line(cli_rays *reader, size_t length, sp_error *error)
{
    static const char byte_order_mark[] = "\xEF\xBB\xBF";
    char *text = reader->text;
    if (length && text[length - 1] == '\n')
        text[--length] = '\0';
    if (length && text[length - 1] == '\r')
        text[--length] = '\0';
    size_t fine = strcspn(text, "\r");
    if (fine < length) {
        fail_at(reader, text + fine, "found a zero byte or a carriage return, expected lines of text", error);
        return NULL;
    }
    return text + (reader->line == 1 && strncmp(text, byte_order_mark, 3) == 0 ? 3 : 0);
}

bool cli_rays_read(cli_rays *reader, sp_ray *rays, size_t room, size_t *count, sp_error *error)
{
    ssize_t length;
    *count = 0;
    while (*count < room && (length = getline(&reader->text, &reader->capacity, reader->file)) >= 0) {
        reader->line++;
        const char *line = check_line(reader, (size_t)length, error);
        if (!line)
            return false;
        line = skip_blanks(line);
        if (!*line || *line == '#')
            continue;
        if (!parse_ray(reader, line, &rays[*count], error))
            return false;
        ++*count;
    }
    if (ferror(reader->file))
        return sp_fail(error, SP_ERROR_INPUT, reader->path, 0, 0, "cannot be read");
    /* What ends before the file does is a line that found no room. */
    return *count == room || feof(reader->file) || sp_fail_memory(error);
}
