/* Views: what a mounting point can reach by one launch, sorted by direction. */
#ifndef OPTIMIZER_VIEW_H
#define OPTIMIZER_VIEW_H

#include "candidates/candidates.h"
#include "nozzle/outline.h"

#define SP_SIGHTING_PART 512 /* patches traced at a time */
#define SP_BINS_EDGE 32
#define SP_BINS (SP_BINS_EDGE * SP_BINS_EDGE)
#define SP_BLOCKS (SP_BINS / SP_LANES) /* of as many bins */

/* Arrivals that pass the criterion's speed and incidence, or where film is asked for all, sorted by the octahedral bin
 * of their direction, then by patch. */
typedef struct {
    uint32_t count;
    float most;                       /* rad, the greatest breadth of a patch */
    uint32_t *start;                  /* [SP_BINS + 1]; NULL: nothing is known to be reached */
    float *broadest;                  /* [SP_BINS], rad, the greatest breadth of a bin's patches */
    float *cosine, *sine;             /* [SP_BINS], of the bin's radius and SP_OUTLINE_BLUR of that together */
    float *block_cosine, *block_sine; /* [SP_BLOCKS], of the block's radius and the greatest of these angles together */
    float *x, *y, *z;                 /* [count + SP_LANES], unit direction at the nozzle; all 0 behind the last */
    float *transfer;                  /* [count + SP_LANES], per area of all patches */
    float *sharp;                     /* [count + SP_LANES], 1/rad: over the patch's breadth */
    uint32_t *patch;                  /* [count] */
    float *part;                      /* [count], share of the patch that the arrival is of; NULL: 1, and none twice */
    uint8_t *twice; /* [count], whether the patch has other arrivals, by its other arc or cells; NULL: none has */
    uint8_t *fails; /* [count], whether speed or incidence fail the criterion, so that it only feeds the film; NULL:
                     * none does */
} sp_view;

static inline float sp_view_part(const sp_view *view, uint32_t i)
{
    return view->part ? view->part[i] : 1;
}

/* The bins' cones: all directions of a bin are within `radius` of its centre, all centres of a block within its radius
 * of its own. */
typedef struct {
    float x[SP_BINS], y[SP_BINS], z[SP_BINS];
    float radius[SP_BINS]; /* rad */
    float block_x[SP_BLOCKS], block_y[SP_BLOCKS], block_z[SP_BLOCKS];
    float block_radius[SP_BLOCKS]; /* rad */
} sp_bins;

void sp_bins_create(sp_bins *bins);
/* The unit direction at u, v of [-1, 1]², onto which the octahedron is unfolded. */
sp_vec3 sp_octahedron_decode(double u, double v);

/* An arrival on its way into a view. */
typedef struct {
    float x, y, z, transfer, breadth, part;
    uint32_t patch;
    uint16_t bin;
    uint8_t arc;
    bool twice, fails;
} sp_sighting;

/* What was traced, patches ascending, in parts of their own so that none has to be moved. */
typedef struct {
    size_t count, most_parts, parts; /* count: of all parts together */
    size_t *size;                    /* [most_parts] */
    sp_sighting **part;              /* [most_parts] */
    size_t cells;                    /* most arrivals of cells in a part */
    bool any_marked;                 /* some is of a cell, of a patch that has others, or fails */
} sp_sightings;

/* Traces what `site` can reach by a launch within half_angle (rad) about its axis; or, where `known` is not NULL,
 * tells again what was traced before. While it runs it takes no more than sp_sightings_work() bytes besides the
 * sightings, for as many `cells` as they then have. The caller frees, also on failure. */
bool sp_sightings_trace(const sp_evaluator *evaluator, const sp_site *site, sp_launch launch, double half_angle,
                        const uint8_t *known, sp_sightings *sightings, sp_error *error);
/* Sets bit 2 patch + arc of `known` for every sighting. */
void sp_sightings_note(const sp_sightings *sightings, uint8_t *known);
void sp_sightings_free(sp_sightings *sightings);
size_t sp_sightings_work(size_t cells);

/* Bytes of a view's block. */
size_t sp_view_bytes(size_t count, bool any_marked);
/* Writes the sightings as a view into the block, of sp_view_bytes, that then is view->start. */
void sp_view_write(const sp_sightings *sightings, const sp_bins *bins, void *block, sp_view *view);

#endif
