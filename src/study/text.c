/* The study as plain tables for a terminal. */
#include "words.h"

#include <sprayplan/result.h>

#include <math.h>
#include <stdlib.h>

/* Words of a row, padded. */
static void add_name(sp_text *text, sp_text *words, int width)
{
    char *name = sp_text_finish(words, NULL);
    if (name)
        sp_text_add(text, "%-*s", width, name);
    else
        text->failed = true;
    free(name);
}

static void add_runs(sp_text *text, const sp_study *study)
{
    enum { WIDTH = 64 };
    sp_text_add(text, "%-*s %10s %17s %11s %9s %10s %9s\n", WIDTH, "settings", "coverage %", "error, points",
                "misjudged %", "prepare s", "evaluate s", "memory MB");
    for (size_t i = 0; i < study->run_count; i++) {
        const sp_study_run *run = &study->runs[i];
        sp_text words = {0};
        if (run->chosen)
            sp_text_add(&words, "the scene's own: ");
        sp_words_run(&words, &run->fidelity, true, true);
        add_name(text, &words, WIDTH);
        sp_text_add(text, " %10.2f %+8.3f \xc2\xb1 %6.3f %11.2f %9.3g %10.3g %9.0f%s\n", 100 * run->coverage,
                    100 * run->error, 100 * run->spread, 100 * run->misjudged, run->speed.prepare, run->speed.evaluate,
                    1e-6 * (double)run->speed.memory, run->speed.front_misjudged ? " *" : "");
    }
    sp_text_add(text, "* nothing that misjudges as little is quicker\n");
    const char *notes[SP_STUDY_NOTES];
    size_t count = sp_words_notes(study, notes);
    for (size_t i = 0; i < count; i++)
        sp_text_add(text, "%s\n", notes[i]);
}

static void add_slope(sp_text *text, double slope, int width)
{
    if (isfinite(slope))
        sp_text_add(text, "%*.2f", width, slope);
    else
        sp_text_add(text, "%*s", width, "-");
}

static void add_orders(sp_text *text, const sp_study *study)
{
    enum { WIDTH = 64 };
    if (study->order_count)
        sp_text_add(text, "\n%-*s %8s %10s %11s\n", WIDTH, "orders of convergence", "along", "error", "misjudged");
    for (size_t i = 0; i < study->order_count; i++) {
        const sp_study_order *order = &study->orders[i];
        bool along_texel = !(order->fidelity.texel > 0);
        sp_text words = {0};
        sp_words_run(&words, &order->fidelity, !along_texel, along_texel);
        add_name(text, &words, WIDTH);
        sp_text_add(text, " %8s ", along_texel ? "texel" : "jets");
        add_slope(text, order->error, 10);
        sp_text_add(text, " ");
        add_slope(text, order->misjudged, 11);
        sp_text_add(text, "\n");
    }
}

static void add_water(sp_text *text, double flow)
{
    sp_text_add(text, " %11.*f", sp_water_decimals(6e4 * flow), 6e4 * flow);
}

/* A price, where mounts cost something, is what was minimised. */
static void add_places(sp_text *text, const sp_study *study)
{
    enum { WIDTH = 44 };
    bool costly = study->place_count > 0 && study->places->costly;
    if (study->place_count)
        sp_text_add(text, "\n%-*s %11s%s %10s %11s %9s %9s %9s\n", WIDTH, "placements", "water L/min",
                    costly ? " price L/min" : "", "coverage %", "confirmed %", "seconds", "CPU s", "cut short");
    for (size_t i = 0; i < study->place_count; i++) {
        const sp_study_place *place = &study->places[i];
        sp_text words = {0};
        sp_words_place(&words, place);
        add_name(text, &words, WIDTH);
        add_water(text, place->water);
        if (costly)
            add_water(text, place->outlay);
        sp_text_add(text, " %10.2f %11.2f %9.2f %9.2f %9s\n", 100 * place->coverage, 100 * place->confirmed,
                    place->seconds, place->cpu,
                    place->limited       ? "its limit"
                    : place->ended_early ? "yes"
                                         : "");
    }
}

char *sp_study_text(const sp_study *study, sp_error *error)
{
    if (!study)
        return NULL;
    sp_text text = {0};
    if (study->run_count) {
        add_runs(&text, study);
        add_orders(&text, study);
    }
    add_places(&text, study);
    return sp_text_finish(&text, error);
}
