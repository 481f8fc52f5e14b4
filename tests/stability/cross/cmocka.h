/* As much of cmocka as the closed forms call, for processors that it is not installed for: the first that fails ends
 * the program. */
#ifndef CROSS_CMOCKA_H
#define CROSS_CMOCKA_H

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct CMUnitTest {
    const char *name;
    void (*run)(void **state);
};

#define cmocka_unit_test(function)                                                                                     \
    {                                                                                                                  \
        #function, function                                                                                            \
    }
#define print_message(...) printf(__VA_ARGS__)
#define fail_msg(...) (printf(__VA_ARGS__), printf("\n"), exit(1))
#define assert_true(holds)                                                                                             \
    do {                                                                                                               \
        if (!(holds))                                                                                                  \
            fail_msg("%s:%d: %s", __FILE__, __LINE__, #holds);                                                         \
    } while (0)
#define assert_false(holds) assert_true(!(holds))
#define assert_null(pointer) assert_true((pointer) == NULL)
#define assert_non_null(pointer) assert_true((pointer) != NULL)
#define assert_int_equal(a, b) assert_true((a) == (b))
#define assert_float_equal(a, b, margin) assert_true(fabs((a) - (b)) <= (margin))
#define assert_string_equal(a, b) assert_true(strcmp(a, b) == 0)
#define assert_memory_equal(a, b, size) assert_true(memcmp(a, b, size) == 0)

#define cmocka_run_group_tests(tests, open, close) cross_run(tests, sizeof(tests) / sizeof *(tests))
static inline int cross_run(const struct CMUnitTest *tests, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        void *state = NULL;
        printf("%s\n", tests[i].name);
        tests[i].run(&state);
    }
    return 0;
}

#endif
