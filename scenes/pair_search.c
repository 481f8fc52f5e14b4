/* Is there more to gain with few nozzles than refinement finds? At one amount of water every pose, or every so many-th,
 * at the flows that refinement may set, is given the best partner that the water left allows; the best of these pairs
 * are refined, each by Ceres from a narrow width and by compass. Says what the best of them cover before and after
 * that, and which place in the order it had. One thread. */
#include "placement.h"
#include "refine/continuation.h"
#include "refine/compass.h"
#include "search/partial_enumeration.h"
#include "search/tuned.h"

#include <stdio.h>
#include <stdlib.h>

#define ROWS 12000 /* about so many poses, before flows are varied */
#define NARROW 3   /* the width at which an annealing starts that keeps what is there */
#define SIGHTS 24
#define STEP_FIRST 0.25 /* of the compass, as refinement has it */
#define STEP_LEAST 0.006

/* A pose and its best partner, or none. */
typedef struct {
    uint32_t row[2];
    size_t count;
    double covered; /* m² of the coverage matrix's sample */
} pair;

static int by_covered(const void *a, const void *b)
{
    const pair *p = a, *q = b;
    return (p->covered < q->covered) - (p->covered > q->covered);
}

/* Every stride-th pose of all beside those that the search remembered. */
static void widen_pool(placement *p)
{
    sp_error error = {0};
    const sp_candidates *candidates = &p->candidates;
    size_t stride = candidates->pose_start[p->sites.count] / ROWS + 1, number = 0;
    for (uint32_t s = 0; s < p->sites.count; s++)
        for (uint32_t k = 0; k < candidates->variant_count; k++) {
            size_t axes = sp_candidates_axes(candidates, p->sites.items[s].mount, k)->count;
            for (uint32_t a = 0; a < axes; a++)
                for (uint32_t r = 0; r < candidates->variants[k].roll_count; r++)
                    if (number++ % stride == 0 && sp_search_knows(&p->search, s, k) &&
                        !sp_pool_add(&p->pool, (sp_pose){s, k, a, r}, &error))
                        fail(&error);
        }
    sp_pool_settle(&p->pool);
}

/* Every row that the budget allows with its best partner, the best first; malloc'd. */
static pair *list_pairs(const sp_coverage_matrix *matrix, double budget, size_t *count)
{
    sp_error error = {0};
    sp_selection selection;
    pair *pairs = malloc((matrix->row_count + 1) * sizeof *pairs);
    if (!pairs || !sp_selection_create(matrix, &selection, &error))
        fail(&error);
    *count = 0;
    for (uint32_t r = 0; r < matrix->row_count; r++) {
        double gain;
        sp_selection_set(&selection, NULL, 0);
        if (!(sp_selection_gain(&selection, r, budget) > 0))
            continue;
        sp_selection_add(&selection, r);
        uint32_t partner = sp_selection_best(&selection, 0, 0, budget, &gain);
        pairs[(*count)++] = (pair){{r, partner}, gain > 0 ? 2 : 1, selection.covered + fmax(gain, 0)};
    }
    sp_selection_free(&selection);
    qsort(pairs, *count, sizeof *pairs, by_covered);
    return pairs;
}

static bool is_known(const pair *pairs, size_t i)
{
    for (size_t k = 0; k < i; k++)
        if (pairs[k].count == pairs[i].count && pairs[i].count == 2 && pairs[k].row[0] == pairs[i].row[1] &&
            pairs[k].row[1] == pairs[i].row[0])
            return true;
    return false;
}

/* What a pair covers on the search's patches, m², before and after it was refined. */
static void refine(placement *p, const sp_tuned *tuned, const sp_coverage_matrix *matrix, const pair *start,
                   double budget, double covered[2])
{
    sp_error error = {0};
    sp_sights sights;
    sp_selection selection;
    sp_partial partial;
    if (!sp_sights_create(&p->search, SIGHTS, false, &sights, &error) ||
        !sp_selection_create(matrix, &selection, &error))
        fail(&error);
    sp_selection_set(&selection, start->row, start->count);
    if (!sp_selection_partial(&selection, &tuned->search, NULL, &partial, &error))
        fail(&error);
    sp_tuned_settle(tuned, &partial);
    covered[0] = partial.covered;
    double water = sp_partial_water(&p->search, &partial, budget);
    if (!sp_continuation(&sights, NARROW, SP_WIDTHS, water, &p->deadline, &partial, &error) ||
        !sp_compass(&sights, STEP_FIRST, STEP_LEAST, water, &p->deadline, &partial, &error))
        fail(&error);
    covered[1] = partial.covered;
    sp_partial_free(&partial);
    sp_selection_free(&selection);
    sp_sights_free(&sights);
}

int main(int argc, char **argv)
{
    double litres = argc == 4 ? strtod(argv[2], NULL) : 0;
    size_t most = argc == 4 ? strtoul(argv[3], NULL, 10) : 0, count;
    if (!(litres > 0) || !most) {
        fprintf(stderr, "usage: pair_search SCENE L_PER_MIN PAIRS\n");
        return 2;
    }
    sp_error error = {0};
    placement p;
    sp_tuned tuned;
    sp_coverage_matrix matrix = {0};
    placement_open(argv[1], &p);
    widen_pool(&p);
    double budget = litres / 6e4 * (1 + SP_ROUNDING), best[2] = {0, 0};
    if (!sp_tuned_create(&p.search, &p.pool, &tuned, &error) ||
        !sp_coverage_matrix_create(&tuned.search, &tuned.pool, NULL, 0, &matrix, &error))
        fail(&error);
    pair *pairs = list_pairs(&matrix, budget, &count);
    size_t tried = 0, rank = 0;
    for (size_t i = 0; i < count && tried < most; i++) {
        double covered[2];
        if (is_known(pairs, i))
            continue;
        refine(&p, &tuned, &matrix, &pairs[i], budget, covered);
        best[0] = fmax(best[0], covered[0]);
        rank = covered[1] > best[1] ? tried : rank;
        best[1] = fmax(best[1], covered[1]);
        tried++;
    }
    printf("%zu rows, %zu pairs refined at %g L/min: %.2f %% of the attainable before, %.2f %% after, from pair %zu\n",
           matrix.row_count, tried, litres, 100 * best[0] / p.search.view_area, 100 * best[1] / p.search.view_area,
           rank + 1);
    free(pairs);
    sp_coverage_matrix_free(&matrix);
    sp_tuned_free(&tuned);
    placement_close(&p);
    return 0;
}
