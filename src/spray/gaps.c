/* How far the surface is from the tracks of a two-axis head. */
#include "nozzle_bodies.h"
#include "nozzle/frame.h"
#include "nozzle/rotation.h"
#include "nozzle/valid.h"
#include "reach.h"

#include <sprayplan/tracks.h>

#include <stdlib.h>

typedef struct {
    double gap, area; /* m, m² */
} gap_share;

static int by_gap(const void *left, const void *right)
{
    const gap_share *a = left, *b = right;
    if (a->gap != b->gap)
        return a->gap < b->gap ? -1 : 1;
    return (a->area > b->area) - (a->area < b->area);
}

/* One share a patch, of its nearest arrival; returns how many. */
static size_t list_shares(const sp_emitter *emitter, const sp_reach *reach, const sp_rotation *rotation,
                          gap_share *shares)
{
    const sp_frame *frame = &emitter->frame;
    const double *area = emitter->source.evaluator->patches.area;
    size_t count = 0;
    for (size_t i = 0; i < reach->count; i++) {
        const sp_arrival *arrival = &reach->arrivals[i];
        sp_vec3 local = sp_frame_local(frame, arrival->direction);
        double gap =
            sp_track_angle(rotation, rotation->turns, local) * sp_distance(emitter->source.position, arrival->point);
        bool same = i > 0 && reach->arrivals[i - 1].patch == arrival->patch;
        count += !same;
        shares[count - 1] = (gap_share){same ? fmin(gap, shares[count - 1].gap) : gap, area[arrival->patch]};
    }
    return count;
}

static void draw_figures(gap_share *shares, size_t count, sp_track_gaps *gaps)
{
    qsort(shares, count, sizeof *shares, by_gap);
    for (size_t i = 0; i < count; i++) {
        gaps->area += shares[i].area;
        gaps->mean += shares[i].area * shares[i].gap;
    }
    double within = 0;
    for (size_t i = 0; i < count && within < 0.95 * gaps->area; i++) {
        within += shares[i].area;
        gaps->p95 = shares[i].gap;
    }
    gaps->known = count > 0;
    gaps->mean = count > 0 ? gaps->mean / gaps->area : 0;
    gaps->greatest = count > 0 ? shares[count - 1].gap : 0;
}

bool sp_find_track_gaps(const sp_evaluator *evaluator, const sp_nozzle *nozzle, sp_track_gaps *gaps, sp_error *error)
{
    if (!evaluator || !nozzle || !sp_nozzle_is_valid(nozzle, error))
        return false;
    const sp_rotation *rotation = &nozzle->type->rotation;
    *gaps = (sp_track_gaps){.known = false};
    if (!sp_type_has_tracks(nozzle->type))
        return true;
    sp_layout one = {.count = 1, .nozzles = (sp_nozzle[]){*nozzle}};
    sp_bodies bodies;
    bool flies = sp_bodies_create(evaluator, &one, &bodies, error) && sp_bodies_fly(evaluator, &bodies, error);
    sp_emitter emitter = flies ? sp_bodies_emitter(evaluator, &bodies, 0) : (sp_emitter){0};
    sp_aim aim = sp_aim_at(emitter.frame.z, sp_spray_reach(&emitter.spray));
    sp_reach *reach = flies ? sp_reach_create(&emitter.source, &aim, error) : NULL;
    gap_share *shares = reach ? malloc((reach->count + 1) * sizeof *shares) : NULL;
    bool done = shares || (reach && sp_fail_memory(error));
    if (done) {
        gaps->turns = rotation->turns ? rotation->turns : sp_track_turns(rotation);
        gaps->duration = rotation->speed > 0 ? 2 * M_PI * gaps->turns / rotation->speed : NAN;
        draw_figures(shares, list_shares(&emitter, reach, rotation, shares), gaps);
    }
    free(shares);
    sp_reach_destroy(reach);
    sp_bodies_free(&bodies);
    return done;
}
