/* The tree that YAML becomes: making, finding, changing. */
#include "scene/yaml.h"

#include <stdlib.h>
#include <string.h>

void sp_yaml_destroy(sp_yaml *node)
{
    if (!node)
        return;
    for (sp_yaml *child = node->first, *next; child; child = next) {
        next = child->next;
        sp_yaml_destroy(child);
    }
    free(node->text);
    free(node->key);
    free(node->owned_file);
    free(node);
}

sp_yaml *sp_yaml_get(const sp_yaml *map, const char *key)
{
    if (!map || map->kind != SP_YAML_MAP)
        return NULL;
    for (sp_yaml *child = map->first; child; child = child->next)
        if (strcmp(child->key, key) == 0)
            return child;
    return NULL;
}

void sp_yaml_append(sp_yaml *parent, sp_yaml *child)
{
    if (parent->last)
        parent->last->next = child;
    else
        parent->first = child;
    parent->last = child;
    child->next = NULL;
    parent->count++;
}

void sp_yaml_replace(sp_yaml *map, sp_yaml *child)
{
    sp_yaml *before = NULL, *old = map->first;
    while (old && strcmp(old->key, child->key) != 0) {
        before = old;
        old = old->next;
    }
    if (!old) {
        sp_yaml_append(map, child);
        return;
    }
    child->next = old->next;
    *(before ? &before->next : &map->first) = child;
    if (map->last == old)
        map->last = child;
    sp_yaml_destroy(old);
}

sp_yaml *sp_yaml_create(sp_yaml_kind kind, const char *key, const char *text, sp_error *error)
{
    sp_yaml *node = calloc(1, sizeof *node);
    if (!node)
        return sp_fail_memory(error);
    node->kind = kind;
    node->file = "";
    node->key = key ? strdup(key) : NULL;
    node->text = text ? strdup(text) : NULL;
    if ((!key || node->key) && (!text || node->text))
        return node;
    sp_yaml_destroy(node);
    return sp_fail_memory(error);
}

sp_yaml *sp_yaml_clone(const sp_yaml *node, sp_error *error)
{
    sp_yaml *copy = sp_yaml_create(node->kind, node->key, node->text, error);
    if (!copy)
        return NULL;
    copy->empty = node->empty;
    for (const sp_yaml *child = node->first; child; child = child->next) {
        sp_yaml *child_copy = sp_yaml_clone(child, error);
        if (!child_copy) {
            sp_yaml_destroy(copy);
            return NULL;
        }
        sp_yaml_append(copy, child_copy);
    }
    return copy;
}
