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
                           .url = "https://example.com/a",
                           .thread = "G 1/2",
                           .insert = "=7"};
    const sp_nozzle nozzle = {.name = "N1",
                              .type = &type,
                              .position = {0.1, -1.0 / 3, 1.8},
                              .axis = {0, 0, -1},
                              .roll = M_PI / 6,
                              .pressure = 2e5};
    const sp_setup setup = sp_setup_default();
    sp_error error = {0};
    assert_true(sp_quantity_parse("12 L/min", "m3/s", &type.flow, &error));
    sp_layout *layout = sp_layout_create(&nozzle, 1, &error);
    sp_fitting_sheet *sheet = sp_fitting_sheet_create(layout, &setup, NULL, 0, &error);
    char *csv = sp_nozzles_csv(sheet, &error);
    assert_non_null(csv);
    const char *start =
        "name,type,x_m,y_m,z_m,axis_x,axis_y,axis_z,roll_deg,angle_deg,pressure_bar,flow_l_min,speed_m_s,"
        "order_code,url,thread,insert,mounting,fitting,depth_mm,standoff_mm,fitting_x_mm,fitting_y_mm,"
        "fitting_height_mm,fitting_radius_mm,fitting_azimuth_deg,tip_x_mm,tip_y_mm,tip_height_mm,tip_radius_mm,"
        "tip_azimuth_deg,tilt_deg,towards_deg,turn_deg,circuit,circuit_l_min\n"
        "N1,\"cone, \"\"wide\"\"\",0.1,";
    assert_memory_equal(csv, start, strlen(start));
    assert_string_equal(csv + strlen(start), "-0.3333333333333333,1.8,0,0,-1,30,90,2,12,19,\"A,1\","
                                             "https://example.com/a,G 1/2,'=7,,,,,,,,,,100,-333,1800,348,286.7,0,0,,1,"
                                             "12\n");
    /* the same of several, behind their names */
    const sp_fitting_sheet *const both[] = {sheet, sheet};
    const char *const names[] = {"one, \"first\"", "=two"}, *rows = strchr(csv, '\n') + 1;
    char *all = sp_all_nozzles_csv(both, names, 2, &error), expected[2048];
    snprintf(expected, sizeof expected, "layout,%.*s\"one, \"\"first\"\"\",%s'=two,%s", (int)(rows - csv), csv, rows,
             rows);
    assert_string_equal(all, expected);
    free(all);
    free(csv);
    sp_fitting_sheet_destroy(sheet);
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
        snprintf(type.thread, sizeof type.thread, "%s", texts[i].name);
        snprintf(type.insert, sizeof type.insert, "%s", texts[i].name);
        sp_error error = {0};
        sp_layout *layout = sp_layout_create(&nozzle, 1, &error);
        sp_fitting_sheet *sheet = sp_fitting_sheet_create(layout, &setup, NULL, 0, &error);
        char *csv = sp_nozzles_csv(sheet, &error), expected[256];
        assert_non_null(csv);
        const char *row = strchr(csv, '\n') + 1, *field = texts[i].field;
        snprintf(expected, sizeof expected, "%s,%s,-1,0,0,", field, field);
        assert_memory_equal(row, expected, strlen(expected));
        snprintf(expected, sizeof expected, ",%s,%s,%s,%s,,,", field, field, field, field);
        assert_non_null(strstr(row, expected));
        free(csv);
        sp_fitting_sheet_destroy(sheet);
        sp_layout_destroy(layout);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(rows_read_back), cmocka_unit_test(no_text_is_a_formula)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
