/* What result.json says of layouts, and of the geometry and fidelity that they were evaluated on. */
#include "json_put.h"

#include <sprayplan/sprayplan.h>

#include <string.h>

/* Area by reason, where all reasons are known. */
static bool put_missing(json_t *geometry, const sp_figures *figures)
{
    if (!isfinite(figures->attainable_area) || figures->missing_area[SP_REASON_UNKNOWN] > 0)
        return true;
    json_t *missing = json_object();
    bool done = true;
    for (sp_reason reason = 0; done && reason < SP_REASONS; reason++)
        done = !sp_reason_key(reason) || sp_put_real(missing, sp_reason_key(reason), figures->missing_area[reason]);
    return sp_put(geometry, "unattainable_m2", missing) && done;
}

/* The same for each part, those of most area first. */
static bool put_missing_parts(json_t *geometry, const sp_figures *figures)
{
    if (!isfinite(figures->attainable_area) || figures->missing_area[SP_REASON_UNKNOWN] > 0)
        return true;
    json_t *parts = json_array();
    bool done = true;
    for (size_t i = 0; done && i < figures->missing_count; i++) {
        json_t *part = json_object();
        done = sp_put_text(part, "part", figures->missing[i].part) &&
               sp_put_real(part, "area_m2", figures->missing[i].area);
        for (sp_reason reason = 0; done && reason < SP_REASONS; reason++)
            done =
                !sp_reason_key(reason) || sp_put_real(part, sp_reason_key(reason), figures->missing[i].areas[reason]);
        done = json_array_append_new(parts, part) == 0 && done;
    }
    return sp_put(geometry, "unattainable_by_part", parts) && done;
}

/* What was made of a geometry's triangles. `evaluator` may be NULL. */
static bool put_account(json_t *geometry, const sp_evaluator *evaluator)
{
    if (!evaluator)
        return true;
    sp_geometry_account account = sp_evaluator_account(evaluator);
    const sp_cad_account *cad = &sp_evaluator_setup(evaluator)->cad;
    json_t *object = json_object();
    bool done = sp_put_count(object, "left_out_triangles", account.left_out);
    if (done && cad->triangles)
        done = sp_put_real(object, "cad_chord_m", cad->chord) &&
               sp_put_count(object, "cad_mended_triangles", cad->mended) &&
               sp_put_count(object, "cad_sewn_faces", cad->sewn) && sp_put_count(object, "cad_faults", cad->faults);
    if (done && account.sides_known)
        done = sp_put_count(object, "closed_shells", account.closed) &&
               sp_put_count(object, "turned_shells", account.turned.count) &&
               sp_put_count(object, "open_shells", account.open) &&
               sp_put_real(object, "open_shells_m2", account.open_area) &&
               sp_put_real(object, "inside_m2", account.sides.inside) &&
               sp_put_real(object, "touching_m2", account.sides.touching) &&
               sp_put_real(object, "wet_on_both_sides_m2", account.sides.both) &&
               sp_put_real(object, "outdoors_m2", account.outdoors);
    double width;
    const sp_flaw *cracks = sp_evaluator_cracks(evaluator, &width);
    if (done && cracks && cracks->count)
        done = sp_put_count(object, "crack_corners", cracks->count) &&
               sp_put_vector(object, "crack_m", sp_setup_outside(sp_evaluator_setup(evaluator), cracks->place[0]));
    return sp_put(geometry, "account", object) && done;
}

bool sp_put_geometry(json_t *object, const sp_figures *figures, const sp_evaluator *evaluator)
{
    json_t *geometry = json_object();
    bool done =
        sp_put_count(geometry, "triangles", figures->triangles) && sp_put_real(geometry, "area_m2", figures->area) &&
        sp_put_real(geometry, "clean_area_m2", figures->clean_area) &&
        sp_put_real(geometry, "attainable_area_m2", figures->attainable_area) && put_missing(geometry, figures) &&
        put_missing_parts(geometry, figures) && put_account(geometry, evaluator);
    return sp_put(object, "geometry", geometry) && done;
}

/* What is asked for; what is not is left out. Of goods that move, the flux of the criterion is their dose's mean. */
bool sp_put_criterion(json_t *object, const sp_figures *figures)
{
    const sp_criterion *asked = &figures->criterion;
    bool goods = isfinite(figures->pass), single = asked->combine == SP_COMBINE_SINGLE;
    if (!figures->criterion_known)
        return true;
    json_t *criterion = json_object();
    bool done =
        (!(asked->flux > 0) || goods || sp_put_real(criterion, "flux_l_min_m2", 6e4 * asked->flux)) &&
        (!(asked->flux > 0) || !goods || sp_put_real(criterion, "dose_l_m2", 1e3 * asked->flux * figures->pass)) &&
        (!(asked->impact_speed > 0) || sp_put_real(criterion, "impact_speed_m_s", asked->impact_speed)) &&
        (!(asked->incidence < M_PI / 2) || sp_put_real(criterion, "incidence_rad", asked->incidence)) &&
        sp_put_text(criterion, "combine", single ? "single" : "sum") &&
        (!(asked->film > 0) || sp_put_real(criterion, "film_l_min_m", 6e4 * asked->film));
    return sp_put(object, "criterion", criterion) && done;
}

/* The largest of a figure in `count` layouts; NAN where one does not know it. */
static double worst(const sp_figures *figures, size_t count, size_t offset)
{
    double most = 0;
    for (size_t i = 0; i < count; ++i) {
        double value = *(const double *)((const char *)&figures[i] + offset);
        most = isnan(most) || isnan(value) ? NAN : fmax(most, value);
    }
    return most;
}

/* Why settings left to auto are as they are. `evaluator` may be NULL. */
static bool put_choice(json_t *fidelity, const sp_evaluator *evaluator)
{
    static const sp_choice none;
    const sp_choice *choice = evaluator ? sp_evaluator_choice(evaluator) : &none;
    json_t *reasons = json_object();
    bool done = sp_put_text(reasons, "trajectory", choice->trajectory) &&
                sp_put_text(reasons, "evaluator", choice->method) &&
                sp_put_text(reasons, "reflections", choice->reflections) &&
                sp_put_text(reasons, "jets_per_nozzle", choice->jets) && sp_put_text(reasons, "texel_m", choice->texel);
    if (done && json_object_size(reasons) > 0)
        return sp_put(fidelity, "auto", reasons);
    json_decref(reasons);
    return done;
}

/* What `count` layouts share, and the worst of their errors. */
bool sp_put_fidelity(json_t *object, const sp_figures *figures, size_t count, const sp_evaluator *evaluator)
{
    json_t *fidelity = json_object();
    bool done = sp_put_text(fidelity, "trajectory", figures->trajectory) &&
                sp_put_text(fidelity, "evaluator", figures->evaluator) &&
                sp_put_count(fidelity, "reflections", figures->reflections) &&
                sp_put_count(fidelity, "jets_per_nozzle", figures->jets) &&
                sp_put_count(fidelity, "jets_wanted_per_nozzle", figures->jets_wanted) &&
                sp_put_real(fidelity, "texel_m", figures->texel) &&
                sp_put_real(fidelity, "error_estimate", worst(figures, count, offsetof(sp_figures, error_estimate))) &&
                sp_put_real(fidelity, "misjudged", worst(figures, count, offsetof(sp_figures, misjudged))) &&
                sp_put_real(fidelity, "error_bound", worst(figures, count, offsetof(sp_figures, error_bound))) &&
                put_choice(fidelity, evaluator);
    return sp_put(object, "fidelity", fidelity) && done;
}

static bool put_flux(json_t *object, const sp_figures *figures)
{
    json_t *flux = json_object();
    bool done = sp_put_real(flux, "min", 6e4 * figures->flux_min) &&
                sp_put_real(flux, "mean", 6e4 * figures->flux_mean) &&
                sp_put_real(flux, "p05", 6e4 * figures->flux_p05) && sp_put_real(flux, "max", 6e4 * figures->flux_max);
    return sp_put(object, "flux_l_min_m2", flux) && done;
}

/* Of goods that move. */
static bool put_dose(json_t *object, const sp_figures *figures)
{
    double l_m2 = 1e3 * figures->pass;
    if (!isfinite(l_m2))
        return true;
    json_t *dose = json_object();
    bool done =
        sp_put_real(dose, "min", l_m2 * figures->flux_min) && sp_put_real(dose, "mean", l_m2 * figures->flux_mean) &&
        sp_put_real(dose, "p05", l_m2 * figures->flux_p05) && sp_put_real(dose, "max", l_m2 * figures->flux_max);
    return sp_put(object, "dose_l_m2", dose) && done && sp_put_real(object, "pass_s", figures->pass);
}

/* Where the liquid ends, where that was counted. */
static bool put_liquid(json_t *object, const sp_figures *figures)
{
    if (!isfinite(figures->landed_clean))
        return true;
    json_t *liquid = json_object();
    bool done = sp_put_real(liquid, "on_clean_surface", 6e4 * figures->landed_clean) &&
                sp_put_real(liquid, "on_other_surface", 6e4 * figures->landed_other) &&
                sp_put_real(liquid, "left", 6e4 * figures->left) &&
                sp_put_real(liquid, "not_followed", 6e4 * figures->unfollowed);
    return sp_put(object, "liquid_l_min", liquid) && done;
}

/* What runs down the walls, where the criterion asks for it. */
static bool put_film(json_t *object, const sp_film_balance *balance)
{
    if (!balance->known)
        return true;
    json_t *film = json_object();
    bool done = sp_put_real(film, "covered_area_m2", balance->area) &&
                sp_put_real(film, "arriving_l_min", 6e4 * balance->arriving) &&
                sp_put_real(film, "left_l_min", 6e4 * balance->left) &&
                sp_put_real(film, "astray_l_min", 6e4 * balance->astray) &&
                sp_put_real(film, "held_l_min", 6e4 * balance->held) &&
                sp_put_real(film, "per_girth_l_min_m", 6e4 * balance->per_girth);
    return sp_put(object, "film", film) && done;
}

static bool put_remedy(json_t *shadow, const sp_remedy_figures *figures)
{
    if (!figures->known)
        return true;
    json_t *remedy = json_object();
    bool done = sp_put_real(remedy, "covers_m2", figures->area);
    if (done && figures->type[0])
        done = sp_put_text(remedy, "type", figures->type) &&
               (!figures->port[0] || sp_put_text(remedy, "port", figures->port)) &&
               sp_put_vector(remedy, "position_m", figures->position) &&
               sp_put_real(remedy, "water_l_min", 6e4 * figures->flow);
    return sp_put(shadow, "remedy", remedy) && done;
}

static bool put_shadow(json_t *shadows, const sp_shadow_figures *figures)
{
    json_t *shadow = json_object();
    bool done = sp_put_real(shadow, "area_m2", figures->area) &&
                sp_put_vector(shadow, "centroid_m", figures->centroid) && sp_put_text(shadow, "part", figures->part) &&
                (figures->reachable < 0 || sp_put(shadow, "reachable", json_boolean(figures->reachable))) &&
                (figures->reachable || !sp_reason_key(figures->reason) ||
                 sp_put_text(shadow, "reason", sp_reason_key(figures->reason))) &&
                (!sp_lack_key(figures->lack) || sp_put_text(shadow, "lack", sp_lack_key(figures->lack))) &&
                sp_put_text(shadow, "nozzle", figures->nozzle) && put_remedy(shadow, &figures->remedy);
    return json_array_append_new(shadows, shadow) == 0 && done;
}

/* How far the surface is from the tracks of a two-axis head. */
static bool put_tracks(json_t *object, const sp_track_gaps *gaps)
{
    if (!gaps->known)
        return true;
    json_t *tracks = json_object();
    bool done = sp_put_count(tracks, "turns", gaps->turns) && sp_put_real(tracks, "seconds", gaps->duration) &&
                sp_put_real(tracks, "reached_m2", gaps->area) && sp_put_real(tracks, "mean_gap_m", gaps->mean) &&
                sp_put_real(tracks, "p95_gap_m", gaps->p95) && sp_put_real(tracks, "greatest_gap_m", gaps->greatest);
    return sp_put(object, "tracks", tracks) && done;
}

static bool put_nozzle(json_t *nozzles, const sp_nozzle_figures *figures)
{
    json_t *nozzle = json_object();
    bool done =
        sp_put_text(nozzle, "name", figures->name) && sp_put_text(nozzle, "type", figures->type) &&
        sp_put_text(nozzle, "order_code", figures->order_code) && sp_put_text(nozzle, "url", figures->url) &&
        (!figures->overlap[0] || sp_put_text(nozzle, "overlap", figures->overlap)) &&
        sp_put_vector(nozzle, "position_m", figures->position) && sp_put_vector(nozzle, "axis", figures->axis) &&
        sp_put_real(nozzle, "roll_rad", figures->roll) && sp_put_real(nozzle, "angle_rad", figures->angle) &&
        sp_put_real(nozzle, "pressure_pa", figures->pressure) &&
        sp_put_real(nozzle, "flow_l_min", 6e4 * figures->flow) && sp_put_real(nozzle, "speed_m_s", figures->speed) &&
        sp_put_real(nozzle, "alone_m2", figures->alone) && sp_put_real(nozzle, "lost_without_m2", figures->lost) &&
        (!figures->fitting || sp_put(nozzle, "new_fitting", json_true())) &&
        sp_put_real(nozzle, "cost_l_min", 6e4 * figures->cost) && put_tracks(nozzle, &figures->tracks);
    return json_array_append_new(nozzles, nozzle) == 0 && done;
}

static bool put_part(json_t *parts, const sp_part_figures *figures)
{
    json_t *part = json_object();
    bool done = sp_put_text(part, "part", figures->part) && sp_put_real(part, "area_m2", figures->area) &&
                sp_put_real(part, "covered_area_m2", figures->covered) &&
                sp_put_real(part, "coverage", figures->covered / figures->area);
    return json_array_append_new(parts, part) == 0 && done;
}

/* Water and what the mounts cost, and that in money; nothing where neither is known. */
static bool put_price(json_t *layout, const sp_figures *figures)
{
    if (!isfinite(figures->mount_cost))
        return true;
    json_t *price = json_object();
    bool done = sp_put_real(price, "mounts_l_min", 6e4 * figures->mount_cost) &&
                sp_put_real(price, "total_l_min", 6e4 * sp_figures_price(figures)) &&
                (!(figures->water_cost.money > 0) || (sp_put_real(price, "money", sp_figures_money(figures)) &&
                                                      sp_put_text(price, "currency", figures->water_cost.currency)));
    return sp_put(layout, "price", price) && done;
}

static bool put_shadows(json_t *layout, const sp_figures *figures)
{
    if (!figures->shadows_known)
        return true;
    json_t *shadows = json_array();
    bool done = true;
    for (size_t i = 0; done && i < figures->shadow_count; ++i)
        done = put_shadow(shadows, &figures->shadows[i]);
    return sp_put(layout, "shadows", shadows) && done;
}

bool sp_put_layout(json_t *layouts, const sp_figures *figures, const sp_evaluator *evaluator, sp_layout_own own)
{
    json_t *layout = json_object(), *nozzles = json_array(), *parts = json_array();
    bool done = sp_put_text(layout, "name", figures->name) && sp_put_real(layout, "water_l_min", 6e4 * figures->flow) &&
                sp_put_real(layout, "covered_area_m2", figures->covered_area) &&
                sp_put_real(layout, "coverage", figures->coverage) &&
                sp_put_real(layout, "error_estimate", figures->error_estimate) &&
                sp_put_real(layout, "misjudged", figures->misjudged) &&
                sp_put_real(layout, "error_bound", figures->error_bound) &&
                sp_put_real(layout, "borderline_m2", figures->borderline) &&
                sp_put_real(layout, "coverage_of_attainable", figures->of_attainable) &&
                sp_put_real(layout, "area_per_water", figures->area_per_water / 6e4) && put_flux(layout, figures) &&
                sp_put_count(layout, "new_fittings", figures->fittings) && put_price(layout, figures) &&
                put_dose(layout, figures) && put_liquid(layout, figures) && put_film(layout, &figures->film);
    for (size_t i = 0; done && i < figures->nozzle_count; ++i)
        done = put_nozzle(nozzles, &figures->nozzles[i]);
    for (size_t i = 0; done && i < figures->part_count; ++i)
        done = put_part(parts, &figures->parts[i]);
    done = sp_put(layout, "parts", parts) && done;
    done = done && put_shadows(layout, figures);
    done = sp_put(layout, "nozzles", nozzles) && done;
    done = done && (!own.geometry || sp_put_geometry(layout, figures, evaluator)) &&
           (!own.criterion || sp_put_criterion(layout, figures)) &&
           (!own.fidelity || sp_put_fidelity(layout, figures, 1, evaluator));
    return json_array_append_new(layouts, layout) == 0 && done;
}

static bool equal(double a, double b)
{
    return a == b || (isnan(a) && isnan(b));
}

bool sp_same_geometry(const sp_figures *a, const sp_figures *b)
{
    return a->triangles == b->triangles && equal(a->area, b->area) && equal(a->clean_area, b->clean_area) &&
           equal(a->attainable_area, b->attainable_area);
}

bool sp_same_fidelity(const sp_figures *a, const sp_figures *b)
{
    return strcmp(a->trajectory, b->trajectory) == 0 && strcmp(a->evaluator, b->evaluator) == 0 &&
           a->reflections == b->reflections && a->jets == b->jets && equal(a->texel, b->texel);
}
