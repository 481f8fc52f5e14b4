/* From designs to their figures. */
#include "design.h"
#include "figures.h"
#include "growing_text.h"

#include <stdlib.h>
#include <string.h>

static void set_setup(sp_figures *figures, const sp_evaluator *evaluator)
{
    const sp_mesh *mesh = sp_evaluator_setup(evaluator)->mesh;
    const sp_fidelity *fidelity = sp_evaluator_fidelity(evaluator);
    bool inverse = fidelity->method == SP_METHOD_INVERSE;
    figures->criterion_known = figures->shadows_known = true;
    figures->criterion = sp_evaluator_setup(evaluator)->criterion;
    figures->triangles = mesh->triangle_count;
    figures->area = sp_mesh_area(mesh);
    figures->clean_area = sp_evaluator_patches(evaluator)->total_area;
    strcpy(figures->trajectory, fidelity->trajectory == SP_TRAJECTORY_LINE   ? "line"
                                : fidelity->trajectory == SP_TRAJECTORY_DRAG ? "drag"
                                                                             : "parabola");
    strcpy(figures->evaluator, inverse ? "inverse" : "forward");
    figures->reflections = fidelity->reflections < 0 ? SP_UNKNOWN : (size_t)fidelity->reflections;
    figures->jets = inverse ? SP_UNKNOWN : fidelity->jets;
    double wanted = sp_evaluator_jets_wanted(evaluator);
    figures->jets_wanted = wanted > 0 ? (size_t)fmin(wanted, 9e15) : SP_UNKNOWN; /* JSON's whole numbers end there */
    figures->texel = fidelity->texel;
}

static void set_coverage(sp_figures *figures, const sp_coverage *coverage, const sp_sweep *sweep)
{
    figures->flow = coverage->flow;
    figures->covered_area = coverage->covered_area;
    figures->coverage = coverage->fraction;
    /* of what was not looked into more may be attainable */
    bool known = figures->attainable_area > 0 && !(figures->missing_area[SP_REASON_UNKNOWN] > 0);
    figures->of_attainable = known ? coverage->covered_area / figures->attainable_area : NAN;
    figures->area_per_water = coverage->flow > 0 ? coverage->area_per_water : NAN;
    const sp_balance *balance = &coverage->balance;
    figures->error_estimate = coverage->measured.known ? coverage->measured.estimate : NAN;
    figures->misjudged = coverage->measured.known ? coverage->measured.misjudged : NAN;
    figures->error_bound = coverage->line_error.known ? coverage->line_error.share : NAN;
    figures->borderline = coverage->borderline.known ? coverage->borderline.area : NAN;
    figures->landed_clean = balance->known ? balance->clean : NAN;
    figures->landed_other = balance->known ? balance->other : NAN;
    figures->left = balance->known ? balance->left : NAN;
    figures->unfollowed = balance->known ? balance->unfollowed : NAN;
    figures->film = coverage->film;
    figures->flux_min = coverage->flux_min;
    figures->flux_mean = coverage->flux_mean;
    figures->flux_p05 = coverage->flux_p05;
    figures->flux_max = coverage->flux_max;
    figures->pass = sweep->speed > 0 ? sp_sweep_duration(sweep) : NAN;
}

static bool set_nozzles(sp_figures *figures, const sp_design *design)
{
    const sp_layout *layout = design->layout;
    const sp_contributions *does = design->contributions;
    const sp_setup *setup = sp_evaluator_setup(design->evaluator);
    const sp_fluid *liquid = &setup->liquid;
    bool copied = true;
    figures->fittings = 0;
    for (size_t i = 0; i < figures->nozzle_count; ++i) {
        const sp_nozzle *nozzle = &layout->nozzles[i];
        char overlap[SP_OVERLAP_TEXT];
        sp_layout_overlap(layout, i, overlap);
        figures->nozzles[i] = (sp_nozzle_figures){.name = sp_text_utf8(nozzle->name),
                                                  .type = sp_text_utf8(nozzle->type->name),
                                                  .order_code = sp_text_utf8(nozzle->type->order_code),
                                                  .url = sp_text_utf8(nozzle->type->url),
                                                  .overlap = sp_text_utf8(overlap),
                                                  .position = sp_setup_outside(setup, nozzle->position),
                                                  .axis = nozzle->axis,
                                                  .roll = nozzle->roll,
                                                  .angle = sp_nozzle_cone(nozzle),
                                                  .pressure = nozzle->pressure,
                                                  .flow = sp_nozzle_flow(nozzle, liquid),
                                                  .speed = sp_nozzle_speed(nozzle, liquid),
                                                  .alone = does ? does->alone[i] : NAN,
                                                  .lost = does ? does->lost[i] : NAN,
                                                  .fitting = design->alternative && design->alternative->fittings[i]};
        figures->fittings += figures->nozzles[i].fitting;
        copied &= figures->nozzles[i].name && figures->nozzles[i].type && figures->nozzles[i].order_code &&
                  figures->nozzles[i].url && figures->nozzles[i].overlap;
    }
    figures->fittings = design->alternative ? figures->fittings : SP_UNKNOWN;
    return copied;
}

/* What the mounts of its nozzles cost; one that is kept or lies on no mount costs nothing. */
static void set_costs(sp_figures *figures, const sp_design *design)
{
    const sp_setup *setup = sp_evaluator_setup(design->evaluator);
    bool costly = false;
    for (size_t m = 0; m < design->mount_count; ++m)
        costly |= design->mounts[m].cost > 0;
    figures->water_cost = design->water_cost;
    figures->mount_cost = costly || design->water_cost.money > 0 ? 0 : NAN;
    for (size_t i = 0; i < figures->nozzle_count; ++i) {
        const sp_nozzle *nozzle = &design->layout->nozzles[i];
        size_t mount = costly && !design->costs && !nozzle->keep
                           ? sp_mount_at(setup, design->mounts, design->mount_count, nozzle->position)
                           : SIZE_MAX;
        double cost = mount == SIZE_MAX ? 0 : design->mounts[mount].cost;
        figures->nozzles[i].cost = !costly ? NAN : design->costs ? design->costs[i] : cost;
        figures->mount_cost += costly ? figures->nozzles[i].cost : 0;
    }
}

static bool set_tracks(sp_figures *figures, const sp_design *design, sp_error *error)
{
    for (size_t i = 0; i < figures->nozzle_count; ++i)
        if (!sp_find_track_gaps(design->evaluator, &design->layout->nozzles[i], &figures->nozzles[i].tracks, error))
            return false;
    return true;
}

/* Which nozzle brings most liquid to each shadow, its index; SP_UNKNOWN where none does. */
static bool find_nearest(const sp_design *design, const sp_shadow *shadows, size_t count, size_t *nearest)
{
    const sp_contributions *does = design->contributions;
    const sp_patches *patches = sp_evaluator_patches(design->evaluator);
    uint32_t *numbers = malloc((patches->count + 1) * sizeof *numbers);
    double *brought = malloc((count + 1) * sizeof *brought), *most = calloc(count + 1, sizeof *most);
    bool done = numbers && brought && most &&
                sp_shadow_numbers(design->evaluator, design->coverage, shadows, count, numbers, NULL);
    for (size_t n = 0; done && n < does->count; ++n) {
        memset(brought, 0, (count + 1) * sizeof *brought); /* the first: of all patches in no shadow */
        for (size_t k = 0; k < patches->count; ++k)
            brought[numbers[k]] += patches->area[k] * (double)does->flux[n * does->patches + k];
        for (size_t i = 0; i < count; ++i)
            if (brought[i + 1] > most[i]) {
                most[i] = brought[i + 1];
                nearest[i] = n;
            }
    }
    free(numbers);
    free(brought);
    free(most);
    return done;
}

/* Of shadow `i`; false where memory ran out. */
static bool set_remedy(sp_remedy_figures *figures, const sp_design *design, size_t i)
{
    const sp_remedy *remedy = i < design->remedy_count ? &design->remedies[i] : NULL;
    bool found = remedy && remedy->nozzle.type;
    *figures = (sp_remedy_figures){.known = remedy,
                                   .type = sp_text_utf8(found ? remedy->nozzle.type->name : ""),
                                   .port = sp_text_utf8(found && remedy->in_port ? remedy->nozzle.name : "")};
    if (found) {
        figures->position = sp_setup_outside(sp_evaluator_setup(design->evaluator), remedy->nozzle.position);
        figures->area = remedy->area;
        figures->flow = remedy->flow;
    }
    return figures->type && figures->port;
}

static bool set_shadows(sp_figures *figures, const sp_design *design, const sp_shadow *shadows)
{
    const sp_setup *setup = sp_evaluator_setup(design->evaluator);
    size_t nearest[SP_SHADOWS_KEPT];
    for (size_t i = 0; i < SP_SHADOWS_KEPT; ++i)
        nearest[i] = SP_UNKNOWN;
    bool copied = !design->contributions || find_nearest(design, shadows, figures->shadow_count, nearest);
    for (size_t i = 0; i < figures->shadow_count; ++i) {
        const sp_shadow *shadow = &shadows[i];
        const char *nozzle = nearest[i] == SP_UNKNOWN ? "" : design->layout->nozzles[nearest[i]].name;
        figures->shadows[i] = (sp_shadow_figures){
            .area = shadow->area,
            .centroid = sp_setup_outside(setup, shadow->centroid),
            .part = sp_text_utf8(setup->mesh->parts[shadow->part].name),
            .reachable = shadow->reachable_area < 0 ? -1 : shadow->reachable_area >= 0.5 * shadow->area,
            .reason = shadow->reason,
            .lack = shadow->lack,
            .nozzle = sp_text_utf8(nozzle)};
        copied &= set_remedy(&figures->shadows[i].remedy, design, i) && figures->shadows[i].part &&
                  figures->shadows[i].nozzle;
    }
    return copied;
}

/* Parts while patches are gone through. */
typedef struct {
    sp_part_figures *parts; /* [part_count of the mesh] */
    size_t count;           /* that have any area */
    double share;           /* of the patch in hand that is covered */
} part_sum;

static void add_to_part(void *user, uint32_t part, double area)
{
    part_sum *sum = user;
    sum->count += sum->parts[part].area == 0 && area > 0;
    sum->parts[part].area += area;
    sum->parts[part].covered += area * sum->share;
}

static bool set_parts(sp_figures *figures, const sp_design *design)
{
    const sp_mesh *mesh = sp_evaluator_setup(design->evaluator)->mesh;
    const sp_patches *patches = sp_evaluator_patches(design->evaluator);
    sp_part_figures *all = calloc(mesh->part_count + 1, sizeof *all);
    part_sum sum = {.parts = all};
    for (uint32_t k = 0; all && k < patches->count; ++k) {
        sum.share = design->coverage->deposits.share[k];
        sp_evaluator_part_areas(design->evaluator, k, add_to_part, &sum);
    }
    size_t count = sum.count, row = 0;
    bool done = all && sp_figures_make_parts(figures, count);
    for (size_t i = 0; done && row < count; ++i)
        if (all[i].area > 0) {
            sp_part_figures *part = &figures->parts[row++];
            *part = all[i];
            done = (part->part = sp_text_utf8(mesh->parts[i].name)) != NULL;
        }
    free(all);
    return done;
}

/* Area by reason; the attainable area is that of no reason. */
static void set_attainable(sp_figures *figures, const sp_patches *patches, const sp_reason *reasons)
{
    for (sp_reason reason = 0; reason < SP_REASONS; reason++)
        figures->missing_area[reason] = reasons ? 0 : NAN;
    for (size_t k = 0; reasons && k < patches->count; ++k)
        figures->missing_area[reasons[k]] += patches->area[k];
    figures->attainable_area = figures->missing_area[SP_REASON_ATTAINABLE];
    figures->missing_area[SP_REASON_ATTAINABLE] = reasons ? 0 : NAN;
}

static int by_area(const void *left, const void *right)
{
    const sp_missing_figures *a = left, *b = right;
    if (a->area != b->area)
        return a->area > b->area ? -1 : 1;
    return strcmp(a->part, b->part);
}

/* The same by part, while patches are gone through. */
typedef struct {
    sp_missing_figures *parts; /* [part_count of the mesh] */
    size_t count;              /* of which any is missing */
    sp_reason reason;          /* of the patch in hand */
} missing_sum;

static void add_to_missing(void *user, uint32_t part, double area)
{
    missing_sum *sum = user;
    sp_missing_figures *missing = &sum->parts[part];
    missing->areas[sum->reason] += area;
    if (sum->reason == SP_REASON_ATTAINABLE || !(area > 0))
        return;
    sum->count += missing->area == 0;
    missing->area += area;
}

static bool set_missing_parts(sp_figures *figures, const sp_evaluator *evaluator, const sp_reason *reasons)
{
    const sp_patches *patches = sp_evaluator_patches(evaluator);
    const sp_mesh *mesh = sp_evaluator_setup(evaluator)->mesh;
    sp_missing_figures *parts = reasons ? calloc(mesh->part_count + 1, sizeof *parts) : NULL;
    missing_sum sum = {.parts = parts};
    for (uint32_t k = 0; parts && k < patches->count; ++k) {
        sum.reason = reasons[k];
        sp_evaluator_part_areas(evaluator, k, add_to_missing, &sum);
    }
    size_t count = sum.count, row = 0;
    bool done = (parts || !reasons) && sp_figures_make_missing(figures, count);
    for (size_t i = 0; done && row < count; ++i)
        if (parts[i].area > 0) {
            sp_missing_figures *missing = &figures->missing[row++];
            *missing = parts[i];
            missing->areas[SP_REASON_ATTAINABLE] = 0;
            done = (missing->part = sp_text_utf8(mesh->parts[i].name)) != NULL;
        }
    free(parts);
    if (done)
        qsort(figures->missing, count, sizeof *figures->missing, by_area);
    return done;
}

/* With `reasons` NULL attainable area is not known; else it is `attained` at least, m²: parts of patches count, too. */
static bool describe(sp_figures *figures, const sp_design *design, const sp_reason *reasons, double attained,
                     sp_error *error)
{
    sp_shadow *shadows = NULL;
    size_t shadow_count = 0;
    if (!sp_shadows(design->evaluator, design->coverage, reasons, &shadows, &shadow_count, error))
        return false;
    set_setup(figures, design->evaluator);
    set_attainable(figures, sp_evaluator_patches(design->evaluator), reasons);
    if (reasons)
        figures->attainable_area = fmax(figures->attainable_area, attained);
    set_coverage(figures, design->coverage, &sp_evaluator_setup(design->evaluator)->sweep);
    bool done = set_missing_parts(figures, design->evaluator, reasons) &&
                sp_figures_make_rows(figures, shadow_count < SP_SHADOWS_KEPT ? shadow_count : SP_SHADOWS_KEPT,
                                     design->layout->count) &&
                set_nozzles(figures, design) && set_shadows(figures, design, shadows) && set_parts(figures, design);
    free(shadows);
    if (!done)
        return sp_fail_memory(error);
    set_costs(figures, design);
    return set_tracks(figures, design, error);
}

/* Why patches are not attainable to what speaks of a design: what that proposal says, but for what the designs that it
 * speaks of cover, *beyond m² of which it calls out of reach. Without one NULL and no error. */
static sp_reason *reported_reasons(const sp_result *result, size_t design, double *beyond, sp_error *error)
{
    const sp_proposal *proposal = sp_result_proposal(result, design);
    const sp_evaluator *evaluator = result->designs[design].evaluator;
    if (!proposal)
        return NULL;
    const sp_patches *patches = sp_evaluator_patches(evaluator);
    sp_reason *reasons = malloc((patches->count + 1) * sizeof *reasons);
    if (!reasons)
        return sp_fail_memory(error);
    for (size_t k = 0; k < patches->count; ++k)
        reasons[k] = proposal->attainable[k] ? SP_REASON_ATTAINABLE
                     : proposal->reasons     ? proposal->reasons[k]
                                             : SP_REASON_UNKNOWN;
    for (size_t i = 0; i < result->design_count; ++i)
        for (size_t k = 0; sp_result_proposal(result, i) == proposal && k < patches->count; ++k)
            if (result->designs[i].coverage->deposits.covered[k] && reasons[k] != SP_REASON_ATTAINABLE) {
                *beyond += reasons[k] != SP_REASON_UNKNOWN ? patches->area[k] : 0;
                reasons[k] = SP_REASON_ATTAINABLE;
            }
    return reasons;
}

/* The most that a design covers of those that the same proposal speaks of, m². */
static double most_attained(const sp_result *result, size_t design)
{
    const sp_proposal *proposal = sp_result_proposal(result, design);
    double most = 0;
    for (size_t i = 0; proposal && i < result->design_count; ++i)
        if (sp_result_proposal(result, i) == proposal)
            most = fmax(most, result->designs[i].coverage->covered_area);
    return most;
}

bool sp_result_is_whole(const sp_result *result, sp_error *error)
{
    if (!result)
        return false;
    for (size_t i = 0; i < result->design_count; ++i) {
        const sp_design *design = &result->designs[i];
        if (design->evaluator ? !design->layout || !design->coverage : !design->figures)
            return sp_fail(error, SP_ERROR_ARGUMENT, NULL, 0, 0,
                           "design %s: found without %s, expected layout and coverage on an evaluator, or figures",
                           design->name, design->evaluator ? "layout or coverage" : "evaluator and figures");
    }
    return true;
}

sp_figures *sp_result_figures(const sp_result *result, sp_error *error)
{
    if (!sp_result_is_whole(result, error))
        return NULL;
    sp_figures *figures = calloc(result->design_count + 1, sizeof *figures);
    if (!figures)
        return sp_fail_memory(error);
    sp_error failure = {0};
    for (size_t i = 0; failure.kind == SP_OK && i < result->design_count; ++i) {
        const sp_design *design = &result->designs[i];
        sp_reason *reasons = design->evaluator ? reported_reasons(result, i, &figures[i].beyond_area, &failure) : NULL;
        if (!design->evaluator && !sp_figures_copy(&figures[i], design->figures))
            sp_fail_memory(&failure);
        if (design->evaluator && failure.kind == SP_OK)
            describe(&figures[i], design, reasons, most_attained(result, i), &failure);
        free(reasons);
        if (failure.kind == SP_OK && !(figures[i].name = sp_text_utf8(design->name)))
            sp_fail_memory(&failure);
    }
    if (failure.kind == SP_OK)
        return figures;
    if (error && error->kind == SP_OK)
        *error = failure;
    sp_figures_destroy(figures, result->design_count);
    return NULL;
}
