/* Integrates a narrow spray over patches: each fragment of a patch is halved in both directions until its cells are
 * small against the patch and, at the spray's edge, against the spray. */
#include "footprint.h"

#include <stdlib.h>

#define NARROW 2.0          /* texels: wider sprays are judged at the patch's point */
#define COARSE 0.125        /* texels: the largest cell, for what changes smoothly and for shadows */
#define FINE 0.125          /* of the spray's width: the largest cell at its edge */
#define FINEST (1.0 / 256)  /* texels: no cell is halved below it, whatever the width; but for spots: */
#define FINEST_SPOT 0x1p-20 /* texels */
#define BEND 1.5            /* how much more a parabola's direction may turn across a cell than at its middle */

static double least_opening(const sp_spray *spray)
{
    if (spray->kind == SP_PATTERN_FLAT_FAN)
        return 2 * fmin(spray->half_width, spray->half_thickness);
    return spray->inner > 0 ? spray->outer - spray->inner : 2 * spray->outer;
}

sp_emitter sp_emitter_of(const sp_evaluator *evaluator, const sp_nozzle *nozzle)
{
    const sp_setup *setup = &evaluator->setup;
    sp_emitter emitter = {.source = {evaluator, nozzle->position, sp_nozzle_speed(nozzle, &setup->liquid)},
                          .frame = sp_nozzle_frame(nozzle->axis, nozzle->roll, setup->up),
                          .spray = sp_spray_create(nozzle->type, sp_nozzle_angle(nozzle))};
    emitter.width = least_opening(&emitter.spray);
    emitter.is_spot = emitter.spray.kind != SP_PATTERN_FLAT_FAN && !(emitter.spray.inner > 0);
    return emitter;
}

sp_vec3 sp_emitter_local(const sp_emitter *emitter, sp_vec3 direction)
{
    const sp_frame *frame = &emitter->frame;
    return sp_v(sp_dot(direction, frame->x), sp_dot(direction, frame->y), sp_dot(direction, frame->z));
}

/* How far the end of a flight moves per angle at the nozzle, across the plane of the flight: v t, the distance of a
 * line. Where a point is beyond reach, as at the envelope next to it, where T = 2 r / g. */
static double lever(const sp_emitter *emitter, sp_vec3 point)
{
    const sp_source *source = &emitter->source;
    sp_vec3 gravity = source->evaluator->gravity;
    double distance = sp_distance(point, source->position), g = sp_length(gravity);
    if (g == 0)
        return distance;
    sp_flight flights[2];
    int count = sp_flights(source->position, point, source->speed, gravity, flights);
    return source->speed * (count > 0 ? flights[0].time : sqrt(2 * distance / g));
}

bool sp_emitter_is_narrow(const sp_emitter *emitter, uint32_t patch)
{
    const sp_evaluator *evaluator = emitter->source.evaluator;
    return emitter->width * lever(emitter, evaluator->patches.point[patch]) < NARROW * evaluator->fidelity.texel;
}

/* For a point beyond reach: whether liquid may reach what lies within `radius` of it. With h the drop along gravity and
 * w the way across it, the parabola of safety is v⁴ + 2 v² g h = g² w²; the jets that touch it halve the angle between
 * upwards and the point, and one that leaves at another angle a falls short of it as a² v t. */
static bool may_reach_near(const sp_emitter *emitter, sp_vec3 point, double radius)
{
    const sp_source *source = &emitter->source;
    sp_vec3 r = sp_sub(point, source->position), gravity = source->evaluator->gravity;
    double g = sp_length(gravity), v2 = source->speed * source->speed, distance = sp_length(r);
    if (g == 0 || distance < 2 * radius)
        return true;
    double drop = sp_dot(r, gravity) / g;
    double across = fmax(sp_length(sp_along(r, -drop / g, gravity)) - radius, 0);
    if (v2 * (v2 + 2 * g * (drop + radius)) < g * g * across * across)
        return false;
    sp_vec3 outermost = sp_unit(sp_along(sp_scale(r, 1 / distance), -1 / g, gravity));
    double margin = sp_spray_margin(&emitter->spray, sp_emitter_local(emitter, outermost));
    return margin > -BEND * sqrt(2 * radius / lever(emitter, point));
}

/* How the spray lies about one flight. */
typedef struct {
    double margin; /* rad, of the flight's direction inside the spray */
    double turn;   /* rad per m: how much the direction turns at most as the end moves */
} bearing;

static bearing take_bearing(const sp_emitter *emitter, const sp_flight *flight)
{
    /* across the plane of the flight by 1 / v t; the product of both turns is the arriving speed over the spread */
    double lever = emitter->source.speed * flight->time;
    double across = 1 / lever, along = sp_length(flight->velocity) / flight->spread * lever;
    return (bearing){sp_spray_margin(&emitter->spray, sp_emitter_local(emitter, flight->direction)),
                     BEND * fmax(across, along)};
}

static bool may_touch(const sp_emitter *emitter, uint32_t patch)
{
    if (!sp_emitter_is_narrow(emitter, patch))
        return false;
    const sp_source *source = &emitter->source;
    sp_vec3 point = source->evaluator->patches.point[patch];
    double radius = sqrt(2) * source->evaluator->fidelity.texel, distance = sp_distance(point, source->position);
    if (distance < 2 * radius)
        return true;
    sp_flight flights[2];
    int count = sp_flights(source->position, point, source->speed, source->evaluator->gravity, flights);
    if (count == 0)
        return may_reach_near(emitter, point, radius);
    for (int k = 0; k < count; k++) {
        bearing bearing = take_bearing(emitter, &flights[k]);
        if (bearing.margin > -radius * bearing.turn)
            return true;
    }
    return false;
}

/* One patch in the making. */
typedef struct {
    const sp_emitter *emitter;
    sp_target target; /* its point moves from cell to cell */
    int arc;
    sp_footprint sum; /* integrals over area, not yet means */
} patch_integral;

typedef struct {
    sp_vec3 corner[3];
} cell;

/* The share of a cell that a strip of the spray covers: the overlap of two intervals, the cell `breadth` wide about 0
 * and the strip from `margin` on one side to the rest of its width on the other. */
static double covered_share(double margin, double width, double breadth)
{
    double to_edge = fmin(1, fmax(0, 0.5 + margin / breadth));
    double to_far_edge = fmin(1, fmax(0, 0.5 + (width - margin) / breadth));
    return fmax(0, to_edge + to_far_edge - 1);
}

static void add_sample(patch_integral *integral, const sp_flight *flight, double share, double area)
{
    const sp_emitter *emitter = integral->emitter;
    sp_arrival arrival;
    if (!sp_arrive(&emitter->source, &integral->target, flight, &arrival) ||
        sp_flight_blocked(&emitter->source, &integral->target, flight))
        return;
    double gain = share * arrival.transfer * area / emitter->spray.solid_angle;
    sp_footprint *sum = &integral->sum;
    sum->gain += gain;
    sum->passing += arrival.passes ? gain : 0;
    sum->speed += gain * arrival.speed;
    sum->incidence += gain * arrival.incidence;
}

static void integrate_cell(patch_integral *integral, const cell *whole);

static void integrate_quarters(patch_integral *integral, const cell *whole)
{
    const sp_vec3 *c = whole->corner;
    sp_vec3 middle[3];
    for (int i = 0; i < 3; i++)
        middle[i] = sp_scale(sp_add(c[(i + 1) % 3], c[(i + 2) % 3]), 0.5);
    for (int i = 0; i < 3; i++) {
        cell quarter = {{c[i], middle[(i + 2) % 3], middle[(i + 1) % 3]}};
        integrate_cell(integral, &quarter);
    }
    cell quarter = {{middle[0], middle[1], middle[2]}};
    integrate_cell(integral, &quarter);
}

/* What share of a cell a strip covers is known without halving the cell; of a spot it is not. */
static double finest_cell(const sp_emitter *emitter, const sp_flight *flight)
{
    double texel = emitter->source.evaluator->fidelity.texel,
           spot = emitter->width * emitter->source.speed * flight->time;
    return emitter->is_spot ? fmin(FINEST * texel, fmax(FINEST_SPOT * texel, FINE * spot)) : FINEST * texel;
}

static void integrate_cell(patch_integral *integral, const cell *whole)
{
    const sp_emitter *emitter = integral->emitter;
    const sp_source *source = &emitter->source;
    const sp_vec3 *c = whole->corner;
    sp_vec3 middle = sp_scale(sp_add(c[0], sp_add(c[1], c[2])), 1.0 / 3);
    double radius = fmax(sp_distance(middle, c[0]), fmax(sp_distance(middle, c[1]), sp_distance(middle, c[2])));
    double texel = source->evaluator->fidelity.texel;
    sp_flight flights[2];
    int count = sp_flights(source->position, middle, source->speed, source->evaluator->gravity, flights);
    bool coarse = radius > COARSE * texel;
    if (integral->arc >= count) { /* beyond reach, though perhaps not everywhere */
        if (radius > FINEST * texel && may_reach_near(emitter, middle, radius))
            integrate_quarters(integral, whole);
        return;
    }
    const sp_flight *flight = &flights[integral->arc];
    bearing bearing = take_bearing(emitter, flight);
    double extent = radius * bearing.turn;
    if (bearing.margin < -extent)
        return;
    bool at_edge =
        fabs(bearing.margin) < extent && extent > FINE * emitter->width && radius > finest_cell(emitter, flight);
    if (coarse || at_edge) {
        integrate_quarters(integral, whole);
        return;
    }
    double area = 0.5 * sp_length(sp_cross(sp_sub(c[1], c[0]), sp_sub(c[2], c[0])));
    double share = covered_share(bearing.margin, emitter->width, sqrt(area) * bearing.turn / BEND);
    integral->target.point = middle;
    if (share > 0)
        add_sample(integral, flight, share, area);
}

static void integrate_piece(void *integral, const sp_vec3 *polygon, int corners, double area)
{
    (void)area;
    for (int i = 2; i < corners; i++)
        integrate_cell(integral, &(cell){{polygon[0], polygon[i - 1], polygon[i]}});
}

static sp_footprint integrate_patch(const sp_emitter *emitter, uint32_t patch)
{
    const sp_evaluator *evaluator = emitter->source.evaluator;
    const sp_patches *patches = &evaluator->patches;
    const sp_fragments *fragments = &evaluator->fragments;
    uint32_t texel = patches->texel[patch];
    patch_integral integral = {.emitter = emitter, .target = {.side = patches->side[patch]}, .sum = {.patch = patch}};
    for (integral.arc = 0; integral.arc < 2; integral.arc++) {
        double before = integral.sum.gain;
        for (uint32_t f = fragments->start[texel]; f < fragments->start[texel + 1]; f++) {
            uint32_t triangle = fragments->items[f].triangle;
            sp_vec3 normal = sp_triangle_normal(evaluator->setup.mesh, triangle);
            integral.target.triangle = triangle;
            integral.target.normal = integral.target.side == SP_SIDE_BACK ? sp_scale(normal, -1) : normal;
            sp_counted_pieces(evaluator, texel, &fragments->items[f], integral.target.side == SP_SIDE_BACK,
                              integrate_piece, &integral);
        }
        integral.sum.arcs += integral.sum.gain > before;
    }
    sp_footprint *sum = &integral.sum;
    if (sum->gain > 0) {
        sum->speed /= sum->gain;
        sum->incidence /= sum->gain;
        sum->gain /= patches->area[patch];
        sum->passing /= patches->area[patch];
    }
    return *sum;
}

/* The patches that the spray may touch, as footprints still empty. */
static sp_footprint *find_touched(const sp_emitter *emitter, int threads, size_t *count, sp_error *error)
{
    size_t patches = emitter->source.evaluator->patches.count;
    bool *touched = malloc(patches ? patches : 1);
    if (!touched)
        return sp_fail_memory(error);
#pragma omp parallel for schedule(dynamic, 1024) num_threads(threads)
    for (size_t i = 0; i < patches; i++)
        touched[i] = may_touch(emitter, (uint32_t)i);
    *count = 0;
    for (size_t i = 0; i < patches; i++)
        *count += touched[i];
    sp_footprint *footprints = malloc((*count ? *count : 1) * sizeof *footprints);
    size_t next = 0;
    for (size_t i = 0; footprints && i < patches; i++) {
        if (touched[i])
            footprints[next++] = (sp_footprint){.patch = (uint32_t)i};
    }
    free(touched);
    return footprints ? footprints : sp_fail_memory(error);
}

sp_footprint *sp_footprints(const sp_emitter *emitter, size_t *count, sp_error *error)
{
    int threads = omp_in_parallel() ? 1 : sp_thread_count(emitter->source.evaluator->setup.run.threads);
    size_t touched = 0, kept = 0;
    sp_footprint *footprints = find_touched(emitter, threads, &touched, error);
    if (!footprints)
        return NULL;
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
    for (size_t i = 0; i < touched; i++)
        footprints[i] = integrate_patch(emitter, footprints[i].patch);
    for (size_t i = 0; i < touched; i++) {
        if (footprints[i].gain > 0)
            footprints[kept++] = footprints[i];
    }
    *count = kept;
    return footprints;
}
