/* That a way is free, or blocked, is proved for all flights to a piece of surface at once, lines and parabolas.
 *
 * Free: every triangle near the shaft has to be told apart from it by a plane, in one of three ways (Haines and
 * Wallace, Shaft culling for efficient ray-cast radiosity, 1991, with a curtain of flights over each line).
 *  - By its own plane, with height h(s) = (1 - s) h(from) + s h(p) + k n·up over it along a flight. With h(p) >= 0 and
 *    h(from) > rise max(0, -n·up) that is above 0 for all s < 1, since k <= rise s (1 - s).
 *  - By the plane of the face that the flight ends in, when the triangle lies behind that, and the height over it stays
 *    above 0 likewise.
 *  - By a plane through `from`, with the triangle on the side m·x >= 0. All flights are on the other where
 *    m·way + |m| radius + lift max(0, m·up) < 0: k <= lift s holds from s = 1 - lift/rise on, and where the triangle
 *    begins farther on than that, this is all that matters.
 *
 * Blocked: flights change steadily with where they end and with gravity, from a line to its parabola. A triangle that
 * has `from` on one side of its plane and all of the piece on the other is met by the plane of each of them once. So
 * from a triangle that the line to the middle meets, what is met goes from triangle to triangle over shared edges, as
 * long as no edge within the shaft is one of a single triangle, or one at which the surface folds back as flights see
 * it: where every flight across the edge has both triangles on different sides. At x a parabola flies along
 * x - from - k up, with k = g t²/2 <= rise, and a line with k = 0; that side is linear in k. */
#include "shaft.h"

#define SHEET_MOST 256 /* triangles of a sheet that blocks */
#define CLEAR 1e-6     /* of the way: as far a sheet that blocks is from either end */
#define ENDS                                                                                                           \
    5e-8              /* of the height of `from`: what is crossed by less is crossed in the 1e-7 of a flight at its    \
                       * end, where nothing blocks (sp_flight_ray) */
#define SEPARATE 1e-9 /* of all lengths: planes through `from` leave so much room */

void sp_shaft_open(sp_shaft *shaft)
{
    shaft->way = sp_sub(shaft->middle, shaft->from);
    shaft->distance = sp_length(shaft->way);
    shaft->axis = sp_unit(shaft->way);
    sp_vec3 aside = fabs(shaft->axis.x) < 0.5 ? sp_v(1, 0, 0) : sp_v(0, 1, 0);
    shaft->across[0] = sp_unit(sp_cross(shaft->axis, aside));
    shaft->across[1] = sp_cross(shaft->axis, shaft->across[0]);
}

/* What a curtain adds to the height that has to be left over a plane of this normal. */
static double sag_over(const sp_shaft *shaft, sp_vec3 normal)
{
    return shaft->rise * fmax(0, -sp_dot(normal, shaft->up));
}

/* Along `e`, which is unit, the half extent of a box, and the place of its middle from `from`. */
static double box_place(const sp_shaft *shaft, sp_vec3 e, const double low[3], const double high[3], double *half)
{
    sp_vec3 middle = sp_v(0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1]), 0.5 * (low[2] + high[2]));
    *half = 0.5 * (fabs(e.x) * (high[0] - low[0]) + fabs(e.y) * (high[1] - low[1]) + fabs(e.z) * (high[2] - low[2]));
    return sp_dot(sp_sub(middle, shaft->from), e);
}

/* Planes square to the way, and one along it. */
static bool box_may_matter(const void *region, const double low[3], const double high[3])
{
    const sp_shaft *shaft = region;
    double half, along = box_place(shaft, shaft->axis, low, high, &half);
    if (along - half > shaft->distance + shaft->radius + shaft->rise || along + half < -shaft->rise)
        return false;
    sp_vec3 middle = sp_v(0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1]), 0.5 * (low[2] + high[2]));
    sp_vec3 aside = sp_sub(middle, shaft->from), e = sp_unit(sp_along(aside, -along, shaft->axis));
    double out = box_place(shaft, e, low, high, &half);
    return out - half <= shaft->radius + 0.25 * shaft->rise * fmax(0, sp_dot(e, shaft->up)) + shaft->round_off;
}

/* Whether the shaft lies beyond the plane through `from` on whose other side, m·x >= 0, something is. */
static bool keeps_below(const sp_shaft *shaft, sp_vec3 m, double lift)
{
    double length = sp_length(m), room = SEPARATE * (shaft->distance + shaft->radius + shaft->rise) * length;
    return length > 0 && sp_dot(m, shaft->way) + length * shaft->radius + lift * fmax(0, sp_dot(m, shaft->up)) < -room;
}

/* Planes through `from` and one of the corners, square to where that lies from the shaft as `from` sees it. */
static bool corner_plane_parts(const sp_shaft *shaft, const sp_vec3 *corner, const double *along, int count,
                               double lift)
{
    double seen[3][2];
    for (int i = 0; i < count; i++)
        for (int k = 0; k < 2; k++)
            seen[i][k] = sp_dot(corner[i], shaft->across[k]) / along[i];
    double up[2] = {sp_dot(shaft->up, shaft->across[0]), sp_dot(shaft->up, shaft->across[1])};
    double level = up[0] * up[0] + up[1] * up[1], high = lift / shaft->distance;
    for (int i = 0; i < count; i++) {
        double share = level > 0 ? (seen[i][0] * up[0] + seen[i][1] * up[1]) / level : 0;
        share = fmin(fmax(share, 0), high);
        double e[2] = {seen[i][0] - share * up[0], seen[i][1] - share * up[1]}, least = INFINITY;
        for (int j = 0; j < count; j++)
            least = fmin(least, e[0] * seen[j][0] + e[1] * seen[j][1]);
        sp_vec3 m = sp_along(sp_scale(shaft->across[0], e[0]), e[1], shaft->across[1]);
        if (keeps_below(shaft, sp_along(m, -least, shaft->axis), lift))
            return true;
    }
    return false;
}

/* Whether a plane through `from`, or one square to the way, has the shaft on one side and these corners on the other;
 * two for an edge, three for a triangle; from `from`, m. */
static bool is_aside(const sp_shaft *shaft, const sp_vec3 *corner, int count)
{
    double along[3], least = INFINITY, most = -INFINITY;
    for (int i = 0; i < count; i++) {
        along[i] = sp_dot(corner[i], shaft->axis);
        least = fmin(least, along[i]);
        most = fmax(most, along[i]);
    }
    double farthest = shaft->distance + shaft->radius + shaft->rise;
    if (least > farthest || (most < 0 && shaft->distance > shaft->radius + shaft->rise))
        return true;
    double lift = shaft->rise * (1 - fmax(0, least / farthest));
    if (least > 0 && corner_plane_parts(shaft, corner, along, count, lift))
        return true;
    for (int i = 0; i < count; i++) {
        sp_vec3 m = sp_cross(corner[i], corner[(i + 1) % count]);
        double third = count == 3 ? sp_dot(m, corner[(i + 2) % 3]) : 0;
        if ((third >= 0 && keeps_below(shaft, m, lift)) || (third <= 0 && keeps_below(shaft, sp_scale(m, -1), lift)))
            return true;
    }
    return false;
}

static void corners_from(const sp_shaft *shaft, uint32_t triangle, sp_vec3 corner[3])
{
    const sp_mesh *mesh = sp_tracer_mesh(shaft->tracer);
    for (int i = 0; i < 3; i++)
        corner[i] = sp_sub(mesh->vertices[mesh->triangles[triangle][i]], shaft->from);
}

/* Whether flights to a face stay in front of a triangle's plane. `normal` is the triangle's, `height` that of `from`
 * over it, above 0, and `corner` is of it. */
static bool stays_in_front(const sp_shaft *shaft, const sp_shaft_face *face, sp_vec3 normal, double height)
{
    double least = -ENDS * (height - sag_over(shaft, normal));
    if (!(least < -shaft->round_off))
        return false;
    for (size_t i = face->first; i < face->end; i++)
        if (height + sp_dot(normal, sp_sub(shaft->corners[i], shaft->from)) < least)
            return false;
    return true;
}

/* Whether a triangle lies behind a face, and the flights to it before that. */
static bool lies_behind(const sp_shaft *shaft, const sp_shaft_face *face, const sp_vec3 corner[3])
{
    sp_vec3 on_face = sp_sub(shaft->corners[face->first], shaft->from), normal = face->normal;
    double height = -sp_dot(normal, on_face);
    normal = height < 0 ? sp_scale(normal, -1) : normal;
    height = fabs(height);
    double most = ENDS * (height - sag_over(shaft, normal));
    if (!(most > shaft->round_off))
        return false;
    for (int i = 0; i < 3; i++)
        if (height + sp_dot(normal, corner[i]) > most)
            return false;
    return true;
}

/* Whether a triangle cannot be in the way. */
static bool leaves_free(const void *region, uint32_t triangle)
{
    const sp_shaft *shaft = region;
    sp_vec3 corner[3], normal = sp_triangle_normal(sp_tracer_mesh(shaft->tracer), triangle);
    corners_from(shaft, triangle, corner);
    double height = -sp_dot(normal, corner[0]);
    normal = height < 0 ? sp_scale(normal, -1) : normal;
    bool apart = true;
    for (size_t i = 0; apart && i < shaft->face_count; i++)
        apart = stays_in_front(shaft, &shaft->faces[i], normal, fabs(height)) ||
                lies_behind(shaft, &shaft->faces[i], corner);
    return apart || is_aside(shaft, corner, 3);
}

bool sp_shaft_is_free(const sp_shaft *shaft)
{
    return shaft->distance > shaft->radius && sp_tracer_visit(shaft->tracer, box_may_matter, leaves_free, shaft);
}

/* Whether the plane of a triangle has `from` on one side and all of the piece on the other. */
static bool stands_between(const sp_shaft *shaft, uint32_t triangle)
{
    sp_vec3 corner[3], normal = sp_triangle_normal(sp_tracer_mesh(shaft->tracer), triangle);
    corners_from(shaft, triangle, corner);
    double height = -sp_dot(normal, corner[0]), clear = CLEAR * shaft->distance;
    normal = height < 0 ? sp_scale(normal, -1) : normal;
    height = fabs(height);
    for (size_t i = 0; height > clear && i < shaft->corner_count; i++)
        if (height + sp_dot(normal, sp_sub(shaft->corners[i], shaft->from)) > -clear)
            return false;
    return height > clear;
}

/* 1 or -1: the side of an edge on which flights across it see a corner; 0 where they differ. All from `from`. */
static int side_of_edge(const sp_shaft *shaft, sp_vec3 start, sp_vec3 edge, sp_vec3 corner)
{
    sp_vec3 aside = sp_sub(corner, start);
    double line = sp_dot(aside, sp_cross(edge, start));
    double arc = line - shaft->rise * sp_dot(aside, sp_cross(edge, shaft->up));
    double doubt = shaft->round_off * sp_length(aside) * sp_length(edge);
    return line > doubt && arc > doubt ? 1 : line < -doubt && arc < -doubt ? -1 : 0;
}

/* The triangle that goes on where flights leave one over its edge k: itself where none do, SP_NONE where that is not
 * known. */
static uint32_t next_of_sheet(const sp_shaft *shaft, uint32_t triangle, uint32_t k)
{
    sp_vec3 own[3], other[3];
    corners_from(shaft, triangle, own);
    sp_vec3 edge[2] = {own[k], own[(k + 1) % 3]};
    if (is_aside(shaft, edge, 2))
        return triangle;
    uint32_t opposite = shaft->edges->opposite[3 * triangle + k];
    if (opposite == SP_NONE)
        return SP_NONE;
    corners_from(shaft, opposite / 3, other);
    sp_vec3 along = sp_sub(edge[1], edge[0]);
    int side = side_of_edge(shaft, edge[0], along, own[(k + 2) % 3]);
    return side != 0 && side_of_edge(shaft, edge[0], along, other[(opposite + 2) % 3]) == -side ? opposite / 3
                                                                                                : SP_NONE;
}

static bool holds(const uint32_t *sheet, size_t count, uint32_t triangle)
{
    for (size_t i = 0; i < count; i++)
        if (sheet[i] == triangle)
            return true;
    return false;
}

bool sp_shaft_is_blocked(const sp_shaft *shaft)
{
    uint32_t sheet[SHEET_MOST];
    sp_ray line = {.origin = shaft->from, .velocity = shaft->way, .t_min = CLEAR, .t_max = 1 - CLEAR, .skip = SP_NONE};
    sheet[0] = sp_trace_nearest(shaft->tracer, &line, sp_v(0, 0, 0)).triangle;
    size_t count = sheet[0] != SP_NONE;
    for (size_t i = 0; i < count; i++) {
        if (!stands_between(shaft, sheet[i]))
            return false;
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t next = next_of_sheet(shaft, sheet[i], k);
            if (next == SP_NONE || (count == SHEET_MOST && !holds(sheet, count, next)))
                return false;
            if (!holds(sheet, count, next))
                sheet[count++] = next;
        }
    }
    return count > 0;
}
