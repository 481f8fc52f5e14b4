/* Where two regions cover shares of one patch, what both leave dry is least where they do not overlap and most where
 * one holds the other. Samples, which are tested one by one, tell where it lies between these; the shares themselves
 * are closed forms, so that edges that coincide or abut count to all digits. Samples are as dense as the blur of edges:
 * seen across an edge of any direction their density is the slope of its step, 30 t² (1 - t)², which over a disc is (1
 * - r²)^(3/2). */
#include "edges.h"

#include "nozzle/pattern.h"

#include <math.h>
#include <stdlib.h>

#define ALL (~(uint64_t)0)
#define ROWS 8                         /* of as many samples */
#define ROUND_OFF 1e-12                /* of a cosine */
#define GOLDEN_ANGLE 2.399963229728653 /* rad: on a spiral turned by it samples are even in every direction */

bool sp_edges_create(const sp_evaluator *evaluator, sp_edges *edges, sp_error *error)
{
    size_t patches = sp_evaluator_patches(evaluator)->count;
    *edges = (sp_edges){.evaluator = evaluator,
                        .dry = malloc((patches + 1) * sizeof *edges->dry),
                        .dark = malloc((patches + 1) * sizeof *edges->dark)};
    for (size_t p = 0; edges->dry && edges->dark && p < patches; p++) {
        edges->dry[p] = 1;
        edges->dark[p] = ALL;
    }
    for (int k = 0; k < SP_EDGE_SAMPLES; k++) {
        double within = (k + 0.5) / SP_EDGE_SAMPLES, radius = sqrt(1 - pow(1 - within, 0.4)), turn = k * GOLDEN_ANGLE;
        edges->blurred[k][0] = 0.5 * SP_SPRAY_BLUR * radius * cos(turn);
        edges->blurred[k][1] = 0.5 * SP_SPRAY_BLUR * radius * sin(turn);
        edges->even[k][0] = (k % ROWS + 0.5) / ROWS - 0.5;
        edges->even[k][1] = (k / ROWS + 0.5) / ROWS - 0.5;
    }
    return (edges->dry && edges->dark) || sp_fail_memory(error);
}

void sp_edges_free(sp_edges *edges)
{
    free(edges->dry);
    free(edges->dark);
    *edges = (sp_edges){0};
}

static bool leaves_the_same_point(const sp_nozzle *patterns, size_t i, size_t next, size_t count)
{
    return next < count && sp_distance(patterns[i].position, patterns[next].position) <= 0;
}

void sp_edges_begin(sp_edges *edges, const sp_nozzle *patterns, size_t i, size_t count)
{
    const sp_nozzle *own = &patterns[i];
    edges->shared =
        (i > 0 && leaves_the_same_point(patterns, i, i - 1, count)) || leaves_the_same_point(patterns, i, i + 1, count);
    if (!edges->shared)
        return;
    edges->from = own->position;
    edges->spray = sp_spray_create(own->type, sp_nozzle_angle(own));
    edges->least = cos(edges->spray.high) - ROUND_OFF;
    edges->most = cos(edges->spray.low) + ROUND_OFF;
    edges->frame = sp_nozzle_frame(own->axis, own->roll, sp_evaluator_setup(edges->evaluator)->up);
}

/* Where samples of a patch are as the pattern in hand sees them, as vectors from its point of any length. */
typedef struct {
    sp_vec3 middle, x, y; /* m, or over the way */
    const double (*offset)[2];
} lattice;

/* A direction in a surface, the same wherever what arrives comes from: flights to one patch that differ a little have
 * their samples in the same places of it. */
static sp_vec3 along_surface(sp_vec3 normal)
{
    return sp_unit(sp_cross(normal, fabs(normal.x) < 0.5 ? sp_v(1, 0, 0) : sp_v(0, 1, 0)));
}

/* In the blur of a patch that looks small. */
static lattice blurred_lattice(const sp_edges *edges, const sp_arrival *arrival)
{
    sp_vec3 d = arrival->direction, along = along_surface(arrival->normal);
    sp_vec3 x = sp_scale(sp_unit(sp_along(along, -sp_dot(along, d), d)), arrival->breadth);
    return (lattice){d, x, sp_cross(d, x), edges->blurred};
}

/* On all of a patch so near that it is cut into cells, where flights are straight. */
static lattice near_lattice(const sp_edges *edges, uint32_t patch)
{
    const sp_patches *patches = sp_evaluator_patches(edges->evaluator);
    sp_vec3 n = patches->normal[patch], x = sp_scale(along_surface(n), patches->length[patch]);
    return (lattice){sp_sub(patches->point[patch], edges->from), x, sp_cross(n, x), edges->even};
}

void sp_edges_sample(const sp_edges *edges, const sp_arrival *arrival, double share, sp_edge_samples *samples)
{
    bool cut = arrival->part < 1;
    if (!edges->shared || share <= 0 || (cut ? samples->dark != ALL : share >= 1))
        return;
    lattice own = cut ? near_lattice(edges, arrival->patch) : blurred_lattice(edges, arrival);
    for (int k = 0; k < SP_EDGE_SAMPLES; k++) {
        sp_vec3 way = sp_along(sp_along(own.middle, own.offset[k][0], own.x), own.offset[k][1], own.y);
        way = sp_unit(way);
        double along = sp_dot(way, edges->frame.z);
        if (along >= edges->least && along <= edges->most && sp_spray_holds(&edges->spray, &edges->frame, way))
            samples->dark &= ~((uint64_t)1 << k);
    }
}

/* What both of two regions leave dry that leave these shares dry; where samples do not tell, they lie anywhere. */
static double left_by_both(double one, double other, uint64_t one_dark, uint64_t other_dark, uint64_t all)
{
    int of_one = __builtin_popcountll(one_dark & all), of_other = __builtin_popcountll(other_dark & all),
        of_both = __builtin_popcountll(one_dark & other_dark & all), beyond = of_one + of_other;
    int most = of_one < of_other ? of_one : of_other, count = __builtin_popcountll(all),
        least = beyond > count ? beyond - count : 0;
    if (most <= least)
        return one * other;
    double low = fmax(0, one + other - 1), high = fmin(one, other);
    return low + (high - low) * (of_both - least) / (most - least);
}

void sp_edges_add(sp_edges *edges, uint32_t patch, double share, sp_edge_samples samples, double *dry)
{
    if (!edges->shared) {
        dry[patch] *= share;
        return;
    }
    if (share >= 1)
        return;
    if (edges->dry[patch] < 1)
        share = left_by_both(edges->dry[patch], share, edges->dark[patch], samples.dark, samples.all);
    edges->dry[patch] = share;
    edges->dark[patch] &= samples.dark;
}

void sp_edges_end(sp_edges *edges, const sp_nozzle *patterns, size_t i, size_t count, double *dry)
{
    if (!edges->shared || leaves_the_same_point(patterns, i, i + 1, count))
        return;
    for (size_t p = 0; p < sp_evaluator_patches(edges->evaluator)->count; p++) {
        dry[p] *= edges->dry[p];
        edges->dry[p] = 1;
        edges->dark[p] = ALL;
    }
}
