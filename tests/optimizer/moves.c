/* Where refinement may move nozzles to: within the mount, clear of walls, and no farther than was allowed. */
#include "small_room.h"

#include "candidates/mounts.h"

#ifdef SPRAYPLAN_SANITIZE
#define MOVES_TEXEL 0.2
#else
#define MOVES_TEXEL 0.1
#endif
#define STANDOFF 0.05
#define ROUNDING 1e-9 /* m */

/* One narrow cone, aimed anyhow, with liquid enough that it covers all that it sees: most from as far away as it can
 * be, at a wall. */
static void open_job(job *j, sp_mount mount, double clearance)
{
    job_open_coarse(j, MOVES_TEXEL);
    j->mounts[0] = mount;
    j->mounts[0].tilt = 90 * DEGREE;
    j->types[1].flow = j->types[1].flow_min = j->types[1].flow_max = 60 * LITRES_PER_MINUTE;
    j->options.type_count = 1;
    j->type_list[0] = &j->types[1];
    j->options.clearance = clearance;
    j->options.max_nozzles = 1;
    j->options.objective = SP_OBJECTIVE_MAX_COVERAGE;
    j->options.refine = sp_place_options_default().refine;
}

/* m to the nearest mounting point. */
static double moved(const job *j, const sp_nozzle *nozzle)
{
    sp_error error = {0};
    sp_sites sites;
    assert_true(sp_sites_create(j->room.evaluator, &j->options, &sites, &error));
    double least = INFINITY;
    for (size_t i = 0; i < sites.count; i++)
        least = fmin(least, sp_distance(sites.items[i].position, nozzle->position));
    sp_sites_free(&sites);
    return least;
}

/* m to the nearest of the room's walls, its floor and, unless the nozzle is mounted there, its lid. */
static double standing_clear(const sp_nozzle *nozzle, bool in_lid)
{
    sp_vec3 p = nozzle->position;
    double aside = fmin(1 - fabs(p.x), 0.7 - fabs(p.y));
    return fmin(fmin(aside, p.z), in_lid ? INFINITY : 1.2 - p.z);
}

/* Places, expecting every nozzle to stand clear, no farther than `most` from a mounting point, and one to have moved.
 */
static sp_proposal *place_moved(job *j, double most)
{
    sp_proposal *proposal = job_place(j);
    double farthest = 0;
    sp_error error = {0};
    assert_int_equal(proposal->layout->count, 1);
    for (size_t i = 0; i < proposal->layout->count; i++) {
        const sp_nozzle *nozzle = &proposal->layout->nozzles[i];
        double clear = standing_clear(nozzle, j->mounts[0].kind == SP_MOUNT_SURFACE), way = moved(j, nozzle);
        farthest = fmax(farthest, way);
        if (clear < j->options.clearance - ROUNDING)
            fail_msg("%s is %g m from a wall, expected at least %g m", nozzle->name, clear, j->options.clearance);
        if (!sp_evaluator_admits(j->room.evaluator, nozzle, &error))
            fail_msg("%s", error.message);
        if (way > most + ROUNDING)
            fail_msg("%s was moved by %g m, expected at most %g m", nozzle->name, way, most);
    }
    assert_true(farthest > 0.01);
    return proposal;
}

static void nozzles_moved_along_a_line_stay_clear(void **state)
{
    (void)state;
    job j;
    sp_mount mount = {.kind = SP_MOUNT_LINE,
                      .axis = sp_v(0, 0, -1),
                      .spacing = 0.4,
                      .from = sp_v(-1, 0.1, 0.6),
                      .to = sp_v(1, 0.1, 0.6)};
    open_job(&j, mount, 0.3);
    sp_proposal *proposal = place_moved(&j, 0.2);
    for (size_t i = 0; i < proposal->layout->count; i++)
        assert_true(proposal->layout->nozzles[i].position.y == 0.1 && proposal->layout->nozzles[i].position.z == 0.6);
    sp_proposal_destroy(proposal);
    room_close(&j.room);
}

/* Along a surface both ways at once come to more than either; to where the nearest mounting point may be, a whole
 * spacing. */
static void nozzles_moved_along_a_lid_stay_clear(void **state)
{
    (void)state;
    const double limits[] = {-1, 0.06, -1}, clearances[] = {0.15, 0.15, 0};
    for (size_t i = 0; i < sizeof limits / sizeof *limits; i++) {
        job j;
        sp_mount mount = {.kind = SP_MOUNT_SURFACE, .part = 1, .spacing = 0.4, .standoff = STANDOFF};
        open_job(&j, mount, clearances[i]);
        j.options.refine.position = limits[i];
        sp_proposal *proposal = place_moved(&j, limits[i] < 0 ? 0.4 : limits[i]);
        for (size_t n = 0; n < proposal->layout->count; n++)
            assert_true(fabs(proposal->layout->nozzles[n].position.z - (1.2 - STANDOFF)) < ROUNDING);
        sp_proposal_destroy(proposal);
        room_close(&j.room);
    }
}

static void nozzles_moved_about_a_box_stay_clear(void **state)
{
    (void)state;
    job j;
    sp_mount mount = {.kind = SP_MOUNT_BOX,
                      .axis = sp_v(0, 0, -1),
                      .spacing = 0.5,
                      .from = sp_v(-1, -0.7, 0),
                      .to = sp_v(1, 0.7, 1.2)};
    open_job(&j, mount, 0.2);
    sp_proposal_destroy(place_moved(&j, 0.25 * sqrt(3)));
    room_close(&j.room);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nozzles_moved_along_a_line_stay_clear),
        cmocka_unit_test(nozzles_moved_along_a_lid_stay_clear),
        cmocka_unit_test(nozzles_moved_about_a_box_stay_clear),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
