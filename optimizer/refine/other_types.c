#include "refine/other_types.h"

#include "refine/refine.h"
#include "scoring/field.h"
#include "scoring/footprints.h"

/* Fed with that flow, m³/s. */
static sp_nozzle as_variant(const sp_nozzle *nozzle, const sp_variant *variant, double flow)
{
    return (sp_nozzle){.type = variant->type,
                       .position = nozzle->position,
                       .axis = nozzle->axis,
                       .roll = nozzle->roll,
                       .pressure = variant->pressure,
                       .angle = variant->angle == variant->type->angle ? 0 : variant->angle,
                       .flow = flow == variant->flow ? 0 : flow};
}

/* Of what no pattern kernel sums a footprint of its own: no candidate need stand where it does. */
static bool look(const sp_search *search, sp_placed *placed, sp_error *error)
{
    placed->moved = NULL;
    if (sp_type_is_uniform(placed->nozzle.type))
        return sp_field_nozzle(search, &placed->nozzle, NULL, placed->field, error);
    placed->moved = sp_footprints_add(search->footprints, &placed->nozzle, error);
    if (placed->moved)
        sp_footprint_field(search, placed->moved, placed->field);
    return placed->moved;
}

/* Whether the final patches may find it no worse than the best. */
static bool may_count(const sp_front *front, const sp_partial *partial)
{
    double least = sp_front_saves(front) ? front->target : front->measured.area;
    return partial->covered + front->bias >= least * (1 - SP_MISJUDGED);
}

/* The best layout with another nozzle in place of nozzle i, into the front. */
static bool measure_with(const sp_search *search, sp_front *front, size_t i, const sp_nozzle *nozzle, double flow,
                         sp_error *error)
{
    sp_front_point point = {.area = -1};
    sp_partial partial;
    if (!sp_partial_copy(search, &front->best, &partial, error))
        return false;
    sp_placed *placed = &partial.items[i];
    placed->nozzle = *nozzle;
    placed->flow = flow;
    bool done = look(search, placed, error);
    if (done)
        sp_partial_refresh(search, &partial);
    done = done && (!may_count(front, &partial) || sp_front_note(front, search, &partial, &point, error));
    sp_partial_free(&partial);
    return done;
}

static bool try_flow(const sp_search *search, sp_front *front, size_t i, const sp_variant *variant, double flow,
                     sp_error *error)
{
    const sp_placed *placed = &front->best.items[i];
    sp_nozzle nozzle = as_variant(&placed->nozzle, variant, flow);
    sp_error refused = {0};
    if (sp_nozzles_spray_alike(&nozzle, &placed->nozzle))
        return true;
    /* a hole may stick in a wall where the other type's did not */
    if (!sp_evaluator_admits(search->coarse, &nozzle, &refused))
        return refused.kind != SP_ERROR_MEMORY || sp_fail_memory(error);
    return measure_with(search, front, i, &nozzle, flow, error);
}

/* With the flow that it is rated for, and with as much as it may be set to of what the nozzle takes. */
static bool try_variant(const sp_search *search, sp_front *front, size_t i, size_t k, sp_error *error)
{
    const sp_variant *variant = &search->candidates->variants[k];
    const sp_setup *setup = sp_evaluator_setup(search->coarse);
    double most = front->best.items[i].flow;
    double within = sp_flow_within(search->options, setup, variant->type, variant->pressure, most);
    if (!sp_candidates_axes(search->candidates, front->best.items[i].site.mount, k)->count)
        return true;
    if (variant->flow <= most * (1 + SP_ROUNDING) && !try_flow(search, front, i, variant, variant->flow, error))
        return false;
    return !(within > 0) || fabs(within - variant->flow) <= SP_ROUNDING * within ||
           try_flow(search, front, i, variant, within, error);
}

bool sp_try_other_types(const sp_search *search, sp_deadline *deadline, sp_front *front, sp_error *error)
{
    if (!sp_refine_asked(&search->options->refine))
        return true;
    for (size_t i = 0; i < front->best.count; i++)
        for (size_t k = 0; k < search->candidates->variant_count; k++)
            if (sp_deadline_goes_on(deadline, "refine", 1) && !try_variant(search, front, i, k, error))
                return false;
    return true;
}
