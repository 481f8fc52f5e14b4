/* What the files of branch and bound share: values of branches at the last prices, and how a branch parts. */
#ifndef OPTIMIZER_BRANCH_WORK_H
#define OPTIMIZER_BRANCH_WORK_H

#include "bound/branch.h"

/* Most nozzles that a layout of the branch can have. */
size_t sp_branch_nozzles(const sp_branching *b, const sp_branch *branch);
/* Nozzles of this kind and lighter that number and water allow. */
size_t sp_rest_fits(const sp_branching *b, size_t kind, size_t nozzles, size_t water);

/* Prices all that is alive at u. */
bool sp_branching_price(sp_branching *b, const sp_tree *tree, const sp_prices *u, sp_error *error);
/* No layout of the branch covers more, by the last prices; INFINITY where they do not hold for it. */
bool sp_branch_value(sp_branching *b, const sp_branch *branch, double *value, sp_error *error);
/* Lowers all open branches by the last prices, closes those that hold nothing better than what was found, and shuts out
 * candidates that no open branch needs. */
bool sp_tree_lower(sp_branching *b, sp_tree *tree, sp_error *error);
/* Marks which candidates are alive up to every position. */
void sp_branching_count_alive(sp_branching *b, const sp_tree *tree);

/* Parts open branch i by the last prices; a layout that is all that is left of it is covered exactly. */
bool sp_tree_part(sp_branching *b, sp_tree *tree, size_t i, sp_error *error);
/* Takes open branch i out. */
sp_branch sp_tree_take(sp_tree *tree, size_t i);

#endif
