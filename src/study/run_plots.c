/* What the runs' errors depend on, as plots. */
#include "page.h"
#include "plot.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#define MOST_SERIES 40
static const char *const colours[] = {"#0b6670", "#b5542e", "#3b5b92", "#8a6d1d", "#7a4b8f", "#c42636", "#6b7a87"};
enum { COLOURS = sizeof colours / sizeof *colours };

/* A plot while it is filled. Memory that runs out leaves series empty, and the text failed. */
typedef struct {
    sp_plot_series series[MOST_SERIES];
    size_t count;
    bool failed;
} drawing;

typedef bool belongs(const sp_study_run *run, const sp_fidelity *kind);
typedef sp_plot_point place(const sp_study_run *run);

static sp_plot_series *add_series(drawing *d, const sp_study *study, const sp_fidelity *kind, belongs *in, place *at)
{
    if (d->count == MOST_SERIES)
        return NULL;
    sp_plot_series *series = &d->series[d->count];
    *series = (sp_plot_series){.points = malloc((study->run_count + 1) * sizeof *series->points)};
    d->failed = d->failed || !series->points;
    if (!series->points)
        return NULL;
    for (size_t i = 0; i < study->run_count; i++)
        if (in(&study->runs[i], kind))
            series->points[series->count++] = at(&study->runs[i]);
    if (series->count == 0) {
        free(series->points);
        return NULL;
    }
    series->colour = colours[d->count % COLOURS];
    series->shape = (int)(d->count % 4);
    d->count++;
    return series;
}

static void name_series(sp_plot_series *series, const sp_fidelity *kind, bool texel, bool jets)
{
    sp_text words = {0};
    sp_words_run(&words, kind, texel, jets);
    char *name = sp_text_finish(&words, NULL);
    snprintf(series->name, sizeof series->name, "%s", name ? name : "");
    free(name);
}

static void finish(sp_text *text, drawing *d, sp_plot plot)
{
    plot.count = d->count;
    plot.series = d->series;
    if (d->failed)
        text->failed = true;
    else
        sp_plot_draw(text, &plot);
    for (size_t i = 0; i < d->count; i++)
        free(d->series[i].points);
}

static bool same_physics(const sp_study_run *run, const sp_fidelity *kind)
{
    return !run->chosen && run->fidelity.trajectory == kind->trajectory && run->fidelity.method == kind->method &&
           run->fidelity.reflections == kind->reflections;
}
static bool same_but_texel(const sp_study_run *run, const sp_fidelity *kind)
{
    return same_physics(run, kind) && (kind->method == SP_METHOD_INVERSE || run->fidelity.jets == kind->jets);
}
static bool same_but_jets(const sp_study_run *run, const sp_fidelity *kind)
{
    return same_physics(run, kind) && run->fidelity.texel == kind->texel;
}
static bool is_chosen(const sp_study_run *run, const sp_fidelity *kind)
{
    (void)kind;
    return run->chosen;
}

/* True where no earlier run of the grid is of the same kind. */
static bool begins(const sp_study *study, size_t i, belongs *in)
{
    if (study->runs[i].chosen)
        return false;
    for (size_t k = 0; k < i; k++)
        if (in(&study->runs[k], &study->runs[i].fidelity))
            return false;
    return true;
}

static sp_plot_point point(double x, double y)
{
    return (sp_plot_point){x, y, NAN, NAN};
}
static sp_plot_point error_by_seconds(const sp_study_run *run)
{
    return point(run->speed.evaluate, 100 * (fabs(run->error) + run->spread));
}
static sp_plot_point misjudged_by_seconds(const sp_study_run *run)
{
    return point(run->speed.evaluate, 100 * run->misjudged);
}
static sp_plot_point misjudged_by_texel(const sp_study_run *run)
{
    return point(1e3 * run->fidelity.texel, 100 * run->misjudged);
}
static sp_plot_point misjudged_by_jets(const sp_study_run *run)
{
    return point((double)run->fidelity.jets, 100 * run->misjudged);
}

static bool on_front(const sp_study_run *run, const sp_fidelity *kind)
{
    (void)kind;
    return run->speed.front;
}
static bool on_front_misjudged(const sp_study_run *run, const sp_fidelity *kind)
{
    (void)kind;
    return run->speed.front_misjudged;
}

static int from_the_left(const void *left, const void *right)
{
    double a = ((const sp_plot_point *)left)->x, b = ((const sp_plot_point *)right)->x;
    return (a > b) - (a < b);
}

static void against_seconds(sp_text *text, const sp_study *study, place *at, belongs *front, const char *label,
                            const char *y_title)
{
    drawing d = {.count = 0};
    for (size_t i = 0; i < study->run_count; i++)
        if (begins(study, i, same_physics)) {
            sp_plot_series *series = add_series(&d, study, &study->runs[i].fidelity, same_physics, at);
            if (series)
                name_series(series, &study->runs[i].fidelity, false, false);
        }
    sp_plot_series *series = add_series(&d, study, NULL, front, at);
    if (series) {
        qsort(series->points, series->count, sizeof *series->points, from_the_left);
        snprintf(series->name, sizeof series->name, "Pareto front");
        series->colour = "#10202a";
        series->shape = 4;
        series->stepped = true;
    }
    series = add_series(&d, study, NULL, is_chosen, at);
    if (series) {
        snprintf(series->name, sizeof series->name, "the scene's own settings");
        series->colour = "#10202a";
        series->shape = 5;
    }
    finish(
        text, &d,
        (sp_plot){
            .label = label, .x_title = "Seconds of one evaluation", .y_title = y_title, .log_x = true, .log_y = true});
}

static void along(sp_text *text, const sp_study *study, bool texel, const char *label, const char *x_title)
{
    drawing d = {.count = 0};
    for (size_t i = 0; i < study->run_count; i++) {
        const sp_fidelity *kind = &study->runs[i].fidelity;
        belongs *in = texel ? same_but_texel : same_but_jets;
        if (!begins(study, i, in) || (!texel && kind->method == SP_METHOD_INVERSE))
            continue;
        sp_plot_series *series = add_series(&d, study, kind, in, texel ? misjudged_by_texel : misjudged_by_jets);
        if (!series)
            continue;
        name_series(series, kind, !texel, texel);
        series->joined = true;
    }
    finish(text, &d,
           (sp_plot){.label = label,
                     .x_title = x_title,
                     .y_title = "Misjudged, % of the surface",
                     .log_x = true,
                     .log_y = true});
}

/* Whether the grid has several values along one of its ways. */
static bool varies(const sp_study *study, bool texel)
{
    for (size_t i = 0; i < study->order_count; i++)
        if (texel == !(study->orders[i].fidelity.texel > 0))
            return true;
    return false;
}

void sp_study_run_plots(sp_text *text, const sp_study *study)
{
    sp_text_add(text, "<section id=\"front\"><h2>Error against seconds</h2>\n");
    against_seconds(text, study, error_by_seconds, on_front,
                    "Chart: error of the coverage in points against seconds of one evaluation",
                    "Error of the coverage, points");
    sp_text_add(text,
                "<p class=\"note\">The size of the mean difference and twice its standard error. Too much here and "
                "too little there cancel in it: a low point may be luck, which the next chart does not know.</p>\n");
    against_seconds(text, study, misjudged_by_seconds, on_front_misjudged,
                    "Chart: misjudged area in per cent against seconds of one evaluation",
                    "Misjudged, % of the surface");
    sp_text_add(text,
                "<p class=\"note\">Misjudged is what is wrong either way: dry that counts as covered, and covered "
                "that counts as dry.</p></section>\n");
    if (varies(study, true)) {
        sp_text_add(text, "<section id=\"texels\"><h2>What a finer texel buys</h2>\n");
        along(text, study, true, "Chart: misjudged area against texel", "Texel, mm");
        sp_text_add(text, "</section>\n");
    }
    if (varies(study, false)) {
        sp_text_add(text, "<section id=\"jets\"><h2>What more jets buy</h2>\n");
        along(text, study, false, "Chart: misjudged area against jets", "Jets of each nozzle");
        sp_text_add(text, "</section>\n");
    }
}
