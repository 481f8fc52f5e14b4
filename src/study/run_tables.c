/* The runs and the orders as tables. */
#include "page.h"
#include "report/markup.h"

#include <math.h>

static void add_share(sp_text *text, double share, int decimals)
{
    sp_text_add(text, "<td>");
    sp_markup_decimals(text, 100 * share, decimals);
    sp_text_add(text, "</td>");
}

static void add_seconds(sp_text *text, double seconds)
{
    sp_text_add(text, "<td>");
    sp_markup_significant(text, seconds, 2);
    sp_text_add(text, "</td>");
}

static void add_memory(sp_text *text, size_t bytes)
{
    sp_text_add(text, "<td>");
    sp_markup_decimals(text, bytes ? 1e-6 * (double)bytes : NAN, 0);
    sp_text_add(text, "</td>");
}

static void add_row(sp_text *text, const sp_study_run *run)
{
    sp_text_add(text, "<tr><th scope=\"row\" style=\"min-width:190px\">");
    if (run->chosen)
        sp_text_add(text, "<b>The scene's own:</b><br>");
    sp_words_run(text, &run->fidelity, true, true);
    sp_text_add(text, "</th><td>");
    sp_words_count(text, run->texels);
    sp_text_add(text, "</td>");
    add_share(text, run->coverage, 2);
    sp_text_add(text, "<td>");
    sp_markup_signed(text, 100 * run->error, 3);
    sp_text_add(text, " \xc2\xb1 ");
    sp_markup_decimals(text, 100 * run->spread, 3);
    sp_text_add(text, "</td>");
    add_share(text, run->misjudged, 2);
    add_seconds(text, run->speed.prepare);
    add_seconds(text, run->speed.evaluate);
    add_seconds(text, run->speed.prepare_cpu);
    add_seconds(text, run->speed.evaluate_cpu);
    add_memory(text, run->speed.memory);
    sp_text_add(text, "<td class=\"text\">%s%s%s</td></tr>\n", run->speed.front ? "error" : "",
                run->speed.front && run->speed.front_misjudged ? ", " : "",
                run->speed.front_misjudged ? "misjudged" : "");
}

static void add_order(sp_text *text, const sp_study_order *order)
{
    bool along_texel = !(order->fidelity.texel > 0);
    sp_text_add(text, "<tr><th scope=\"row\">");
    sp_words_run(text, &order->fidelity, !along_texel, along_texel);
    sp_text_add(text, "</th><td class=\"text\">%s</td><td>%zu</td><td>", along_texel ? "texel" : "jets", order->count);
    sp_markup_decimals(text, order->error, 2);
    sp_text_add(text, "</td><td>");
    sp_markup_decimals(text, order->misjudged, 2);
    sp_text_add(text, "</td></tr>\n");
}

static void add_orders(sp_text *text, const sp_study *study)
{
    if (study->order_count == 0)
        return;
    sp_text_add(text,
                "<section id=\"orders\"><h2>Orders of convergence</h2>\n<div class=\"wide\"><table class=\"numbers "
                "small narrow\"><thead><tr><th scope=\"col\">Series</th><th scope=\"col\" class=\"text\">Along</th><th "
                "scope=\"col\">Runs</th><th scope=\"col\">Error</th><th scope=\"col\">Misjudged</th></tr></thead>\n"
                "<tbody>\n");
    for (size_t i = 0; i < study->order_count; i++)
        add_order(text, &study->orders[i]);
    sp_text_add(text,
                "</tbody></table></div>\n<p class=\"note\">The power of the texel, or of one over the jets, that "
                "fits best: with order 1 half the texel misjudges half the area. Below 0: it gets worse. The mean "
                "error changes its sign on the way, and where fewer than three runs know it better than by twice "
                "their standard error it has no order.</p></section>\n");
}

void sp_study_run_tables(sp_text *text, const sp_study *study)
{
    sp_text_add(
        text, "<section id=\"runs\"><h2>Every run</h2>\n<div class=\"wide\"><table class=\"numbers small\"><thead><tr>"
              "<th scope=\"col\">Settings</th><th scope=\"col\">Patches</th><th scope=\"col\">Coverage, %%</th><th "
              "scope=\"col\">Error, points</th><th scope=\"col\">Misjudged, %%</th><th scope=\"col\">Prepare, s</th>"
              "<th scope=\"col\">Evaluate, s</th><th scope=\"col\">Prepare, CPU s</th><th scope=\"col\">Evaluate, CPU "
              "s</th><th scope=\"col\">Memory, MB</th><th scope=\"col\" class=\"text\">On the front of</th></tr>"
              "</thead>\n<tbody>\n");
    for (size_t i = 0; i < study->run_count; i++)
        add_row(text, &study->runs[i]);
    sp_text_add(text, "</tbody></table></div></section>\n");
    add_orders(text, study);
}
