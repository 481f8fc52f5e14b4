/* The placements, as plots and as a table. */
#include "page.h"
#include "plot.h"
#include "report/markup.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { IN_GROUP = 3, MOST_GROUPS = 8 };
static const char *const colours[] = {"#6b7a87", "#b5542e", "#3b5b92", "#0b6670",
                                      "#7a4b8f", "#8a6d1d", "#c42636", "#10202a"};

static size_t group_size(const sp_study *study, size_t first)
{
    return study->place_count - first < IN_GROUP ? study->place_count - first : IN_GROUP;
}

/* The one in the middle of a group, or its first where the study ended before. */
static const sp_study_place *middle(const sp_study *study, size_t first)
{
    return &study->places[group_size(study, first) == IN_GROUP ? first + 1 : first];
}

/* Where mounts cost something the search minimises prices, which then stand where water does elsewhere. */
static bool is_costly(const sp_study *study)
{
    return study->places->costly;
}

static void draw(sp_text *text, const sp_study *study, bool outlay)
{
    sp_plot_series series[MOST_GROUPS];
    sp_plot_point points[MOST_GROUPS * IN_GROUP];
    size_t groups = 0;
    for (size_t first = 0; first < study->place_count && groups < MOST_GROUPS; first += IN_GROUP, groups++) {
        sp_plot_series *s = &series[groups];
        *s = (sp_plot_series){.colour = colours[groups], .shape = (int)(groups % 4), .points = &points[first]};
        s->count = group_size(study, first);
        for (size_t i = 0; i < s->count; i++) {
            const sp_study_place *place = &study->places[first + i];
            double spread = 100 * place->confirmed_spread, confirmed = 100 * place->confirmed;
            s->points[i] = outlay ? (sp_plot_point){place->seconds, 6e4 * place->outlay, NAN, NAN}
                                  : (sp_plot_point){place->seconds, confirmed, confirmed - spread, confirmed + spread};
        }
        sp_text words = {0};
        sp_words_place(&words, middle(study, first));
        char *name = sp_text_finish(&words, NULL);
        snprintf(s->name, sizeof s->name, "%s", name ? name : "");
        free(name);
    }
    bool costly = is_costly(study);
    sp_plot_draw(text, &(sp_plot){.label = !outlay  ? "Chart: confirmed coverage against seconds of the search"
                                           : costly ? "Chart: price of the proposal against seconds of the search"
                                                    : "Chart: water of the proposal against seconds of the search",
                                  .x_title = "Seconds until the layout was there",
                                  .y_title = !outlay  ? "Confirmed coverage, %"
                                             : costly ? "Price: water and mounts, L/min"
                                                      : "Water, L/min",
                                  .log_x = true,
                                  .count = groups,
                                  .series = series});
}

static double water_of(const sp_study_place *place)
{
    return 6e4 * place->water;
}
static double coverage_of(const sp_study_place *place)
{
    return 100 * place->coverage;
}
static double confirmed_of(const sp_study_place *place)
{
    return 100 * place->confirmed;
}
static double seconds_of(const sp_study_place *place)
{
    return place->seconds;
}
static double cpu_of(const sp_study_place *place)
{
    return place->cpu;
}

/* From the least to the most of a group. */
static void add_range(sp_text *text, const sp_study_place *places, size_t count, double (*of)(const sp_study_place *),
                      int decimals)
{
    double least = INFINITY, most = -INFINITY;
    for (size_t i = 0; i < count; i++) {
        least = fmin(least, of(&places[i]));
        most = fmax(most, of(&places[i]));
    }
    sp_text_add(text, "<td>");
    sp_markup_decimals(text, least, decimals);
    if (most > least) {
        sp_text_add(text, " to ");
        sp_markup_decimals(text, most, decimals);
    }
    sp_text_add(text, "</td>");
}

static size_t ended_early(const sp_study_place *places, size_t count)
{
    size_t ended = 0;
    for (size_t i = 0; i < count; i++)
        ended += places[i].ended_early;
    return ended;
}

static void add_group(sp_text *text, const sp_study *study, size_t first)
{
    const sp_study_place *places = &study->places[first];
    size_t count = group_size(study, first), ended = ended_early(places, count);
    sp_text_add(text, "<tr><th scope=\"row\">");
    sp_words_place(text, middle(study, first));
    sp_text_add(text, "</th>");
    for (size_t i = 0; i < IN_GROUP; i++) {
        sp_text_add(text, "<td>");
        sp_markup_water(text, i < count ? 6e4 * places[i].outlay : NAN);
        sp_text_add(text, "</td>");
    }
    if (is_costly(study))
        add_range(text, places, count, water_of, 1);
    add_range(text, places, count, coverage_of, 2);
    add_range(text, places, count, confirmed_of, 2);
    add_range(text, places, count, seconds_of, 1);
    add_range(text, places, count, cpu_of, 1);
    sp_text_add(text, "<td>");
    if (places->limited)
        sp_text_add(text, "its own");
    else if (ended)
        sp_text_add(text, "%zu of %zu", ended, count);
    else
        sp_text_add(text, "none");
    sp_text_add(text, "</td></tr>\n");
}

void sp_study_place_page(sp_text *text, const sp_study *study)
{
    if (study->place_count == 0)
        return;
    const char *outlay = is_costly(study) ? "Price" : "Water";
    sp_text_add(text, "<section id=\"placements\"><h2>Placements</h2>\n<h3>%s of what is proposed</h3>\n", outlay);
    draw(text, study, true);
    sp_text_add(text, "<h3>Coverage that points confirm</h3>\n");
    draw(text, study, false);
    sp_text_add(
        text,
        "<h3>Every search</h3>\n<div class=\"wide\"><table class=\"numbers small\"><thead><tr><th "
        "rowspan=\"2\">Search</th><th colspan=\"3\" scope=\"colgroup\">%s, L/min, on a texel</th>%s<th "
        "rowspan=\"2\">Coverage, %%</th><th rowspan=\"2\">Confirmed, %%</th><th "
        "rowspan=\"2\">Seconds</th><th rowspan=\"2\">CPU seconds</th><th rowspan=\"2\">Cut "
        "short</th></tr>\n<tr><th scope=\"col\" style=\"text-align:right\">3&nbsp;%% finer</th><th scope=\"col\">as "
        "said</th><th scope=\"col\">3&nbsp;%% coarser</th></tr></thead>\n<tbody>\n",
        outlay, is_costly(study) ? "<th rowspan=\"2\">Water, L/min</th>" : "");
    for (size_t first = 0; first < study->place_count; first += IN_GROUP)
        add_group(text, study, first);
    sp_text_add(text,
                "</tbody></table></div>\n<p class=\"note\">Three placements each, on texels 3&nbsp;%% apart: what "
                "they differ by is the luck of the search, and settings whose %ss lie within it are not told "
                "apart. Coverage is by the search's own settings; confirmed is the share of the points, each "
                "judged for itself at the first impact (bars: twice its standard error). Seconds end when the "
                "layout is there: forward check and certificate come after and are left out. What was cut short "
                "reached the limit of the study, not the end of its search.</p></section>\n",
                is_costly(study) ? "price" : "water");
}
