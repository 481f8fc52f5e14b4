/* What of the spray runs down the walls as a film. */
#ifndef SPRAY_FALLING_FILM_H
#define SPRAY_FALLING_FILM_H

#include "film/film.h"
#include "spray/state/state.h"

typedef struct sp_falling_film {
    sp_evaluator *walls; /* all wet sides, cleaned or not, in cells: owned, or the evaluator itself */
    sp_film *film;       /* on them */
    uint32_t *cell;      /* [patches of the evaluator], the cell that holds each patch's point */
    double girth;        /* m, around all walls, seen from above */
    size_t hollow_count;
    sp_hollow hollows[SP_HOLLOWS];
    sp_mesh_diagnosis flaws; /* of the mesh, of which only the cracks are looked for */
} sp_falling_film;

/* The evaluator's falling film, where its criterion asks for film. True where it does not. */
bool sp_falling_film_create(sp_evaluator *evaluator, sp_error *error);
/* Of the evaluator, which may have none. */
void sp_falling_film_destroy(sp_evaluator *evaluator);
/* Fills in the film of every patch, and where it ends, for what arrives on the walls from a layout of nozzles of one
 * pattern each at the first impact: what a wall throws back is taken to run down it all the same. */
bool sp_falling_film_find(const sp_falling_film *falling_film, const sp_layout *layout, sp_coverage *coverage,
                          sp_error *error);

#endif
