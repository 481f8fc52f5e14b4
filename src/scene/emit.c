/* A tree as YAML text. */
#include "scene/yaml.h"

#include <ctype.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 120 };

typedef struct {
    char *text; /* always terminated once something was added */
    size_t size, room;
    sp_error *error;
    bool failed;
} builder;

static void add_bytes(builder *out, const char *bytes, size_t size)
{
    if (out->failed)
        return;
    if (out->size + size + 1 > out->room) {
        size_t room = 2 * (out->size + size) + 256;
        char *text = realloc(out->text, room);
        if (!text) {
            out->failed = true;
            sp_fail_memory(out->error);
            return;
        }
        out->text = text;
        out->room = room;
    }
    memcpy(out->text + out->size, bytes, size);
    out->size += size;
    out->text[out->size] = '\0';
}

static void add(builder *out, const char *text)
{
    add_bytes(out, text, strlen(text));
}

static void add_indent(builder *out, int indent)
{
    for (int i = 0; i < indent; i++)
        add(out, " ");
}

/* True for text that is the same without quotes wherever a value may stand. Far stricter than YAML. */
static bool is_plain(const char *text)
{
    size_t size = strlen(text);
    if (!size || !strcmp(text, "...") || text[size - 1] == ' ')
        return false;
    bool sign = text[0] == '-' && (isdigit((unsigned char)text[1]) || text[1] == '.');
    if (!isalnum((unsigned char)text[0]) && text[0] != '.' && !sign)
        return false;
    for (const char *c = text; *c; c++)
        if ((*c & 0x80) || (!isalnum((unsigned char)*c) && !strchr(" ._/+^()%*-", *c)))
            return false;
    return true;
}

/* One code point of UTF-8; returns its bytes, 0 where it is none (also for overlong forms and surrogates). */
static size_t decode(const char *text, unsigned *point)
{
    const unsigned char *c = (const unsigned char *)text;
    size_t size = c[0] < 0x80             ? 1
                  : (c[0] & 0xe0) == 0xc0 ? 2
                  : (c[0] & 0xf0) == 0xe0 ? 3
                  : (c[0] & 0xf8) == 0xf0 ? 4
                                          : 0;
    static const unsigned least[] = {0, 0, 0x80, 0x800, 0x10000};
    *point = size == 1 ? c[0] : c[0] & (0x7fu >> size);
    for (size_t i = 1; i < size; i++) {
        if ((c[i] & 0xc0) != 0x80)
            return 0;
        *point = *point << 6 | (c[i] & 0x3f);
    }
    bool good = size && *point >= least[size] && *point <= 0x10ffff && (*point < 0xd800 || *point > 0xdfff);
    return good ? size : 0;
}

/* Code points that YAML or an editor would not leave alone. */
static bool needs_escape(unsigned point)
{
    return point < 0x20 || (point >= 0x7f && point < 0xa0) || point == 0x2028 || point == 0x2029 || point == 0xfeff ||
           point == 0xfffe || point == 0xffff;
}

static void add_quoted(builder *out, const char *whole)
{
    const char *text = whole;
    add(out, "\"");
    while (*text) {
        unsigned point;
        size_t size = decode(text, &point);
        char escape[16];
        if (!size) {
            sp_fail(out->error, SP_ERROR_INPUT, NULL, 0, 0, "found '%.200s', expected text in UTF-8", whole);
            out->failed = true;
            return;
        }
        snprintf(escape, sizeof escape, "\\u%04x", point);
        if (needs_escape(point))
            add(out, escape);
        else if (point == '"' || point == '\\')
            add(out, point == '"' ? "\\\"" : "\\\\");
        else
            add_bytes(out, text, size);
        text += size;
    }
    add(out, "\"");
}

static void add_scalar(builder *out, const sp_yaml *node)
{
    if (node->empty)
        return;
    if (is_plain(node->text))
        add(out, node->text);
    else
        add_quoted(out, node->text);
}

static void add_flow(builder *out, const sp_yaml *node)
{
    if (node->kind == SP_YAML_SCALAR) {
        add_scalar(out, node);
        return;
    }
    bool map = node->kind == SP_YAML_MAP;
    add(out, map ? "{" : "[");
    for (const sp_yaml *child = node->first; child && !out->failed; child = child->next) {
        if (map) {
            add(out, child->key);
            add(out, ": ");
        }
        add_flow(out, child);
        if (child->next)
            add(out, ", ");
    }
    add(out, map ? "}" : "]");
}

/* Adds the value on the line that is being written if it fits; takes it back if not. */
static bool add_on_line(builder *out, const sp_yaml *node)
{
    size_t before = out->size, line = before;
    add(out, " ");
    add_flow(out, node);
    while (line > 0 && out->text && out->text[line - 1] != '\n')
        line--;
    bool fits = out->failed || node->kind == SP_YAML_SCALAR || node->count == 0 || out->size - line <= WIDTH;
    if (fits)
        add(out, "\n");
    else
        out->size = before;
    return fits;
}

static void add_block(builder *out, const sp_yaml *node, int indent, bool begun)
{
    bool map = node->kind == SP_YAML_MAP;
    for (const sp_yaml *child = node->first; child && !out->failed; child = child->next) {
        if (!begun)
            add_indent(out, indent);
        begun = false;
        if (map)
            add(out, child->key);
        add(out, map ? ":" : "-");
        if (add_on_line(out, child))
            continue;
        bool beside = !map && child->kind == SP_YAML_MAP;
        add(out, beside ? " " : "\n");
        add_block(out, child, indent + 2, beside);
    }
}

char *sp_yaml_text(const sp_yaml *root, const char *heading, sp_error *error)
{
    builder out = {.error = error};
    add(&out, "# ");
    add(&out, heading);
    add(&out, "\n");
    add_block(&out, root, 0, false);
    if (!out.failed)
        return out.text;
    free(out.text);
    return NULL;
}
