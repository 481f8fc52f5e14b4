/* The PLY reader: text and bytes of either order. */
#include "mesh_files.h"

#include <math.h>

#define VERTICES "element vertex 4\nproperty float x\nproperty double y\nproperty float z\n"
#define FACES "element face 2\nproperty list uchar int vertex_indices\n"
#define HEADER(format) "ply\nformat " format " 1.0\ncomment a tetrahedron's half\n" VERTICES FACES "end_header\n"
#define POINTS "0 0 0\n1 0 0\n0 1 0\n0 0 1e0\n"

static const char text[] = HEADER("ascii") POINTS "3 0 2 1\n3 0 1 3\n";

static void assert_half(const sp_mesh *mesh)
{
    assert_int_equal(mesh->vertex_count, 4);
    assert_int_equal(mesh->triangle_count, 2);
    assert_string_equal(mesh->parts[0].name, "default");
    const uint32_t expected[2][3] = {{0, 2, 1}, {0, 1, 3}};
    assert_memory_equal(mesh->triangles, expected, sizeof expected);
    assert_true(mesh->vertices[1].x == 1 && mesh->vertices[2].y == 1 && mesh->vertices[3].z == 1);
}

/* Puts a number of so many bytes down, highest byte first where asked for. */
static size_t put(unsigned char *at, const void *number, size_t size, bool big)
{
    const unsigned char *bytes = number;
    const uint16_t one = 1;
    bool reversed = big == (*(const unsigned char *)&one == 1);
    for (size_t i = 0; i < size; i++)
        at[i] = bytes[reversed ? size - 1 - i : i];
    return size;
}

/* The same surface; `end` ends the lines of the header. Returns the size. */
static size_t make_binary(unsigned char bytes[400], bool big, const char *end)
{
    static const float points[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    static const int32_t faces[2][3] = {{0, 2, 1}, {0, 1, 3}};
    const char *header = big ? HEADER("binary_big_endian") : HEADER("binary_little_endian");
    size_t size = 0;
    for (; *header; header++) {
        const char *put_down = *header == '\n' ? end : (const char[]){*header, '\0'};
        memcpy(bytes + size, put_down, strlen(put_down));
        size += strlen(put_down);
    }
    for (int i = 0; i < 4; i++) {
        double y = (double)points[i][1];
        size += put(bytes + size, &points[i][0], 4, big);
        size += put(bytes + size, &y, 8, big);
        size += put(bytes + size, &points[i][2], 4, big);
    }
    for (int i = 0; i < 2; i++) {
        bytes[size++] = 3;
        for (int k = 0; k < 3; k++)
            size += put(bytes + size, &faces[i][k], 4, big);
    }
    return size;
}

static void all_forms_are_the_same_surface(void **state)
{
    (void)state;
    sp_mesh *mesh = read_good(".ply", text);
    assert_half(mesh);
    sp_mesh_destroy(mesh);
    for (int i = 0; i < 4; i++) {
        unsigned char bytes[400];
        sp_error error = {0};
        mesh = read_bytes(".PLY", bytes, make_binary(bytes, i & 1, i & 2 ? "\r\n" : "\n"), &error);
        assert_string_equal(error.message, "");
        assert_half(mesh);
        sp_mesh_destroy(mesh);
    }
}

/* What others write besides: more elements and properties, polygons, empty lines, other names of types. */
static void what_is_no_surface_is_skipped(void **state)
{
    (void)state;
    sp_mesh *mesh = read_good(
        ".ply", "ply\r\nformat ascii 1.0\r\nobj_info num_cols 512\r\nelement camera 1\r\n"
                "property float32 f\r\nproperty list uint8 float64 lens\r\nelement nothing 7\r\n"
                "element vertex 5\r\nproperty uchar red\r\nproperty float nx\r\nproperty int16 z\r\n"
                "property float32 x\r\nproperty list uchar int near\r\nproperty float64 y\r\n"
                "element face 2\r\nproperty uchar flags\r\nproperty list uint8 uint32 vertex_index\r\n"
                "property list uchar float texcoord\r\nelement edge 1\r\nproperty int vertex1\r\n"
                "end_header\r\n"
                "nan 2 0.5 inf\r\n"
                "255 nan 0 0 0 0\r\n0 0 0 2 2 8 9 0\r\n\r\n  0 0 0 2 0 2  \r\n0 0 0 1 1 7 3\r\n0 0 0 0 0 2\r\n"
                "1 5 0 1 2 3 4 6 0 0 1 0 1 1\r\n7 3 0 2 4 0\r\n12\r\n\r\n");
    assert_int_equal(mesh->triangle_count, 4);
    assert_int_equal(mesh->vertex_count, 5);
    assert_true(mesh->vertices[3].y == 3 && mesh->vertices[2].x == 2);
    sp_mesh_destroy(mesh);
}

static void wrong_headers_are_refused_at_their_line(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        int line;
        const char *what;
    } cases[] = {
        {"", 1, "found no 'ply'"},
        {"plyx\n", 1, "found no 'ply'"},
        {"ply\nelement vertex 4\n", 2, "found 'element', expected format"},
        {"ply\nformat ascii 2.0\n", 2, "found '2.0', expected 1.0"},
        {"ply\nformat binary 1.0\n", 2, "expected ascii, binary_little_endian or binary_big_endian"},
        {"ply\nformat ascii\n", 2, "found the end of the line, expected 1.0"},
        {"ply\nformat ascii 1.0\nproperty int a\n", 3, "expected an element before it"},
        {"ply\nformat ascii 1.0\nelement vertex -1\n", 3, "found '-1', expected a whole number"},
        {"ply\nformat ascii 1.0\nelement vertex 1.5\n", 3, "found '1.5', expected a whole number"},
        {"ply\nformat ascii 1.0\nelement vertex 99999999999\n", 3, "expected a whole number below 4294967295"},
        {"ply\nformat ascii 1.0\nelement vertex 4 5\n", 3, "found '5', expected the end of the line"},
        {"ply\nformat ascii 1.0\nelement vertex 4\nproperty half x\n", 4, "found 'half', expected a type"},
        {"ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty int x\n", 5, "this property once"},
        {"ply\nformat ascii 1.0\nelement vertex 4\nelement vertex 4\n", 4, "this element once"},
        {"ply\nformat ascii 1.0\nelement face 4\n", 3, "expected vertex before it"},
        {"ply\nformat ascii 1.0\nelement tristrips 1\n", 3, "found 'tristrips', expected surface in faces only"},
        {"ply\nformat ascii 1.0\n" VERTICES "element face 1\nproperty list float int vertex_indices\n", 8,
         "found 'float', expected a type of whole numbers"},
        {"ply\nformat ascii 1.0\n" VERTICES "element face 1\nproperty list int float vertex_indices\n", 8,
         "found 'float', expected a type of whole numbers"},
        {"ply\nformat ascii 1.0\n" VERTICES "what is this\n", 7, "found 'what', expected element"},
        {"ply\nformat ascii 1.0\n" VERTICES FACES, 9, "found the end of the file, expected end_header"},
        {"ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n" FACES "end_header\n", 3,
         "found 'vertex', expected its properties x, y and z"},
        {"ply\nformat ascii 1.0\n" VERTICES "element face 2\nproperty int a\nend_header\n", 7,
         "found 'face', expected its property list vertex_indices"},
        {"ply\nformat ascii 1.0\n" VERTICES "end_header\n" POINTS, 0, "a header without an element face"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        read_bad(".ply", cases[i].text, cases[i].line, cases[i].what);
}

static void wrong_bodies_are_refused_at_their_line(void **state)
{
    (void)state;
    static const struct {
        const char *body;
        int line;
        const char *what;
    } cases[] = {
        {"0 0 0\n1 0 0\n0 x 0\n", 13, "found 'x', expected"},
        {"0 0 0\n1 0 0\n0 nan 0\n", 13, "nan"},
        {"0 0 0\n1 0\n", 12, "found the end of the line, expected a number"},
        {"0 0 0\n1 0 0 0\n", 12, "found '0', expected the end of the line"},
        {"0 0 0\n1 0 1e31\n", 12, "found in vertex 2 of 4 a number that is not finite or beyond 1e30 m"},
        {POINTS "3 0 2 4\n", 15, "found in face 1 of 2 a corner that no vertex has"},
        {POINTS "3 0 2 -1\n", 15, "a corner that no vertex has"},
        {POINTS "3 0 2 0.5\n", 15, "a corner that no vertex has"},
        {POINTS "2 0 2\n", 15, "fewer than three corners"},
        {POINTS "-3 0 2 1\n", 15, "a list of no whole length"},
        {POINTS "3.5 0 2 1\n", 15, "a list of no whole length"},
        {POINTS "4294967290 0 2 1\n", 15, "found the end of the line, expected a number"},
        {POINTS "3 0 2 1\n", 16, "found the end of the file, expected as many lines as the header says"},
        {POINTS "3 0 2 1\n3 0 1 3\n3 0 1 3\n", 17, "found more behind the last element"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char whole[1000];
        snprintf(whole, sizeof whole, "%s%s", HEADER("ascii"), cases[i].body);
        read_bad(".ply", whole, cases[i].line, cases[i].what);
    }
}

/* An element that takes nothing does not take long. */
static void elements_without_properties_are_stepped_over(void **state)
{
    (void)state;
    char whole[1000];
    snprintf(whole, sizeof whole, "ply\nformat ascii 1.0\nelement nothing 4294967294\n%s", strstr(text, "comment"));
    sp_mesh *mesh = read_good(".ply", whole);
    assert_half(mesh);
    sp_mesh_destroy(mesh);
}

static void more_elements_or_properties_than_allowed_are_refused(void **state)
{
    (void)state;
    char *whole = malloc(1 << 16);
    assert_non_null(whole);
    for (int elements = 0; elements < 2; elements++) {
        strcpy(whole, "ply\nformat ascii 1.0\nelement a 1\n");
        for (int i = 0; i < 300; i++)
            strcat(whole, elements ? "element b 1\n" : "property int b\n");
        read_bad(".ply", whole, elements ? 35 : 260, elements ? "at most 32 elements" : "at most 256 properties");
    }
    free(whole);
}

/* Cut at any length, and each byte changed: a mesh or an error. */
static void damage_is_no_crash(void **state)
{
    (void)state;
    for (int form = 0; form < 3; form++) {
        unsigned char bytes[400], damaged[400];
        size_t size = sizeof text - 1;
        if (form == 0)
            memcpy(bytes, text, size);
        else
            size = make_binary(bytes, form == 2, "\n");
        for (size_t at = 0; at < 2 * size; at++) {
            sp_error error = {0};
            memcpy(damaged, bytes, size);
            damaged[at / 2] ^= at % 2 ? 0x80 : 0x01;
            sp_mesh *mesh = read_bytes(".ply", damaged, at % 2 ? size : at / 2, &error);
            assert_true((mesh != NULL) == (error.kind == SP_OK));
            assert_true(!mesh || at % 2 || (form == 0 && at / 2 + 1 >= size));
            sp_mesh_destroy(mesh);
        }
    }
}

static void bytes_beyond_the_last_element_are_refused(void **state)
{
    (void)state;
    unsigned char bytes[400] = {0};
    sp_error error = {0};
    size_t size = make_binary(bytes, false, "\n");
    assert_null(read_bytes(".ply", bytes, size + 1, &error));
    assert_non_null(strstr(error.message, "found more behind the last element"));
}

/* A coordinate of bytes that is no number. */
static void binary_numbers_are_checked(void **state)
{
    (void)state;
    const float wrong[] = {NAN, INFINITY, 1e31f};
    for (int i = 0; i < 6; i++) {
        unsigned char bytes[400];
        sp_error error = {0};
        size_t size = make_binary(bytes, i % 2, "\n"), faces = 2 * 13;
        put(bytes + size - faces - 16, &wrong[i / 2], 4, i % 2); /* the last vertex's x */
        assert_null(read_bytes(".ply", bytes, size, &error));
        assert_non_null(strstr(error.message, "vertex 4 of 4"));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_forms_are_the_same_surface),
        cmocka_unit_test(what_is_no_surface_is_skipped),
        cmocka_unit_test(wrong_headers_are_refused_at_their_line),
        cmocka_unit_test(wrong_bodies_are_refused_at_their_line),
        cmocka_unit_test(elements_without_properties_are_stepped_over),
        cmocka_unit_test(more_elements_or_properties_than_allowed_are_refused),
        cmocka_unit_test(damage_is_no_crash),
        cmocka_unit_test(bytes_beyond_the_last_element_are_refused),
        cmocka_unit_test(binary_numbers_are_checked),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
