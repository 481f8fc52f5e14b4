#include "scene/units.h"

#include <udunits2.h>

#include <ctype.h>
#include <float.h>
#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct sp_units {
    ut_system *system;
};

/* udunits keeps the state of its parsers, its tables of units and its handler of messages in static variables, whatever
 * the system: one thread at a time is inside of it, and messages are swallowed meanwhile. */
static pthread_mutex_t inside = PTHREAD_MUTEX_INITIALIZER;

/* Returns the handler to put back. */
static ut_error_message_handler enter(void)
{
    pthread_mutex_lock(&inside);
    return ut_set_error_message_handler(ut_ignore);
}

static void leave(ut_error_message_handler handler)
{
    ut_set_error_message_handler(handler);
    pthread_mutex_unlock(&inside);
}

/* What makers' sheets have and udunits does not know. A pressure is always a difference here, so that one above the
 * air's is no other; a US gallon is 231 cubic inches, exactly, and water in a column of 1000 kg/m³ under 9.80665 m/s².
 */
static const struct {
    const char *name, *scaled;
    double factor;
} sheet_units[] = {
    {"deg", "rad", M_PI / 180}, {"gpm", "m3/s", 3.785411784e-3 / 60},
    {"lpm", "L/min", 1},        {"LPM", "L/min", 1},
    {"psig", "psi", 1},         {"barg", "bar", 1},
    {"cP", "mPa.s", 1},         {"USgpm", "m3/s", 3.785411784e-3 / 60},
    {"PSI", "psi", 1},          {"mWC", "Pa", 9806.65},
    {"cfm", "ft3/min", 1},
};

/* What udunits would take for a product. */
static const struct {
    const char *spelt, *unit;
} gauge_units[] = {{"bar(g)", "barg"}, {"psi(g)", "psig"}};

static const char *without_brackets(const char *unit)
{
    for (size_t i = 0; i < sizeof gauge_units / sizeof *gauge_units; i++)
        if (strcmp(unit, gauge_units[i].spelt) == 0)
            return gauge_units[i].unit;
    return unit;
}

static bool add_unit(ut_system *system, const char *name, double factor, const char *of)
{
    ut_unit *base = ut_parse(system, of, UT_ASCII);
    ut_unit *unit = ut_scale(factor, base);
    bool good = unit && ut_map_name_to_unit(name, UT_ASCII, unit) == UT_SUCCESS;
    ut_free(unit);
    ut_free(base);
    return good;
}

sp_units *sp_units_create(sp_error *error)
{
    sp_units *units = calloc(1, sizeof *units);
    if (!units)
        return sp_fail_memory(error);
    ut_error_message_handler handler = enter();
    units->system = ut_read_xml(NULL);
    bool good = units->system != NULL;
    for (size_t i = 0; good && i < sizeof sheet_units / sizeof *sheet_units; i++)
        good = add_unit(units->system, sheet_units[i].name, sheet_units[i].factor, sheet_units[i].scaled);
    leave(handler);
    if (good)
        return units;
    sp_fail(error, SP_ERROR_FILE, NULL, 0, 0, "cannot read the units database of udunits2");
    sp_units_destroy(units);
    return NULL;
}

void sp_units_destroy(sp_units *units)
{
    if (!units)
        return;
    ut_error_message_handler handler = enter();
    ut_free_system(units->system);
    leave(handler);
    free(units);
}

/* udunits takes far more than units: "10 mm" (a scaled unit), "s since 2000", "lg(re 1 mW)". What is left here are
 * names with exponents, products and quotients, and a leading "1/". */
static bool plain_unit(const char *unit)
{
    if (strlen(unit) > 60 || (!isalpha((unsigned char)unit[0]) && !strchr("1%", unit[0]) && !(unit[0] & 0x80)))
        return false;
    if (unit[0] == '1' && unit[1] != '/')
        return false;
    for (const char *c = unit + 1; *c; c++) {
        bool digit = isdigit((unsigned char)*c);
        if (digit && !isalnum((unsigned char)c[-1]) && !strchr("^-", c[-1]))
            return false;
        if (!digit && !isalpha((unsigned char)*c) && !(*c & 0x80) && !strchr("/.*^- ()%", *c))
            return false;
    }
    return true;
}

/* udunits' gal is the Galileo, 0.01 m/s². */
static bool names_gal(const char *unit)
{
    for (const char *c = unit; *c;) {
        size_t size = 0;
        while (isalpha((unsigned char)c[size]))
            size++;
        if (size == 3 && tolower((unsigned char)c[0]) == 'g' && tolower((unsigned char)c[1]) == 'a' &&
            tolower((unsigned char)c[2]) == 'l')
            return true;
        c += size ? size : 1;
    }
    return false;
}

/* To udunits radians have no dimension; to us an angle is not a share. */
static bool is_angle(const ut_unit *unit)
{
    char definition[256] = "";
    ut_format(unit, definition, sizeof definition, UT_ASCII | UT_DEFINITION);
    return strstr(definition, "rad") != NULL;
}

/* udunits also converts to reciprocals, offsets and logarithms; a quantity here is a multiple of its unit. */
static bool convert(ut_unit *from, ut_unit *to, double *factor)
{
    if (!ut_are_convertible(from, to) || is_angle(from) != is_angle(to))
        return false;
    cv_converter *converter = ut_get_converter(from, to);
    if (!converter)
        return false;
    double one = cv_convert_double(converter, 1), two = cv_convert_double(converter, 2);
    cv_free(converter);
    *factor = one;
    return isfinite(one) && one > 0 && fabs(two - 2 * one) <= 1e-12 * one;
}

bool sp_units_factor(const sp_units *units, const char *unit, const sp_dimension *dimension, double *factor, char *why,
                     size_t size)
{
    if (names_gal(unit)) {
        snprintf(why, size, "gal is the Galileo here: write gpm for US gallons per minute, or L/min");
        return false;
    }
    ut_error_message_handler handler = enter();
    ut_unit *from = plain_unit(unit) ? ut_parse(units->system, without_brackets(unit), UT_UTF8) : NULL;
    ut_unit *to = ut_parse(units->system, dimension->unit, UT_UTF8);
    bool good = from && to && convert(from, to, factor);
    if (!good)
        snprintf(why, size, from ? "'%.60s' measures something else" : "'%.60s' is no known unit", unit);
    ut_free(from);
    ut_free(to);
    leave(handler);
    return good;
}

/* A decimal number: no "inf", no "nan", no hexadecimals. Returns what follows it, or NULL. */
static const char *skip_number(const char *text)
{
    size_t digits = 0;
    if (*text == '+' || *text == '-')
        text++;
    for (; isdigit((unsigned char)*text); text++)
        digits++;
    if (*text == '.')
        for (text++; isdigit((unsigned char)*text); text++)
            digits++;
    if (!digits)
        return NULL;
    if (*text == 'e' || *text == 'E') {
        const char *exponent = text + 1 + (text[1] == '+' || text[1] == '-');
        if (isdigit((unsigned char)*exponent))
            for (text = exponent; isdigit((unsigned char)*text);)
                text++;
    }
    return text;
}

/* A decimal number of units. The product is rounded once, at its end: where long double has no more digits than double
 * (Apple's processors) a third of all values have no number in degrees. */
static double number_of(const char *text, double factor)
{
    return factor == 1 ? strtod(text, NULL) : (double)(strtold(text, NULL) * factor);
}

bool sp_units_number(double value, double factor, char number[SP_UNITS_NUMBER])
{
    for (int digits = DBL_DIG; digits <= LDBL_DECIMAL_DIG; digits++) {
        snprintf(number, SP_UNITS_NUMBER, "%.*Lg", digits, (long double)value / factor);
        if (number_of(number, factor) == value)
            return true;
    }
    return false;
}

bool sp_units_of(const sp_units *units, const char *text, const sp_dimension *dimension, double *factor, char *why,
                 size_t size)
{
    why[0] = '\0';
    const char *unit = skip_number(text);
    if (!unit)
        return false;
    *factor = 1;
    while (*unit == ' ')
        unit++;
    if (!*unit && !dimension->bare)
        snprintf(why, size, "it has no unit");
    return *unit ? sp_units_factor(units, unit, dimension, factor, why, size) : dimension->bare;
}

bool sp_units_read(const sp_units *units, const char *text, const sp_dimension *dimension, double *value, char *why,
                   size_t size)
{
    double factor;
    if (!sp_units_of(units, text, dimension, &factor, why, size))
        return false;
    double read = number_of(text, factor);
    if (!isfinite(read)) {
        snprintf(why, size, "it is not finite");
        return false;
    }
    *value = read;
    return true;
}
