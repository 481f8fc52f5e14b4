/* What the colours of the pictures mean: the bar with its ticks and what the criterion asks for, and the swatches. */
#include "page.h"

#include <sprayplan/image.h>

#include <stdlib.h>

#define STOPS 16
#define LEFT 32.0 /* of the bar, in the drawing's units: half a long tick's figure has room before it */
#define LENGTH 378.0
#define MOST_NAMES 60 /* characters of the names of designs in a line */
#define LINE 20       /* of a criterion's text */
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

/* `value` in the reader's unit. What lies beyond the scale's end has the colour of the end. */
static void add_tick(const sp_colour_scale *scale, sp_text *text, double value)
{
    double si = value / sp_quantity_words_of[scale->style.quantity].to_unit;
    double x = LEFT + LENGTH * sp_colour_scale_place(scale, si);
    bool first = scale->below && si <= scale->low * (1 + 1e-9), last = scale->above && si >= scale->high * (1 - 1e-9);
    sp_text_add(text,
                "<path class=\"tick\" d=\"M%.1f 38v6\"/><text x=\"%.1f\" y=\"58\" text-anchor=\"middle\">%s%g</text>",
                x, x,
                first  ? "\xe2\x89\xa4 "
                : last ? "\xe2\x89\xa5 "
                       : "",
                value);
}

/* Points at the ends beyond which there are values. */
static void add_points(const sp_colour_scale *scale, sp_text *text)
{
    uint8_t rgb[3];
    for (int end = 0; end < 2; ++end) {
        if (!(end ? scale->above : scale->below))
            continue;
        sp_colour_of(scale->style.colours, end, rgb);
        sp_text_add(text, "<path class=\"beyond\" d=\"M%g 20l%d 9l%d 9z\" fill=\"#%02x%02x%02x\"/>",
                    LEFT + end * LENGTH, end ? 10 : -10, end ? -10 : 10, rgb[0], rgb[1], rgb[2]);
    }
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

/* One field for each step: below what is asked, or that and more; between two that are asked, from one to the other. */
static void add_steps(const sp_colour_scale *scale, sp_text *text, const sp_quantity_words *words)
{
    int last = scale->threshold_count;
    double width = LENGTH / (last + 1);
    for (int i = 0; i <= last; ++i) {
        uint8_t rgb[3];
        double x = LEFT + i * width, from = words->to_unit * scale->thresholds[i ? i - 1 : 0];
        sp_colour_of(scale->style.colours, sp_colour_scale_step(scale, i), rgb);
        sp_text_add(text,
                    "<rect x=\"%g\" y=\"20\" width=\"%g\" height=\"18\" fill=\"#%02x%02x%02x\"/><text x=\"%g\" "
                    "y=\"58\" text-anchor=\"middle\">%s%.4g",
                    x, width, rgb[0], rgb[1], rgb[2], x + width / 2, i ? "" : "below ", from);
        if (i > 0 && i < last)
            sp_text_add(text, " to %.4g</text>", words->to_unit * scale->thresholds[i]);
        else /* the unit stands above: among many steps it has no room */
            sp_text_add(text, "%s%s%s</text>", last > 1 ? "" : " ", last > 1 ? "" : words->unit, i ? " or more" : "");
    }
}

/* A line across the bar where something is asked for. */
static void add_mark(const sp_colour_scale *scale, sp_text *text, double threshold)
{
    double x = LEFT + LENGTH * sp_colour_scale_place(scale, threshold);
    sp_text_add(text,
                "<path d=\"M%.1f 20v18\" stroke=\"#fff\" stroke-width=\"5\"/><path class=\"tick\" d=\"M%.1f 15v26\" "
                "stroke-width=\"2\"/>",
                x, x);
}

/* "asked for by one.yaml, two.yaml": whose it is, as far as there is room. */
static void add_askers(const sp_page *page, sp_text *text, double threshold)
{
    sp_text names = {0}, name = {0};
    size_t left_out = 0;
    for (size_t i = 0; i < page->result->design_count; ++i) {
        const sp_design *design = &page->result->designs[i];
        if (!design->evaluator || sp_colour_threshold(design, page->scale.style.quantity) != threshold)
            continue;
        sp_page_plain_name(page, &name, i);
        if (name.failed || names.failed || names.length + name.length > MOST_NAMES)
            left_out++;
        else
            sp_text_add(&names, "%s%s", names.length ? ", " : "", name.text);
        text->failed |= name.failed || names.failed;
        free(name.text);
        name = (sp_text){0};
    }
    if (names.length) {
        sp_text_add(text, " by ");
        sp_markup_escape(text, names.text);
    }
    if (left_out)
        sp_text_add(text, names.length ? " and %zu more" : " by %zu", left_out);
    free(names.text);
}

/* Where criteria differ, a line of text for each, below all else. */
static int lines_of_criteria(const sp_page *page)
{
    const sp_colour_scale *scale = &page->scale;
    bool marked = scale->style.quantity != SP_QUANTITY_COVERED && scale->style.quantity != SP_QUANTITY_CHARTS;
    return marked && scale->threshold_count > 1 ? scale->threshold_count : 0;
}

/* What a mark means, so far down; whose criterion it is where they differ. */
static void add_criterion(const sp_page *page, sp_text *text, double threshold, double x, int top)
{
    const sp_quantity_words *words = &sp_quantity_words_of[page->scale.style.quantity];
    bool marked = page->scale.style.shades != SP_SHADES_STEPPED;
    if (marked)
        sp_text_add(text, "<path class=\"tick\" d=\"M%g %dv16\" stroke-width=\"2\"/>", x, top);
    sp_text_add(text, "<text x=\"%g\" y=\"%d\">asked for", marked ? x + 26 : x, top + 13);
    if (lines_of_criteria(page))
        add_askers(page, text, threshold);
    sp_text_add(text, ": at %s %.4g %s</text>\n", most_is_asked(page->scale.style.quantity) ? "most" : "least",
                words->to_unit * threshold, words->unit);
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

/* Marks across the bar and what they mean: one beside the swatches, more below all else. */
static void add_criteria(const sp_page *page, sp_text *text, int height, bool film)
{
    const sp_colour_scale *scale = &page->scale;
    bool stepped = scale->style.shades == SP_SHADES_STEPPED; /* says itself where it parts */
    if (scale->style.quantity == SP_QUANTITY_COVERED)        /* of which no criterion asks for a share */
        return;
    for (int i = 0; i < scale->threshold_count && !stepped; ++i)
        add_mark(scale, text, scale->thresholds[i]);
    for (int i = 0; i < lines_of_criteria(page); ++i)
        add_criterion(page, text, scale->thresholds[i], LEFT, height + LINE * i);
    if (scale->threshold_count == 1 && !stepped)
        add_criterion(page, text, scale->thresholds[0], 468, film ? 67 : 45);
}

static void add_scale(const sp_colour_scale *scale, sp_text *text)
{
    const sp_quantity_words *words = &sp_quantity_words_of[scale->style.quantity];
    if (scale->style.shades == SP_SHADES_STEPPED) {
        add_steps(scale, text, words);
        return;
    }
    sp_text_add(text, "<rect x=\"%g\" y=\"20\" width=\"%g\" height=\"18\" fill=\"url(#ramp)\"/>", LEFT, LENGTH);
    add_points(scale, text);
    if (scale->style.shades == SP_SHADES_LOG)
        add_ratio_ticks(scale, text, words->to_unit * scale->low, words->to_unit * scale->high);
    else
        add_even_ticks(scale, text, words->to_unit * scale->high);
}

void sp_page_colour_bar(const sp_page *page, sp_text *text)
{
    const sp_colour_scale *scale = &page->scale;
    const sp_quantity_words *words = &sp_quantity_words_of[scale->style.quantity];
    bool charts = scale->style.quantity == SP_QUANTITY_CHARTS, film = !charts && shows_film(page);
    int height = film ? 86 : 64, lines = LINE * lines_of_criteria(page);
    sp_text_add(text,
                "<div class=\"wide\"><svg class=\"bar\" viewBox=\"0 0 860 %d\" role=\"img\" aria-label=\"Colour bar: "
                "%s%s%s, %s; grey: needs "
                "no cleaning\">\n<defs>",
                height + lines, words->name, *words->unit ? ", " : "", words->unit,
                charts ? "neighbours in different colours"
                       : "from dark for little to light for much; hatched red: not covered");
    add_gradient(text, scale->style.colours);
    add_hatch(text);
    sp_text_add(text, "</defs>\n<text x=\"%g\" y=\"%d\">%s%s%s%s</text>", LEFT, charts ? 34 : 13, words->name,
                *words->unit ? ", " : "", words->unit, charts ? ": each a colour unlike its neighbours'" : "");
    if (!charts) {
        add_scale(scale, text);
        add_criteria(page, text, height, film);
    }
    add_swatches(text, !charts, film);
    sp_text_add(text, "</svg></div>\n");
}
