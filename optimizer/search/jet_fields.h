/* What nozzles bring to the search's patches where walls throw liquid back: as jets find it, which fly on, and not by
 * the flights to the first impact that the search goes by. */
#ifndef OPTIMIZER_JET_FIELDS_H
#define OPTIMIZER_JET_FIELDS_H

#include "deadline/deadline.h"
#include "scoring/partial.h"

typedef struct {
    sp_search search;           /* the same, but for what the kept nozzles bring */
    size_t count;               /* of the nozzles; 0: none was flown */
    sp_placed *items;           /* [count], the same but for their fields */
    const sp_placed **flown;    /* [count], the items */
    float *fields;              /* one after the other, of which several items may share one */
    float *kept_hit, *kept_dry; /* of `search` */
} sp_jet_fields;

/* Of `nozzles` [count], of the search's layouts, with as many reflections as `fine` counts; none where time is too
 * short, or the run is interrupted. The film is what the search says. Freed by the caller, after failure too. */
bool sp_jet_fields_create(const sp_search *search, const sp_evaluator *fine, const sp_placed *const *nozzles,
                          size_t count, sp_deadline *deadline, sp_jet_fields *fields, sp_error *error);
void sp_jet_fields_free(sp_jet_fields *fields);

#endif
