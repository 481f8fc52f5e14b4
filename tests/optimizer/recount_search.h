/* Layouts from a search that knows nothing of the optimiser's: at random, by annealing over the candidate poses, and by
 * annealing over aims of any kind. What a layout covers is what sp_evaluate_inverse says; to be quick, most are counted
 * by what it says of their nozzles one by one, put together as coverage.h tells, and only the best of a run are
 * evaluated whole, which must come to the same. */
#ifndef RECOUNT_SEARCH_H
#define RECOUNT_SEARCH_H

#include "recount_scenes.h"

#include "candidates/candidates.h"

#include <time.h>

#define RECOUNT_MOST 24       /* nozzles of a layout */
#define RECOUNT_ROOM 40000000 /* patches that are remembered, of all nozzles */
#define RECOUNT_FEW 40        /* poses */
#define RECOUNT_STEPS 1500    /* of one annealing */
#define RECOUNT_ROUNDING 1e-6 /* of an area, that shares of patches in single precision may be counted too low by */

typedef struct {
    uint32_t patch;
    double even, dry, film;
} recount_mark;

/* A nozzle that may be chosen. */
typedef struct {
    sp_nozzle nozzle;
    double flow;
    size_t port; /* mount that it takes, SIZE_MAX: none */
    bool known;
    size_t count;
    recount_mark *marks;
} recount_choice;

typedef struct {
    size_t count, item[RECOUNT_MOST];
} recount_layout;

typedef enum { RECOUNT_RANDOM, RECOUNT_ANNEALED, RECOUNT_AIMED, RECOUNT_WAYS } recount_way;

typedef struct {
    const recount_scene *scene;
    const sp_proposal *proposal;
    const sp_patches *patches;
    sp_sites sites;
    sp_candidates candidates;
    size_t poses, own, slots; /* choices: so many poses, then nozzles of the proposal, then room for aims */
    recount_choice *choices;
    recount_choice kept[2];
    size_t remembered;
    double *even, *dry, *film; /* [patches] */
    uint64_t random;
    double best[RECOUNT_WAYS]; /* m² at the proposal's water */
    double least_water;        /* that covered as much as the proposal; INFINITY */
    double margin, aim_margin; /* the least of (bound - area) / bound */
    size_t tried, evaluated;
} recount;

static inline double recount_random(recount *r)
{
    r->random ^= r->random >> 12;
    r->random ^= r->random << 25;
    r->random ^= r->random >> 27;
    return (double)((r->random * 0x2545f4914f6cdd1du) >> 11) * 0x1p-53;
}

static inline size_t recount_below(recount *r, size_t count)
{
    return (size_t)(recount_random(r) * (double)count);
}

static inline double recount_clock(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static inline void recount_forget(recount *r, recount_choice *choice)
{
    r->remembered -= choice->count;
    free(choice->marks);
    choice->marks = NULL;
    choice->count = 0;
    choice->known = false;
}

/* What a nozzle does alone. */
static inline void recount_know(recount *r, recount_choice *choice)
{
    sp_error error = {0};
    if (choice->known)
        return;
    for (size_t i = 0; r->remembered > RECOUNT_ROOM && i < r->poses; i++)
        recount_forget(r, &r->choices[i]);
    sp_layout *layout = sp_layout_create(&choice->nozzle, 1, &error);
    sp_coverage *coverage = sp_evaluate_inverse(r->scene->room.evaluator, layout, &error);
    assert_non_null(coverage);
    const sp_deposits *deposits = &coverage->deposits;
    for (size_t p = 0; p < deposits->count; p++)
        choice->count += deposits->even[p] > 0 || deposits->dry[p] < 1 || deposits->film[p] > 0;
    choice->marks = malloc((choice->count + 1) * sizeof *choice->marks);
    assert_non_null(choice->marks);
    size_t count = 0;
    for (size_t p = 0; p < deposits->count; p++)
        if (deposits->even[p] > 0 || deposits->dry[p] < 1 || deposits->film[p] > 0)
            choice->marks[count++] = (recount_mark){
                .patch = (uint32_t)p, .even = deposits->even[p], .dry = deposits->dry[p], .film = deposits->film[p]};
    r->remembered += count;
    choice->known = true;
    choice->flow = coverage->flow;
    sp_coverage_destroy(coverage);
    sp_layout_destroy(layout);
}

/* `again`: another that sprays as it does is poured already, whose edges lie in the same place. */
static inline void recount_pour(recount *r, const recount_choice *choice, bool again)
{
    bool single = r->scene->room.setup.criterion.combine == SP_COMBINE_SINGLE;
    for (size_t i = 0; i < choice->count; i++) {
        const recount_mark *mark = &choice->marks[i];
        double *even = &r->even[mark->patch];
        *even = single ? fmax(*even, mark->even) : *even + mark->even;
        if (!again)
            r->dry[mark->patch] *= mark->dry;
        r->film[mark->patch] += mark->film;
    }
}

/* Whether item i of a layout sprays as a kept nozzle or an item before it. */
static inline bool recount_repeats(const recount *r, const recount_layout *layout, size_t i)
{
    const sp_nozzle *own = &r->choices[layout->item[i]].nozzle;
    bool found = false;
    for (size_t k = 0; k < r->scene->kept_count; k++)
        found = found || sp_nozzles_spray_alike(&r->kept[k].nozzle, own);
    for (size_t k = 0; k < i; k++)
        found = found || sp_nozzles_spray_alike(&r->choices[layout->item[k]].nozzle, own);
    return found;
}

/* The area that a layout covers, kept nozzles included, m². */
static inline double recount_area(recount *r, const recount_layout *layout)
{
    const sp_criterion *criterion = &r->scene->room.setup.criterion;
    double area = 0;
    for (size_t i = 0; i < r->scene->kept_count; i++)
        recount_know(r, &r->kept[i]);
    for (size_t i = 0; i < layout->count; i++)
        recount_know(r, &r->choices[layout->item[i]]);
    /* the room for marks may have run out meanwhile */
    for (size_t i = 0; i < layout->count; i++)
        recount_know(r, &r->choices[layout->item[i]]);
    for (size_t p = 0; p < r->patches->count; p++) {
        r->even[p] = 0;
        r->dry[p] = 1;
        r->film[p] = 0;
    }
    for (size_t i = 0; i < r->scene->kept_count; i++)
        recount_pour(r, &r->kept[i], false);
    for (size_t i = 0; i < layout->count; i++)
        recount_pour(r, &r->choices[layout->item[i]], recount_repeats(r, layout, i));
    for (size_t p = 0; p < r->patches->count; p++)
        area += criterion->film > 0 && r->film[p] >= criterion->film
                    ? r->patches->area[p]
                    : sp_wetting_share(&(sp_wetting){r->even[p], r->dry[p], 0}, criterion->flux) * r->patches->area[p];
    r->tried++;
    return area;
}

static inline double recount_flow(const recount *r, const recount_layout *layout)
{
    double flow = 0;
    for (size_t i = 0; i < r->scene->kept_count; i++)
        flow += r->kept[i].flow;
    for (size_t i = 0; i < layout->count; i++)
        flow += r->choices[layout->item[i]].flow;
    return flow;
}

/* The same by one evaluation of the whole layout. */
static inline double recount_truly(recount *r, const recount_layout *layout)
{
    sp_error error = {0};
    sp_nozzle nozzles[RECOUNT_MOST + 2];
    size_t count = 0;
    for (size_t i = 0; i < r->scene->kept_count; i++)
        nozzles[count++] = r->kept[i].nozzle;
    for (size_t i = 0; i < layout->count; i++)
        nozzles[count++] = r->choices[layout->item[i]].nozzle;
    sp_layout *whole = sp_layout_create(nozzles, count, &error);
    sp_coverage *coverage = sp_evaluate_inverse(r->scene->room.evaluator, whole, &error);
    assert_non_null(coverage);
    double area = coverage->covered_area;
    assert_true(fabs(coverage->flow - recount_flow(r, layout)) <= 1e-12 * coverage->flow);
    sp_coverage_destroy(coverage);
    sp_layout_destroy(whole);
    r->evaluated++;
    return area;
}

/* The least bound that the proposal gives for so much water; `aimed`: of any aims. */
static inline double recount_bound(const recount *r, double flow, bool aimed)
{
    const sp_proposal *p = r->proposal;
    const sp_certificate *c = &p->certificate;
    double bound = INFINITY;
    if (flow <= p->coverage->flow * (1 + 1e-12))
        bound = aimed ? c->every_aim.area_bound : c->area_bound;
    for (size_t i = 0; i < p->front_count; i++)
        if (flow <= p->front[i].flow * (1 + 1e-12))
            bound = fmin(bound, aimed ? p->front[i].every_aim_bound : p->front[i].bound);
    return bound;
}

/* No bound is broken by a layout that covers so much. */
static inline void recount_judge(recount *r, const recount_layout *layout, double area, recount_way way)
{
    const sp_certificate *c = &r->proposal->certificate;
    bool aimed = way == RECOUNT_AIMED;
    double flow = recount_flow(r, layout), bound = recount_bound(r, flow, aimed), margin = (bound - area) / bound;
    double water = aimed ? c->every_aim.water_bound : c->water_bound;
    if (isfinite(bound) && margin < 0)
        fail_msg("%.9g m2 (evaluated whole %.9g) with %.9g m3/s in %zu, bound %.9g", area, recount_truly(r, layout),
                 flow, layout->count, bound);
    if (isfinite(bound))
        *(aimed ? &r->aim_margin : &r->margin) = fmin(aimed ? r->aim_margin : r->margin, margin);
    if (flow <= r->proposal->coverage->flow * (1 + 1e-12))
        r->best[way] = fmax(r->best[way], area);
    if (area < c->counted * (1 + RECOUNT_ROUNDING))
        return;
    if (flow < water * (1 - 1e-9))
        fail_msg("%.9g m2 with %.9g m3/s in %zu, at least %.9g needed", area, flow, layout->count, water);
    if (!aimed)
        r->least_water = fmin(r->least_water, flow);
}

static inline bool recount_admits(recount *r, const recount_layout *layout, size_t item, double water)
{
    const sp_place_options *options = &r->scene->options;
    const recount_choice *choice = &r->choices[item];
    size_t most = options->max_nozzles ? options->max_nozzles - r->scene->kept_count : RECOUNT_MOST;
    if (layout->count >= most || layout->count >= RECOUNT_MOST ||
        recount_flow(r, layout) + choice->flow > water * (1 + 1e-12))
        return false;
    for (size_t i = 0; choice->port != SIZE_MAX && i < layout->count; i++)
        if (r->choices[layout->item[i]].port == choice->port)
            return false;
    return true;
}

/* Of the proposal or a point of its front. */
static inline double recount_some_water(recount *r)
{
    size_t i = recount_below(r, 2 * r->proposal->front_count + 1);
    return i < r->proposal->front_count ? r->proposal->front[i].flow : r->proposal->coverage->flow;
}

static inline recount_layout recount_at_random(recount *r, double water)
{
    recount_layout layout = {0};
    for (int failed = 0; failed < 20;) {
        size_t item = recount_below(r, r->poses);
        if (recount_admits(r, &layout, item, water))
            layout.item[layout.count++] = item;
        else
            failed++;
    }
    return layout;
}

static inline void recount_remove(recount_layout *layout, size_t i)
{
    layout->item[i] = layout->item[--layout->count];
}

/* Another pose: any, one like an old one, or one of the proposal's. */
static inline size_t recount_pick(recount *r, size_t old)
{
    double which = recount_random(r);
    if (which < 0.1 && r->own)
        return r->poses + recount_below(r, r->own);
    if (which < 0.6 && old < r->poses) {
        size_t far = 1 + recount_below(r, 20);
        return recount_random(r) < 0.5 ? (old + far) % r->poses : (old + r->poses - far % r->poses) % r->poses;
    }
    return recount_below(r, r->poses);
}

/* A nozzle at a mounting point with any axis, roll, angle and flow that refinement may set; or a little off an old one.
 */
static inline sp_nozzle recount_aim(recount *r, const sp_nozzle *old, size_t *port)
{
    const sp_place_options *options = &r->scene->options;
    uint32_t site, variant;
    do {
        site = (uint32_t)recount_below(r, r->sites.count);
        variant = (uint32_t)recount_below(r, r->candidates.variant_count);
    } while (!sp_candidates_axes(&r->candidates, r->sites.items[site].mount, variant)->count);
    const sp_site *at = &r->sites.items[site];
    const sp_mount *mount = &options->mounts[at->mount];
    const sp_variant *own = &r->candidates.variants[variant];
    double low, high, least, most;
    sp_angle_range(options, own->type, &low, &high);
    sp_flow_range(options, &r->scene->room.setup, own->type, own->pressure, &least, &most);
    sp_frame frame = sp_nozzle_frame(at->axis, 2 * M_PI * recount_random(r), r->scene->room.setup.up);
    double polar = mount->tilt * sqrt(recount_random(r));
    sp_nozzle nozzle = {.type = own->type,
                        .position = at->position,
                        .axis = sp_unit(sp_along(sp_scale(frame.z, cos(polar)), sin(polar), frame.x)),
                        .roll = 2 * M_PI * recount_random(r),
                        .pressure = own->pressure,
                        .angle = low + (high - low) * recount_random(r),
                        .flow = least + (most - least) * recount_random(r)};
    *port = mount->kind == SP_MOUNT_PORT ? at->mount : SIZE_MAX;
    if (!old || old->type != own->type || old->pressure != own->pressure ||
        memcmp(&old->position, &at->position, sizeof at->position))
        return nozzle;
    sp_vec3 near = sp_unit(sp_along(old->axis, 0.2 * recount_random(r), sp_sub(nozzle.axis, old->axis)));
    if (sp_dot(near, at->axis) >= cos(mount->tilt))
        nozzle.axis = near;
    nozzle.roll = old->roll + 0.3 * (recount_random(r) - 0.5);
    return nozzle;
}

/* A slot that the layout does not use, with an aim in it. */
static inline size_t recount_new_aim(recount *r, const recount_layout *layout, size_t old)
{
    size_t slot = r->poses + r->own;
    for (bool used = true; used; slot += used) {
        used = false;
        for (size_t i = 0; i < layout->count; i++)
            used |= layout->item[i] == slot;
    }
    recount_choice *choice = &r->choices[slot];
    recount_forget(r, choice);
    choice->nozzle = recount_aim(r, old == SIZE_MAX ? NULL : &r->choices[old].nozzle, &choice->port);
    choice->flow = choice->nozzle.flow;
    return slot;
}

/* One change of a layout, within the limits. False where it came to nothing. */
static inline bool recount_change(recount *r, recount_layout *layout, double water, bool aimed)
{
    recount_layout changed = *layout;
    size_t old = SIZE_MAX;
    if (changed.count && recount_random(r) < 0.7) {
        size_t i = recount_below(r, changed.count);
        old = changed.item[i];
        recount_remove(&changed, i);
        if (changed.count && recount_random(r) < 0.15)
            recount_remove(&changed, recount_below(r, changed.count));
    }
    if (old == SIZE_MAX || recount_random(r) < 0.9) {
        /* what is tried must not take the slot of what is left */
        size_t item = aimed && recount_random(r) < 0.95 ? recount_new_aim(r, layout, old) : recount_pick(r, old);
        if (!recount_admits(r, &changed, item, water))
            return false;
        changed.item[changed.count++] = item;
    }
    *layout = changed;
    return true;
}

/* One annealing at some water, from nothing or from the proposal. */
static inline void recount_anneal(recount *r, double until, bool aimed)
{
    double water = recount_some_water(r), whole = r->patches->total_area, best_area = -1;
    recount_layout layout = {0}, best = {0};
    recount_way way = aimed ? RECOUNT_AIMED : RECOUNT_ANNEALED;
    if (recount_random(r) < 0.3)
        for (size_t i = 0; i < r->own; i++)
            if (recount_admits(r, &layout, r->poses + i, water))
                layout.item[layout.count++] = r->poses + i;
    double area = recount_area(r, &layout);
    for (size_t step = 0; step < RECOUNT_STEPS && recount_clock() < until; step++) {
        double heat = whole * 0.005 * pow(1e-4, (double)step / RECOUNT_STEPS);
        recount_layout next = layout;
        if (!recount_change(r, &next, water, aimed))
            continue;
        double found = recount_area(r, &next);
        recount_judge(r, &next, found, way);
        if (found < area && recount_random(r) >= exp((found - area) / heat))
            continue;
        layout = next;
        area = found;
        if (aimed && found > best_area) {
            best_area = found;
            assert_true(fabs(recount_truly(r, &layout) - found) <= 1e-9 * whole);
        } else if (!aimed && found > best_area) {
            best = layout;
            best_area = found;
        }
    }
    if (!aimed && best_area >= 0)
        assert_true(fabs(recount_truly(r, &best) - best_area) <= 1e-9 * whole);
}

/* Every layout that goes on from this one with poses no lower in number. */
static inline void recount_every(recount *r, recount_layout layout, size_t first)
{
    for (size_t item = first; item < r->poses + r->own; item++) {
        recount_layout more = layout;
        if (!recount_admits(r, &layout, item, INFINITY))
            continue;
        more.item[more.count++] = item;
        recount_judge(r, &more, recount_area(r, &more), RECOUNT_RANDOM);
        recount_every(r, more, item);
    }
}

/* Tries every layout where poses are few, then spends so many seconds on each way. */
static inline void recount_search(recount *r, double seconds)
{
    double begun = recount_clock();
    if (r->poses <= RECOUNT_FEW && r->scene->options.max_nozzles && r->scene->options.max_nozzles <= 3)
        recount_every(r, (recount_layout){0}, 0);
    for (size_t tried = 0; recount_clock() < begun + 0.25 * seconds; tried++) {
        recount_layout layout = recount_at_random(r, recount_some_water(r));
        double area = tried % 8 ? recount_area(r, &layout) : recount_truly(r, &layout);
        recount_judge(r, &layout, area, RECOUNT_RANDOM);
    }
    bool aimed = r->proposal->certificate.every_aim.computed;
    while (recount_clock() < begun + (aimed ? 0.7 : 1) * seconds)
        recount_anneal(r, begun + (aimed ? 0.7 : 1) * seconds, false);
    while (recount_clock() < begun + seconds)
        recount_anneal(r, begun + seconds, true);
}

static inline bool recount_port_taken(const recount_scene *scene, uint32_t mount)
{
    const sp_mount *port = &scene->options.mounts[mount];
    for (size_t i = 0; port->kind == SP_MOUNT_PORT && i < scene->kept_count; i++)
        if (scene->kept[i].position.x == port->position.x && scene->kept[i].position.y == port->position.y)
            return true;
    return false;
}

static inline void recount_list_poses(recount *r)
{
    sp_vec3 up = r->scene->room.setup.up;
    r->choices = calloc(r->candidates.pose_start[r->sites.count] + 2 * RECOUNT_MOST + 8, sizeof *r->choices);
    assert_non_null(r->choices);
    for (uint32_t site = 0; site < r->sites.count; site++)
        for (uint32_t k = 0; k < r->candidates.variant_count; k++) {
            uint32_t mount = r->sites.items[site].mount;
            const sp_variant *variant = &r->candidates.variants[k];
            size_t axes = sp_candidates_axes(&r->candidates, mount, k)->count;
            bool port = r->scene->options.mounts[mount].kind == SP_MOUNT_PORT;
            for (uint32_t a = 0; a < axes && !recount_port_taken(r->scene, mount); a++)
                for (uint32_t roll = 0; roll < variant->roll_count; roll++)
                    r->choices[r->poses++] = (recount_choice){
                        .nozzle = sp_pose_nozzle(&r->candidates, &r->sites, (sp_pose){site, k, a, roll}, up),
                        .flow = variant->flow,
                        .port = port ? mount : SIZE_MAX};
        }
}

static inline void recount_list_own(recount *r)
{
    const sp_layout *layout = r->proposal->layout;
    for (size_t i = 0; i < layout->count; i++) {
        recount_choice choice = {.nozzle = layout->nozzles[i], .port = SIZE_MAX};
        choice.flow = sp_nozzle_flow(&choice.nozzle, &r->scene->room.setup.liquid);
        for (size_t m = 0; m < r->scene->options.mount_count; m++)
            if (r->scene->options.mounts[m].kind == SP_MOUNT_PORT &&
                !strcmp(r->scene->options.mounts[m].name, choice.nozzle.name))
                choice.port = m;
        if (!choice.nozzle.keep && r->own < RECOUNT_MOST)
            r->choices[r->poses + r->own++] = choice;
    }
}

static inline void recount_open(recount *r, const recount_scene *scene, const sp_proposal *proposal)
{
    sp_error error = {0};
    *r = (recount){.scene = scene,
                   .proposal = proposal,
                   .patches = sp_evaluator_patches(scene->room.evaluator),
                   .random = 7,
                   .least_water = INFINITY,
                   .margin = INFINITY,
                   .aim_margin = INFINITY};
    r->even = malloc(r->patches->count * sizeof *r->even);
    r->dry = malloc(r->patches->count * sizeof *r->dry);
    r->film = malloc(r->patches->count * sizeof *r->film);
    assert_true(r->even && r->dry && r->film);
    assert_true(sp_sites_create(scene->room.evaluator, &scene->options, &r->sites, &error));
    assert_true(sp_candidates_create(scene->room.evaluator, &scene->options, &r->sites, &r->candidates, &error));
    recount_list_poses(r);
    recount_list_own(r);
    for (size_t i = 0; i < scene->kept_count; i++)
        r->kept[i] = (recount_choice){.nozzle = scene->kept[i],
                                      .flow = sp_nozzle_flow(&scene->kept[i], &scene->room.setup.liquid)};
    r->slots = RECOUNT_MOST + 2;
}

static inline void recount_close(recount *r)
{
    for (size_t i = 0; i < r->poses + r->own + r->slots; i++)
        recount_forget(r, &r->choices[i]);
    for (size_t i = 0; i < r->scene->kept_count; i++)
        recount_forget(r, &r->kept[i]);
    free(r->choices);
    free(r->even);
    free(r->film);
    free(r->dry);
    sp_candidates_free(&r->candidates);
    sp_sites_free(&r->sites);
}

#endif
