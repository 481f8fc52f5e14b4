/* Hollows and flats: cells that fill together before liquid leaves them, over their rim. */
#ifndef FILM_POOLS_H
#define FILM_POOLS_H

#include "film/flood.h"

typedef struct {
    uint32_t *of; /* [cells], the cell that stands for each: itself, or of its pool the one of lowest rank */
    bool *pooled; /* [cells] */
} sp_film_basins;

bool sp_film_basins_create(const sp_film_surface *surface, const sp_film_links *links, const uint32_t *ends,
                           const sp_film_order *order, sp_film_basins *basins, sp_error *error);
void sp_film_basins_free(sp_film_basins *basins);

#endif
