/* Cells of aims: all the ways in which a nozzle at one place may point, turn, open and be throttled, in pieces.
 *
 * An aim is an axis within the mount's tilt, a roll, an angle and a flow. A cell holds the axes of a square of the
 * octahedral map, an interval of rolls, one of angles, and one step of flow. */
#ifndef OPTIMIZER_AIM_CELLS_H
#define OPTIMIZER_AIM_CELLS_H

#include "scoring/partial.h"

#define SP_AIM_CHILDREN 64

/* A type at a pressure, whatever its angle and flow. */
typedef struct {
    const sp_nozzle_type *type;
    double pressure;              /* Pa */
    size_t launch, variant;       /* variant: the first of the candidates' variants that are of this kind */
    double angle_low, angle_high; /* rad */
    size_t step_count;            /* flows from edge[i] to edge[i + 1], m³/s */
    double *edge;                 /* [step_count + 1] */
} sp_aim_kind;

typedef struct {
    size_t count;
    sp_aim_kind *items;
} sp_aim_kinds;

/* The kinds of the candidates' variants, as far as refinement may open and throttle them. */
bool sp_aim_kinds_create(const sp_search *search, sp_aim_kinds *kinds, sp_error *error);
void sp_aim_kinds_free(sp_aim_kinds *kinds);

typedef struct {
    uint32_t site, kind, step;
    int level;                    /* the axes' square is one of 2^level x 2^level; -1: all axes within the tilt */
    double u, v;                  /* its lower corner */
    double roll, roll_half;       /* rad, the middle and half the width */
    double angle_low, angle_high; /* rad */
    double upper;                 /* price that no aim of the cell exceeds */
} sp_aim_cell;

/* All axes of a cell lie within `radius` (rad) of `axis`. */
typedef struct {
    sp_vec3 axis;
    double radius;
} sp_aim_disc;

/* All of the aims of a kind at a site, with one step of flow. */
sp_aim_cell sp_aim_cell_whole(const sp_aim_kind *kind, uint32_t site, uint32_t number, uint32_t step);
sp_aim_disc sp_aim_cell_disc(const sp_aim_cell *cell, const sp_site *site, double tilt);
/* A pattern and its frame that hold all directions which any aim of the cell sprays in. */
sp_spray sp_aim_cell_spray(const sp_aim_cell *cell, const sp_aim_kind *kind, double radius);
sp_frame sp_aim_cell_frame(const sp_aim_cell *cell, const sp_aim_disc *disc, sp_vec3 up);
/* No aim of the cell sprays more per steradian (m³/s/sr). */
double sp_aim_cell_intensity(const sp_aim_cell *cell, const sp_aim_kind *kind);
/* The same, the least. */
double sp_aim_cell_intensity_least(const sp_aim_cell *cell, const sp_aim_kind *kind);
/* A narrow aim of the cell that sprays as much per steradian: its middle. */
sp_aim_cell sp_aim_cell_middle(const sp_aim_cell *cell, const sp_aim_kind *kind);
/* False where a cell is as small as makes a difference. */
bool sp_aim_cell_splits(const sp_aim_cell *cell, const sp_aim_kind *kind, const sp_site *site, double tilt);
/* A cell that splits in pieces that together hold all of its aims within the tilt; returns how many, which may be none.
 */
size_t sp_aim_cell_split(const sp_aim_cell *cell, const sp_aim_kind *kind, const sp_site *site, double tilt,
                         sp_aim_cell children[SP_AIM_CHILDREN]);

#endif
