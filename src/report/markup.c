#include "markup.h"

#include <sprayplan/result.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

#define MOST_DECIMALS 9
#define LEAST 0.5e-9 /* what rounds to more than 0 with these */

static const char *entity(char character)
{
    switch (character) {
    case '&':
        return "&amp;";
    case '<':
        return "&lt;";
    case '>':
        return "&gt;";
    case '"':
        return "&quot;";
    case '\'':
        return "&#39;";
    default:
        return NULL;
    }
}

void sp_markup_escape(sp_text *text, const char *value)
{
    for (const char *at = value; *at; ++at) {
        const char *safe = entity(*at);
        sp_text_append(text, safe ? safe : at, safe ? strlen(safe) : 1);
    }
}

void sp_markup_json(sp_text *text, const char *json)
{
    for (const char *rest; (rest = strchr(json, '<')); json = rest + 1) {
        sp_text_append(text, json, (size_t)(rest - json));
        sp_text_add(text, "\\u003c");
    }
    sp_text_append(text, json, strlen(json));
}

void sp_markup_base64(sp_text *text, const uint8_t *bytes, size_t size)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < size; i += 3) {
        uint32_t group = (uint32_t)bytes[i] << 16;
        group |= i + 1 < size ? (uint32_t)bytes[i + 1] << 8 : 0;
        group |= i + 2 < size ? bytes[i + 2] : 0;
        const char four[4] = {digits[group >> 18], digits[group >> 12 & 63],
                              i + 1 < size ? digits[group >> 6 & 63] : '=', i + 2 < size ? digits[group & 63] : '='};
        sp_text_append(text, four, 4);
    }
}

/* What rounds to 0 has no sign. */
static bool rounds_below_zero(double value, int decimals)
{
    char digits[340]; /* the longest double, and a few decimals */
    snprintf(digits, sizeof digits, "%.*f", decimals, fabs(value));
    return value < 0 && strspn(digits, "0.") < strlen(digits);
}

void sp_markup_decimals(sp_text *text, double value, int decimals)
{
    if (!isfinite(value))
        sp_text_add(text, "\xe2\x80\x93");
    else
        sp_text_add(text, "%s%.*f", rounds_below_zero(value, decimals) ? "\xe2\x88\x92" : "", decimals, fabs(value));
}

void sp_markup_significant(sp_text *text, double value, int digits)
{
    double size = fabs(value);
    int decimals = isfinite(value) && size >= LEAST ? digits - 1 - (int)floor(log10(size) + 1e-9) : 0;
    sp_markup_decimals(text, value, decimals < 0 ? 0 : decimals > MOST_DECIMALS ? MOST_DECIMALS : decimals);
}

void sp_markup_water(sp_text *text, double l_min)
{
    sp_markup_decimals(text, l_min, sp_water_decimals(l_min));
}

void sp_markup_water_of(sp_text *text, double l_min, double whole)
{
    sp_markup_decimals(text, l_min, sp_water_decimals(whole));
}

void sp_markup_water_beside(sp_text *text, double l_min, double most)
{
    sp_markup_decimals(text, l_min, sp_told_decimals(l_min, sp_water_decimals(most), 2));
}

void sp_markup_signed(sp_text *text, double value, int decimals)
{
    if (isfinite(value) && value >= 0)
        sp_text_add(text, "+");
    sp_markup_decimals(text, value, decimals);
}
