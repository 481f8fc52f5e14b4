#include "overlay.h"

#include "nozzle/pattern.h"

#include <stdlib.h>

#define RIM SP_OUTLINE
#define LENGTH 0.12 /* of the box's diagonal that an outline reaches */

typedef struct {
    double x, y;
} spot;

static int by_x(const void *a, const void *b)
{
    const spot *p = a, *q = b;
    if (p->x != q->x)
        return p->x < q->x ? -1 : 1;
    return p->y < q->y ? -1 : p->y > q->y;
}

static bool turns_left(const spot *hull, size_t count, const spot *next)
{
    const spot *a = &hull[count - 2], *b = &hull[count - 1];
    return (b->x - a->x) * (next->y - a->y) - (b->y - a->y) * (next->x - a->x) > 0;
}

/* Convex hull by Andrew's monotone chain; `hull` has room for count + 1. Returns how many corners. */
static size_t convex_hull(spot *spots, size_t count, spot *hull)
{
    qsort(spots, count, sizeof *spots, by_x);
    size_t used = 0;
    for (int half = 0; half < 2; ++half) {
        size_t start = used;
        for (size_t i = 0; i < count; ++i) {
            const spot *next = &spots[half ? count - 1 - i : i];
            while (used >= start + 2 && !turns_left(hull, used, next))
                used--;
            hull[used++] = *next;
        }
        used--; /* the last one starts the other half */
    }
    return used;
}

static void add_path(sp_text *text, const char *class_name, const spot *spots, size_t count)
{
    if (count < 2)
        return;
    sp_text_add(text, "<path class=\"%s\" d=\"M", class_name);
    for (size_t i = 0; i < count; ++i)
        sp_text_add(text, "%.1f %.1f ", spots[i].x, spots[i].y);
    sp_text_add(text, "z\"/>");
}

/* So far that it stays clear of what the axis meets. */
static double outline_length(double size, const sp_evaluator *evaluator, const sp_nozzle *pattern)
{
    sp_ray ray = {pattern->position, pattern->axis, 0, INFINITY, SP_NONE};
    sp_hit hit = sp_trace_nearest(sp_evaluator_tracer(evaluator), &ray, sp_v(0, 0, 0));
    return fmin(LENGTH * size, 0.8 * hit.t);
}

void sp_overlay_outline(const sp_evaluator *evaluator, const sp_nozzle *pattern, double size, sp_vec3 rim[SP_OUTLINE])
{
    double length = outline_length(size, evaluator, pattern);
    sp_frame frame = sp_nozzle_frame(pattern->axis, pattern->roll, sp_evaluator_setup(evaluator)->up);
    sp_spray spray = sp_spray_create(pattern->type, sp_nozzle_angle(pattern));
    for (int i = 0; i < RIM; ++i) {
        sp_vec3 d = sp_spray_rim(&spray, i, RIM);
        sp_vec3 world = sp_add(sp_add(sp_scale(frame.x, d.x), sp_scale(frame.y, d.y)), sp_scale(frame.z, d.z));
        rim[i] = sp_along(pattern->position, length, world);
    }
}

static void add_outline(sp_text *text, const sp_camera *camera, const sp_evaluator *evaluator, const sp_nozzle *pattern)
{
    spot spots[RIM + 1], rim[RIM], hull[RIM + 3];
    sp_vec3 points[RIM];
    double xy[2];
    sp_overlay_outline(evaluator, pattern, camera->size, points);
    for (int i = 0; i < RIM; ++i) {
        if (!sp_camera_project(camera, points[i], xy))
            return;
        spots[i] = rim[i] = (spot){xy[0], xy[1]};
    }
    if (!sp_camera_shows(camera, pattern->position, xy))
        return;
    spots[RIM] = (spot){xy[0], xy[1]};
    add_path(text, "spray", hull, convex_hull(spots, RIM + 1, hull));
    add_path(text, "rim", rim, RIM);
}

/* Of each of its patterns. */
static void add_outlines(sp_text *text, const sp_camera *camera, const sp_evaluator *evaluator, const sp_nozzle *nozzle)
{
    const sp_setup *setup = sp_evaluator_setup(evaluator);
    size_t count = sp_nozzle_pattern_count(nozzle);
    sp_nozzle *patterns = malloc(count * sizeof *patterns);
    if (patterns)
        sp_nozzle_patterns(nozzle, &setup->liquid, setup->up, patterns);
    for (size_t i = 0; patterns && i < count; i++)
        add_outline(text, camera, evaluator, &patterns[i]);
    text->failed |= !patterns;
    free(patterns);
}

void sp_overlay_sprays(sp_text *text, const sp_camera *camera, const sp_evaluator *evaluator, const sp_layout *layout)
{
    for (size_t i = 0; i < layout->count; ++i)
        add_outlines(text, camera, evaluator, &layout->nozzles[i]);
}
