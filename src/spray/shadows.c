/* Shadows: connected regions that the criteria do not find covered. */
#include "criterion.h"
#include "spray/state/state.h"

#include <stdlib.h>

sp_lack sp_patch_lack(const sp_evaluator *evaluator, const sp_coverage *coverage, uint32_t patch)
{
    const sp_deposits *deposits = &coverage->deposits;
    if (deposits->covered[patch])
        return SP_LACK_NOTHING;
    if (!(deposits->flux[patch] > 0))
        return SP_LACK_REACH;
    if (deposits->counted[patch] > 0)
        return SP_LACK_FLUX;
    return sp_is_fast_enough(&evaluator->setup.criterion, deposits->speed_max[patch]) ? SP_LACK_ANGLE : SP_LACK_SPEED;
}

typedef struct {
    const sp_evaluator *evaluator;
    const sp_coverage *coverage;
    const sp_reason *reasons;
    bool *visited;     /* [patches], covered ones too */
    uint32_t *queue;   /* [patches] */
    double *part_area; /* [parts], zero between regions */
    double uncovered;  /* m², of the whole surface */
} shadow_search;

/* The part with most of the region's area; of equal ones the lowest number. Leaves part_area zero again. */
static uint32_t main_part(const shadow_search *search, size_t members)
{
    const sp_patches *patches = &search->evaluator->patches;
    const sp_mesh *mesh = search->evaluator->setup.mesh;
    for (size_t i = 0; i < members; i++)
        search->part_area[mesh->part[patches->triangle[search->queue[i]]]] += patches->area[search->queue[i]];
    uint32_t best = mesh->part[patches->triangle[search->queue[0]]];
    for (size_t i = 0; i < members; i++) {
        uint32_t part = mesh->part[patches->triangle[search->queue[i]]];
        double more = search->part_area[part] - search->part_area[best];
        if (more > 0 || (more == 0 && part < best))
            best = part;
    }
    for (size_t i = 0; i < members; i++)
        search->part_area[mesh->part[patches->triangle[search->queue[i]]]] = 0;
    return best;
}

/* Why most of the region's unattainable area is so; of equal ones the first. */
static sp_reason main_reason(const shadow_search *search, size_t members)
{
    double area[SP_REASONS] = {0};
    if (!search->reasons)
        return SP_REASON_UNKNOWN;
    for (size_t i = 0; i < members; i++)
        area[search->reasons[search->queue[i]]] += search->evaluator->patches.area[search->queue[i]];
    sp_reason best = SP_REASON_ATTAINABLE;
    for (sp_reason reason = SP_REASON_UNKNOWN; reason < SP_REASONS; reason++)
        if (area[reason] > 0 && (best == SP_REASON_ATTAINABLE || area[reason] > area[best]))
            best = reason;
    return best;
}

static sp_lack main_lack(const shadow_search *search, size_t members)
{
    double area[SP_LACKS] = {0};
    for (size_t i = 0; i < members; i++)
        area[sp_patch_lack(search->evaluator, search->coverage, search->queue[i])] +=
            search->evaluator->patches.area[search->queue[i]];
    sp_lack most = SP_LACK_REACH;
    for (sp_lack lack = SP_LACK_SPEED; lack < SP_LACKS; lack++)
        if (area[lack] > area[most])
            most = lack;
    return most;
}

/* Fills the queue with the patches of the region that holds `first`; returns how many. */
static size_t flood(const sp_patches *patches, uint32_t first, bool *visited, uint32_t *queue)
{
    size_t members = 1;
    queue[0] = first;
    visited[first] = true;
    for (size_t i = 0; i < members; i++) {
        uint32_t patch = queue[i];
        for (uint32_t k = patches->neighbour_start[patch]; k < patches->neighbour_start[patch + 1]; k++) {
            uint32_t other = patches->neighbours[k];
            if (!visited[other]) {
                visited[other] = true;
                queue[members++] = other;
            }
        }
    }
    return members;
}

/* The region that holds patch `first`. A patch at the edge of a spray is part of it as a whole or not at all, which
 * evens out; but it is no larger than all that is not covered. */
static sp_shadow grow(const shadow_search *search, uint32_t first)
{
    const sp_patches *patches = &search->evaluator->patches;
    size_t members = flood(patches, first, search->visited, search->queue);
    sp_shadow shadow = {.first = first, .reachable_area = search->reasons ? 0 : -1};
    for (size_t i = 0; i < members; i++) {
        uint32_t patch = search->queue[i];
        shadow.area += patches->area[patch];
        shadow.centroid = sp_along(shadow.centroid, patches->area[patch], patches->point[patch]);
        if (search->reasons && search->reasons[patch] == SP_REASON_ATTAINABLE)
            shadow.reachable_area += patches->area[patch];
    }
    shadow.centroid = sp_scale(shadow.centroid, 1 / shadow.area);
    shadow.area = fmin(shadow.area, search->uncovered);
    shadow.reachable_area = fmin(shadow.reachable_area, search->uncovered);
    shadow.part = main_part(search, members);
    shadow.reason = main_reason(search, members);
    shadow.lack = main_lack(search, members);
    return shadow;
}

static int largest_first(const void *left, const void *right)
{
    const sp_shadow *a = left, *b = right;
    if (a->area != b->area)
        return a->area > b->area ? -1 : 1;
    return (a->first > b->first) - (a->first < b->first);
}

/* NULL only where memory runs out. */
static sp_shadow *find_regions(const shadow_search *search, size_t *count)
{
    size_t room = 16;
    sp_shadow *regions = malloc(room * sizeof *regions);
    *count = 0;
    for (size_t patch = 0; regions && patch < search->evaluator->patches.count; patch++) {
        if (search->visited[patch])
            continue;
        if (*count == room) {
            room *= 2;
            sp_shadow *more = realloc(regions, room * sizeof *regions);
            if (!more) {
                free(regions);
                return NULL;
            }
            regions = more;
        }
        regions[(*count)++] = grow(search, (uint32_t)patch);
    }
    if (regions)
        qsort(regions, *count, sizeof *regions, largest_first);
    return regions;
}

bool sp_shadows(const sp_evaluator *evaluator, const sp_coverage *coverage, const sp_reason *reasons,
                sp_shadow **shadows, size_t *count, sp_error *error)
{
    if (!evaluator || !coverage)
        return sp_fail(error, SP_ERROR_ARGUMENT, NULL, 0, 0, "shadows: evaluator and coverage must not be NULL");
    size_t patches = evaluator->patches.count;
    if (coverage->deposits.count != patches)
        return sp_fail(error, SP_ERROR_ARGUMENT, NULL, 0, 0, "shadows: the coverage is of another evaluator");
    shadow_search search = {.evaluator = evaluator,
                            .coverage = coverage,
                            .reasons = reasons,
                            .visited = malloc(patches ? patches * sizeof(bool) : 1),
                            .queue = malloc(patches ? patches * sizeof(uint32_t) : 1),
                            .part_area = calloc(evaluator->setup.mesh->part_count, sizeof(double)),
                            .uncovered = fmax(0, coverage->area - coverage->covered_area)};
    sp_shadow *regions = NULL;
    if (search.visited && search.queue && search.part_area) {
        for (size_t i = 0; i < patches; i++)
            search.visited[i] = coverage->deposits.covered[i];
        regions = find_regions(&search, count);
    }
    free(search.visited);
    free(search.queue);
    free(search.part_area);
    if (!regions)
        return sp_fail_memory(error);
    if (*count == 0) {
        free(regions);
        regions = NULL;
    }
    *shadows = regions;
    return true;
}

bool sp_shadow_numbers(const sp_evaluator *evaluator, const sp_coverage *coverage, const sp_shadow *shadows,
                       size_t count, uint32_t *numbers, sp_error *error)
{
    if (!evaluator || !coverage || (count && !shadows))
        return false;
    size_t patches = evaluator->patches.count;
    bool *visited = malloc(patches + 1);
    uint32_t *queue = malloc((patches + 1) * sizeof *queue);
    bool done = visited && queue;
    for (size_t i = 0; done && i < patches; i++) {
        visited[i] = coverage->deposits.covered[i];
        numbers[i] = 0;
    }
    for (size_t i = 0; done && i < count; i++) {
        size_t members = flood(&evaluator->patches, shadows[i].first, visited, queue);
        for (size_t k = 0; k < members; k++)
            numbers[queue[k]] = (uint32_t)i + 1;
    }
    free(visited);
    free(queue);
    return done || sp_fail_memory(error);
}
