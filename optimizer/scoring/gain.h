/* What a nozzle would add to a partial layout, by its field or footprint. */
#ifndef OPTIMIZER_GAIN_H
#define OPTIMIZER_GAIN_H

#include "scoring/partial.h"
#include "scoring/footprint.h"

typedef struct {
    double gain; /* m² by which the partial layout's value would rise */
    double
        room; /* m² by which it could rise at most, whatever the flow: never grows while a partial layout only grows */
} sp_score;

/* What a field adds to a partial layout, where film is asked for. */
sp_score sp_field_score(const sp_search *search, const sp_partial *partial, const float *field);
/* What it gains, whatever is asked for. */
double sp_field_gain(const sp_search *search, const sp_partial *partial, const float *field);

/* What one more nozzle in a pose adds: `gain`, which its field or footprint would, unless one with its edges stands
 * there already. Of one that sprays more than that and has edges where that is too weak for any, about. */
double sp_gain_at(const sp_search *search, const sp_partial *partial, sp_pose pose, double gain);

/* What a footprint adds to a partial layout. */
sp_score sp_footprint_score(const sp_search *search, const sp_partial *partial, const sp_footprint *footprint);

#endif
