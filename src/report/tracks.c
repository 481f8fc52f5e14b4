/* How close the mesh is that two-axis heads draw on the walls. */
#include "page.h"

static void add_cell(sp_text *text, double value, int decimals)
{
    sp_text_add(text, "<td>");
    sp_markup_decimals(text, value, decimals);
    sp_text_add(text, "</td>");
}

static void add_head(const sp_page *page, sp_text *text, size_t design, const sp_nozzle_figures *nozzle)
{
    const sp_track_gaps *gaps = &nozzle->tracks;
    sp_text_add(text, "<tr><th scope=\"row\">");
    sp_page_name(page, text, design);
    sp_text_add(text, ": ");
    sp_markup_escape(text, nozzle->name);
    sp_text_add(text, "</th>");
    add_cell(text, gaps->turns == SP_UNKNOWN ? NAN : (double)gaps->turns, 0);
    add_cell(text, gaps->duration / 60, 1);
    add_cell(text, gaps->area, 3);
    add_cell(text, 1e3 * gaps->mean, 1);
    add_cell(text, 1e3 * gaps->p95, 1);
    add_cell(text, 1e3 * gaps->greatest, 1);
    sp_text_add(text, "</tr>\n");
}

void sp_page_tracks(const sp_page *page, sp_text *text)
{
    bool any = false;
    for (size_t i = 0; i < page->result->design_count; ++i)
        for (size_t k = 0; k < page->figures[i].nozzle_count; ++k)
            any |= page->figures[i].nozzles[k].tracks.known;
    if (!any)
        return;
    sp_text_add(text, "<section id=\"tracks\"><h2>Tracks of jet heads</h2>\n<div class=\"wide\"><table "
                      "class=\"numbers\"><thead><tr><th scope=\"col\">Head</th><th scope=\"col\">Turns</th><th "
                      "scope=\"col\">min</th><th scope=\"col\">Reached <span class=\"unit\">(m\xc2\xb2)</span></th>"
                      "<th scope=\"col\">Mean gap <span class=\"unit\">(mm)</span></th><th scope=\"col\">95&nbsp;%% "
                      "within <span class=\"unit\">(mm)</span></th><th scope=\"col\">Greatest <span class=\"unit\">"
                      "(mm)</span></th></tr></thead>\n<tbody>\n");
    for (size_t i = 0; i < page->result->design_count; ++i)
        for (size_t k = 0; k < page->figures[i].nozzle_count; ++k)
            if (page->figures[i].nozzles[k].tracks.known)
                add_head(page, text, i, &page->figures[i].nozzles[k]);
    sp_text_add(text, "</tbody></table></div>\n<p>A gap is how far a place that the head reaches is from the middle of "
                      "the nearest track of any of its jets, after so many turns of its body: the angle at the head "
                      "times the distance. Walls that are met at a slant are not stretched. All other figures are of "
                      "the mean over time, which knows no tracks.</p>\n</section>\n");
}
