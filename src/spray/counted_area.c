/* What of the surface is counted: clean, and wet. */
#include "spray/wet/wet.h"

#define ROUND_OFF 1e-12 /* of a fragment */

bool sp_side_is_counted(const sp_evaluator *evaluator, uint32_t triangle, unsigned side)
{
    const sp_setup *setup = &evaluator->setup;
    if (!evaluator->everything && !setup->surfaces[setup->mesh->part[triangle]].clean)
        return false;
    return setup->cavity == SP_CAVITY_NONE ? side == 0 : (evaluator->wet->sides[triangle] >> side) & 1;
}

double sp_evaluator_counted(const sp_evaluator *evaluator, uint32_t patch)
{
    const sp_patches *patches = &evaluator->patches;
    const sp_setup *setup = &evaluator->setup;
    bool clean = setup->surfaces[setup->mesh->part[patches->triangle[patch]]].clean;
    return evaluator->everything && !clean ? 0 : patches->area[patch];
}

double sp_counted_area(const sp_evaluator *evaluator, uint32_t triangle)
{
    int sides = sp_side_is_counted(evaluator, triangle, 0) + sp_side_is_counted(evaluator, triangle, 1);
    return sides * sp_triangle_area(evaluator->setup.mesh, triangle);
}

bool sp_point_is_counted(const sp_evaluator *evaluator, uint32_t triangle, double u, double v, unsigned side)
{
    return sp_side_is_counted(evaluator, triangle, side) && (sp_wet_at(evaluator->wet, triangle, u, v) >> side & 1);
}

uint32_t sp_patch_at(const sp_evaluator *evaluator, uint32_t triangle, double u, double v, bool back)
{
    unsigned side = evaluator->setup.cavity != SP_CAVITY_NONE && back;
    if (!sp_point_is_counted(evaluator, triangle, u, v, side))
        return SP_NONE;
    return evaluator->texel_patch[sp_atlas_texel(evaluator->atlas, triangle, u, v)][side];
}

/* A fragment on its way through the cells of its triangle. */
typedef struct {
    const sp_evaluator *evaluator;
    uint32_t triangle;
    unsigned side;
    double scale; /* m² as the atlas measured it, per unit of weights */
    double least; /* m²: smaller pieces are round-off at a cut */
    sp_counted_visitor *visit;
    void *user;
} cell_walk;

static double area_in_weights(const sp_triangle_piece *piece)
{
    double twice = 0;
    for (int i = 2; i < piece->count; i++) {
        const double *a = piece->at[0], *b = piece->at[i - 1], *c = piece->at[i];
        twice += (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    }
    return fabs(twice) / 2;
}

static void visit_cell(void *user, uint32_t cell, const sp_triangle_piece *part)
{
    const cell_walk *walk = user;
    const sp_mesh *mesh = walk->evaluator->setup.mesh;
    size_t face = mesh->triangle_count + cell;
    double area = area_in_weights(part) * walk->scale;
    if (!walk->evaluator->wet->flooded.liquid[2 * face + walk->side] || !(area > walk->least))
        return;
    sp_vec3 polygon[SP_PIECE_POINTS];
    for (int i = 0; i < part->count; i++)
        polygon[i] = sp_triangle_point(mesh, walk->triangle, part->at[i][0], part->at[i][1]);
    walk->visit(walk->user, polygon, part->count, area);
}

/* `piece` of a triangle, of `area` m², cell by cell. */
static void visit_cells(const sp_evaluator *evaluator, uint32_t triangle, unsigned side, const sp_triangle_piece *piece,
                        double area, sp_counted_visitor *visit, void *user)
{
    double weights = area_in_weights(piece);
    cell_walk walk = {evaluator, triangle, side, weights > 0 ? area / weights : 0, ROUND_OFF * area, visit, user};
    sp_cuts_split(&evaluator->wet->cuts, triangle, piece, visit_cell, &walk);
}

void sp_counted_pieces(const sp_evaluator *evaluator, uint32_t texel, const sp_fragment *fragment, unsigned side,
                       sp_counted_visitor *visit, void *user)
{
    const sp_mesh *mesh = evaluator->setup.mesh;
    uint32_t triangle = fragment->triangle;
    if (!sp_side_is_counted(evaluator, triangle, side))
        return;
    sp_vec3 polygon[SP_FRAGMENT_POINTS];
    int corners = sp_atlas_fragment_polygon(evaluator->atlas, mesh, texel, triangle, polygon);
    if (evaluator->wet->whole[triangle] >> side & 1) {
        visit(user, polygon, corners, fragment->area);
        return;
    }
    sp_triangle_piece piece = {.count = corners};
    for (int i = 0; i < corners; i++)
        sp_triangle_weights(mesh, triangle, polygon[i], &piece.at[i][0], &piece.at[i][1]);
    visit_cells(evaluator, triangle, side, &piece, fragment->area, visit, user);
}

void sp_counted_parts(const sp_evaluator *evaluator, uint32_t triangle, unsigned side, sp_counted_visitor *visit,
                      void *user)
{
    const sp_mesh *mesh = evaluator->setup.mesh;
    double area = sp_triangle_area(mesh, triangle);
    sp_triangle_piece all = {3, {{0, 0}, {1, 0}, {0, 1}}};
    if (!sp_side_is_counted(evaluator, triangle, side))
        return;
    if (!(evaluator->wet->whole[triangle] >> side & 1)) {
        visit_cells(evaluator, triangle, side, &all, area, visit, user);
        return;
    }
    sp_vec3 corners[3];
    for (int i = 0; i < 3; i++)
        corners[i] = sp_triangle_point(mesh, triangle, all.at[i][0], all.at[i][1]);
    visit(user, corners, 3, area);
}
