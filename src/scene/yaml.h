/* YAML as a plain tree whose every node knows where it stands: a thin layer over libfyaml's events. */
#ifndef SCENE_YAML_H
#define SCENE_YAML_H

#include <sprayplan/error.h>

#include <stddef.h>
#include <stdio.h>

typedef enum { SP_YAML_SCALAR, SP_YAML_LIST, SP_YAML_MAP } sp_yaml_kind;

typedef struct sp_yaml sp_yaml;
struct sp_yaml {
    sp_yaml_kind kind;
    char *text; /* scalar: its value, owned */
    bool empty; /* scalar: nothing is written there, not even quotes */
    char *key;  /* in a map: its key, owned; NULL elsewhere */
    int key_line, key_column;
    int line, column;      /* from 1; 0 for an override, which has no file */
    const char *file;      /* where it was read, owned by the topmost node of what was read together */
    char *owned_file;      /* the topmost node's copy */
    sp_yaml *first, *last; /* children of a list or map, in order */
    sp_yaml *next;         /* the parent's next child */
    size_t count;          /* of children */
};

/* Reads one document of `size` bytes; `file` names it in errors. Aliases, anchors and tags are refused, so that a tree
 * is never larger than its text; so are nesting beyond 32 levels and keys that are not scalars. */
sp_yaml *sp_yaml_parse(const char *file, const char *text, size_t size, sp_error *error);
/* The same from a file, or what is left of a stream, of at most 16 MiB. */
sp_yaml *sp_yaml_load(const char *file, sp_error *error);
sp_yaml *sp_yaml_load_stream(FILE *stream, const char *file, sp_error *error);
void sp_yaml_destroy(sp_yaml *node);

/* The child with that key, or NULL; NULL where the node is NULL or not a map. */
sp_yaml *sp_yaml_get(const sp_yaml *map, const char *key);
/* A node that stands in no file: a scalar with that text, or a list or map without children. `key` may be NULL. */
sp_yaml *sp_yaml_create(sp_yaml_kind kind, const char *key, const char *text, sp_error *error);
/* A copy that stands in no file. */
sp_yaml *sp_yaml_clone(const sp_yaml *node, sp_error *error);
/* Adds a child at the end; the parent then owns it. */
void sp_yaml_append(sp_yaml *parent, sp_yaml *child);
/* Puts `child` in place of the child with the same key, which is destroyed, or at the end. */
void sp_yaml_replace(sp_yaml *map, sp_yaml *child);

/* The tree as YAML text, which reads back as the same tree; `heading` is a comment of one line. Malloc'd. Fails for
 * text that is not UTF-8. */
char *sp_yaml_text(const sp_yaml *root, const char *heading, sp_error *error);

#endif
