/* A line upwards from the point crosses each shell as often outwards as inwards, and once more outwards for every time
 * that the shell goes round the point. "Up" is a direction that no drawing uses, and which triangles a line meets is
 * decided in the plane across it, edge by edge, the same for both triangles of an edge: so none is missed or met
 * twice. */
#include "spray/wet/winding.h"

#include <assert.h>
#include <stdlib.h>

#define MOST_BINS 1024 /* along either axis of the plane */
#define HALF_BIN 0.501 /* and some more */

/* Triangles by where they lie in the plane across the lines. */
typedef struct {
    double x, y;
} plane_point;

/* The box around a triangle there: its least x and y, and less its largest, to the nearest in single precision. */
typedef float plane_box __attribute__((vector_size(16)));

struct sp_winding {
    const sp_mesh *mesh;
    plane_point *flat; /* [mesh->vertex_count] */
    const sp_shells *shells;
    sp_vec3 x, y, up;
    double low[2], step[2];
    int bins;
    size_t *start;    /* [bins² + 1] */
    uint32_t *items;  /* triangles of closed shells, each in every bin that it meets */
    plane_box *boxes; /* of the items, together in memory: a bin where shells are finely meshed has hundreds */
};

static plane_point flatten(const sp_winding *winding, sp_vec3 p)
{
    return (plane_point){sp_dot(p, winding->x), sp_dot(p, winding->y)};
}

static int bin_of(const sp_winding *winding, int axis, double value)
{
    double bin = floor((value - winding->low[axis]) / winding->step[axis]);
    return (int)fmin(fmax(bin, 0), winding->bins - 1);
}

/* The bins that a triangle's box meets: columns from[0] to to[0], rows from[1] to to[1]. */
static plane_box bins_of(const sp_winding *winding, uint32_t triangle, int from[2], int to[2])
{
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    for (int k = 0; k < 3; k++) {
        plane_point p = winding->flat[winding->mesh->triangles[triangle][k]];
        low[0] = fmin(low[0], p.x);
        low[1] = fmin(low[1], p.y);
        high[0] = fmax(high[0], p.x);
        high[1] = fmax(high[1], p.y);
    }
    for (int axis = 0; axis < 2; axis++) {
        from[axis] = bin_of(winding, axis, low[axis]);
        to[axis] = bin_of(winding, axis, high[axis]);
    }
    return (plane_box){(float)low[0], (float)low[1], -(float)high[0], -(float)high[1]};
}

static bool is_closed(const sp_winding *winding, uint32_t triangle)
{
    return winding->shells->closed[winding->shells->of[triangle]];
}

/* Lays the bins over the closed shells; returns how many triangles they have. */
static size_t lay_bins(sp_winding *winding)
{
    double high[2] = {-INFINITY, -INFINITY};
    size_t count = 0;
    winding->low[0] = winding->low[1] = INFINITY;
    for (uint32_t t = 0; t < winding->mesh->triangle_count; t++) {
        if (!is_closed(winding, t))
            continue;
        count++;
        for (int k = 0; k < 3; k++) {
            plane_point p = winding->flat[winding->mesh->triangles[t][k]];
            winding->low[0] = fmin(winding->low[0], p.x);
            winding->low[1] = fmin(winding->low[1], p.y);
            high[0] = fmax(high[0], p.x);
            high[1] = fmax(high[1], p.y);
        }
    }
    winding->bins = (int)fmin(fmax(sqrt((double)count), 1), MOST_BINS);
    for (int axis = 0; axis < 2; axis++)
        winding->step[axis] = count ? fmax((high[axis] - winding->low[axis]) / winding->bins, 1e-300) : 1;
    return count;
}

/* The edges of a triangle as the bins see them: normal·p <= most for what it holds of a bin, p being the bin's middle.
 * Bins are taken for a little larger than they are, so that round-off leaves out none. */
typedef struct {
    plane_point normal[3];
    double most[3];
} bin_sieve;

static bin_sieve sieve_of(const sp_winding *winding, uint32_t triangle)
{
    plane_point corner[3];
    bin_sieve sieve;
    for (int k = 0; k < 3; k++)
        corner[k] = winding->flat[winding->mesh->triangles[triangle][k]];
    double area = (corner[1].x - corner[0].x) * (corner[2].y - corner[0].y) -
                  (corner[1].y - corner[0].y) * (corner[2].x - corner[0].x);
    double way = (area > 0) - (area < 0);
    for (int k = 0; k < 3; k++) {
        plane_point from = corner[k], to = corner[(k + 1) % 3];
        sieve.normal[k] = (plane_point){way * (to.y - from.y), way * (from.x - to.x)};
        sieve.most[k] =
            sieve.normal[k].x * from.x + sieve.normal[k].y * from.y +
            HALF_BIN * (fabs(sieve.normal[k].x) * winding->step[0] + fabs(sieve.normal[k].y) * winding->step[1]);
    }
    return sieve;
}

static bool falls_in(const sp_winding *winding, const bin_sieve *sieve, int column, int row)
{
    double x = winding->low[0] + (column + 0.5) * winding->step[0];
    double y = winding->low[1] + (row + 0.5) * winding->step[1];
    for (int k = 0; k < 3; k++)
        if (sieve->normal[k].x * x + sieve->normal[k].y * y > sieve->most[k])
            return false;
    return true;
}

static void fill_bins(sp_winding *winding, bool counting)
{
    for (uint32_t t = 0; t < winding->mesh->triangle_count; t++) {
        if (!is_closed(winding, t))
            continue;
        int from[2], to[2];
        plane_box box = bins_of(winding, t, from, to);
        bin_sieve sieve = sieve_of(winding, t);
        for (int row = from[1]; row <= to[1]; row++)
            for (int column = from[0]; column <= to[0]; column++) {
                size_t bin = (size_t)row * (size_t)winding->bins + (size_t)column;
                if (!falls_in(winding, &sieve, column, row))
                    continue;
                if (counting) {
                    winding->start[bin + 1]++;
                    continue;
                }
                winding->boxes[winding->start[bin]] = box;
                winding->items[winding->start[bin]++] = t;
            }
    }
}

sp_winding *sp_winding_create(const sp_mesh *mesh, const sp_shells *shells, sp_error *error)
{
    sp_winding *winding = calloc(1, sizeof *winding);
    if (!winding)
        return sp_fail_memory(error);
    winding->mesh = mesh;
    winding->shells = shells;
    winding->up = sp_unit(sp_v(0.2113248654, 0.3482817191, 0.9132604871));
    winding->x = sp_unit(sp_cross(sp_v(0.8191725134, 0.5735764364, 0.1036482177), winding->up));
    winding->y = sp_cross(winding->up, winding->x);
    winding->flat = malloc((mesh->vertex_count + 1) * sizeof *winding->flat);
    if (!winding->flat) {
        sp_winding_destroy(winding);
        return sp_fail_memory(error);
    }
    for (size_t i = 0; i < mesh->vertex_count; i++)
        winding->flat[i] = flatten(winding, mesh->vertices[i]);
    lay_bins(winding);
    size_t bins = (size_t)winding->bins * (size_t)winding->bins;
    winding->start = calloc(bins + 2, sizeof *winding->start);
    if (winding->start) {
        fill_bins(winding, true);
        for (size_t i = 0; i < bins; i++)
            winding->start[i + 1] += winding->start[i];
        winding->items = malloc((winding->start[bins] + 1) * sizeof *winding->items);
        winding->boxes = malloc((winding->start[bins] + 1) * sizeof *winding->boxes);
    }
    if (!winding->items || !winding->boxes) {
        sp_winding_destroy(winding);
        return sp_fail_memory(error);
    }
    fill_bins(winding, false);
    /* what was counted was filled in */
    assert(winding->start[bins - 1] == winding->start[bins]);
    for (size_t i = bins; i > 0; i--) /* filling moved each start to the next one's */
        winding->start[i] = winding->start[i - 1];
    winding->start[0] = 0;
    return winding;
}

void sp_winding_destroy(sp_winding *winding)
{
    if (!winding)
        return;
    free(winding->flat);
    free(winding->start);
    free(winding->items);
    free(winding->boxes);
    free(winding);
}

/* Whether p lies on the left of the edge from corner a to corner b. The lower corner is always taken first, so that the
 * two triangles of an edge never agree. */
static bool on_left(const sp_winding *winding, uint32_t a, uint32_t b, plane_point p)
{
    bool swapped = a > b;
    plane_point from = winding->flat[swapped ? b : a], to = winding->flat[swapped ? a : b];
    bool left = (to.x - from.x) * (p.y - from.y) - (to.y - from.y) * (p.x - from.x) > 0;
    return left != swapped;
}

/* 1 where the line upwards from the point leaves what the triangle bounds, -1 where it enters, 0 where they do not
 * meet. */
static int crossing(const sp_winding *winding, uint32_t triangle, sp_vec3 point, plane_point p)
{
    const uint32_t *corner = winding->mesh->triangles[triangle];
    plane_point first = winding->flat[corner[0]], second = winding->flat[corner[1]], third = winding->flat[corner[2]];
    if ((first.x < p.x && second.x < p.x && third.x < p.x) || (first.x > p.x && second.x > p.x && third.x > p.x) ||
        (first.y < p.y && second.y < p.y && third.y < p.y) || (first.y > p.y && second.y > p.y && third.y > p.y))
        return 0;
    bool left = on_left(winding, corner[0], corner[1], p);
    if (on_left(winding, corner[1], corner[2], p) != left || on_left(winding, corner[2], corner[0], p) != left)
        return 0;
    const sp_vec3 *vertices = winding->mesh->vertices;
    sp_vec3 a = vertices[corner[0]];
    sp_vec3 normal = sp_cross(sp_sub(vertices[corner[1]], a), sp_sub(vertices[corner[2]], a));
    double height = sp_dot(normal, sp_sub(a, point));
    int way = left ? 1 : -1;
    return height * way > 0 ? way : 0;
}

/* Whether a place lies outside of a box; never where it does not, as rounding keeps the order of numbers. */
static inline bool is_out(const plane_box *box, const plane_box *place)
{
    __extension__ typedef long long halves __attribute__((vector_size(16)));
    halves below = (halves)(*place < *box);
    return (below[0] | below[1]) != 0;
}

static int add_crossings(const sp_winding *winding, sp_vec3 point, uint32_t only, uint32_t except)
{
    plane_point p = flatten(winding, point);
    plane_box place = {(float)p.x, (float)p.y, -(float)p.x, -(float)p.y};
    size_t row = (size_t)bin_of(winding, 1, p.y), column = (size_t)bin_of(winding, 0, p.x);
    size_t bin = row * (size_t)winding->bins + column;
    int sum = 0;
    for (size_t i = winding->start[bin]; i < winding->start[bin + 1]; i++) {
        if (is_out(&winding->boxes[i], &place))
            continue;
        uint32_t triangle = winding->items[i], shell = winding->shells->of[triangle];
        if (shell == except || (only != SP_NONE && shell != only))
            continue;
        int turn = only != SP_NONE ? 1 : winding->shells->turn[shell];
        sum += turn * crossing(winding, triangle, point, p);
    }
    return sum;
}

int sp_winding_at(const sp_winding *winding, sp_vec3 point)
{
    return add_crossings(winding, point, SP_NONE, SP_NONE);
}

int sp_winding_of(const sp_winding *winding, sp_vec3 point, uint32_t shell)
{
    return add_crossings(winding, point, shell, SP_NONE);
}

int sp_winding_without(const sp_winding *winding, sp_vec3 point, uint32_t shell)
{
    return add_crossings(winding, point, SP_NONE, shell);
}
