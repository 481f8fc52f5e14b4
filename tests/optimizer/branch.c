/* Branch and bound against every layout there is, on instances small enough to try them all. */
#include "every_layout.h"

#include "bound/branch.h"

#ifdef SPRAYPLAN_SANITIZE
#define INSTANCES 5
#else
#define INSTANCES 30
#endif
#define STEPS_MOST 400

/* Steps until the tree is closed; the bound holds at every one. `seeded`: the best layout is known beforehand. */
static void check_tree(const instance *in, const every_layout *all, size_t water, bool seeded, size_t *steps)
{
    sp_error error = {0};
    sp_stored_line stored;
    sp_branching b;
    sp_tree tree;
    double whole = in->cover.base, best = all->by_water[water];
    for (size_t t = 0; t < in->cover.texel_count; t++)
        whole += (double)in->area[t];
    assert_true(sp_stored_line_create(&in->cover, &in->rows, &stored, &error));
    assert_true(sp_branching_create(&in->cover, &stored.line, &b, &error));
    assert_true(sp_tree_create(&b, water, whole, seeded ? best : 0.8 * best, &tree, &error));
    double bound = sp_tree_bound(&tree);
    while (!sp_tree_closed(&tree) && tree.steps < STEPS_MOST) {
        assert_true(sp_tree_step(&b, &tree, &error));
        assert_true(sp_tree_bound(&tree) <= bound);
        bound = sp_tree_bound(&tree);
        assert_true(bound >= best);
    }
    *steps += tree.steps;
    /* what it ends with is the best there is */
    assert_true(sp_tree_closed(&tree));
    assert_true(bound <= best * (1 + 1e-4) + 1e-9);
    sp_tree_free(&tree);
    sp_branching_free(&b);
    sp_stored_line_free(&stored);
}

static void ends_with_the_best(void **state)
{
    (void)state;
    for (int single = 0; single < 2; single++) {
        size_t steps = 0;
        for (uint64_t i = 0; i < INSTANCES; i++) {
            instance in;
            every_layout all;
            instance_create(&in, 12, 14, single, 1 + i % 4, 26 + i % 30, i % 3, 0.1 + 0.03 * (double)(i % 20),
                            9177 + 1000 * i);
            in.cover.repeats = i % 2 ? in.cover.repeats : false;
            every_layout_create(&in, &all);
            check_tree(&in, &all, in.cover.water, i % 2, &steps);
            check_tree(&in, &all, in.cover.water / 2, i % 2, &steps);
            every_layout_free(&all);
            instance_free(&in);
        }
        print_message("%s: %.1f steps a tree\n", single ? "single" : "sum", (double)steps / (2 * INSTANCES));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ends_with_the_best),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
