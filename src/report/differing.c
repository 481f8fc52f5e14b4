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

/* Results of older versions do not tell theirs. */
static void add_criteria(const sp_page *page, sp_text *text, bool one)
{
    sp_text_add(text, one ? "<p class=\"warning\"><strong>What covered means is not known.</strong> These results do "
                            "not tell it, and it may differ"
                          : "<p class=\"warning\"><strong>The criteria differ.</strong> Covered means: ");
    for (size_t i = 0; i < page->result->design_count && !one; ++i) {
        char clause[SP_CRITERION_TEXT];
        sp_criterion_clause(&page->figures[i], clause);
        sp_text_add(text, i ? "; " : "");
        sp_page_narrow_name(page, text, i);
        sp_text_add(text, " ");
        sp_markup_escape(text, clause);
    }
    sp_text_add(text, ".</p>\n");
}

/* No fault, but what a layout covers depends on them. */
static void add_texels(const sp_page *page, sp_text *text)
{
    sp_text_add(text, "<p class=\"note\"><strong>The texels differ.</strong> Nozzles then have other figures, by about "
                      "as much as these are off: ");
    for (size_t i = 0; i < page->result->design_count; ++i) {
        double texel = page->figures[i].texel;
        sp_text_add(text, i ? "; " : "");
        sp_page_narrow_name(page, text, i);
        if (isfinite(texel))
            sp_text_add(text, " %.3g&nbsp;mm", 1e3 * texel);
        else
            sp_text_add(text, " not told");
    }
    sp_text_add(text, ".</p>\n");
}

void sp_page_differing(const sp_page *page, sp_text *text)
{
    size_t count = page->result->design_count;
    bool one = sp_figures_share_criterion(page->figures, count);
    if (!sp_figures_share_surface(page->figures, count))
        add_geometries(page, text);
    if (count > 1 && !(one && page->figures[0].criterion_known))
        add_criteria(page, text, one);
    if (!sp_figures_share_texel(page->figures, count))
        add_texels(page, text);
}
