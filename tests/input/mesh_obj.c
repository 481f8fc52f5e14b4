/* The OBJ reader: what it takes, what it refuses and where it says so. */
#include "mesh_files.h"

#include <locale.h>

#define SQUARE "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"

static void assert_triangle(const sp_mesh *mesh, size_t t, uint32_t a, uint32_t b, uint32_t c)
{
    assert_true(t < mesh->triangle_count);
    assert_int_equal(mesh->triangles[t][0], a);
    assert_int_equal(mesh->triangles[t][1], b);
    assert_int_equal(mesh->triangles[t][2], c);
}

static void polygons_become_fans(void **state)
{
    (void)state;
    sp_mesh *mesh = read_good(".obj", SQUARE "v 2 0.5 0\nf 1 2 5 3 4\n");
    assert_int_equal(mesh->triangle_count, 3);
    assert_triangle(mesh, 0, 0, 1, 4);
    assert_triangle(mesh, 1, 0, 4, 2);
    assert_triangle(mesh, 2, 0, 2, 3);
    sp_mesh_destroy(mesh);
}

static void every_form_of_index_is_read(void **state)
{
    (void)state;
    sp_mesh *mesh = read_good(".obj", SQUARE "vt 0 0\nvt 1\nvt 0 0 0\nvn 0 0 1\n"
                                             "f 1 2 3\nf 1/1 2/2 3/3\nf 1//1 2//1 3//1\nf 1/1/1 2/-1/-1 3/3/1\n"
                                             "f -4 -3 -2\nf +1 02 3\n");
    assert_int_equal(mesh->triangle_count, 6);
    for (size_t t = 0; t < 6; t++)
        assert_triangle(mesh, t, 0, 1, 2);
    sp_mesh_destroy(mesh);
}

static void negative_indices_count_from_where_they_stand(void **state)
{
    (void)state;
    sp_mesh *mesh = read_good(".obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 0 0 1\nv 1 0 1\nv 0 1 1\nf -3 -2 -1\n");
    assert_triangle(mesh, 0, 0, 1, 2);
    assert_triangle(mesh, 1, 3, 4, 5);
    sp_mesh_destroy(mesh);
}

static void groups_and_objects_are_parts(void **state)
{
    (void)state;
    sp_mesh *mesh =
        read_good(".obj", SQUARE "f 1 2 3\ng lid\ng shell\nf 1 2 3\no  lid   upper \nf 1 2 4\ng shell\nf 1 3 4\n"
                                 "g\nf 2 3 4\n");
    assert_int_equal(mesh->part_count, 3);
    assert_string_equal(mesh->parts[0].name, "default");
    assert_string_equal(mesh->parts[1].name, "shell");
    assert_string_equal(mesh->parts[2].name, "lid upper");
    static const uint32_t expected[] = {0, 1, 2, 1, 0};
    for (size_t t = 0; t < 5; t++)
        assert_int_equal(mesh->part[t], expected[t]);
    sp_mesh_destroy(mesh);
}

static void many_groups_keep_their_numbers(void **state)
{
    (void)state;
    enum { GROUPS = 1000 };
    char *text = malloc(GROUPS * 40 + 100), *at = text;
    assert_non_null(text);
    at += sprintf(at, SQUARE);
    for (int i = 0; i < 2 * GROUPS; i++)
        at += sprintf(at, "g n%d\nf 1 2 3\n", i % GROUPS);
    sp_mesh *mesh = read_good(".obj", text);
    assert_int_equal(mesh->part_count, GROUPS);
    for (int i = 0; i < 2 * GROUPS; i++)
        assert_int_equal(mesh->part[i], i % GROUPS);
    assert_string_equal(mesh->parts[GROUPS - 1].name, "n999");
    sp_mesh_destroy(mesh);
    free(text);
}

static void names_that_are_not_utf8_become_it(void **state)
{
    (void)state;
    sp_mesh *mesh =
        read_good(".obj", SQUARE "g Beh\xE4lter\nf 1 2 3\ng Beh\xC3\xA4lter\nf 1 3 4\ng \xED\xA0\x80\nf 1 2 4\n");
    assert_int_equal(mesh->part_count, 2);
    assert_string_equal(mesh->parts[0].name, "Beh\xC3\xA4lter");
    assert_string_equal(mesh->parts[1].name, "\xC3\xAD\xC2\xA0\xC2\x80");
    sp_mesh_destroy(mesh);
}

static void line_ends_comments_and_continuations(void **state)
{
    (void)state;
    sp_mesh *mesh = read_good(
        ".obj", "\xEF\xBB\xBF# comment \\\nv 0 0 0 # behind\r\nv\t1 \\\r\n 0\\\n 0\r\n\r\n  v 0 1 0\rf 1 2 \\\n3");
    assert_int_equal(mesh->triangle_count, 1);
    assert_true(mesh->vertices[1].x == 1 && mesh->vertices[2].y == 1);
    sp_mesh_destroy(mesh);
}

static void harmless_statements_are_skipped(void **state)
{
    (void)state;
    sp_mesh *mesh =
        read_good(".obj", "mtllib a b.mtl\nv 0 0 0 1\nv 1 0 0 0.5 0.5 0.5\nv 0 1 0 1 0.5 0.5 0.5\nusemtl steel\ns off\n"
                          "l 1 2\np 1\nvp 1 2\nlod 3\nf 1 2 3\n");
    assert_int_equal(mesh->triangle_count, 1);
    sp_mesh_destroy(mesh);
}

static void numbers_in_every_notation(void **state)
{
    (void)state;
    sp_mesh *mesh = read_good(".obj", "v -1.5e-3 +.25 1.\nv 1E2 00.5 -0\nv 0.1e+1 1e-400 3\nf 1 2 3\n");
    assert_true(mesh->vertices[0].x == -1.5e-3 && mesh->vertices[0].y == 0.25 && mesh->vertices[0].z == 1);
    assert_true(mesh->vertices[1].x == 100 && mesh->vertices[1].y == 0.5 && !signbit(mesh->vertices[1].z));
    assert_true(mesh->vertices[2].x == 1 && mesh->vertices[2].y == 0);
    sp_mesh_destroy(mesh);
}

static void a_decimal_comma_in_the_locale_changes_nothing(void **state)
{
    (void)state;
    static const char *const names[] = {"de_DE.UTF-8", "de_DE", "fr_FR.UTF-8", "fr_FR"};
    bool set = false;
    for (size_t i = 0; i < 4 && !set; i++)
        set = setlocale(LC_NUMERIC, names[i]) != NULL;
    if (!set) {
        print_message("no locale with a decimal comma here\n");
        skip();
    }
    sp_mesh *mesh = read_good(".obj", "v 0.5 0 0\nv 1.5 0 0\nv 0 1.25 0\nf 1 2 3\n");
    assert_true(mesh->vertices[0].x == 0.5 && mesh->vertices[2].y == 1.25);
    sp_mesh_destroy(mesh);
    setlocale(LC_NUMERIC, "C");
}

static void bad_input_is_refused_at_its_line(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        int line;
        const char *what;
    } cases[] = {
        {"", 0, "no triangle"},
        {SQUARE, 0, "no triangle"},
        {"v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", 0, "without area"},
        {"v 0 0\n", 1, "end of the line"},
        {"v 0 0 0\nv 0 0 x\n", 2, "'x'"},
        {"v 0 0 0\nv 0 0 1.5.2\n", 2, "'1.5.2'"},
        {"v 0 0 0x10\n", 1, "'0x10'"},
        {"v 0 0 nan\n", 1, "'nan'"},
        {"v inf 0 0\n", 1, "'inf'"},
        {"v 0 1,5 0\n", 1, "'1,5'"},
        {"v 0 1e 0\n", 1, "'1e'"},
        {"v 0 . 0\n", 1, "'.'"},
        {"v 0 - 0\n", 1, "'-'"},
        {"v 0 1e999 0\n", 1, "'1e999'"},
        {"v 0 1e200 0\n", 1, "1e30"},
        {"v 1 2 3 4 5\n", 1, "five"},
        {"v 1 2 3 4 5 6 7 8\n", 1, "'8'"},
        {SQUARE "f 1 2\n", 5, "three corners"},
        {SQUARE "f 1 2 \\\n", 6, "three corners"},
        {SQUARE "f\n", 5, "three corners"},
        {SQUARE "f 1 2 0\n", 5, "index 0"},
        {SQUARE "f 1 2 5\n", 5, "index 5"},
        {SQUARE "f 1 2 -5\n", 5, "index -5"},
        {SQUARE "f 1 2 99999999999999999999\n", 5, "index 99999"},
        {SQUARE "f 1 2 4294967297\n", 5, "index 4294967297"},
        {SQUARE "f 1 2 3.0\n", 5, "'3.0'"},
        {SQUARE "f 1 2 3a\n", 5, "'3a'"},
        {SQUARE "f 1 2 --3\n", 5, "'--3'"},
        {SQUARE "f 1/1 2/1 3/1\n", 5, "texture index 1"},
        {SQUARE "f 1//1 2//1 3//1\n", 5, "normal index 1"},
        {SQUARE "vt 0 0\nf 1/ 2/ 3/\n", 6, "'1/'"},
        {SQUARE "vt 0 0\nf 1/1/ 2/1/ 3/1/\n", 6, "'1/1/'"},
        {SQUARE "vt 0 0\nvn 0 0 1\nf 1/1/1/1 2/1/1 3/1/1\n", 7, "'1/1/1/1'"},
        {SQUARE "vt 0 0\nf 1/1 2 3/1\n", 6, "same form"},
        {SQUARE "f 1 2 \\\n 3 \\\n 9\n", 7, "index 9"},
        {"f 1 2 3\n" SQUARE, 1, "index 1"},
        {"vn 0 1\n", 1, "end of the line"},
        {"vn 0 1 0 0\n", 1, "'0'"},
        {"vt\n", 1, "end of the line"},
        {"vt 0 zero\n", 1, "'zero'"},
        {"\n\nvertex 0 0 0\n", 3, "'vertex'"},
        {"# fine\r\n\r\nV 0 0 0\r\n", 3, "'V'"},
        {"v 0 0 0\rv 0 0\r", 2, "end of the line"},
        {"cstype bezier\n", 1, "curved"},
        {"g a\x01"
         "b\n",
         1, "control"},
        {"<html>\n", 1, "'<html>'"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        read_bad(".obj", cases[i].text, cases[i].line, cases[i].what);
}

static void the_column_is_the_tokens(void **state)
{
    (void)state;
    sp_error error = {0};
    assert_null(read_text(".OBJ", SQUARE "f 1 2\t 7\n", &error));
    assert_int_equal(error.line, 5);
    assert_int_equal(error.column, 8);
}

static void zero_bytes_and_binary_are_refused(void **state)
{
    (void)state;
    sp_error error = {0};
    assert_null(read_bytes(".obj", "v 0 0 0\0\nv 1 0 0\n", 17, &error));
    assert_int_equal(error.line, 1);
    error = (sp_error){0};
    assert_null(read_bytes(".obj", "\0\0\0\0", 4, &error));
    assert_int_equal(error.line, 1);
}

/* A file cut anywhere is read or refused, and never read past. */
static void truncated_at_every_length(void **state)
{
    (void)state;
    static const char text[] =
        "# a\nmtllib m\r\n" SQUARE "vt 0.5 1e-3\nvn 0 0 1\ng caf\xC3\xA9 two\nf 1/1/1 2/1/1 \\\n 3/1/1 -1/-1/-1\n"
        "s off\no \xE4\nf 1//1 2//1 3//1\n";
    for (size_t length = 0; length < sizeof text; length++) {
        sp_error error = {0};
        sp_mesh *mesh = read_bytes(".obj", text, length, &error);
        assert_true((mesh != NULL) == (error.kind == SP_OK));
        sp_mesh_destroy(mesh);
    }
}

static void files_that_cannot_be_read(void **state)
{
    (void)state;
    sp_error error = {0};
    assert_null(sp_mesh_load("no/such/file.obj", 1, &error));
    assert_int_equal(error.kind, SP_ERROR_INPUT);
    error = (sp_error){0};
    assert_null(sp_mesh_load("mesh.step", 1, &error));
    assert_int_equal(error.kind, SP_ERROR_INPUT);
    error = (sp_error){0};
    assert_null(sp_mesh_load("obj", 1, &error));
    assert_int_equal(error.kind, SP_ERROR_INPUT);
    error = (sp_error){0};
    assert_null(sp_mesh_load("mesh.obj", 0, &error));
    assert_int_equal(error.kind, SP_ERROR_ARGUMENT);
}

/* A keyword goes on behind a zero byte. */
static void zero_bytes_end_no_word(void **state)
{
    (void)state;
    static const char *const words[] = {"v", "vt", "fo", "trace_obj"};
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        char bytes[200] = {0};
        sp_error error = {0};
        strcpy(bytes, words[i]);
        strcpy(bytes + 150, " 1 2 3\n");
        assert_null(read_bytes(".obj", bytes, 157, &error));
        assert_non_null(strstr(error.message, "a statement of the OBJ format"));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(polygons_become_fans),
        cmocka_unit_test(every_form_of_index_is_read),
        cmocka_unit_test(negative_indices_count_from_where_they_stand),
        cmocka_unit_test(groups_and_objects_are_parts),
        cmocka_unit_test(many_groups_keep_their_numbers),
        cmocka_unit_test(names_that_are_not_utf8_become_it),
        cmocka_unit_test(line_ends_comments_and_continuations),
        cmocka_unit_test(harmless_statements_are_skipped),
        cmocka_unit_test(numbers_in_every_notation),
        cmocka_unit_test(a_decimal_comma_in_the_locale_changes_nothing),
        cmocka_unit_test(bad_input_is_refused_at_its_line),
        cmocka_unit_test(the_column_is_the_tokens),
        cmocka_unit_test(zero_bytes_and_binary_are_refused),
        cmocka_unit_test(truncated_at_every_length),
        cmocka_unit_test(files_that_cannot_be_read),
        cmocka_unit_test(zero_bytes_end_no_word),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
