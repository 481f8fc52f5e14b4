/* Each allocation of the program's own that fails ends a command with "out of memory", or it makes no difference. */
#include "faults/program.h"

/* As small as there is: the same calls as for a vessel. */
#define SCENE(criterion, simulate, more)                                                                               \
    "geometry:\n"                                                                                                      \
    "  - file: room.obj\n"                                                                                             \
    "criterion: {" criterion "}\n" more "catalogue: catalogue.yaml\n"                                                  \
    "nozzles:\n"                                                                                                       \
    "  - {name: N1, type: cone, position: [0.5 m, 0.5 m, 0.9 m], axis: [0, 0, -1], pressure: 2 bar}\n"                 \
    "simulate: {texel: 500 mm" simulate "}\n"                                                                          \
    "place:\n"                                                                                                         \
    "  coverage: 90 %\n"                                                                                               \
    "  max_nozzles: 2\n"                                                                                               \
    "  pressure: 2 bar\n"                                                                                              \
    "  mounts:\n"                                                                                                      \
    "    - port: {name: P1, position: [0.3 m, 0.3 m, 1 m], axis: [0, 0, -1], depth: {from: 100 mm, to: 300 mm, "       \
    "spacing: 200 mm}}\n"

/* Standard output as JSON without what was measured of the run itself. */
static char *answer(const char *text)
{
    json_t *object = json_loads(text, JSON_REJECT_DUPLICATES, NULL);
    assert_true(json_is_object(object));
    json_object_del(object, "stages");
    json_object_del(object, "seconds");
    char *plain = json_dumps(object, JSON_SORT_KEYS);
    json_decref(object);
    assert_non_null(plain);
    return plain;
}

static bool is_out_of_memory(const outcome *result)
{
    return result->status == 1 && !strcmp(result->err, "out of memory\n");
}

/* True where the run ended as it may. */
static bool survives(const char *arguments, long number, int status, const char *expected)
{
    plan->failing_allocation = number;
    outcome result = run_faulty(arguments);
    bool good = is_out_of_memory(&result);
    if (!good && result.status == status) {
        char *found = answer(result.out);
        good = !strcmp(found, expected);
        free(found);
    }
    if (!good)
        print_error("sprayplan %s, allocation %ld fails: status %d, %s\n", arguments, number, result.status,
                    result.err);
    forget(&result);
    return good;
}

/* The allocations to fail, [count] flags: of each place in the code the first, with `all` also the last and one
 * between. */
static long choose(long count, bool all, bool *chosen)
{
    long places = 0;
    for (long i = 0; i < count; i++) {
        long first = i, last = i, same = 0;
        for (long k = 0; k < i && first == i; k++)
            first = plan->places[k] == plan->places[i] ? k : i;
        if (first < i)
            continue;
        places++;
        chosen[i] = true;
        for (long k = i; k < count && all; k++)
            if (plan->places[k] == plan->places[i])
                last = k, chosen[k] = same++ == 7;
        chosen[i] = chosen[last] = true;
    }
    return places;
}

/* With SPRAYPLAN_LONG all that are chosen fail in turn, else every `every`-th of them. */
static void each_fails(const char *arguments, long every)
{
    *plan = (fault_plan){0};
    outcome whole = run_faulty(arguments);
    long count = plan->allocations, runs = 0, failures = 0, turn = 0;
    bool all = getenv("SPRAYPLAN_LONG") != NULL, *chosen = calloc((size_t)count, sizeof *chosen);
    if (whole.status != 0 && whole.status != 4)
        print_error("sprayplan %s: %s\n", arguments, whole.err);
    assert_true((whole.status == 0 || whole.status == 4) && chosen && count <= FAULT_PLACES);
    long places = choose(count, all, chosen);
    char *expected = answer(whole.out);
    for (long n = 0; n < count; n++)
        if (chosen[n] && (all || turn++ % every == 0))
            failures += !survives(arguments, n + 1, whole.status, expected), runs++;
    print_message("sprayplan %s: %ld allocations in %ld places, of which %ld failed in turn\n", arguments, count,
                  places, runs);
    free(expected);
    free(chosen);
    forget(&whole);
    assert_int_equal(failures, 0);
}

#ifdef SPRAYPLAN_SANITIZE
enum { FEW = 4 };
#else
enum { FEW = 1 };
#endif

static void check(void **state)
{
    (void)state;
    each_fails("check small.yaml --json --threads 2", 4 * FEW);
    each_fails("check small.yaml --json --threads 2 --repair mended.obj", 12 * FEW);
}

static void simulate(void **state)
{
    (void)state;
    each_fails("simulate small.yaml --json --threads 2", 8 * FEW);
    each_fails("simulate film.yaml --json --threads 2", 20 * FEW);
    each_fails("simulate jets.yaml --json --threads 2", 8 * FEW);
    each_fails("simulate drag.yaml --json --threads 2", 40 * FEW);
}

static void place(void **state)
{
    (void)state;
    each_fails("place small.yaml --json --threads 4", 80 * FEW);
    if (getenv("SPRAYPLAN_LONG"))
        each_fails("place film.yaml --json --threads 4", 1);
}

static void trace(void **state)
{
    (void)state;
    each_fails("trace room.obj --json --rays rays.csv --threads 2", 2 * FEW);
}

static void reports(void **state)
{
    (void)state;
    if (FEW == 1 || getenv("SPRAYPLAN_LONG"))
        each_fails("simulate small.yaml --json --threads 2 -o out", 130 * FEW);
}

static int open_scenes(void **state)
{
    if (open_faults(state))
        return -1;
    write_file("small.yaml", SCENE("flux: 1 L/min/m2", "", ""));
    write_file("film.yaml", SCENE("film: 1 L/min/m, combine: single", "", "cavity: [0.5 m, 0.5 m, 0.5 m]\n"));
    write_file("jets.yaml", SCENE("flux: 1 L/min/m2", ", evaluator: forward, jets: 100, reflections: 1", ""));
    write_file("drag.yaml", SCENE("impact_speed: 1 m/s", ", trajectory: drag", ""));
    write_file("rays.csv", "# one ray\n0.5,0.5,0.5,0,0,-1\n\n0.5,0.5,0.5,0,1,-1\n");
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(check), cmocka_unit_test(simulate), cmocka_unit_test(place),
        cmocka_unit_test(trace), cmocka_unit_test(reports),
    };
    return cmocka_run_group_tests(tests, open_scenes, close_faults);
}
