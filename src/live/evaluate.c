/* What all nozzles bring together, from what each brings alone. */
#include "live/numbers.h"
#include "live/state.h"
#include "spray/criterion.h"

#include <stdlib.h>
#include <string.h>

#define STRIDE_MOST 64

/* As many as were handed over; those that are no more are forgotten. */
static bool make_room(sp_live *live, size_t count)
{
    if (count == live->nozzle_count)
        return true;
    sp_live_nozzle *nozzles = calloc(count + 1, sizeof *nozzles);
    if (!nozzles)
        return sp_fail_memory(&live->error);
    for (size_t i = 0; i < live->nozzle_count; i++) {
        if (i < count)
            nozzles[i] = live->nozzles[i];
        else
            sp_live_forget(&live->nozzles[i]);
    }
    free(live->nozzles);
    live->nozzles = nozzles;
    live->nozzle_count = count;
    return true;
}

static bool read_nozzle(sp_live *live, size_t index, sp_nozzle *nozzle)
{
    const double *row = (const double *)live->arrays[SP_LIVE_NOZZLES] + index * SP_LIVE_NOZZLE_NUMBERS;
    if (!(row[0] >= 0 && row[0] < (double)live->type_count))
        return sp_fail(&live->error, SP_ERROR_ARGUMENT, NULL, 0, 0, "nozzle %zu: no such type", index);
    *nozzle = sp_live_read_nozzle(row);
    nozzle->type = &live->types[(size_t)row[0]];
    return true;
}

static size_t handed_over(const sp_live *live)
{
    return live->bytes[SP_LIVE_NOZZLES] / (SP_LIVE_NOZZLE_NUMBERS * sizeof(double));
}

static bool is_on(const sp_live *live, size_t index)
{
    return ((const double *)live->arrays[SP_LIVE_NOZZLES])[(index + 1) * SP_LIVE_NOZZLE_NUMBERS - 1] != 0;
}

bool sp_live_nozzle_on(sp_live *live, size_t index, sp_nozzle *nozzle)
{
    return index < handed_over(live) && is_on(live, index) && read_nozzle(live, index, nozzle);
}

static void add_patch(const sp_live *live, const sp_deposits *alone, bool again, sp_deposits *all, size_t i)
{
    const sp_criterion *criterion = &sp_evaluator_setup(live->evaluator)->criterion;
    all->flux[i] += alone->flux[i];
    all->counted[i] = sp_combined(criterion, all->counted[i], alone->counted[i]);
    all->speed[i] += alone->speed[i];
    all->speed_max[i] = fmax(all->speed_max[i], alone->speed_max[i]);
    all->incidence[i] += alone->incidence[i];
    all->impact[i] += alone->impact[i];
    all->even[i] = sp_combined(criterion, all->even[i], alone->even[i]);
    if (!again)
        all->dry[i] *= alone->dry[i];
}

static void stand_for(sp_deposits *all, size_t i, size_t standing)
{
    all->flux[i] = all->flux[standing];
    all->counted[i] = all->counted[standing];
    all->speed[i] = all->speed[standing];
    all->speed_max[i] = all->speed_max[standing];
    all->incidence[i] = all->incidence[standing];
    all->impact[i] = all->impact[standing];
    all->even[i] = all->even[standing];
    all->dry[i] = all->dry[standing];
}

static void add_nozzle(sp_live *live, size_t n, bool again, unsigned stride)
{
    sp_deposits *all = &live->coverage->deposits;
    for (size_t i = 0; i < all->count; i++)
        if (stride == 1 || live->sample.among[i])
            add_patch(live, &live->nozzles[n].alone->deposits, again, all, i);
}

/* False when memory runs out. */
static bool add_up(sp_live *live, unsigned stride)
{
    const sp_fluid *liquid = &sp_evaluator_setup(live->evaluator)->liquid;
    sp_deposits *all = &live->coverage->deposits;
    sp_layout *on = sp_layout_create(NULL, live->nozzle_count, &live->error);
    if (!on)
        return false;
    on->count = 0;
    for (size_t n = 0; n < live->nozzle_count; n++)
        if (is_on(live, n))
            on->nozzles[on->count++] = live->nozzles[n].nozzle;
    for (size_t n = 0, k = 0; n < live->nozzle_count; n++)
        if (is_on(live, n))
            add_nozzle(live, n, sp_layout_repeats(on, k++, liquid), stride);
    sp_layout_destroy(on);
    for (size_t i = 0; stride > 1 && i < all->count; i++)
        stand_for(all, i, live->sample.standing[i]);
    sp_coverage_judge(live->evaluator, live->coverage);
    return true;
}

static void draw_figures(sp_live *live, double flow)
{
    live->figures[SP_LIVE_COVERAGE] = live->coverage->fraction;
    live->figures[SP_LIVE_COVERED] = live->coverage->covered_area;
    live->figures[SP_LIVE_FLOW] = flow;
    live->figures[SP_LIVE_PATCHES] = (double)live->coverage->deposits.count;
    live->figures[SP_LIVE_SHADOW_COUNT] = 0;
}

bool sp_live_evaluate(sp_live *live, unsigned stride)
{
    live->error = (sp_error){0};
    live->evaluations++;
    live->figures[SP_LIVE_TRACED] = 0;
    size_t count = handed_over(live);
    bool good = live->evaluator && stride >= 1 && stride <= STRIDE_MOST && make_room(live, count) &&
                (stride == 1 || sp_live_take_sample(live, stride));
    double flow = 0;
    for (size_t i = 0; good && i < count; i++) {
        sp_nozzle nozzle;
        if (!is_on(live, i))
            continue;
        good = read_nozzle(live, i, &nozzle) && sp_live_lay(live, &live->nozzles[i], &nozzle, stride);
        if (good)
            flow += sp_nozzle_flow(&nozzle, &sp_evaluator_setup(live->evaluator)->liquid);
    }
    sp_coverage_destroy(live->coverage);
    live->coverage = good ? sp_coverage_create(live->evaluator, &live->error) : NULL;
    if (!live->coverage)
        return sp_fail(&live->error, SP_ERROR_ARGUMENT, NULL, 0, 0, "not open, or a stride that cannot be");
    if (!add_up(live, stride))
        return false;
    draw_figures(live, flow);
    return true;
}

bool sp_live_admits(sp_live *live, size_t index)
{
    sp_nozzle nozzle;
    live->error = (sp_error){0};
    return live->evaluator && index < handed_over(live) && read_nozzle(live, index, &nozzle) &&
           sp_evaluator_admits(live->evaluator, &nozzle, &live->error);
}

static void list_shadows(sp_live *live, const sp_shadow *shadows, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        const double row[SP_LIVE_SHADOW_NUMBERS] = {shadows[i].area,       shadows[i].centroid.x, shadows[i].centroid.y,
                                                    shadows[i].centroid.z, shadows[i].part,       shadows[i].lack};
        memcpy(live->shadow_list[i], row, sizeof row);
    }
    live->figures[SP_LIVE_SHADOW_COUNT] = (double)count;
}

bool sp_live_find_shadows(sp_live *live)
{
    sp_shadow *shadows = NULL;
    size_t count = 0;
    live->error = (sp_error){0};
    if (!live->coverage || !sp_shadows(live->evaluator, live->coverage, NULL, &shadows, &count, &live->error))
        return false;
    count = count < SP_LIVE_SHADOWS ? count : SP_LIVE_SHADOWS;
    free(live->shadow_of);
    live->shadow_of = malloc((live->coverage->deposits.count + 1) * sizeof *live->shadow_of);
    bool done = live->shadow_of || sp_fail_memory(&live->error);
    done = done && sp_shadow_numbers(live->evaluator, live->coverage, shadows, count, live->shadow_of, &live->error);
    if (done)
        list_shadows(live, shadows, count);
    free(shadows);
    return done;
}

const void *sp_live_tell(sp_live *live, sp_live_result what)
{
    const sp_deposits *all = live->coverage ? &live->coverage->deposits : NULL;
    switch (what) {
    case SP_LIVE_FIGURES:
        return live->figures;
    case SP_LIVE_PATCH_FLUX:
        return all ? all->flux : NULL;
    case SP_LIVE_PATCH_SPEED:
        return all ? all->speed : NULL;
    case SP_LIVE_PATCH_INCIDENCE:
        return all ? all->incidence : NULL;
    case SP_LIVE_PATCH_IMPACT:
        return all ? all->impact : NULL;
    case SP_LIVE_PATCH_SHARE:
        return all ? all->share : NULL;
    case SP_LIVE_SHADOW_LIST:
        return live->shadow_list;
    case SP_LIVE_SHADOW_OF:
        return live->shadow_of;
    case SP_LIVE_BOXES:
        return live->boxes;
    case SP_LIVE_LEGS:
        return live->legs;
    }
    return NULL;
}

const double *sp_live_alone(sp_live *live, size_t index)
{
    bool known = index < live->nozzle_count && live->nozzles[index].laid && is_on(live, index);
    return known ? live->nozzles[index].alone->deposits.flux : NULL;
}
