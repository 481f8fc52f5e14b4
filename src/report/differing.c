/* What designs side by side do not have in common besides their nozzles, so that their figures are not of one thing. */
#include "page.h"

static void add_geometries(const sp_page *page, sp_text *text)
{
    sp_text_add(text, "<p class=\"warning\"><strong>The geometries differ.</strong> Every share is of the layout&#39;s "
                      "own surface to be cleaned: ");
    for (size_t i = 0; i < page->result->design_count; ++i) {
        const sp_figures *figures = &page->figures[i];
        sp_text_add(text, i ? "; " : "");
        sp_page_narrow_name(page, text, i);
        if (!sp_figures_tell_surface(figures)) {
            sp_text_add(text, " not told");
            continue;
        }
        sp_text_add(text, " ");
        sp_markup_significant(text, figures->clean_area, 4);
        sp_text_add(text, "&nbsp;m\xc2\xb2, %zu triangles", figures->triangles);
    }
    sp_text_add(text, ".</p>\n");
}

void sp_page_differing(const sp_page *page, sp_text *text)
{
    if (!sp_figures_share_surface(page->figures, page->result->design_count))
        add_geometries(page, text);
}
