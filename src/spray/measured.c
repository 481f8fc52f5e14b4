/* How far a coverage is off, measured at points. */
#include "reference.h"

#include <sprayplan/points.h>

#include <stdlib.h>

#define FEWEST 10000
#define MOST (FEWEST << 9)
#define BLOCK 65536      /* points in memory at a time; even */
#define PRECISION 0.0625 /* of the accuracy or the difference, that twice the standard error may come to */
#define ROUGH 0.25       /* the same, for choosing and of goods that move, where a point takes as long as a hundred */
#define ROUGH_MOST (FEWEST << 3)
#define UNSEEN 3 /* points that may differ though none was found to, with 95 % confidence */

/* Sums over the points' differences, each from -1 to 1. */
typedef struct {
    double sum, size;
    double scatter; /* of the squared differences within pairs */
} tally;

/* What a point is off by. Where round-off left it no patch, nothing was said of it that could be wrong. */
static double difference(const sp_coverage *coverage, const sp_point *point, bool covered)
{
    return point->patch == SP_NONE ? 0 : coverage->deposits.share[point->patch] - covered;
}

/* Neighbours have neighbouring parts of the surface to themselves, and are drawn independently: the square of what they
 * are apart is on average the sum of their variances, and more where the means of their parts differ. */
static void add_block(const sp_coverage *coverage, const sp_point *points, const bool *covered, size_t count,
                      tally *tally)
{
    for (size_t i = 0; i < count; i += 2) {
        double one = difference(coverage, &points[i], covered[i]);
        double other = difference(coverage, &points[i + 1], covered[i + 1]);
        tally->sum += one + other;
        tally->size += fabs(one) + fabs(other);
        tally->scatter += (one - other) * (one - other);
    }
}

/* A surface, what was found of it, and what it is compared with. */
typedef struct {
    const sp_points *surface;
    sp_reference *reference;
    const sp_coverage *coverage;
    uint64_t seed;
    double precision; /* of the accuracy or the difference */
    size_t most;      /* points */
    sp_point *points; /* [BLOCK] */
    bool *covered;    /* [BLOCK] */
} measuring;

static bool compare(const sp_evaluator *evaluator, const measuring *m, size_t n, tally *tally, sp_error *error)
{
    for (size_t first = 0; first < n; first += BLOCK) {
        size_t count = n - first < BLOCK ? n - first : BLOCK;
#pragma omp parallel for num_threads(sp_thread_count(evaluator->setup.run.threads))
        for (size_t i = 0; i < count; i++)
            m->points[i] = sp_points_draw(m->surface, first + i, n, m->seed);
        if (!sp_reference_judge(m->reference, m->points, count, m->covered, error))
            return false;
        add_block(m->coverage, m->points, m->covered, count, tally);
    }
    return true;
}

/* By n points; what they take is reported as a stage of its own each time, as nobody knows how many will do. */
static bool compare_by(const sp_evaluator *evaluator, const measuring *m, size_t n, tally *tally, sp_error *error)
{
    sp_watch watch = sp_watch_start(evaluator, "measured error", n);
    m->reference->watch = &watch;
    bool done = compare(evaluator, m, n, tally, error) && sp_watch_end(&watch, error);
    m->reference->watch = NULL;
    return done;
}

static bool measure(const sp_evaluator *evaluator, const measuring *m, sp_measured_error *measured, sp_error *error)
{
    double accuracy = evaluator->setup.fidelity.accuracy, mean = 0, spread = INFINITY;
    for (size_t n = FEWEST; n <= m->most && spread > m->precision * fmax(accuracy, mean); n *= 2) {
        tally tally = {0};
        if (!compare_by(evaluator, m, n, &tally, error))
            return false;
        mean = fabs(tally.sum) / (double)n;
        spread = 2 * sqrt(tally.scatter + UNSEEN) / (double)n;
        *measured = (sp_measured_error){.known = true,
                                        .estimate = fmin(1, mean + spread),
                                        .bias = tally.sum / (double)n,
                                        .misjudged = tally.size / (double)n,
                                        .points = n};
    }
    return true;
}

static bool measure_on(const sp_evaluator *evaluator, const sp_layout *layout, sp_trajectory trajectory, measuring *m,
                       sp_measured_error *measured, sp_error *error)
{
    *measured = (sp_measured_error){.known = false};
    if (evaluator->fidelity.reflections > 0 || !(m->coverage->area > 0))
        return true;
    sp_points *surface = sp_points_create(evaluator, error);
    sp_reference *reference = sp_reference_create(evaluator, layout, trajectory, error);
    m->surface = surface;
    m->reference = reference;
    m->points = malloc(BLOCK * sizeof *m->points);
    m->covered = malloc(BLOCK * sizeof *m->covered);
    bool done = surface && reference && ((m->points && m->covered) || sp_fail_memory(error)) &&
                measure(evaluator, m, measured, error);
    free(m->points);
    free(m->covered);
    sp_reference_destroy(reference);
    sp_points_destroy(surface);
    return done;
}

bool sp_measure_error(const sp_evaluator *evaluator, const sp_layout *layout, const sp_coverage *coverage,
                      sp_trajectory reference, uint64_t seed, sp_measured_error *measured, sp_error *error)
{
    if (!evaluator || !layout || !coverage)
        return false;
    if (reference == SP_TRAJECTORY_AUTO)
        reference = evaluator->setup.fidelity.trajectory;
    measuring m = {.coverage = coverage,
                   .seed = seed,
                   .precision = evaluator->movers ? ROUGH : PRECISION,
                   .most = evaluator->movers ? ROUGH_MOST : MOST};
    return measure_on(evaluator, layout, reference, &m, measured, error);
}

bool sp_measure_roughly(const sp_evaluator *evaluator, const sp_layout *layout, const sp_coverage *coverage,
                        sp_measured_error *measured, sp_error *error)
{
    const sp_fidelity *open = &evaluator->setup.fidelity;
    measuring m = {.coverage = coverage, .seed = open->seed, .precision = ROUGH, .most = ROUGH_MOST};
    return measure_on(evaluator, layout, open->trajectory, &m, measured, error);
}
