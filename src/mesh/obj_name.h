/* Names of groups as OBJ can say them. */
#ifndef SPRAYPLAN_MESH_OBJ_NAME_H
#define SPRAYPLAN_MESH_OBJ_NAME_H

#include <stdbool.h>
#include <stddef.h>

/* The character to write for name[at]. `#` begins a comment where a word would begin, a backslash at the name's end
 * makes the next line part of this one. */
static inline char sp_obj_name_letter(const char *name, size_t at)
{
    char letter = name[at];
    bool comment = letter == '#' && (at == 0 || name[at - 1] == ' ');
    return comment || (letter == '\\' && !name[at + 1]) ? '_' : letter;
}

#endif
