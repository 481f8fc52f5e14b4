/* What the handle holds. */
#ifndef LIVE_STATE_H
#define LIVE_STATE_H

#include "live/live.h"
#include "spray/inverse.h"

/* A nozzle as it was laid last. */
typedef struct {
    bool laid; /* `alone` is what `nozzle` brings, on the patches of `stride`: on all of them where that is 1 */
    unsigned stride;
    sp_nozzle nozzle;
    sp_coverage *alone; /* sums, not yet means; NULL where it is off */
    sp_reach *reach;    /* all that its one pattern reaches in any direction; NULL: not known */
    sp_source source;   /* of the reach */
    uint64_t used;      /* when the reach was, in evaluations */
} sp_live_nozzle;

/* Patches that stand for those beside them. */
typedef struct {
    unsigned stride;    /* 0: not made */
    bool *among;        /* [patches], these */
    uint32_t *standing; /* [patches], the one that stands for each */
} sp_live_sample;

struct sp_live {
    void *arrays[SP_LIVE_ARRAYS];
    size_t bytes[SP_LIVE_ARRAYS];
    sp_mesh mesh; /* arrays are the handle's */
    sp_surface *surfaces;
    size_t type_count;
    sp_nozzle_type *types;
    sp_member *members;
    sp_evaluator *evaluator;
    sp_live_sample sample;
    size_t nozzle_count;
    sp_live_nozzle *nozzles; /* [nozzle_count] */
    uint64_t evaluations;
    sp_coverage *coverage;
    double figures[SP_LIVE_FIGURE_COUNT];
    double shadow_list[SP_LIVE_SHADOWS][SP_LIVE_SHADOW_NUMBERS];
    uint32_t *shadow_of;                 /* [patches] */
    double (*boxes)[6];                  /* of the accelerator's leaves; NULL: nobody asked */
    double (*legs)[SP_LIVE_LEG_NUMBERS]; /* of the jets flown last */
    double foot[6];
    sp_error error;
    char text[1400];
};

/* types.c: from what was handed over. */
bool sp_live_make_types(sp_live *live);
void sp_live_free_types(sp_live *live);
/* evaluate.c: nozzle `index` of those handed over; false where it is off, or none. */
bool sp_live_nozzle_on(sp_live *live, size_t index, sp_nozzle *nozzle);
/* sample.c: as sp_live_evaluate says. */
bool sp_live_take_sample(sp_live *live, unsigned stride);
void sp_live_free_sample(sp_live_sample *sample);
/* nozzle.c: what one brings, traced only as far as it has changed; counts in figures[SP_LIVE_TRACED]. */
bool sp_live_lay(sp_live *live, sp_live_nozzle *kept, const sp_nozzle *nozzle, unsigned stride);
void sp_live_forget(sp_live_nozzle *kept);

#endif
