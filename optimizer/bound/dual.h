/* Lagrange multipliers of texels that make the best layout's bound low: the Lagrangian dual of maximum coverage.
 *
 * For multipliers 0 <= u <= area no layout covers more than Σ (area - u) + the most that Σ u share of its nozzles can
 * come to. That holds for any u, and for any valid inequality of the shares; the iterations here only look for good
 * ones. */
#ifndef OPTIMIZER_DUAL_H
#define OPTIMIZER_DUAL_H

#include "bound/cover.h"

typedef struct {
    const sp_cover *cover;
    size_t texels;
    sp_multipliers multipliers; /* the best found by the last solve */
    double bound;               /* m² that it shows for the rows it was solved on, cover->base included */
    double reached;        /* m² that fractions of those rows do cover (the linear program's own value, from below) */
    size_t row_capacity;   /* of what follows */
    double *choice;        /* [rows], fraction of each row in the average of the last solve */
    sp_multipliers u;      /* where the iterations stand */
    double *x;             /* [rows] */
    double *dual_resource; /* [2 + ports], of water, number and ports */
    double weight;         /* primal weight: steps in multipliers over steps in choice */
} sp_dual;

/* What the last solve chose of a row; nothing of rows that have come since. */
static inline double sp_dual_choice(const sp_dual *dual, size_t row)
{
    return row < dual->row_capacity ? dual->choice[row] : 0;
}

bool sp_dual_create(const sp_cover *cover, sp_dual *dual, sp_error *error);
void sp_dual_free(sp_dual *dual);

/* What a solve is about. */
typedef struct {
    size_t nozzles, water; /* at most, above 0; no more than the cover's */
    size_t iterations;     /* at most */
    double tolerance;      /* ends where bound and linear program are this near, as a share of the bound */
    const sp_valid_inequalities *inequalities; /* for as many nozzles at least, or NULL */
    size_t coarse;                             /* iterations on groups of texels, at most, before these */
    const float *strengthened; /* [rows->used], the shares strengthened; NULL: as inequalities and kinds make them */
} sp_dual_task;

/* Room for the choices of so many rows. */
bool sp_dual_make_room(sp_dual *dual, size_t rows, sp_error *error);
/* Gives every texel the inequality under which what the last solve chose covers it least. */
bool sp_dual_strengthen(sp_dual *dual, const sp_rows *rows, const sp_valid_inequalities *inequalities, sp_error *error);
/* After sp_rows_keep with the same marks. */
void sp_dual_keep(sp_dual *dual, size_t rows, const bool *marked);

#endif
