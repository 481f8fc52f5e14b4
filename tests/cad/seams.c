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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_head_keeps_its_edges),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
