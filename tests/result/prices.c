/* Prices back from a result.json, which may come from a stranger. */
#include <sprayplan/result.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#define PATH BINARY_DIR "/prices-test.json"

static sp_figures *read_price(const char *price, sp_error *error)
{
    size_t count;
    FILE *file = fopen(PATH, "wb");
    assert_non_null(file);
    fprintf(file,
            "{\"sprayplan\": \"0.1.0\", \"layouts\": [{\"name\": \"a\", \"water_l_min\": 60, \"covered_area_m2\": 4, "
            "\"coverage\": 0.8, %s \"nozzles\": [{\"name\": \"N\", \"cost_l_min\": 15}, {\"name\": \"M\"}]}]}",
            price);
    fclose(file);
    *error = (sp_error){0};
    sp_figures *figures = sp_figures_read(PATH, &count, error);
    unlink(PATH);
    return figures;
}

static void reads_prices(void **state)
{
    (void)state;
    static const struct {
        const char *price;
        double total, money; /* L/min, in the currency; NAN: not told */
        const char *currency;
    } cases[] = {
        {"", NAN, NAN, ""},
        {"\"price\": {\"mounts_l_min\": 15, \"total_l_min\": 75},", 75, NAN, ""},
        {"\"price\": {\"mounts_l_min\": 15, \"money\": 3000, \"currency\": \"EUR\"},", 75, 3000, "EUR"},
        {"\"price\": {\"mounts_l_min\": 0, \"money\": 0.5, \"currency\": \"CHF\"},", 60, 0.5, "CHF"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        sp_error error;
        sp_figures *figures = read_price(cases[i].price, &error);
        assert_string_equal(error.message, "");
        double total = 6e4 * sp_figures_price(figures), money = sp_figures_money(figures);
        assert_true(isnan(cases[i].total) ? isnan(total) : fabs(total - cases[i].total) < 1e-9);
        assert_true(isnan(cases[i].money) ? isnan(money) : fabs(money - cases[i].money) < 1e-9);
        assert_string_equal(figures->water_cost.currency, cases[i].currency);
        assert_true(fabs(6e4 * figures->nozzles[0].cost - 15) < 1e-9 && isnan(figures->nozzles[1].cost));
        sp_figures_destroy(figures, 1);
    }
}

static void rejects_what_is_no_price(void **state)
{
    (void)state;
    static const char *const faults[][2] = {
        {"\"price\": 75,", "layouts[0].price: found 75, expected an object"},
        {"\"price\": {\"mounts_l_min\": -1},", "layouts[0].price.mounts_l_min: found -1, expected a number from 0"},
        {"\"price\": {\"mounts_l_min\": 1, \"money\": -5, \"currency\": \"EUR\"},", "layouts[0].price.money: found -5"},
        {"\"price\": {\"mounts_l_min\": 1, \"money\": 5},",
         "layouts[0].price.currency: missing, expected three capital"},
        {"\"price\": {\"mounts_l_min\": 1, \"money\": 5, \"currency\": \"<b>\"},",
         "layouts[0].price.currency: found a text, expected three capital letters"},
        {"\"price\": {\"mounts_l_min\": 1, \"money\": 5, \"currency\": \"EURO\"},", "layouts[0].price.currency: found"},
        {"\"price\": {\"mounts_l_min\": 1, \"money\": 5, \"currency\": [1]},",
         "layouts[0].price.currency: found a list"},
    };
    for (size_t i = 0; i < sizeof faults / sizeof *faults; i++) {
        sp_error error;
        assert_null(read_price(faults[i][0], &error));
        if (strncmp(error.message, faults[i][1], strlen(faults[i][1])) != 0)
            fail_msg("found '%s', expected '%s...'", error.message, faults[i][1]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reads_prices),
        cmocka_unit_test(rejects_what_is_no_price),
    };
    return cmocka_run_group_tests_name("prices", tests, NULL, NULL);
}
