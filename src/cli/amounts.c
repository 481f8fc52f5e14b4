#include "amounts.h"

#include <sprayplan/result.h>

#include <math.h>
#include <stdio.h>

#define LEAST_PLAIN 1e-7 /* of less, decimals for people leave fewer than three digits */

void cli_amount_text(double amount, double whole, int least, int digits, char text[CLI_AMOUNT])
{
    double size = fabs(whole);
    if (size > 0 && size < LEAST_PLAIN)
        snprintf(text, CLI_AMOUNT, "%.3g", amount);
    else
        snprintf(text, CLI_AMOUNT, "%.*f", sp_told_decimals(whole, least, digits), amount);
}
