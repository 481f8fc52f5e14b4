/* Nozzles in a closed room, and what holds of any of them there: the bound on flying along lines, and the same bytes
 * for any number of threads. */
#ifndef TESTS_ROOM_OF_NOZZLES_H
#define TESTS_ROOM_OF_NOZZLES_H

#include "measure.h"

#include <sprayplan/deviation.h>

#include <string.h>

static const sp_vec3 place = {0.21, -0.13, 0.3}, body = {0.2, 0.1, -1};

static inline void open_room(scene *s, double texel)
{
    scene_open(s, mesh_of_room(), SP_TRAJECTORY_PARABOLA, texel);
    s->setup.criterion.flux = 1.0 / 60 / 1000;
}

/* What a nozzle covers where so much flux (m/s) is asked for; bound and decided as sp_bound_lines, or NULL. */
static inline sp_coverage *cover_room(const sp_nozzle *nozzle, sp_trajectory trajectory, double flux, double *bound,
                                      bool *decided)
{
    sp_error error = {0};
    scene s;
    open_room(&s, 0.05);
    s.setup.criterion.flux = flux;
    s.setup.fidelity.trajectory = trajectory;
    sp_evaluator *evaluator = scene_evaluator(&s);
    sp_layout *layout = sp_layout_create(nozzle, 1, &error);
    assert_true(!decided || sp_bound_lines(evaluator, layout, bound, decided, &error));
    sp_coverage *coverage = scene_cover(evaluator, nozzle, 1, true);
    sp_layout_destroy(layout);
    sp_evaluator_destroy(evaluator);
    scene_close(&s);
    return coverage;
}

/* Where it is proved that lines and parabolas say the same, they do. Returns the bound. */
static inline double assert_bound_on_lines(const char *what, size_t which, const sp_nozzle *nozzle, double flux)
{
    bool *decided = calloc(1 << 16, sizeof *decided);
    double bound = 1;
    assert_non_null(decided);
    sp_coverage *falling = cover_room(nozzle, SP_TRAJECTORY_PARABOLA, flux, NULL, NULL),
                *straight = cover_room(nozzle, SP_TRAJECTORY_LINE, flux, &bound, decided);
    assert_true(falling->deposits.count == straight->deposits.count && falling->deposits.count < 1 << 16);
    for (size_t i = 0; i < straight->deposits.count; i++)
        if (decided[i] && straight->deposits.share[i] != falling->deposits.share[i])
            fail_msg("%s %zu: patch %zu is decided, and %g by lines, %g by parabolas", what, which, i,
                     straight->deposits.share[i], falling->deposits.share[i]);
    print_message("%s %zu, flux %g: lines change %.2f points, proved: no more than %.1f\n", what, which, flux,
                  100 * fabs(straight->fraction - falling->fraction), 100 * bound);
    assert_true(fabs(straight->fraction - falling->fraction) <= bound);
    free(decided);
    sp_coverage_destroy(falling);
    sp_coverage_destroy(straight);
    return bound;
}

/* The same bytes of every field by either evaluator, whatever the number of threads. */
static inline void assert_threads_change_nothing(const sp_nozzle *nozzles, size_t count)
{
    for (int inverse = 0; inverse < 2; inverse++) {
        sp_coverage *first = NULL;
        for (int threads = 1; threads <= 3; threads++) {
            scene s;
            open_room(&s, 0.1);
            s.setup.run.threads = threads;
            s.setup.fidelity.jets = 20000;
            sp_evaluator *evaluator = scene_evaluator(&s);
            sp_coverage *coverage = scene_cover(evaluator, nozzles, count, inverse);
            size_t size = coverage->deposits.count * sizeof *coverage->deposits.flux;
            assert_true(!first || (!memcmp(first->deposits.flux, coverage->deposits.flux, size) &&
                                   !memcmp(first->deposits.share, coverage->deposits.share, size)));
            if (first)
                sp_coverage_destroy(coverage);
            first = first ? first : coverage;
            sp_evaluator_destroy(evaluator);
            scene_close(&s);
        }
        sp_coverage_destroy(first);
    }
}

#endif
