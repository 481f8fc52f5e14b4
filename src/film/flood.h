/* The order in which liquid empties the cells: from where it leaves the surface upwards, hollows after their rim. */
#ifndef FILM_FLOOD_H
#define FILM_FLOOD_H

#include "film/ends.h"

typedef struct {
    uint32_t *rank;   /* [cells], 0 for the first: liquid runs to lower ranks alone */
    uint32_t *parent; /* [cells], the cell from which each was reached; SP_NONE where liquid ends */
    bool *sunk;       /* [cells], below the rim that liquid has to rise to */
    bool *held;       /* [cells], where it stands, since no way leads out */
    bool *over;       /* [cells], liquid stands there as high as the free edge of a sheet, and runs over it */
} sp_film_order;

/* Priority flood (Barnes, Lehman, Mulla 2014) over borders and `ends`. Liquid stands at the lowest cell of what no way
 * leads out of, and of a hollow deeper than 5 % of the geometry's height: that is a vessel without its drain. A cell
 * comes after all that it runs to, though the point of one lie higher, as those of parts of texels may. */
bool sp_film_order_create(const sp_film_surface *surface, const sp_film_links *links, const uint32_t *ends,
                          sp_film_order *order, sp_error *error);
void sp_film_order_free(sp_film_order *order);

#endif
