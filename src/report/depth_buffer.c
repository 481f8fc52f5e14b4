/* Triangles are scan-converted in homogeneous coordinates (M. Olano, T. Greer: Triangle scan conversion using 2D
 * homogeneous coordinates, Graphics Hardware 1997): the sign of the edges' functions decides, which needs no clipping
 * where a triangle reaches behind the eye, and leaves no gap between neighbours, whose functions of their common edge
 * are each other's negative to the last bit. */
#include "depth_buffer.h"

#include <stdlib.h>

#define BAND 64    /* rows that one thread fills at a time */
#define ROUND 1e-3 /* samples; how far projected corners may be off */
#define STEEP 1e-9 /* an edge that crosses its row at less than this share of its function's size clips nothing */

/* What all triangles have in common. */
typedef struct {
    const sp_mesh *mesh;
    const sp_camera *camera;
    double from; /* m; nearer is cut off */
    int columns, rows;
    sp_look_at *look;
    const void *user;
} view;

/* Those that a triangle may show on; none if first > last. */
typedef struct {
    int first, last;
} rows;

/* One triangle as the eye has it: x to the right, y upwards, z forward. */
typedef struct {
    double edge[3][3]; /* across from each corner; its product with a direction is not negative inside */
    double depth[3];   /* of the corners, m */
    rows rows;
    int back; /* which side is seen */
} footprint;

static void cross(const double a[3], const double b[3], double c[3])
{
    for (int k = 0; k < 3; ++k) {
        int i = (k + 1) % 3, j = (k + 2) % 3;
        c[k] = a[i] * b[j] - a[j] * b[i];
    }
}

static double column_of(const view *v, double x)
{
    return ((x - v->camera->shift_x) / v->camera->reach_x + 1) * (0.5 * v->columns) - 0.5;
}

static double row_of(const view *v, double y)
{
    return (1 - (y - v->camera->shift_y) / v->camera->reach_y) * (0.5 * v->rows) - 0.5;
}

static double x_at(const view *v, int column)
{
    return v->camera->shift_x + (2 * (column + 0.5) / v->columns - 1) * v->camera->reach_x;
}

static double y_at(const view *v, int row)
{
    return v->camera->shift_y + (1 - 2 * (row + 0.5) / v->rows) * v->camera->reach_y;
}

/* The rows that the corners span, all of them where one lies beside or behind the eye; false for none, or where all
 * columns are missed. */
static bool find_rows(const view *v, const double corner[3][3], footprint *f)
{
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    f->rows.first = 0;
    f->rows.last = v->rows - 1;
    for (int k = 0; k < 3; ++k) {
        if (!(corner[k][2] > 0))
            return true;
        const double at[2] = {column_of(v, corner[k][0] / corner[k][2]), row_of(v, corner[k][1] / corner[k][2])};
        for (int i = 0; i < 2; ++i) {
            low[i] = fmin(low[i], at[i] - ROUND);
            high[i] = fmax(high[i], at[i] + ROUND);
        }
    }
    f->rows.first = (int)ceil(fmin(fmax(low[1], 0), v->rows));
    f->rows.last = (int)floor(fmax(fmin(high[1], v->rows - 1), -1));
    return f->rows.first <= f->rows.last && ceil(fmax(low[0], 0)) <= floor(fmin(high[0], v->columns - 1));
}

/* False where no sample shows it. */
static bool project(const view *v, uint32_t triangle, footprint *f)
{
    double corner[3][3];
    for (int k = 0; k < 3; ++k) {
        sp_vec3 p = sp_sub(v->mesh->vertices[v->mesh->triangles[triangle][k]], v->camera->eye);
        corner[k][0] = sp_dot(p, v->camera->right);
        corner[k][1] = sp_dot(p, v->camera->up);
        corner[k][2] = f->depth[k] = sp_dot(p, v->camera->forward);
    }
    if (!(fmax(fmax(f->depth[0], f->depth[1]), f->depth[2]) > v->from) || !find_rows(v, corner, f))
        return false;
    for (int k = 0; k < 3; ++k)
        cross(corner[(k + 1) % 3], corner[(k + 2) % 3], f->edge[k]);
    double turn = corner[0][0] * f->edge[0][0] + corner[0][1] * f->edge[0][1] + corner[0][2] * f->edge[0][2];
    f->back = turn < 0; /* right, up and forward are left-handed */
    for (int k = 0; k < 9 && f->back; ++k)
        f->edge[k / 3][k % 3] *= -1;
    return turn != 0;
}

/* The columns of a row that may be inside; widened by one, as the edges' signs decide. */
static void find_columns(const view *v, const footprint *f, const double base[3], int *first, int *last)
{
    double low = 0, high = v->columns - 1;
    for (int k = 0; k < 3; ++k) {
        const double *edge = f->edge[k];
        if (!(fabs(edge[0]) > STEEP * (fabs(edge[1]) + fabs(edge[2]))))
            continue;
        double column = column_of(v, -base[k] / edge[0]);
        if (edge[0] > 0)
            low = fmax(low, column - 1);
        else
            high = fmin(high, column + 1);
    }
    *first = (int)ceil(fmin(low, v->columns));
    *last = (int)floor(fmax(high, -1));
}

static void fill_row(const view *v, const footprint *f, uint32_t triangle, int row, sp_depth_sample *samples)
{
    double base[3], y = y_at(v, row);
    for (int k = 0; k < 3; ++k)
        base[k] = f->edge[k][2] + y * f->edge[k][1];
    int first, last;
    find_columns(v, f, base, &first, &last);
    for (int column = first; column <= last; ++column) {
        double x = x_at(v, column), e[3];
        for (int k = 0; k < 3; ++k)
            e[k] = base[k] + x * f->edge[k][0];
        double sum = e[0] + e[1] + e[2];
        if (!(e[0] >= 0 && e[1] >= 0 && e[2] >= 0 && sum > 0))
            continue;
        double depth = (e[0] * f->depth[0] + e[1] * f->depth[1] + e[2] * f->depth[2]) / sum;
        if (!(depth > v->from && depth < samples[column].depth))
            continue;
        uint32_t look = v->look(v->user, triangle, e[1] / sum, e[2] / sum, f->back);
        if (look != SP_LOOK_NOTHING)
            samples[column] = (sp_depth_sample){depth, triangle, look};
    }
}

static void fill_band(const view *v, const rows *range, int top, sp_depth_sample *samples)
{
    int bottom = top + BAND < v->rows ? top + BAND : v->rows;
    for (size_t k = (size_t)top * (size_t)v->columns; k < (size_t)bottom * (size_t)v->columns; ++k)
        samples[k] = (sp_depth_sample){INFINITY, SP_NONE, SP_LOOK_NOTHING};
    for (size_t t = 0; t < v->mesh->triangle_count; ++t) {
        footprint f;
        if (range[t].first >= bottom || range[t].last < top || !project(v, (uint32_t)t, &f))
            continue;
        for (int row = f.rows.first > top ? f.rows.first : top; row <= f.rows.last && row < bottom; ++row)
            fill_row(v, &f, (uint32_t)t, row, &samples[(size_t)row * (size_t)v->columns]);
    }
}

bool sp_depth_buffer_fill(sp_depth_sample *samples, const sp_mesh *mesh, const sp_camera *camera, sp_look_at *look,
                          const void *user, int threads, sp_error *error)
{
    double from = camera->cut ? sp_dot(sp_sub(camera->centre, camera->eye), camera->forward) : 0;
    const view v = {mesh, camera, from, 2 * camera->width, 2 * camera->height, look, user};
    rows *range = malloc((mesh->triangle_count + 1) * sizeof *range);
    if (!range)
        return sp_fail_memory(error);
#pragma omp parallel num_threads(threads)
    {
#pragma omp for
        for (size_t t = 0; t < mesh->triangle_count; ++t) {
            footprint f;
            range[t] = project(&v, (uint32_t)t, &f) ? f.rows : (rows){0, -1};
        }
#pragma omp for schedule(dynamic)
        for (int top = 0; top < v.rows; top += BAND)
            fill_band(&v, range, top, samples);
    }
    free(range);
    return true;
}
