/* The naive kd-tree: the middle of the longest side, until few triangles are left (study, 3.2.2.1). */
#include "trace/kd_tree.h"

enum { FEW = 8 };

static bool choose_middle(const kd_box *boxes, const kd_cell *cell, kd_plane *plane)
{
    (void)boxes;
    plane->axis = KD_LEAF;
    if (cell->count <= FEW)
        return true;
    uint32_t longest = 0;
    for (uint32_t axis = 1; axis < 3; axis++)
        if (cell->high[axis] - cell->low[axis] > cell->high[longest] - cell->low[longest])
            longest = axis;
    double middle = 0.5 * (cell->low[longest] + cell->high[longest]);
    if (middle > cell->low[longest] && middle < cell->high[longest])
        *plane = (kd_plane){middle, longest};
    return true;
}

bool kd_tree_naive(const sp_mesh *mesh, kd_tree *tree) { return kd_tree_build(mesh, choose_middle, tree); }
