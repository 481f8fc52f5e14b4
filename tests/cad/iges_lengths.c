/* IGES files whose unit of length is unknown, missing or contradicts itself, and models to a scale. */
#include "files.h"

#define EDGE 10.0 /* of a square, in units of its file */

/* A section's lines: 72 columns of the text, its letter, the line's number; how many. */
static int write_section(FILE *file, char letter, const char *text)
{
    int count = 0;
    for (const char *at = text; *at; at += strlen(at) < 72 ? strlen(at) : 72)
        fprintf(file, "%-72.72s%c%7d\n", at, letter, ++count);
    return count;
}

/* `lengths` are the global parameters 13 to 15: scale, flag, name. The square is entity 128, a spline surface of degree
 * 1 either way: four knots each, four weights, four points, the range of its parameters. */
static void write_square(const char *path, const char *lengths)
{
    char global[512], square[512], terminal[80];
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    snprintf(global, sizeof global, "%-72s%s,1,0.1,15H20260101.000000,1E-5,100.,4Htest,4Htest,11,0,15H20260101.000000;",
             "1H,,1H;,6Hsquare,8Hsome.igs,4Htest,4Htest,32,38,6,308,15,6Hsquare,", lengths);
    snprintf(square, sizeof square, "%-64s%8d%-64s%8d", "128,1,1,1,1,0,0,1,0,0,0.,0.,1.,1.,0.,0.,1.,1.,1.,1.,1.,1.,", 1,
             "0.,0.,0.,10.,0.,0.,0.,10.,0.,10.,10.,0.,0.,1.,0.,1.;", 1);
    int start = write_section(file, 'S', "written by a test"), header = write_section(file, 'G', global);
    int entity = write_section(file, 'D',
                               "     128       1       0       0       0       0       0       000000000"
                               "     128       0       0       2       0                               0");
    int parameters = write_section(file, 'P', square);
    snprintf(terminal, sizeof terminal, "S%7dG%7dD%7dP%7d", start, header, entity, parameters);
    write_section(file, 'T', terminal);
    assert_int_equal(fclose(file), 0);
}

/* The unit that was taken, m, and what was said first; "" where nothing was. */
static void expect_read(const char *lengths, double unit, size_t faults, const char *said)
{
    const sp_cad_options options = sp_cad_options_default();
    sp_cad_account account;
    write_square("square.igs", lengths);
    sp_mesh *mesh = load_cad("square.igs", 1, &options, &account);
    double area = EDGE * EDGE * unit * unit;
    if (account.faults != faults || strcmp(account.fault, said) != 0 || fabs(part_area(mesh, 0) / area - 1) > 1e-9)
        fail_msg("%s: %zu faults, %s; %g m2, expected %g", lengths, account.faults, account.fault, part_area(mesh, 0),
                 area);
    sp_mesh_destroy(mesh);
    assert_int_equal(remove("square.igs"), 0);
}

static void a_unit_that_is_known_is_taken(void **state)
{
    (void)state;
    need_cad();
    expect_read("1.0,2,2HMM", 1e-3, 0, "");
    expect_read("1.0,2,2Hmm", 1e-3, 0, "");
    expect_read("1.0,2,", 1e-3, 0, "");
    expect_read(",6,1HM", 1, 0, "");
    expect_read("1,1,2HIN", 0.0254, 0, "");
    expect_read("1.,1,4HINCH", 0.0254, 0, "");
    expect_read("1.0D0,3,2HCM", 1e-2, 0, "");
    expect_read("1.0,0,2HFT", 0.3048, 0, "");
}

static void a_unit_in_doubt_is_reported(void **state)
{
    (void)state;
    need_cad();
    expect_read("1.0,3,6HFATHOM", 1e-3, 1, "the unit of length \"FATHOM\" is not known, mm are taken");
    expect_read("1.0,3,35Ha name that is longer than any unit", 1e-3, 1,
                "the unit of length \"a name that is longe\" is not known, mm are taken");
    expect_read("1.0,0,", 0.0254, 1, "no unit of length is named, inches are taken");
    expect_read(",,", 0.0254, 1, "no unit of length is named, inches are taken");
    expect_read("1.0,1,2HMM", 0.0254, 1, "the unit of length is INCH by its flag, \"MM\" by its name: INCH is taken");
    expect_read("1.0,6,8HMILLIMET", 1, 1, "the unit of length is M by its flag, \"MILLIMET\" by its name: M is taken");
}

static void a_scale_is_reported(void **state)
{
    (void)state;
    need_cad();
    expect_read("2.0,2,2HMM", 1e-3, 1,
                "the model space scale of 2 is not applied: real lengths are these divided by it");
    expect_read("1.23456789D-5,2,2HMM", 1e-3, 1,
                "the model space scale of 1.23456789e-05 is not applied: real lengths are these divided by it");
    expect_read("0.,2,2HMM", 1e-3, 1, "the model space scale of 0 is none, 1 is taken");
    expect_read("2.0,1,2HMM", 0.0254, 2, "the unit of length is INCH by its flag, \"MM\" by its name: INCH is taken");
}

static void a_flag_that_is_none_is_refused(void **state)
{
    (void)state;
    need_cad();
    static const struct {
        const char *lengths, *found;
    } cases[] = {
        {"1.0,77,2HMM", "found the flag 77 and the name \"MM\""},
        {"1.0,12,", "found the flag 12 and the name \"\""},
        {"1.0,-1,2HMM", "found the flag -1 and the name \"MM\""},
        {"1.0,0,6HFATHOM", "found the flag 0 and the name \"FATHOM\""},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const sp_cad_options options = sp_cad_options_default();
        sp_error error = {0};
        write_square("square.igs", cases[i].lengths);
        assert_null(sp_cad_load("square.igs", 1, &options, NULL, &error));
        assert_int_equal(error.kind, SP_ERROR_INPUT);
        if (!strstr(error.message, cases[i].found) || !strstr(error.message, "expected a flag from 1 to 11"))
            fail_msg("%s: %s", cases[i].lengths, error.message);
    }
    assert_int_equal(remove("square.igs"), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_unit_that_is_known_is_taken),
        cmocka_unit_test(a_unit_in_doubt_is_reported),
        cmocka_unit_test(a_scale_is_reported),
        cmocka_unit_test(a_flag_that_is_none_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
