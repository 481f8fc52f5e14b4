/* sprayplan trace: its CSV, exact for rays whose hits are exact in binary. */
#include "workplace.h"

#include <math.h>

#define HEADER "ray,t,triangle,u,v,x,y,z,speed,incidence_deg\n"

/* In the room: down on the floor's first and second triangle (a quad is a fan: 1 2 3 and 1 3 4), slantwise on the
 * floor, a ray that starts outside and points away. */
static const char rays[] = "# ox,oy,oz,vx,vy,vz\n"
                           "0.75, 0.25, 0.5, 0, 0, -2\n"
                           "\n"
                           "0.25,0.75,0.5,0,0,-2 # the other half\n"
                           "0.25,0.125,0.5,0.5,0,-0.5\n"
                           "2,2,2,1,0,0\n";

static void lines_hit_where_they_must(void **state)
{
    (void)state;
    write_file("rays.csv", rays);
    outcome result = run_program("trace room.obj --rays rays.csv");
    static const char expected[] = HEADER "0,0.25,0,0.5,0.25,0.75,0.25,0,2,0\n"
                                          "1,0.25,1,0.25,0.5,0.25,0.75,0,2,0\n"
                                          "2,1,0,0.625,0.125,0.75,0.125,0,0.70710678118654757,45";
    assert_memory_equal(result.out, expected, sizeof expected - 1);
    assert_non_null(strstr(result.out, "\n3,,,,,,,,,\n"));
    assert_string_equal(result.err, "");
    assert_int_equal(result.status, 0);
    forget(&result);
}

static void rays_are_in_m_whatever_the_mesh(void **state)
{
    (void)state;
    write_file("far.csv", "750,250,500,0,0,-2000\n");
    outcome result = run_program("trace room.obj --rays far.csv --unit km");
    assert_string_equal(result.out, HEADER "0,0.25,0,0.5,0.25,750,250,0,2000,0\n");
    assert_int_equal(result.status, 0);
    forget(&result);
}

/* From (1/2, 1/4, 1/2) at 1 m/s along x, g = 4: falls 1/2 m in 1/2 s, 1/2 m on: at the foot of the wall; from lower it
 * meets the floor. z = 1/8 - 2 t² = 0 at t = 1/4, with v = (1, 0, -1). */
static void parabolas_fall(void **state)
{
    (void)state;
    write_file("thrown.csv", "0.5,0.25,0.125,1,0,0\n");
    outcome result = run_program("trace room.obj --rays thrown.csv --gravity 0,0,-4");
    static const char expected[] = HEADER "0,0.25,0,0.5,0.25,0.75,0.25,0,1.4142135623730951,45";
    assert_memory_equal(result.out, expected, sizeof expected - 1);
    assert_int_equal(result.status, 0);
    forget(&result);
}

/* Let go 1/2 m above the floor, g = 4: it falls t = 1/2 s, to 2 m/s. */
static void a_drop_that_is_let_go_falls(void **state)
{
    (void)state;
    static const char *const velocities[] = {"0,0,0", "0,1e-200,0"};
    for (size_t i = 0; i < sizeof velocities / sizeof *velocities; i++) {
        char ray[64];
        snprintf(ray, sizeof ray, "0.75,0.25,0.5,%s\n", velocities[i]);
        write_file("still.csv", ray);
        for (int k = 0; k < 4; k++) {
            static const char *const ways[] = {"bvh", "sah", "naive", "none"};
            char line[128];
            snprintf(line, sizeof line, "trace room.obj --rays still.csv --gravity 0,0,-4 --accel %s", ways[k]);
            outcome fallen = run_program(line);
            assert_string_equal(fallen.out, HEADER "0,0.5,0,0.5,0.25,0.75,0.25,0,2,0\n");
            assert_int_equal(fallen.status, 0);
            forget(&fallen);
        }
        outcome result = run_program("trace room.obj --rays still.csv");
        assert_non_null(strstr(result.err, "still.csv:1:1: found a velocity below 1e-150 m/s in \"0.75,"));
        assert_int_equal(result.status, 3);
        forget(&result);
    }
}

/* In 1e30 m/s2 it takes 1e-15 s to the floor 1/2 m below. */
static void gravity_has_an_end(void **state)
{
    (void)state;
    write_file("drop.csv", "0.75,0.25,0.5,0,0,-1\n");
    outcome result = run_program("trace room.obj --rays drop.csv --gravity 0,0,-1e30");
    assert_int_equal(result.status, 0);
    assert_true(fabs(strtod(result.out + sizeof HEADER + 1, NULL) / 1e-15 - 1) < 1e-12);
    forget(&result);
    static const char *const beyond[] = {"0,0,-1e31", "1e308,0,0", "0,-1.1e30,0"};
    for (size_t i = 0; i < sizeof beyond / sizeof *beyond; i++) {
        char line[128];
        snprintf(line, sizeof line, "trace room.obj --rays drop.csv --gravity %s", beyond[i]);
        result = run_program(line);
        assert_int_equal(result.status, 2);
        assert_non_null(strstr(result.err, "expected gx,gy,gz in m/s2, up to 1e30 each"));
        forget(&result);
    }
}

static void a_file_without_rays_is_reported(void **state)
{
    (void)state;
    write_file("none.csv", "# ox,oy,oz,vx,vy,vz\n\n");
    outcome result = run_program("trace room.obj --rays none.csv");
    assert_string_equal(result.out, HEADER);
    assert_string_equal(result.err, "sprayplan: trace: none.csv holds no rays\n");
    assert_int_equal(result.status, 0);
    forget(&result);
    json_t *object = expect_json("trace room.obj --rays none.csv --json", 0);
    assert_int_equal(json_array_size(json_object_get(object, "hits")), 0);
    json_decref(object);
}

/* Without a number: its place among the hits is that. */
static void help_says_what_a_miss_is(void **state)
{
    (void)state;
    outcome result = run_program("trace --help");
    for (char *at = result.out; *at; at++)
        *at = *at == '\n' ? ' ' : *at;
    assert_non_null(strstr(result.out, "with --json null"));
    forget(&result);
}

static void every_accelerator_and_thread_count_gives_the_same_bytes(void **state)
{
    (void)state;
    char *text = malloc(1 << 20), *at = text;
    uint32_t seed = 1;
    for (int i = 0; i < 1000; ++i) {
        double number[6];
        for (int k = 0; k < 6; ++k) {
            seed = seed * 1664525 + 1013904223;
            number[k] = (seed >> 8) * 0x1p-24 - (k < 3 ? 0 : 0.5);
        }
        at += sprintf(at, "%.17g,%.17g,%.17g,%.17g,%.17g,%.17g\n", number[0], number[1], number[2], number[3],
                      number[4], number[5]);
    }
    write_file("many.csv", text);
    free(text);
    static const char *const gravities[] = {"0,0,0", "0,0,-9.81"};
    for (int g = 0; g < 2; ++g) {
        static const char *const ways[] = {"--accel sah", "--accel naive", "--accel none", "--accel bvh",
                                           "--threads 3"};
        outcome first = {0};
        for (int i = 0; i < 5; ++i) {
            char line[256];
            snprintf(line, sizeof line, "trace room.obj --rays many.csv --gravity %s %s", gravities[g], ways[i]);
            outcome result = run_program(line);
            assert_int_equal(result.status, 0);
            if (i == 0) {
                first = result;
                continue;
            }
            assert_string_equal(result.out, first.out);
            forget(&result);
        }
        assert_null(strstr(first.out, ",,")); /* nothing leaves a closed room */
        forget(&first);
    }
}

static void json_holds_the_same(void **state)
{
    (void)state;
    write_file("rays.csv", rays);
    json_t *object = expect_json("trace room.obj --rays rays.csv --json", 0);
    json_t *hits = json_object_get(object, "hits");
    assert_int_equal(json_array_size(hits), 4);
    json_t *hit = json_array_get(hits, 1);
    assert_int_equal(json_integer_value(json_object_get(hit, "triangle")), 1);
    assert_true(json_number_value(json_object_get(hit, "t")) == 0.25);
    assert_true(json_is_null(json_array_get(hits, 3)));
    json_decref(object);
}

static void a_bad_ray_is_located(void **state)
{
    (void)state;
    static const struct {
        const char *text, *where;
    } files[] = {
        {"0,0,0,1,0,0\n0,0,zero,1,0,0\n", "bad.csv:2:5: "},
        {"0,0,0,1,0\n", "bad.csv:1:"},
        {"0,0,0,1,0,0,0\n", "bad.csv:1:12: "},
        {"0,0,0,0,0,0\n", "bad.csv:1:"},
        {"0,0,nan,1,0,0\n", "bad.csv:1:5: "},
        {"0,0,1e999,1,0,0\n", "bad.csv:1:5: "},
    };
    for (size_t i = 0; i < sizeof files / sizeof *files; ++i) {
        write_file("bad.csv", files[i].text);
        outcome result = run_program("trace room.obj --rays bad.csv");
        if (result.status != 3 || strstr(result.err, files[i].where) != result.err)
            print_error("%s: status %d, %s\n", files[i].text, result.status, result.err);
        assert_int_equal(result.status, 3);
        assert_ptr_equal(strstr(result.err, files[i].where), result.err);
        forget(&result);
    }
}

#ifdef SPRAYPLAN_SANITIZE
enum { EVERY = 3 }; /* in turn: the program takes long to begin */
#else
enum { EVERY = 1 };
#endif

/* Every number of a ray and of gravity. */
static void no_number_that_is_none(void **state)
{
    (void)state;
    static const char *const none[] = {"nan", "-nan", "inf", "-inf", "Infinity", "1e999", "-1e999", "0x", ""};
    write_file("good.csv", "0.5,0.5,0.5,1,1,1\n");
    for (int column = 0; column < 9; ++column)
        for (size_t k = (size_t)column % EVERY; k < sizeof none / sizeof *none; k += EVERY) {
            char ray[256] = "0.25,0.75,0.5,0,0,-2\n", gravity[128] = "", line[512];
            for (int c = 0; c < 6; ++c)
                snprintf(ray + strlen(ray), 32, "%s%s", c ? "," : "", c == column ? none[k] : "0.5");
            for (int c = 6; c < 9; ++c)
                snprintf(gravity + strlen(gravity), 32, "%s%s", c > 6 ? "," : "", c == column ? none[k] : "0.5");
            write_file("bad.csv", ray);
            snprintf(line, sizeof line, "trace room.obj --rays %s --gravity %s", column < 6 ? "bad.csv" : "good.csv",
                     gravity);
            outcome result = run_program(line);
            const char *where = column < 6 ? "bad.csv:2:" : "gravity";
            if (result.status != (column < 6 ? 3 : 2) || !strstr(result.err, where))
                fail_msg("column %d, '%s': status %d, %s", column, none[k], result.status, result.err);
            forget(&result);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lines_hit_where_they_must),
        cmocka_unit_test(rays_are_in_m_whatever_the_mesh),
        cmocka_unit_test(parabolas_fall),
        cmocka_unit_test(a_drop_that_is_let_go_falls),
        cmocka_unit_test(gravity_has_an_end),
        cmocka_unit_test(a_file_without_rays_is_reported),
        cmocka_unit_test(help_says_what_a_miss_is),
        cmocka_unit_test(every_accelerator_and_thread_count_gives_the_same_bytes),
        cmocka_unit_test(json_holds_the_same),
        cmocka_unit_test(a_bad_ray_is_located),
        cmocka_unit_test(no_number_that_is_none),
    };
    return cmocka_run_group_tests(tests, open_workplace, close_workplace);
}
