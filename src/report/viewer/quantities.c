#include "quantities.h"

#define DECADES 5.0 /* of a logarithmic scale's bytes: steps of 4.6 % */

static const sp_shown_quantity words[SP_SHOWN_QUANTITIES] = {
    {.key = "flux", .name = "Liquid flux", .unit = "L/min per m\xc2\xb2", .to_unit = 6e4},
    {.key = "speed", .name = "Impact speed", .unit = "m/s", .to_unit = 1},
    {.key = "incidence", .name = "Incidence", .unit = "deg", .to_unit = 180 / M_PI, .at_most = true},
    {.key = "impact", .name = "Impact pressure", .unit = "Pa", .to_unit = 1},
    {.key = "jets", .name = "Jets that arrive", .unit = "", .to_unit = 1},
};

const double *sp_shown_values(const sp_deposits *deposits, int quantity)
{
    const double *const values[SP_SHOWN_QUANTITIES] = {deposits->flux, deposits->speed, deposits->incidence,
                                                       deposits->impact, deposits->jets};
    return values[quantity];
}

/* Of all designs, in SI. */
static double most(const sp_page *page, int quantity)
{
    double found = 0;
    for (size_t i = 0; i < page->result->design_count; ++i) {
        const sp_design *design = &page->result->designs[i];
        const double *values = design->evaluator ? sp_shown_values(&design->coverage->deposits, quantity) : NULL;
        for (size_t k = 0; values && k < design->coverage->deposits.count; ++k)
            found = fmax(found, values[k]);
    }
    return found;
}

static double rounded_up(double value)
{
    double power = pow(10, floor(log10(value)));
    return value <= power ? power : value <= 2 * power ? 2 * power : value <= 5 * power ? 5 * power : 10 * power;
}

static void scale_evenly(sp_shown_quantity *q, double high)
{
    q->low = q->shown[0] = 0;
    q->high = q->shown[1] = high > 0 ? rounded_up(high) : 1;
}

static void scale_by_ratios(sp_shown_quantity *q, double high)
{
    q->log = true;
    q->high = high > 0 ? high : 1;
    q->low = q->high * pow(10, -DECADES);
    q->shown[1] = rounded_up(q->high);
    q->shown[0] = q->shown[1] / 1000;
}

static bool any_jets(const sp_page *page)
{
    bool any = false;
    for (size_t i = 0; i < page->result->design_count && !page->live; ++i) {
        const sp_evaluator *evaluator = page->result->designs[i].evaluator;
        any |= evaluator && sp_evaluator_fidelity(evaluator)->method == SP_METHOD_FORWARD;
    }
    return any;
}

/* From one on. */
static void scale_counts(sp_shown_quantity *q, double high)
{
    q->log = q->whole = true;
    q->low = q->shown[0] = 1;
    q->high = fmax(high, 2);
    q->shown[1] = rounded_up(q->high);
}

/* As criteria know them; charts, of which they ask nothing, for the rest. */
static sp_quantity asked_quantity(int quantity)
{
    static const sp_quantity quantities[SP_SHOWN_QUANTITIES] = {
        SP_QUANTITY_FLUX, SP_QUANTITY_SPEED, SP_QUANTITY_INCIDENCE, SP_QUANTITY_CHARTS, SP_QUANTITY_CHARTS};
    return quantities[quantity];
}

static void add_steps(const sp_page *page, sp_shown_quantities *shown)
{
    for (int k = 0; k < SP_SHOWN_QUANTITIES; ++k) {
        sp_shown_quantity *q = &shown->of[k];
        q->step_count =
            sp_colour_thresholds(page->result->designs, page->result->design_count, asked_quantity(k), q->steps);
        for (int i = 0; i < q->step_count; ++i)
            q->steps[i] *= q->to_unit;
    }
}

sp_shown_quantities sp_shown_quantities_of(const sp_page *page)
{
    sp_shown_quantities shown = {.count = any_jets(page) ? SP_SHOWN_QUANTITIES : SP_SHOWN_JETS};
    sp_shown_quantity *quantities = shown.of;
    for (int k = 0; k < SP_SHOWN_QUANTITIES; ++k)
        quantities[k] = words[k];
    scale_by_ratios(&quantities[SP_SHOWN_FLUX], 6e4 * most(page, SP_SHOWN_FLUX));
    quantities[SP_SHOWN_FLUX].shown[0] = 6e4 * page->flux.low;
    quantities[SP_SHOWN_FLUX].shown[1] = 6e4 * page->flux.high;
    scale_evenly(&quantities[SP_SHOWN_SPEED], most(page, SP_SHOWN_SPEED));
    scale_by_ratios(&quantities[SP_SHOWN_IMPACT], most(page, SP_SHOWN_IMPACT));
    scale_counts(&quantities[SP_SHOWN_JETS], most(page, SP_SHOWN_JETS));
    quantities[SP_SHOWN_INCIDENCE].high = quantities[SP_SHOWN_INCIDENCE].shown[1] = 90;
    add_steps(page, &shown);
    return shown;
}

double sp_shown_asked(const sp_design *design, int quantity)
{
    return words[quantity].to_unit * sp_colour_threshold(design, asked_quantity(quantity));
}

static double value_of(const sp_shown_quantity *q, int byte)
{
    double place = (byte - 1) / 254.0;
    return q->log ? q->low * pow(q->high / q->low, place) : q->low + place * (q->high - q->low);
}

static bool does_meet(const sp_shown_quantity *q, double asked, double shown)
{
    return q->at_most ? shown <= asked : shown >= asked;
}

uint8_t sp_shown_byte(const sp_shown_quantity *q, double asked, double value)
{
    double shown = value * q->to_unit;
    double place = q->log ? log(shown / q->low) / log(q->high / q->low) : (shown - q->low) / (q->high - q->low);
    int byte = (int)(1 + lrint(254 * fmin(fmax(place, 0), 1)));
    /* What was rounded past what is asked goes back: the reader sees the value beside whether it is covered. */
    bool meets = does_meet(q, asked, shown);
    if (asked > 0 && does_meet(q, asked, value_of(q, byte)) != meets)
        byte += meets == q->at_most ? -1 : 1;
    return (uint8_t)(byte < 1 ? 1 : byte > 255 ? 255 : byte);
}
