/* The name of a part: one name for each level of the assembly, that of the copy where its author gave it one. */
#include "mesh/cad/stream.h"

#include "mesh/utf8.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

static bool has_prefix(const char *text, size_t length, const char *prefix)
{
    return length >= strlen(prefix) && memcmp(text, prefix, strlen(prefix)) == 0;
}

/* Without what is blank at its ends; no length where nothing is left but what OpenCASCADE makes up, "=>[0:1:1:3]". */
static size_t trim(const char **text)
{
    while (**text && (unsigned char)**text <= ' ')
        ++*text;
    size_t length = strlen(*text);
    while (length > 0 && (unsigned char)(*text)[length - 1] <= ' ')
        length--;
    return has_prefix(*text, length, "=>[") ? 0 : length;
}

/* What stands for a copy that its author gave no name: "12", and "NAUO12" after the entity that it is in the file. */
static bool is_number(const char *text, size_t length)
{
    for (size_t i = has_prefix(text, length, "NAUO") ? 4 : 0; i < length; i++)
        if (!isdigit((unsigned char)text[i]))
            return false;
    return true;
}

static size_t append_level(char *name, size_t length, const char *copy, const char *original)
{
    const char *text = copy;
    size_t size = trim(&text);
    if (is_number(text, size)) {
        const char *name_of_all = original;
        size_t of_all = trim(&name_of_all);
        text = of_all ? name_of_all : text;
        size = of_all ? of_all : size;
    }
    if (size == 0)
        return length;
    if (length > 0)
        name[length++] = '/';
    size_t end = length + sp_utf8_append(name + length, text, size);
    for (size_t i = length; i < end; i++)
        if ((unsigned char)name[i] < ' ' || name[i] == 127)
            name[i] = ' ';
    return end;
}

char *sp_cad_part_name(const char *texts, size_t size, sp_error *error)
{
    static const char nothing[] = "body";
    char *own = malloc(size + 1), *name = malloc(2 * size + sizeof nothing);
    size_t length = 0;
    if (own && name) {
        memcpy(own, texts, size);
        own[size] = '\0';
        for (const char *at = own, *end = own + size; at < end;) {
            const char *copy = at, *original = at + strlen(at) < end ? at + strlen(at) + 1 : at;
            length = append_level(name, length, copy, original);
            at = original + strlen(original) + 1;
        }
        if (length == 0)
            memcpy(name, nothing, length = sizeof nothing - 1);
        name[length] = '\0';
    } else {
        sp_fail_memory(error);
        free(name);
        name = NULL;
    }
    free(own);
    return name;
}
