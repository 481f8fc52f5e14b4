/* Charts and texels of an evaluator's lengths. */
#ifndef SPRAY_RESOLUTION_H
#define SPRAY_RESOLUTION_H

#include "spray/state/state.h"

#define SP_PLAIN_TEXELS 100000 /* on what is cleaned and counted, where the texel is left open and nothing measured */

/* The texel (m) of which all that is cleaned and counted has so many; what else there is, however large, does not make
 * it longer. 0 where nothing is. Needs the wet sides. */
double sp_texel_of(const sp_evaluator *evaluator, double texels);
/* Jets of a nozzle that suffice for texels of this length (m), as far as there is time to trace them. */
uint64_t sp_jets_for(const sp_evaluator *evaluator, double texel);
/* Atlas and patches of the evaluator's own lengths, or in proportion to those of `fine`, in place of any there are.
 * Jets that are left open follow from the lengths. Makes charts where there are none that serve these lengths. */
bool sp_texels_create(sp_evaluator *evaluator, const sp_evaluator *fine, sp_error *error);
void sp_texels_free(sp_evaluator *evaluator);

#endif
