/* Dividing triangles in two by the surface area heuristic, for building the wide hierarchy. */
#ifndef SPRAYPLAN_TRACE_BVH_SPLIT_H
#define SPRAYPLAN_TRACE_BVH_SPLIT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { SP_BIN_COUNT = 16 };

/* Four lanes, the last one idle, so that a compiler sees vectors. */
typedef struct {
    float low[4], high[4];
} sp_bvh_box;

/* A triangle to be placed: its box in the hierarchy's space. */
typedef struct {
    float low[3];
    uint32_t triangle;
    float high[3];
    uint32_t unused;
} sp_bvh_reference;

/* References [first, first + count) of one of two buffers, with the box around them and around twice their centres. */
typedef struct {
    size_t first, count;
    int buffer;
    sp_bvh_box box, centres;
} sp_bvh_range;

sp_bvh_box sp_bvh_box_empty(void);
void sp_bvh_box_unite(sp_bvh_box *box, const sp_bvh_box *other);
/* Half the surface. */
float sp_bvh_box_area(const sp_bvh_box *box);
/* The boxes of a range, from its references. */
void sp_bvh_measure(const sp_bvh_reference *references, sp_bvh_range *range);

/* Divides a range of more than one; both parts lie in the other buffer. `balanced`: into halves, whatever that costs.
 * With `threads` above 1 the work is shared out; the outcome is the same. `buffers` are two arrays that hold the
 * range's places. False when memory runs out. */
bool sp_bvh_divide(sp_bvh_reference *const buffers[2], const sp_bvh_range *range, bool balanced, int threads,
                   sp_bvh_range parts[2]);

#endif
