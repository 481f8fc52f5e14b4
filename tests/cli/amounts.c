/* Areas and flows on the terminal: of small geometry and little water there are digits, of other as many as ever. */
#include "workplace.h"

#include <math.h>

static void expect_told(const char *command, const char *const lines[])
{
    outcome result = run_program(command);
    assert_int_equal(result.status, 0);
    for (; *lines; lines++)
        if (!strstr(result.out, *lines))
            fail_msg("%s: nowhere: %s\n%s", command, *lines, result.out);
    forget(&result);
}

/* The room at a scale, with a nozzle beneath its ceiling. */
static void write_scaled(double scale, const char *flow)
{
    char text[1000];
    snprintf(text, sizeof text, "nozzles:\n  - {name: drop, pattern: full_cone, angle: 120 deg, flow: %s, at: 2 bar}\n",
             flow);
    write_file("scaled_drops.yaml", text);
    snprintf(text, sizeof text,
             "geometry:\n  - {file: room.obj, scale: %g}\ncavity: [%g, %g, %g]\ncatalogue: scaled_drops.yaml\n"
             "nozzles:\n  - {name: N1, type: drop, position: [%g, %g, %g], axis: [0, 0, -1], pressure: 2 bar}\n"
             "simulate: {texel: %g, trajectory: line, evaluator: inverse}\n",
             scale, scale / 2, scale / 2, scale / 2, scale / 2, scale / 2, 0.9 * scale, scale / 20);
    write_file("scaled.yaml", text);
}

static void check_tells_small_areas_and_flows(void **state)
{
    (void)state;
    write_scaled(1, "0.05 L/min");
    expect_told(
        "check scaled.yaml",
        (const char *const[]){"triangles   12 (6.0000 m2), ", "to clean    6.0000 m2 in ",
                              " clean              8       4.0000       4.0000     0.0000     0.0000     0.0000\n",
                              "N1               drop                       0.0500 ", NULL});
    write_scaled(0.001, "1e-4 L/min");
    expect_told(
        "check scaled.yaml",
        (const char *const[]){"triangles   12 (0.00000600 m2), ", "to clean    0.00000600 m2 in ",
                              " clean              8   0.00000400   0.00000400 0.00000000 0.00000000 0.00000000\n",
                              "N1               drop                     0.000100 ", NULL});
}

/* Less than decimals tell. */
static void what_is_minute_is_told(void **state)
{
    (void)state;
    write_scaled(1e-5, "1e-8 L/min");
    expect_told(
        "check scaled.yaml",
        (const char *const[]){"triangles   12 (6e-10 m2), ", "to clean    6e-10 m2 in ",
                              " clean              8        4e-10        4e-10          0          0          0\n",
                              "N1               drop                        1e-08 ", NULL});
    outcome result = run_program("simulate scaled.yaml");
    const char *row = strstr(result.out, "manual        1        1e-08 ");
    double covered, percent;
    assert_non_null(row);
    assert_int_equal(sscanf(row, "manual 1 1e-08 %lf %lf", &covered, &percent), 2);
    assert_true(covered > 1e-10 && covered < 6e-10);
    assert_true(fabs(covered / 6e-10 - percent / 100) < 0.006);
    forget(&result);
}

/* A part of 1 mm² in the room, which the room's decimals would tell as nothing; the room's own stay. */
static void a_small_part_is_told(void **state)
{
    (void)state;
    write_file("chip.obj", "v .1 .1 .5\nv .101 .1 .5\nv .101 .101 .5\nv .1 .101 .5\nf 1 2 3 4\n");
    write_file("chip.yaml", "geometry:\n  - file: room.obj\n  - file: chip.obj\ncavity: [0.5, 0.5, 0.5]\n");
    expect_told("check chip.yaml",
                (const char *const[]){
                    "triangles   14 (6.0000 m2), ",
                    " clean              8       4.0000       4.0000     0.0000     0.0000     0.0000\n",
                    " clean              2     0.000001     0.000002   0.000000   0.000000   0.000000\n", NULL});
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(check_tells_small_areas_and_flows),
        cmocka_unit_test(what_is_minute_is_told),
        cmocka_unit_test(a_small_part_is_told),
    };
    return cmocka_run_group_tests(tests, open_workplace, close_workplace);
}
