#include "lengths.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define MOST_DECIMALS 15
#define PLAIN 1e15 /* what is as large has no decimals in binary */

void cli_length_text(double length, double step, char text[CLI_LENGTH])
{
    int decimals = (int)fmin(fmax(ceil(-log10(step)), 0), MOST_DECIMALS);
    if (!(fabs(length) < PLAIN)) {
        snprintf(text, CLI_LENGTH, "%g", length);
        return;
    }
    size_t end = (size_t)snprintf(text, CLI_LENGTH, "%.*f", decimals, length);
    while (decimals && text[end - 1] == '0')
        text[--end] = '\0';
    if (decimals && text[end - 1] == '.')
        text[--end] = '\0';
    if (!strcmp(text, "-0"))
        strcpy(text, "0");
}

void cli_point_text(sp_vec3 point, double step, const char *unit, char text[CLI_POINT])
{
    char x[CLI_LENGTH], y[CLI_LENGTH], z[CLI_LENGTH];
    cli_length_text(point.x, step, x);
    cli_length_text(point.y, step, y);
    cli_length_text(point.z, step, z);
    snprintf(text, CLI_POINT, "%s%s, %s%s, %s%s", x, unit, y, unit, z, unit);
}
