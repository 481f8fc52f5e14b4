/* Points by their coordinates, so that equal ones become one vertex. */
#ifndef SPRAYPLAN_MESH_WELD_H
#define SPRAYPLAN_MESH_WELD_H

#include "mesh/siphash.h"

#include <sprayplan/mesh.h>

typedef struct {
    uint32_t *slots; /* [size] of vertex numbers by hash of their coordinates, SP_NONE where free; the owner frees it */
    size_t size;     /* a power of two, or 0 */
    sp_hash_key key; /* of the hashes */
} sp_weld_table;

/* Makes room for `capacity` vertices where there is none, and puts the `count` there are in anew. Starts as {0}. False
 * when memory runs out. */
bool sp_weld_reserve(sp_weld_table *table, size_t capacity, const sp_vec3 *vertices, size_t count);
/* The slot that holds the number of the vertex equal to `point`, or, where it is free, may hold the point's own. There
 * must be a free slot. */
uint32_t *sp_weld_slot(const sp_weld_table *table, const sp_vec3 *vertices, sp_vec3 point);

/* -0 becomes 0: they are equal, and hashed by their bits. */
static inline sp_vec3 sp_weld_canonical(sp_vec3 point)
{
    return sp_add(point, sp_v(0, 0, 0));
}

#endif
