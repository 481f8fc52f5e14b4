/* What is read from standard input, where - stands for it. */
#include "results.h"

/* Runs `sprayplan <arguments>` with what the shell's `from` prints, or `<file`, on standard input. */
static outcome run_with(const char *from, const char *arguments)
{
    char line[2048];
    bool redirected = from[0] == '<';
    snprintf(line, sizeof line, "cd '%s' && %s%s'%s/sprayplan' %s >.out 2>.err %s", workplace, redirected ? "" : from,
             redirected ? "" : " | ", BINARY_DIR, arguments, redirected ? from : "");
    int status = system(line);
    assert_true(WIFEXITED(status));
    return (outcome){WEXITSTATUS(status), read_file(".out", NULL), read_file(".err", NULL)};
}

static void expect_with(const char *from, const char *arguments, int status, const char *complaint)
{
    outcome result = run_with(from, arguments);
    if (result.status != status || !strstr(result.err, complaint))
        print_error("%s, %s: status %d, %s\n", from, arguments, result.status, result.err);
    assert_int_equal(result.status, status);
    assert_non_null(strstr(result.err, complaint));
    forget(&result);
}

/* What depends on where the scene came from, or on the clock. */
static void forget_origin(json_t *result)
{
    json_object_del(result, "scene");
    json_object_del(result, "inputs");
    json_object_del(result, "stages");
}

/* Through a pipe: other files are found from the working directory, and what is written is whole. */
static void a_scene(void **state)
{
    (void)state;
    json_t *named = expect_json("simulate room.yaml " COARSE " --json", 0);
    outcome result = run_with("cat room.yaml", "simulate - " COARSE " --json -o out");
    assert_int_equal(result.status, 0);
    json_t *piped = json_loads(result.out, 0, NULL);
    assert_string_equal(json_string_value(json_object_get(piped, "scene")), "standard input");
    assert_int_equal(json_array_size(json_object_get(piped, "inputs")), 2); /* what came through a pipe is gone */
    forget_origin(named);
    forget_origin(piped);
    assert_true(json_equal(named, piped));
    json_decref(named);
    json_decref(piped);
    forget(&result);
    json_decref(expect_json("check out/layout.yaml --json", 0));
}

static void errors_in_it_say_where(void **state)
{
    (void)state;
    expect_with("sed s/geometry/geomtry/ room.yaml", "check -", 3, "standard input:1:1: geomtry: found a key");
    expect_with("</dev/null", "check -", 3, "standard input:1:1: YAML: found nothing");
    expect_with("sed s/room.obj/hall.obj/ room.yaml", "check -", 3,
                "expected a file, relative to the working directory");
    expect_with("sed s/catalogue.yaml/none.yaml/ room.yaml", "check -", 3,
                "expected a file, relative to the working directory");
    expect_with("cat room.yaml", "compare - -", 2, "found - 2 times, expected it once");
}

/* Whatever its name is not. */
static void what_is_redirected_is_not_replaced(void **state)
{
    (void)state;
    ensure("kept", "simulate room.yaml " COARSE);
    write_file("kept/layout.yaml", room_yaml);
    char *before = read_file("kept/layout.yaml", NULL);
    expect_with("<kept/layout.yaml", "simulate - -o kept", 1,
                "kept/layout.yaml: would replace a file that was read, expected another folder to write to");
    char *after = read_file("kept/layout.yaml", NULL);
    assert_string_equal(before, after);
    free(before);
    free(after);
}

static const char square_stl[] = "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
                                 "endloop\nendfacet\nendsolid s\n";
static const char square_ply[] = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                                 "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
                                 "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

/* Its kind is told by what it begins with. */
static void a_mesh(void **state)
{
    (void)state;
    static const char hit[] = "ray,t,triangle,u,v,x,y,z,speed,incidence_deg\n0,1,0,0.25,0.25,0.25,0.25,0,1,0\n";
    write_file("square.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    write_file("square.stl", square_stl);
    write_file("square.ply", square_ply);
    write_file("rays.csv", "0.25,0.25,1,0,0,-1\n");
    static const char *const meshes[] = {"<square.obj", "<square.stl", "<square.ply"};
    for (size_t i = 0; i < sizeof meshes / sizeof *meshes; i++) {
        outcome result = run_with(meshes[i], "trace - --rays rays.csv");
        assert_string_equal(result.err, "");
        assert_string_equal(result.out, hit);
        forget(&result);
    }
    outcome result = run_with("cat rays.csv", "trace square.obj --rays -");
    assert_string_equal(result.out, hit);
    forget(&result);
    expect_with("cat square.obj", "atlas - --texel 10mm --json", 0, "");
    expect_with("echo 'ISO-10303-21;'", "bench -", 3, "standard input: found a CAD file, expected OBJ, STL or PLY");
    expect_with("echo v 0 0", "atlas -", 3, "standard input:1");
    expect_with("cat square.obj", "trace - --rays -", 2, "found - 2 times");
    expect_with("cat square.obj", "atlas - --reuse", 2, "--reuse: found -, expected a file");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_scene),
        cmocka_unit_test(errors_in_it_say_where),
        cmocka_unit_test(what_is_redirected_is_not_replaced),
        cmocka_unit_test(a_mesh),
    };
    return cmocka_run_group_tests(tests, open_workplace, close_workplace);
}
