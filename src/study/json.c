/* study.json. */
#include "words.h"

#include <sprayplan/sprayplan.h>

#include <jansson.h>
#include <math.h>
#include <stdlib.h>

/* Takes `value`; an object that could not be made is a failure, and so is one that finds no room. */
static bool put(json_t *object, const char *key, json_t *value)
{
    return json_object_set_new(object, key, value) == 0;
}

static bool put_real(json_t *object, const char *key, double value)
{
    return !isfinite(value) || put(object, key, json_real(value));
}

static bool put_count(json_t *object, const char *key, uint64_t value)
{
    return put(object, key, json_integer((json_int_t)value));
}

static bool put_flag(json_t *object, const char *key, bool value)
{
    return put(object, key, json_boolean(value));
}

/* A texel or a number of jets of 0 is what varies, or there is none. */
static bool put_fidelity(json_t *object, const sp_fidelity *fidelity)
{
    bool forward = fidelity->method == SP_METHOD_FORWARD;
    return put(object, "evaluator", json_string(sp_word_method(fidelity))) &&
           put(object, "trajectory", json_string(sp_word_trajectory(fidelity))) &&
           put_count(object, "reflections", (uint64_t)fidelity->reflections) &&
           (!forward || fidelity->jets == 0 || put_count(object, "jets_per_nozzle", fidelity->jets)) &&
           (!(fidelity->texel > 0) || put_real(object, "texel_m", fidelity->texel));
}

static json_t *reference_object(const sp_study *study)
{
    json_t *object = json_object();
    const sp_fidelity *reference = &study->reference;
    bool points = !(reference->texel > 0);
    bool good = put(object, "judged_by", json_string(points ? "points" : "jets")) &&
                (points ? put(object, "trajectory", json_string(sp_word_trajectory(reference)))
                        : put_fidelity(object, reference)) &&
                put_count(object, "points", study->points) && put_real(object, "coverage", study->reference_coverage) &&
                put_real(object, "two_standard_errors", study->reference_spread) &&
                put_real(object, "error_without_reflections", study->reference_check) &&
                (!(study->reference_film_cell > 0) || put_real(object, "film_texel_m", study->reference_film_cell));
    if (good)
        return object;
    json_decref(object);
    return NULL;
}

static json_t *speed_object(const sp_study_speed *speed)
{
    json_t *object =
        json_pack("{s:f, s:f, s:f, s:f, s:b, s:b}", "prepare_s", speed->prepare, "evaluate_s", speed->evaluate,
                  "prepare_cpu_s", speed->prepare_cpu, "evaluate_cpu_s", speed->evaluate_cpu, "on_front", speed->front,
                  "on_front_misjudged", speed->front_misjudged);
    if (speed->memory > 0)
        json_object_set_new(object, "memory_bytes", json_integer((json_int_t)speed->memory));
    return object;
}

static bool add_run(json_t *runs, const sp_study_run *run)
{
    json_t *object = json_object();
    bool good = put_fidelity(object, &run->fidelity) && put_flag(object, "chosen", run->chosen) &&
                put_count(object, "texels", run->texels) && put_real(object, "coverage", run->coverage) &&
                put_real(object, "error", run->error) && put_real(object, "two_standard_errors", run->spread) &&
                put_real(object, "misjudged", run->misjudged) && put(object, "speed", speed_object(&run->speed));
    return json_array_append_new(runs, object) == 0 && good;
}

static bool add_order(json_t *orders, const sp_study_order *order)
{
    json_t *object = json_object();
    bool along_texel = !(order->fidelity.texel > 0);
    bool good = put(object, "along", json_string(along_texel ? "texel" : "jets")) &&
                put_fidelity(object, &order->fidelity) && put_count(object, "runs", order->count) &&
                put_real(object, "error", order->error) && put_real(object, "misjudged", order->misjudged);
    return json_array_append_new(orders, object) == 0 && good;
}

static json_t *place_speed(const sp_study_place *place)
{
    json_t *object = json_pack("{s:f, s:f}", "seconds", place->seconds, "cpu_s", place->cpu);
    if (isfinite(place->limit))
        json_object_set_new(object, "limit_s", json_real(place->limit));
    if (place->memory > 0)
        json_object_set_new(object, "memory_bytes", json_integer((json_int_t)place->memory));
    return object;
}

static bool add_place(json_t *places, const sp_study_place *place)
{
    json_t *object = json_object();
    bool good = put(object, "trajectory", json_string(sp_word_trajectory(&place->fidelity))) &&
                put_real(object, "texel_m", place->fidelity.texel) && put_flag(object, "refined", place->refine) &&
                put(object, "shift", json_integer(place->shift)) &&
                put_flag(object, "ended_early", place->ended_early) && put_flag(object, "reached", place->reached) &&
                put_count(object, "nozzles", place->nozzles) && put_real(object, "water_l_min", 6e4 * place->water) &&
                (!place->costly || put_real(object, "price_l_min", 6e4 * place->outlay)) &&
                put_real(object, "coverage", place->coverage) && put_real(object, "confirmed", place->confirmed) &&
                put_real(object, "two_standard_errors", place->confirmed_spread) &&
                put(object, "speed", place_speed(place));
    return json_array_append_new(places, object) == 0 && good;
}

static bool put_places(json_t *object, const char *key, const sp_study *study, bool limited)
{
    json_t *places = json_array();
    bool good = true;
    for (size_t i = 0; i < study->place_count; i++)
        if (study->places[i].limited == limited)
            good = add_place(places, &study->places[i]) && good;
    return put(object, key, places) && good;
}

static json_t *notes_array(const sp_study *study)
{
    json_t *array = json_array();
    const char *notes[SP_STUDY_NOTES];
    size_t count = sp_words_notes(study, notes);
    bool good = true;
    for (size_t i = 0; i < count; i++)
        good = json_array_append_new(array, json_string(notes[i])) == 0 && good;
    if (good)
        return array;
    json_decref(array);
    return NULL;
}

static bool put_grid(json_t *object, const sp_study *study)
{
    json_t *runs = json_array(), *orders = json_array();
    bool good = true;
    for (size_t i = 0; i < study->run_count; i++)
        good = add_run(runs, &study->runs[i]) && good;
    for (size_t i = 0; i < study->order_count; i++)
        good = add_order(orders, &study->orders[i]) && good;
    good = put(object, "runs", runs) && good;
    good = put(object, "orders", orders) && good;
    return good && put(object, "reference", reference_object(study)) && put(object, "notes", notes_array(study));
}

char *sp_study_json(const sp_study *study, const char *scene, sp_error *error)
{
    if (!study || !scene)
        return NULL;
    json_t *object = json_object();
    char *name = sp_text_utf8(scene);
    bool good = name && put(object, "sprayplan", json_string(SP_VERSION)) &&
                put(object, "command", json_string("study")) && put(object, "scene", json_string(name)) &&
                put_real(object, "clean_area_m2", study->area) && put_flag(object, "interrupted", study->interrupted) &&
                (study->run_count == 0 || put_grid(object, study)) &&
                (study->place_count == 0 ||
                 (put_places(object, "place", study, false) && put_places(object, "place_limited", study, true)));
    char *dumped = good ? json_dumps(object, JSON_INDENT(1)) : NULL;
    json_decref(object);
    free(name);
    sp_text text = {0};
    if (!dumped)
        return sp_fail_memory(error);
    sp_text_add(&text, "%s\n", dumped);
    free(dumped);
    return sp_text_finish(&text, error);
}
