/* Tracers: making them, and walking their tree with one ray. */
#include "trace/kd_tree.h"
#include "trace/line.h"
#include "trace/parabola.h"

#include <float.h>
#include <omp.h>
#include <stdlib.h>

/* How much wider than itself every plane of the tree is taken, relative to the size of the coordinates: well above what
 * rounding may move a hit, so that the tree never decides an answer. */
#define MARGIN 1e-10

struct sp_tracer {
    const sp_mesh *mesh;
    kd_tree tree;
    parabola_plane *planes; /* [triangle_count] */
    double size;            /* largest coordinate, m */
};

static void to_array(sp_vec3 p, double array[3])
{
    array[0] = p.x;
    array[1] = p.y;
    array[2] = p.z;
}

static void corners_of(const sp_mesh *mesh, uint32_t triangle, double corners[3][3])
{
    for (int i = 0; i < 3; i++)
        to_array(mesh->vertices[mesh->triangles[triangle][i]], corners[i]);
}

static void prepare_plane(const sp_mesh *mesh, uint32_t triangle, double size, parabola_plane *plane)
{
    double corners[3][3];
    corners_of(mesh, triangle, corners);
    sp_vec3 a = mesh->vertices[mesh->triangles[triangle][0]], b = mesh->vertices[mesh->triangles[triangle][1]];
    sp_vec3 c = mesh->vertices[mesh->triangles[triangle][2]];
    sp_vec3 normal = sp_cross(sp_sub(b, a), sp_sub(c, a));
    to_array(a, plane->corner);
    to_array(normal, plane->normal);
    plane->axis = 0;
    for (int k = 1; k < 3; k++)
        if (fabs(plane->normal[k]) > fabs(plane->normal[plane->axis]))
            plane->axis = k;
    int kx = (plane->axis + 1) % 3, ky = (plane->axis + 2) % 3;
    plane->e1[0] = corners[1][kx] - corners[0][kx];
    plane->e1[1] = corners[1][ky] - corners[0][ky];
    plane->e2[0] = corners[2][kx] - corners[0][kx];
    plane->e2[1] = corners[2][ky] - corners[0][ky];
    plane->inverse = 1 / (plane->e1[0] * plane->e2[1] - plane->e1[1] * plane->e2[0]);
    double longest = fmax(sp_distance(a, b), fmax(sp_distance(b, c), sp_distance(c, a)));
    double height = sp_length(normal) / longest;
    plane->slack = 1e-12 + 64 * DBL_EPSILON * (size + longest) / height;
}

static bool prepare(sp_tracer *tracer)
{
    const sp_mesh *mesh = tracer->mesh;
    tracer->planes = malloc((mesh->triangle_count + 1) * sizeof *tracer->planes);
    if (!tracer->planes)
        return false;
    for (int axis = 0; axis < 3; axis++)
        tracer->size = fmax(tracer->size, fmax(fabs(tracer->tree.low[axis]), fabs(tracer->tree.high[axis])));
    for (size_t t = 0; t < mesh->triangle_count; t++)
        prepare_plane(mesh, (uint32_t)t, tracer->size, &tracer->planes[t]);
    return true;
}

static bool build_tree(const sp_mesh *mesh, sp_accelerator accelerator, kd_tree *tree)
{
    switch (accelerator) {
    case SP_ACCELERATOR_SAH:
        return kd_tree_sah(mesh, tree);
    case SP_ACCELERATOR_NAIVE:
        return kd_tree_naive(mesh, tree);
    default:
        return kd_tree_leaf(mesh, tree);
    }
}

sp_tracer *sp_tracer_create(const sp_mesh *mesh, sp_accelerator accelerator, sp_error *error)
{
    if (!mesh)
        return NULL;
    sp_tracer *tracer = calloc(1, sizeof *tracer);
    if (!tracer)
        return sp_fail_memory(error);
    tracer->mesh = mesh;
    if (!build_tree(mesh, accelerator, &tracer->tree) || !prepare(tracer)) {
        sp_tracer_destroy(tracer);
        return sp_fail_memory(error);
    }
    return tracer;
}

void sp_tracer_destroy(sp_tracer *tracer)
{
    if (!tracer)
        return;
    kd_tree_free(&tracer->tree);
    free(tracer->planes);
    free(tracer);
}

const sp_mesh *sp_tracer_mesh(const sp_tracer *tracer) { return tracer->mesh; }

size_t sp_tracer_bytes(const sp_tracer *tracer)
{
    return sizeof *tracer + tracer->tree.node_capacity * sizeof *tracer->tree.nodes +
           tracer->tree.ref_capacity * sizeof *tracer->tree.refs +
           tracer->mesh->triangle_count * sizeof *tracer->planes;
}

/* One ray on its way through the tree. */
typedef struct {
    const sp_tracer *tracer;
    double origin[3], velocity[3], gravity[3];
    double t_min, t_max;
    double margin; /* m */
    bool curved, any; /* any: the first hit found will do */
    uint32_t skip;
    line_shear shear;
    double inverse[3]; /* 1 / velocity */
    sp_hit best;
} walk;

/* Shrinks [*from, *to] to when coordinate `axis` is at most (`sign` 1) or at least (`sign` -1) `bound`, within the margin. */
static inline bool clip(const walk *w, int axis, double bound, double sign, double *from, double *to)
{
    double height = sign * (w->origin[axis] - bound) - w->margin, speed = sign * w->velocity[axis];
    if (w->gravity[axis] != 0)
        return parabola_below(height, speed, sign * w->gravity[axis], from, to);
    if (speed == 0)
        return height <= 0;
    double t = -height * (sign * w->inverse[axis]);
    if (speed > 0)
        *to = lesser(*to, t);
    else
        *from = greater(*from, t);
    return *from <= *to;
}

static bool clip_to_box(const walk *w, double *from, double *to)
{
    for (int axis = 0; axis < 3; axis++)
        if (!clip(w, axis, w->tracer->tree.high[axis], 1, from, to) ||
            !clip(w, axis, w->tracer->tree.low[axis], -1, from, to))
            return false;
    return true;
}

static inline void test_triangle(walk *w, uint32_t triangle)
{
    sp_hit hit = {.triangle = triangle};
    if (triangle == w->skip)
        return;
    if (w->curved) {
        if (!parabola_triangle(&w->tracer->planes[triangle], w->origin, w->velocity, w->gravity, w->t_min, w->t_max,
                               triangle, &hit))
            return;
    } else {
        double corners[3][3];
        corners_of(w->tracer->mesh, triangle, corners);
        if (!line_triangle(&w->shear, w->origin, corners, &hit.t, &hit.u, &hit.v) ||
            !(hit.t > w->t_min && hit.t < w->t_max))
            return;
    }
    if (hit.t < w->best.t || (hit.t == w->best.t && triangle < w->best.triangle))
        w->best = hit;
}

static void test_leaf(walk *w, const kd_node *leaf)
{
    const uint32_t *refs = w->tracer->tree.refs + leaf->first;
    for (uint32_t i = 0; i < leaf->right; i++) {
        test_triangle(w, refs[i]);
        if (w->any && w->best.triangle != SP_NONE)
            return;
    }
}

typedef struct {
    uint32_t node;
    double from, to;
} pending;

/* Nearer cells first; a cell that begins behind the best hit is left out. */
static void walk_tree(walk *w, double from, double to)
{
    const kd_node *nodes = w->tracer->tree.nodes;
    pending stack[KD_DEPTH + 2];
    int depth = 0;
    stack[depth++] = (pending){0, from, to};
    while (depth) {
        pending at = stack[--depth];
        const kd_node *node = &nodes[at.node];
        while (at.from <= w->best.t && node->axis != KD_LEAF) {
            pending left = {(uint32_t)(node - nodes) + 1, at.from, at.to}, right = {node->right, at.from, at.to};
            bool into_left = clip(w, (int)node->axis, node->split, 1, &left.from, &left.to);
            bool into_right = clip(w, (int)node->axis, node->split, -1, &right.from, &right.to);
            if (into_left && into_right) {
                bool left_first = left.from <= right.from;
                stack[depth++] = left_first ? right : left;
                at = left_first ? left : right;
            } else if (into_left || into_right) {
                at = into_left ? left : right;
            } else {
                break;
            }
            node = &nodes[at.node];
        }
        if (at.from <= w->best.t && node->axis == KD_LEAF)
            test_leaf(w, node);
        if (w->any && w->best.triangle != SP_NONE)
            return;
    }
}

/* How far from the origin the flight gets while it is near the mesh: what its rounding errors scale with. */
static double flight_size(const walk *w, const double low[3], const double high[3])
{
    double size = w->tracer->size;
    for (int axis = 0; axis < 3; axis++)
        size = fmax(size, fmax(fabs(w->origin[axis] - low[axis]), fabs(w->origin[axis] - high[axis])));
    return size;
}

static sp_hit trace(const sp_tracer *tracer, const sp_ray *ray, sp_vec3 gravity, bool any)
{
    walk w = {.tracer = tracer,
              .t_min = ray->t_min,
              .t_max = ray->t_max,
              .any = any,
              .skip = ray->skip,
              .best = {INFINITY, 0, 0, SP_NONE}};
    to_array(ray->origin, w.origin);
    to_array(ray->velocity, w.velocity);
    to_array(gravity, w.gravity);
    w.curved = gravity.x != 0 || gravity.y != 0 || gravity.z != 0;
    w.margin = MARGIN * flight_size(&w, tracer->tree.low, tracer->tree.high);
    if (!w.curved)
        w.shear = line_prepare(w.velocity);
    for (int axis = 0; axis < 3; axis++)
        w.inverse[axis] = 1 / w.velocity[axis];
    double from = w.t_min, to = w.t_max;
    if (clip_to_box(&w, &from, &to))
        walk_tree(&w, from, to);
    return w.best;
}

sp_hit sp_trace_nearest(const sp_tracer *tracer, const sp_ray *ray, sp_vec3 gravity)
{
    return trace(tracer, ray, gravity, false);
}

bool sp_trace_occluded(const sp_tracer *tracer, const sp_ray *ray, sp_vec3 gravity)
{
    return trace(tracer, ray, gravity, true).triangle != SP_NONE;
}

void sp_trace_nearest_many(const sp_tracer *tracer, const sp_ray *rays, size_t count, sp_vec3 gravity, int threads,
                           sp_hit *hits)
{
#pragma omp parallel for schedule(dynamic, 1024) num_threads(threads > 0 ? threads : omp_get_max_threads())
    for (size_t i = 0; i < count; i++)
        hits[i] = trace(tracer, &rays[i], gravity, false);
}

void sp_trace_occluded_many(const sp_tracer *tracer, const sp_ray *rays, size_t count, sp_vec3 gravity, int threads,
                            bool *occluded)
{
#pragma omp parallel for schedule(dynamic, 1024) num_threads(threads > 0 ? threads : omp_get_max_threads())
    for (size_t i = 0; i < count; i++)
        occluded[i] = trace(tracer, &rays[i], gravity, true).triangle != SP_NONE;
}
