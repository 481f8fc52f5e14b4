/* Coverage by part, the least covered first: where the next look goes. */
#include "page.h"

#include <stdlib.h>
#include <string.h>

#define PARTS_SHOWN 24
#define ROUND_OFF 1e-6 /* relative: parts may be small beside the length of a texel */

static double share(const sp_part_figures *part)
{
    return part->area > 0 ? part->covered / part->area : NAN;
}

/* By name and, up to round-off, by area: one column of areas is then that of both. */
static bool same_parts(const sp_figures *a, const sp_figures *b)
{
    bool same = a->part_count == b->part_count;
    for (size_t i = 0; same && i < a->part_count; ++i)
        same = strcmp(a->parts[i].part, b->parts[i].part) == 0 &&
               !(fabs(a->parts[i].area - b->parts[i].area) > ROUND_OFF * fmax(a->parts[i].area, b->parts[i].area));
    return same;
}

typedef struct {
    double share;
    size_t part;
} rank;

static int least_first(const void *left, const void *right)
{
    const rank *a = left, *b = right;
    if (a->share != b->share)
        return a->share < b->share ? -1 : 1;
    return (a->part > b->part) - (a->part < b->part);
}

/* Parts by how much of them one design covers. NULL where memory runs out. */
static rank *ranked(const sp_figures *figures)
{
    rank *ranks = malloc((figures->part_count + 1) * sizeof *ranks);
    for (size_t i = 0; ranks && i < figures->part_count; ++i)
        ranks[i] = (rank){fmax(share(&figures->parts[i]), 0), i}; /* not known: 0 */
    if (ranks)
        qsort(ranks, figures->part_count, sizeof *ranks, least_first);
    return ranks;
}

static void add_covered(sp_text *text, const sp_part_figures *part, const char *aside)
{
    sp_text_add(text, "<td%s>", aside);
    sp_markup_significant(text, part->covered, 3);
    sp_text_add(text, "</td><td%s>", aside);
    sp_markup_decimals(text, 100 * share(part), 1);
    sp_text_add(text, "</td>");
}

/* Of the parts from the `from`th to the `end`th in rank together. */
static sp_part_figures together(const sp_figures *figures, const rank *ranks, size_t from, size_t end)
{
    sp_part_figures sum = {0};
    for (size_t i = from; i < end; ++i) {
        sum.area += figures->parts[ranks[i].part].area;
        sum.covered += figures->parts[ranks[i].part].covered;
    }
    return sum;
}

/* A row of the designs from `first` to `end`. */
static void add_row(const sp_page *page, sp_text *text, size_t first, size_t end, const char *name, const rank *ranks,
                    size_t from, size_t to)
{
    sp_part_figures part = together(&page->figures[first], ranks, from, to);
    sp_text_add(text, "<tr><th scope=\"row\">");
    sp_markup_escape(text, name);
    sp_text_add(text, "</th><td>");
    sp_markup_significant(text, part.area, 3);
    sp_text_add(text, "</td>");
    for (size_t i = first; i < end; ++i) {
        part = together(&page->figures[i], ranks, from, to);
        add_covered(text, &part, sp_page_aside(page, i));
    }
    sp_text_add(text, "</tr>\n");
}

static void add_head(const sp_page *page, sp_text *text, size_t first, size_t end)
{
    sp_text_add(text, "<div class=\"wide\"><table class=\"numbers small\"><thead><tr><th scope=\"col\" "
                      "rowspan=\"2\">Part</th><th scope=\"col\" rowspan=\"2\">m\xc2\xb2</th>");
    for (size_t i = first; i < end; ++i) {
        sp_text_add(text, "<th scope=\"colgroup\" colspan=\"2\"%s>", sp_page_aside(page, i));
        sp_page_narrow_name(page, text, i);
        sp_text_add(text, "</th>");
    }
    sp_text_add(text, "</tr><tr class=\"sub\">");
    for (size_t i = first; i < end; ++i)
        sp_text_add(text, "<th scope=\"col\"%s>m\xc2\xb2</th><th scope=\"col\"%s>%%</th>", sp_page_aside(page, i),
                    sp_page_aside(page, i));
    sp_text_add(text, "</tr></thead>\n<tbody>\n");
}

/* The designs from `first` to `end`, which have the same parts. */
static void add_table(const sp_page *page, sp_text *text, size_t first, size_t end)
{
    size_t by = page->main >= first && page->main < end ? page->main : first;
    const sp_figures *figures = &page->figures[by];
    size_t count = figures->part_count, shown = count > PARTS_SHOWN + 1 ? PARTS_SHOWN : count;
    rank *ranks = ranked(figures);
    text->failed |= !ranks;
    if (!ranks)
        return;
    add_head(page, text, first, end);
    for (size_t i = 0; i < shown; ++i)
        add_row(page, text, first, end, figures->parts[ranks[i].part].part, ranks, i, i + 1);
    if (shown < count)
        add_row(page, text, first, end, "all other parts", ranks, shown, count);
    if (count > 1)
        add_row(page, text, first, end, "together", ranks, 0, count);
    sp_text_add(text, "</tbody></table></div>\n");
    free(ranks);
}

void sp_page_parts(const sp_page *page, sp_text *text)
{
    size_t known = 0, designs = page->result->design_count;
    for (size_t i = 0; i < designs; ++i)
        known += page->figures[i].part_count > 0;
    if (!known)
        return;
    sp_text_add(text, "<section id=\"parts\"><h2>Coverage by part</h2>\n");
    for (size_t first = 0, end; first < designs; first = end) {
        for (end = first + 1; end < designs && same_parts(&page->figures[first], &page->figures[end]); ++end)
            continue;
        end = end < sp_page_fold(page, first) ? end : sp_page_fold(page, first);
        if (page->figures[first].part_count > 0)
            add_table(page, text, first, end);
    }
    sp_text_add(text,
                "<p class=\"note\">Area to be cleaned, and what of it is covered; the least covered part "
                "%sfirst.</p></section>\n",
                page->main != SP_UNKNOWN && designs > 1 ? "of the proposal " : "");
}
