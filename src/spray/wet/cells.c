/* Cells, looked up in the cuts that made them. */
#include "spray/wet/cuts.h"

#include <string.h>

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

void sp_piece_clip(const sp_triangle_piece *piece, const sp_cut *cut, int way, sp_triangle_piece *part)
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
        sp_piece_clip(piece, &cuts->cuts[node], side ? 1 : -1, &part);
        split_below(cuts, cuts->cuts[node].child[side], &part, visit, user);
    }
}

void sp_cuts_split(const sp_cuts *cuts, uint32_t triangle, const sp_triangle_piece *piece, sp_cell_visitor *visit,
                   void *user)
{
    split_below(cuts, cuts->root[triangle], piece, visit, user);
}
