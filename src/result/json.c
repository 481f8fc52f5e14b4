/* result.json as DESIGN §6: keys in its order, what was not computed absent. */
#include "growing_text.h"

#include <sprayplan/result.h>
#include <sprayplan/sprayplan.h>

#include <jansson.h>
#include <stdlib.h>
#include <string.h>

/* An absent figure is no failure; a figure that finds no memory is. */
static bool put(json_t *object, const char *key, json_t *value)
{
    return json_object_set_new(object, key, value) == 0;
}

static bool put_real(json_t *object, const char *key, double value)
{
    return !isfinite(value) || put(object, key, json_real(value));
}

static bool put_count(json_t *object, const char *key, size_t value)
{
    return value == SP_UNKNOWN || put(object, key, json_integer((json_int_t)value));
}

static bool put_text(json_t *object, const char *key, const char *value)
{
    return !value[0] || put(object, key, json_string(value));
}

static bool put_vector(json_t *object, const char *key, sp_vec3 value)
{
    if (!isfinite(value.x) || !isfinite(value.y) || !isfinite(value.z))
        return true;
    return put(object, key, json_pack("[fff]", value.x, value.y, value.z));
}

/* Area by reason, where all reasons are known. */
static bool put_missing(json_t *geometry, const sp_figures *figures)
{
    if (!isfinite(figures->attainable_area) || figures->missing_area[SP_REASON_UNKNOWN] > 0)
        return true;
    json_t *missing = json_object();
    bool done = true;
    for (sp_reason reason = 0; done && reason < SP_REASONS; reason++)
        done = !sp_reason_key(reason) || put_real(missing, sp_reason_key(reason), figures->missing_area[reason]);
    return put(geometry, "unattainable_m2", missing) && done;
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
        done = put_text(part, "part", figures->missing[i].part) && put_real(part, "area_m2", figures->missing[i].area);
        for (sp_reason reason = 0; done && reason < SP_REASONS; reason++)
            done = !sp_reason_key(reason) || put_real(part, sp_reason_key(reason), figures->missing[i].areas[reason]);
        done = json_array_append_new(parts, part) == 0 && done;
    }
    return put(geometry, "unattainable_by_part", parts) && done;
}

/* What was made of a geometry's triangles. `evaluator` may be NULL. */
static bool put_account(json_t *geometry, const sp_evaluator *evaluator)
{
    if (!evaluator)
        return true;
    sp_geometry_account account = sp_evaluator_account(evaluator);
    const sp_cad_account *cad = &sp_evaluator_setup(evaluator)->cad;
    json_t *object = json_object();
    bool done = put_count(object, "left_out_triangles", account.left_out);
    if (done && cad->triangles)
        done = put_real(object, "cad_chord_m", cad->chord) && put_count(object, "cad_mended_triangles", cad->mended) &&
               put_count(object, "cad_sewn_faces", cad->sewn) && put_count(object, "cad_faults", cad->faults);
    if (done && account.sides_known)
        done = put_count(object, "closed_shells", account.closed) &&
               put_count(object, "turned_shells", account.turned) && put_count(object, "open_shells", account.open) &&
               put_real(object, "open_shells_m2", account.open_area) &&
               put_real(object, "inside_m2", account.sides.inside) &&
               put_real(object, "touching_m2", account.sides.touching) &&
               put_real(object, "wet_on_both_sides_m2", account.sides.both) &&
               put_real(object, "outdoors_m2", account.outdoors);
    return put(geometry, "account", object) && done;
}

static bool put_geometry(json_t *object, const sp_figures *figures, const sp_evaluator *evaluator)
{
    json_t *geometry = json_object();
    bool done = put_count(geometry, "triangles", figures->triangles) && put_real(geometry, "area_m2", figures->area) &&
                put_real(geometry, "clean_area_m2", figures->clean_area) &&
                put_real(geometry, "attainable_area_m2", figures->attainable_area) && put_missing(geometry, figures) &&
                put_missing_parts(geometry, figures) && put_account(geometry, evaluator);
    return put(object, "geometry", geometry) && done;
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
    bool done = put_text(reasons, "trajectory", choice->trajectory) && put_text(reasons, "evaluator", choice->method) &&
                put_text(reasons, "reflections", choice->reflections) &&
                put_text(reasons, "jets_per_nozzle", choice->jets) && put_text(reasons, "texel_m", choice->texel);
    if (done && json_object_size(reasons) > 0)
        return put(fidelity, "auto", reasons);
    json_decref(reasons);
    return done;
}

/* What `count` layouts share, and the worst of their errors. */
static bool put_fidelity(json_t *object, const sp_figures *figures, size_t count, const sp_evaluator *evaluator)
{
    json_t *fidelity = json_object();
    bool done = put_text(fidelity, "trajectory", figures->trajectory) &&
                put_text(fidelity, "evaluator", figures->evaluator) &&
                put_count(fidelity, "reflections", figures->reflections) &&
                put_count(fidelity, "jets_per_nozzle", figures->jets) &&
                put_count(fidelity, "jets_wanted_per_nozzle", figures->jets_wanted) &&
                put_real(fidelity, "texel_m", figures->texel) &&
                put_real(fidelity, "error_estimate", worst(figures, count, offsetof(sp_figures, error_estimate))) &&
                put_real(fidelity, "misjudged", worst(figures, count, offsetof(sp_figures, misjudged))) &&
                put_real(fidelity, "error_bound", worst(figures, count, offsetof(sp_figures, error_bound))) &&
                put_choice(fidelity, evaluator);
    return put(object, "fidelity", fidelity) && done;
}

static bool put_flux(json_t *object, const sp_figures *figures)
{
    json_t *flux = json_object();
    bool done = put_real(flux, "min", 6e4 * figures->flux_min) && put_real(flux, "mean", 6e4 * figures->flux_mean) &&
                put_real(flux, "p05", 6e4 * figures->flux_p05) && put_real(flux, "max", 6e4 * figures->flux_max);
    return put(object, "flux_l_min_m2", flux) && done;
}

/* Of goods that move. */
static bool put_dose(json_t *object, const sp_figures *figures)
{
    double l_m2 = 1e3 * figures->pass;
    if (!isfinite(l_m2))
        return true;
    json_t *dose = json_object();
    bool done = put_real(dose, "min", l_m2 * figures->flux_min) && put_real(dose, "mean", l_m2 * figures->flux_mean) &&
                put_real(dose, "p05", l_m2 * figures->flux_p05) && put_real(dose, "max", l_m2 * figures->flux_max);
    return put(object, "dose_l_m2", dose) && done && put_real(object, "pass_s", figures->pass);
}

/* Where the liquid ends, where that was counted. */
static bool put_liquid(json_t *object, const sp_figures *figures)
{
    if (!isfinite(figures->landed_clean))
        return true;
    json_t *liquid = json_object();
    bool done = put_real(liquid, "on_clean_surface", 6e4 * figures->landed_clean) &&
                put_real(liquid, "on_other_surface", 6e4 * figures->landed_other) &&
                put_real(liquid, "left", 6e4 * figures->left) &&
                put_real(liquid, "not_followed", 6e4 * figures->unfollowed);
    return put(object, "liquid_l_min", liquid) && done;
}

/* What runs down the walls, where the criterion asks for it. */
static bool put_film(json_t *object, const sp_film_balance *balance)
{
    if (!balance->known)
        return true;
    json_t *film = json_object();
    bool done =
        put_real(film, "covered_area_m2", balance->area) && put_real(film, "arriving_l_min", 6e4 * balance->arriving) &&
        put_real(film, "left_l_min", 6e4 * balance->left) && put_real(film, "astray_l_min", 6e4 * balance->astray) &&
        put_real(film, "held_l_min", 6e4 * balance->held) &&
        put_real(film, "per_girth_l_min_m", 6e4 * balance->per_girth);
    return put(object, "film", film) && done;
}

static bool put_remedy(json_t *shadow, const sp_remedy_figures *figures)
{
    if (!figures->known)
        return true;
    json_t *remedy = json_object();
    bool done = put_real(remedy, "covers_m2", figures->area);
    if (done && figures->type[0])
        done =
            put_text(remedy, "type", figures->type) && (!figures->port[0] || put_text(remedy, "port", figures->port)) &&
            put_vector(remedy, "position_m", figures->position) && put_real(remedy, "water_l_min", 6e4 * figures->flow);
    return put(shadow, "remedy", remedy) && done;
}

static bool put_shadow(json_t *shadows, const sp_shadow_figures *figures)
{
    json_t *shadow = json_object();
    bool done = put_real(shadow, "area_m2", figures->area) && put_vector(shadow, "centroid_m", figures->centroid) &&
                put_text(shadow, "part", figures->part) &&
                (figures->reachable < 0 || put(shadow, "reachable", json_boolean(figures->reachable))) &&
                (figures->reachable || !sp_reason_key(figures->reason) ||
                 put_text(shadow, "reason", sp_reason_key(figures->reason))) &&
                (!sp_lack_key(figures->lack) || put_text(shadow, "lack", sp_lack_key(figures->lack))) &&
                put_text(shadow, "nozzle", figures->nozzle) && put_remedy(shadow, &figures->remedy);
    return json_array_append_new(shadows, shadow) == 0 && done;
}

/* How far the surface is from the tracks of a two-axis head. */
static bool put_tracks(json_t *object, const sp_track_gaps *gaps)
{
    if (!gaps->known)
        return true;
    json_t *tracks = json_object();
    bool done = put_count(tracks, "turns", gaps->turns) && put_real(tracks, "seconds", gaps->duration) &&
                put_real(tracks, "reached_m2", gaps->area) && put_real(tracks, "mean_gap_m", gaps->mean) &&
                put_real(tracks, "p95_gap_m", gaps->p95) && put_real(tracks, "greatest_gap_m", gaps->greatest);
    return put(object, "tracks", tracks) && done;
}

static bool put_nozzle(json_t *nozzles, const sp_nozzle_figures *figures)
{
    json_t *nozzle = json_object();
    bool done = put_text(nozzle, "name", figures->name) && put_text(nozzle, "type", figures->type) &&
                put_text(nozzle, "order_code", figures->order_code) && put_text(nozzle, "url", figures->url) &&
                put_vector(nozzle, "position_m", figures->position) && put_vector(nozzle, "axis", figures->axis) &&
                put_real(nozzle, "roll_rad", figures->roll) && put_real(nozzle, "angle_rad", figures->angle) &&
                put_real(nozzle, "pressure_pa", figures->pressure) &&
                put_real(nozzle, "flow_l_min", 6e4 * figures->flow) && put_real(nozzle, "speed_m_s", figures->speed) &&
                put_real(nozzle, "alone_m2", figures->alone) && put_real(nozzle, "lost_without_m2", figures->lost) &&
                (!figures->fitting || put(nozzle, "new_fitting", json_true())) &&
                put_real(nozzle, "cost_l_min", 6e4 * figures->cost) && put_tracks(nozzle, &figures->tracks);
    return json_array_append_new(nozzles, nozzle) == 0 && done;
}

static bool put_part(json_t *parts, const sp_part_figures *figures)
{
    json_t *part = json_object();
    bool done = put_text(part, "part", figures->part) && put_real(part, "area_m2", figures->area) &&
                put_real(part, "covered_area_m2", figures->covered) &&
                put_real(part, "coverage", figures->covered / figures->area);
    return json_array_append_new(parts, part) == 0 && done;
}

/* Water and what the mounts cost, and that in money; nothing where neither is told. */
static bool put_price(json_t *layout, const sp_figures *figures)
{
    if (!isfinite(figures->mount_cost))
        return true;
    json_t *price = json_object();
    bool done = put_real(price, "mounts_l_min", 6e4 * figures->mount_cost) &&
                put_real(price, "total_l_min", 6e4 * sp_figures_price(figures)) &&
                (!(figures->water_cost.money > 0) || (put_real(price, "money", sp_figures_money(figures)) &&
                                                      put_text(price, "currency", figures->water_cost.currency)));
    return put(layout, "price", price) && done;
}

static bool put_layout(json_t *layouts, const sp_figures *figures, const sp_evaluator *evaluator, bool own_geometry,
                       bool own_fidelity)
{
    json_t *layout = json_object(), *shadows = json_array(), *nozzles = json_array(), *parts = json_array();
    bool done =
        put_text(layout, "name", figures->name) && put_real(layout, "water_l_min", 6e4 * figures->flow) &&
        put_real(layout, "covered_area_m2", figures->covered_area) && put_real(layout, "coverage", figures->coverage) &&
        put_real(layout, "error_estimate", figures->error_estimate) &&
        put_real(layout, "misjudged", figures->misjudged) && put_real(layout, "error_bound", figures->error_bound) &&
        put_real(layout, "borderline_m2", figures->borderline) &&
        put_real(layout, "coverage_of_attainable", figures->of_attainable) &&
        put_real(layout, "area_per_water", figures->area_per_water / 6e4) && put_flux(layout, figures) &&
        put_count(layout, "new_fittings", figures->fittings) && put_price(layout, figures) &&
        put_dose(layout, figures) && put_liquid(layout, figures) && put_film(layout, &figures->film);
    for (size_t i = 0; done && i < figures->shadow_count; ++i)
        done = put_shadow(shadows, &figures->shadows[i]);
    for (size_t i = 0; done && i < figures->nozzle_count; ++i)
        done = put_nozzle(nozzles, &figures->nozzles[i]);
    for (size_t i = 0; done && i < figures->part_count; ++i)
        done = put_part(parts, &figures->parts[i]);
    done = put(layout, "parts", parts) && done;
    done = put(layout, "shadows", shadows) && done;
    done = put(layout, "nozzles", nozzles) && done;
    done = done && (!own_geometry || put_geometry(layout, figures, evaluator)) &&
           (!own_fidelity || put_fidelity(layout, figures, 1, evaluator));
    return json_array_append_new(layouts, layout) == 0 && done;
}

static bool equal(double a, double b)
{
    return a == b || (isnan(a) && isnan(b));
}

static bool same_geometry(const sp_figures *a, const sp_figures *b)
{
    return a->triangles == b->triangles && equal(a->area, b->area) && equal(a->clean_area, b->clean_area) &&
           equal(a->attainable_area, b->attainable_area);
}

static bool same_fidelity(const sp_figures *a, const sp_figures *b)
{
    return strcmp(a->trajectory, b->trajectory) == 0 && strcmp(a->evaluator, b->evaluator) == 0 &&
           a->reflections == b->reflections && a->jets == b->jets && equal(a->texel, b->texel);
}

/* What was asked for; where less is attainable, what was aimed at is less. */
static bool put_target(json_t *root, const sp_proposal *proposal, double clean_area)
{
    json_t *target = json_object();
    bool done = put_real(target, "coverage", proposal->asked_area / clean_area) &&
                put_real(target, "coverage_aimed_at", proposal->target_area / clean_area) &&
                put(target, "reached", json_boolean(proposal->reached));
    return put(root, "target", target) && done;
}

/* `fittings`: with how many nozzles of each point want one. */
static bool put_front(json_t *root, const sp_proposal *proposal, double clean_area, bool fittings)
{
    double whole = proposal->certificate.whole;
    json_t *front = json_array();
    bool done = true;
    for (size_t i = 0; done && i < proposal->front_count; ++i) {
        const sp_front_point *point = &proposal->front[i];
        json_t *entry = json_object();
        done = put_real(entry, "water_l_min", 6e4 * point->flow) &&
               (!proposal->costly || put_real(entry, "price_l_min", 6e4 * point->outlay)) &&
               put_real(entry, "coverage", point->area / clean_area) && put_count(entry, "nozzles", point->nozzles) &&
               (!fittings || put_count(entry, "new_fittings", point->fittings)) &&
               (!proposal->certificate.computed || (put_real(entry, "coverage_on_texels", point->counted / whole) &&
                                                    put_real(entry, "coverage_bound", point->bound / whole))) &&
               (!proposal->certificate.every_aim.computed ||
                put_real(entry, "coverage_bound_every_aim", point->every_aim_bound / whole));
        done = json_array_append_new(front, entry) == 0 && done;
    }
    return put(root, "front", front) && done;
}

static bool put_front_by_nozzles(json_t *root, const sp_proposal *proposal, double clean_area, bool fittings)
{
    json_t *front = json_array();
    bool done = true;
    for (size_t i = 0; done && i < proposal->by_number_count; ++i) {
        const sp_front_point *point = &proposal->by_number[i];
        json_t *entry = json_object();
        done = put_count(entry, "nozzles", point->nozzles) && put_real(entry, "water_l_min", 6e4 * point->flow) &&
               (!proposal->costly || put_real(entry, "price_l_min", 6e4 * point->outlay)) &&
               put_real(entry, "coverage", point->area / clean_area) &&
               (!fittings || put_count(entry, "new_fittings", point->fittings));
        done = json_array_append_new(front, entry) == 0 && done;
    }
    return put(root, "front_by_nozzles", front) && done;
}

/* The keys of bounds: of water, or where mounts cost something of water and cost. */
static const char *const bound_keys[2][2] = {
    {"coverage_bound_same_water", "water_bound_same_coverage_l_min"},
    {"coverage_bound_same_price", "price_bound_same_coverage_l_min"},
};

static bool put_every_aim(json_t *certificate, const sp_certificate *found, bool costly)
{
    json_t *every = json_object();
    bool done = put_count(every, "mounting_points", found->every_aim.places) &&
                put_real(every, bound_keys[costly][0], found->every_aim.area_bound / found->whole) &&
                put_real(every, bound_keys[costly][1], 6e4 * found->every_aim.water_bound) &&
                put_real(every, "gap", found->every_aim.gap);
    return put(certificate, "every_aim", every) && done;
}

static bool put_forward_check(json_t *root, const sp_forward_check *found)
{
    json_t *check = json_object();
    bool done = put_real(check, "coverage", found->coverage) && put_real(check, "difference", found->difference) &&
                put_real(check, "tolerance", found->tolerance) && put(check, "agrees", json_boolean(found->agrees)) &&
                put_count(check, "jets", (size_t)found->jets) && put_count(check, "texels", found->texels);
    return put(root, "forward_check", check) && done;
}

/* Everything that it speaks of is counted on its own texels. */
static bool put_certificate(json_t *root, const sp_certificate *found, bool costly)
{
    json_t *certificate = json_object();
    bool done = put_text(certificate, "method", "lagrangian dual, layouts of few nozzles one by one") &&
                put_real(certificate, "coverage", found->counted / found->whole) &&
                put_real(certificate, bound_keys[costly][0], found->area_bound / found->whole) &&
                put_real(certificate, bound_keys[costly][1], 6e4 * found->water_bound) &&
                put_real(certificate, "gap", found->gap) && put_count(certificate, "candidates", found->candidates) &&
                put_count(certificate, "own_poses", found->own) && put_count(certificate, "texels", found->texels) &&
                (!found->every_aim.computed || put_every_aim(certificate, found, costly));
    return put(root, "certificate", certificate) && done;
}

static bool put_stages(json_t *stages, const sp_stage *list, size_t count)
{
    for (size_t i = 0; i < count; ++i)
        if (json_array_append_new(stages, json_pack("{s:s, s:f, s:f}", "name", list[i].name, "seconds", list[i].seconds,
                                                    "processor_seconds", list[i].processor_seconds)) != 0)
            return false;
    return true;
}

static bool put_inputs(json_t *root, const sp_result *result)
{
    if (result->input_count == 0)
        return true;
    json_t *inputs = json_array();
    bool done = true;
    for (size_t i = 0; done && i < result->input_count; ++i) {
        json_t *input = json_object();
        char *path = sp_text_utf8(result->inputs[i].path);
        done = path && put_text(input, "file", path) && put_text(input, "sha256", result->inputs[i].sha256);
        free(path);
        done = json_array_append_new(inputs, input) == 0 && done;
    }
    return put(root, "inputs", inputs) && done;
}

/* Of a proposal, a result or both; nothing where all was carried out. */
static bool put_cut_short(json_t *object, const sp_proposal *proposal, const sp_result *result)
{
    json_t *cut = json_array();
    bool done = true;
    for (size_t i = 0; done && proposal && i < proposal->cut_count; ++i)
        done = json_array_append_new(cut, json_string(proposal->cut[i])) == 0;
    for (size_t i = 0; done && result && i < result->left_out_count; ++i)
        done = json_array_append_new(cut, json_string(result->left_out[i])) == 0;
    if (done && json_array_size(cut) > 0)
        return put(object, "cut_short", cut);
    json_decref(cut);
    return done;
}

/* What was found and proved, besides the layout. */
static bool put_proposal(json_t *object, const sp_proposal *proposal, double clean_area, bool fittings)
{
    return put_target(object, proposal, clean_area) && put_front(object, proposal, clean_area, fittings) &&
           put_front_by_nozzles(object, proposal, clean_area, fittings) &&
           (!proposal->forward_check.computed || put_forward_check(object, &proposal->forward_check)) &&
           (!proposal->certificate.computed || put_certificate(object, &proposal->certificate, proposal->costly));
}

/* Which alternative is proposed, and the same of each. */
static bool put_alternatives(json_t *root, const sp_result *result, const sp_figures *figures)
{
    char why[SP_CHOICE_TEXT];
    json_t *alternatives = json_array();
    sp_result_choice(result, why);
    bool done =
        put_text(root, "proposed", figures[sp_result_proposed(result)].name) && put_text(root, "proposed_for", why);
    for (size_t i = 0; done && i < result->design_count; ++i) {
        const sp_proposal *alternative = result->designs[i].alternative;
        if (!alternative)
            continue;
        json_t *entry = json_object(), *stages = json_array();
        done = put_text(entry, "name", figures[i].name) &&
               put_proposal(entry, alternative, figures[i].clean_area, true) &&
               put_stages(stages, alternative->stages, alternative->stage_count) &&
               put_cut_short(entry, alternative, NULL);
        done = put(entry, "stages", stages) && done;
        done = json_array_append_new(alternatives, entry) == 0 && done;
    }
    return put(root, "alternatives", alternatives) && done;
}

static bool fill(json_t *root, const sp_result *result, const sp_figures *figures)
{
    bool one_geometry = true, one_fidelity = true;
    for (size_t i = 1; i < result->design_count; ++i) {
        one_geometry = one_geometry && same_geometry(&figures[0], &figures[i]);
        one_fidelity = one_fidelity && same_fidelity(&figures[0], &figures[i]);
    }
    char *scene = sp_text_utf8(result->scene);
    bool done =
        scene && put_text(root, "sprayplan", SP_VERSION) && put_text(root, "command", result->command) &&
        put_text(root, "scene", scene) && put_inputs(root, result) &&
        (!one_geometry || result->design_count == 0 || put_geometry(root, figures, result->designs[0].evaluator)) &&
        (!one_fidelity || result->design_count == 0 ||
         put_fidelity(root, figures, result->design_count, result->designs[0].evaluator));
    free(scene);
    json_t *layouts = json_array(), *stages = json_array();
    for (size_t i = 0; done && i < result->design_count; ++i)
        done = put_layout(layouts, &figures[i], result->designs[i].evaluator, !one_geometry, !one_fidelity);
    done = put(root, "layouts", layouts) && done;
    bool alternatives = sp_result_has_alternatives(result);
    if (result->proposal)
        done =
            done && put_proposal(root, result->proposal, figures[sp_result_proposed(result)].clean_area, alternatives);
    done = done && (!alternatives || put_alternatives(root, result, figures));
    done = done && put_stages(stages, result->stages, result->stage_count) &&
           (!result->proposal || alternatives ||
            put_stages(stages, result->proposal->stages, result->proposal->stage_count));
    done = done && put_cut_short(root, alternatives ? NULL : result->proposal, result);
    return put(root, "stages", stages) && done;
}

char *sp_result_json(const sp_result *result, sp_error *error)
{
    sp_figures *figures = sp_result_figures(result, error);
    if (!figures)
        return NULL;
    json_t *root = json_object();
    char *dump = fill(root, result, figures) ? json_dumps(root, JSON_INDENT(1) | JSON_REAL_PRECISION(17)) : NULL;
    json_decref(root);
    sp_figures_destroy(figures, result->design_count);
    sp_text text = {0};
    if (dump)
        sp_text_add(&text, "%s\n", dump);
    else
        text.failed = true;
    free(dump);
    return sp_text_finish(&text, error);
}
