/* Coverage against water: the best found for rising water, and the designs. */
#include "page.h"

#define WIDTH 760
#define HEIGHT 380
#define LEFT 70
#define RIGHT 20
#define TOP 16
#define BOTTOM 56

typedef struct {
    double x_max, x_step, y_min, y_max, y_step; /* L/min, % */
} axes;

static double x_of(const axes *a, double water)
{
    return LEFT + (WIDTH - LEFT - RIGHT) * water / a->x_max;
}

static double y_of(const axes *a, double percent)
{
    return HEIGHT - BOTTOM - (HEIGHT - TOP - BOTTOM) * (percent - a->y_min) / (a->y_max - a->y_min);
}

/* 1, 2 or 5 times a power of ten, about a fifth of the range. */
static double nice_step(double range)
{
    double rough = range / 5, power = pow(10, floor(log10(rough))), share = rough / power;
    return power * (share < 1.5 ? 1 : share < 3.5 ? 2 : share < 7.5 ? 5 : 10);
}

static double whole_area(const sp_page *page)
{
    const sp_figures *figures = &page->figures[page->main == SP_UNKNOWN ? 0 : page->main];
    return figures->clean_area;
}

static axes choose_axes(const sp_page *page)
{
    const sp_proposal *proposal = page->result->proposal;
    double most = 1e-3, least = 100, whole = whole_area(page);
    for (size_t i = 0; i < page->result->design_count; ++i) {
        most = fmax(most, 6e4 * page->figures[i].flow);
        least = fmin(least, 100 * page->figures[i].coverage);
    }
    for (size_t i = 0; proposal && i < proposal->front_count; ++i) {
        most = fmax(most, 6e4 * proposal->front[i].flow);
        least = fmin(least, 100 * proposal->front[i].area / whole);
    }
    axes a = {.x_step = nice_step(1.05 * most), .y_max = 100};
    a.x_max = a.x_step * ceil(1.05 * most / a.x_step);
    a.y_step = nice_step(fmax(100 - least, 2));
    a.y_min = fmax(0, a.y_step * floor((least - 0.2 * a.y_step) / a.y_step));
    return a;
}

static void add_grid(sp_text *text, const axes *a)
{
    for (double y = a->y_min; y < a->y_max + 0.5 * a->y_step; y += a->y_step) {
        sp_text_add(text, "<line class=\"grid\" x1=\"%d\" x2=\"%d\" y1=\"%.1f\" y2=\"%.1f\"/>", LEFT, WIDTH - RIGHT,
                    y_of(a, y), y_of(a, y));
        sp_text_add(text, "<text x=\"%d\" y=\"%.1f\" text-anchor=\"end\">%g</text>\n", LEFT - 8, y_of(a, y) + 4, y);
    }
    for (double x = 0; x < a->x_max + 0.5 * a->x_step; x += a->x_step)
        sp_text_add(text,
                    "<line class=\"grid\" x1=\"%.1f\" x2=\"%.1f\" y1=\"%d\" y2=\"%d\"/><text x=\"%.1f\" y=\"%d\" "
                    "text-anchor=\"middle\">%g</text>\n",
                    x_of(a, x), x_of(a, x), TOP, HEIGHT - BOTTOM, x_of(a, x), HEIGHT - BOTTOM + 20, x);
    sp_text_add(text, "<text class=\"axis\" x=\"%d\" y=\"%d\" text-anchor=\"middle\">Water, L/min</text>\n",
                (LEFT + WIDTH - RIGHT) / 2, HEIGHT - 12);
    sp_text_add(
        text,
        "<text class=\"axis\" transform=\"translate(18 %d) rotate(-90)\" text-anchor=\"middle\">Coverage of the "
        "surface to be cleaned, %%</text>\n",
        (TOP + HEIGHT - BOTTOM) / 2);
}

/* Steps: with water between two points one has the left one's layout. */
static void add_front(const sp_page *page, sp_text *text, const axes *a)
{
    const sp_proposal *proposal = page->result->proposal;
    double whole = whole_area(page);
    if (!proposal || proposal->front_count == 0)
        return;
    sp_text_add(text, "<path class=\"front\" d=\"");
    for (size_t i = 0; i < proposal->front_count; ++i) {
        double x = x_of(a, 6e4 * proposal->front[i].flow), y = y_of(a, 100 * proposal->front[i].area / whole);
        if (i == 0)
            sp_text_add(text, "M%.1f %.1f", x, y);
        else
            sp_text_add(text, "H%.1fV%.1f", x, y);
    }
    sp_text_add(text, "H%d\"/>\n", WIDTH - RIGHT);
    for (size_t i = 0; i < proposal->front_count; ++i)
        sp_text_add(text, "<circle class=\"point\" cx=\"%.1f\" cy=\"%.1f\" r=\"3.5\"/>\n",
                    x_of(a, 6e4 * proposal->front[i].flow), y_of(a, 100 * proposal->front[i].area / whole));
}

/* What is proved that no layout exceeds, at the waters of the front. */
static void add_bound(const sp_page *page, sp_text *text, const axes *a)
{
    const sp_proposal *proposal = page->result->proposal;
    if (!proposal || !proposal->certificate.computed || proposal->front_count == 0)
        return;
    sp_text_add(text, "<path class=\"bound\" d=\"");
    for (size_t i = 0; i < proposal->front_count; ++i) {
        double y = y_of(a, fmin(100, 100 * proposal->front[i].bound / proposal->certificate.whole));
        sp_text_add(text, i == 0 ? "M%.1f %.1f" : "H%.1fV%.1f", x_of(a, 6e4 * proposal->front[i].flow), y);
    }
    sp_text_add(text, "H%d\"/>\n", WIDTH - RIGHT);
}

/* Shapes differ as well as colours. */
static void add_marker(sp_text *text, double x, double y, size_t shape, const char *colour)
{
    if (shape % 3 == 0)
        sp_text_add(text, "<path d=\"M%.1f %.1fl8 8l-8 8l-8 -8z\"", x, y - 8);
    else if (shape % 3 == 1)
        sp_text_add(text, "<rect x=\"%.1f\" y=\"%.1f\" width=\"12\" height=\"12\"", x - 6, y - 6);
    else
        sp_text_add(text, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"7.5\"", x, y);
    sp_text_add(text, " fill=\"%s\" stroke=\"#fff\" stroke-width=\"1.5\"/>\n", colour);
}

static void add_designs(const sp_page *page, sp_text *text, const axes *a)
{
    size_t count = page->result->design_count;
    for (size_t i = 0; i < count; ++i) {
        double legend = HEIGHT - BOTTOM - 20 - 22 * (double)(count - 1 - i);
        add_marker(text, x_of(a, 6e4 * page->figures[i].flow), y_of(a, 100 * page->figures[i].coverage), i,
                   sp_page_colour(page, i));
        if (count > 12)
            continue;
        add_marker(text, WIDTH - RIGHT - 250, legend - 4, i, sp_page_colour(page, i));
        sp_text_add(text, "<text class=\"legend\" x=\"%d\" y=\"%.1f\">", WIDTH - RIGHT - 234, legend);
        sp_page_name(page, text, i);
        sp_text_add(text, "</text>\n");
    }
    if (!page->result->proposal || count > 12)
        return;
    double legend = HEIGHT - BOTTOM - 20 - 22 * (double)count;
    sp_text_add(
        text,
        "<path class=\"front\" d=\"M%d %.1fh20\"/><circle class=\"point\" cx=\"%d\" cy=\"%.1f\" r=\"3.5\"/><text "
        "class=\"legend\" x=\"%d\" y=\"%.1f\">Best found for rising water</text>\n",
        WIDTH - RIGHT - 260, legend - 4, WIDTH - RIGHT - 250, legend - 4, WIDTH - RIGHT - 234, legend);
    if (page->result->proposal->certificate.computed)
        sp_text_add(text,
                    "<path class=\"bound\" d=\"M%d %.1fh20\"/><text class=\"legend\" x=\"%d\" y=\"%.1f\">Proved: none "
                    "covers more</text>\n",
                    WIDTH - RIGHT - 260, legend - 26, WIDTH - RIGHT - 234, legend - 22);
}

void sp_page_front_chart(const sp_page *page, sp_text *text)
{
    bool front = page->result->proposal && page->result->proposal->front_count > 0;
    if (!front && page->result->design_count < 2)
        return;
    axes a = choose_axes(page);
    sp_text_add(text,
                "<section id=\"front\"><h2>Coverage against water</h2>\n<svg class=\"chart\" viewBox=\"0 0 %d %d\" "
                "role=\"img\" aria-label=\"Chart: coverage in per cent against water in litres a minute\">\n",
                WIDTH, HEIGHT);
    add_grid(text, &a);
    add_bound(page, text, &a);
    add_front(page, text, &a);
    add_designs(page, text, &a);
    sp_text_add(text, "</svg>\n");
    if (front)
        sp_text_add(text,
                    "<p class=\"note\">Each dot is a layout that the search found; none that it found covers more with "
                    "as little water. %s</p>\n",
                    page->result->proposal->certificate.computed
                        ? "The dashed line is what no layout of the candidates exceeds, counted on the texels of the "
                          "certificate below."
                        : "How far the best possible may lie above is not known.");
    sp_text_add(text, "</section>\n");
}
