/* What a nozzle would add to a draft, by its field or footprint. */
#ifndef OPTIMIZER_GAIN_H
#define OPTIMIZER_GAIN_H

#include "scoring/draft.h"
#include "scoring/footprint.h"

typedef struct {
    double gain; /* m² by which the draft's value would rise */
    double room; /* m² by which it could rise at most, whatever the flow: never grows while a draft only grows */
} sp_score;

/* What a field adds to a draft, where film is asked for. */
sp_score sp_field_score(const sp_search *search, const sp_draft *draft, const float *field);
/* What it gains, whatever is asked for. */
double sp_field_gain(const sp_search *search, const sp_draft *draft, const float *field);

/* What a footprint adds to a draft. */
sp_score sp_footprint_score(const sp_search *search, const sp_draft *draft, const sp_footprint *footprint);

#endif
