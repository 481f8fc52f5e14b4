/* The same nozzles, counted by several runs: they are shown as one of them found. */
#include "page.h"

/* The first design that shows what the same run found of the same nozzles. */
static size_t first_with(const sp_page *page, size_t design)
{
    const sp_figures *figures = page->result->designs[design].figures;
    for (size_t first = 0; figures && first < design; ++first) {
        const sp_figures *others = page->result->designs[first].figures;
        if (others && others->nozzles == figures->nozzles)
            return first;
    }
    return design;
}

static void add_group(const sp_page *page, sp_text *text, size_t first)
{
    size_t listed = 0;
    for (size_t i = first; i < page->result->design_count; ++i) {
        if (first_with(page, i) != first)
            continue;
        sp_text_add(text, listed++ ? ", " : "<p class=\"note\">The same nozzles: ");
        sp_page_narrow_name(page, text, i);
    }
    sp_text_add(text, ". What their runs found, each on texels of its own, differs by no more than the errors; the "
                      "figures of the run of least error stand for all.</p>\n");
}

void sp_page_same_layouts(const sp_page *page, sp_text *text)
{
    size_t count = page->result->design_count;
    for (size_t first = 0; first < count; ++first) {
        size_t others = 0;
        for (size_t i = first + 1; i < count; ++i)
            others += first_with(page, i) == first;
        if (others > 0 && first_with(page, first) == first)
            add_group(page, text, first);
    }
}
