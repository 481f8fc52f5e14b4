/* What a nozzle brings by itself to what decides whether patches are covered. Liquid of one does not depend on the
 * others', whichever way it flies or runs down: what any of them do together follows from what each does alone. */
#ifndef SPRAY_ALONE_H
#define SPRAY_ALONE_H

#include <sprayplan/evaluator.h>

/* [patches] each, as sp_deposits has them. */
typedef struct {
    double *even, *dry;
    double *film; /* NULL where the criterion does not ask for it */
} sp_alone;

/* A coverage's own; of no nozzle at all for NULL. False, with the error set and nothing to free, without memory. */
bool sp_alone_create(const sp_evaluator *evaluator, const sp_coverage *coverage, sp_alone *alone, sp_error *error);
void sp_alone_free(sp_alone *alone);
/* Bytes that it holds. */
size_t sp_alone_size(const sp_evaluator *evaluator);
/* Adds one nozzle's to that of others; without its edges where others count them (see sp_layout_repeats). */
void sp_alone_join(const sp_evaluator *evaluator, sp_alone *all, const sp_alone *one, bool edges);
/* m² of what is to be cleaned. */
double sp_alone_covered(const sp_evaluator *evaluator, const sp_alone *alone);

#endif
