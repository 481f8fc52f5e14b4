/* Setups for the closed forms, and the comparison of both evaluators with them. */
#ifndef CLOSED_FORM_MEASURE_H
#define CLOSED_FORM_MEASURE_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <sprayplan/evaluator.h>

#include "shapes.h"

#ifdef SPRAYPLAN_SANITIZE
#define JETS 200000
#define COARSER 4.0        /* times the texel that the full-size test asks for */
#define INVERSE_BOUND 0.02 /* of the area */
#define FORWARD_BOUND 0.06
#else
#define JETS 4000000
#define COARSER 1.0
#define INVERSE_BOUND 0.005
#define FORWARD_BOUND 0.015
#endif

#define PARTS 12

/* A scene of one mesh, all of it clean, to be changed by the test before it is evaluated. */
typedef struct {
    sp_mesh *mesh;
    sp_surface surfaces[PARTS];
    sp_setup setup;
} scene;

static inline void scene_open(scene *s, sp_mesh *mesh, sp_trajectory trajectory, double texel)
{
    assert_non_null(mesh);
    assert_true(mesh->part_count <= PARTS);
    s->mesh = mesh;
    for (size_t i = 0; i < PARTS; i++)
        s->surfaces[i] = (sp_surface){.clean = true, .restitution = 0, .rebound = 1};
    s->setup = sp_setup_default();
    s->setup.mesh = mesh;
    s->setup.surfaces = s->surfaces;
    s->setup.fidelity.trajectory = trajectory;
    s->setup.fidelity.method = SP_METHOD_FORWARD;
    s->setup.fidelity.reflections = 0;
    s->setup.fidelity.jets = JETS;
    s->setup.fidelity.texel = texel * COARSER;
}

static inline void scene_close(scene *s)
{
    sp_mesh_destroy(s->mesh);
    s->mesh = NULL;
}

static inline void assert_no_error(const sp_error *error)
{
    if (error->kind != SP_OK)
        fail_msg("%s", error->message);
}

static inline sp_evaluator *scene_evaluator(const scene *s)
{
    sp_error error = {0};
    sp_evaluator *evaluator = sp_evaluator_create(&s->setup, &error);
    assert_no_error(&error);
    assert_non_null(evaluator);
    return evaluator;
}

static inline sp_coverage *scene_cover(const sp_evaluator *evaluator, const sp_nozzle *nozzles, size_t count,
                                       bool inverse)
{
    sp_error error = {0};
    sp_layout *layout = sp_layout_create(nozzles, count, &error);
    sp_coverage *coverage =
        inverse ? sp_evaluate_inverse(evaluator, layout, &error) : sp_evaluate(evaluator, layout, &error);
    assert_no_error(&error);
    assert_non_null(coverage);
    sp_layout_destroy(layout);
    return coverage;
}

static inline void compare_with(const char *what, const char *evaluator, double found, double expected, double bound)
{
    double error = found / expected - 1;
    print_message("%-34s %-8s %12.6g expected %12.6g, error %+7.3f %%\n", what, evaluator, found, expected,
                  100 * error);
    if (!(fabs(error) <= bound))
        fail_msg("%s, %s: error %.3f %%, allowed %.3f %%", what, evaluator, 100 * error, 100 * bound);
}

enum { BY_INVERSE = 1, BY_FORWARD = 2, BY_BOTH = 3 };

/* The area that the nozzles cover must be `area` (m²). */
static inline void assert_covers(const char *what, const scene *s, const sp_nozzle *nozzles, size_t count, double area,
                                 int methods)
{
    sp_evaluator *evaluator = scene_evaluator(s);
    for (int method = BY_INVERSE; method <= BY_FORWARD; method *= 2) {
        if (!(methods & method))
            continue;
        bool inverse = method == BY_INVERSE;
        sp_coverage *coverage = scene_cover(evaluator, nozzles, count, inverse);
        compare_with(what, inverse ? "inverse" : "forward", coverage->covered_area, area,
                     inverse ? INVERSE_BOUND : FORWARD_BOUND);
        sp_coverage_destroy(coverage);
    }
    sp_evaluator_destroy(evaluator);
}

static inline double deg(double degrees)
{
    return degrees * M_PI / 180;
}

/* A type of 12 L/min at 2 bar; `degrees` is the full angle. */
static inline sp_nozzle_type spray_type(sp_pattern pattern, double degrees)
{
    return (sp_nozzle_type){.name = "t",
                            .pattern = pattern,
                            .angle = deg(degrees),
                            .hollow = 0.7,
                            .thickness = deg(20),
                            .flow = 2e-4,
                            .at = 2e5,
                            .exponent = 0.5,
                            .cv = 0.95,
                            .drop = 1e-3};
}

/* At 2 bar unless the test sets the speed. */
static inline sp_nozzle nozzle_at(const sp_nozzle_type *type, sp_vec3 position, sp_vec3 axis, double speed)
{
    return (sp_nozzle){.name = "n",
                       .type = type,
                       .position = position,
                       .axis = sp_unit(axis),
                       .roll = 0.3, /* no edge of a spray runs along a row of texels */
                       .pressure = 2e5,
                       .speed = speed};
}

#endif
