/* Sorting by 64-bit keys. */
#ifndef MESH_KEY_SORT_H
#define MESH_KEY_SORT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Sorts `keys` [count] ascending. Returns false when memory runs out. */
bool sp_sort_keys(uint64_t *keys, size_t count);
/* order [count] becomes the indices of `keys` in ascending order of key; equal keys keep their order. count < 2^32.
 * Returns false when memory runs out. */
bool sp_order_by_key(const uint64_t *keys, size_t count, uint32_t *order);

#endif
