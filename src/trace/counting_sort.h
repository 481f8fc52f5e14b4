/* Sorting numbered things by small keys. */
#ifndef SPRAYPLAN_MESH_COUNTING_SORT_H
#define SPRAYPLAN_MESH_COUNTING_SORT_H

#include <sprayplan/error.h>

#include <stddef.h>
#include <stdint.h>

/* Sorts order[count] by keys[order[i]] < key_count; things of equal key keep their order, so that sorting by the least
 * important key first sorts by several. False when memory runs out. */
bool sp_counting_sort(uint32_t *order, size_t count, const uint32_t *keys, size_t key_count, sp_error *error);

#endif
