/* One run of PDHG, the primal-dual hybrid gradient method, that sp_dual_solve makes: steps, and looks at where they
 * lead. */
#ifndef OPTIMIZER_PDHG_H
#define OPTIMIZER_PDHG_H

#include "bound/dual.h"

/* Everything that a run needs. Resources: water, number, ports. */
typedef struct {
    sp_dual *dual;
    const sp_rows *rows;
    const sp_dual_task *task;
    double *tau;         /* [rows], of the step in x; 0: a row that cannot be chosen */
    double *sigma;       /* [2 texels], plain and strengthened, as all that follows of [2 texels] */
    float *strengthened; /* [rows->used], the shares strengthened; NULL: no inequalities */
    double *dual_resource, *sigma_resource, *load, *use; /* [resources]; load: Σ of a row's use over the rows */
    double *price, *price_sum;                           /* [rows] */
    double *x_sum, *x_bar;                               /* [rows] */
    double *u_sum;                                       /* [2 texels] */
    sp_multipliers u_last, u_mean;
    double *resource_sum;
    float *cover; /* [2 texels], Σ share x */
    double *x_start, *u_start;
    sp_knapsack knapsack;
    sp_offers offers;
    double scale; /* of the resource rows, so that their steps keep up with the texels' */
    size_t resources, since;
    double gap_start;
} sp_pdhg;

/* dual->x and dual->choice have room for all rows. */
bool sp_pdhg_create(sp_dual *dual, const sp_rows *rows, const sp_dual_task *task, sp_pdhg *h, sp_error *error);
void sp_pdhg_free(sp_pdhg *h);
void sp_pdhg_step(sp_pdhg *h);
/* Looks at where the steps stand and at their average, and notes in the dual what is best; true where bound and linear
 * program are near enough. */
bool sp_pdhg_look(sp_pdhg *h, size_t iteration);

/* What one unit of a row takes: of how many resources, which, and how much. */
typedef struct {
    size_t count, resource[3];
    double amount[3];
} sp_takes;
sp_takes sp_pdhg_takes(const sp_pdhg *h, size_t row);
double sp_pdhg_limit(const sp_pdhg *h, size_t resource);
/* cover = Σ share x. */
void sp_pdhg_add_up(sp_pdhg *h, const double *x);

#endif
