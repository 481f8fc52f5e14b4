/* Points drawn evenly from what is counted. */
#include "nozzle/scramble.h"
#include "spray/state/state.h"

#include <sprayplan/points.h>

#include <stdlib.h>

#define HALVINGS 40 /* of a triangle: finer than its corners' digits tell places apart */

/* A triangle's side, or a triangle of what is counted of it. */
typedef struct {
    double end;          /* m² of all up to and with this one */
    double corner[3][2]; /* weights of the mesh's triangle's second and third corner */
    uint32_t triangle;
    unsigned side;
} stretch;

struct sp_points {
    const sp_evaluator *evaluator;
    size_t count;
    double area;        /* m² */
    stretch *stretches; /* [count] */
};

/* Stretches while they are counted and then laid end to end. */
typedef struct {
    sp_points *points; /* its stretches NULL while they are counted */
    uint32_t triangle;
    unsigned side;
} laying;

static void lay(void *user, const sp_vec3 *polygon, int corners, double area)
{
    laying *l = user;
    sp_points *points = l->points;
    const sp_mesh *mesh = points->evaluator->setup.mesh;
    (void)area;
    for (int i = 2; i < corners; i++) {
        if (points->stretches) {
            const sp_vec3 corner[3] = {polygon[0], polygon[i - 1], polygon[i]};
            stretch *s = &points->stretches[points->count];
            *s = (stretch){.triangle = l->triangle, .side = l->side};
            for (int k = 0; k < 3; k++)
                sp_triangle_weights(mesh, l->triangle, corner[k], &s->corner[k][0], &s->corner[k][1]);
            points->area += 0.5 * sp_length(sp_cross(sp_sub(corner[1], corner[0]), sp_sub(corner[2], corner[0])));
            s->end = points->area;
        }
        points->count++;
    }
}

static void lay_all(sp_points *points)
{
    points->count = 0;
    for (uint32_t t = 0; t < points->evaluator->setup.mesh->triangle_count; t++)
        for (unsigned side = 0; side < 2; side++)
            sp_counted_parts(points->evaluator, t, side, lay, &(laying){points, t, side});
}

sp_points *sp_points_create(const sp_evaluator *evaluator, sp_error *error)
{
    if (!evaluator)
        return NULL;
    sp_points *points = calloc(1, sizeof *points);
    if (!points)
        return sp_fail_memory(error);
    points->evaluator = evaluator;
    lay_all(points);
    points->stretches = malloc((points->count + 1) * sizeof *points->stretches);
    if (!points->stretches) {
        sp_points_destroy(points);
        return sp_fail_memory(error);
    }
    lay_all(points);
    return points;
}

void sp_points_destroy(sp_points *points)
{
    if (!points)
        return;
    free(points->stretches);
    free(points);
}

double sp_points_area(const sp_points *points)
{
    return points->area;
}

/* The first that ends beyond a place. */
static const stretch *find_stretch(const sp_points *points, double place)
{
    size_t low = 0, high = points->count - 1;
    while (low < high) {
        size_t middle = (low + high) / 2;
        if (points->stretches[middle].end > place)
            high = middle;
        else
            low = middle + 1;
    }
    return &points->stretches[low];
}

static void copy(double to[2], const double from[2])
{
    to[0] = from[0];
    to[1] = from[1];
}

/* The place at a share `t` of the area along Sierpinski's curve, which goes from the first corner to the second:
 * through the half with the first, then the half with the second, in each from its own corner to the third. */
static void follow_curve(const double corner[3][2], double t, double place[2])
{
    double from[2], to[2], apex[2];
    copy(from, corner[0]);
    copy(to, corner[1]);
    copy(apex, corner[2]);
    for (int i = 0; i < HALVINGS; i++) {
        double middle[2] = {0.5 * (from[0] + to[0]), 0.5 * (from[1] + to[1])};
        bool second = t >= 0.5;
        copy(second ? from : to, apex);
        copy(apex, middle);
        t = 2 * t - second;
    }
    for (int k = 0; k < 2; k++)
        place[k] = (from[k] + to[k] + apex[k]) / 3;
}

sp_point sp_points_draw(const sp_points *points, size_t i, size_t n, uint64_t seed)
{
    const sp_evaluator *evaluator = points->evaluator;
    const sp_mesh *mesh = evaluator->setup.mesh;
    double jitter = sp_fraction(sp_scramble(sp_scramble(seed) + i));
    double at = ((double)i + jitter) / (double)n * points->area;
    const stretch *s = find_stretch(points, at);
    double start = s > points->stretches ? s[-1].end : 0, weights[2];
    follow_curve(s->corner, fmin(fmax((at - start) / (s->end - start), 0), 1), weights);
    sp_vec3 normal = sp_triangle_normal(mesh, s->triangle);
    bool sided = evaluator->setup.cavity != SP_CAVITY_NONE;
    return (sp_point){.position = sp_triangle_point(mesh, s->triangle, weights[0], weights[1]),
                      .normal = s->side ? sp_scale(normal, -1) : normal,
                      .side = !sided    ? SP_SIDE_BOTH
                              : s->side ? SP_SIDE_BACK
                                        : SP_SIDE_FRONT,
                      .triangle = s->triangle,
                      .u = weights[0],
                      .v = weights[1],
                      .patch = sp_patch_at(evaluator, s->triangle, weights[0], weights[1], s->side)};
}
