/* Quantities: what udunits converts, what we add to it, and what it would take that is no quantity to us. */
#include "scene/units.h"

#include <sprayplan/scene.h>

#include <locale.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <stdio.h>
#include <string.h>

static void is(const char *text, const char *unit, double expected)
{
    double value = NAN;
    sp_error error = {0};
    if (!sp_quantity_parse(text, unit, &value, &error))
        fail_msg("%s: %s", text, error.message);
    if (!(fabs(value - expected) <= 4e-16 * fabs(expected)))
        fail_msg("%s: %.17g, not %.17g", text, value, expected);
}

static void is_not(const char *text, const char *unit, const char *message)
{
    double value = 42;
    sp_error error = {0};
    if (sp_quantity_parse(text, unit, &value, &error))
        fail_msg("'%s' was read as %g", text, value);
    assert_true(value == 42);
    assert_int_equal(error.kind, SP_ERROR_INPUT);
    assert_string_equal(error.message, message);
}

static void conversions(void **state)
{
    (void)state;
    is("250 mm", "m", 0.25);
    is("0.25", "m", 0.25);
    is("-.5e1", "m", -5);
    is("+1e-3m", "m", 1e-3);
    is("1 in", "m", 0.0254);
    is("10 \xc2\xb5m", "m", 1e-5);
    is("180 deg", "rad", M_PI);
    is("90 \xc2\xb0", "rad", M_PI / 2);
    is("1 rad", "rad", 1);
    is("2 bar", "Pa", 2e5);
    is("6 L/min", "m3/s", 1e-4);
    is("6 l/min", "m3/s", 1e-4);
    is("3.6 m3/h", "m3/s", 1e-3);
    is("1 gpm", "m3/s", 3.785411784e-3 / 60);
    is("6 lpm", "m3/s", 1e-4);
    is("6 LPM", "m3/s", 1e-4);
    is("2 barg", "Pa", 2e5);
    is("20 psig", "Pa", 20 * 6894.757293168361);
    is("20 PSI", "Pa", 20 * 6894.757293168361);
    is("20 psi(g)", "Pa", 20 * 6894.757293168361);
    is("2 bar(g)", "Pa", 2e5);
    is("10 mWC", "Pa", 98066.5);
    is("500 mmWC", "Pa", 0.5 * 9806.65);
    is("1 USgpm", "m3/s", 3.785411784e-3 / 60);
    is("1 usgpm", "m3/s", 3.785411784e-3 / 60);
    is("1 cfm", "m3/s", 0.3048 * 0.3048 * 0.3048 / 60);
    is("1.1 cP", "Pa.s", 1.1e-3);
    is("60 L/min/m2", "m/s", 1e-3);
    is("60 L/(min.m^2)", "m/s", 1e-3);
    is("1 mPa.s", "Pa.s", 1e-3);
    is("1 g/cm3", "kg/m3", 1000);
    is("60 1/min", "1/s", 1);
    is("9.81 m/s2", "m/s2", 9.81);
    is("9.81 m.s-2", "m/s2", 9.81);
    is("1 %", "1", 0.01);
    is("0.5", "1", 0.5);
}

static void refusals(void **state)
{
    (void)state;
    is_not("2", "Pa", "found '2', expected a number and a unit that measures the same as Pa: it has no unit");
    is_not("", "m", "found '', expected a number and a unit that measures the same as m");
    is_not("mm", "m", "found 'mm', expected a number and a unit that measures the same as m");
    is_not("2 bar", "m",
           "found '2 bar', expected a number and a unit that measures the same as m: 'bar' measures something else");
    is_not("2 furlogs", "m",
           "found '2 furlogs', expected a number and a unit that measures the same as m: 'furlogs' is no known unit");
    is_not("5 gal/min", "m3/s",
           "found '5 gal/min', expected a number and a unit that measures the same as m3/s: gal is the Galileo here: "
           "write gpm "
           "for US gallons per minute, or L/min");
    is_not("981 gal", "m/s2",
           "found '981 gal', expected a number and a unit that measures the same as m/s2: gal is the Galileo here: "
           "write gpm "
           "for US gallons per minute, or L/min");
    is_not("2 bar(a)", "Pa",
           "found '2 bar(a)', expected a number and a unit that measures the same as Pa: 'bar(a)' measures something "
           "else");
    is_not("1e400 m", "m",
           "found '1e400 m', expected a number and a unit that measures the same as m: it is not finite");
    is_not("0.5 rad", "1", "found '0.5 rad', expected a number without unit: 'rad' measures something else");
    is_not("20 %", "rad",
           "found '20 %', expected a number and a unit that measures the same as rad: '%' measures something else");
}

/* All of these udunits would take: scaled units, reciprocals, times, logarithms. */
static void no_quantities(void **state)
{
    (void)state;
    static const char *const lengths[] = {"1 10 mm", "5 2",   "inf m",        "nan",        "0x10 m",  "1,5 m", "1 1/m",
                                          "2 m m",   "1 m 2", "3 lg(re 1 m)", "3 m from 2", "3 m @ 2", "1 m;",  "1 -m"};
    for (size_t i = 0; i < sizeof lengths / sizeof *lengths; i++) {
        double value = 42;
        sp_error error = {0};
        if (sp_quantity_parse(lengths[i], "m", &value, &error))
            fail_msg("'%s' was read as %g", lengths[i], value);
        assert_int_equal(error.kind, SP_ERROR_INPUT);
    }
}

/* A host program may speak a language with a decimal comma; files have a point all the same. */
static void other_locale(void **state)
{
    (void)state;
    if (!setlocale(LC_ALL, "de_DE.UTF-8")) {
        print_message("no German locale here, the check is left out\n");
        skip();
    }
    is("0.25 m", "m", 0.25);
    assert_string_equal(localeconv()->decimal_point, ",");
    setlocale(LC_ALL, "C");
}

static const struct {
    const char *name, *si;
} friendly[] = {{"bar", "Pa"}, {"deg", "rad"}, {"L/min", "m3/s"}, {"L/min/m2", "m/s"}, {"%", "1"}, {"m", "m"}};
enum { FRIENDLY = sizeof friendly / sizeof *friendly };

static double read_back(const sp_units *units, const char *number, int unit)
{
    const sp_dimension dimension = {"a quantity", friendly[unit].si, "", false};
    char text[80], why[200];
    double value = NAN;
    snprintf(text, sizeof text, "%s %s", number, friendly[unit].name);
    if (!sp_units_read(units, text, &dimension, &value, why, sizeof why))
        fail_msg("%s: %s", text, why);
    return value;
}

static double factor_of(const sp_units *units, int unit)
{
    const sp_dimension dimension = {"a quantity", friendly[unit].si, "", false};
    double factor = NAN;
    char why[200];
    assert_true(sp_units_factor(units, friendly[unit].name, &dimension, &factor, why, sizeof why));
    return factor;
}

/* What a person wrote is written again: no 199999.99999999997. */
static void short_numbers_stay(void **state)
{
    (void)state;
    static const char *const numbers[] = {"2",    "120",   "0.3",   "16.4",  "-30", "0",
                                          "2.05", "359.9", "1e-05", "1e+15", "0.1"};
    sp_units *units = sp_units_create(NULL);
    for (int unit = 0; unit < FRIENDLY; unit++)
        for (int i = 0; i < 1000; i++) {
            char number[SP_UNITS_NUMBER], drawn[SP_UNITS_NUMBER];
            const char *given = numbers[i % (int)(sizeof numbers / sizeof *numbers)];
            snprintf(drawn, sizeof drawn, "%.9g", i * 0.037 + 1e-4 * i * i);
            given = i < 11 ? given : drawn;
            assert_true(sp_units_number(read_back(units, given, unit), factor_of(units, unit), number));
            assert_string_equal(number, given);
        }
    sp_units_destroy(units);
}

/* Every value has a number in every unit, tiny and huge ones too. */
static void every_value_reads_back(void **state)
{
    (void)state;
    sp_units *units = sp_units_create(NULL);
    uint64_t random = 1;
    for (int unit = 0; unit < FRIENDLY; unit++) {
        double factor = factor_of(units, unit);
        for (int i = 0; i < 500; i++) {
            char number[SP_UNITS_NUMBER];
            random = random * 6364136223846793005u + 1442695040888963407u;
            double value = ldexp((double)(random >> 11), i % 4 ? -50 : (int)(random % 1900) - 1000);
            sp_units_number(value, factor, number);
            if (isfinite(value) && read_back(units, number, unit) != value)
                fail_msg("%.17g as %s %s reads as %.17g", value, number, friendly[unit].name,
                         read_back(units, number, unit));
        }
    }
    sp_units_destroy(units);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(conversions),  cmocka_unit_test(refusals),           cmocka_unit_test(no_quantities),
        cmocka_unit_test(other_locale), cmocka_unit_test(short_numbers_stay), cmocka_unit_test(every_value_reads_back),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
