#include <sprayplan/result.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static void rows_read_back(void **state)
{
    (void)state;
    sp_nozzle_type type = {.name = "cone, \"wide\"",
                           .pattern = SP_PATTERN_FULL_CONE,
                           .angle = M_PI / 2,
                           .flow = 2e-4,
                           .at = 2e5,
                           .exponent = 0.5,
                           .cv = 0.95,
                           .drop = 1e-3,
                           .angle_min = M_PI / 2,
                           .angle_max = M_PI / 2,
                           .flow_min = 2e-4,
                           .flow_max = 2e-4,
                           .order_code = "A,1",
                           .url = "https://example.com/a"};
    const sp_nozzle nozzle = {.name = "N1",
                              .type = &type,
                              .position = {0.1, -1.0 / 3, 1.8},
                              .axis = {0, 0, -1},
                              .roll = M_PI / 6,
                              .pressure = 2e5};
    const sp_setup setup = sp_setup_default();
    sp_error error = {0};
    sp_layout *layout = sp_layout_create(&nozzle, 1, &error);
    char *csv = sp_nozzles_csv(layout, &setup, &error);
    assert_non_null(csv);
    const char *start =
        "name,type,x_m,y_m,z_m,axis_x,axis_y,axis_z,roll_deg,angle_deg,pressure_bar,flow_l_min,speed_m_s,"
        "order_code,url\n"
        "N1,\"cone, \"\"wide\"\"\",0.1,";
    assert_memory_equal(csv, start, strlen(start));
    double values[10];
    char *at = csv + strlen(start);
    for (int i = 0; i < 10; ++i) {
        values[i] = strtod(at, &at);
        assert_int_equal(*at++, ',');
    }
    assert_string_equal(at, "\"A,1\",https://example.com/a\n");
    assert_true(values[0] == -1.0 / 3 && values[1] == 1.8 && values[4] == -1);
    assert_true(fabs(values[5] - 30) < 1e-12 && fabs(values[6] - 90) < 1e-12 && values[7] == 2);
    assert_true(fabs(values[8] - 12) < 1e-12 && fabs(values[9] - 19) < 1e-12);
    free(csv);
    sp_layout_destroy(layout);
}

/* Numbers may begin with a minus; texts that do are marked. */
static void no_text_is_a_formula(void **state)
{
    (void)state;
    static const struct {
        const char *name, *field;
    } texts[] = {{"=1+1", "'=1+1"},         {"+x", "'+x"},         {"-x", "'-x"},
                 {"@SUM(A1)", "'@SUM(A1)"}, {"\t=x", "\"'\t=x\""}, {"=a,\"b\"", "\"'=a,\"\"b\"\"\""},
                 {"a;=x", "\"a;=x\""},      {"a=x", "a=x"},        {"", ""}};
    const sp_setup setup = sp_setup_default();
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        sp_nozzle_type type = {.pattern = SP_PATTERN_FULL_CONE, .angle = 1, .flow = 1, .at = 1, .exponent = 0.5};
        sp_nozzle nozzle = {.type = &type, .position = {-1, 0, 0}, .axis = {0, 0, -1}, .pressure = 1e5};
        snprintf(nozzle.name, sizeof nozzle.name, "%s", texts[i].name);
        snprintf(type.name, sizeof type.name, "%s", texts[i].name);
        snprintf(type.order_code, sizeof type.order_code, "%s", texts[i].name);
        snprintf(type.url, sizeof type.url, "%s", texts[i].name);
        sp_error error = {0};
        sp_layout *layout = sp_layout_create(&nozzle, 1, &error);
        char *csv = sp_nozzles_csv(layout, &setup, &error), expected[256];
        assert_non_null(csv);
        const char *row = strchr(csv, '\n') + 1, *field = texts[i].field;
        snprintf(expected, sizeof expected, "%s,%s,-1,0,0,", field, field);
        assert_memory_equal(row, expected, strlen(expected));
        snprintf(expected, sizeof expected, ",%s,%s\n", field, field);
        assert_string_equal(row + strlen(row) - strlen(expected), expected);
        free(csv);
        sp_layout_destroy(layout);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(rows_read_back), cmocka_unit_test(no_text_is_a_formula)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
