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

static void check_reports_small_areas_and_flows(void **state)
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
static void what_is_minute_is_reported(void **state)
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
static void a_small_part_is_reported(void **state)
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

/* A floor to be washed from 1 m above it; a roof above that, and chips of 1 mm² on it. */
static void write_roofed(int chips)
{
    char mesh[2000], scene[1000];
    size_t used = (size_t)snprintf(mesh, sizeof mesh,
                                   "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 2\nv 1 0 2\nv 1 1 2\nv 0 1 2\n"
                                   "g floor\nf 1 2 3 4\ng roof\nf 5 6 7 8\n");
    for (int i = 0; i < chips; i++)
        used += (size_t)snprintf(mesh + used, sizeof mesh - used,
                                 "v .%d .5 3\nv .%d01 .5 3\nv .%d01 .501 3\nv .%d .501 3\ng chip%d\nf -4 -3 -2 -1\n",
                                 i + 1, i + 1, i + 1, i + 1, i);
    write_file("roofed.obj", mesh);
    snprintf(scene, sizeof scene,
             "geometry:\n  - file: roofed.obj\ncatalogue: catalogue.yaml\nsimulate: {texel: 50 mm, trajectory: line}\n"
             "place:\n  types: [cone]\n  pressure: 2 bar\n  max_nozzles: 1\n  refine: none\n  mounts:\n"
             "    - port: {name: P, position: [0.5, 0.5, 1], axis: [0, 0, -1]}\n");
    write_file("roofed.yaml", scene);
}

/* None of the parts out of reach is told as nothing, and those that are not named are counted. */
static void parts_out_of_reach_are_all_reported(void **state)
{
    (void)state;
    static const struct {
        int chips;
        const char *told, *shown;
    } cases[] = {{2, "roof 1.0000, chip0 0.000001, chip1 0.000001\n", "chip1&nbsp;0.000001)"},
                 {3, "roof 1.0000, chip0 0.000001, chip1 0.000001, 1 other part 0.000001\n",
                  "chip1&nbsp;0.000001, 1 other part&nbsp;0.000001)"},
                 {6, "roof 1.0000, chip0 0.000001, chip1 0.000001, 4 other parts 0.000004\n",
                  "chip1&nbsp;0.000001, 4 other parts&nbsp;0.000004)"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        write_roofed(cases[i].chips);
        outcome result = run_program("place roofed.yaml -o roofed");
        const char *line = strstr(result.out, " no line of reach: ");
        if (!line || !strstr(line, cases[i].told))
            fail_msg("nowhere: %s\n%s", cases[i].told, result.out);
        forget(&result);
        char *page = read_file("roofed/report.html", NULL);
        assert_non_null(strstr(page, cases[i].shown));
        free(page);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(check_reports_small_areas_and_flows),
        cmocka_unit_test(what_is_minute_is_reported),
        cmocka_unit_test(a_small_part_is_reported),
        cmocka_unit_test(parts_out_of_reach_are_all_reported),
    };
    return cmocka_run_group_tests(tests, open_workplace, close_workplace);
}
