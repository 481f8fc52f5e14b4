/* Coverage against water, or price: the best found as it rises, and the designs. */
#include "page.h"

#include <string.h>

#define WIDTH 760
#define HEIGHT 380
#define LEFT 70
#define RIGHT 20
#define TOP 16
#define BOTTOM 56
#define FEW 4      /* designs in a chart that has room for their legend */
#define LEGEND 264 /* from its left to the right of the chart, of a legend within it */
#define LETTER 7.0 /* breadth of one, on average */
#define MARKER 8   /* about its middle */
#define MANY 24    /* designs: more have none */

typedef struct {
    double x_max, x_step, y_min, y_max, y_step; /* L/min (price: water, and cost of mounts), % */
} axes;

static double x_of(const axes *a, double price)
{
    return LEFT + (WIDTH - LEFT - RIGHT) * price / a->x_max;
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

/* The proposal whose front is drawn with a design; NULL where it has none of its own. */
static const sp_proposal *front_of(const sp_page *page, size_t design)
{
    return page->alternatives     ? page->result->designs[design].alternative
           : design == page->main ? page->result->proposal
                                  : NULL;
}

/* Fronts of several alternatives have their designs' colours, the only one its own. */
static void add_stroke(const sp_page *page, sp_text *text, size_t design)
{
    if (page->alternatives)
        sp_text_add(text, " style=\"stroke:%s\"", sp_page_colour(page, design));
}

static axes choose_axes(const sp_page *page)
{
    double most = 1e-3, least = 100;
    for (size_t i = 0; i < page->result->design_count; ++i) {
        const sp_proposal *proposal = front_of(page, i);
        most = fmax(most, 6e4 * sp_page_price(page, &page->figures[i]));
        least = fmin(least, 100 * page->figures[i].coverage);
        for (size_t k = 0; proposal && k < proposal->front_count; ++k) {
            most = fmax(most, 6e4 * proposal->front[k].outlay);
            least = fmin(least, 100 * proposal->front[k].area / page->figures[i].clean_area);
        }
    }
    axes a = {.x_step = nice_step(1.05 * most), .y_max = 100};
    a.x_max = a.x_step * ceil(1.05 * most / a.x_step);
    a.y_step = nice_step(fmax(100 - least, 2));
    a.y_min = fmax(0, a.y_step * floor((least - 0.2 * a.y_step) / a.y_step));
    return a;
}

static void add_grid(const sp_page *page, sp_text *text, const axes *a)
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
    sp_text_add(text, "<text class=\"axis\" x=\"%d\" y=\"%d\" text-anchor=\"middle\">%s, L/min</text>\n",
                (LEFT + WIDTH - RIGHT) / 2, HEIGHT - 12, page->costly ? "Price: water and mounts" : "Water");
    sp_text_add(
        text,
        "<text class=\"axis\" transform=\"translate(18 %d) rotate(-90)\" text-anchor=\"middle\">Coverage of the "
        "surface to be cleaned, %%</text>\n",
        (TOP + HEIGHT - BOTTOM) / 2);
}

/* Steps: between two points one has the left one's layout. */
static void add_front(const sp_page *page, sp_text *text, const axes *a, size_t design)
{
    const sp_proposal *proposal = front_of(page, design);
    double whole = page->figures[design].clean_area;
    if (!proposal || proposal->front_count == 0)
        return;
    sp_text_add(text, "<path class=\"front\"");
    add_stroke(page, text, design);
    sp_text_add(text, " d=\"");
    for (size_t i = 0; i < proposal->front_count; ++i) {
        double x = x_of(a, 6e4 * proposal->front[i].outlay), y = y_of(a, 100 * proposal->front[i].area / whole);
        if (i == 0)
            sp_text_add(text, "M%.1f %.1f", x, y);
        else
            sp_text_add(text, "H%.1fV%.1f", x, y);
    }
    sp_text_add(text, "H%d\"/>\n", WIDTH - RIGHT);
    for (size_t i = 0; i < proposal->front_count; ++i) {
        sp_text_add(text, "<circle class=\"point\" cx=\"%.1f\" cy=\"%.1f\" r=\"3.5\"",
                    x_of(a, 6e4 * proposal->front[i].outlay), y_of(a, 100 * proposal->front[i].area / whole));
        if (page->alternatives)
            sp_text_add(text, " style=\"fill:%s\"", sp_page_colour(page, design));
        sp_text_add(text, "/>\n");
    }
}

/* Whether a line is drawn of what is proved of a design's front. Nothing is where what walls throw back counts: what is
 * proved is without it. */
static bool has_bound(const sp_page *page, size_t design)
{
    const sp_proposal *proposal = front_of(page, design);
    return proposal && proposal->certificate.computed && proposal->front_count > 0 &&
           !sp_evaluator_counts_thrown_back(page->result->designs[design].evaluator);
}

/* Fronts, and how many of them have such a line: each alternative is searched, and proved, for itself. */
typedef struct {
    size_t fronts, bounds;
} drawn_lines;

static drawn_lines count_lines(const sp_page *page)
{
    drawn_lines lines = {0};
    for (size_t i = 0; i < page->result->design_count; ++i) {
        const sp_proposal *proposal = front_of(page, i);
        lines.fronts += proposal && proposal->front_count > 0;
        lines.bounds += has_bound(page, i);
    }
    return lines;
}

/* What is proved that no layout exceeds: of a price the bound at the point to its right, up to the last of them. A
 * point's own says nothing of what costs more. */
static void add_bound(const sp_page *page, sp_text *text, const axes *a, size_t design)
{
    if (!has_bound(page, design))
        return;
    const sp_proposal *proposal = front_of(page, design);
    sp_text_add(text, "<path class=\"bound\"");
    add_stroke(page, text, design);
    sp_text_add(text, " d=\"");
    for (size_t i = 0; i < proposal->front_count; ++i) {
        double y = y_of(a, fmin(100, 100 * proposal->front[i].bound / proposal->certificate.whole));
        if (i == 0)
            sp_text_add(text, "M%d %.1f", LEFT, y);
        sp_text_add(text, "V%.1fH%.1f", y, x_of(a, 6e4 * proposal->front[i].outlay));
    }
    sp_text_add(text, "\"/>\n");
}

/* Shapes differ as well as colours. */
static void add_marker(sp_text *text, double x, double y, size_t shape, const char *colour)
{
    shape = (shape + shape / 6) % 3; /* colours come again after six */
    if (shape == 0)
        sp_text_add(text, "<path d=\"M%.1f %.1fl8 8l-8 8l-8 -8z\"", x, y - 8);
    else if (shape == 1)
        sp_text_add(text, "<rect x=\"%.1f\" y=\"%.1f\" width=\"12\" height=\"12\"", x - 6, y - 6);
    else
        sp_text_add(text, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"7.5\"", x, y);
    sp_text_add(text, " fill=\"%s\" stroke=\"#fff\" stroke-width=\"1.5\"/>\n", colour);
}

/* Lines of a legend; 0: none. */
static size_t legend_lines(const sp_page *page)
{
    size_t count = page->result->design_count;
    return count > MANY ? 0 : count + (page->result->proposal ? 1 + (count_lines(page).bounds > 0) : 0);
}

/* Characters of a legend's longest line, more or less. */
static size_t legend_letters(const sp_page *page)
{
    size_t most = page->result->proposal ? strlen("Best found for rising water") : 0;
    for (size_t i = 0; i < page->result->design_count; ++i) {
        size_t letters = strlen(page->result->designs[i].name);
        most = letters > most ? letters : most;
    }
    return most;
}

/* Whether a legend in the lower right corner would lie over a line at this height. */
static bool is_in_corner(const sp_page *page, const axes *a, double from, double to, double share)
{
    double right = WIDTH - RIGHT - LEGEND + 30 + LETTER * (double)legend_letters(page);
    return x_of(a, 6e4 * to) > WIDTH - RIGHT - LEGEND - MARKER && x_of(a, 6e4 * from) < right + MARKER &&
           y_of(a, 100 * share) > HEIGHT - BOTTOM - 12 - MARKER - 22 * (double)legend_lines(page);
}

/* Few designs are explained within the chart, where the front leaves room; more, or several fronts, below it. */
static bool is_below(const sp_page *page)
{
    size_t count = page->result->design_count;
    if (page->alternatives || count > FEW)
        return true;
    axes a = choose_axes(page);
    for (size_t i = 0; i < count; ++i) {
        const sp_proposal *proposal = front_of(page, i);
        double price = sp_page_price(page, &page->figures[i]);
        if (is_in_corner(page, &a, price, price, page->figures[i].coverage))
            return true;
        for (size_t k = 0; proposal && k < proposal->front_count; ++k)
            if (is_in_corner(page, &a, proposal->front[k].outlay,
                             k + 1 < proposal->front_count ? proposal->front[k + 1].outlay : INFINITY,
                             proposal->front[k].area / page->figures[i].clean_area))
                return true;
    }
    return false;
}

/* The place of a line's text, the designs' lines first. */
static void legend_place(const sp_page *page, size_t line, double *x, double *y)
{
    size_t count = page->result->design_count;
    bool below = is_below(page);
    *x = below ? LEFT + 26 : WIDTH - RIGHT - LEGEND + 30;
    *y = below          ? HEIGHT + 14 + 22 * (double)line
         : line < count ? HEIGHT - BOTTOM - 20 - 22 * (double)(count - 1 - line)
                        : HEIGHT - BOTTOM - 20 - 22 * (double)line;
}

/* What lines are. */
static void add_lines_legend(const sp_page *page, sp_text *text)
{
    double x, y;
    size_t count = page->result->design_count;
    legend_place(page, count, &x, &y);
    sp_text_add(text,
                "<path class=\"front\" d=\"M%g %.1fh20\"/><circle class=\"point\" cx=\"%g\" cy=\"%.1f\" "
                "r=\"3.5\"/><text class=\"legend\" x=\"%g\" y=\"%.1f\">Best found for rising %s</text>\n",
                x - 26, y - 4, x - 16, y - 4, x, y, page->costly ? "price" : "water");
    if (count_lines(page).bounds == 0)
        return;
    legend_place(page, count + 1, &x, &y);
    sp_text_add(text,
                "<path class=\"bound\" d=\"M%g %.1fh20\"/><text class=\"legend\" x=\"%g\" y=\"%.1f\">Proved: none "
                "covers more</text>\n",
                x - 26, y - 4, x, y);
}

static void add_designs(const sp_page *page, sp_text *text, const axes *a)
{
    size_t count = page->result->design_count;
    for (size_t i = 0; i < count; ++i) {
        double x, y;
        legend_place(page, i, &x, &y);
        add_marker(text, x_of(a, 6e4 * sp_page_price(page, &page->figures[i])),
                   y_of(a, 100 * page->figures[i].coverage), i, sp_page_colour(page, i));
        if (legend_lines(page) == 0)
            continue;
        add_marker(text, x - 16, y - 4, i, sp_page_colour(page, i));
        sp_text_add(text, "<text class=\"legend\" x=\"%g\" y=\"%.1f\">", x, y);
        sp_page_name(page, text, i);
        sp_text_add(text, "</text>\n");
    }
    if (page->result->proposal && legend_lines(page) > 0)
        add_lines_legend(page, text);
}

static void add_note(const sp_page *page, sp_text *text)
{
    drawn_lines lines = count_lines(page);
    sp_text_add(text,
                "<p class=\"note\">Each dot is a layout that the search found; none that it found covers more %s. ",
                page->costly ? "for as low a price" : "with as little water");
    if (lines.bounds > 0)
        sp_text_add(text, "The dashed line is what no layout of the candidates exceeds, up to the last dot, counted on "
                          "the texels of the certificate below.");
    else
        sp_text_add(text, "How far the best possible may lie above is not known.");
    if (page->alternatives)
        sp_text_add(text, " Each alternative has its own, in its colour.");
    if (lines.bounds > 0 && lines.bounds < lines.fronts)
        sp_text_add(text, " Where it has no dashed line, how far the best possible may lie above is not known.");
    sp_text_add(text, "</p>\n");
}

void sp_page_front_chart(const sp_page *page, sp_text *text)
{
    bool front = page->result->proposal && page->result->proposal->front_count > 0;
    if (!front && page->result->design_count < 2)
        return;
    axes a = choose_axes(page);
    sp_text_add(text,
                "<section id=\"front\"><h2>Coverage against %s</h2>\n<div class=\"wide\"><svg class=\"chart\" "
                "viewBox=\"0 0 %d %d\" "
                "role=\"img\" aria-label=\"Chart: coverage in per cent against %s in litres a minute\">\n",
                page->costly ? "price" : "water", WIDTH,
                HEIGHT + (is_below(page) ? 22 * (int)legend_lines(page) + 8 : 0), page->costly ? "price" : "water");
    add_grid(page, text, &a);
    for (size_t i = 0; i < page->result->design_count; ++i)
        add_bound(page, text, &a, i);
    for (size_t i = 0; i < page->result->design_count; ++i)
        add_front(page, text, &a, i);
    add_designs(page, text, &a);
    sp_text_add(text, "</svg></div>\n");
    if (front)
        add_note(page, text);
    sp_text_add(text, "</section>\n");
}
