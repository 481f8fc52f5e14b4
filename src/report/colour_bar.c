/* What the colours of the pictures mean: the bar with its ticks and what the criterion asks for, and the swatches. */
#include "page.h"

#include <sprayplan/image.h>

#define STOPS 16
#define LEFT 10.0
#define LENGTH 400.0 /* of the bar, in the drawing's units */
#define MOST_TICKS 8
#define WIDE_RATIO 200.0 /* of a scale by ratios: beyond, whole decades alone have ticks */

static void add_hatch(sp_text *text)
{
    sp_text_add(
        text,
        "<pattern id=\"hatch\" width=\"8\" height=\"8\" patternUnits=\"userSpaceOnUse\" "
        "patternTransform=\"rotate(45)\"><rect width=\"8\" height=\"8\" fill=\"#%02x%02x%02x\"/><rect width=\"2.2\" "
        "height=\"8\" fill=\"#%02x%02x%02x\"/></pattern>",
        sp_colour_hatch[0][0], sp_colour_hatch[0][1], sp_colour_hatch[0][2], sp_colour_hatch[1][0],
        sp_colour_hatch[1][1], sp_colour_hatch[1][2]);
}

static void add_gradient(sp_text *text, sp_colours colours)
{
    sp_text_add(text, "<linearGradient id=\"ramp\">");
    for (int i = 0; i <= STOPS; ++i) {
        uint8_t rgb[3];
        sp_colour_of(colours, (double)i / STOPS, rgb);
        sp_text_add(text, "<stop offset=\"%g\" stop-color=\"#%02x%02x%02x\"/>", (double)i / STOPS, rgb[0], rgb[1],
                    rgb[2]);
    }
    sp_text_add(text, "</linearGradient>");
}

/* `value` in the reader's unit. */
static void add_tick(const sp_colour_scale *scale, sp_text *text, double value)
{
    double x =
        LEFT + LENGTH * sp_colour_scale_place(scale, value / sp_quantity_words_of[scale->style.quantity].to_unit);
    sp_text_add(text,
                "<path class=\"tick\" d=\"M%.1f 38v6\"/><text x=\"%.1f\" y=\"58\" text-anchor=\"middle\">%g</text>", x,
                x, value);
}

static void add_ratio_ticks(const sp_colour_scale *scale, sp_text *text, double low, double high)
{
    const double steps[] = {1, 2, 5};
    int each = high / low > WIDE_RATIO ? 1 : 3;
    for (int power = (int)floor(log10(low)) - 1; power <= (int)ceil(log10(high)); ++power)
        for (int k = 0; k < each; ++k) {
            double value = steps[k] * pow(10, power);
            if (value >= low * (1 - 1e-9) && value <= high * (1 + 1e-9))
                add_tick(scale, text, value);
        }
}

static void add_even_ticks(const sp_colour_scale *scale, sp_text *text, double high)
{
    double power = pow(10, floor(log10(high / MOST_TICKS))), step = power;
    while (high / step > MOST_TICKS * (1 + 1e-9))
        step = step < 1.5 * power ? 2 * power : step < 4 * power ? 5 * power : 10 * power;
    for (int i = 0; i * step <= high * (1 + 1e-9); ++i)
        add_tick(scale, text, i * step);
}

static bool most_is_asked(sp_quantity quantity)
{
    return quantity == SP_QUANTITY_INCIDENCE || quantity == SP_QUANTITY_INCIDENCE_MIN;
}

static void add_steps(const sp_colour_scale *scale, sp_text *text, double threshold, const char *unit)
{
    for (int i = 0; i < 2; ++i) {
        uint8_t rgb[3];
        double x = LEFT + i * LENGTH / 2;
        sp_colour_of(scale->style.colours, i ? 0.85 : 0.15, rgb);
        sp_text_add(text,
                    "<rect x=\"%g\" y=\"20\" width=\"%g\" height=\"18\" fill=\"#%02x%02x%02x\"/><text x=\"%g\" "
                    "y=\"58\" text-anchor=\"middle\">%s%.4g %s%s</text>",
                    x, LENGTH / 2, rgb[0], rgb[1], rgb[2], x + LENGTH / 4, i ? "" : "below ", threshold, unit,
                    i ? " or more" : "");
    }
}

/* A line across the bar, and what it means, so far down. */
static void add_criterion(const sp_colour_scale *scale, sp_text *text, double threshold, const char *unit, int top)
{
    double x = LEFT + LENGTH * sp_colour_scale_place(scale, scale->threshold);
    sp_text_add(text,
                "<path d=\"M%.1f 20v18\" stroke=\"#fff\" stroke-width=\"5\"/><path class=\"tick\" d=\"M%.1f 15v26\" "
                "stroke-width=\"2\"/><path class=\"tick\" d=\"M468 %dv16\" stroke-width=\"2\"/><text x=\"494\" "
                "y=\"%d\">asked for: at %s %.4g %s</text>\n",
                x, x, top, top + 13, most_is_asked(scale->style.quantity) ? "most" : "least", threshold, unit);
}

static bool shows_film(const sp_page *page)
{
    for (size_t i = 0; i < page->result->design_count; ++i)
        if (page->result->designs[i].evaluator && page->figures[i].film.known)
            return true;
    return false;
}

static void add_swatches(sp_text *text, bool hatched, bool film)
{
    if (hatched)
        sp_text_add(text, "<rect class=\"swatch\" x=\"450\" y=\"20\" width=\"36\" height=\"18\" fill=\"url(#hatch)\"/>"
                          "<text x=\"494\" y=\"34\">not covered</text>");
    sp_text_add(text,
                "<rect class=\"swatch\" x=\"600\" y=\"20\" width=\"36\" height=\"18\" fill=\"#%02x%02x%02x\"/><text "
                "x=\"644\" y=\"34\">no cleaning asked</text>\n",
                sp_colour_obstacle[0], sp_colour_obstacle[1], sp_colour_obstacle[2]);
    if (film)
        sp_text_add(text,
                    "<rect class=\"swatch\" x=\"450\" y=\"44\" width=\"36\" height=\"18\" "
                    "fill=\"#%02x%02x%02x\"/><text x=\"494\" y=\"58\">covered by film alone</text>\n",
                    sp_colour_film[0], sp_colour_film[1], sp_colour_film[2]);
}

static void add_scale(const sp_colour_scale *scale, sp_text *text, bool film)
{
    const sp_quantity_words *words = &sp_quantity_words_of[scale->style.quantity];
    double threshold = words->to_unit * scale->threshold;
    if (scale->style.shades == SP_SHADES_STEPPED) {
        add_steps(scale, text, threshold, words->unit);
        return;
    }
    sp_text_add(text, "<rect x=\"%g\" y=\"20\" width=\"%g\" height=\"18\" fill=\"url(#ramp)\"/>", LEFT, LENGTH);
    if (scale->style.shades == SP_SHADES_LOG)
        add_ratio_ticks(scale, text, words->to_unit * scale->low, words->to_unit * scale->high);
    else
        add_even_ticks(scale, text, words->to_unit * scale->high);
    if (threshold > 0 && scale->style.quantity != SP_QUANTITY_COVERED) /* of which no criterion asks for a share */
        add_criterion(scale, text, threshold, words->unit, film ? 67 : 45);
}

void sp_page_colour_bar(const sp_page *page, sp_text *text)
{
    const sp_colour_scale *scale = &page->scale;
    const sp_quantity_words *words = &sp_quantity_words_of[scale->style.quantity];
    bool charts = scale->style.quantity == SP_QUANTITY_CHARTS, film = !charts && shows_film(page);
    sp_text_add(
        text,
        "<svg class=\"bar\" viewBox=\"0 0 860 %d\" role=\"img\" aria-label=\"Colour bar: %s%s%s, %s; grey: needs "
        "no cleaning\">\n<defs>",
        film ? 86 : 64, words->name, *words->unit ? ", " : "", words->unit,
        charts ? "neighbours in different colours"
               : "from dark for little to light for much; hatched red: not covered");
    add_gradient(text, scale->style.colours);
    add_hatch(text);
    sp_text_add(text, "</defs>\n<text x=\"10\" y=\"%d\">%s%s%s%s</text>", charts ? 34 : 13, words->name,
                *words->unit ? ", " : "", words->unit, charts ? ": each a colour unlike its neighbours'" : "");
    if (!charts)
        add_scale(scale, text, film);
    add_swatches(text, !charts, film);
    sp_text_add(text, "</svg>\n");
}
