/* Where the liquid ends: what flies out or onto other surface is paid for and cleans nothing. */
#include "page.h"

typedef double liquid(const sp_figures *figures);

static double on_clean(const sp_figures *f)
{
    return f->landed_clean;
}
static double on_other(const sp_figures *f)
{
    return f->landed_other;
}
static double left(const sp_figures *f)
{
    return f->left;
}
static double unfollowed(const sp_figures *f)
{
    return f->unfollowed;
}

/* Of the designs from `first` to `end`. */
static void add_row(const sp_page *page, sp_text *text, size_t first, size_t end, const char *title, liquid *value)
{
    sp_text_add(text, "<tr><th scope=\"row\">%s</th>", title);
    for (size_t i = first; i < end; ++i) {
        const sp_figures *figures = &page->figures[i];
        sp_text_add(text, "<td%s>", sp_page_column(page, i));
        sp_markup_water_of(text, 6e4 * value(figures), 6e4 * figures->flow);
        if (isfinite(value(figures)) && figures->flow > 0) {
            sp_text_add(text, " <span class=\"unit\">(");
            sp_markup_decimals(text, 100 * value(figures) / figures->flow, 1);
            sp_text_add(text, "&nbsp;%%)</span>");
        }
        sp_text_add(text, "</td>");
    }
    sp_text_add(text, "</tr>\n");
}

static void add_table(const sp_page *page, sp_text *text, size_t first, size_t end)
{
    sp_text_add(text, "<div class=\"wide\"><table "
                      "class=\"numbers\"><thead><tr><th scope=\"col\">L/min <span class=\"unit\">(of the "
                      "layout&#39;s water)</span></th>");
    sp_page_columns(page, text, first, end);
    sp_text_add(text, "</tr></thead>\n<tbody>\n");
    add_row(page, text, first, end, "Lands on surface to be cleaned", on_clean);
    add_row(page, text, first, end, "Lands on other surface: obstacles, dry sides", on_other);
    add_row(page, text, first, end, "Flies out of the geometry", left);
    add_row(page, text, first, end, "Is thrown back from a wall and not followed further", unfollowed);
    sp_text_add(text, "</tbody></table></div>\n");
}

void sp_page_liquid(const sp_page *page, sp_text *text)
{
    bool known = false;
    for (size_t i = 0; i < page->result->design_count; ++i)
        known |= isfinite(page->figures[i].landed_clean);
    if (!known)
        return;
    sp_text_add(text, "<section id=\"liquid\"><h2>Where the liquid goes</h2>\n");
    for (size_t first = 0; first < page->result->design_count; first = sp_page_fold(page, first))
        add_table(page, text, first, sp_page_fold(page, first));
    sp_text_add(text, "</section>\n");
}
