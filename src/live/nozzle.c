/* What one nozzle brings. What it may reach in any direction depends on its position and speed alone, and is kept while
 * these stay: once it is known, a turn, a roll, another angle or flow, or a type that is as fast, traces nothing. */
#include "live/state.h"

#include "spray/nozzle_bodies.h"

#include <stdlib.h>
#include <string.h>

#define KEPT_MOST 1000000 /* arrivals of all reaches, some 150 MB */

void sp_live_forget(sp_live_nozzle *kept)
{
    sp_coverage_destroy(kept->alone);
    sp_reach_destroy(kept->reach);
    *kept = (sp_live_nozzle){0};
}

static bool same_source(const sp_source *a, const sp_source *b)
{
    return a->position.x == b->position.x && a->position.y == b->position.y && a->position.z == b->position.z &&
           a->speed == b->speed;
}

/* Those that were used longest ago go first, never that of the nozzle in hand. */
static void keep_few(sp_live *live, const sp_live_nozzle *own)
{
    for (;;) {
        size_t held = 0;
        sp_live_nozzle *oldest = NULL;
        for (size_t i = 0; i < live->nozzle_count; i++) {
            sp_live_nozzle *other = &live->nozzles[i];
            held += other->reach ? other->reach->count : 0;
            if (other->reach && other != own && (!oldest || other->used < oldest->used))
                oldest = other;
        }
        if (held <= KEPT_MOST || !oldest)
            return;
        sp_reach_destroy(oldest->reach);
        oldest->reach = NULL;
    }
}

static sp_aim aim_of(const sp_emitter *emitter)
{
    sp_aim aim = sp_aim_at(emitter->frame.z, sp_spray_reach(&emitter->spray));
    aim.emitter = emitter;
    return aim;
}

/* Of what is known the arrivals that the spray takes. */
static bool lay_known(sp_live *live, sp_live_nozzle *kept, const sp_emitter *emitter, double flow, unsigned stride,
                      sp_combination *combination)
{
    sp_arrival *taken = malloc((kept->reach->count + 1) * sizeof *taken);
    if (!taken)
        return sp_fail_memory(&live->error);
    sp_aim aim = aim_of(emitter);
    size_t count = 0;
    for (size_t i = 0; i < kept->reach->count; i++) {
        const sp_arrival *arrival = &kept->reach->arrivals[i];
        if ((stride == 1 || live->sample.among[arrival->patch]) && sp_aim_takes(&aim, arrival))
            taken[count++] = *arrival;
    }
    kept->used = live->evaluations;
    sp_lay_arrivals(emitter, flow, taken, count, combination);
    free(taken);
    return true;
}

/* What the spray alone reaches. */
static bool lay_traced(sp_live *live, const sp_emitter *emitter, double flow, unsigned stride,
                       sp_combination *combination)
{
    sp_aim aim = aim_of(emitter);
    aim.among = stride > 1 ? live->sample.among : NULL;
    sp_reach *reach = sp_reach_create(&emitter->source, &aim, &live->error);
    if (!reach)
        return false;
    sp_lay_arrivals(emitter, flow, reach->arrivals, reach->count, combination);
    sp_reach_destroy(reach);
    return true;
}

static bool lay_patterns(sp_live *live, sp_live_nozzle *kept, const sp_bodies *bodies, unsigned stride,
                         sp_combination *combination)
{
    const sp_layout *patterns = bodies->patterns;
    bool done = true, traced = false;
    for (size_t i = 0; done && i < patterns->count; i++) {
        sp_emitter emitter = sp_bodies_emitter(live->evaluator, bodies, i);
        double flow = sp_nozzle_flow(&patterns->nozzles[i], &sp_evaluator_setup(live->evaluator)->liquid);
        bool known = kept->reach && patterns->count == 1 && same_source(&kept->source, &emitter.source);
        sp_combination_begin_pattern(combination, patterns->nozzles, i, patterns->count);
        if (flow > 0) {
            traced = traced || !known;
            done = known ? lay_known(live, kept, &emitter, flow, stride, combination)
                         : lay_traced(live, &emitter, flow, stride, combination);
        }
        sp_combination_end_pattern(combination, patterns->nozzles, i, patterns->count);
    }
    sp_combination_end_nozzle(combination);
    live->figures[SP_LIVE_TRACED] += traced;
    return done;
}

/* The source of a nozzle of one pattern: those of a cluster turn about its body. */
static bool source_of(sp_live *live, const sp_nozzle *nozzle, sp_source *source)
{
    sp_layout one = {.count = 1, .nozzles = (sp_nozzle[]){*nozzle}};
    sp_bodies bodies;
    bool found = sp_bodies_create(live->evaluator, &one, &bodies, &live->error) && bodies.patterns->count == 1;
    if (found)
        *source = sp_bodies_emitter(live->evaluator, &bodies, 0).source;
    sp_bodies_free(&bodies);
    return found;
}

bool sp_live_prepare(sp_live *live, size_t index)
{
    sp_source source;
    live->error = (sp_error){0};
    if (index >= live->nozzle_count || !live->nozzles[index].laid)
        return true;
    sp_live_nozzle *kept = &live->nozzles[index];
    if (!source_of(live, &kept->nozzle, &source))
        return live->error.kind == SP_OK;
    kept->used = live->evaluations;
    if (kept->reach && same_source(&kept->source, &source))
        return true;
    sp_reach_destroy(kept->reach);
    sp_aim aim = sp_aim_at(sp_v(0, 0, 1), M_PI);
    kept->reach = sp_reach_create(&source, &aim, &live->error);
    kept->source = source;
    if (kept->reach)
        keep_few(live, kept);
    return kept->reach != NULL;
}

/* On the same patches or all. */
static bool is_laid(const sp_live_nozzle *kept, const sp_nozzle *nozzle, unsigned stride)
{
    const sp_nozzle *old = &kept->nozzle;
    return kept->laid && (kept->stride == 1 || kept->stride == stride) && sp_nozzles_spray_alike(old, nozzle);
}

bool sp_live_lay(sp_live *live, sp_live_nozzle *kept, const sp_nozzle *nozzle, unsigned stride)
{
    if (is_laid(kept, nozzle, stride))
        return true;
    sp_layout one = {.count = 1, .nozzles = (sp_nozzle[]){*nozzle}};
    sp_bodies bodies;
    sp_combination combination = {0};
    sp_coverage_destroy(kept->alone);
    kept->laid = false;
    kept->alone = sp_bodies_create(live->evaluator, &one, &bodies, &live->error)
                      ? sp_coverage_create(live->evaluator, &live->error)
                      : NULL;
    bool done = kept->alone &&
                sp_combination_create(live->evaluator, &kept->alone->deposits, &combination, &live->error) &&
                lay_patterns(live, kept, &bodies, stride, &combination);
    sp_combination_free(&combination);
    sp_bodies_free(&bodies);
    kept->laid = done;
    kept->stride = stride;
    kept->nozzle = *nozzle;
    return done;
}
