#include "scene/yaml.h"

#include "mesh/utf8.h"

#include <libfyaml.h>

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_DEPTH = 32, FIRST_BYTES = 16 << 10, MAX_BYTES = 16 << 20 };
/* Of 150 bytes each, so that what is held stays within ten times the text and 64 MiB. */
enum { MAX_VALUES = 400000 };
/* libfyaml holds 370 bytes for each until a list or block that begins a file ends: it may yet turn out to be a key. */
enum { MAX_MARKS = 100000 };

typedef struct {
    struct fy_parser *parser;
    struct fy_diag *diag;
    const char *file;
    const char *text;
    size_t size, given; /* bytes, of them to the parser */
    size_t marks;       /* brackets, commas and colons since the last event, about */
    bool cut;           /* they were too many */
    size_t values;
    int lines;
    sp_error *error;
} source;

static void swallow(struct fy_diag *diag, void *user, const char *text, size_t size)
{
    (void)diag, (void)user, (void)text, (void)size;
}

/* Copies a token's text; an absent token is an empty text. */
static char *token_text(struct fy_token *token)
{
    size_t size = 0;
    const char *text = token ? fy_token_get_text(token, &size) : "";
    char *copy = malloc(size + 1);
    if (!copy)
        return NULL;
    if (text)
        memcpy(copy, text, size);
    copy[text ? size : 0] = '\0';
    return copy;
}

static bool fail_at(const source *s, const struct fy_mark *mark, const char *what)
{
    return sp_fail(s->error, SP_ERROR_INPUT, s->file, mark ? mark->line + 1 : 0, mark ? mark->column + 1 : 0, "%s",
                   what);
}

/* For what starts with a sign (& or *), behind which libfyaml's mark stands. */
static bool fail_before(const source *s, const struct fy_mark *mark, const char *what)
{
    return sp_fail(s->error, SP_ERROR_INPUT, s->file, mark ? mark->line + 1 : 0, mark ? mark->column : 0, "%s", what);
}

/* What libfyaml says is wrong, the first of it, where it says; it takes the end of the last line for one more. */
static bool fail_parse(const source *s)
{
    void *at = NULL;
    const struct fy_diag_error *found = fy_diag_errors_iterate(s->diag, &at);
    if (!found || !found->msg)
        return sp_fail(s->error, SP_ERROR_INPUT, s->file, 0, 0, "YAML: found text that cannot be parsed");
    bool beyond = found->line > s->lines;
    return sp_fail(s->error, SP_ERROR_INPUT, s->file,
                   beyond            ? s->lines
                   : found->line > 0 ? found->line
                                     : 1,
                   beyond              ? 0
                   : found->column > 0 ? found->column
                                       : 1,
                   "YAML: %s", found->msg);
}

/* Where it is too much the text ends: libfyaml never comes back from a callback that fails. */
static ssize_t give(void *user, void *buffer, size_t room)
{
    source *s = user;
    size_t left = s->size - s->given, count = s->marks > MAX_MARKS ? 0 : left < room ? left : room;
    s->cut |= count < left && count < room;
    if (count)
        memcpy(buffer, s->text + s->given, count);
    for (size_t i = 0; i < count; i++)
        s->marks += strchr("[{,:", s->text[s->given + i]) != NULL;
    s->given += count;
    return (ssize_t)count;
}

static struct fy_event *next_event(source *s)
{
    struct fy_event *event = fy_parser_parse(s->parser);
    if (event && !s->cut) {
        s->marks = 0;
        return event;
    }
    if (s->cut)
        sp_fail(s->error, SP_ERROR_INPUT, s->file, 0, 0,
                "YAML: found more than 100,000 brackets, commas and colons in one value, expected fewer");
    else
        fail_parse(s);
    if (event)
        fy_parser_event_free(s->parser, event);
    return NULL;
}

static bool check_event(const source *s, struct fy_event *event, int depth)
{
    struct fy_token *anchor = fy_event_get_anchor_token(event), *tag = fy_event_get_tag_token(event);
    if (event->type == FYET_ALIAS)
        return fail_before(s, fy_event_start_mark(event), "YAML: found an alias, expected its value written out");
    if (anchor)
        return fail_before(s, fy_token_start_mark(anchor), "YAML: found an anchor, expected a value without one");
    if (tag)
        return fail_at(s, fy_token_start_mark(tag), "YAML: found a tag, expected a value without one");
    if (depth > MAX_DEPTH)
        return fail_at(s, fy_event_start_mark(event), "YAML: found more than 32 levels of nesting, expected fewer");
    return true;
}

static sp_yaml *read_node(source *s, struct fy_event *event, int depth);

/* Where nothing is written there is nothing to mark: its key's or list's place stands in for it. */
static void stand_in(sp_yaml *node, int line, int column)
{
    if (node->line > 0)
        return;
    node->line = line;
    node->column = column;
}

static bool read_list(source *s, sp_yaml *node, int depth)
{
    for (;;) {
        struct fy_event *event = next_event(s);
        if (!event)
            return false;
        bool end = event->type == FYET_SEQUENCE_END;
        sp_yaml *child = end ? NULL : read_node(s, event, depth + 1);
        fy_parser_event_free(s->parser, event);
        if (!child)
            return end;
        stand_in(child, node->line, node->column);
        sp_yaml_append(node, child);
    }
}

/* Moves a key's text and place to the value that follows it. */
static bool read_value(source *s, sp_yaml *node, sp_yaml *key, int depth)
{
    struct fy_event *event = next_event(s);
    sp_yaml *child = event ? read_node(s, event, depth + 1) : NULL;
    if (event)
        fy_parser_event_free(s->parser, event);
    if (!child)
        return false;
    child->key = key->text;
    key->text = NULL;
    child->key_line = key->line;
    child->key_column = key->column;
    stand_in(child, key->line, key->column);
    sp_yaml_append(node, child);
    return true;
}

static bool read_map(source *s, sp_yaml *node, int depth)
{
    for (;;) {
        struct fy_event *event = next_event(s);
        if (!event)
            return false;
        bool end = event->type == FYET_MAPPING_END;
        sp_yaml *key = NULL;
        if (!end && (event->type == FYET_MAPPING_START || event->type == FYET_SEQUENCE_START))
            fail_at(s, fy_event_start_mark(event), "YAML: found a list or block as a key, expected a name");
        else if (!end)
            key = read_node(s, event, depth + 1);
        fy_parser_event_free(s->parser, event);
        if (!key)
            return end;
        bool good = read_value(s, node, key, depth);
        sp_yaml_destroy(key);
        if (!good)
            return false;
    }
}

static bool fill_node(source *s, struct fy_event *event, sp_yaml *node, int depth)
{
    if (event->type == FYET_SEQUENCE_START) {
        node->kind = SP_YAML_LIST;
        return read_list(s, node, depth);
    }
    if (event->type == FYET_MAPPING_START) {
        node->kind = SP_YAML_MAP;
        return read_map(s, node, depth);
    }
    node->kind = SP_YAML_SCALAR;
    node->text = token_text(event->scalar.value);
    if (!node->text)
        return sp_fail_memory(s->error);
    enum fy_node_style style = fy_event_get_node_style(event);
    node->empty = !node->text[0] && (style == FYNS_ANY || style == FYNS_PLAIN);
    /* libfyaml's mark stands behind the quote. */
    node->column -= style == FYNS_SINGLE_QUOTED || style == FYNS_DOUBLE_QUOTED;
    return true;
}

static sp_yaml *read_node(source *s, struct fy_event *event, int depth)
{
    if (!check_event(s, event, depth))
        return NULL;
    if (s->values++ == MAX_VALUES) {
        fail_at(s, fy_event_start_mark(event), "YAML: found more than 400,000 values, expected fewer");
        return NULL;
    }
    sp_yaml *node = calloc(1, sizeof *node);
    if (!node)
        return sp_fail_memory(s->error);
    const struct fy_mark *mark = fy_event_start_mark(event);
    node->file = s->file;
    node->line = mark ? mark->line + 1 : 0;
    node->column = mark ? mark->column + 1 : 0;
    if (fill_node(s, event, node, depth))
        return node;
    sp_yaml_destroy(node);
    return NULL;
}

/* The stream's one document; an empty stream is an empty scalar. */
static sp_yaml *read_document(source *s)
{
    sp_yaml *root = NULL;
    for (;;) {
        struct fy_event *event = next_event(s);
        if (!event)
            break;
        enum fy_event_type type = event->type;
        bool good = true;
        if (type == FYET_DOCUMENT_START && root)
            good = fail_at(s, fy_event_start_mark(event), "YAML: found a second document, expected one");
        else if (type != FYET_STREAM_START && type != FYET_STREAM_END && type != FYET_DOCUMENT_START &&
                 type != FYET_DOCUMENT_END)
            good = (root = read_node(s, event, 1)) != NULL;
        fy_parser_event_free(s->parser, event);
        if (!good)
            break;
        if (type == FYET_STREAM_END) {
            if (!root)
                sp_fail(s->error, SP_ERROR_INPUT, s->file, 1, 1, "YAML: found nothing, expected a value");
            return root;
        }
    }
    sp_yaml_destroy(root);
    return NULL;
}

static sp_yaml *parse_with(source *s)
{
    struct fy_diag_cfg quiet = {.output_fn = swallow, .level = FYET_ERROR, .module_mask = ~0u};
    s->diag = fy_diag_create(&quiet);
    if (!s->diag)
        return sp_fail_memory(s->error);
    fy_diag_set_collect_errors(s->diag, true);
    struct fy_parse_cfg settings = {.flags = FYPCF_QUIET | FYPCF_JSON_NONE, .diag = s->diag};
    s->parser = fy_parser_create(&settings);
    if (!s->parser)
        return sp_fail_memory(s->error);
    if (fy_parser_set_input_callback(s->parser, s, give) != 0)
        return sp_fail_memory(s->error);
    return read_document(s);
}

/* How many lines the text has, 0 for what is none: libfyaml never ends on directives that are no UTF-8. */
static int count_lines(const char *file, const char *text, size_t size, sp_error *error)
{
    const char *zero = size ? memchr(text, '\0', size) : NULL;
    size_t fine = sp_utf8_length(text, zero ? (size_t)(zero - text) : size);
    int lines = 1;
    for (size_t i = 0; i < fine; i++)
        lines += text[i] == '\n' || (text[i] == '\r' && i + 1 < size && text[i + 1] != '\n');
    if (fine == size)
        return lines;
    sp_fail(error, SP_ERROR_INPUT, file, lines, 0, "YAML: found a %s, expected text",
            text[fine] ? "byte that is no UTF-8" : "zero byte");
    return 0;
}

sp_yaml *sp_yaml_parse(const char *file, const char *text, size_t size, sp_error *error)
{
    int lines = count_lines(file, text, size, error);
    if (!lines)
        return NULL;
    char *name = strdup(file);
    if (!name)
        return sp_fail_memory(error);
    source s = {.file = name, .text = text, .size = size, .lines = lines, .error = error};
    sp_yaml *root = parse_with(&s);
    /* The collected errors hold tokens of the parser, and the diagnostics do not free them by themselves. */
    if (s.diag)
        fy_diag_reset_error(s.diag);
    if (s.parser)
        fy_parser_destroy(s.parser);
    if (s.diag)
        fy_diag_unref(s.diag);
    if (root)
        root->owned_file = name;
    else
        free(name);
    return root;
}

/* At most MAX_BYTES + 1 of the stream; NULL where memory ran out. Most scenes are a thousandth of that. */
static char *read_stream(FILE *stream, size_t *size)
{
    size_t room = FIRST_BYTES;
    char *text = NULL;
    for (*size = 0; *size < MAX_BYTES + 1; room *= 2) {
        room = room < MAX_BYTES + 1 ? room : MAX_BYTES + 1;
        char *more = realloc(text, room);
        if (!more) {
            free(text);
            return NULL;
        }
        text = more;
        *size += fread(text + *size, 1, room - *size, stream);
        if (*size < room)
            break;
    }
    return text;
}

sp_yaml *sp_yaml_load_stream(FILE *stream, const char *file, sp_error *error)
{
    size_t size;
    errno = 0;
    char *text = read_stream(stream, &size);
    if (!text)
        return sp_fail_memory(error);
    sp_yaml *root = NULL;
    if (ferror(stream))
        sp_fail(error, SP_ERROR_INPUT, file, 0, 0, "cannot read: %s", strerror(errno));
    else if (size > MAX_BYTES)
        sp_fail(error, SP_ERROR_INPUT, file, 0, 0, "found more than 16 MiB, expected a smaller file");
    else
        root = sp_yaml_parse(file, text, size, error);
    free(text);
    return root;
}

sp_yaml *sp_yaml_load(const char *file, sp_error *error)
{
    FILE *stream = fopen(file, "rb");
    if (!stream) {
        sp_fail(error, SP_ERROR_INPUT, file, 0, 0, "cannot open: %s", strerror(errno));
        return NULL;
    }
    sp_yaml *root = sp_yaml_load_stream(stream, file, error);
    fclose(stream);
    return root;
}
