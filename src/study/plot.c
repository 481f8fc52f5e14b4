#include "plot.h"

#include "report/markup.h"

#include <math.h>

#define WIDTH 900
#define HEIGHT 400
#define LEFT 70
#define RIGHT 290 /* the legend's */
#define TOP 16
#define BOTTOM 56
#define MOST_TICKS 60

typedef struct {
    double low, high; /* of the data, or their logarithms */
    bool log;
    double ticks[MOST_TICKS]; /* in the data's unit */
    bool named[MOST_TICKS];   /* the tick has a number */
    size_t count;
} axis;

static double scaled(const axis *a, double value)
{
    return a->log ? log10(value) : value;
}

static bool shown(const axis *a, double value)
{
    return isfinite(value) && (!a->log || value > 0);
}

static double across(const axis *a, double value)
{
    return (scaled(a, value) - a->low) / (a->high - a->low);
}

static double x_of(const axis *x, double value)
{
    return LEFT + (WIDTH - LEFT - RIGHT) * across(x, value);
}

static double y_of(const axis *y, double value)
{
    return HEIGHT - BOTTOM - (HEIGHT - TOP - BOTTOM) * across(y, value);
}

/* 1, 2 or 5 times a power of ten, about a fifth of the range. */
static double nice_step(double range)
{
    double rough = range / 5, power = pow(10, floor(log10(rough))), share = rough / power;
    return power * (share < 1.5 ? 1 : share < 3.5 ? 2 : share < 7.5 ? 5 : 10);
}

static void add_tick(axis *a, double value, bool named)
{
    if (a->count < MOST_TICKS) {
        a->ticks[a->count] = value;
        a->named[a->count++] = named;
    }
}

static void mark_linear(axis *a)
{
    double range = a->high > a->low ? a->high - a->low : fmax(0.1 * fabs(a->high), 1e-6), step = nice_step(1.1 * range);
    double middle = 0.5 * (a->high + a->low);
    double first = floor((middle - 0.55 * range) / step), last = ceil((middle + 0.55 * range) / step);
    a->low = first * step;
    a->high = last * step;
    for (double i = first; i <= last; i++)
        add_tick(a, i * step, true);
}

/* Ticks at 1, 2 and 5, or at powers of ten alone where there are many of these; at even steps where these are few. */
static void mark_log(axis *a)
{
    double range = fmax(a->high - a->low, 0.05);
    a->low -= 0.06 * range;
    a->high += 0.06 * range;
    static const double parts[] = {1, 2, 5};
    for (double power = floor(a->low); power <= a->high; power++)
        for (int i = 0; i < 3; i++) {
            double value = parts[i] * pow(10, power);
            if (log10(value) >= a->low && log10(value) <= a->high && (i == 0 || range < 5))
                add_tick(a, value, i == 0 || range < 3);
        }
    if (a->count >= 3)
        return;
    a->count = 0;
    double low = pow(10, a->low), high = pow(10, a->high), step = nice_step(high - low);
    for (double i = ceil(low / step); i * step <= high; i++)
        add_tick(a, i * step, true);
}

static void stretch(axis *a, double value)
{
    if (!shown(a, value))
        return;
    a->low = fmin(a->low, scaled(a, value));
    a->high = fmax(a->high, scaled(a, value));
}

static bool visible(const axis *x, const axis *y, const sp_plot_point *point)
{
    return shown(x, point->x) && shown(y, point->y);
}

static bool choose_axes(const sp_plot *plot, axis *x, axis *y)
{
    *x = (axis){.low = INFINITY, .high = -INFINITY, .log = plot->log_x};
    *y = (axis){.low = INFINITY, .high = -INFINITY, .log = plot->log_y};
    for (size_t i = 0; i < plot->count; i++)
        for (size_t k = 0; k < plot->series[i].count; k++) {
            const sp_plot_point *point = &plot->series[i].points[k];
            if (!visible(x, y, point))
                continue;
            stretch(x, point->x);
            stretch(y, point->y);
            stretch(y, point->low);
            stretch(y, point->high);
        }
    if (!(x->low <= x->high))
        return false;
    x->log ? mark_log(x) : mark_linear(x);
    y->log ? mark_log(y) : mark_linear(y);
    return true;
}

/* No more digits than the value has, no exponent between a millionth and a million. */
static void add_number(sp_text *text, double value)
{
    if (fabs(value) >= 1e7 || (value != 0 && fabs(value) < 1e-5))
        sp_text_add(text, "%.3g", value);
    else
        sp_text_add(text, "%.8g", round(value * 1e8) / 1e8);
}

static void add_axes(sp_text *text, const sp_plot *plot, const axis *x, const axis *y)
{
    for (size_t i = 0; i < y->count; i++) {
        double at = y_of(y, y->ticks[i]);
        sp_text_add(text, "<line class=\"grid\" x1=\"%d\" x2=\"%d\" y1=\"%.1f\" y2=\"%.1f\"/>", LEFT, WIDTH - RIGHT, at,
                    at);
        if (!y->named[i])
            continue;
        sp_text_add(text, "<text x=\"%d\" y=\"%.1f\" text-anchor=\"end\">", LEFT - 8, at + 4);
        add_number(text, y->ticks[i]);
        sp_text_add(text, "</text>\n");
    }
    for (size_t i = 0; i < x->count; i++) {
        double at = x_of(x, x->ticks[i]);
        sp_text_add(text, "<line class=\"grid\" x1=\"%.1f\" x2=\"%.1f\" y1=\"%d\" y2=\"%d\"/>", at, at, TOP,
                    HEIGHT - BOTTOM);
        if (!x->named[i])
            continue;
        sp_text_add(text, "<text x=\"%.1f\" y=\"%d\" text-anchor=\"middle\">", at, HEIGHT - BOTTOM + 20);
        add_number(text, x->ticks[i]);
        sp_text_add(text, "</text>\n");
    }
    sp_text_add(text,
                "<text class=\"axis\" x=\"%d\" y=\"%d\" text-anchor=\"middle\">%s</text>\n<text class=\"axis\" "
                "transform=\"translate(18 %d) rotate(-90)\" text-anchor=\"middle\">%s</text>\n",
                (LEFT + WIDTH - RIGHT) / 2, HEIGHT - 12, plot->x_title, (TOP + HEIGHT - BOTTOM) / 2, plot->y_title);
}

/* Shapes differ as well as colours. */
static void add_marker(sp_text *text, double x, double y, const sp_plot_series *series)
{
    switch (series->shape) {
    case 0:
        sp_text_add(text, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"4.5\"", x, y);
        break;
    case 1:
        sp_text_add(text, "<rect x=\"%.1f\" y=\"%.1f\" width=\"8\" height=\"8\"", x - 4, y - 4);
        break;
    case 2:
        sp_text_add(text, "<path d=\"M%.1f %.1fl5.5 5.5l-5.5 5.5l-5.5 -5.5z\"", x, y - 5.5);
        break;
    case 3:
        sp_text_add(text, "<path d=\"M%.1f %.1fl5.5 9h-11z\"", x, y - 5.5);
        break;
    case 4:
        sp_text_add(text,
                    "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"7.5\" fill=\"none\" stroke=\"%s\" stroke-width=\"1.5\"/>\n", x,
                    y, series->colour);
        return;
    case 5:
        sp_text_add(text, "<path d=\"M%.1f %.1fl9 9l-9 9l-9 -9z\"", x, y - 9);
        break;
    default:
        return;
    }
    sp_text_add(text, " fill=\"%s\" stroke=\"#fff\" stroke-width=\"1\"/>\n", series->colour);
}

static void add_line(sp_text *text, const axis *x, const axis *y, const sp_plot_series *series)
{
    bool begun = false;
    for (size_t i = 0; i < series->count; i++) {
        const sp_plot_point *point = &series->points[i];
        if (!visible(x, y, point))
            continue;
        double to_x = x_of(x, point->x), to_y = y_of(y, point->y);
        if (!begun)
            sp_text_add(text, "<path fill=\"none\" stroke=\"%s\" stroke-width=\"1.5\"%s d=\"M%.1f %.1f", series->colour,
                        series->stepped ? " stroke-dasharray=\"5 4\"" : "", to_x, to_y);
        else
            sp_text_add(text, series->stepped ? "H%.1fV%.1f" : "L%.1f %.1f", to_x, to_y);
        begun = true;
    }
    if (begun)
        sp_text_add(text, "\"/>\n");
}

static void add_series(sp_text *text, const axis *x, const axis *y, const sp_plot_series *series)
{
    if (series->joined || series->stepped)
        add_line(text, x, y, series);
    for (size_t i = 0; i < series->count; i++) {
        const sp_plot_point *point = &series->points[i];
        if (!visible(x, y, point))
            continue;
        if (shown(y, point->low) && shown(y, point->high))
            sp_text_add(
                text, "<line x1=\"%.1f\" x2=\"%.1f\" y1=\"%.1f\" y2=\"%.1f\" stroke=\"%s\" stroke-width=\"1.5\"/>\n",
                x_of(x, point->x), x_of(x, point->x), y_of(y, point->low), y_of(y, point->high), series->colour);
        add_marker(text, x_of(x, point->x), y_of(y, point->y), series);
    }
}

static void add_legend(sp_text *text, const sp_plot *plot)
{
    double y = TOP + 14;
    for (size_t i = 0; i < plot->count; i++) {
        const sp_plot_series *series = &plot->series[i];
        if (series->count == 0)
            continue;
        if (series->joined || series->stepped)
            sp_text_add(text, "<path fill=\"none\" stroke=\"%s\" stroke-width=\"1.5\"%s d=\"M%d %.1fh22\"/>",
                        series->colour, series->stepped ? " stroke-dasharray=\"5 4\"" : "", WIDTH - RIGHT + 13, y - 4);
        add_marker(text, WIDTH - RIGHT + 24, y - 4, series);
        sp_text_add(text, "<text class=\"legend\" x=\"%d\" y=\"%.1f\">", WIDTH - RIGHT + 42, y);
        sp_markup_escape(text, series->name);
        sp_text_add(text, "</text>\n");
        y += 22;
    }
}

void sp_plot_draw(sp_text *text, const sp_plot *plot)
{
    axis x, y;
    if (!choose_axes(plot, &x, &y))
        return;
    sp_text_add(text, "<svg class=\"chart\" viewBox=\"0 0 %d %d\" role=\"img\" aria-label=\"%s\">\n", WIDTH, HEIGHT,
                plot->label);
    add_axes(text, plot, &x, &y);
    for (size_t i = 0; i < plot->count; i++)
        add_series(text, &x, &y, &plot->series[i]);
    add_legend(text, plot);
    sp_text_add(text, "</svg>\n");
}
