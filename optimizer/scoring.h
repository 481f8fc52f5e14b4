/* Scoring: what a pose would add to a design, by sweeping what its mounting point can reach. */
#ifndef OPTIMIZER_SCORING_H
#define OPTIMIZER_SCORING_H

#include "design.h"

typedef struct {
    double gain; /* m² by which the design's value would rise */
    double room; /* m² by which it could rise at most, whatever the flow: never grows while a design only grows */
} sp_score;

/* The worth of a patch per m² at this flux over threshold. */
static inline float sp_worth(const sp_search *search, float wet)
{
    return wet >= 1 ? 1 : search->credit * wet;
}

/* Both arcs of a parabola to the same patch count one after the other, which matters only where both fall short. */
sp_score sp_score_pose(const sp_search *search, const float *wet, sp_pose pose);
/* [patch_count], flux over threshold of a candidate pose; of any nozzle, traced anew. */
void sp_field_pose(const sp_search *search, sp_pose pose, float *field);
bool sp_field_nozzle(const sp_search *search, const sp_nozzle *nozzle, float *field, sp_error *error);
/* The same from what was traced from its position at its speed. */
void sp_field_reach(const sp_search *search, const sp_nozzle *nozzle, const sp_reach *reach, float *field);
/* What a field adds to a design. */
double sp_field_gain(const sp_search *search, const float *wet, const float *field);

#endif
