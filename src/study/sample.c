/* Figures of a coverage from points of the surface. */
#include "state.h"

#include <math.h>
#include <omp.h>
#include <stdlib.h>

#define BLOCK 65536 /* points in memory at a time */
#define UNSEEN 3    /* points that may differ though none was found to, with 95 % confidence */

sp_point_mean sp_sample_of(const double *values, size_t count)
{
    double sum = 0, size = 0, scatter = UNSEEN;
    for (size_t i = 0; i + 1 < count; i += 2) {
        double apart = values[i] - values[i + 1];
        sum += values[i] + values[i + 1];
        size += fabs(values[i]) + fabs(values[i + 1]);
        scatter += apart * apart;
    }
    double n = (double)count;
    return (sp_point_mean){.mean = sum / n, .spread = 2 * sqrt(scatter) / n, .size = size / n};
}

static int threads_of(const sp_studying *studying)
{
    int threads = studying->options->run.threads;
    return threads > 0 ? threads : omp_get_max_threads();
}

/* The points first to end of all, [end - first]. */
static void draw(const sp_studying *studying, const sp_points *surface, size_t first, size_t end, sp_point *points)
{
    uint64_t seed = studying->setup->fidelity.seed;
    int threads = threads_of(studying);
#pragma omp parallel for num_threads(threads)
    for (size_t i = first; i < end; i++)
        points[i - first] = sp_points_draw(surface, i, studying->points, seed);
}

/* What is done with a block of points. */
typedef bool block_work(void *user, const sp_point *points, size_t first, size_t count, sp_error *error);

static bool each_block(const sp_studying *studying, const sp_evaluator *evaluator, block_work *work, void *user,
                       sp_error *error)
{
    sp_points *surface = sp_points_create(evaluator, error);
    sp_point *points = malloc(BLOCK * sizeof *points);
    bool good = surface && (points || sp_fail_memory(error));
    for (size_t first = 0; good && first < studying->points; first += BLOCK) {
        size_t end = first + BLOCK < studying->points ? first + BLOCK : studying->points;
        draw(studying, surface, first, end, points);
        good = work(user, points, first, end - first, error);
    }
    free(points);
    sp_points_destroy(surface);
    return good;
}

typedef struct {
    const sp_coverage *coverage;
    const double *truth; /* NULL: 0 everywhere */
    double *values;
} comparing;

/* Where round-off left a point no patch, nothing was said of it that could be wrong. */
static bool compare(void *user, const sp_point *points, size_t first, size_t count, sp_error *error)
{
    const comparing *c = user;
    (void)error;
    for (size_t i = 0; i < count; i++) {
        double truth = c->truth ? c->truth[first + i] : 0;
        double share = points[i].patch == SP_NONE ? truth : c->coverage->deposits.share[points[i].patch];
        c->values[first + i] = share - truth;
    }
    return true;
}

bool sp_sample_difference(const sp_studying *studying, const sp_evaluator *evaluator, const sp_coverage *coverage,
                          const double *truth, double *values, sp_error *error)
{
    comparing c = {coverage, truth, values};
    return each_block(studying, evaluator, compare, &c, error);
}

typedef struct {
    const sp_reference *reference;
    bool *covered; /* [BLOCK] */
    double *values;
} judging;

static bool judge(void *user, const sp_point *points, size_t first, size_t count, sp_error *error)
{
    const judging *j = user;
    if (!sp_reference_judge(j->reference, points, count, j->covered, error))
        return false;
    for (size_t i = 0; i < count; i++)
        j->values[first + i] = j->covered[i];
    return true;
}

bool sp_sample_covered(const sp_studying *studying, const sp_reference *reference, double *values, sp_error *error)
{
    if (!reference)
        return false;
    judging j = {reference, malloc(BLOCK * sizeof *j.covered), values};
    bool good = (j.covered || sp_fail_memory(error)) && each_block(studying, studying->own, judge, &j, error);
    free(j.covered);
    return good;
}
