/* Visibility: what each mounting point can reach by each launch, whatever the nozzle's axis, roll and type. Traced once
 * and kept as far as the options' memory allows; of what does not fit only what is in sight is kept, two bits a patch,
 * and the rest is worked out again whenever it is looked at, and is the same then. Of several ranks each traces its own
 * mounting points, and keeps these before the others', of which all hear what is in sight. */
#ifndef OPTIMIZER_VISIBILITY_H
#define OPTIMIZER_VISIBILITY_H

#include "scoring/view.h"
#include "deadline/deadline.h"

/* Where one view at a time is worked out that is not kept. */
typedef struct sp_view_buffer {
    void *block;
    sp_view view;
    size_t at; /* which view that is; SIZE_MAX: none */
    struct sp_view_buffer *next;
} sp_view_buffer;

/* The buffers, each in use or idle. */
typedef struct sp_view_buffers sp_view_buffers;

typedef struct {
    const sp_evaluator *evaluator; /* borrowed, as the next three: the coarse one that is traced on */
    const sp_place_options *options;
    const sp_sites *sites;
    const sp_candidates *candidates;
    size_t site_count, launch_count;
    size_t largest;  /* most arrivals of a view */
    size_t cells;    /* most of them, of cells, that one part of the tracing has */
    sp_view *views;  /* [site_count x launch_count], those that are kept */
    bool *known;     /* [site_count x launch_count], traced before the time was up */
    bool hurried;    /* not all were, or time was too short for patches as fine as at leisure */
    uint8_t *sights; /* [site_count x launch_count][sight_bytes], bit 2 patch + arc: whether the way is free */
    size_t sight_bytes;
    double memory;    /* bytes that the options allow it and footprints together */
    double prints;    /* of them, what footprints come to at most */
    double bytes;     /* most that views, buffers and tracing take at any time; the rest is left to footprints */
    int buffer_count; /* threads that may look at a time */
    sp_view_buffers *buffers;
    sp_bins bins;
} sp_visibility;

/* Half-angle (rad) about the site's axis that holds all that its candidates of this launch can reach, those that
 * kernels know; negative: there are none. */
double sp_visibility_needed(const sp_place_options *options, const sp_candidates *candidates, const sp_site *site,
                            size_t launch);
/* Traces all views on patches as fine as time allows: those of *resampled, or of `fine` itself where that stays NULL.
 * The caller destroys it. */
bool sp_visibility_fit(const sp_evaluator *fine, const sp_place_options *options, const sp_sites *sites,
                       const sp_candidates *candidates, sp_deadline *deadline, sp_evaluator **resampled,
                       sp_visibility *visibility, sp_error *error);
/* Traces all views on the patches of `coarse`. Sites left out when the time ends see nothing. Footprints, which are all
 * kept, are left what they may come to, or half of the memory. Fails with SP_ERROR_INPUT where the rest does not hold
 * one view and what tracing it takes. */
bool sp_visibility_create(const sp_evaluator *coarse, const sp_place_options *options, const sp_sites *sites,
                          const sp_candidates *candidates, sp_deadline *deadline, sp_visibility *visibility,
                          sp_error *error);
void sp_visibility_free(sp_visibility *visibility);
/* False where a look has failed since; what was looked at then was empty. */
bool sp_visibility_sound(const sp_visibility *visibility, sp_error *error);

/* The view of a site, without `start` where nothing is known. A view that was not kept is traced again into *buffer,
 * which is NULL or from an earlier look: it is valid until the next look with that buffer, or its release. Blocks while
 * all buffers are in use, so a thread that held two, or more than buffer_count threads that held one while they waited
 * for each other, would deadlock. Thread-safe otherwise. */
const sp_view *sp_visibility_look(const sp_visibility *visibility, uint32_t site, size_t launch,
                                  sp_view_buffer **buffer);
/* Gives the buffer back and sets *buffer to NULL; nothing where it is NULL. */
void sp_visibility_release(const sp_visibility *visibility, sp_view_buffer **buffer);

static inline bool sp_visibility_known(const sp_visibility *visibility, uint32_t site, size_t launch)
{
    return visibility->known[site * visibility->launch_count + launch];
}

#endif
