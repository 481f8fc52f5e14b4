/* Where to look first. */
#include "page.h"

#include <stdlib.h>

/* Flux that is little beside 1 L/min per m² may be much of what the criterion asks for. */
static int flux_decimals(const sp_criterion *criterion, double flux)
{
    return sp_told_decimals(6e4 * flux, sp_told_decimals(6e4 * criterion->flux, 2, 2), 1);
}

static void add_swab(sp_text *text, size_t number, const sp_swab *swab, int place, const sp_criterion *criterion)
{
    const double values[] = {swab->place.x,
                             swab->place.y,
                             swab->place.z,
                             100 * swab->received,
                             6e4 * swab->flux,
                             swab->speed,
                             swab->incidence * 180 / M_PI};
    const int decimals[] = {place, place, place, 0, flux_decimals(criterion, swab->flux), 1, 0};
    char *part = sp_text_utf8(swab->part);
    const char *lack = sp_lack_text(swab->lack);
    text->failed |= !part;
    sp_text_add(text, "<tr><th scope=\"row\">%zu</th><td class=\"text\">", number);
    sp_markup_escape(text, part ? part : "");
    sp_text_add(text, "</td>");
    for (size_t i = 0; i < sizeof values / sizeof *values; ++i) {
        sp_text_add(text, "<td>");
        sp_markup_decimals(text, values[i], decimals[i]);
        sp_text_add(text, "</td>");
    }
    sp_text_add(text, "<td class=\"text lack\">%s</td></tr>\n", lack ? lack : "covered");
    free(part);
}

bool sp_page_swabs(const sp_page *page, sp_text *text, sp_error *error)
{
    sp_swab swabs[SP_SWABS];
    size_t count;
    const sp_design *design = page->main == SP_UNKNOWN ? NULL : &page->result->designs[page->main];
    if (!design || !design->evaluator)
        return true;
    if (!sp_find_swabs(design, swabs, &count, error))
        return false;
    sp_text_add(text, "<section id=\"swabs\"><h2>Where to take samples</h2>\n<div class=\"wide\"><table "
                      "class=\"numbers small\"><caption>");
    sp_page_name(page, text, page->main);
    if (count == 1)
        sp_text_add(text, ": the worst place");
    else
        sp_text_add(text, ": the %zu worst places", count);
    sp_text_add(text, "</caption>\n<thead><tr><th scope=\"col\">No.</th><th scope=\"col\" "
                      "class=\"text\">Part</th><th scope=\"col\">x&nbsp;m</th><th scope=\"col\">y&nbsp;m</th><th "
                      "scope=\"col\">z&nbsp;m</th><th scope=\"col\">%% of the criterion</th><th scope=\"col\">L/min "
                      "per m\xc2\xb2</th><th scope=\"col\">m/s</th><th scope=\"col\">incidence&nbsp;&deg;</th><th "
                      "scope=\"col\" class=\"text\">Lacks</th></tr></thead>\n<tbody>\n");
    const int place = sp_place_decimals(&page->figures[page->main], 3);
    for (size_t i = 0; i < count; ++i)
        add_swab(text, i + 1, &swabs[i], place, &sp_evaluator_setup(design->evaluator)->criterion);
    sp_text_add(text, "</tbody></table></div>\n<p class=\"note\">The places that receive the least share of what the "
                      "criterion asks for, of equally bad ones those deepest in a shadow, 20&nbsp;%% of the "
                      "geometry&#39;s diagonal apart where they can be, all at least 5&nbsp;%%. Flux is all that "
                      "arrives, with its mean speed and incidence; the "
                      "share is of what the criterion counts. The same is in swabs.csv.</p></section>\n");
    return true;
}
