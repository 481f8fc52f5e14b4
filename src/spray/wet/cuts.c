/* Every triangle that others cross or touch is cut along the lines where they do, one line after the other: a line cuts
 * those cells alone that it really passes through, but all of each, so that cells stay convex. A triangle that lies in
 * the plane of another cuts it along its own edges. Cells that are still long are halved: a shaft may lead through an
 * opening without touching it. The lines come in a shuffled order, which keeps the trees low; where very many cross one
 * triangle it is first halved by lines that part them. One after the other the lines of a convex outline, or lines
 * whose order somebody has chosen, would make a tree as deep as there are lines. */
#include "spray/wet/cuts.h"

#include "spray/wet/growth.h"
#include "spray/wet/meetings.h"
#include "spray/wet/stretches.h"

#include <stdlib.h>

#define LONGEST                                                                                                        \
    (1.0 / 64)        /* of the geometry's diagonal: no face is longer, lest it lead from one space into another       \
                       */
#define CROWD 128     /* lines in one cell that are parted before it is cut along each */
#define UNEVEN 0.75   /* share of them on one side of a line that hardly parts them */
#define UNEVEN_MOST 2 /* such lines one after the other */
#define CROWD_WORK 64 /* times that each line of a triangle may be looked at, on average */

typedef struct {
    const sp_mesh *mesh;
    sp_cuts *cuts;
    const sp_meetings *meetings;
    size_t cut_room, cell_room;
    sp_growth growth;
} cutter;

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
    if (!sp_growth_has_room(&cutter->growth, &cuts->cuts, &cutter->cut_room, cuts->cut_count, sizeof *cuts->cuts) ||
        !sp_growth_has_room(&cutter->growth, &cuts->cell_triangle, &cutter->cell_room, cuts->cell_count,
                            sizeof *cuts->cell_triangle))
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
    if (cutter->growth.failed || !(sp_stretch_length(cutter->mesh, triangle, part) > cuts->contact))
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

/* The line of a meeting, and what of it lies on its triangle; false where that is next to nothing. */
static bool clip_meeting(const cutter *cutter, const sp_meeting_line *meeting, sp_cut *line, sp_stretch *whole)
{
    const sp_mesh *mesh = cutter->mesh;
    const uint32_t *corner = mesh->triangles[meeting->triangle];
    sp_triangle_weights(mesh, meeting->triangle, meeting->p, &whole->from[0], &whole->from[1]);
    sp_triangle_weights(mesh, meeting->triangle, meeting->q, &whole->to[0], &whole->to[1]);
    sp_vec3 p = sp_triangle_point(mesh, meeting->triangle, whole->from[0], whole->from[1]);
    sp_vec3 q = sp_triangle_point(mesh, meeting->triangle, whole->to[0], whole->to[1]);
    if (!(sp_distance(p, q) > cutter->cuts->contact))
        return false;
    *line = sp_cut_through(mesh, meeting->triangle, p, q);
    for (int i = 0; i < 3; i++) {
        sp_cut edge =
            sp_cut_through(mesh, meeting->triangle, mesh->vertices[corner[i]], mesh->vertices[corner[(i + 1) % 3]]);
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
    if (cutter->growth.failed || count <= CROWD || count > crowd->work)
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
    cutter->growth.failed = cutter->growth.failed || !below;
    uint32_t node = (uint32_t)cutter->cuts->cut_count - 1;
    for (int side = 0; side < 2 && !cutter->growth.failed; side++) {
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

/* Cuts a triangle along all of its meetings. */
static void cut_triangle(cutter *cutter, const sp_meeting_line *meetings, size_t count)
{
    uint32_t triangle = meetings[0].triangle;
    sp_stretch whole;
    sp_cut line;
    if (count > CROWD) {
        sp_stretch *parts = malloc(count * sizeof *parts);
        crowd crowd = {cutter, triangle, CROWD_WORK * count, malloc(count * sizeof *crowd.places)};
        size_t left = 0;
        cutter->growth.failed = !parts || !crowd.places;
        for (size_t i = 0; i < count && !cutter->growth.failed; i++)
            left += clip_meeting(cutter, &meetings[i], &line, &parts[left]) &&
                    sp_stretch_length(cutter->mesh, triangle, &parts[left]) > cutter->cuts->contact;
        halve_crowd(&crowd, SP_NONE, 0, parts, left, 0);
        free(parts);
        free(crowd.places);
    }
    for (size_t i = 0; i < count && !cutter->growth.failed; i++)
        if (clip_meeting(cutter, &meetings[i], &line, &whole))
            cut_along(cutter, triangle, SP_NONE, 0, &whole, &line);
}

static void cut_triangles(cutter *cutter)
{
    const sp_meetings *meetings = cutter->meetings;
    for (size_t i = 0, end; i < meetings->count && !cutter->growth.failed; i = end) {
        for (end = i + 1; end < meetings->count; end++)
            if (meetings->items[end].triangle != meetings->items[i].triangle)
                break;
        cut_triangle(cutter, meetings->items + i, end - i);
    }
}

static void keep_coverings(cutter *cutter)
{
    sp_cuts *cuts = cutter->cuts;
    const sp_meetings *meetings = cutter->meetings;
    size_t triangles = cutter->mesh->triangle_count;
    cuts->cover_start = calloc(triangles + 2, sizeof *cuts->cover_start);
    cuts->covers = malloc((meetings->covering_count + 1) * sizeof *cuts->covers);
    cutter->growth.failed = cutter->growth.failed || !cuts->cover_start || !cuts->covers;
    if (cutter->growth.failed)
        return;
    for (size_t i = 0; i < meetings->covering_count; i++) {
        cuts->cover_start[meetings->coverings[i].triangle + 1]++;
        cuts->covers[i] = meetings->coverings[i].cover;
    }
    for (size_t t = 0; t < triangles; t++)
        cuts->cover_start[t + 1] += cuts->cover_start[t];
}

/* A triangle becomes one cell. */
static void begin_cell(cutter *cutter, uint32_t triangle)
{
    sp_cuts *cuts = cutter->cuts;
    if (!sp_growth_has_room(&cutter->growth, &cuts->cell_triangle, &cutter->cell_room, cuts->cell_count,
                            sizeof *cuts->cell_triangle))
        return;
    cuts->root[triangle] = (uint32_t)cuts->cell_count | SP_CELL;
    cuts->cell_triangle[cuts->cell_count++] = triangle;
}

/* Every triangle that is met or covered begins as one cell; not the copies of another, which lie on it all over.
 */
static void begin_cells(cutter *cutter, bool *touched)
{
    sp_cuts *cuts = cutter->cuts;
    size_t triangles = cutter->mesh->triangle_count;
    cuts->root = malloc((triangles + 1) * sizeof *cuts->root);
    if (!cuts->root) {
        cutter->growth.failed = true;
        return;
    }
    for (size_t i = 0; i < cutter->meetings->count; i++)
        touched[cutter->meetings->items[i].triangle] = true;
    for (size_t i = 0; i < cutter->meetings->covering_count; i++)
        touched[cutter->meetings->coverings[i].triangle] = true;
    for (uint32_t t = 0; t < triangles && !cutter->growth.failed; t++) {
        cuts->root[t] = SP_NONE;
        if (touched[t] && !cutter->meetings->copies[t])
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

/* Halves what is longer than it may be below a child; `piece` is all of it. */
static void halve_below(const halving *halving, uint32_t of, int which, const sp_triangle_piece *piece)
{
    cutter *cutter = halving->cutter;
    sp_cuts *cuts = cutter->cuts;
    if (cutter->growth.failed || piece->count < 3 || piece->count > SP_PIECE_POINTS - 2)
        return;
    uint32_t node = *child_of(cuts, halving->triangle, of, which);
    if (node & SP_CELL) {
        sp_cut cut;
        if (!middle_cut(halving, piece, &cut))
            return;
        split_cell(cutter, halving->triangle, of, which, &cut);
        if (cutter->growth.failed)
            return;
        node = (uint32_t)cuts->cut_count - 1;
    }
    for (int side = 0; side < 2; side++) {
        sp_triangle_piece part;
        sp_piece_clip(piece, &cuts->cuts[node], side ? 1 : -1, &part);
        halve_below(halving, node, side, &part);
    }
}

static void halve_long_faces(cutter *cutter, double longest)
{
    const sp_mesh *mesh = cutter->mesh;
    for (uint32_t t = 0; t < mesh->triangle_count && !cutter->growth.failed; t++) {
        const sp_triangle_piece whole = {.count = 3, .at = {{0, 0}, {1, 0}, {0, 1}}};
        halving halving = {cutter, t, longest};
        sp_cut cut;
        if (cutter->meetings->copies[t])
            continue;
        if (cutter->cuts->root[t] == SP_NONE) {
            if (!middle_cut(&halving, &whole, &cut))
                continue;
            begin_cell(cutter, t);
        }
        halve_below(&halving, SP_NONE, 0, &whole);
    }
}

static void cut_mesh(cutter *cutter)
{
    bool *touched = calloc(cutter->mesh->triangle_count + 1, sizeof *touched);
    cutter->growth.failed = !touched;
    if (!cutter->growth.failed)
        begin_cells(cutter, touched);
    free(touched);
    if (!cutter->growth.failed)
        cut_triangles(cutter);
    halve_long_faces(cutter, LONGEST / SP_CONTACT * cutter->cuts->contact);
    if (!cutter->growth.failed)
        keep_coverings(cutter);
}

bool sp_cuts_create(sp_cuts *cuts, const sp_setup *setup, const sp_shells *shells, double contact, sp_error *error)
{
    *cuts = (sp_cuts){.contact = contact};
    sp_meetings meetings;
    cutter cutter = {.mesh = setup->mesh, .cuts = cuts, .meetings = &meetings};
    bool done = sp_meetings_find(setup, shells, contact, &meetings, error);
    if (done)
        cut_mesh(&cutter);
    sp_meetings_free(&meetings);
    if (done && !cutter.growth.failed)
        return true;
    sp_cuts_destroy(cuts);
    if (cutter.growth.crowded)
        return sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0, "geometry: its triangles are cut into more than %d cells",
                       SP_GROWTH_MOST);
    return done && sp_fail_memory(error);
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
