/* How what runs on each cell, or pool, is shared among those below. */
#ifndef FILM_SHARES_H
#define FILM_SHARES_H

#include "film/pools.h"

/* What leaves a cell, or over a pool's rim. */
typedef struct {
    uint32_t from; /* the cell that stands for it, see sp_film_basins */
    uint32_t to;   /* the same, of lower rank; or SP_FILM_LEFT, SP_FILM_ASTRAY, SP_FILM_HELD */
    double width;  /* m, across the flow */
} sp_film_share;

typedef struct {
    size_t count, capacity;
    sp_film_share *items; /* of each cell that stands for itself or a pool at least one */
    double *width;        /* [cells], m: across all that leaves it, of those that stand for themselves or a pool */
} sp_film_shares;

bool sp_film_shares_create(const sp_film_surface *surface, const sp_film_links *links, const uint32_t *ends,
                           const sp_film_order *order, const sp_film_basins *basins, sp_film_shares *shares,
                           sp_error *error);
void sp_film_shares_free(sp_film_shares *shares);

#endif
