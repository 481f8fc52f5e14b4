#include "atlas/texels/borders.h"
#include "mesh/cracks.h"
#include "mesh/min_max.h"
#include "atlas/texels/texels.h"

#include <math.h>
#include <stdlib.h>

#define BESIDE 0.01 /* pixels: an edge nearer than this to a border of pixels may run along it */

typedef struct {
    const sp_atlas *atlas;
    const sp_mesh *mesh;
    const bool *asked;      /* [charts] */
    const sp_vec3 *normals; /* [triangles] */
    sp_border_visitor *visit;
    void *user;
    sp_cracks cracks;
} walk;

/* One triangle on its page, and how far one goes on the surface for a pixel along x and along y. */
typedef struct {
    const walk *walk;
    uint32_t triangle;
    const double (*uv)[2];
    sp_vec3 along[2], normal;
    double height, across[2]; /* of the border of pixels along x that was met last; where that cuts the triangle */
} sheet;

/* From where to where the line on which coordinate `k` is `at` lies in the triangle; nowhere from above to. */
static void cut_line(const double (*uv)[2], int k, double at, double cut[2])
{
    double from = INFINITY, to = -INFINITY;
    for (int i = 0; i < 3; i++) {
        const double *p = uv[i], *q = uv[(i + 1) % 3];
        if ((p[k] < at) == (q[k] < at))
            continue;
        double there = p[1 - k] + (at - p[k]) / (q[k] - p[k]) * (q[1 - k] - p[1 - k]);
        from = sp_lesser(from, there);
        to = sp_greater(to, there);
    }
    cut[0] = from;
    cut[1] = to;
}

/* What of that lies within [low, low + 1]; 0 for none. */
static double length_within(const double cut[2], double low)
{
    return sp_greater(0, sp_lesser(cut[1], low + 1) - sp_greater(cut[0], low));
}

/* The border between pixel x, y and the next one along x or, `above`, along y. */
static bool visit_between(void *user, uint32_t a, uint32_t b, uint32_t x, uint32_t y, bool above)
{
    sheet *s = user;
    if (a == b)
        return true;
    double upwards[2];
    if (!above) {
        cut_line(s->uv, 0, x + 1.0, upwards);
    } else if (s->height != y + 1.0) {
        s->height = y + 1.0;
        cut_line(s->uv, 1, s->height, s->across);
    }
    double length = above ? length_within(s->across, x) : length_within(upwards, y);
    if (!(length > 0))
        return true;
    sp_vec3 step = sp_scale(s->along[above ? 0 : 1], length);
    sp_vec3 outward = above ? sp_cross(s->normal, step) : sp_cross(step, s->normal);
    sp_border border = {.texel = {a, b},
                        .triangle = {s->triangle, s->triangle},
                        .outward = {outward, sp_scale(outward, -1)},
                        .on_front = true,
                        .on_back = true};
    return s->walk->visit(s->walk->user, &border);
}

static bool is_in_one_pixel(const double (*uv)[2])
{
    for (int k = 0; k < 2; k++)
        if (floor(uv[0][k]) != floor(uv[1][k]) || floor(uv[0][k]) != floor(uv[2][k]))
            return false;
    return true;
}

static bool visit_inside(const walk *w, uint32_t triangle, sp_pieces *pieces)
{
    const double(*uv)[2] = (const double(*)[2])w->atlas->uv[triangle];
    if (!w->asked[w->atlas->chart[triangle]] || is_in_one_pixel(uv))
        return true;
    double u[2] = {uv[1][0] - uv[0][0], uv[1][1] - uv[0][1]}, v[2] = {uv[2][0] - uv[0][0], uv[2][1] - uv[0][1]};
    double twice = u[0] * v[1] - u[1] * v[0];
    if (!(twice > 0))
        return true;
    const sp_vec3 *at = w->mesh->vertices;
    const uint32_t *corner = w->mesh->triangles[triangle];
    sp_vec3 first = sp_sub(at[corner[1]], at[corner[0]]), second = sp_sub(at[corner[2]], at[corner[0]]);
    sheet s = {w, triangle, uv, .normal = w->normals[triangle], .height = -1};
    s.along[0] = sp_along(sp_scale(first, v[1] / twice), -u[1] / twice, second);
    s.along[1] = sp_along(sp_scale(first, -v[0] / twice), u[0] / twice, second);
    return sp_pieces_sides(pieces, w->atlas, triangle, visit_between, &s);
}

/* One triangle at an edge, as it is met on the way about it. */
typedef struct {
    uint32_t half_edge;
    double angle;
    bool ahead; /* its front faces what comes next */
} leaf;

static int by_angle(const void *left, const void *right)
{
    const leaf *a = left, *b = right;
    if (a->angle != b->angle)
        return a->angle < b->angle ? -1 : 1;
    return (a->half_edge > b->half_edge) - (a->half_edge < b->half_edge);
}

static sp_vec3 point_on(const sp_mesh *mesh, uint32_t half_edge, double part)
{
    sp_vec3 from = mesh->vertices[sp_half_edge_from(mesh, half_edge)];
    return sp_along(from, part, sp_sub(mesh->vertices[sp_half_edge_to(mesh, half_edge)], from));
}

static sp_vec3 step_of(const sp_mesh *mesh, uint32_t half_edge)
{
    return sp_sub(mesh->vertices[sp_half_edge_to(mesh, half_edge)], mesh->vertices[sp_half_edge_from(mesh, half_edge)]);
}

/* Sorts the triangles of an edge about the first of them. */
static void sort_leaves(const walk *w, const uint32_t *half_edges, size_t count, leaf *leaves)
{
    const sp_mesh *mesh = w->mesh;
    sp_vec3 edge = sp_unit(step_of(mesh, half_edges[0])), x = {0}, y = {0};
    for (size_t i = 0; i < count; i++) {
        sp_vec3 normal = w->normals[half_edges[i] / 3];
        sp_vec3 into = sp_unit(sp_cross(normal, step_of(mesh, half_edges[i])));
        if (i == 0) {
            x = into;
            y = sp_cross(edge, into);
        }
        double angle = i == 0 ? 0 : atan2(sp_dot(into, y), sp_dot(into, x));
        leaves[i] =
            (leaf){half_edges[i], angle < 0 ? angle + 2 * M_PI : angle, sp_dot(normal, sp_cross(edge, into)) > 0};
    }
    qsort(leaves, count, sizeof *leaves, by_angle);
}

/* What two triangles share of an edge, from one texel to the next; `a` is `b` where the surface ends. */
typedef struct {
    const walk *walk;
    sp_edge_walk *edge;
    uint32_t a, b;
    sp_vec3 out_of_a, out_of_b; /* along the whole way */
} fold;

static fold fold_of(const walk *w, sp_edge_walk *edge, uint32_t a, uint32_t b)
{
    return (fold){w,
                  edge,
                  a,
                  b,
                  sp_cross(step_of(w->mesh, a), w->normals[a / 3]),
                  sp_cross(step_of(w->mesh, b), w->normals[b / 3])};
}

/* The piece that the walk is at; the border says on which sides. */
static bool visit_piece(const fold *f, sp_border border)
{
    const sp_edge_walk *edge = f->edge;
    double part = edge->to - edge->from;
    bool ends = f->a == f->b;
    if (!ends && edge->texel_a == edge->texel_b)
        return true;
    border.texel[0] = edge->texel_a;
    border.texel[1] = ends ? SP_NONE : edge->texel_b;
    border.triangle[0] = f->a / 3;
    border.triangle[1] = f->b / 3;
    border.outward[0] = sp_scale(f->out_of_a, part);
    border.outward[1] = sp_scale(f->out_of_b, part);
    if (ends) {
        double start = edge->way[0][0], length = edge->way[0][1] - start;
        border.at[0] = point_on(f->walk->mesh, f->a, start + edge->from * length);
        border.at[1] = point_on(f->walk->mesh, f->a, start + edge->to * length);
    }
    return f->walk->visit(f->walk->user, &border);
}

/* True where the two triangles of an edge lie side by side on the page, in one face: they share all texels that it
 * crosses, unless it runs along a border of pixels. */
static bool is_inside(const walk *w, uint32_t a, uint32_t b)
{
    double p[2], q[2];
    if (a == b || !sp_edge_is_opposite(w->mesh, a, b) || sp_edge_is_cut(w->atlas, w->mesh, a, b) ||
        sp_edge_is_crease(w->mesh, a, b))
        return false;
    sp_edge_point(w->atlas, a, 0, p);
    sp_edge_point(w->atlas, a, 1, q);
    for (int k = 0; k < 2; k++) {
        double border = floor(p[k] + 0.5);
        if (fabs(p[k] - border) < BESIDE && fabs(q[k] - border) < BESIDE)
            return false;
    }
    return true;
}

/* An edge of one triangle or two: both sides go on, or end, at once. */
static bool visit_plain(const walk *w, sp_edge_walk *edge, uint32_t a, uint32_t b)
{
    if (is_inside(w, a, b))
        return true;
    fold f = fold_of(w, edge, a, b);
    sp_border both = {.on_front = true, .on_back = true, .turned = a != b && !sp_edge_is_opposite(w->mesh, a, b)};
    if (!sp_edge_walk_begin(edge, w->atlas, w->mesh, a, b))
        return false;
    while (sp_edge_walk_next(edge, w->atlas))
        if (!visit_piece(&f, both))
            return false;
    return true;
}

/* From the side of one triangle that faces ahead to the side of the next that faces back. */
static bool visit_leaf(const walk *w, sp_edge_walk *edge, const leaf *own, const leaf *next)
{
    fold f = fold_of(w, edge, own->half_edge, next->half_edge);
    sp_border ahead = {.on_front = own->ahead, .on_back = !own->ahead, .turned = own->ahead == next->ahead};
    if (!sp_edge_walk_begin(edge, w->atlas, w->mesh, f.a, f.b))
        return false;
    while (sp_edge_walk_next(edge, w->atlas))
        if (!visit_piece(&f, ahead))
            return false;
    return true;
}

/* Parts of an open edge: they end the surface, where `a` is `b`, or lie at a crack. */
static bool visit_part(const walk *w, sp_edge_walk *edge, uint32_t a, const double on_a[2], uint32_t b,
                       const double on_b[2])
{
    fold f = fold_of(w, edge, a, b);
    f.out_of_a = sp_scale(f.out_of_a, on_a[1] - on_a[0]);
    f.out_of_b = sp_scale(f.out_of_b, fabs(on_b[1] - on_b[0]));
    sp_border both = {.on_front = true, .on_back = true, .turned = a != b && on_b[0] < on_b[1]};
    if (!sp_edge_walk_begin_on(edge, w->atlas, a, on_a, b, on_b))
        return false;
    while (sp_edge_walk_next(edge, w->atlas))
        if (!visit_piece(&f, both))
            return false;
    return true;
}

static bool is_asked(const walk *w, const uint32_t *half_edges, size_t count)
{
    bool any = false;
    for (size_t i = 0; i < count; i++)
        any = any || w->asked[w->atlas->chart[half_edges[i] / 3]];
    return any;
}

/* An open edge with cracks, at sides [first] up to `end` of these: each is visited with the first of its half-edges. */
static bool visit_cracked(const walk *w, sp_edge_walk *edge, uint32_t half_edge, size_t first, size_t end)
{
    bool own = is_asked(w, &half_edge, 1), done = true;
    double rest[2] = {0, 0};
    for (size_t i = first; done && i <= end; i++) {
        rest[1] = i < end ? w->cracks.sides[i].from : 1;
        if (own && rest[0] < rest[1])
            done = visit_part(w, edge, half_edge, rest, half_edge, rest);
        if (i == end)
            break;
        const sp_crack *crack = &w->cracks.cracks[w->cracks.sides[i].crack];
        if (done && crack->half_edge[0] == half_edge && is_asked(w, crack->half_edge, 2))
            done = visit_part(w, edge, half_edge, crack->part[0], crack->half_edge[1], crack->part[1]);
        rest[0] = w->cracks.sides[i].to;
    }
    return done;
}

static bool visit_leaves(const walk *w, sp_edge_walk *edge, const uint32_t *half_edges, size_t count, leaf *leaves)
{
    if (count <= 2)
        return visit_plain(w, edge, half_edges[0], half_edges[count - 1]);
    sort_leaves(w, half_edges, count, leaves);
    for (size_t k = 0; k < count; k++)
        if (!visit_leaf(w, edge, &leaves[k], &leaves[(k + 1) % count]))
            return false;
    return true;
}

static bool visit_edge(const walk *w, sp_edge_walk *edge, const uint32_t *half_edges, size_t count, leaf *leaves)
{
    size_t first = 0, end = count == 1 ? sp_cracks_on(&w->cracks, half_edges[0], &first) : 0;
    if (count == 1 && first < end)
        return visit_cracked(w, edge, half_edges[0], first, end);
    return !is_asked(w, half_edges, count) || visit_leaves(w, edge, half_edges, count, leaves);
}

static bool visit_edges(walk *w, double crack, sp_error *error)
{
    sp_half_edges edges = {0};
    sp_edge_walk edge = {0};
    leaf *leaves = malloc((3 * w->mesh->triangle_count + 1) * sizeof *leaves);
    bool done = leaves && sp_half_edges_create(w->mesh, &edges, error) &&
                sp_cracks_find(w->mesh, &edges, crack, &w->cracks, error);
    for (size_t i = 0, of_edge; done && i < 3 * w->mesh->triangle_count; i += of_edge) {
        of_edge = sp_half_edges_of_edge(w->mesh, &edges, i);
        done = visit_edge(w, &edge, &edges.order[i], of_edge, leaves);
    }
    sp_edge_walk_free(&edge);
    sp_half_edges_destroy(&edges);
    sp_cracks_free(&w->cracks);
    free(leaves);
    return done;
}

bool sp_atlas_visit_borders(const sp_atlas *atlas, const sp_mesh *mesh, double crack, const bool *asked,
                            const sp_vec3 *normals, sp_border_visitor *visit, void *user, sp_error *error)
{
    walk w = {atlas, mesh, asked, normals, visit, user, {0}};
    sp_pieces pieces = {0};
    bool done = true;
    for (uint32_t t = 0; done && t < mesh->triangle_count; t++)
        done = visit_inside(&w, t, &pieces);
    done = done && visit_edges(&w, crack, error);
    sp_pieces_free(&pieces);
    return done || sp_fail_memory(error);
}
