/* Answers computed in double precision, many at a time. For the kernels, which are compiled once for each set of
 * instructions. */
#ifndef SPRAYPLAN_TRACE_ANSWER_H
#define SPRAYPLAN_TRACE_ANSWER_H

#include "trace/line/line_bvh.h"

enum { SP_ANSWERS = 32 };

/* Lines and the triangles that they surely hit. */
typedef struct {
    const sp_bvh *bvh;
    const sp_ray *rays;
    sp_hit *hits;
    int count;
    uint32_t ray[SP_ANSWERS], triangle[SP_ANSWERS], z[SP_ANSWERS];
} answers;

/* What the test in line.c and barycentric.h makes of them, all lanes at once: a compiler sees vectors in these loops,
 * and every operation is the one of line.c, so that the bits are. All by the line's axes x, y, z. */
typedef struct {
    double origin[3][SP_ANSWERS], velocity[3][SP_ANSWERS];
    double corner[3][3][SP_ANSWERS]; /* [corner][axis] */
    double t[SP_ANSWERS], u[SP_ANSWERS], v[SP_ANSWERS];
    double plain[SP_ANSWERS]; /* no sliver */
} answer_lanes;

static inline void start_answers(answers *a, const sp_bvh *bvh, const sp_ray *rays, sp_hit *hits)
{
    a->bvh = bvh;
    a->rays = rays;
    a->hits = hits;
    a->count = 0;
}

static inline void gather_lines(const answers *a, answer_lanes *l)
{
    for (int i = 0; i < a->count; i++) {
        const sp_ray *ray = &a->rays[a->ray[i]];
        uint32_t z = a->z[i], x = z == 2 ? 0 : z + 1, y = z == 0 ? 2 : z - 1;
        const double *origin = &ray->origin.x, *velocity = &ray->velocity.x;
        l->origin[0][i] = origin[x];
        l->origin[1][i] = origin[y];
        l->origin[2][i] = origin[z];
        l->velocity[0][i] = velocity[x];
        l->velocity[1][i] = velocity[y];
        l->velocity[2][i] = velocity[z];
    }
}

/* Idle lanes repeat the first. */
static inline void gather_corners(const answers *a, answer_lanes *l)
{
    const sp_mesh *mesh = a->bvh->mesh;
    for (int i = 0; i < (a->count + 7) / 8 * 8; i++) {
        int from = i < a->count ? i : 0;
        const uint32_t *vertex = mesh->triangles[a->triangle[from]];
        uint32_t z = a->z[from], x = z == 2 ? 0 : z + 1, y = z == 0 ? 2 : z - 1;
        for (int k = 0; k < 3; k++) {
            const double *corner = &mesh->vertices[vertex[k]].x;
            l->corner[k][0][i] = corner[x];
            l->corner[k][1][i] = corner[y];
            l->corner[k][2][i] = corner[z];
        }
    }
    for (int i = a->count; i < (a->count + 7) / 8 * 8; i++)
        for (int k = 0; k < 3; k++) {
            l->origin[k][i] = l->origin[k][0];
            l->velocity[k][i] = l->velocity[k][0];
        }
}

static inline void compute_answers(answer_lanes *l, int count)
{
    for (int i = 0; i < (count + 7) / 8 * 8; i++) {
        double shear_x = l->velocity[0][i] / l->velocity[2][i], shear_y = l->velocity[1][i] / l->velocity[2][i];
        double inverse_z = 1 / l->velocity[2][i], x[3], y[3], z[3];
        for (int k = 0; k < 3; k++) {
            z[k] = l->corner[k][2][i] - l->origin[2][i];
            x[k] = l->corner[k][0][i] - l->origin[0][i] - shear_x * z[k];
            y[k] = l->corner[k][1][i] - l->origin[1][i] - shear_y * z[k];
        }
        double w0 = x[2] * y[1] - y[2] * x[1], w1 = x[0] * y[2] - y[0] * x[2], w2 = x[1] * y[0] - y[1] * x[0];
        double sum = w0 + w1 + w2;
        double reach =
            sp_greater(sp_greater(fabs(x[0]) + fabs(y[0]), fabs(x[1]) + fabs(y[1])), fabs(x[2]) + fabs(y[2]));
        l->plain[i] = fabs(sum) > 0x1p-8 * reach * reach ? 1 : 0;
        l->t[i] = (w0 * z[0] + w1 * z[1] + w2 * z[2]) / sum * inverse_z;
        l->u[i] = w1 / sum;
        l->v[i] = w2 / sum;
    }
}

/* Writes the hits of lines that have been gathered. */
static inline void finish_answers(answers *a, answer_lanes *l)
{
    gather_corners(a, l);
    compute_answers(l, a->count);
    for (int i = 0; i < a->count; i++) {
        uint32_t ray = a->ray[i], triangle = a->triangle[i];
        if (l->plain[i] != 0)
            a->hits[ray] = (sp_hit){l->t[i], l->u[i], l->v[i], triangle};
        else
            a->hits[ray] = sp_bvh_line_ask(a->bvh, &a->rays[ray], triangle);
    }
    a->count = 0;
}

static inline void give_answers(answers *a)
{
    answer_lanes l;
    if (a->count == 0)
        return;
    for (int i = 0; i < a->count; i++)
        sp_bvh_prefetch_corners(a->bvh, a->triangle[i]);
    gather_lines(a, &l);
    finish_answers(a, &l);
}

static inline void note_answer(answers *a, uint32_t ray, uint32_t triangle, uint32_t z)
{
    a->ray[a->count] = ray;
    a->triangle[a->count] = triangle;
    a->z[a->count++] = z;
}

#endif
