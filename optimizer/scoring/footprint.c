#include "scoring/footprint.h"

#include "spray/edges.h"

#include <stdlib.h>
#include <string.h>

/* The patterns of one nozzle on their way together. */
typedef struct {
    const sp_search *search;
    double *even, *dry; /* [patch_count], see sp_wetting */
    sp_edges edges;
    float *film; /* [patch_count], of all patterns; NULL: not asked for */
    float *own;  /* [patch_count], of the pattern in hand */
    sp_runoff *runoff;
    double *arriving; /* [patch_count], m³/s, the runoff's */
} sum;

/* One pattern of the nozzle. */
typedef struct {
    sp_spray spray;
    sp_frame frame;
    double flow; /* m³/s */
} posed;

static void sum_free(sum *s)
{
    free(s->even);
    free(s->dry);
    sp_edges_free(&s->edges);
    free(s->film);
    free(s->own);
}

static bool sum_create(const sp_search *search, sum *s, sp_error *error)
{
    size_t room = search->patch_count + 1;
    *s = (sum){.search = search, .even = calloc(room, sizeof *s->even), .dry = malloc(room * sizeof *s->dry)};
    if (search->runoffs) {
        s->film = calloc(room, sizeof *s->film);
        s->own = malloc(room * sizeof *s->own);
        s->runoff = sp_search_runoff(search);
        s->arriving = sp_runoff_arriving(s->runoff);
    }
    bool room_left = s->even && s->dry && (!search->runoffs || (s->film && s->own));
    if (!sp_edges_create(search->coarse, &s->edges, error) || !(room_left || sp_fail_memory(error))) {
        sum_free(s);
        return false;
    }
    for (size_t p = 0; p < search->patch_count; p++)
        s->dry[p] = 1;
    return true;
}

/* The flux (m/s) of an arrival, on what of its patch lies inside the spray where a share of it does. */
static double flux_of(const posed *pattern, const sp_arrival *arrival, double share)
{
    const sp_spray *spray = &pattern->spray;
    if (sp_spray_is_uniform(spray))
        return pattern->flow / spray->solid_angle * arrival->transfer;
    double density =
        share > 0 ? sp_spray_density(spray, &pattern->frame, arrival->direction, arrival->breadth) / share : 0;
    return pattern->flow * density * arrival->transfer;
}

/* All arrivals of a pattern at one patch, as the inverse evaluator counts them. */
static void lay_patch(const posed *pattern, const sp_arrival *first, const sp_arrival *end, sum *s)
{
    double area = sp_evaluator_patches(s->search->coarse)->area[first->patch], left = pattern->flow,
           threshold = s->search->threshold;
    sp_wetting wetting = {0, 1, 0};
    sp_edge_samples samples = sp_edge_samples_dark();
    for (const sp_arrival *arrival = first; arrival < end; arrival++) {
        double share = sp_spray_share(&pattern->spray, &pattern->frame, arrival->direction, arrival->breadth),
               flux = flux_of(pattern, arrival, share);
        /* no patch receives more than there is, however dense the flights are at its points */
        double brings = fmin(arrival->part * share * flux * area, left);
        left -= brings;
        if (s->arriving)
            s->arriving[first->patch] += brings;
        if (!arrival->passes)
            continue;
        bool alone = sp_flux_suffices(flux, threshold);
        sp_wetting_add(&wetting, flux, threshold, arrival->part, share,
                       !alone && sp_spray_holds(&pattern->spray, &pattern->frame, arrival->direction));
        if (alone)
            sp_edges_sample(&s->edges, arrival, share, &samples);
    }
    sp_wetting settled = sp_wetting_settle(wetting, threshold);
    s->even[first->patch] += settled.even;
    sp_edges_add(&s->edges, first->patch, settled.dry, samples, s->dry);
}

static bool lay_pattern(const sp_nozzle *nozzle, sum *s, sp_error *error)
{
    const sp_search *search = s->search;
    const sp_setup *setup = sp_evaluator_setup(search->coarse);
    posed pattern = {.spray = sp_spray_create(nozzle->type, sp_nozzle_angle(nozzle)),
                     .frame = sp_nozzle_frame(nozzle->axis, nozzle->roll, setup->up),
                     .flow = sp_nozzle_flow(nozzle, &setup->liquid)};
    double half_angle = fmin(M_PI, sp_spray_reach(&pattern.spray) + 1e-6);
    sp_launch launch;
    if (!sp_launch_table_find(search->candidates->table, nozzle, &launch, error))
        return false;
    sp_reach *reach = search->all_feeds ? sp_evaluator_reach(search->coarse, nozzle->position, launch, nozzle->axis,
                                                             half_angle, error)
                                        : sp_evaluator_reach_passing(search->coarse, nozzle->position, launch,
                                                                     nozzle->axis, half_angle, NULL, error);
    if (!reach)
        return false;
    for (size_t i = 0, end; i < reach->count; i = end) {
        for (end = i + 1; end < reach->count && reach->arrivals[end].patch == reach->arrivals[i].patch;)
            end++;
        lay_patch(&pattern, &reach->arrivals[i], &reach->arrivals[end], s);
    }
    sp_reach_destroy(reach);
    if (s->film)
        sp_runoff_find(s->runoff, nozzle->type, pattern.flow, s->own);
    for (size_t p = 0; s->film && p < search->patch_count; p++)
        s->film[p] += s->own[p];
    return true;
}

static sp_print print_at(const sum *s, size_t patch)
{
    double threshold = s->search->threshold, even = s->even[patch];
    float hit = even > 0 ? threshold > 0 ? (float)(even / threshold) : INFINITY : 0;
    return (sp_print){(uint32_t)patch, hit, (float)(1 - s->dry[patch]), s->film ? s->film[patch] : 0};
}

/* Of the patches that it reaches. */
static bool write_prints(const sum *s, sp_footprint *footprint, sp_error *error)
{
    size_t count = 0;
    for (int pass = 0; pass < 2; pass++) {
        count = 0;
        for (size_t p = 0; p < s->search->patch_count; p++) {
            sp_print print = print_at(s, p);
            if (!(print.hit > 0 || print.edge > 0 || print.film > 0))
                continue;
            if (pass)
                footprint->prints[count] = print;
            count++;
        }
        if (!pass && !(footprint->prints = malloc((count + 1) * sizeof *footprint->prints)))
            return sp_fail_memory(error);
    }
    footprint->count = count;
    return true;
}

static bool lay_all(const sp_nozzle *patterns, size_t count, sum *s, sp_error *error)
{
    for (size_t i = 0; i < count; i++) {
        sp_edges_begin(&s->edges, patterns, i, count);
        if (!lay_pattern(&patterns[i], s, error))
            return false;
        sp_edges_end(&s->edges, patterns, i, count, s->dry);
    }
    return true;
}

bool sp_footprint_trace(const sp_search *search, const sp_nozzle *nozzle, sp_footprint *footprint, sp_error *error)
{
    const sp_setup *setup = sp_evaluator_setup(search->coarse);
    size_t count = sp_nozzle_pattern_count(nozzle);
    *footprint = (sp_footprint){0};
    sp_nozzle *patterns = malloc((count + 1) * sizeof *patterns);
    sum s;
    if (!patterns)
        return sp_fail_memory(error);
    if (!sum_create(search, &s, error)) {
        free(patterns);
        return false;
    }
    sp_nozzle_patterns(nozzle, &setup->liquid, setup->up, patterns);
    bool done = lay_all(patterns, count, &s, error) && write_prints(&s, footprint, error);
    sum_free(&s);
    free(patterns);
    return done;
}

void sp_footprint_free(sp_footprint *footprint)
{
    free(footprint->prints);
    *footprint = (sp_footprint){0};
}

void sp_footprint_pour(const sp_search *search, const sp_footprint *footprint, bool again, float *hit, float *film,
                       float *dry)
{
    for (size_t i = 0; i < footprint->count; i++) {
        const sp_print *print = &footprint->prints[i];
        sp_pour(search, print->hit, &hit[print->patch], &dry[print->patch]);
        if (!again)
            sp_pour(search, -print->edge, &hit[print->patch], &dry[print->patch]);
        if (film)
            film[print->patch] += print->film;
    }
}

void sp_footprint_field(const sp_search *search, const sp_footprint *footprint, float *field)
{
    memset(field, 0, search->field_count * sizeof *field);
    for (size_t i = 0; i < footprint->count; i++) {
        const sp_print *print = &footprint->prints[i];
        field[print->patch] = print->edge > 0 && print->hit < SP_ENOUGH ? -print->edge : print->hit;
        if (search->runoffs)
            field[search->patch_count + print->patch] = print->film;
    }
}
