/* STEP files that do not state the unit of their lengths. */
#include "files.h"

/* The first unit that OpenCASCADE lists is that of lengths. */
static void take_units_away(const char *from, const char *to)
{
    char *text = read_text(from), *at = text;
    size_t taken = 0;
    while ((at = strstr(at, "GLOBAL_UNIT_ASSIGNED_CONTEXT")) != NULL) {
        char *first = strchr(at, '#'), *second = strchr(first + 1, '#');
        assert_true(first && second);
        memset(first, ' ', (size_t)(second - first));
        at = second;
        taken++;
    }
    assert_true(taken > 0);
    FILE *file = fopen(to, "wb");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0);
    assert_int_equal(fclose(file), 0);
    free(text);
}

static void what_is_taken_for_mm_is_reported(void **state)
{
    (void)state;
    need_cad();
    const sp_cad_options options = sp_cad_options_default();
    sp_cad_account account, other;
    make_cad("ball", "stated.step", "MM");
    take_units_away("stated.step", "silent.step");
    sp_mesh *stated = load_cad("stated.step", 1, &options, &account);
    sp_mesh *silent = load_cad("silent.step", 1, &options, &other);
    assert_int_equal(account.faults, 0);
    assert_int_equal(other.faults, 1);
    assert_string_equal(other.fault, "no unit of length is stated, mm are taken");
    assert_true(fabs(part_area(silent, 0) / part_area(stated, 0) - 1) < 1e-9);
    sp_mesh_destroy(silent);
    sp_mesh_destroy(stated);
    assert_int_equal(remove("stated.step"), 0);
    assert_int_equal(remove("silent.step"), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_taken_for_mm_is_reported),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
