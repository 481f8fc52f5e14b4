/* STEP files of surfaces that close on themselves, with nozzles across their seams. */
#include "files.h"

static void expect_sound(const sp_mesh *mesh, const sp_cad_account *account, double area, double volume)
{
    double own;
    assert_int_equal(account->faults, 0);
    assert_int_equal(mesh->part_count, 1);
    assert_true(fabs(part_area(mesh, 0) / area - 1) < 3e-3);
    assert_true(fabs(mesh->parts[0].volume / volume - 1) < 1e-5);
    assert_true(sp_mesh_volumes(mesh, &own, NULL));
    assert_true(fabs(own / volume - 1) < 1e-2);
}

/* A sphere with a shut pipe that begins in its middle and ends at `length` from there. */
static void measure_ball(double radius, double pipe, double length, double *area, double *volume)
{
    double out = sqrt(radius * radius - pipe * pipe), cap = radius - out;
    *area =
        4 * M_PI * radius * radius - 2 * M_PI * radius * cap + 2 * M_PI * pipe * (length - out) + M_PI * pipe * pipe;
    *volume = 4 * M_PI / 3 * radius * radius * radius - M_PI / 3 * cap * cap * (3 * radius - cap) +
              M_PI * pipe * pipe * (length - out);
}

/* OpenCASCADE took the two lids that the nozzles cut out of the spheres, and the pipes, for all of it. */
static void a_ball_keeps_its_walls(void **state)
{
    (void)state;
    static const char *const units[] = {"MM", "INCH"};
    need_cad();
    double area[2], volume[2];
    measure_ball(0.5, 0.05, 0.7, &area[0], &volume[0]);
    measure_ball(0.495, 0.045, 0.695, &area[1], &volume[1]);
    for (int i = 0; i < 2; i++) {
        const sp_cad_options options = sp_cad_options_default();
        sp_cad_account account;
        make_cad("ball", "ball.step", units[i]);
        sp_mesh *mesh = load_cad("ball.step", 1, &options, &account);
        expect_sound(mesh, &account, area[0] + area[1], volume[0] - volume[1]);
        sp_mesh_destroy(mesh);
        assert_int_equal(remove("ball.step"), 0);
    }
}

/* As a BREP file has it, which needs no reading of curves. */
static void a_head_keeps_its_edges(void **state)
{
    (void)state;
    static const char *const degrees[] = {"0", "90", "180"};
    need_cad();
    for (int i = 0; i < 3; i++) {
        const sp_cad_options options = sp_cad_options_default();
        sp_cad_account account, same;
        make_cad("head", "head.step", degrees[i]);
        make_cad("head", "head.brep", degrees[i]);
        sp_mesh *mesh = load_cad("head.step", 1, &options, &account);
        sp_mesh *exact = load_cad("head.brep", 1e-3, &options, &same);
        expect_sound(mesh, &account, part_area(exact, 0), exact->parts[0].volume);
        sp_mesh_destroy(exact);
        sp_mesh_destroy(mesh);
        assert_int_equal(remove("head.step"), 0);
        assert_int_equal(remove("head.brep"), 0);
    }
}

/* Its ellipses become arcs of nearly a whole turn, which are read as they are. */
static void spoil(const char *path)
{
    static const char surface[] = "SURFACE_OF_REVOLUTION('',#";
    char *text = read_text(path), *at = text;
    char *end = strstr(strstr(text, "\nDATA;"), "\nENDSEC;");
    unsigned curves[8], count = 0;
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    for (char *next; (next = strstr(at, surface)) != NULL && count < 8; count++) {
        next += sizeof surface - 1;
        fprintf(file, "%.*s%u", (int)(next - at), at, 900000 + count);
        curves[count] = (unsigned)strtoul(next, &at, 10);
    }
    assert_int_equal(count, 2);
    fprintf(file, "%.*s\n", (int)(end - at), at);
    for (unsigned i = 0; i < count; i++)
        fprintf(file, "#%u = TRIMMED_CURVE('',#%u,(PARAMETER_VALUE(-3.)),(PARAMETER_VALUE(3.)),.T.,.PARAMETER.);\n",
                900000 + i, curves[i]);
    fprintf(file, "%s", end + 1);
    assert_int_equal(fclose(file), 0);
    free(text);
}

static void what_is_read_wrong_is_reported(void **state)
{
    (void)state;
    need_cad();
    const sp_cad_options options = sp_cad_options_default();
    sp_cad_account account;
    make_cad("head", "spoilt.step", "0");
    spoil("spoilt.step");
    sp_mesh *mesh = load_cad("spoilt.step", 1, &options, &account);
    assert_int_equal(account.faults, 3);
    assert_non_null(strstr(account.fault, ": a solid's faces are bounded wrong"));
    sp_mesh_destroy(mesh);
    assert_int_equal(remove("spoilt.step"), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_ball_keeps_its_walls),
        cmocka_unit_test(a_head_keeps_its_edges),
        cmocka_unit_test(what_is_read_wrong_is_reported),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
