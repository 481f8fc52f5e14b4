/* The runs and the placements as tables for spreadsheets (RFC 4180; no field needs quotes). */
#include "words.h"

#include <inttypes.h>

static void add_numbers(sp_text *text, const double *values, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        sp_text_append(text, ",", 1);
        sp_text_number(text, values[i]);
    }
}

char *sp_study_csv(const sp_study *study, sp_error *error)
{
    if (!study)
        return NULL;
    sp_text text = {0};
    sp_text_add(&text, "evaluator,trajectory,reflections,jets_per_nozzle,texel_m,chosen,texels,coverage,error,"
                       "two_standard_errors,misjudged,prepare_s,evaluate_s,prepare_cpu_s,evaluate_cpu_s,memory_bytes,"
                       "on_front,on_front_misjudged\n");
    for (size_t i = 0; i < study->run_count; i++) {
        const sp_study_run *run = &study->runs[i];
        const sp_study_speed *speed = &run->speed;
        const double found[] = {run->coverage, run->error, run->spread, run->misjudged},
                     seconds[] = {speed->prepare, speed->evaluate, speed->prepare_cpu, speed->evaluate_cpu};
        bool forward = run->fidelity.method == SP_METHOD_FORWARD;
        sp_text_add(&text, "%s,%s,%d,%" PRIu64 ",", sp_word_method(&run->fidelity), sp_word_trajectory(&run->fidelity),
                    run->fidelity.reflections, forward ? run->fidelity.jets : 0);
        sp_text_number(&text, run->fidelity.texel);
        sp_text_add(&text, ",%d,%zu", run->chosen, run->texels);
        add_numbers(&text, found, 4);
        add_numbers(&text, seconds, 4);
        sp_text_add(&text, ",%zu,%d,%d\n", speed->memory, speed->front, speed->front_misjudged);
    }
    return sp_text_finish(&text, error);
}

char *sp_study_place_csv(const sp_study *study, sp_error *error)
{
    if (!study)
        return NULL;
    sp_text text = {0};
    sp_text_add(&text, "trajectory,refined,shift,texel_m,limited,ended_early,reached,nozzles,water_l_min,price_l_min,"
                       "coverage,confirmed,two_standard_errors,seconds,cpu_s,limit_s,memory_bytes\n");
    for (size_t i = 0; i < study->place_count; i++) {
        const sp_study_place *place = &study->places[i];
        const double values[] = {6e4 * place->water,      6e4 * place->outlay, place->coverage, place->confirmed,
                                 place->confirmed_spread, place->seconds,      place->cpu,      place->limit};
        sp_text_add(&text, "%s,%d,%d,", sp_word_trajectory(&place->fidelity), place->refine, place->shift);
        sp_text_number(&text, place->fidelity.texel);
        sp_text_add(&text, ",%d,%d,%d,%zu", place->limited, place->ended_early, place->reached, place->nozzles);
        add_numbers(&text, values, sizeof values / sizeof *values);
        sp_text_add(&text, ",%zu\n", place->memory);
    }
    return sp_text_finish(&text, error);
}
