#include "sprays.h"

#include "report/overlay.h"
#include "spray/paths.h"

#include <stdlib.h>

#define FULL 32767.0
#define JET 128 /* begins with this leg */
#define POINTS (SP_OUTLINE + 1)

typedef struct {
    sp_vec3 middle;
    double span;
    size_t spray_count;
    sp_vec3 *points; /* [spray_count x POINTS], where each is and its rim */
    sp_paths paths;
} lines;

static double part_of(sp_vec3 v, int axis)
{
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

static double largest(double most, sp_vec3 away)
{
    return fmax(most, fmax(fabs(away.x), fmax(fabs(away.y), fabs(away.z))));
}

static bool draw_lines(const sp_evaluator *evaluator, const sp_nozzle *nozzle, lines *drawn, sp_error *error)
{
    const sp_setup *setup = sp_evaluator_setup(evaluator);
    size_t count = sp_nozzle_pattern_count(nozzle);
    sp_vec3 low, high;
    double size = sp_mesh_box(setup->mesh, &low, &high);
    sp_nozzle *patterns = malloc(count * sizeof *patterns);
    *drawn = (lines){
        .middle = nozzle->position, .spray_count = count, .points = malloc(count * POINTS * sizeof *drawn->points)};
    if (patterns && drawn->points) {
        sp_nozzle_patterns(nozzle, &setup->liquid, setup->up, patterns);
        for (size_t i = 0; i < count; ++i) {
            drawn->points[i * POINTS] = patterns[i].position;
            sp_overlay_outline(evaluator, &patterns[i], size, &drawn->points[i * POINTS + 1]);
        }
    }
    bool done = patterns && drawn->points;
    free(patterns);
    return done ? sp_paths_fly(evaluator, nozzle, &drawn->paths, error) : sp_fail_memory(error) != NULL;
}

static void measure(lines *drawn)
{
    double most = 0;
    for (size_t i = 0; i < drawn->spray_count * POINTS; ++i)
        most = largest(most, sp_sub(drawn->points[i], drawn->middle));
    for (size_t i = 0; i < drawn->paths.leg_count; ++i)
        most = fmax(largest(most, sp_sub(drawn->paths.legs[i].end, drawn->middle)), drawn->paths.legs[i].rise);
    drawn->span = most > 0 ? most : 1;
}

static uint16_t short_of(const lines *drawn, double length)
{
    return (uint16_t)lrint(FULL * length / drawn->span);
}

static void pack_rims(const lines *drawn, uint16_t *shorts, sp_packed *packed)
{
    size_t count = drawn->spray_count * POINTS;
    for (int axis = 0; axis < 3; ++axis) {
        for (size_t i = 0; i < count; ++i)
            shorts[i] = short_of(drawn, part_of(sp_sub(drawn->points[i], drawn->middle), axis));
        sp_packed_shorts(packed, shorts, count, true);
    }
}

static void pack_jets(const lines *drawn, uint16_t *shorts, uint8_t *bytes, sp_packed *packed)
{
    const sp_paths *paths = &drawn->paths;
    memset(bytes, 0, drawn->spray_count);
    for (size_t i = 0; i < paths->jet_count; ++i)
        bytes[paths->pattern[i]]++;
    sp_packed_bytes(packed, bytes, drawn->spray_count);
    for (size_t i = 0; i < paths->leg_count; ++i) {
        bool begins = i == 0 || paths->legs[i].jet != paths->legs[i - 1].jet;
        bytes[i] = (uint8_t)(paths->legs[i].bounce + (begins ? JET : 0));
    }
    sp_packed_bytes(packed, bytes, paths->leg_count);
    for (int axis = 0; axis < 4; ++axis) {
        for (size_t i = 0; i < paths->leg_count; ++i) {
            const sp_path_leg *leg = &paths->legs[i];
            shorts[i] = short_of(drawn, axis < 3 ? part_of(sp_sub(leg->end, drawn->middle), axis) : leg->rise);
        }
        sp_packed_shorts(packed, shorts, paths->leg_count, false);
    }
}

bool sp_viewer_sprays(const sp_evaluator *evaluator, const sp_nozzle *nozzle, json_t *object, sp_packed *packed,
                      sp_error *error)
{
    lines drawn;
    bool done = draw_lines(evaluator, nozzle, &drawn, error);
    if (done) {
        measure(&drawn);
        size_t legs = drawn.paths.leg_count, room = legs + drawn.spray_count * POINTS;
        uint16_t *shorts = malloc(room * sizeof *shorts);
        uint8_t *bytes = malloc(room);
        done = (shorts && bytes && json_object_set_new(object, "span", json_real(drawn.span)) == 0 &&
                json_object_set_new(object, "sprays", json_integer((json_int_t)drawn.spray_count)) == 0 &&
                json_object_set_new(object, "legs", json_integer((json_int_t)legs)) == 0) ||
               sp_fail_memory(error);
        if (done) {
            pack_rims(&drawn, shorts, packed);
            pack_jets(&drawn, shorts, bytes, packed);
        }
        free(shorts);
        free(bytes);
    }
    free(drawn.points);
    sp_paths_free(&drawn.paths);
    return done;
}
