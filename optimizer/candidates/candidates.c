#include "candidates/candidates.h"

#include "candidates/launches.h"

#include <assert.h>
#include <stdlib.h>

/* Axes lie at most about a third of the pattern's half-angle apart, and closer, down to a twelfth, while there are
 * fewer poses than POSES_ENOUGH: finer ones look alike to the search, and refinement moves them anyway. */
#define AXIS_SHARE (1.0 / 3)
#define AXIS_STEP_LEAST (8 * M_PI / 180)
#define AXIS_STEP_MOST (20 * M_PI / 180)
#define FINENESS_LEAST 0.25
#define FINENESS_STEP 0.95
#define POSES_ENOUGH 1.1e6
#define COARSENESS_MOST 4.0
#define TRACED_ENOUGH 40000.0 /* patterns, each of which takes about as long as a view */
#define FLAT_ROLLS 8
#define BODY_ROLLS 4 /* of what no pattern kernel sums, each of which has to be traced */
#define ANGLES 3

static size_t rolls_of(const sp_nozzle_type *type)
{
    if (sp_type_roll_period(type) == 0)
        return 1;
    return sp_type_is_uniform(type) ? FLAT_ROLLS : BODY_ROLLS;
}

static bool is_same(const sp_launch *a, const sp_launch *b)
{
    return a->speed == b->speed && a->fronts == b->fronts && a->trajectory == b->trajectory;
}

/* False, with an error, where it sprays nothing. */
static bool variant_create(const sp_setup *setup, const sp_nozzle_type *type, double pressure, double angle,
                           sp_candidates *candidates, sp_error *error)
{
    sp_nozzle nozzle = {.type = type, .pressure = pressure};
    sp_launch launch;
    sp_variant variant = {.type = type, .pressure = pressure, .angle = angle, .spray = sp_spray_create(type, angle)};
    variant.flow = sp_nozzle_flow(&nozzle, &setup->liquid);
    variant.reach = sp_type_reach(type, angle);
    variant.roll_count = rolls_of(type);
    if (!(variant.flow > 0) || !(sp_nozzle_speed(&nozzle, &setup->liquid) > 0))
        return sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0, "place: type %s at %g Pa sprays nothing", type->name,
                       pressure);
    if (!sp_launch_table_find(candidates->table, &nozzle, &launch, error))
        return false;
    while (variant.launch < candidates->launch_count && !is_same(&candidates->launches[variant.launch], &launch))
        variant.launch++;
    if (variant.launch == candidates->launch_count)
        candidates->launches[candidates->launch_count++] = launch;
    candidates->variants[candidates->variant_count++] = variant;
    return true;
}

/* An adjustable type at its own angle and at the ends of what refinement may set: the search must see that it helps. */
static bool type_variants(const sp_setup *setup, const sp_place_options *options, const sp_nozzle_type *type,
                          double pressure, sp_candidates *candidates, sp_error *error)
{
    double low, high;
    sp_angle_range(options, type, &low, &high);
    return variant_create(setup, type, pressure, type->angle, candidates, error) &&
           (low >= type->angle || variant_create(setup, type, pressure, low, candidates, error)) &&
           (high <= type->angle || variant_create(setup, type, pressure, high, candidates, error));
}

static bool variants_create(const sp_setup *setup, const sp_place_options *options, sp_candidates *candidates,
                            sp_error *error)
{
    if (!options->type_count || !options->pressure_count)
        return sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0, "place: no %s to choose from",
                       options->type_count ? "pressure" : "type");
    if (options->pressure_count > SIZE_MAX / ANGLES / sizeof(sp_variant) / options->type_count)
        return sp_fail_memory(error);
    size_t most = options->type_count * options->pressure_count * ANGLES;
    candidates->variants = calloc(most, sizeof *candidates->variants);
    candidates->launches = calloc(most, sizeof *candidates->launches);
    if (!candidates->variants || !candidates->launches)
        return sp_fail_memory(error);
    for (size_t t = 0; t < options->type_count; t++)
        for (size_t p = 0; p < options->pressure_count; p++)
            if (!type_variants(setup, options, options->types[t],
                               sp_fed_pressure(options->types[t], options->pressures[p]), candidates, error))
                return false;
    return true;
}

/* Rings about +z, the outermost at the tilt itself, each ring's axes no further apart than the rings; where tilts are
 * set in steps, at settings alone. With `axes` NULL it only counts. */
static size_t rings(double tilt, double step, sp_step setting, sp_vec3 *axes)
{
    bool settings = setting.count > 0;
    double size = sp_step_size(setting), apart = settings ? size * fmax(1, floor(step / size)) : step;
    size_t ring_count = tilt > 0 ? (size_t)ceil(tilt / step * (1 - 1e-9)) : 0, count = 0;
    if (settings)
        ring_count = (size_t)floor(tilt / apart * (1 + 1e-9));
    for (size_t ring = 0; ring <= ring_count; ring++) {
        double polar = ring_count ? tilt * (double)ring / (double)ring_count : 0;
        if (settings)
            polar = sp_step_nearest(setting, 0, apart * (double)ring, 0, tilt);
        size_t around = (size_t)fmax(1, ceil(2 * M_PI * sin(polar) / step * (1 - 1e-9)));
        for (size_t i = 0; i < around; i++, count++) {
            /* every other ring is turned by half a step */
            double azimuth = 2 * M_PI * ((double)i + 0.5 * (double)(ring % 2)) / (double)around;
            if (axes)
                axes[count] = sp_v(sin(polar) * cos(azimuth), sin(polar) * sin(azimuth), cos(polar));
        }
    }
    return count;
}

/* How close axes lie: of poses of uniform types, and of those that have to be traced one by one. */
typedef struct {
    double uniform, traced; /* times the usual step */
} spacing;

static double axis_step(const sp_variant *variant, const spacing *spacing)
{
    return (sp_type_is_uniform(variant->type) ? spacing->uniform : spacing->traced) *
           fmin(AXIS_STEP_MOST, fmax(AXIS_STEP_LEAST, AXIS_SHARE * variant->reach));
}

static double axis_tilt(const sp_variant *variant, const sp_mount *mount)
{
    /* what sprays all round is the same whatever its axis */
    return sp_spray_is_isotropic(&variant->spray) ? 0 : fmin(M_PI, mount->tilt);
}

/* Of all, and the patterns of those that are traced. */
typedef struct {
    double poses, traced;
} census;

static census take_census(const sp_place_options *options, const sp_sites *sites, const sp_candidates *candidates,
                          const spacing *spacing)
{
    census all = {0, 0}, per_site = {0, 0};
    uint32_t counted = SP_NONE; /* the mount that per_site is of: sites come mount by mount */
    for (size_t i = 0; i < sites->count; i++, all.poses += per_site.poses, all.traced += per_site.traced) {
        const sp_mount *mount = &options->mounts[sites->items[i].mount];
        if (sites->items[i].mount == counted)
            continue;
        counted = sites->items[i].mount;
        per_site = (census){0, 0};
        for (size_t k = 0; k < candidates->variant_count; k++) {
            const sp_variant *variant = &candidates->variants[k];
            if (!sp_mount_takes(mount, variant->type))
                continue;
            double poses =
                (double)variant->roll_count *
                (double)rings(axis_tilt(variant, mount), axis_step(variant, spacing), mount->tilt_step, NULL);
            per_site.poses += poses;
            if (!sp_type_is_uniform(variant->type))
                per_site.traced += poses * (double)sp_nozzle_pattern_count(&(sp_nozzle){.type = variant->type});
        }
    }
    return all;
}

/* Few poses lie closer; many that have to be traced farther apart, until a mounting point has few of them. */
static spacing spacing_for(const sp_place_options *options, const sp_sites *sites, const sp_candidates *candidates)
{
    spacing spacing = {1, 1};
    while (spacing.traced < COARSENESS_MOST && take_census(options, sites, candidates, &spacing).traced > TRACED_ENOUGH)
        spacing.traced /= FINENESS_STEP;
    while (spacing.uniform > FINENESS_LEAST && take_census(options, sites, candidates, &spacing).poses < POSES_ENOUGH)
        spacing.uniform *= FINENESS_STEP;
    return spacing;
}

static bool axes_create(const sp_place_options *options, const sp_sites *sites, sp_candidates *candidates,
                        sp_error *error)
{
    spacing spacing = spacing_for(options, sites, candidates);
    candidates->mount_count = options->mount_count;
    candidates->axes = calloc(options->mount_count * candidates->variant_count, sizeof *candidates->axes);
    if (!candidates->axes)
        return sp_fail_memory(error);
    for (size_t m = 0; m < options->mount_count; m++)
        for (size_t k = 0; k < candidates->variant_count; k++) {
            const sp_variant *variant = &candidates->variants[k];
            if (!sp_mount_takes(&options->mounts[m], variant->type))
                continue;
            double step = axis_step(variant, &spacing), tilt = axis_tilt(variant, &options->mounts[m]);
            sp_axes *axes = &candidates->axes[m * candidates->variant_count + k];
            sp_step setting = options->mounts[m].tilt_step;
            assert(step > 0);
            axes->axes = malloc(rings(tilt, step, setting, NULL) * sizeof *axes->axes);
            if (!axes->axes)
                return sp_fail_memory(error);
            axes->count = rings(tilt, step, setting, axes->axes);
        }
    return true;
}

bool sp_candidates_create(const sp_evaluator *evaluator, const sp_place_options *options, const sp_sites *sites,
                          sp_candidates *candidates, sp_error *error)
{
    const sp_setup *setup = sp_evaluator_setup(evaluator);
    *candidates = (sp_candidates){.table = sp_launches_create(evaluator, options, sites, error)};
    if (!candidates->table || !variants_create(setup, options, candidates, error) ||
        !axes_create(options, sites, candidates, error)) {
        sp_candidates_free(candidates);
        return false;
    }
    candidates->pose_start = calloc(sites->count + 1, sizeof *candidates->pose_start);
    if (!candidates->pose_start) {
        sp_candidates_free(candidates);
        return sp_fail_memory(error);
    }
    for (size_t i = 0; i < sites->count; i++) {
        size_t count = 0;
        for (size_t k = 0; k < candidates->variant_count; k++)
            count +=
                sp_candidates_axes(candidates, sites->items[i].mount, k)->count * candidates->variants[k].roll_count;
        candidates->pose_start[i + 1] = candidates->pose_start[i] + count;
    }
    return true;
}

void sp_candidates_free(sp_candidates *candidates)
{
    for (size_t i = 0; candidates->axes && i < candidates->mount_count * candidates->variant_count; i++)
        free(candidates->axes[i].axes);
    free(candidates->axes);
    free(candidates->variants);
    free(candidates->launches);
    sp_launch_table_destroy(candidates->table);
    free(candidates->pose_start);
    *candidates = (sp_candidates){0};
}

size_t sp_candidates_number(const sp_candidates *candidates, const sp_sites *sites, sp_pose pose)
{
    size_t number = candidates->pose_start[pose.site];
    uint32_t mount = sites->items[pose.site].mount;
    for (uint32_t k = 0; k < pose.variant; k++)
        number += sp_candidates_axes(candidates, mount, k)->count * candidates->variants[k].roll_count;
    return number + pose.axis * candidates->variants[pose.variant].roll_count + pose.roll;
}

sp_vec3 sp_frame_axis(const sp_frame *frame, sp_vec3 axis)
{
    return sp_unit(sp_add(sp_add(sp_scale(frame->x, axis.x), sp_scale(frame->y, axis.y)), sp_scale(frame->z, axis.z)));
}

double sp_variant_roll(const sp_variant *variant, size_t i)
{
    return sp_type_roll_period(variant->type) * (double)i / (double)variant->roll_count;
}

sp_nozzle sp_pose_nozzle(const sp_candidates *candidates, const sp_sites *sites, sp_pose pose, sp_vec3 up)
{
    const sp_site *site = &sites->items[pose.site];
    const sp_variant *variant = &candidates->variants[pose.variant];
    const sp_axes *axes = sp_candidates_axes(candidates, site->mount, pose.variant);
    sp_frame frame = sp_nozzle_frame(site->axis, 0, up);
    return (sp_nozzle){.type = variant->type,
                       .position = site->position,
                       .axis = sp_frame_axis(&frame, axes->axes[pose.axis]),
                       .roll = sp_variant_roll(variant, pose.roll),
                       .pressure = variant->pressure,
                       .angle = variant->angle == variant->type->angle ? 0 : variant->angle};
}
