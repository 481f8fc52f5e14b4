/* What the viewer can show of a patch, one byte a value. */
#ifndef REPORT_VIEWER_QUANTITIES_H
#define REPORT_VIEWER_QUANTITIES_H

#include "report/page.h"

/* Jets are shown where some were flown, from nozzles to walls and on; who evaluates layouts in the page flies none. */
enum { SP_SHOWN_FLUX, SP_SHOWN_SPEED, SP_SHOWN_INCIDENCE, SP_SHOWN_IMPACT, SP_SHOWN_JETS, SP_SHOWN_QUANTITIES };

/* Byte 0: no liquid. 1 to 255: from `low` to `high` in 254 steps, in equal ratios where `log`; the ends mean that or
 * beyond. All in the reader's unit. */
typedef struct {
    const char *key, *name, *unit;
    double to_unit; /* times a value in SI */
    double low, high;
    bool log, whole;                    /* whole: a count */
    bool at_most;                       /* a criterion asks for at most so much, not at least */
    double shown[2];                    /* ends of the colour bar */
    double steps[SP_COLOUR_THRESHOLDS]; /* what the designs' criteria ask for, each once, the least first */
    int step_count;
} sp_shown_quantity;

typedef struct {
    sp_shown_quantity of[SP_SHOWN_QUANTITIES];
    int count; /* all, or all but jets */
} sp_shown_quantities;

/* One scale for all designs of the page. */
sp_shown_quantities sp_shown_quantities_of(const sp_page *page);
const double *sp_shown_values(const sp_deposits *deposits, int quantity);
/* What a design's criterion asks for, in the reader's unit; 0: nothing. */
double sp_shown_asked(const sp_design *design, int quantity);
/* `value` in SI. What the byte stands for meets what is asked where the value does, and not where it does not. */
uint8_t sp_shown_byte(const sp_shown_quantity *quantity, double asked, double value);

#endif
