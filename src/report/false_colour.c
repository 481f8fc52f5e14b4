#include "false_colour.h"

#include <sprayplan/image.h>

#include <string.h>

const uint8_t sp_colour_hatch[2][3] = {{250, 248, 245}, {196, 38, 54}};
const uint8_t sp_colour_obstacle[3] = {172, 178, 184};
const uint8_t sp_colour_film[3] = {152, 203, 243};

const sp_quantity_words sp_quantity_words_of[SP_QUANTITIES] = {
    [SP_QUANTITY_FLUX] = {"Liquid flux", "L/min per m\xc2\xb2", 6e4},
    [SP_QUANTITY_SPEED] = {"Impact speed, mean", "m/s", 1},
    [SP_QUANTITY_SPEED_MAX] = {"Impact speed, greatest", "m/s", 1},
    [SP_QUANTITY_INCIDENCE] = {"Incidence, mean", "deg", 180 / M_PI},
    [SP_QUANTITY_INCIDENCE_MIN] = {"Incidence, least", "deg", 180 / M_PI},
    [SP_QUANTITY_IMPACT] = {"Impact pressure, mean", "Pa", 1},
    [SP_QUANTITY_IMPACT_MAX] = {"Impact pressure, greatest", "Pa", 1},
    [SP_QUANTITY_JETS] = {"Jets that arrive", "", 1},
    [SP_QUANTITY_COVERED] = {"Covered share", "%", 100},
    [SP_QUANTITY_CHARTS] = {"Charts of the atlas", "", 1},
};

double sp_quantity_value(const sp_deposits *deposits, sp_quantity quantity, size_t patch)
{
    const double *const values[SP_QUANTITIES] = {
        deposits->flux,   deposits->speed,      deposits->speed_max, deposits->incidence, deposits->incidence_min,
        deposits->impact, deposits->impact_max, deposits->jets,      deposits->share,     NULL};
    return values[quantity] ? values[quantity][patch] : 0;
}

#define BINS 1000
#define BINS_A_DECADE 50.0
#define LOWEST -14.0 /* log10 of the value at bin 0 */

/* The value below which `share` of the area lies, to a fiftieth of a decade. */
static double percentile(const double bins[BINS], double total, double share)
{
    double below = 0;
    for (int i = 0; i < BINS; ++i) {
        below += bins[i];
        if (below >= share * total)
            return pow(10, LOWEST + (i + 0.5) / BINS_A_DECADE);
    }
    return pow(10, LOWEST + BINS / BINS_A_DECADE);
}

/* 1, 2 or 5 times a power of ten, next to `value` downwards or upwards. */
static double rounded(double value, bool upwards)
{
    const double steps[] = {1, 2, 5, 10};
    double power = pow(10, floor(log10(value)));
    double best = power;
    for (int i = 0; i < 4; ++i) {
        bool far_enough = steps[i] * power >= value * (1 - 1e-9);
        if (upwards && far_enough)
            return steps[i] * power;
        if (steps[i] * power <= value * (1 + 1e-9))
            best = steps[i] * power;
    }
    return best;
}

/* The next round number upwards, less far off than 1, 2 or 5 times a power of ten. */
static double rounded_closely(double value)
{
    const double steps[] = {1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10};
    double power = pow(10, floor(log10(value)));
    size_t i = 0;
    while (steps[i] * power < value * (1 - 1e-9) && i + 1 < sizeof steps / sizeof *steps)
        i++;
    return steps[i] * power;
}

double sp_colour_threshold(const sp_design *design, sp_quantity quantity)
{
    const sp_criterion *criterion = &sp_evaluator_setup(design->evaluator)->criterion;
    switch (quantity) {
    case SP_QUANTITY_FLUX:
        return criterion->flux;
    case SP_QUANTITY_SPEED:
    case SP_QUANTITY_SPEED_MAX:
        return criterion->impact_speed;
    case SP_QUANTITY_INCIDENCE:
    case SP_QUANTITY_INCIDENCE_MIN:
        return criterion->incidence < M_PI / 2 ? criterion->incidence : 0;
    default:
        return quantity == SP_QUANTITY_COVERED ? 0.5 : 0;
    }
}

/* Keeps them in ascending order, each value once; of too many the least. */
static int add_threshold(double thresholds[SP_COLOUR_THRESHOLDS], int count, double threshold)
{
    int at = 0;
    while (at < count && thresholds[at] < threshold)
        at++;
    if (!(threshold > 0) || at == SP_COLOUR_THRESHOLDS || (at < count && thresholds[at] == threshold))
        return count;
    count += count < SP_COLOUR_THRESHOLDS;
    for (int i = count - 1; i > at; --i)
        thresholds[i] = thresholds[i - 1];
    thresholds[at] = threshold;
    return count;
}

int sp_colour_thresholds(const sp_design *designs, size_t count, sp_quantity quantity,
                         double thresholds[SP_COLOUR_THRESHOLDS])
{
    int found = 0;
    for (size_t i = 0; i < count; ++i)
        if (designs[i].evaluator)
            found = add_threshold(thresholds, found, sp_colour_threshold(&designs[i], quantity));
    return found;
}

/* How the area is spread over a quantity's values, of all designs. */
typedef struct {
    double bins[BINS]; /* m² */
    double total;
    double least, most;    /* SI */
    bool nothing_is_asked; /* by the criterion of some design */
} spread;

static void add_design(spread *s, const sp_design *design, sp_quantity quantity)
{
    const sp_patches *patches = sp_evaluator_patches(design->evaluator);
    const sp_deposits *deposits = &design->coverage->deposits;
    for (size_t k = 0; k < patches->count; ++k) {
        double value = sp_quantity_value(deposits, quantity, k);
        bool hidden = quantity == SP_QUANTITY_FLUX && (!deposits->covered[k] || deposits->by_film[k]);
        if (hidden || !(value > 0))
            continue;
        double bin = fmin(fmax((log10(value) - LOWEST) * BINS_A_DECADE, 0), BINS - 1);
        s->bins[(int)bin] += patches->area[k];
        s->least = s->total > 0 ? fmin(s->least, value) : value;
        s->most = fmax(s->most, value);
        s->total += patches->area[k];
    }
}

/* Round figures in the unit that the reader sees. */
static void set_ends(sp_colour_scale *scale, const spread *s)
{
    sp_quantity quantity = scale->style.quantity;
    double unit = sp_quantity_words_of[quantity].to_unit;
    double most = s->total > 0 ? unit * percentile(s->bins, s->total, 0.99) : 100;
    double least = s->total > 0 ? unit * percentile(s->bins, s->total, 0.01) : 1;
    if (scale->style.shades != SP_SHADES_LOG) {
        bool angle = quantity == SP_QUANTITY_INCIDENCE || quantity == SP_QUANTITY_INCIDENCE_MIN;
        scale->low = 0;
        scale->high = angle ? M_PI / 2 : quantity == SP_QUANTITY_COVERED ? 1 : rounded_closely(most) / unit;
        return;
    }
    /* Where a design covers by less than others ask for, its colours have to tell it all the same. */
    if (s->total > 0 && quantity == SP_QUANTITY_FLUX && scale->threshold_count > 0)
        least = fmin(s->nothing_is_asked ? least : INFINITY, unit * scale->thresholds[0]);
    double high = rounded(most, true), low = fmax(rounded(least, false), high / 1000);
    if (high < 5 * low)
        high = rounded(5 * low, true);
    scale->low = low / unit;
    scale->high = high / unit;
}

sp_colour_scale sp_colour_scale_of(const sp_design *designs, size_t count, sp_picture_style style)
{
    sp_colour_scale scale = {.style = style};
    spread s = {0};
    bool even = style.quantity != SP_QUANTITY_FLUX && style.quantity != SP_QUANTITY_JETS &&
                style.quantity != SP_QUANTITY_IMPACT && style.quantity != SP_QUANTITY_IMPACT_MAX;
    if (style.quantity == SP_QUANTITY_CHARTS)
        return scale;
    for (size_t i = 0; i < count; ++i) {
        if (!designs[i].evaluator)
            continue;
        add_design(&s, &designs[i], style.quantity);
        s.nothing_is_asked |= !(sp_colour_threshold(&designs[i], style.quantity) > 0);
    }
    scale.threshold_count = sp_colour_thresholds(designs, count, style.quantity, scale.thresholds);
    if (style.shades == SP_SHADES_AUTO || (style.shades == SP_SHADES_STEPPED && scale.threshold_count == 0))
        scale.style.shades = even ? SP_SHADES_LINEAR : SP_SHADES_LOG;
    set_ends(&scale, &s);
    scale.below = s.total > 0 && s.least < scale.low * (1 - 1e-9);
    scale.above = s.total > 0 && s.most > scale.high * (1 + 1e-9);
    return scale;
}

double sp_colour_scale_step(const sp_colour_scale *scale, int steps)
{
    return 0.15 + 0.7 * steps / scale->threshold_count;
}

double sp_colour_scale_place(const sp_colour_scale *scale, double value)
{
    if (scale->style.shades == SP_SHADES_STEPPED) {
        int steps = 0;
        while (steps < scale->threshold_count && value >= scale->thresholds[steps])
            steps++;
        return sp_colour_scale_step(scale, steps);
    }
    if (!(value > scale->low))
        return 0;
    double place = scale->style.shades == SP_SHADES_LOG ? log(value / scale->low) / log(scale->high / scale->low)
                                                        : (value - scale->low) / (scale->high - scale->low);
    return fmin(place, 1);
}

void sp_false_colour(const sp_colour_scale *scale, const sp_deposits *deposits, uint32_t patch, int stripe,
                     uint8_t rgb[3])
{
    sp_quantity quantity = scale->style.quantity;
    bool arrives = deposits->flux[patch] > 0;
    if (deposits->by_film[patch] && (quantity == SP_QUANTITY_FLUX || !arrives))
        memcpy(rgb, sp_colour_film, 3);
    else if (deposits->covered[patch] || (quantity != SP_QUANTITY_FLUX && arrives && !stripe))
        sp_colour_of(scale->style.colours, sp_colour_scale_place(scale, sp_quantity_value(deposits, quantity, patch)),
                     rgb);
    else
        memcpy(rgb, sp_colour_hatch[stripe], 3);
}
