/* Scoring: what a pose would add to a partial layout, by summing over what its mounting point can reach. */
#ifndef OPTIMIZER_SCORING_H
#define OPTIMIZER_SCORING_H

#include "scoring/field.h"
#include "scoring/gain.h"

/* What scores many poses one after the other, those of one mounting point together: what an arrival is worth to a
 * variant does not depend on where the nozzle points, so that it is found once and then only summed. One thread's own.
 * The arrivals at one patch count one after the other, which matters only where they fall short. */
typedef struct {
    float *block;                    /* holds the four */
    float *had, *area, *room, *gain; /* [largest view + SP_LANES], by arrival */
    float *field;                    /* [field_count], where film or footprints are: of the pose in hand */
    sp_field_scratch fields;         /* the same, which takes `had` and `area` for its own */
    const sp_partial *partial;
    float room_total[SP_BINS], gain_total[SP_BINS];
    const sp_search *search; /* what it looks at, NULL: nothing */
    const sp_view *view;
    sp_view_buffer *buffer; /* NULL, or what the view lies on */
    uint32_t site;
    size_t launch;
    size_t variant;   /* SIZE_MAX: none */
    sp_frame frame;   /* the site's */
    sp_region region; /* the variant's, about the site's axis */
    sp_cull cull;     /* of the variant */
} sp_scorer;

/* Threads that may score at a time: no more than memory has buffers for. */
int sp_scorer_threads(const sp_search *search);
/* One for each of `count` threads; NULL on error. */
sp_scorer *sp_scorers_create(const sp_search *search, int count, sp_error *error);
void sp_scorers_destroy(sp_scorer *scorers, int count);
/* Says that what is wet, or the search's credit, has changed, and leaves the buffer: all scorers of a loop are to
 * forget at its end, before anyone else looks. */
void sp_scorers_forget(sp_scorer *scorers, int count);
/* Turns to what a site's nozzles of a launch would add to a partial layout. */
void sp_scorer_look(sp_scorer *scorer, const sp_search *search, const sp_partial *partial, uint32_t site,
                    size_t launch);
/* Then to a variant of that launch. Both do nothing where the scorer has not turned elsewhere since, nor forgotten. */
void sp_scorer_take(sp_scorer *scorer, size_t variant);
/* Then to its poses; where the gain is less than `least`, m², either may come out higher, the gain still below that. */
sp_score sp_scorer_score(const sp_scorer *scorer, uint32_t axis, uint32_t roll, double least);
/* Or to a pose's field, as the kernels have it, where film is asked for, or of its footprint: the scorer's, until the
 * next. */
const float *sp_scorer_field(const sp_scorer *scorer, uint32_t axis, uint32_t roll);
/* What none of the variant's poses gains more than, m²; INFINITY where its bins do not tell. */
double sp_scorer_most(const sp_scorer *scorer);
/* Looks, takes and scores at once. */
sp_score sp_score_pose(sp_scorer *scorer, const sp_search *search, const sp_partial *partial, sp_pose pose,
                       double least);

/* False where what a variant's poses at a site bring was left out for want of time. */
bool sp_search_knows(const sp_search *search, uint32_t site, size_t variant);

/* The region of a pose at the site that the scorer looks at, of the variant that it took. */
sp_region sp_scorer_region(const sp_scorer *scorer, uint32_t axis, uint32_t roll);

#endif
