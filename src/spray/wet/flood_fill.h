/* The flood: which free sides of faces look into the liquid. */
#ifndef SPRAY_FLOOD_FILL_H
#define SPRAY_FLOOD_FILL_H

#include "spray/wet/faces.h"

#include "mesh/disjoint_sets.h"

/* What lines of sight met: side `to` of a face, or one of these. */
#define SP_SKY (SP_NONE - 1)
#define SP_AMBIGUOUS (SP_NONE - 2) /* an edge, or what is not free */

typedef struct {
    uint32_t from, to;
    uint32_t line; /* its number among the lines of `from` */
} sp_sight_link;

typedef struct {
    const sp_setup *setup;
    const sp_tracer *tracer;
    const sp_faces *faces;
    const sp_shells *shells;
    size_t sides;     /* 2 faces->count */
    double area;      /* m², of the free ones */
    uint32_t *parent; /* [sides + 1], disjoint sets of sides that look into one space; the last is the liquid */
    size_t sight_count, sight_room;
    sp_sight_link *sights;
    uint16_t *seen; /* [sides], how many lines from the cavity's point met the side */
    bool *in_view;  /* [sides], the middle of the side sees the cavity's point */
} sp_flood;

/* caps.c: whether a line meets a cap, or one of the setup's, before t. */
bool sp_cap_blocks(const sp_cap *cap, const sp_ray *line, double t);
bool sp_caps_block(const sp_setup *setup, const sp_ray *line, double t);

/* inside.c: direction `index` of `count`, spread evenly over the sphere; the line of sight from a point that way. */
sp_vec3 sp_sphere_direction(int index, int count);
sp_ray sp_sphere_sight(sp_vec3 point, int index, int count);

/* flood_fill.c: a line from inside a face into the space that its side looks into; the side that a line meets. */
sp_ray sp_flood_line(const sp_flood *flood, uint32_t side, uint64_t line);
uint32_t sp_flood_met(const sp_flood *flood, const sp_ray *line, const sp_hit *hit);

/* What the flood found. */
typedef struct {
    bool *liquid;    /* [2 faces->count], the caller's: sides to which lines of sight lead from the cavity, on and on */
    double outdoors; /* m², of what they lead to under the sky, left out */
    sp_opening openings[SP_OPENINGS];
    size_t opening_count, more_openings; /* those kept; those found besides */
} sp_flooded;
bool sp_flood_faces(const sp_setup *setup, const sp_tracer *tracer, const sp_faces *faces, const sp_shells *shells,
                    sp_flooded *found, sp_error *error);

/* Casts lines number `first` and following from the sides that are marked, `least` or more of each, keeps what they met
 * in `sights`, and joins. *joined becomes how many joins were new. */
#define SP_FLOOD_LINES 32768 /* numbers of lines that the flood itself uses */
bool sp_flood_cast(sp_flood *flood, const bool *sides, uint64_t first, uint64_t least, size_t *joined, sp_error *error);

/* openings.c: where lines leave the liquid that was found, from all that were cast. */
bool sp_flood_openings(const sp_flood *flood, sp_flooded *found, sp_error *error);

/* outdoors.c: clears liquid[side] of what is reached through openings alone but lies under the sky; its area (m²) in
 * *left_out. */
bool sp_flood_keep_indoors(sp_flood *flood, bool *liquid, double *left_out, sp_error *error);

#endif
