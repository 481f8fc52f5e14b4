/* The STL reader, text and binary. */
#include "mesh_files.h"

#define FACET(a, b, c)                                                                                                 \
    "facet normal 0 0 1\n outer loop\n  vertex " a "\n  vertex " b "\n  vertex " c "\n endloop\nendfacet\n"
#define ONE FACET("0 0 0", "1 0 0", "0 1 0")

static void solids_are_parts(void **state)
{
    (void)state;
    sp_mesh *mesh = read_good(".stl", "solid inner wall\n" ONE "endsolid inner wall\nsolid\n" ONE "endsolid\r\n"
                                      "SOLID inner wall\n" FACET("0 0 0", "1 0 0", "0 0 1") "EndSolid\n");
    assert_int_equal(mesh->triangle_count, 3);
    assert_int_equal(mesh->part_count, 2);
    assert_string_equal(mesh->parts[0].name, "inner wall");
    assert_string_equal(mesh->parts[1].name, "default");
    assert_int_equal(mesh->part[2], 0);
    assert_int_equal(mesh->vertex_count, 4);
    sp_mesh_destroy(mesh);
}

static void bad_text_is_refused_at_its_line(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        int line;
        const char *what;
    } cases[] = {
        {"solid a\nendsolid a\n", 0, "no triangle"},
        {"solid a\n" ONE, 9, "endsolid"},
        {"solid a\n" ONE "endsolid\nfacet\n", 10, "'facet'"},
        {"solid a\nfacets\n", 2, "'facets'"},
        {"solid a\nfacet 0 0 1\n", 2, "'0'"},
        {"solid a\nfacet normal 0 0\n", 3, "the end of the file"},
        {"solid a\nfacet normal 0 0\nouter loop\n", 3, "'loop', expected outer"},
        {"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 nan\n", 4, "'nan'"},
        {"solid a\nfacet normal 0 0 1\nouter lop\n", 3, "'lop'"},
        {"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0\nvertex 1 0 0\n", 5, "'vertex'"},
        {"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 1e99\n", 6, "1e30"},
        {"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nendloop\n", 6, "'endloop'"},
        {"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nvertex 0 1 1\n", 7,
         "'vertex'"},
        {"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0x1\n", 6, "'0x1'"},
        {"not an stl file at all", 0, "bytes of binary STL"},
        {"", 0, "bytes of binary STL"},
        {"# a mesh of another kind under this name, longer than the head of a binary file\nv 0 0 0\nv 1 0 0\nv 0 1 0\n"
         "f 1 2 3\n",
         0, "found no STL, expected text that begins with \"solid\", or 84 bytes of binary STL and 50 more for each"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        read_bad(".stl", cases[i].text, cases[i].line, cases[i].what);
}

enum { HEADER = 80, START = 84, RECORD = 50, TRIANGLES = 2, SIZE = START + TRIANGLES * RECORD };

static void put_word(unsigned char *at, uint32_t word)
{
    for (int i = 0; i < 4; i++)
        at[i] = (unsigned char)(word >> (8 * i));
}

static void put_float(unsigned char *at, float number)
{
    uint32_t word;
    memcpy(&word, &number, sizeof word);
    put_word(at, word);
}

/* Two triangles of a unit square, z = 0.5. `fill` is the header's byte. */
static void make_binary(unsigned char bytes[SIZE], const char *header, int fill)
{
    static const float corners[TRIANGLES][3][3] = {{{0, 0, 0.5f}, {1, 0, 0.5f}, {1, 1, 0.5f}},
                                                   {{0, 0, 0.5f}, {1, 1, 0.5f}, {0, 1, 0.5f}}};
    memset(bytes, fill, HEADER);
    memset(bytes + HEADER, 0, SIZE - HEADER);
    memcpy(bytes, header, strlen(header));
    put_word(bytes + HEADER, TRIANGLES);
    for (int t = 0; t < TRIANGLES; t++)
        for (int k = 0; k < 9; k++)
            put_float(bytes + START + RECORD * t + 12 + 4 * k, corners[t][k / 3][k % 3]);
}

static void binary_is_read_even_where_it_begins_with_solid(void **state)
{
    (void)state;
    static const char *const headers[] = {"binary", "solid from a program", ""};
    for (int i = 0; i < 3; i++) {
        unsigned char bytes[SIZE];
        sp_error error = {0};
        make_binary(bytes, headers[i], i == 1 ? ' ' : 0);
        sp_mesh *mesh = read_bytes(".StL", bytes, SIZE, &error);
        assert_non_null(mesh);
        assert_int_equal(mesh->triangle_count, 2);
        assert_int_equal(mesh->vertex_count, 4);
        assert_string_equal(mesh->parts[0].name, "default");
        assert_true(mesh->vertices[2].x == 1 && mesh->vertices[2].z == 0.5);
        sp_mesh_destroy(mesh);
    }
}

static void binary_of_the_wrong_size_is_refused(void **state)
{
    (void)state;
    static const char *const headers[] = {"binary", "solid from a program"};
    for (int i = 0; i < 2; i++) {
        unsigned char bytes[SIZE + 1] = {0};
        make_binary(bytes, headers[i], ' ');
        for (size_t length = 0; length <= SIZE + 1; length++) {
            sp_error error = {0};
            sp_mesh *mesh = read_bytes(".stl", bytes, length, &error);
            assert_true((mesh != NULL) == (length == SIZE));
            assert_true(mesh || error.kind == SP_ERROR_INPUT);
            if (!mesh && length > START)
                assert_non_null(strstr(error.message, "bytes of binary STL, expected 184"));
            sp_mesh_destroy(mesh);
        }
        sp_error error = {0};
        put_word(bytes + HEADER, UINT32_MAX);
        assert_null(read_bytes(".stl", bytes, SIZE, &error));
    }
}

/* The corners of a triangle; its normal may be anything. */
static void binary_coordinates_are_checked(void **state)
{
    (void)state;
    static const float wrong[] = {NAN, INFINITY, -INFINITY, 1e31f};
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 12; k++) {
            unsigned char bytes[SIZE];
            sp_error error = {0};
            make_binary(bytes, "", 0);
            put_float(bytes + START + RECORD + 4 * k, wrong[i]);
            sp_mesh *mesh = read_bytes(".stl", bytes, SIZE, &error);
            assert_true((mesh != NULL) == (k < 3));
            if (!mesh)
                assert_non_null(strstr(error.message, "found in triangle 2 of 2 a coordinate that is not finite"));
            sp_mesh_destroy(mesh);
        }
}

/* Whatever the normals say, nothing at all included. */
static void the_order_of_corners_decides(void **state)
{
    (void)state;
    static const char *const normals[] = {"0 0 1", "0 0 -1", "nan nan nan", "-nan(ind) inf -inf", "-1.#IND 1e999 0"};
    for (size_t i = 0; i < sizeof normals / sizeof *normals; i++) {
        char text[512];
        snprintf(text, sizeof text,
                 "solid\nfacet normal %s\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
                 "endsolid\n",
                 normals[i]);
        sp_mesh *mesh = read_good(".stl", text);
        assert_int_equal(mesh->triangle_count, 1);
        assert_true(sp_triangle_normal(mesh, 0).z == 1);
        sp_mesh_destroy(mesh);
    }
}

static void text_truncated_at_every_length(void **state)
{
    (void)state;
    static const char text[] =
        "solid caf\xC3\xA9\n" ONE "endsolid\nsolid b\n" FACET("0 0 0", "1.5e0 0 0", "0 -1 0") "endsolid b\n";
    for (size_t length = 0; length < sizeof text; length++) {
        sp_error error = {0};
        sp_mesh *mesh = read_bytes(".stl", text, length, &error);
        assert_true((mesh != NULL) == (error.kind == SP_OK));
        sp_mesh_destroy(mesh);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(solids_are_parts),
        cmocka_unit_test(bad_text_is_refused_at_its_line),
        cmocka_unit_test(binary_is_read_even_where_it_begins_with_solid),
        cmocka_unit_test(binary_of_the_wrong_size_is_refused),
        cmocka_unit_test(binary_coordinates_are_checked),
        cmocka_unit_test(the_order_of_corners_decides),
        cmocka_unit_test(text_truncated_at_every_length),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
