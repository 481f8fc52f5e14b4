#include "render.h"

#include <omp.h>
#include <stdlib.h>
#include <string.h>

#define LOOK_THROUGH_MOST 1000 /* surfaces; ends a ray that round-off holds in place */
#define CREASE 0.906           /* cosine of 25 degrees: a sharper edge is drawn */
#define STEP 0.008             /* of the box's diagonal: a jump in depth that is drawn */
#define INK 0.45f

/* Needed only to find edges. */
typedef struct {
    uint32_t triangle;
    float depth; /* along the forward axis, m */
} sighting;

/* The first surface that shows its wet side. */
static sp_hit look(const sp_layers *layers, const sp_camera *camera, sp_vec3 direction, int *back)
{
    const sp_mesh *mesh = sp_evaluator_setup(layers->evaluator)->mesh;
    sp_ray ray = {camera->eye, direction, 0, INFINITY, SP_NONE};
    if (camera->cut)
        ray.t_min = sp_dot(sp_sub(camera->centre, camera->eye), camera->forward);
    sp_hit hit = {.triangle = SP_NONE};
    for (int i = 0; i < LOOK_THROUGH_MOST; ++i) {
        hit = sp_trace_nearest(sp_evaluator_tracer(layers->evaluator), &ray, sp_v(0, 0, 0));
        if (hit.triangle == SP_NONE)
            return hit;
        *back = sp_dot(sp_triangle_normal(mesh, hit.triangle), direction) > 0;
        if (sp_layers_wet(layers, hit.triangle, *back))
            return hit;
        ray.t_min = hit.t;
        ray.skip = hit.triangle;
    }
    hit.triangle = SP_NONE;
    return hit;
}

static void sample_at(const sp_layers *layers, const sp_camera *camera, double x, double y, sp_sample *sample,
                      sighting *seen)
{
    sp_vec3 direction = sp_camera_direction(camera, x, y);
    int back = 0;
    sp_hit hit = look(layers, camera, direction, &back);
    *sample = (sp_sample){SP_LOOK_NOTHING, 1};
    *seen = (sighting){hit.triangle, 0};
    if (hit.triangle == SP_NONE)
        return;
    const sp_mesh *mesh = sp_evaluator_setup(layers->evaluator)->mesh;
    double facing = fabs(sp_dot(sp_triangle_normal(mesh, hit.triangle), sp_unit(direction)));
    uint32_t patch = sp_layers_patch(layers, hit.triangle, hit.u, hit.v, back);
    sample->look = patch == SP_NONE ? SP_LOOK_GREY : patch;
    /* A light at the eye; weak, because brightness also means flux. */
    sample->shade = (float)(0.7 + 0.3 * facing);
    seen->depth = (float)hit.t; /* the direction's forward component is 1 */
}

static sp_vec3 point_of(const sp_camera *camera, int x, int y, const sighting *seen)
{
    return sp_along(camera->eye, seen->depth, sp_camera_direction(camera, 0.5 * (x + 0.5), 0.5 * (y + 0.5)));
}

/* True where an edge of the body runs between two neighbouring samples. */
static bool is_edge(const sp_mesh *mesh, const sp_camera *camera, int x, int y, const sighting *a, int i, int j,
                    const sighting *b)
{
    if (a->triangle == b->triangle)
        return false;
    if (a->triangle == SP_NONE || b->triangle == SP_NONE)
        return true;
    sp_vec3 n = sp_triangle_normal(mesh, a->triangle), m = sp_triangle_normal(mesh, b->triangle);
    if (fabs(sp_dot(n, m)) < CREASE || mesh->part[a->triangle] != mesh->part[b->triangle])
        return true;
    sp_vec3 between = sp_sub(point_of(camera, i, j, b), point_of(camera, x, y, a));
    return fmin(fabs(sp_dot(between, n)), fabs(sp_dot(between, m))) > STEP * camera->size;
}

static void ink_edges(sp_shot *shot, const sp_mesh *mesh, const sp_camera *camera, const sighting *seen, int threads)
{
    int columns = 2 * shot->width, rows = 2 * shot->height;
#pragma omp parallel for num_threads(threads) schedule(dynamic, 16)
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) {
            size_t here = (size_t)y * (size_t)columns + (size_t)x;
            bool edge =
                (x + 1 < columns && is_edge(mesh, camera, x, y, &seen[here], x + 1, y, &seen[here + 1])) ||
                (y + 1 < rows && is_edge(mesh, camera, x, y, &seen[here], x, y + 1, &seen[here + (size_t)columns]));
            if (edge)
                shot->samples[here].shade *= INK;
        }
}

bool sp_shot_create(sp_shot *shot, const sp_layers *layers, const sp_camera *camera, int threads, sp_error *error)
{
    int columns = 2 * camera->width, rows = 2 * camera->height;
    size_t count = (size_t)columns * (size_t)rows;
    int team = threads > 0 ? threads : omp_get_max_threads();
    *shot = (sp_shot){camera->width, camera->height, malloc(count * sizeof *shot->samples)};
    sighting *seen = malloc(count * sizeof *seen);
    if (!shot->samples || !seen) {
        free(seen);
        sp_shot_free(shot);
        return sp_fail_memory(error);
    }
#pragma omp parallel for num_threads(team) schedule(dynamic, 8)
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) {
            size_t here = (size_t)y * (size_t)columns + (size_t)x;
            sample_at(layers, camera, 0.5 * (x + 0.5), 0.5 * (y + 0.5), &shot->samples[here], &seen[here]);
        }
    ink_edges(shot, sp_evaluator_setup(layers->evaluator)->mesh, camera, seen, team);
    free(seen);
    return true;
}

void sp_shot_free(sp_shot *shot)
{
    free(shot->samples);
    *shot = (sp_shot){0};
}

/* Stripes of the hatch across the picture, in samples. */
static int stripe_at(int x, int y)
{
    return (x + y) % 16 < 4;
}

static void sample_colour(const sp_sample *sample, const sp_deposits *deposits, sp_flux_scale scale, int stripe,
                          uint8_t rgb[3])
{
    if (sample->look == SP_LOOK_NOTHING)
        memset(rgb, 255, 3);
    else if (sample->look == SP_LOOK_GREY)
        memcpy(rgb, sp_colour_obstacle, 3);
    else
        sp_false_colour(scale, deposits, sample->look, stripe, rgb);
    for (int k = 0; k < 3; ++k)
        rgb[k] = (uint8_t)((float)rgb[k] * sample->shade + 0.5f);
}

uint8_t *sp_shot_picture(const sp_shot *shot, const sp_coverage *coverage, sp_flux_scale scale, sp_error *error)
{
    size_t width = (size_t)shot->width, height = (size_t)shot->height;
    uint8_t *pixels = malloc(3 * width * height);
    if (!pixels)
        return sp_fail_memory(error);
    for (size_t y = 0; y < height; ++y)
        for (size_t x = 0; x < width; ++x) {
            int sum[3] = {0};
            for (size_t k = 0; k < 4; ++k) {
                size_t column = 2 * x + k % 2, row = 2 * y + k / 2;
                uint8_t rgb[3];
                sample_colour(&shot->samples[row * 2 * width + column], &coverage->deposits, scale,
                              stripe_at((int)column, (int)row), rgb);
                for (int c = 0; c < 3; ++c)
                    sum[c] += rgb[c];
            }
            for (int c = 0; c < 3; ++c)
                pixels[3 * (y * width + x) + (size_t)c] = (uint8_t)((sum[c] + 2) / 4);
        }
    return pixels;
}
