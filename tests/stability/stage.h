/* A room with a sheet and a ball in it, sprayed by a cone and a fan, that can be set up at any size, place and attitude
 * with physics that go with it; and what must hold of every result. */
#ifndef STABILITY_STAGE_H
#define STABILITY_STAGE_H

#include "../closed-form/measure.h"

#ifdef SPRAYPLAN_SANITIZE
#define STAGE_TEXEL 0.08
#define STAGE_JETS 20000
#else
#define STAGE_TEXEL 0.0237
#define STAGE_JETS 150000
#endif

typedef struct {
    scene s;
    sp_nozzle_type types[2];
    sp_nozzle nozzles[2];
} stage;

/* A box with 12 × 12 squares a wall, a sheet in its middle and a ball at one end. */
static inline sp_mesh *furnished_room(const sp_transform *pose)
{
    rectangle faces[7];
    box_rectangles(sp_v(-1, -0.8, 0), sp_v(2, 1.6, 1.5), faces);
    faces[6] = (rectangle){sp_v(-0.1, -0.5, 0.2), sp_v(0.1, 0.7, 0), sp_v(0.05, 0, 0.7)};
    sp_mesh *pieces[2] = {mesh_of_rectangles(faces, 7), mesh_of_sphere(0.25, 3)};
    sp_transform places[2] = {sp_transform_default(), sp_transform_default()};
    places[1].translate = sp_v(0.55, 0.3, 0.5);
    sp_mesh *room = sp_mesh_join((const sp_mesh *const *)pieces, places, 2, NULL);
    sp_mesh *moved = sp_mesh_join((const sp_mesh *const *)&room, pose, 1, NULL);
    assert_non_null(moved);
    sp_mesh_destroy(pieces[0]);
    sp_mesh_destroy(pieces[1]);
    sp_mesh_destroy(room);
    return moved;
}

/* Moves a nozzle; its frame turns with it, which takes a roll of its own where the pose tilts the vertical. */
static inline void pose_nozzle(const sp_transform *pose, sp_vec3 up, sp_nozzle *nozzle)
{
    sp_transform turn = *pose;
    turn.scale = 1;
    turn.translate = sp_v(0, 0, 0);
    sp_frame before = sp_nozzle_frame(nozzle->axis, nozzle->roll, sp_v(0, 0, 1));
    nozzle->position = sp_transform_point(pose, nozzle->position);
    nozzle->axis = sp_unit(sp_transform_point(&turn, nozzle->axis));
    sp_vec3 x = sp_transform_point(&turn, before.x);
    sp_frame unrolled = sp_nozzle_frame(nozzle->axis, 0, up);
    nozzle->roll = atan2(sp_dot(x, unrolled.y), sp_dot(x, unrolled.x));
    nozzle->flow *= pose->scale * pose->scale;
    nozzle->speed *= pose->scale;
}

/* Lengths, speeds and gravity grow by the pose's scale, flows by its square: times and fluxes stay. `up` is where the
 * pose turns (0, 0, 1) to, if that is a vertical that a setup can have; for lines it does not matter. */
static inline void stage_open(stage *st, sp_trajectory trajectory, const sp_transform *pose, sp_vec3 up)
{
    scene_open(&st->s, furnished_room(pose), trajectory, 1);
    sp_setup *setup = &st->s.setup;
    setup->fidelity.texel = STAGE_TEXEL * pose->scale;
    setup->fidelity.jets = STAGE_JETS;
    setup->cavity = SP_CAVITY_POINT;
    setup->cavity_point = sp_transform_point(pose, sp_v(0.6, -0.4, 1.2));
    setup->up = up;
    setup->gravity = 9.81 * pose->scale;
    setup->criterion = (sp_criterion){8.3e-6, 3 * pose->scale, deg(80), SP_COMBINE_SUM, 0};
    st->types[0] = spray_type(SP_PATTERN_FULL_CONE, 100);
    st->types[1] = spray_type(SP_PATTERN_FLAT_FAN, 90);
    st->nozzles[0] = nozzle_at(&st->types[0], sp_v(-0.61, 0.17, 1.23), sp_v(0.7, -0.2, -0.6), 9);
    st->nozzles[1] = nozzle_at(&st->types[1], sp_v(0.13, -0.47, 1.11), sp_v(0.1, 0.9, -0.5), 12);
    for (int i = 0; i < 2; i++) {
        st->nozzles[i].flow = 1e-4;
        pose_nozzle(pose, up, &st->nozzles[i]);
    }
}

static inline void stage_close(stage *st)
{
    scene_close(&st->s);
}

static inline void assert_sound_column(const char *name, const double *column, size_t count, double least, double most)
{
    for (size_t i = 0; i < count; i++)
        if (!(column[i] >= least && column[i] <= most))
            fail_msg("%s of patch %zu is %g, must be within %g and %g", name, i, column[i], least, most);
}

/* No number that is not one, and none that contradicts another. */
static inline void assert_sound(const sp_evaluator *evaluator, const sp_coverage *coverage)
{
    const sp_deposits *d = &coverage->deposits;
    size_t n = d->count;
    assert_true(n > 0 && n == sp_evaluator_patches(evaluator)->count);
    assert_sound_column("flux", d->flux, n, 0, 1e300);
    assert_sound_column("jets", d->jets, n, 0, 1e300);
    assert_sound_column("speed", d->speed, n, 0, 1e300);
    assert_sound_column("largest speed", d->speed_max, n, 0, 1e300);
    assert_sound_column("incidence", d->incidence, n, 0, M_PI / 2 + 1e-12);
    assert_sound_column("least incidence", d->incidence_min, n, 0, M_PI / 2);
    assert_sound_column("impact", d->impact, n, 0, 1e300);
    assert_sound_column("largest impact", d->impact_max, n, 0, 1e300);
    for (size_t i = 0; i < n; i++) {
        assert_true(d->counted[i] >= 0 && d->counted[i] <= d->flux[i] * (1 + 1e-12));
        assert_true(d->speed[i] <= d->speed_max[i] * (1 + 1e-12));
        assert_true(d->incidence_min[i] <= d->incidence[i] * (1 + 1e-12));
        assert_true((d->flux[i] > 0) == (d->jets[i] > 0));
    }
    assert_true(coverage->area > 0 && isfinite(coverage->area));
    assert_true(coverage->fraction >= 0 && coverage->fraction <= 1 + 1e-12);
    assert_true(isfinite(coverage->flow) && isfinite(coverage->area_per_water));
    assert_true(coverage->flux_min <= coverage->flux_p05 && coverage->flux_p05 <= coverage->flux_max);
    assert_true(coverage->flux_min <= coverage->flux_mean * (1 + 1e-12) &&
                coverage->flux_mean <= coverage->flux_max * (1 + 1e-12));
}

/* What arrives, of what is sprayed. */
static inline double share_landed(const sp_coverage *coverage)
{
    return coverage->flux_mean * coverage->area / coverage->flow;
}

static inline sp_coverage *sound_cover(const sp_evaluator *evaluator, const sp_nozzle *nozzles, size_t count,
                                       bool inverse)
{
    sp_coverage *coverage = scene_cover(evaluator, nozzles, count, inverse);
    assert_sound(evaluator, coverage);
    return coverage;
}

/* What two results of one scene are compared by. */
typedef struct {
    double area, fraction, landed, speed, incidence; /* m², 1, 1, m/s and rad (means by liquid) */
} summary;

static inline summary summarise(const sp_evaluator *evaluator, const sp_nozzle *nozzles, size_t count, bool inverse)
{
    sp_coverage *coverage = sound_cover(evaluator, nozzles, count, inverse);
    const sp_deposits *d = &coverage->deposits;
    const double *area = sp_evaluator_patches(evaluator)->area;
    summary sum = {coverage->area, coverage->fraction, share_landed(coverage), 0, 0};
    double liquid = 0;
    for (size_t i = 0; i < d->count; i++) {
        liquid += d->flux[i] * area[i];
        sum.speed += d->flux[i] * area[i] * d->speed[i];
        sum.incidence += d->flux[i] * area[i] * d->incidence[i];
    }
    assert_true(liquid > 0);
    sum.speed /= liquid;
    sum.incidence /= liquid;
    sp_coverage_destroy(coverage);
    return sum;
}

#endif
