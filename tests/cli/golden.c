/* What place says of two vessels, in full, is what it said before, by either tree. Where it is to change, the files
 * that the test names are the new golden ones. */
#include "workplace.h"

#include <math.h>

#define TOLERANCE 1e-9 /* relative: mathematical functions of another C library may round otherwise */
/* Texels, types and water of which a placement takes seconds, not a minute. */
#define SMALL                                                                                                          \
    "--set simulate.texel=150mm --set 'place.types=[full-cone-120-16, flat-fan-90-10]' "                               \
    "--set place.max_water=36L/min"

/* Seconds, and hashes of files that have comments. */
static bool changes(const char *key)
{
    return strstr(key, "seconds") || !strcmp(key, "inputs") || !strcmp(key, "scene");
}

static void strip(json_t *value)
{
    const char *key;
    json_t *member;
    void *next;
    json_object_foreach_safe(value, next, key, member)
    {
        if (changes(key))
            json_object_del(value, key);
        else
            strip(member);
    }
    for (size_t i = 0; i < json_array_size(value); i++)
        strip(json_array_get(value, i));
}

/* Counts what differs, and prints where the first few do. */
static size_t differences(const json_t *golden, const json_t *found, const char *path)
{
    char below[512];
    size_t count = 0;
    if (json_is_real(golden) && json_is_real(found)) {
        double a = json_real_value(golden), b = json_real_value(found);
        count = !(fabs(a - b) <= TOLERANCE * fmax(fabs(a), fabs(b)));
    } else if (json_is_object(golden) && json_is_object(found)) {
        const char *key;
        json_t *member;
        count = json_object_size(golden) != json_object_size(found);
        json_object_foreach((json_t *)golden, key, member)
        {
            snprintf(below, sizeof below, "%s.%s", path, key);
            count += differences(member, json_object_get(found, key), below);
        }
        return count;
    } else if (json_is_array(golden) && json_array_size(golden) == json_array_size(found)) {
        for (size_t i = 0; i < json_array_size(golden); i++) {
            snprintf(below, sizeof below, "%s[%zu]", path, i);
            count += differences(json_array_get(golden, i), json_array_get(found, i), below);
        }
        return count;
    } else {
        count = !json_equal(golden, found);
    }
    if (count) {
        char *before = json_dumps(golden, JSON_ENCODE_ANY | JSON_COMPACT),
             *now = found ? json_dumps(found, JSON_ENCODE_ANY | JSON_COMPACT) : NULL;
        print_message("%s: %.60s, now %.60s\n", path, before, now ? now : "missing");
        free(before);
        free(now);
    }
    return count;
}

/* Runs a program of the build's on the scene of that name in a folder, and compares. */
static void compare(const char *program, const char *folder, const char *name)
{
    char line[2048], path[512];
    snprintf(line, sizeof line, "'%s/%s' place '%s/%s.yaml' " SMALL " --json -q >'%s/found' 2>/dev/null", BINARY_DIR,
             program, folder, name, workplace);
    int status = system(line);
    assert_true(WIFEXITED(status) && WEXITSTATUS(status) == 4); /* so little water covers less than is asked for */
    char *text = read_file("found", NULL);
    json_t *found = json_loads(text, 0, NULL);
    assert_non_null(found);
    strip(found);
    snprintf(path, sizeof path, "%s/tests/cli/golden/%s.json", SOURCE_DIR, name);
    json_t *golden = json_load_file(path, 0, NULL);
    size_t count = golden ? differences(golden, found, name) : 1;
    if (count) {
        snprintf(path, sizeof path, "%s/tests/%s.json", BINARY_DIR, name);
        assert_int_equal(json_dump_file(found, path, JSON_INDENT(1) | JSON_SORT_KEYS), 0);
        fail_msg("%zu differences; what was found: %s", count, path);
    }
    json_decref(golden);
    json_decref(found);
    free(text);
}

static void the_vessel_is_as_before(void **state)
{
    (void)state;
    compare("sprayplan", workplace, "vessel");
}

static void so_it_is_by_the_tree_of_reference(void **state)
{
    (void)state;
    compare("tests/sprayplan-sah", workplace, "vessel");
}

static void the_tank_is_as_before(void **state)
{
    (void)state;
    if (access(DATA_DIR "/mixing_tank/tank.obj", R_OK) != 0) {
        print_message("the mixing tank's mesh is missing\n");
        skip();
    }
    compare("sprayplan", SOURCE_DIR "/scenes", "mixing_tank");
}

static int open_vessel(void **state)
{
    char line[1024];
    if (open_workplace(state))
        return -1;
    snprintf(line, sizeof line,
             "cd '%s' && cp '%s/scenes/vessel.yaml' '%s/scenes/catalogue.yaml' . && '%s/scenes/vessel' "
             "vessel.obj >.out",
             workplace, SOURCE_DIR, SOURCE_DIR, BINARY_DIR);
    return system(line);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_vessel_is_as_before),
        cmocka_unit_test(so_it_is_by_the_tree_of_reference),
        cmocka_unit_test(the_tank_is_as_before),
    };
    return cmocka_run_group_tests(tests, open_vessel, close_workplace);
}
