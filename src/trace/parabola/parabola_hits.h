/* The hits of parabolas of which it is known which triangle they meet first, many at a time. */
#ifndef SPRAYPLAN_TRACE_PARABOLA_HITS_H
#define SPRAYPLAN_TRACE_PARABOLA_HITS_H

#include "trace/bvh/bvh.h"
#include "trace/ray/parabola.h"

enum { SP_PARABOLA_HITS = 32 };

/* Ray number ray[i] of `rays` meets triangle[i], i < count. */
typedef struct {
    const sp_bvh *bvh;
    const sp_acceleration *acceleration;
    const sp_ray *rays;
    uint32_t ray[SP_PARABOLA_HITS], triangle[SP_PARABOLA_HITS];
    int count;
} sp_parabola_pairs;

/* What sp_parabola_test makes of a ray and two triangles, of which the second may be SP_NONE. */
sp_hit sp_parabola_ask(const sp_bvh *bvh, const sp_acceleration *acceleration, const sp_ray *ray, uint32_t triangle,
                       uint32_t other);

/* Writes what sp_parabola_test makes of each pair to hits[ray[i]], to the last bit. One for each set of instructions.
 */
void sp_parabola_hits_portable(const sp_parabola_pairs *pairs, sp_hit *hits);
void sp_parabola_hits_avx2(const sp_parabola_pairs *pairs, sp_hit *hits);
void sp_parabola_hits_avx512(const sp_parabola_pairs *pairs, sp_hit *hits);

#endif
