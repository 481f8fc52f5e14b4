/* What runs down the walls. */
#include "page.h"

typedef double film_figure(const sp_figures *figures);
typedef int film_decimals(const sp_figures *figures);

static double covered(const sp_figures *f)
{
    return f->film.area;
}
static double arriving(const sp_figures *f)
{
    return 6e4 * f->film.arriving;
}
static double drained(const sp_figures *f)
{
    return 6e4 * f->film.left;
}
static double held(const sp_figures *f)
{
    return 6e4 * f->film.held;
}
static double astray(const sp_figures *f)
{
    return 6e4 * f->film.astray;
}
static double per_girth(const sp_figures *f)
{
    return 6e4 * f->film.per_girth;
}

static int area_decimals(const sp_figures *f)
{
    return sp_area_decimals(f, 3);
}
/* Of parts of the layout's water. */
static int water_decimals(const sp_figures *f)
{
    return sp_water_decimals(6e4 * f->flow);
}
static int per_girth_decimals(const sp_figures *f)
{
    return sp_water_decimals(per_girth(f));
}

/* Columns of a table. */
typedef struct {
    size_t first, end; /* designs */
} columns;

static void add_row(const sp_page *page, sp_text *text, columns shown, const char *title, const char *unit,
                    film_decimals *decimals, film_figure *value)
{
    sp_text_add(text, "<tr><th scope=\"row\">%s <span class=\"unit\">(%s)</span></th>", title, unit);
    for (size_t i = shown.first; i < shown.end; ++i) {
        sp_text_add(text, "<td%s>", sp_page_column(page, i));
        if (page->figures[i].film.known)
            sp_markup_decimals(text, value(&page->figures[i]), decimals(&page->figures[i]));
        sp_text_add(text, "</td>");
    }
    sp_text_add(text, "</tr>\n");
}

/* Of the geometry of a design: a fault of the vessel, not of a layout. */
static void add_hollows(const sp_page *page, sp_text *text, size_t design)
{
    const sp_evaluator *evaluator = page->result->designs[design].evaluator;
    size_t count;
    const sp_hollow *hollows = sp_evaluator_hollows(evaluator, &count);
    if (!count)
        return;
    sp_text_add(text, "<div class=\"wide\"><table class=\"numbers\"><caption>");
    sp_page_name(page, text, design);
    sp_text_add(text, ": hollows and flats, where liquid stands</caption>\n<thead><tr><th scope=\"col\">Lowest place "
                      "<span class=\"unit\">(m)</span></th><th scope=\"col\">Area <span class=\"unit\">(m\xc2\xb2)"
                      "</span></th><th scope=\"col\">Drains</th></tr></thead>\n<tbody>\n");
    const int digits = sp_place_decimals(&page->figures[design], 3);
    for (size_t i = 0; i < count; i++) {
        sp_vec3 place = sp_setup_outside(sp_evaluator_setup(evaluator), hollows[i].place);
        const double along[3] = {place.x, place.y, place.z};
        for (int k = 0; k < 3; k++) {
            sp_text_add(text, k ? ", " : "<tr><th scope=\"row\">");
            sp_markup_decimals(text, along[k], digits);
        }
        sp_text_add(text, "</th><td>");
        sp_markup_decimals(text, hollows[i].area, sp_area_decimals(&page->figures[design], 4));
        sp_text_add(text, "</td><td>%s</td></tr>\n", hollows[i].drains ? "over its rim" : "not at all");
    }
    sp_text_add(text, "</tbody></table></div>\n");
}

static void add_table(const sp_page *page, sp_text *text, columns shown)
{
    sp_text_add(text, "<div class=\"wide\"><table "
                      "class=\"numbers\"><thead><tr><th scope=\"col\">Film</th>");
    sp_page_columns(page, text, shown.first, shown.end);
    sp_text_add(text, "</tr></thead>\n<tbody>\n");
    add_row(page, text, shown, "Covered by film alone", "m\xc2\xb2", area_decimals, covered);
    add_row(page, text, shown, "Arrives on wet surface", "L/min", water_decimals, arriving);
    add_row(page, text, shown, "Drains from the geometry", "L/min", water_decimals, drained);
    add_row(page, text, shown, "Stands where it cannot drain", "L/min", water_decimals, held);
    add_row(page, text, shown, "Drips on dry surface", "L/min", water_decimals, astray);
    add_row(page, text, shown, "Supply per metre around all walls, seen from above", "L/min per m", per_girth_decimals,
            per_girth);
    sp_text_add(text, "</tbody></table></div>\n");
}

void sp_page_film(const sp_page *page, sp_text *text)
{
    bool known = false;
    for (size_t i = 0; i < page->result->design_count; ++i)
        known |= page->figures[i].film.known;
    if (!known)
        return;
    sp_text_add(text, "<section id=\"film\"><h2>What runs down the walls</h2>\n");
    for (size_t first = 0; first < page->result->design_count; first = sp_page_fold(page, first))
        add_table(page, text, (columns){first, sp_page_fold(page, first)});
    sp_text_add(text,
                "<p>What arrives is summed up over texels, each judged at one point, and what lands is counted by "
                "single jets: the two differ by what texels do not tell, and by surface that is wet and not to "
                "be cleaned. The last row is the measure of rules of thumb, a mean around the "
                "walls; what the criterion asks for is what runs down at each place.</p>\n");
    const sp_evaluator *before = NULL;
    for (size_t i = 0; i < page->result->design_count; ++i) {
        const sp_evaluator *evaluator = page->result->designs[i].evaluator;
        if (evaluator && evaluator != before)
            add_hollows(page, text, i);
        before = evaluator;
    }
    sp_text_add(text, "</section>\n");
}
