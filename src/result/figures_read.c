/* Figures back from a result.json, which may come from a stranger. */
#include "figures.h"
#include "json_read.h"
#include "mesh/file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#define LARGEST 1e100 /* in any unit: beyond it products of figures overflow, whatever the size of the machine */

#define LARGEST_FILE (256L << 20) /* bytes */
#define MEMORY 67108864.0         /* bytes, beyond ten times the file */
#define MOST_LAYOUTS 1000

static bool read_missing(const sp_json_reader *in, const json_t *geometry, sp_figures *figures)
{
    const json_t *missing;
    if (!sp_json_part(in, geometry, "unattainable_m2", JSON_OBJECT, false, &missing))
        return false;
    sp_json_reader inner = *in;
    snprintf(inner.place + strlen(inner.place), sizeof inner.place - strlen(inner.place), "unattainable_m2.");
    for (sp_reason reason = 0; reason < SP_REASONS; reason++) {
        const char *key = sp_reason_key(reason);
        figures->missing_area[reason] = NAN;
        if (key && !sp_json_real(&inner, missing, key, 0, LARGEST, 1, &figures->missing_area[reason]))
            return false;
    }
    return true;
}

static bool read_missing_part(const sp_json_reader *in, const json_t *entry, sp_missing_figures *missing)
{
    if (!sp_json_text(in, entry, "part", &missing->part) ||
        !sp_json_real(in, entry, "area_m2", 0, LARGEST, 1, &missing->area))
        return false;
    for (sp_reason reason = 0; reason < SP_REASONS; reason++) {
        const char *key = sp_reason_key(reason);
        if (key && !sp_json_real(in, entry, key, 0, LARGEST, 1, &missing->areas[reason]))
            return false;
    }
    return true;
}

static bool read_missing_parts(const sp_json_reader *in, const json_t *geometry, sp_figures *figures)
{
    const json_t *parts;
    if (!sp_json_part(in, geometry, "unattainable_by_part", JSON_ARRAY, false, &parts))
        return false;
    if (!sp_figures_make_missing(figures, json_array_size(parts)))
        return sp_fail_memory(in->error);
    sp_json_reader inner;
    for (size_t i = 0; i < figures->missing_count; ++i)
        if (!sp_json_enter(in, "unattainable_by_part", i, json_array_get(parts, i), &inner) ||
            !read_missing_part(&inner, json_array_get(parts, i), &figures->missing[i]))
            return false;
    return true;
}

static bool read_geometry(const sp_json_reader *in, const json_t *geometry, sp_figures *figures)
{
    return sp_json_count(in, geometry, "triangles", &figures->triangles) &&
           sp_json_real(in, geometry, "area_m2", 0, LARGEST, 1, &figures->area) &&
           sp_json_real(in, geometry, "clean_area_m2", 0, LARGEST, 1, &figures->clean_area) &&
           sp_json_real(in, geometry, "attainable_area_m2", 0, LARGEST, 1, &figures->attainable_area) &&
           read_missing(in, geometry, figures) && read_missing_parts(in, geometry, figures);
}

static bool read_fidelity(const sp_json_reader *in, const json_t *fidelity, sp_figures *figures)
{
    static const char *const trajectories[3] = {"line", "parabola", "drag"}, *const evaluators[3] = {"forward",
                                                                                                     "inverse"};
    return sp_json_choice(in, fidelity, "trajectory", trajectories, figures->trajectory) &&
           sp_json_choice(in, fidelity, "evaluator", evaluators, figures->evaluator) &&
           sp_json_count(in, fidelity, "reflections", &figures->reflections) &&
           sp_json_count(in, fidelity, "jets_per_nozzle", &figures->jets) &&
           sp_json_count(in, fidelity, "jets_wanted_per_nozzle", &figures->jets_wanted) &&
           sp_json_real(in, fidelity, "texel_m", 0, LARGEST, 1, &figures->texel) &&
           sp_json_real(in, fidelity, "error_estimate", 0, 1, 1, &figures->error_estimate) &&
           sp_json_real(in, fidelity, "misjudged", 0, 1, 1, &figures->misjudged) &&
           sp_json_real(in, fidelity, "error_bound", 0, 1, 1, &figures->error_bound);
}

/* The layout's own errors; where it tells none, what its fidelity says stays. */
static bool read_errors(const sp_json_reader *in, const json_t *layout, sp_figures *figures)
{
    double estimate, misjudged, bound;
    if (!sp_json_real(in, layout, "error_estimate", 0, 1, 1, &estimate) ||
        !sp_json_real(in, layout, "misjudged", 0, 1, 1, &misjudged) ||
        !sp_json_real(in, layout, "error_bound", 0, 1, 1, &bound))
        return false;
    figures->error_estimate = isnan(estimate) ? figures->error_estimate : estimate;
    figures->misjudged = isnan(misjudged) ? figures->misjudged : misjudged;
    figures->error_bound = isnan(bound) ? figures->error_bound : bound;
    return true;
}

static bool read_coverage(const sp_json_reader *in, const json_t *layout, sp_figures *figures)
{
    const double l_min = 1 / 6e4;
    const json_t *flux;
    if (!sp_json_real(in, layout, "water_l_min", 0, LARGEST, l_min, &figures->flow) ||
        !sp_json_real(in, layout, "covered_area_m2", 0, LARGEST, 1, &figures->covered_area) ||
        !sp_json_real(in, layout, "coverage", 0, 1 + 1e-9, 1, &figures->coverage) ||
        !sp_json_real(in, layout, "borderline_m2", 0, LARGEST, 1, &figures->borderline) ||
        !sp_json_real(in, layout, "coverage_of_attainable", 0, 1 + 1e-9, 1, &figures->of_attainable) ||
        !sp_json_real(in, layout, "area_per_water", 0, LARGEST, 6e4, &figures->area_per_water) ||
        !sp_json_real(in, layout, "pass_s", 0, LARGEST, 1, &figures->pass) ||
        !sp_json_part(in, layout, "flux_l_min_m2", JSON_OBJECT, false, &flux))
        return false;
    if (isnan(figures->flow))
        return sp_json_wrong(in, "water_l_min", NULL, "a number");
    if (isnan(figures->coverage))
        return sp_json_wrong(in, "coverage", NULL, "a number from 0 to 1");
    sp_json_reader inner = *in;
    snprintf(inner.place + strlen(inner.place), sizeof inner.place - strlen(inner.place), "flux_l_min_m2.");
    return sp_json_real(&inner, flux, "min", 0, LARGEST, l_min, &figures->flux_min) &&
           sp_json_real(&inner, flux, "mean", 0, LARGEST, l_min, &figures->flux_mean) &&
           sp_json_real(&inner, flux, "p05", 0, LARGEST, l_min, &figures->flux_p05) &&
           sp_json_real(&inner, flux, "max", 0, LARGEST, l_min, &figures->flux_max);
}

static bool read_liquid(const sp_json_reader *in, const json_t *layout, sp_figures *figures)
{
    const double l_min = 1 / 6e4;
    const json_t *liquid;
    if (!sp_json_part(in, layout, "liquid_l_min", JSON_OBJECT, false, &liquid))
        return false;
    sp_json_reader inner = *in;
    snprintf(inner.place + strlen(inner.place), sizeof inner.place - strlen(inner.place), "liquid_l_min.");
    return sp_json_real(&inner, liquid, "on_clean_surface", 0, LARGEST, l_min, &figures->landed_clean) &&
           sp_json_real(&inner, liquid, "on_other_surface", 0, LARGEST, l_min, &figures->landed_other) &&
           sp_json_real(&inner, liquid, "left", 0, LARGEST, l_min, &figures->left) &&
           sp_json_real(&inner, liquid, "not_followed", 0, LARGEST, l_min, &figures->unfollowed);
}

/* `layout` knows its pass. */
static bool read_criterion(const sp_json_reader *in, const json_t *object, sp_figures *figures)
{
    static const char *const ways[3] = {"sum", "single"};
    const json_t *found;
    double flux, dose, speed, incidence, film;
    char combine[16];
    if (!sp_json_part(in, object, "criterion", JSON_OBJECT, false, &found))
        return false;
    sp_json_reader inner = *in;
    snprintf(inner.place + strlen(inner.place), sizeof inner.place - strlen(inner.place), "criterion.");
    if (!sp_json_real(&inner, found, "flux_l_min_m2", 0, LARGEST, 1 / 6e4, &flux) ||
        !sp_json_real(&inner, found, "dose_l_m2", 0, LARGEST, 1e-3, &dose) ||
        !sp_json_real(&inner, found, "impact_speed_m_s", 0, LARGEST, 1, &speed) ||
        !sp_json_real(&inner, found, "incidence_rad", 0, M_PI / 2, 1, &incidence) ||
        !sp_json_choice(&inner, found, "combine", ways, combine) ||
        !sp_json_real(&inner, found, "film_l_min_m", 0, LARGEST, 1 / 6e4, &film))
        return false;
    if (isfinite(dose) && !(figures->pass > 0))
        return sp_json_wrong(&inner, "dose_l_m2", json_object_get(found, "dose_l_m2"),
                             "it of a layout with pass_s alone");
    figures->criterion_known = found;
    figures->criterion =
        (sp_criterion){.flux = isfinite(dose) ? dose / figures->pass : fmax(flux, 0),
                       .impact_speed = fmax(speed, 0),
                       .incidence = fmin(incidence, M_PI / 2),
                       .combine = combine[0] == 's' && combine[1] == 'i' ? SP_COMBINE_SINGLE : SP_COMBINE_SUM,
                       .film = fmax(film, 0)};
    return true;
}

/* What a total in money says of water. */
static bool read_money(const sp_json_reader *in, const json_t *price, double total, sp_water_cost *cost)
{
    double money;
    const json_t *currency = json_object_get(price, "currency");
    const char *letters = currency && json_is_string(currency) ? json_string_value(currency) : "";
    if (!sp_json_real(in, price, "money", 0, LARGEST, 1, &money))
        return false;
    if (isnan(money))
        return true;
    if (strlen(letters) != 3 || strspn(letters, "ABCDEFGHIJKLMNOPQRSTUVWXYZ") != 3)
        return sp_json_wrong(in, "currency", currency, "three capital letters");
    *cost = (sp_water_cost){.money = total > 0 ? money / total : 0};
    strcpy(cost->currency, letters);
    return true;
}

static bool read_price(const sp_json_reader *in, const json_t *layout, sp_figures *figures)
{
    const json_t *price;
    figures->mount_cost = NAN;
    if (!sp_json_part(in, layout, "price", JSON_OBJECT, false, &price))
        return false;
    if (!price)
        return true;
    sp_json_reader inner = *in;
    snprintf(inner.place + strlen(inner.place), sizeof inner.place - strlen(inner.place), "price.");
    return sp_json_real(&inner, price, "mounts_l_min", 0, LARGEST, 1 / 6e4, &figures->mount_cost) &&
           read_money(&inner, price, sp_figures_price(figures), &figures->water_cost);
}

static bool read_film(const sp_json_reader *in, const json_t *layout, sp_film_balance *balance)
{
    const double l_min = 1 / 6e4;
    const json_t *film;
    if (!sp_json_part(in, layout, "film", JSON_OBJECT, false, &film))
        return false;
    if (!film)
        return true;
    sp_json_reader inner = *in;
    snprintf(inner.place + strlen(inner.place), sizeof inner.place - strlen(inner.place), "film.");
    balance->known = true;
    return sp_json_real(&inner, film, "covered_area_m2", 0, LARGEST, 1, &balance->area) &&
           sp_json_real(&inner, film, "arriving_l_min", 0, LARGEST, l_min, &balance->arriving) &&
           sp_json_real(&inner, film, "left_l_min", 0, LARGEST, l_min, &balance->left) &&
           sp_json_real(&inner, film, "astray_l_min", 0, LARGEST, l_min, &balance->astray) &&
           sp_json_real(&inner, film, "held_l_min", 0, LARGEST, l_min, &balance->held) &&
           sp_json_real(&inner, film, "per_girth_l_min_m", 0, LARGEST, l_min, &balance->per_girth);
}

static bool read_reason(const sp_json_reader *in, const json_t *entry, sp_reason *reason)
{
    const json_t *found = json_object_get(entry, "reason");
    *reason = SP_REASON_UNKNOWN;
    if (!found)
        return true;
    for (sp_reason i = 0; json_is_string(found) && i < SP_REASONS; i++)
        if (sp_reason_key(i) && !strcmp(json_string_value(found), sp_reason_key(i))) {
            *reason = i;
            return true;
        }
    return sp_json_wrong(in, "reason", found,
                         "no_line_of_reach, reflection_only, too_slow, too_slanted or too_little_flux");
}

static bool read_lack(const sp_json_reader *in, const json_t *entry, sp_lack *lack)
{
    const json_t *found = json_object_get(entry, "lack");
    *lack = SP_LACK_NOTHING;
    if (!found)
        return true;
    for (sp_lack i = 0; json_is_string(found) && i < SP_LACKS; i++)
        if (sp_lack_key(i) && !strcmp(json_string_value(found), sp_lack_key(i))) {
            *lack = i;
            return true;
        }
    return sp_json_wrong(in, "lack", found, "no_nozzle_in_reach, too_slow, too_slanted or too_little_flux");
}

static bool read_remedy(const sp_json_reader *in, const json_t *entry, sp_remedy_figures *remedy)
{
    const json_t *found;
    sp_json_reader inner = *in;
    if (!sp_json_part(in, entry, "remedy", JSON_OBJECT, false, &found))
        return false;
    remedy->known = found;
    snprintf(inner.place + strlen(inner.place), sizeof inner.place - strlen(inner.place), "remedy.");
    return sp_json_text(&inner, found, "type", &remedy->type) && sp_json_text(&inner, found, "port", &remedy->port) &&
           sp_json_vector(&inner, found, "position_m", &remedy->position) &&
           sp_json_real(&inner, found, "covers_m2", 0, LARGEST, 1, &remedy->area) &&
           sp_json_real(&inner, found, "water_l_min", 0, LARGEST, 1 / 6e4, &remedy->flow);
}

static bool read_shadow(const sp_json_reader *in, const json_t *entry, sp_shadow_figures *shadow)
{
    const json_t *reachable = json_object_get(entry, "reachable");
    if (reachable && !json_is_boolean(reachable))
        return sp_json_wrong(in, "reachable", reachable, "true or false");
    shadow->reachable = reachable ? json_is_true(reachable) : -1;
    return read_reason(in, entry, &shadow->reason) && read_lack(in, entry, &shadow->lack) &&
           sp_json_text(in, entry, "nozzle", &shadow->nozzle) &&
           sp_json_real(in, entry, "area_m2", 0, LARGEST, 1, &shadow->area) &&
           sp_json_vector(in, entry, "centroid_m", &shadow->centroid) &&
           sp_json_text(in, entry, "part", &shadow->part) && read_remedy(in, entry, &shadow->remedy);
}

/* A page will link it. */
static bool get_url(const sp_json_reader *in, const json_t *object, const char *key, char **value)
{
    return sp_json_text(in, object, key, value) &&
           (!(*value)[0] || sp_is_url(*value) ||
            sp_json_wrong(in, key, json_object_get(object, key), "an http or https address"));
}

static bool read_tracks(const sp_json_reader *in, const json_t *entry, sp_track_gaps *gaps)
{
    const json_t *tracks;
    if (!sp_json_part(in, entry, "tracks", JSON_OBJECT, false, &tracks))
        return false;
    if (!tracks)
        return true;
    sp_json_reader inner = *in;
    snprintf(inner.place + strlen(inner.place), sizeof inner.place - strlen(inner.place), "tracks.");
    gaps->known = true;
    return sp_json_count(&inner, tracks, "turns", &gaps->turns) &&
           sp_json_real(&inner, tracks, "seconds", 0, LARGEST, 1, &gaps->duration) &&
           sp_json_real(&inner, tracks, "reached_m2", 0, LARGEST, 1, &gaps->area) &&
           sp_json_real(&inner, tracks, "mean_gap_m", 0, LARGEST, 1, &gaps->mean) &&
           sp_json_real(&inner, tracks, "p95_gap_m", 0, LARGEST, 1, &gaps->p95) &&
           sp_json_real(&inner, tracks, "greatest_gap_m", 0, LARGEST, 1, &gaps->greatest);
}

static bool read_nozzle(const sp_json_reader *in, const json_t *entry, sp_nozzle_figures *nozzle)
{
    return sp_json_text(in, entry, "name", &nozzle->name) && sp_json_text(in, entry, "type", &nozzle->type) &&
           sp_json_text(in, entry, "order_code", &nozzle->order_code) && get_url(in, entry, "url", &nozzle->url) &&
           sp_json_text(in, entry, "overlap", &nozzle->overlap) &&
           sp_json_vector(in, entry, "position_m", &nozzle->position) &&
           sp_json_vector(in, entry, "axis", &nozzle->axis) &&
           sp_json_real(in, entry, "roll_rad", -1e6, 1e6, 1, &nozzle->roll) &&
           sp_json_real(in, entry, "angle_rad", 0, 7, 1, &nozzle->angle) &&
           sp_json_real(in, entry, "pressure_pa", 0, LARGEST, 1, &nozzle->pressure) &&
           sp_json_real(in, entry, "flow_l_min", 0, LARGEST, 1 / 6e4, &nozzle->flow) &&
           sp_json_real(in, entry, "speed_m_s", 0, LARGEST, 1, &nozzle->speed) &&
           sp_json_real(in, entry, "alone_m2", 0, LARGEST, 1, &nozzle->alone) &&
           sp_json_real(in, entry, "lost_without_m2", -LARGEST, LARGEST, 1, &nozzle->lost) &&
           sp_json_flag(in, entry, "new_fitting", &nozzle->fitting) &&
           sp_json_real(in, entry, "cost_l_min", 0, LARGEST, 1 / 6e4, &nozzle->cost) &&
           read_tracks(in, entry, &nozzle->tracks);
}

static bool read_part(const sp_json_reader *in, const json_t *entry, sp_part_figures *part)
{
    return sp_json_text(in, entry, "part", &part->part) &&
           sp_json_real(in, entry, "area_m2", 0, LARGEST, 1, &part->area) &&
           sp_json_real(in, entry, "covered_area_m2", 0, LARGEST, 1, &part->covered);
}

static bool read_parts(const sp_json_reader *in, const json_t *layout, sp_figures *figures)
{
    const json_t *parts;
    if (!sp_json_part(in, layout, "parts", JSON_ARRAY, false, &parts))
        return false;
    if (!sp_figures_make_parts(figures, json_array_size(parts)))
        return sp_fail_memory(in->error);
    sp_json_reader inner;
    for (size_t i = 0; i < figures->part_count; ++i)
        if (!sp_json_enter(in, "parts", i, json_array_get(parts, i), &inner) ||
            !read_part(&inner, json_array_get(parts, i), &figures->parts[i]))
            return false;
    return true;
}

static bool read_rows(const sp_json_reader *in, const json_t *layout, sp_figures *figures)
{
    const json_t *shadows, *nozzles;
    if (!read_parts(in, layout, figures) || !sp_json_part(in, layout, "shadows", JSON_ARRAY, false, &shadows) ||
        !sp_json_part(in, layout, "nozzles", JSON_ARRAY, true, &nozzles))
        return false;
    figures->shadows_known = shadows;
    size_t shadow_count = json_array_size(shadows), nozzle_count = json_array_size(nozzles);
    shadow_count = shadow_count < SP_SHADOWS_KEPT ? shadow_count : SP_SHADOWS_KEPT;
    if (!sp_figures_make_rows(figures, shadow_count, nozzle_count))
        return sp_fail_memory(in->error);
    sp_json_reader inner;
    for (size_t i = 0; i < shadow_count; ++i)
        if (!sp_json_enter(in, "shadows", i, json_array_get(shadows, i), &inner) ||
            !read_shadow(&inner, json_array_get(shadows, i), &figures->shadows[i]))
            return false;
    for (size_t i = 0; i < nozzle_count; ++i)
        if (!sp_json_enter(in, "nozzles", i, json_array_get(nozzles, i), &inner) ||
            !read_nozzle(&inner, json_array_get(nozzles, i), &figures->nozzles[i]))
            return false;
    return true;
}

static bool read_layout(const sp_json_reader *in, const json_t *root, const json_t *layout, sp_figures *figures)
{
    const sp_json_reader top = {in->file, in->error, ""};
    const json_t *geometry, *fidelity;
    bool own_geometry = json_object_get(layout, "geometry"), own_fidelity = json_object_get(layout, "fidelity");
    sp_json_reader inner = own_geometry ? *in : top;
    if (!sp_json_part(&inner, own_geometry ? layout : root, "geometry", JSON_OBJECT, false, &geometry))
        return false;
    size_t used = strlen(inner.place);
    snprintf(inner.place + used, sizeof inner.place - used, "geometry.");
    if (!read_geometry(&inner, geometry, figures))
        return false;
    inner = own_fidelity ? *in : top;
    if (!sp_json_part(&inner, own_fidelity ? layout : root, "fidelity", JSON_OBJECT, false, &fidelity))
        return false;
    used = strlen(inner.place);
    snprintf(inner.place + used, sizeof inner.place - used, "fidelity.");
    if (!read_fidelity(&inner, fidelity, figures) || !sp_json_text(in, layout, "name", &figures->name))
        return false;
    if (!figures->name[0])
        return sp_json_wrong(in, "name", json_object_get(layout, "name"), "a text that is not empty");
    bool own_criterion = json_object_get(layout, "criterion");
    return read_errors(in, layout, figures) && read_coverage(in, layout, figures) &&
           read_criterion(own_criterion ? in : &top, own_criterion ? layout : root, figures) &&
           read_liquid(in, layout, figures) && read_film(in, layout, &figures->film) &&
           sp_json_count(in, layout, "new_fittings", &figures->fittings) && read_price(in, layout, figures) &&
           read_rows(in, layout, figures);
}

/* At most so much is made of the text, in bytes: two copies of it, and what jansson and sp_figures need for the least
 * that can stand for an object, a list, and an entry of either. */
static double memory_of(const char *text, size_t size)
{
    double memory = 3 * (double)size;
    for (const char *at = text; at < text + size; at++)
        memory += *at == '{' ? 600 : *at == ':' ? 216 : *at == '[' ? 130 : *at == ',' ? 104 : 0;
    return memory;
}

static json_t *parse(const char *path, const char *text, size_t size, sp_error *error)
{
    json_error_t cause;
    if (memory_of(text, size) > 10 * (double)size + MEMORY) {
        sp_fail(error, SP_ERROR_INPUT, path, 0, 0, "found far more lists and objects than text, expected a result");
        return NULL;
    }
    json_t *root = json_loadb(text, size, JSON_REJECT_DUPLICATES, &cause);
    if (!root)
        sp_fail(error, SP_ERROR_INPUT, path, cause.line, cause.column, "no valid JSON: %s", cause.text);
    return root;
}

static sp_figures *read_all(const sp_json_reader *in, const json_t *root, size_t *count)
{
    const json_t *layouts;
    if (!json_is_object(root))
        return sp_json_wrong(in, "top", root, "an object"), NULL;
    if (!json_is_string(json_object_get(root, "sprayplan")))
        return sp_json_wrong(in, "sprayplan", json_object_get(root, "sprayplan"), "a text: the version that wrote it"),
               NULL;
    if (!sp_json_part(in, root, "layouts", JSON_ARRAY, true, &layouts))
        return NULL;
    size_t found = json_array_size(layouts);
    if (found < 1 || found > MOST_LAYOUTS) {
        sp_fail(in->error, SP_ERROR_INPUT, in->file, 0, 0, "layouts: found %zu entries, expected 1 to %d", found,
                MOST_LAYOUTS);
        return NULL;
    }
    sp_figures *figures = calloc(found, sizeof *figures);
    if (!figures)
        return sp_fail_memory(in->error);
    sp_json_reader inner;
    for (size_t i = 0; i < found; ++i)
        if (!sp_json_enter(in, "layouts", i, json_array_get(layouts, i), &inner) ||
            !read_layout(&inner, root, json_array_get(layouts, i), &figures[i])) {
            sp_figures_destroy(figures, found);
            return NULL;
        }
    *count = found;
    return figures;
}

sp_figures *sp_figures_parse(const char *path, const char *text, size_t size, size_t *count, sp_error *error)
{
    *count = 0;
    json_t *root = parse(path, text, size, error);
    if (!root)
        return NULL;
    const sp_json_reader in = {path, error, ""};
    sp_figures *figures = read_all(&in, root, count);
    json_decref(root);
    return figures;
}

sp_figures *sp_figures_read(const char *path, size_t *count, sp_error *error)
{
    struct stat status;
    size_t size;
    *count = 0;
    if (!path)
        return NULL;
    if (stat(path, &status) == 0 && (!S_ISREG(status.st_mode) || status.st_size > LARGEST_FILE)) {
        sp_fail(error, SP_ERROR_INPUT, path, 0, 0, "cannot be read, expected a file of at most %ld MiB",
                LARGEST_FILE >> 20);
        return NULL;
    }
    char *text = sp_read_file(path, &size, error);
    sp_figures *figures = text ? sp_figures_parse(path, text, size, count, error) : NULL;
    free(text);
    return figures;
}
