#include "render.h"

#include <omp.h>
#include <stdlib.h>
#include <string.h>

#define CREASE 0.906 /* cosine of 25 degrees: a sharper edge is drawn */
#define STEP 0.008   /* of the box's diagonal: a jump in depth that is drawn */
#define INK 0.45f
#define NEARER 0.03 /* of the box's diagonal: so much nearer throws a shadow on what is beside it in the picture */
#define SHADOW 0.75f
#define SHADOW_REACH 5  /* samples */
#define TILE 8          /* samples, at least SHADOW_REACH */
#define FAINT_INK 0.72f /* of triangles */

/* What edges and shadows are found from. */
typedef struct {
    const sp_mesh *mesh;
    const sp_camera *camera;
    const sp_vec3 *normals;      /* [mesh->triangle_count] */
    const sp_depth_sample *seen; /* [rows columns] */
    double *nearest; /* of each tile and those around it, m; [tiles down, tiles across]; INFINITY: nothing seen */
    int columns, rows, across;
} scenery;

static sp_vec3 point_of(const sp_camera *camera, int x, int y, const sp_depth_sample *seen)
{
    return sp_along(camera->eye, seen->depth, sp_camera_direction(camera, 0.5 * (x + 0.5), 0.5 * (y + 0.5)));
}

/* True where an edge of the body runs between two neighbouring samples. */
static bool is_edge(const scenery *scene, int x, int y, const sp_depth_sample *a, int i, int j,
                    const sp_depth_sample *b)
{
    if (a->triangle == b->triangle)
        return false;
    if (a->triangle == SP_NONE || b->triangle == SP_NONE)
        return true;
    const uint32_t *part = scene->mesh->part;
    sp_vec3 n = scene->normals[a->triangle], m = scene->normals[b->triangle];
    if (fabs(sp_dot(n, m)) < CREASE || part[a->triangle] != part[b->triangle])
        return true;
    sp_vec3 between = sp_sub(point_of(scene->camera, i, j, b), point_of(scene->camera, x, y, a));
    return fmin(fabs(sp_dot(between, n)), fabs(sp_dot(between, m))) > STEP * scene->camera->size;
}

/* How dark the shadow is that nearer surface throws on what lies behind it, 1 for none: tells near from far where
 * colours do not. */
static float shadow_at(const scenery *scene, const sp_depth_sample *here, int x, int y)
{
    static const int ways[8][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}};
    double from = here->depth - NEARER * scene->camera->size;
    if (here->triangle == SP_NONE || !(scene->nearest[y / TILE * scene->across + x / TILE] < from))
        return 1;
    for (int reach = 1; reach <= SHADOW_REACH; reach += 2)
        for (int k = 0; k < 8; ++k) {
            int i = x + reach * ways[k][0], j = y + reach * ways[k][1];
            if (i < 0 || j < 0 || i >= scene->columns || j >= scene->rows)
                continue;
            const sp_depth_sample *there = &scene->seen[(size_t)j * (size_t)scene->columns + (size_t)i];
            if (there->triangle != SP_NONE && there->depth < from)
                return SHADOW + (1 - SHADOW) * (float)(reach - 1) / SHADOW_REACH;
        }
    return 1;
}

/* True where the edge of a triangle does, on one surface. */
static bool is_wire(const sp_depth_sample *a, const sp_depth_sample *b)
{
    return a->triangle != b->triangle && a->triangle != SP_NONE && b->triangle != SP_NONE;
}

/* A light at the eye; weak, because brightness also means flux. */
static float light_at(const scenery *scene, const sp_depth_sample *here, int x, int y)
{
    if (here->triangle == SP_NONE)
        return 1;
    sp_vec3 direction = sp_camera_direction(scene->camera, 0.5 * (x + 0.5), 0.5 * (y + 0.5));
    return (float)(0.7 + 0.3 * fabs(sp_dot(scene->normals[here->triangle], sp_unit(direction))));
}

static void shade(sp_shot *shot, const scenery *scene, bool wireframe, int threads)
{
    int columns = scene->columns, rows = scene->rows;
#pragma omp parallel for num_threads(threads) schedule(dynamic, 16)
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) {
            size_t at = (size_t)y * (size_t)columns + (size_t)x;
            const sp_depth_sample *here = &scene->seen[at], *right = here + 1, *below = here + columns;
            bool edge = (x + 1 < columns && is_edge(scene, x, y, here, x + 1, y, right)) ||
                        (y + 1 < rows && is_edge(scene, x, y, here, x, y + 1, below));
            bool wire =
                wireframe && ((x + 1 < columns && is_wire(here, right)) || (y + 1 < rows && is_wire(here, below)));
            float ink = edge ? INK : wire ? FAINT_INK : 1;
            shot->samples[at] =
                (sp_seen_sample){here->look, light_at(scene, here, x, y) * shadow_at(scene, here, x, y) * ink};
        }
}

/* The nearest that each tile shows, handed to the eight around it too: most of a picture is far from all that throws a
 * shadow, and is not gone through. */
static bool find_nearest(scenery *scene)
{
    int across = (scene->columns + TILE - 1) / TILE, down = (scene->rows + TILE - 1) / TILE;
    size_t count = (size_t)across * (size_t)down;
    double *nearest = malloc((count + 1) * sizeof *nearest);
    for (size_t k = 0; nearest && k < count; ++k)
        nearest[k] = INFINITY;
    for (int y = 0; nearest && y < scene->rows; ++y)
        for (int x = 0; x < scene->columns; ++x) {
            const sp_depth_sample *seen = &scene->seen[(size_t)y * (size_t)scene->columns + (size_t)x];
            double *tile = &nearest[y / TILE * across + x / TILE];
            *tile = fmin(*tile, seen->depth);
        }
    double *around = nearest ? malloc((count + 1) * sizeof *around) : NULL;
    for (int k = 0; around && k < across * down; ++k) {
        around[k] = INFINITY;
        for (int j = k / across ? k / across - 1 : 0; j <= k / across + 1 && j < down; ++j)
            for (int i = k % across ? k % across - 1 : 0; i <= k % across + 1 && i < across; ++i)
                around[k] = fmin(around[k], nearest[j * across + i]);
    }
    free(nearest);
    scene->nearest = around;
    scene->across = across;
    return around != NULL;
}

/* Of every triangle: samples by the thousand ask for the same one. */
static sp_vec3 *all_normals(const sp_mesh *mesh, int threads)
{
    sp_vec3 *normals = malloc((mesh->triangle_count + 1) * sizeof *normals);
    if (normals) {
#pragma omp parallel for num_threads(threads)
        for (size_t t = 0; t < mesh->triangle_count; ++t)
            normals[t] = sp_triangle_normal(mesh, (uint32_t)t);
    }
    return normals;
}

bool sp_shot_create(sp_shot *shot, const sp_evaluator *evaluator, const sp_camera *camera, bool wireframe,
                    sp_look_at *look, const void *user, sp_error *error)
{
    const sp_setup *setup = sp_evaluator_setup(evaluator);
    int team = setup->run.threads > 0 ? setup->run.threads : omp_get_max_threads();
    size_t count = 4 * (size_t)camera->width * (size_t)camera->height;
    *shot = (sp_shot){camera->width, camera->height, malloc(count * sizeof *shot->samples)};
    sp_depth_sample *seen = malloc(count * sizeof *seen);
    sp_vec3 *normals = all_normals(setup->mesh, team);
    scenery scene = {.mesh = setup->mesh,
                     .camera = camera,
                     .normals = normals,
                     .seen = seen,
                     .columns = 2 * camera->width,
                     .rows = 2 * camera->height};
    bool done = shot->samples && seen && normals &&
                sp_depth_buffer_fill(seen, setup->mesh, camera, look, user, team, error) && find_nearest(&scene);
    if (done)
        shade(shot, &scene, wireframe, team);
    free(scene.nearest);
    free(normals);
    free(seen);
    if (done)
        return true;
    sp_shot_free(shot);
    return sp_fail_memory(error);
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

/* The colours of the last look of each stripe: neighbours mostly show the same. */
typedef struct {
    sp_look_colour *colour;
    const void *user;
    uint32_t look[2];
    uint8_t rgb[2][3];
} last_colours;

static const uint8_t *colour_of(last_colours *last, uint32_t look, int stripe)
{
    uint8_t *rgb = last->rgb[stripe];
    if (look == last->look[stripe])
        return rgb;
    last->look[stripe] = look;
    if (look == SP_LOOK_NOTHING)
        memset(rgb, 255, 3);
    else
        last->colour(last->user, look, stripe, rgb);
    return rgb;
}

uint8_t *sp_shot_picture(const sp_shot *shot, sp_look_colour *colour, const void *user, sp_error *error)
{
    size_t width = (size_t)shot->width, height = (size_t)shot->height;
    uint8_t *pixels = malloc(3 * width * height);
    if (!pixels)
        return sp_fail_memory(error);
    last_colours last = {.colour = colour, .user = user, .look = {SP_LOOK_NOTHING, SP_LOOK_NOTHING}};
    memset(last.rgb, 255, sizeof last.rgb);
    for (size_t y = 0; y < height; ++y)
        for (size_t x = 0; x < width; ++x) {
            int sum[3] = {0};
            for (size_t k = 0; k < 4; ++k) {
                size_t column = 2 * x + k % 2, row = 2 * y + k / 2;
                const sp_seen_sample *sample = &shot->samples[row * 2 * width + column];
                const uint8_t *rgb = colour_of(&last, sample->look, stripe_at((int)column, (int)row));
                for (int c = 0; c < 3; ++c)
                    sum[c] += (uint8_t)((float)rgb[c] * sample->shade + 0.5f);
            }
            for (int c = 0; c < 3; ++c)
                pixels[3 * (y * width + x) + (size_t)c] = (uint8_t)((sum[c] + 2) / 4);
        }
    return pixels;
}
