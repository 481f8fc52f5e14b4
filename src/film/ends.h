/* Where liquid goes that leaves a cell and finds no other across its border: to another body, or down through the air.
 */
#ifndef FILM_ENDS_H
#define FILM_ENDS_H

#include "film/links.h"

/* In place of a cell. */
#define SP_FILM_LEFT (SP_NONE - 1)   /* it meets nothing any more */
#define SP_FILM_ASTRAY (SP_NONE - 2) /* it lands on surface that is not wet */
#define SP_FILM_SHUT (SP_NONE - 3)   /* it does not leave: another body stands there */
#define SP_FILM_HELD (SP_NONE - 4)   /* it stands there */

static inline bool sp_film_is_cell(uint32_t to)
{
    return to < SP_FILM_HELD;
}

/* For every cell the one that it drips on, or its border with nothing beyond leads to; SP_FILM_LEFT, SP_FILM_ASTRAY,
 * SP_FILM_SHUT; SP_NONE where all that leaves it crosses links. [cells]; the caller frees; NULL where memory ran out.
 */
uint32_t *sp_film_ends_find(const sp_film_surface *surface, const sp_film_links *links, sp_error *error);

#endif
