/* Which cells do not hold their film. */
#ifndef FILM_DRIPS_H
#define FILM_DRIPS_H

#include "film/links.h"

/* Fills in links->drips: a ceiling flatter than 10° on the mean over a wave of the liquid, and what hangs lower than
 * all within it. */
bool sp_film_drips_find(const sp_film_surface *surface, sp_film_links *links, sp_error *error);

#endif
