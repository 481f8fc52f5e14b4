/* Proposals and their certificates counted again by the public evaluator alone: what they say is covered is, and no
 * layout that an independent search finds breaks a bound. An argument gives the seconds that each scene is searched
 * for, half of them with refinement, a second one a part of the names of the scenes to run; then texels are finer and a
 * table is printed. */
#include "recount_search.h"

#include <stdio.h>

#ifdef SPRAYPLAN_SANITIZE
#define SANITIZED true
#else
#define SANITIZED false
#endif
#define HALL_TEXEL 0.9
#define CHAMBER_TEXEL 0.3
#define SECONDS 0.3
#define HALL_TEXEL_FULL 0.14 /* where seconds are given */
#define CHAMBER_TEXEL_FULL 0.04
#define PLACING_FULL 30 /* s for a proposal and its bounds */

static double seconds;
static const char *wanted; /* NULL: a quick look */

#define ROUNDING 5e-6 /* of an area: candidates' directions are kept in single precision */

static void check_counts(const recount_scene *scene, const sp_proposal *proposal)
{
    sp_error error = {0};
    const sp_certificate *c = &proposal->certificate;
    const sp_patches *patches = sp_evaluator_patches(scene->room.evaluator);
    assert_int_equal(c->texels, patches->count);
    assert_true(fabs(c->whole - patches->total_area) <= 1e-12 * patches->total_area);
    sp_coverage *coverage = sp_evaluate_inverse(scene->room.evaluator, proposal->layout, &error);
    assert_non_null(coverage);
    if (fabs(c->counted - coverage->covered_area) > ROUNDING * coverage->covered_area)
        fail_msg("counted %.9g m2, evaluated %.9g", c->counted, coverage->covered_area);
    sp_coverage_destroy(coverage);
    for (size_t i = 0; i < proposal->front_count; i++) {
        const sp_front_point *point = &proposal->front[i];
        if (fabs(point->counted - point->area) > ROUNDING * point->area)
            fail_msg("front: counted %.9g m2, evaluated %.9g", point->counted, point->area);
    }
}

static void print_row(const recount_case *which, bool refined, const recount *r)
{
    const sp_proposal *p = r->proposal;
    const sp_certificate *c = &p->certificate;
    double whole = c->whole, water = LITRES_PER_MINUTE;
    printf("| %s%s | %zu | %zu | %.2f | %.3f | %.3f | %.3f | %.3f | %.1e | %.2f | %.2f | ", which->name,
           refined ? ", refined" : "", c->texels, r->poses, p->coverage->flow / water, 100 * c->counted / whole,
           100 * r->best[RECOUNT_RANDOM] / whole, 100 * r->best[RECOUNT_ANNEALED] / whole, 100 * c->area_bound / whole,
           r->margin, r->least_water / water, c->water_bound / water);
    if (c->every_aim.computed)
        printf("%.3f | %.3f | %.1e", 100 * r->best[RECOUNT_AIMED] / whole, 100 * c->every_aim.area_bound / whole,
               r->aim_margin);
    else
        printf("| |");
    printf(" | %zu | %zu |\n", r->tried, r->evaluated);
    fflush(stdout);
}

static void search_layouts(const recount_case *which, bool refined, const recount_scene *scene,
                           const sp_proposal *proposal)
{
    recount r;
    recount_open(&r, scene, proposal);
    recount_search(&r, wanted ? seconds / 2 : seconds);
    if (wanted)
        print_row(which, refined, &r);
    recount_close(&r);
}

static void check_case(const recount_case *which, bool refined)
{
    recount_scene scene;
    sp_error error = {0};
    double texel = which->hall ? HALL_TEXEL : CHAMBER_TEXEL;
    if (wanted)
        texel = which->hall ? HALL_TEXEL_FULL : CHAMBER_TEXEL_FULL;
    which->open(&scene, texel);
    if (wanted)
        scene.options.run.time_limit = PLACING_FULL;
    if (refined)
        scene.options.refine = sp_place_options_default().refine;
    sp_proposal *proposal = sp_place(scene.room.evaluator, &scene.options, &error);
    assert_string_equal(error.message, "");
    room_check(proposal, &scene.options);
    assert_true(proposal->certificate.computed);
    check_counts(&scene, proposal);
    search_layouts(which, refined, &scene, proposal);
    sp_proposal_destroy(proposal);
    scene_close(&scene);
}

static void nothing_found_breaks_a_bound(void **state)
{
    const recount_case *which = *state;
    if (wanted || !which->refined)
        check_case(which, false);
    if (wanted || which->refined)
        check_case(which, true);
}

int main(int argc, char **argv)
{
    struct CMUnitTest tests[RECOUNT_CASES];
    size_t count = 0;
    seconds = argc > 1 ? atof(argv[1]) : SECONDS;
    wanted = argc > 2 ? argv[2] : argc > 1 ? "" : NULL;
    for (size_t i = 0; i < RECOUNT_CASES; i++)
        if (wanted ? strstr(recount_cases[i].name, wanted) != NULL : recount_cases[i].sanitized == SANITIZED)
            tests[count++] = (struct CMUnitTest){.name = recount_cases[i].name,
                                                 .test_func = nothing_found_breaks_a_bound,
                                                 .initial_state = (void *)(uintptr_t)&recount_cases[i]};
    return _cmocka_run_group_tests("recount", tests, count, NULL, NULL);
}
