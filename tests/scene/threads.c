/* Scenes are loaded, quantities parsed and scenes written by several threads at a time, and come out as by one. */
#include "scratch.h"

#include <sprayplan/scene.h>

#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

enum { THREADS = 4, TIMES = 8 };

/* The scene written anew; NULL where anything failed. The caller frees. */
static char *read_and_write(void)
{
    sp_error error = {0};
    double flow = 0;
    sp_scene *scene = sp_scene_load("scene.yaml", &error);
    char *text = NULL;
    if (scene && sp_quantity_parse("6 L/min", "m3/s", &flow, &error) && fabs(flow - 1e-4) < 1e-19)
        text = sp_scene_text(scene, sp_scene_layout(scene), &sp_scene_setup(scene)->fidelity, ".", &error);
    sp_scene_destroy(scene);
    return text;
}

/* Counts in `user` what comes out otherwise than it should. Nothing is asserted off the test's own thread. */
static void *repeat(void *user)
{
    size_t *wrong = user;
    char *first = read_and_write();
    *wrong = first == NULL;
    for (int i = 1; i < TIMES; i++) {
        char *text = read_and_write();
        *wrong += !text || !first || strcmp(text, first) != 0;
        free(text);
    }
    free(first);
    return NULL;
}

static void many_threads_load_at_a_time(void **state)
{
    (void)state;
    pthread_t threads[THREADS];
    size_t wrong[THREADS], alone;
    scratch_write("scene.yaml", full_scene);
    repeat(&alone);
    assert_int_equal(alone, 0);
    for (int i = 0; i < THREADS; i++)
        assert_int_equal(pthread_create(&threads[i], NULL, repeat, &wrong[i]), 0);
    for (int i = 0; i < THREADS; i++)
        assert_int_equal(pthread_join(threads[i], NULL), 0);
    for (int i = 0; i < THREADS; i++)
        assert_int_equal(wrong[i], 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(many_threads_load_at_a_time)};
    return cmocka_run_group_tests(tests, scratch_make, scratch_remove);
}
