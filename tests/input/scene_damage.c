/* Damaged files: cut short, bytes changed, pieces doubled. Any error will do, a crash or a leak will not,
 * and what still loads can be written and loads again. */
#include "../scene/scratch.h"

#include <sprayplan/scene.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#ifdef SPRAYPLAN_SANITIZE
enum { STEP = 7, ROUNDS = 200 };
#else
enum { STEP = 3, ROUNDS = 500 };
#endif

/* Loads what lies there; returns true if it is a scene. */
static bool attempt(void)
{
    static const sp_fidelity fidelity = {SP_TRAJECTORY_LINE, SP_METHOD_INVERSE, 0, 0, 0.01, SP_SPLAT_NEAREST, 0.01, 1};
    sp_error error = {0};
    sp_scene *scene = sp_scene_load("scene.yaml", &error);
    if (!scene) {
        assert_int_not_equal(error.kind, SP_OK);
        assert_true(error.message[0]);
        return false;
    }
    char *text = sp_scene_text(scene, sp_scene_layout(scene), &fidelity, ".", &error);
    assert_non_null(text);
    scratch_write("again.yaml", text);
    sp_scene *again = sp_scene_load("again.yaml", &error);
    if (!again)
        fail_msg("%s\n%s", error.message, text);
    sp_scene_destroy(again);
    sp_scene_destroy(scene);
    free(text);
    return true;
}

static void cut(const char *file, const char *text)
{
    scratch_write("scene.yaml", full_scene);
    scratch_write("catalogue.yaml", catalogue);
    for (size_t size = 0; size < strlen(text); size += STEP) {
        scratch_write_bytes(file, text, size);
        attempt();
    }
}

static void cut_short(void **state)
{
    (void)state;
    cut("scene.yaml", full_scene);
    cut("catalogue.yaml", catalogue);
}

/* Steele, Lea and Flood's splitmix64. */
static uint64_t next(uint64_t *state)
{
    uint64_t z = *state += 0x9e3779b97f4a7c15;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9;
    z = (z ^ z >> 27) * 0x94d049bb133111eb;
    return z ^ z >> 31;
}

/* Changes bytes, mostly to those that mean something to YAML, or doubles a piece. Returns the new size. */
static size_t damage(char *bytes, size_t size, uint64_t *random)
{
    static const char signs[] = "{}[]:,-#&*!|>'\"%@`?\n\t \\0123456789.eE";
    if (next(random) % 8 == 0) {
        size_t length = next(random) % 60 + 1, from = next(random) % (size - length),
               to = next(random) % (size - length);
        memmove(bytes + to + length, bytes + to, size - to);
        memmove(bytes + to, bytes + from, length);
        size += length;
    }
    for (uint64_t n = next(random) % 3 + 1; n > 0; n--) {
        char *byte = &bytes[next(random) % size];
        *byte = next(random) % 4 ? signs[next(random) % (sizeof signs - 1)] : (char)next(random);
    }
    return size;
}

static void damage_file(const char *file, const char *text, uint64_t seed)
{
    size_t loaded = 0, size = strlen(text);
    char *bytes = malloc(size + 64);
    assert_non_null(bytes);
    scratch_write("scene.yaml", full_scene);
    scratch_write("catalogue.yaml", catalogue);
    for (int round = 0; round < ROUNDS; round++) {
        memcpy(bytes, text, size);
        scratch_write_bytes(file, bytes, damage(bytes, size, &seed));
        loaded += attempt();
    }
    free(bytes);
    /* Some damage does not matter, most does: otherwise this test tries nothing. */
    assert_true(loaded > 0 && loaded < ROUNDS / 2);
}

static void damaged(void **state)
{
    (void)state;
    damage_file("scene.yaml", full_scene, 1);
    damage_file("catalogue.yaml", catalogue, 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(cut_short), cmocka_unit_test(damaged)};
    return cmocka_run_group_tests(tests, scratch_make, scratch_remove);
}
