/* Arrays that grow. */
#ifndef SPRAYPLAN_MESH_GROW_H
#define SPRAYPLAN_MESH_GROW_H

#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* Room for `capacity` items of `size` bytes; what the array holds stays. False when memory runs out: then it is what it
 * was. `array` is the address of a pointer to the items. */
static inline bool sp_reallocate(void *array, size_t capacity, size_t size)
{
    void *items;
    if (capacity > SIZE_MAX / size)
        return false;
    memcpy(&items, array, sizeof items);
    items = realloc(items, capacity * size);
    if (items)
        memcpy(array, &items, sizeof items);
    return items != NULL;
}

/* Where `needed` items do not fit into *capacity, twice as much as they need. */
static inline bool sp_grow(void *array, size_t *capacity, size_t needed, size_t size)
{
    if (needed <= *capacity)
        return true;
    if (needed > SIZE_MAX / 2 || !sp_reallocate(array, 2 * needed, size))
        return false;
    *capacity = 2 * needed;
    return true;
}

#endif
