/* Every triangle that others cross or touch is cut along the lines where they do, one line after the other: a line cuts
 * those cells alone that it really passes through, but all of each, so that cells stay convex. A triangle that lies in
 * the plane of another cuts it along its own edges. Cells that are still long are halved: a shaft may lead through an
 * opening without touching it. The lines come in a shuffled order, which keeps the trees low; where very many cross one
 * triangle it is first halved by lines that part them. One after the other the lines of a convex outline, or lines
 * whose order somebody has chosen, would make a tree as deep as there are lines. */
#include "spray/wet/cuts.h"

#include "nozzle/scramble.h"
#include "spray/wet/pairs.h"
#include "spray/wet/stretches.h"

#include <stdlib.h>
#include <string.h>

#define LONGEST                                                                                                        \
    (1.0 / 64)        /* of the geometry's diagonal: no face is longer, lest it lead from one space into another       \
                       */
#define CROWD 128     /* lines in one cell that are parted before it is cut along each */
#define UNEVEN 0.75   /* share of them on one side of a line that hardly parts them */
#define UNEVEN_MOST 2 /* such lines one after the other */
#define CROWD_WORK 64 /* times that each line of a triangle may be looked at, on average */

/* Where another triangle crosses or touches one, from p to q. */
typedef struct {
    uint32_t triangle;
    uint32_t order; /* shuffled */
    sp_vec3 p, q;
} scratch;

typedef struct {
    uint32_t triangle, cover;
} covering;

typedef struct {
    const sp_mesh *mesh;
    sp_cuts *cuts;
    scratch *scratches;
    size_t scratch_count, scratch_room;
    covering *coverings;
    size_t covering_count, covering_room;
    size_t cut_room, cell_room;
    bool *copies; /* [triangles] */
    bool failed;  /* memory ran out, or numbers did */
    bool crowded; /* numbers did */
} cutter;

static void *grow(cutter *cutter, void *items, size_t count, size_t *room, size_t size)
{
    if (count < *room)
        return items;
    if (count >= SP_CELL / 2) {
        cutter->failed = cutter->crowded = true;
        return items;
    }
    size_t more = 2 * *room + 256;
    void *grown = realloc(items, more * size);
    if (!grown) {
        cutter->failed = true;
        return items;
    }
    *room = more;
    return grown;
}

static uint32_t shuffle(uint64_t index)
{
    return (uint32_t)(sp_scramble(index * 0x9e3779b97f4a7c15u) >> 32);
}

static void add_scratch(cutter *cutter, uint32_t triangle, sp_vec3 p, sp_vec3 q)
{
    cutter->scratches = grow(cutter, cutter->scratches, cutter->scratch_count, &cutter->scratch_room, sizeof(scratch));
    if (!cutter->failed) {
        uint32_t order = shuffle(cutter->scratch_count);
        cutter->scratches[cutter->scratch_count++] = (scratch){triangle, order, p, q};
    }
}

static void add_covering(cutter *cutter, uint32_t triangle, uint32_t cover)
{
    cutter->coverings =
        grow(cutter, cutter->coverings, cutter->covering_count, &cutter->covering_room, sizeof(covering));
    if (!cutter->failed)
        cutter->coverings[cutter->covering_count++] = (covering){triangle, cover};
}

/* On which side of a triangle's plane the corners of another lie: -1, 0 (within the contact) or 1. */
static void take_sides(const cutter *cutter, uint32_t plane, uint32_t other, double height[3], int side[3])
{
    const sp_mesh *mesh = cutter->mesh;
    sp_vec3 normal = sp_triangle_normal(mesh, plane), corner = mesh->vertices[mesh->triangles[plane][0]];
    for (int i = 0; i < 3; i++) {
        height[i] = sp_dot(normal, sp_sub(mesh->vertices[mesh->triangles[other][i]], corner));
        side[i] = (height[i] > cutter->cuts->contact) - (height[i] < -cutter->cuts->contact);
    }
}

/* Where the plane of one triangle meets another; false where it does in less than a line. */
static bool meeting_line(const cutter *cutter, uint32_t other, const double height[3], const int side[3], sp_vec3 *p,
                         sp_vec3 *q)
{
    const sp_mesh *mesh = cutter->mesh;
    sp_vec3 found[3];
    int count = 0;
    for (int i = 0; i < 3; i++) {
        int k = (i + 1) % 3;
        sp_vec3 a = mesh->vertices[mesh->triangles[other][i]], b = mesh->vertices[mesh->triangles[other][k]];
        if (side[i] == 0)
            found[count++] = a;
        else if (side[i] * side[k] < 0)
            found[count++] = sp_along(a, height[i] / (height[i] - height[k]), sp_sub(b, a));
    }
    if (count < 2)
        return false;
    *p = found[0];
    *q = found[1];
    return true;
}

static bool in_one_plane(const int side[3])
{
    return side[0] == 0 && side[1] == 0 && side[2] == 0;
}

static void cover(cutter *cutter, uint32_t triangle, uint32_t other)
{
    const sp_mesh *mesh = cutter->mesh;
    for (int i = 0; i < 3; i++)
        add_scratch(cutter, triangle, mesh->vertices[mesh->triangles[other][i]],
                    mesh->vertices[mesh->triangles[other][(i + 1) % 3]]);
    add_covering(cutter, triangle, other);
}

static void scratch_pair(cutter *cutter, sp_pair pair)
{
    if (pair.copy) {
        add_covering(cutter, pair.a, pair.b);
        add_covering(cutter, pair.b, pair.a);
        return;
    }
    double height[2][3];
    int side[2][3];
    take_sides(cutter, pair.a, pair.b, height[0], side[0]);
    if (abs(side[0][0] + side[0][1] + side[0][2]) == 3)
        return;
    take_sides(cutter, pair.b, pair.a, height[1], side[1]);
    if (abs(side[1][0] + side[1][1] + side[1][2]) == 3)
        return;
    if (in_one_plane(side[0]) || in_one_plane(side[1])) {
        cover(cutter, pair.a, pair.b);
        cover(cutter, pair.b, pair.a);
        return;
    }
    sp_vec3 p, q;
    if (meeting_line(cutter, pair.b, height[0], side[0], &p, &q))
        add_scratch(cutter, pair.a, p, q);
    if (meeting_line(cutter, pair.a, height[1], side[1], &p, &q))
        add_scratch(cutter, pair.b, p, q);
}

/* What passes through a cap is in two spaces. Copies have no cells. */
static void scratch_cap(cutter *cutter, const sp_cap *cap)
{
    const sp_mesh *mesh = cutter->mesh;
    sp_vec3 normal = sp_unit(cap->normal), p, q;
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        if (cutter->copies[t])
            continue;
        double height[3];
        int side[3];
        for (int i = 0; i < 3; i++) {
            height[i] = sp_dot(normal, sp_sub(mesh->vertices[mesh->triangles[t][i]], cap->point));
            side[i] = (height[i] > cutter->cuts->contact) - (height[i] < -cutter->cuts->contact);
        }
        if (in_one_plane(side) || !meeting_line(cutter, t, height, side, &p, &q))
            continue;
        sp_vec3 along = sp_sub(q, p);
        double length2 = sp_dot(along, along);
        double share = length2 > 0 ? sp_dot(sp_sub(cap->point, p), along) / length2 : 0;
        if (sp_distance(sp_along(p, fmin(fmax(share, 0), 1), along), cap->point) <= cap->radius)
            add_scratch(cutter, t, p, q);
    }
}

/* Below a cut `of`, or a triangle where that is SP_NONE: names a child rather than points at it, as the cuts move when
 * they grow. */
static uint32_t *child_of(sp_cuts *cuts, uint32_t triangle, uint32_t of, int which)
{
    return of == SP_NONE ? &cuts->root[triangle] : &cuts->cuts[of].child[which];
}

/* Cuts the cell that a child is. */
static void split_cell(cutter *cutter, uint32_t triangle, uint32_t of, int which, const sp_cut *line)
{
    sp_cuts *cuts = cutter->cuts;
    cuts->cuts = grow(cutter, cuts->cuts, cuts->cut_count, &cutter->cut_room, sizeof *cuts->cuts);
    cuts->cell_triangle =
        grow(cutter, cuts->cell_triangle, cuts->cell_count, &cutter->cell_room, sizeof *cuts->cell_triangle);
    if (cutter->failed)
        return;
    uint32_t *child = child_of(cuts, triangle, of, which), cell = *child & ~SP_CELL;
    *child = (uint32_t)cuts->cut_count;
    cuts->cuts[cuts->cut_count] = *line;
    cuts->cuts[cuts->cut_count].child[0] = cell | SP_CELL;
    cuts->cuts[cuts->cut_count++].child[1] = (uint32_t)cuts->cell_count | SP_CELL;
    cuts->cell_triangle[cuts->cell_count++] = triangle;
}

/* Cuts every cell below a child that the stretch passes through. */
static void cut_along(cutter *cutter, uint32_t triangle, uint32_t of, int which, const sp_stretch *part,
                      const sp_cut *line)
{
    sp_cuts *cuts = cutter->cuts;
    if (cutter->failed || !(sp_stretch_length(cutter->mesh, triangle, part) > cuts->contact))
        return;
    uint32_t node = *child_of(cuts, triangle, of, which);
    if (node & SP_CELL) {
        split_cell(cutter, triangle, of, which, line);
        return;
    }
    for (int side = 0; side < 2; side++) {
        sp_stretch below = *part;
        sp_cut cut = cuts->cuts[node];
        if (sp_stretch_clip(&below, &cut, side ? 1 : -1, cuts->contact))
            cut_along(cutter, triangle, node, side, &below, line);
    }
}

/* The line of a scratch, and what of it lies on its triangle; false where that is next to nothing. */
static bool clip_scratch(const cutter *cutter, const scratch *scratch, sp_cut *line, sp_stretch *whole)
{
    const sp_mesh *mesh = cutter->mesh;
    const uint32_t *corner = mesh->triangles[scratch->triangle];
    sp_triangle_weights(mesh, scratch->triangle, scratch->p, &whole->from[0], &whole->from[1]);
    sp_triangle_weights(mesh, scratch->triangle, scratch->q, &whole->to[0], &whole->to[1]);
    sp_vec3 p = sp_triangle_point(mesh, scratch->triangle, whole->from[0], whole->from[1]);
    sp_vec3 q = sp_triangle_point(mesh, scratch->triangle, whole->to[0], whole->to[1]);
    if (!(sp_distance(p, q) > cutter->cuts->contact))
        return false;
    *line = sp_cut_through(mesh, scratch->triangle, p, q);
    for (int i = 0; i < 3; i++) {
        sp_cut edge =
            sp_cut_through(mesh, scratch->triangle, mesh->vertices[corner[i]], mesh->vertices[corner[(i + 1) % 3]]);
        if (!sp_stretch_clip(whole, &edge, 1, cutter->cuts->contact))
            return false;
    }
    return true;
}

/* The lines that cross one triangle while it is halved. */
typedef struct {
    cutter *cutter;
    uint32_t triangle;
    size_t work;    /* stretches that may yet be looked at */
    double *places; /* room for one a stretch */
} crowd;

/* Halves the cell that a child is until few of the stretches are left in each, or no line parts them; `uneven`: as many
 * lines before this one have hardly parted them. */
static void halve_crowd(crowd *crowd, uint32_t of, int which, const sp_stretch *parts, size_t count, int uneven)
{
    cutter *cutter = crowd->cutter;
    if (cutter->failed || count <= CROWD || count > crowd->work)
        return;
    crowd->work -= count;
    sp_cut line;
    double contact = cutter->cuts->contact;
    size_t fuller = sp_stretches_halve(cutter->mesh, crowd->triangle, parts, count, contact, crowd->places, &line);
    uneven = (double)fuller > UNEVEN * (double)count ? uneven + 1 : 0;
    if (uneven > UNEVEN_MOST)
        return;
    split_cell(cutter, crowd->triangle, of, which, &line);
    sp_stretch *below = malloc(fuller * sizeof *below + 1);
    cutter->failed = cutter->failed || !below;
    uint32_t node = (uint32_t)cutter->cuts->cut_count - 1;
    for (int side = 0; side < 2 && !cutter->failed; side++) {
        size_t left = 0;
        for (size_t i = 0; i < count; i++) {
            sp_stretch part = parts[i];
            if (sp_stretch_clip(&part, &line, side ? 1 : -1, contact) &&
                sp_stretch_length(cutter->mesh, crowd->triangle, &part) > contact)
                below[left++] = part;
        }
        halve_crowd(crowd, node, side, below, left, uneven);
    }
    free(below);
}

/* Cuts a triangle along all of its scratches. */
static void cut_triangle(cutter *cutter, const scratch *scratches, size_t count)
{
    uint32_t triangle = scratches[0].triangle;
    sp_stretch whole;
    sp_cut line;
    if (count > CROWD) {
        sp_stretch *parts = malloc(count * sizeof *parts);
        crowd crowd = {cutter, triangle, CROWD_WORK * count, malloc(count * sizeof *crowd.places)};
        size_t left = 0;
        cutter->failed = !parts || !crowd.places;
        for (size_t i = 0; i < count && !cutter->failed; i++)
            left += clip_scratch(cutter, &scratches[i], &line, &parts[left]) &&
                    sp_stretch_length(cutter->mesh, triangle, &parts[left]) > cutter->cuts->contact;
        halve_crowd(&crowd, SP_NONE, 0, parts, left, 0);
        free(parts);
        free(crowd.places);
    }
    for (size_t i = 0; i < count && !cutter->failed; i++)
        if (clip_scratch(cutter, &scratches[i], &line, &whole))
            cut_along(cutter, triangle, SP_NONE, 0, &whole, &line);
}

static void cut_triangles(cutter *cutter)
{
    size_t end;
    for (size_t i = 0; i < cutter->scratch_count && !cutter->failed; i = end) {
        for (end = i + 1; end < cutter->scratch_count; end++)
            if (cutter->scratches[end].triangle != cutter->scratches[i].triangle)
                break;
        cut_triangle(cutter, cutter->scratches + i, end - i);
    }
}

static int by_scratch(const void *left, const void *right)
{
    const scratch *p = left, *q = right;
    if (p->triangle != q->triangle)
        return p->triangle < q->triangle ? -1 : 1;
    return p->order < q->order ? -1 : p->order > q->order;
}

static int by_covering(const void *left, const void *right)
{
    const covering *p = left, *q = right;
    if (p->triangle != q->triangle)
        return p->triangle < q->triangle ? -1 : 1;
    return p->cover < q->cover ? -1 : p->cover > q->cover;
}

static void keep_coverings(cutter *cutter)
{
    sp_cuts *cuts = cutter->cuts;
    size_t triangles = cutter->mesh->triangle_count;
    cuts->cover_start = calloc(triangles + 2, sizeof *cuts->cover_start);
    cuts->covers = malloc((cutter->covering_count + 1) * sizeof *cuts->covers);
    cutter->failed = cutter->failed || !cuts->cover_start || !cuts->covers;
    if (cutter->failed)
        return;
    if (cutter->covering_count)
        qsort(cutter->coverings, cutter->covering_count, sizeof *cutter->coverings, by_covering);
    for (size_t i = 0; i < cutter->covering_count; i++) {
        cuts->cover_start[cutter->coverings[i].triangle + 1]++;
        cuts->covers[i] = cutter->coverings[i].cover;
    }
    for (size_t t = 0; t < triangles; t++)
        cuts->cover_start[t + 1] += cuts->cover_start[t];
}

/* A triangle becomes one cell. */
static void begin_cell(cutter *cutter, uint32_t triangle)
{
    sp_cuts *cuts = cutter->cuts;
    cuts->cell_triangle =
        grow(cutter, cuts->cell_triangle, cuts->cell_count, &cutter->cell_room, sizeof *cuts->cell_triangle);
    if (cutter->failed)
        return;
    cuts->root[triangle] = (uint32_t)cuts->cell_count | SP_CELL;
    cuts->cell_triangle[cuts->cell_count++] = triangle;
}

/* Every triangle that is scratched or covered begins as one cell; not the copies of another, which lie on it all over.
 */
static void begin_cells(cutter *cutter, bool *touched)
{
    sp_cuts *cuts = cutter->cuts;
    size_t triangles = cutter->mesh->triangle_count;
    cuts->root = malloc((triangles + 1) * sizeof *cuts->root);
    if (!cuts->root) {
        cutter->failed = true;
        return;
    }
    for (size_t i = 0; i < cutter->scratch_count; i++)
        touched[cutter->scratches[i].triangle] = true;
    for (size_t i = 0; i < cutter->covering_count; i++)
        touched[cutter->coverings[i].triangle] = true;
    for (uint32_t t = 0; t < triangles && !cutter->failed; t++) {
        cuts->root[t] = SP_NONE;
        if (touched[t] && !cutter->copies[t])
            begin_cell(cutter, t);
    }
}

/* The pieces of one triangle while they are made smaller. */
typedef struct {
    cutter *cutter;
    uint32_t triangle;
    double longest; /* m */
} halving;

/* The cut across the longest way through a piece, in its middle; false where that is short enough. */
static bool middle_cut(const halving *halving, const sp_triangle_piece *piece, sp_cut *cut)
{
    const sp_mesh *mesh = halving->cutter->mesh;
    sp_vec3 from = sp_v(0, 0, 0), to = from;
    double longest = 0;
    for (int i = 0; i < piece->count; i++) {
        sp_vec3 p = sp_triangle_point(mesh, halving->triangle, piece->at[i][0], piece->at[i][1]);
        for (int k = 0; k < i; k++) {
            sp_vec3 q = sp_triangle_point(mesh, halving->triangle, piece->at[k][0], piece->at[k][1]);
            double length = sp_distance(p, q);
            if (length > longest) {
                longest = length;
                from = p;
                to = q;
            }
        }
    }
    sp_vec3 middle = sp_scale(sp_add(from, to), 0.5);
    sp_vec3 along = sp_cross(sp_triangle_normal(mesh, halving->triangle), sp_sub(to, from));
    *cut = sp_cut_through(mesh, halving->triangle, middle, sp_add(middle, along));
    return longest > halving->longest;
}

static void clip_piece(const sp_triangle_piece *piece, const sp_cut *cut, int way, sp_triangle_piece *part);

/* Halves what is longer than it may be below a child; `piece` is all of it. */
static void halve_below(const halving *halving, uint32_t of, int which, const sp_triangle_piece *piece)
{
    cutter *cutter = halving->cutter;
    sp_cuts *cuts = cutter->cuts;
    if (cutter->failed || piece->count < 3 || piece->count > SP_PIECE_POINTS - 2)
        return;
    uint32_t node = *child_of(cuts, halving->triangle, of, which);
    if (node & SP_CELL) {
        sp_cut cut;
        if (!middle_cut(halving, piece, &cut))
            return;
        split_cell(cutter, halving->triangle, of, which, &cut);
        if (cutter->failed)
            return;
        node = (uint32_t)cuts->cut_count - 1;
    }
    for (int side = 0; side < 2; side++) {
        sp_triangle_piece part;
        clip_piece(piece, &cuts->cuts[node], side ? 1 : -1, &part);
        halve_below(halving, node, side, &part);
    }
}

static void halve_long_faces(cutter *cutter, double longest)
{
    const sp_mesh *mesh = cutter->mesh;
    for (uint32_t t = 0; t < mesh->triangle_count && !cutter->failed; t++) {
        const sp_triangle_piece whole = {.count = 3, .at = {{0, 0}, {1, 0}, {0, 1}}};
        halving halving = {cutter, t, longest};
        sp_cut cut;
        if (cutter->copies[t])
            continue;
        if (cutter->cuts->root[t] == SP_NONE) {
            if (!middle_cut(&halving, &whole, &cut))
                continue;
            begin_cell(cutter, t);
        }
        halve_below(&halving, SP_NONE, 0, &whole);
    }
}

static void mark_copies(cutter *cutter, const sp_pair *pairs, size_t pair_count)
{
    cutter->copies = calloc(cutter->mesh->triangle_count + 1, sizeof *cutter->copies);
    cutter->failed = !cutter->copies;
    for (size_t i = 0; i < pair_count && !cutter->failed; i++)
        cutter->copies[pairs[i].b] = cutter->copies[pairs[i].b] || pairs[i].copy;
}

static void cut_mesh(cutter *cutter, const sp_pair *pairs, size_t pair_count)
{
    for (size_t i = 0; i < pair_count && !cutter->failed; i++)
        scratch_pair(cutter, pairs[i]);
    bool *touched = calloc(cutter->mesh->triangle_count + 1, sizeof *touched);
    cutter->failed = cutter->failed || !touched;
    if (!cutter->failed)
        begin_cells(cutter, touched);
    free(touched);
    if (!cutter->failed && cutter->scratch_count)
        qsort(cutter->scratches, cutter->scratch_count, sizeof *cutter->scratches, by_scratch);
    if (!cutter->failed)
        cut_triangles(cutter);
    halve_long_faces(cutter, LONGEST / SP_CONTACT * cutter->cuts->contact);
    if (!cutter->failed)
        keep_coverings(cutter);
}

bool sp_cuts_create(sp_cuts *cuts, const sp_setup *setup, const sp_shells *shells, double contact, sp_error *error)
{
    *cuts = (sp_cuts){.contact = contact};
    size_t pair_count = 0;
    sp_pair *pairs = sp_pairs_create(setup->mesh, shells, contact, &pair_count, error);
    if (!pairs)
        return false;
    cutter cutter = {.mesh = setup->mesh, .cuts = cuts};
    mark_copies(&cutter, pairs, pair_count);
    for (size_t i = 0; i < setup->cap_count && !cutter.failed; i++)
        scratch_cap(&cutter, &setup->caps[i]);
    cut_mesh(&cutter, pairs, pair_count);
    free(pairs);
    free(cutter.scratches);
    free(cutter.coverings);
    free(cutter.copies);
    if (!cutter.failed)
        return true;
    sp_cuts_destroy(cuts);
    if (!cutter.crowded)
        return sp_fail_memory(error);
    return sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0,
                   "geometry: its triangles meet or lie on each other more than %u times", SP_CELL / 2);
}

void sp_cuts_destroy(sp_cuts *cuts)
{
    free(cuts->root);
    free(cuts->cuts);
    free(cuts->cell_triangle);
    free(cuts->cover_start);
    free(cuts->covers);
    *cuts = (sp_cuts){0};
}

uint32_t sp_cuts_cell(const sp_cuts *cuts, uint32_t triangle, double u, double v, bool *near)
{
    const double at[2] = {u, v};
    uint32_t node = cuts->root[triangle];
    *near = false;
    while (!(node & SP_CELL)) {
        double distance = sp_cut_distance(&cuts->cuts[node], at);
        *near = *near || fabs(distance) < cuts->contact;
        node = cuts->cuts[node].child[distance > 0];
    }
    return node & ~SP_CELL;
}

/* The part of a convex piece on one side of a cut. */
static void clip_piece(const sp_triangle_piece *piece, const sp_cut *cut, int way, sp_triangle_piece *part)
{
    part->count = 0;
    for (int i = 0; i < piece->count; i++) {
        const double *p = piece->at[i], *q = piece->at[(i + 1) % piece->count];
        double here = way * sp_cut_distance(cut, p), there = way * sp_cut_distance(cut, q);
        if (here >= 0)
            memcpy(part->at[part->count++], p, sizeof part->at[0]);
        if ((here > 0 && there < 0) || (here < 0 && there > 0)) {
            double share = here / (here - there);
            part->at[part->count][0] = p[0] + share * (q[0] - p[0]);
            part->at[part->count++][1] = p[1] + share * (q[1] - p[1]);
        }
    }
}

static void split_below(const sp_cuts *cuts, uint32_t node, const sp_triangle_piece *piece, sp_cell_visitor *visit,
                        void *user)
{
    if (piece->count < 3)
        return;
    if (node & SP_CELL) {
        visit(user, node & ~SP_CELL, piece);
        return;
    }
    if (piece->count > SP_PIECE_POINTS - 2) { /* no room for another corner: in two along a chord */
        int half = piece->count / 2;
        sp_triangle_piece first = {.count = half + 1}, second = {.count = piece->count - half + 1};
        memcpy(first.at, piece->at, sizeof piece->at[0] * (size_t)(half + 1));
        memcpy(second.at, piece->at + half, sizeof piece->at[0] * (size_t)(piece->count - half));
        memcpy(second.at[second.count - 1], piece->at[0], sizeof piece->at[0]);
        split_below(cuts, node, &first, visit, user);
        split_below(cuts, node, &second, visit, user);
        return;
    }
    for (int side = 0; side < 2; side++) {
        sp_triangle_piece part;
        clip_piece(piece, &cuts->cuts[node], side ? 1 : -1, &part);
        split_below(cuts, cuts->cuts[node].child[side], &part, visit, user);
    }
}

void sp_cuts_split(const sp_cuts *cuts, uint32_t triangle, const sp_triangle_piece *piece, sp_cell_visitor *visit,
                   void *user)
{
    split_below(cuts, cuts->root[triangle], piece, visit, user);
}
