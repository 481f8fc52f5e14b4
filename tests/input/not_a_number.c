/* NaN, infinity and what is too large for a number, in the place of every number of a scene, a catalogue, a mesh and a
 * file of rays in turn: refused, with the line that holds it. */
#include "../scene/scratch.h"

#include <sprayplan/mesh.h>
#include <sprayplan/scene.h>

#include <ctype.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#ifdef SPRAYPLAN_SANITIZE /* one of each sort: which spellings are numbers is seen without */
static const char *const no_numbers[] = {"-nan", ".inf", "1e999"};
#else
static const char *const no_numbers[] = {"nan", ".nan", "-nan", "inf", ".inf", "-.inf", "Infinity", "1e999", "-1e999"};
#endif
#define KINDS (sizeof no_numbers / sizeof *no_numbers)

/* Whether a number begins there: not within a word such as N1, and a unit's exponent such as m2 is no number. */
static bool begins_number(const char *text, const char *at)
{
    char before = at > text ? at[-1] : ' ';
    return isdigit((unsigned char)*at) && !isalnum((unsigned char)before) && !strchr("_.-", before);
}

static size_t number_length(const char *at)
{
    return strspn(at, "0123456789.");
}

static int line_of(const char *text, const char *at)
{
    int line = 1;
    for (; text < at; text++)
        line += *text == '\n';
    return line;
}

/* Loads what lies in `file` and what belongs to it; false with an error. */
typedef bool loader(sp_error *error);

/* Every number of `text` in turn; returns how many there are. */
static int assert_numbers_refused(const char *file, const char *text, loader *load)
{
    sp_error none = {0};
    int count = 0;
    scratch_write(file, text);
    if (!load(&none))
        fail_msg("%s is refused as it is: %s", file, none.message);
    for (const char *at = text; *at; at++) {
        if (!begins_number(text, at))
            continue;
        size_t length = number_length(at);
        for (size_t k = 0; k < KINDS; k++) {
            char *damaged = malloc(strlen(text) + 32);
            assert_non_null(damaged);
            sprintf(damaged, "%.*s%s%s", (int)(at - text), text, no_numbers[k], at + length);
            scratch_write(file, damaged);
            free(damaged);
            sp_error error = {0};
            if (load(&error) || error.kind != SP_ERROR_INPUT)
                fail_msg("%s:%d: %s in the place of %.*s is taken", file, line_of(text, at), no_numbers[k], (int)length,
                         at);
            if (error.line != line_of(text, at) || !strstr(error.file, file))
                fail_msg("%s:%d: %s in the place of %.*s: %s:%d: %s", file, line_of(text, at), no_numbers[k],
                         (int)length, at, error.file, error.line, error.message);
        }
        count++;
        at += length - 1;
    }
    scratch_write(file, text);
    print_message("%s: %d numbers, each refused as any of %zu that are none\n", file, count, KINDS);
    return count;
}

static bool load_scene(sp_error *error)
{
    sp_scene *scene = sp_scene_load("scene.yaml", error);
    sp_scene_destroy(scene);
    return scene != NULL;
}

static void in_a_scene(void **state)
{
    (void)state;
    scratch_write("catalogue.yaml", catalogue);
    assert_true(assert_numbers_refused("scene.yaml", full_scene, load_scene) > 70);
    assert_true(assert_numbers_refused("catalogue.yaml", catalogue, load_scene) > 20);
}

static bool load_obj(sp_error *error)
{
    sp_mesh *mesh = sp_mesh_load("solid.obj", 1, error);
    sp_mesh_destroy(mesh);
    return mesh != NULL;
}

static bool load_stl(sp_error *error)
{
    sp_mesh *mesh = sp_mesh_load("solid.stl", 1, error);
    sp_mesh_destroy(mesh);
    return mesh != NULL;
}

/* Of an STL file the normals are not read. */
static void in_a_mesh(void **state)
{
    (void)state;
    static const char stl[] = "solid a\n"
                              "facet normal nan inf nan\nouter loop\n"
                              "vertex 0 0 0\nvertex 1.5 0 0\nvertex 0 2 0\n"
                              "endloop\nendfacet\nendsolid a\n";
    assert_int_equal(assert_numbers_refused("solid.obj", tetrahedron, load_obj), 12 + 12);
    assert_int_equal(assert_numbers_refused("solid.stl", stl, load_stl), 9);
}

/* The three corners of one triangle, and what no float is in each of their coordinates. */
static void in_a_binary_mesh(void **state)
{
    (void)state;
    static const uint32_t no_floats[] = {0x7f800000, 0xff800000, 0x7fc00000, 0xffc00001, 0x7f800001};
    static const float corners[9] = {0, 0, 0, 1.5f, 0, 0, 0, 2, 0};
    for (int i = -1; i < 9; i++)
        for (size_t k = 0; k < sizeof no_floats / sizeof *no_floats; k++) {
            char bytes[134] = {0};
            const uint32_t one = 1;
            memcpy(bytes + 80, &one, 4);
            memcpy(bytes + 96, corners, 36);
            if (i >= 0)
                memcpy(bytes + 96 + 4 * i, &no_floats[k], 4);
            scratch_write_bytes("solid.stl", bytes, sizeof bytes);
            sp_error error = {0};
            if (load_stl(&error) != (i < 0) || (i >= 0 && error.kind != SP_ERROR_INPUT))
                fail_msg("coordinate %d as %08x: %s", i, no_floats[k], error.message);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(in_a_scene),
        cmocka_unit_test(in_a_mesh),
        cmocka_unit_test(in_a_binary_mesh),
    };
    return cmocka_run_group_tests(tests, scratch_make, scratch_remove);
}
