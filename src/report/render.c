#include "render.h"

#include <omp.h>
#include <stdlib.h>
#include <string.h>

#define BAND 32
#define LOOK_THROUGH_MOST 1000 /* surfaces; ends a ray that round-off holds in place */
#define CREASE 0.906           /* cosine of 25 degrees: a sharper edge is drawn */
#define STEP 0.008             /* of the box's diagonal: a jump in depth that is drawn */
#define INK 0.45f
#define NEARER 0.03 /* of the box's diagonal: so much nearer throws a shadow on what is beside it in the picture */
#define SHADOW 0.75f
#define SHADOW_REACH 5  /* samples */
#define TILE 8          /* samples, at least SHADOW_REACH */
#define FAINT_INK 0.72f /* of triangles */

/* Needed only to find edges. */
typedef struct {
    uint32_t triangle;
    float depth; /* along the forward axis, m */
} sighting;

/* What edges and shadows are found from. */
typedef struct {
    const sp_mesh *mesh;
    const sp_camera *camera;
    const sp_vec3 *normals; /* [mesh->triangle_count] */
    const sighting *seen;   /* [rows columns] */
    float *nearest; /* of each tile and those around it, m; [tiles down, tiles across]; INFINITY: nothing seen */
    int columns, rows, across;
} scenery;

/* Rows of samples that one thread looks at together: lines from one eye, side by side, are traced faster than one by
 * one. */
typedef struct {
    const sp_evaluator *evaluator;
    const sp_camera *camera;
    const sp_vec3 *normals; /* of the triangles */
    sp_look_at *look;
    const void *user;
    size_t columns;
    sp_ray *rays;           /* [BAND columns] */
    sp_hit *hits;           /* the same */
    uint32_t *number;       /* the same: the sample that a ray belongs to */
    sp_seen_sample *sample; /* of the band's first sample */
    sighting *seen;         /* the same */
} band;

/* True where the ray is to be traced on. */
static bool looks_on(const band *b, size_t i)
{
    const sp_hit *hit = &b->hits[i];
    sp_ray *ray = &b->rays[i];
    if (hit->triangle == SP_NONE)
        return false;
    double facing = sp_dot(b->normals[hit->triangle], sp_unit(ray->velocity));
    uint32_t look = b->look(b->user, hit->triangle, hit->u, hit->v, facing > 0), number = b->number[i];
    if (look != SP_LOOK_NOTHING) {
        /* A light at the eye; weak, because brightness also means flux. */
        b->sample[number] = (sp_seen_sample){look, (float)(0.7 + 0.3 * fabs(facing))};
        b->seen[number] = (sighting){hit->triangle, (float)hit->t}; /* the direction's forward component is 1 */
        return false;
    }
    ray->t_min = hit->t;
    ray->skip = hit->triangle;
    return true;
}

static void aim(const band *b, size_t y, size_t count)
{
    const sp_camera *camera = b->camera;
    double from = camera->cut ? sp_dot(sp_sub(camera->centre, camera->eye), camera->forward) : 0;
    for (size_t i = 0; i < count; ++i) {
        double column = (double)(i % b->columns), row = (double)(y + i / b->columns);
        sp_vec3 direction = sp_camera_direction(camera, 0.5 * (column + 0.5), 0.5 * (row + 0.5));
        b->rays[i] = (sp_ray){camera->eye, direction, from, INFINITY, SP_NONE};
        b->number[i] = (uint32_t)i;
        b->sample[i] = (sp_seen_sample){SP_LOOK_NOTHING, 1};
        b->seen[i] = (sighting){SP_NONE, 0};
    }
}

/* The first surfaces that are not looked through, `rows` rows from y on. */
static void look_along(const band *b, size_t y, size_t rows)
{
    size_t count = rows * b->columns;
    aim(b, y, count);
    for (int i = 0; count && i < LOOK_THROUGH_MOST; ++i) {
        sp_trace_nearest_many(sp_evaluator_tracer(b->evaluator), b->rays, count, sp_v(0, 0, 0), 1, b->hits);
        size_t kept = 0;
        for (size_t k = 0; k < count; ++k)
            if (looks_on(b, k)) {
                b->rays[kept] = b->rays[k];
                b->number[kept++] = b->number[k];
            }
        count = kept;
    }
}

static sp_vec3 point_of(const sp_camera *camera, int x, int y, const sighting *seen)
{
    return sp_along(camera->eye, seen->depth, sp_camera_direction(camera, 0.5 * (x + 0.5), 0.5 * (y + 0.5)));
}

/* True where an edge of the body runs between two neighbouring samples. */
static bool is_edge(const scenery *scene, int x, int y, const sighting *a, int i, int j, const sighting *b)
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
static float shadow_at(const scenery *scene, const sighting *here, int x, int y)
{
    static const int ways[8][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}};
    double from = (double)here->depth - NEARER * scene->camera->size;
    if (here->triangle == SP_NONE || !((double)scene->nearest[y / TILE * scene->across + x / TILE] < from))
        return 1;
    for (int reach = 1; reach <= SHADOW_REACH; reach += 2)
        for (int k = 0; k < 8; ++k) {
            int i = x + reach * ways[k][0], j = y + reach * ways[k][1];
            if (i < 0 || j < 0 || i >= scene->columns || j >= scene->rows)
                continue;
            const sighting *there = &scene->seen[(size_t)j * (size_t)scene->columns + (size_t)i];
            if (there->triangle != SP_NONE && (double)there->depth < from)
                return SHADOW + (1 - SHADOW) * (float)(reach - 1) / SHADOW_REACH;
        }
    return 1;
}

/* True where the edge of a triangle does, on one surface. */
static bool is_wire(const sighting *a, const sighting *b)
{
    return a->triangle != b->triangle && a->triangle != SP_NONE && b->triangle != SP_NONE;
}

static void ink_edges(sp_shot *shot, const scenery *scene, bool wireframe, int threads)
{
    int columns = scene->columns, rows = scene->rows;
#pragma omp parallel for num_threads(threads) schedule(dynamic, 16)
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) {
            size_t at = (size_t)y * (size_t)columns + (size_t)x;
            const sighting *here = &scene->seen[at], *right = here + 1, *below = here + columns;
            bool edge = (x + 1 < columns && is_edge(scene, x, y, here, x + 1, y, right)) ||
                        (y + 1 < rows && is_edge(scene, x, y, here, x, y + 1, below));
            bool wire =
                wireframe && ((x + 1 < columns && is_wire(here, right)) || (y + 1 < rows && is_wire(here, below)));
            shot->samples[at].shade *= shadow_at(scene, here, x, y);
            if (edge || wire)
                shot->samples[at].shade *= edge ? INK : FAINT_INK;
        }
}

/* The nearest that each tile shows, handed to the eight around it too: most of a picture is far from all that throws a
 * shadow, and is not gone through. */
static bool find_nearest(scenery *scene)
{
    int across = (scene->columns + TILE - 1) / TILE, down = (scene->rows + TILE - 1) / TILE;
    size_t count = (size_t)across * (size_t)down;
    float *nearest = malloc((count + 1) * sizeof *nearest);
    for (size_t k = 0; nearest && k < count; ++k)
        nearest[k] = INFINITY;
    for (int y = 0; nearest && y < scene->rows; ++y)
        for (int x = 0; x < scene->columns; ++x) {
            const sighting *seen = &scene->seen[(size_t)y * (size_t)scene->columns + (size_t)x];
            float *tile = &nearest[y / TILE * across + x / TILE];
            if (seen->triangle != SP_NONE && seen->depth < *tile)
                *tile = seen->depth;
        }
    float *around = nearest ? malloc((count + 1) * sizeof *around) : NULL;
    for (int k = 0; around && k < across * down; ++k) {
        around[k] = INFINITY;
        for (int j = k / across ? k / across - 1 : 0; j <= k / across + 1 && j < down; ++j)
            for (int i = k % across ? k % across - 1 : 0; i <= k % across + 1 && i < across; ++i)
                around[k] = fminf(around[k], nearest[j * across + i]);
    }
    free(nearest);
    scene->nearest = around;
    scene->across = across;
    return around != NULL;
}

/* Bands are shared out among the threads, each with buffers of its own. */
static bool look_at_all(sp_shot *shot, const band *common, sighting *seen, int team)
{
    const sp_camera *camera = common->camera;
    size_t columns = 2 * (size_t)camera->width, rows = 2 * (size_t)camera->height, at_once = BAND * columns;
    sp_ray *rays = malloc((size_t)team * at_once * sizeof *rays);
    sp_hit *hits = malloc((size_t)team * at_once * sizeof *hits);
    uint32_t *number = malloc((size_t)team * at_once * sizeof *number);
    bool done = rays && hits && number;
    if (done) {
#pragma omp parallel for num_threads(team) schedule(dynamic)
        for (size_t y = 0; y < rows; y += BAND) {
            size_t own = (size_t)omp_get_thread_num() * at_once;
            band b = *common;
            b.columns = columns;
            b.rays = &rays[own];
            b.hits = &hits[own];
            b.number = &number[own];
            b.sample = &shot->samples[y * columns];
            b.seen = &seen[y * columns];
            look_along(&b, y, rows - y < BAND ? rows - y : BAND);
        }
    }
    free(rays);
    free(hits);
    free(number);
    return done;
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
    sighting *seen = malloc(count * sizeof *seen);
    sp_vec3 *normals = all_normals(setup->mesh, team);
    const band common = {.evaluator = evaluator, .camera = camera, .normals = normals, .look = look, .user = user};
    scenery scene = {.mesh = setup->mesh,
                     .camera = camera,
                     .normals = normals,
                     .seen = seen,
                     .columns = 2 * camera->width,
                     .rows = 2 * camera->height};
    bool done = shot->samples && seen && normals && look_at_all(shot, &common, seen, team) && find_nearest(&scene);
    if (done)
        ink_edges(shot, &scene, wireframe, team);
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
