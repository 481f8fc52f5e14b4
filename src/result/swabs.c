/* The worst places of a design: where to look, or to take a sample, first. */
#include "design.h"

#include <sprayplan/result.h>

#include <stdlib.h>

#define APART 0.05 /* of the geometry's diagonal */
#define SPREAD 4   /* times as far apart, first, of places that are equally bad */

typedef struct {
    double received; /* share of what is asked for; INFINITY where any liquid that passes will do */
    double counted;  /* m³/s per m² */
    uint32_t depth;  /* patches from here to what is covered */
    uint32_t patch;
} candidate;

static int worst_first(const void *left, const void *right)
{
    const candidate *a = left, *b = right;
    if (a->received != b->received)
        return a->received < b->received ? -1 : 1;
    if (a->depth != b->depth)
        return a->depth > b->depth ? -1 : 1;
    if (a->counted != b->counted)
        return a->counted < b->counted ? -1 : 1;
    return (a->patch > b->patch) - (a->patch < b->patch);
}

static double received(const sp_criterion *criterion, const sp_deposits *deposits, size_t patch)
{
    double counted = deposits->counted[patch];
    double impact = criterion->flux > 0 ? counted / criterion->flux : counted > 0 ? INFINITY : 0;
    return criterion->film > 0 ? fmax(impact, deposits->film[patch] / criterion->film) : impact;
}

/* Patches from each to the nearest that is covered; UINT32_MAX where no way leads there. NULL where memory runs out. */
static uint32_t *depths(const sp_patches *patches, const bool *covered)
{
    uint32_t *depth = malloc((patches->count + 1) * sizeof *depth),
             *queue = malloc((patches->count + 1) * sizeof *queue);
    size_t known = 0;
    for (uint32_t i = 0; depth && queue && i < patches->count; ++i) {
        depth[i] = covered[i] ? 0 : UINT32_MAX;
        if (covered[i])
            queue[known++] = i;
    }
    for (size_t i = 0; i < known; ++i)
        for (uint32_t k = patches->neighbour_start[queue[i]]; k < patches->neighbour_start[queue[i] + 1]; ++k) {
            uint32_t other = patches->neighbours[k];
            if (depth[other] != UINT32_MAX)
                continue;
            depth[other] = depth[queue[i]] + 1;
            queue[known++] = other;
        }
    if (!queue) {
        free(depth);
        depth = NULL;
    }
    free(queue);
    return depth;
}

/* All that is counted, the worst first. NULL where memory runs out. */
static candidate *candidates(const sp_design *design, size_t *count)
{
    const sp_patches *patches = sp_evaluator_patches(design->evaluator);
    const sp_criterion *criterion = &sp_evaluator_setup(design->evaluator)->criterion;
    const sp_deposits *deposits = &design->coverage->deposits;
    candidate *list = malloc((patches->count + 1) * sizeof *list);
    uint32_t *depth = list ? depths(patches, deposits->covered) : NULL;
    *count = 0;
    for (uint32_t i = 0; depth && i < patches->count; ++i)
        if (sp_evaluator_counted(design->evaluator, i) > 0)
            list[(*count)++] = (candidate){received(criterion, deposits, i), deposits->counted[i], depth[i], i};
    if (depth)
        qsort(list, *count, sizeof *list, worst_first);
    else
        free(list);
    free(depth);
    return depth ? list : NULL;
}

static bool is_apart(const sp_patches *patches, const sp_swab *swabs, size_t count, uint32_t patch, double least)
{
    bool apart = true;
    for (size_t i = 0; apart && i < count; ++i)
        apart = sp_distance(patches->point[swabs[i].patch], patches->point[patch]) >= least;
    return apart;
}

static sp_swab describe(const sp_design *design, const candidate *found)
{
    const sp_setup *setup = sp_evaluator_setup(design->evaluator);
    const sp_patches *patches = sp_evaluator_patches(design->evaluator);
    const sp_deposits *deposits = &design->coverage->deposits;
    uint32_t patch = found->patch;
    bool wet = deposits->flux[patch] > 0;
    return (sp_swab){.patch = patch,
                     .place = sp_setup_outside(setup, patches->point[patch]),
                     .part = setup->mesh->parts[setup->mesh->part[patches->triangle[patch]]].name,
                     .received = isfinite(found->received) && (setup->criterion.flux > 0 || setup->criterion.film > 0)
                                     ? found->received
                                     : NAN,
                     .flux = deposits->flux[patch],
                     .speed = wet ? deposits->speed[patch] : NAN,
                     .incidence = wet ? deposits->incidence[patch] : NAN,
                     .lack = sp_patch_lack(design->evaluator, design->coverage, patch)};
}

/* Of equally bad places, the deepest first: at first far apart, and none half as deep as the deepest or less, so that
 * one large dry region does not take them all, then nearer. */
static void choose(const sp_design *design, const candidate *list, size_t all, double least, sp_swab swabs[SP_SWABS],
                   size_t *count)
{
    const sp_patches *patches = sp_evaluator_patches(design->evaluator);
    for (int spread = SPREAD; spread >= 1; spread /= 2)
        for (size_t i = 0; i < all && *count < SP_SWABS; ++i)
            if ((spread == 1 || list[i].depth > list[0].depth / 2) &&
                is_apart(patches, swabs, *count, list[i].patch, spread * least))
                swabs[(*count)++] = describe(design, &list[i]);
}

bool sp_find_swabs(const sp_design *design, sp_swab swabs[SP_SWABS], size_t *count, sp_error *error)
{
    if (!sp_design_is_evaluated(design))
        return false;
    sp_vec3 low, high;
    double least = APART * sp_mesh_box(sp_evaluator_setup(design->evaluator)->mesh, &low, &high);
    size_t all;
    candidate *list = candidates(design, &all);
    *count = 0;
    if (!list)
        return sp_fail_memory(error);
    for (size_t i = 0, next; i < all; i = next) {
        for (next = i + 1; next < all && list[next].received == list[i].received;)
            next++;
        choose(design, &list[i], next - i, least, swabs, count);
    }
    free(list);
    return true;
}
