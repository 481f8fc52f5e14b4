/* place on a small room, out of time, interrupted, and asked to end; and simulate, which has nothing to write then. */
#include "results.h"

#include <signal.h>
#include <time.h>

/* Whether the process has a handler of its own for this signal. */
static bool catches(pid_t process, int signal)
{
    char path[64], line[256];
    unsigned long long caught = 0;
    snprintf(path, sizeof path, "/proc/%d/status", (int)process);
    FILE *file = fopen(path, "r");
    while (file && fgets(line, sizeof line, file))
        sscanf(line, "SigCgt: %llx", &caught);
    if (file)
        fclose(file);
    return caught >> (signal - 1) & 1;
}

/* Begins what takes far longer than the test lets it run. */
static pid_t begin(const char *command, const char *scene, const char *folder)
{
    pid_t child = fork();
    if (child == 0) {
        if (chdir(workplace) != 0 || !freopen(".out", "w", stdout) || !freopen(".err", "w", stderr))
            _exit(127);
        execl(BINARY_DIR "/sprayplan", "sprayplan", command, scene, "-o", folder, (char *)NULL);
        _exit(127);
    }
    assert_true(child > 0);
    return child;
}

/* Interrupts what has worked for so many seconds of processor, which must not have ended by itself; it ends as it
 * should. */
static void interrupt_after(pid_t child, int seconds, int signal)
{
    struct timespec pause = {0, 10000000}, worked = {0};
    clockid_t clock;
    int status;
    assert_int_equal(clock_getcpuclockid(child, &clock), 0);
    while (!catches(child, signal) || worked.tv_sec < seconds) {
        assert_int_equal(waitpid(child, &status, WNOHANG), 0);
        nanosleep(&pause, NULL);
        assert_int_equal(clock_gettime(clock, &worked), 0);
    }
    assert_int_equal(kill(child, signal), 0);
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status));
    assert_int_equal(WEXITSTATUS(status), 130);
    char *complaint = read_file(".err", NULL);
    assert_non_null(strstr(complaint, "interrupted"));
    free(complaint);
}

/* check accepts what was written in `folder`, and simulate gives its figures; of a proposal without nozzles, where that
 * may be, there is nothing to simulate. */
static void proposal_is_whole(const char *folder, bool may_be_empty)
{
    char text[256];
    snprintf(text, sizeof text, "%s/result.json", folder);
    json_t *placed = json_file(text), *proposed = layout_named(placed, "proposed");
    if (may_be_empty && number(proposed, "water_l_min") == 0) {
        assert_true(number(proposed, "covered_area_m2") == 0);
        json_decref(placed);
        return;
    }
    snprintf(text, sizeof text, "check %s/layout.yaml --quiet", folder);
    outcome result = run_program(text);
    assert_int_equal(result.status, 0);
    forget(&result);
    snprintf(text, sizeof text, "simulate %s/layout.yaml --json", folder);
    json_t *again = expect_json(text, 0), *manual = layout_named(again, "manual");
    assert_true(number(proposed, "covered_area_m2") == number(manual, "covered_area_m2"));
    assert_true(number(proposed, "water_l_min") == number(manual, "water_l_min"));
    json_decref(placed);
    json_decref(again);
}

/* What shows patches is there, or is named as left out. */
static void what_shows_patches_is_there_or_named(const char *folder)
{
    static const char *const files[] = {"coverage.png", "deposits.exr", "model.glb", "surface.vtp", "texels.vtp"};
    char path[256];
    snprintf(path, sizeof path, "%s/result.json", folder);
    char *result = read_file(path, NULL);
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        char path_of_file[1100];
        snprintf(path_of_file, sizeof path_of_file, "%s/%s/%s", workplace, folder, files[i]);
        assert_true((access(path_of_file, F_OK) == 0) == !strstr(result, files[i]));
    }
    snprintf(path, sizeof path, "%s/report.html", folder);
    char *page = read_file(path, NULL);
    assert_true(!strstr(page, "id=\"viewer-model\"") == !!strstr(result, "coverage.png"));
    free(page);
    free(result);
}

/* In the figures, in the page and on the terminal; such a search never comes to its end. */
static void what_was_cut_is_named(const char *folder, const char *said)
{
    char path[256];
    snprintf(path, sizeof path, "%s/result.json", folder);
    json_t *result = json_file(path), *cut = json_object_get(result, "cut_short"), *name;
    size_t i;
    snprintf(path, sizeof path, "%s/report.html", folder);
    char *page = read_file(path, NULL), *told = strstr(page, "Cut short or left out: ");
    said = strstr(said, "Cut short or left out: ");
    assert_true(said && told);
    assert_true(json_array_size(cut) > 0);
    json_array_foreach(cut, i, name)
    {
        assert_non_null(strstr(said, json_string_value(name)));
        if (!strchr(json_string_value(name), '\''))
            assert_non_null(strstr(told, json_string_value(name)));
    }
    free(page);
    json_decref(result);
}

static void is_named_as_cut(const char *folder, const char *what)
{
    char path[256];
    snprintf(path, sizeof path, "%s/result.json", folder);
    json_t *result = json_file(path), *name;
    size_t i;
    bool named = false;
    json_array_foreach(json_object_get(result, "cut_short"), i, name) named |= !strcmp(json_string_value(name), what);
    json_decref(result);
    if (!named)
        fail_msg("%s is not named", what);
}

static void out_of_time_place_writes_the_best_so_far(void **state)
{
    (void)state;
    write_long_scene("long.yaml", "", "40 mm");
    static const char *const limits[] = {"0.1", "2"};
    for (size_t i = 0; i < sizeof limits / sizeof *limits; i++) {
        char text[128];
        snprintf(text, sizeof text, "place long.yaml -o limited%zu --time-limit %s", i, limits[i]);
        outcome result = run_program(text);
        assert_true(result.status == 0 || result.status == 4);
        /* either what is proved of the best possible, or that nothing is */
        assert_true(!strstr(result.out, "candidate poses") == !!strstr(result.out, "before anything was proved"));
        snprintf(text, sizeof text, "limited%zu", i);
        what_was_cut_is_named(text, result.out);
        what_shows_patches_is_there_or_named(text);
        forget(&result);
        proposal_is_whole(text, false);
    }
}

static void place_survives(int signal, const char *scene, const char *folder)
{
    /* thousands of mounting points; the evaluator of twelve triangles takes a few milliseconds of two seconds */
    interrupt_after(begin("place", scene, folder), 2, signal);
    is_named_as_cut(folder, "certificate");
    is_named_as_cut(folder, "what each nozzle brings");
    proposal_is_whole(folder, true); /* the signal may come before the first nozzle is found */
}

static void interrupting_place_writes_the_best_so_far(void **state)
{
    (void)state;
    write_long_scene("long.yaml", "", "40 mm");
    place_survives(SIGINT, "long.yaml", "interrupted");
}

/* As timeout(1) and schedulers do. */
static void so_does_asking_it_to_end(void **state)
{
    (void)state;
    write_long_scene("long.yaml", "", "40 mm");
    place_survives(SIGTERM, "long.yaml", "terminated");
}

/* What is found is evaluated by jets after that, which could be cut short as well. Nozzles are found early on. */
static void so_does_interrupting_a_search_by_jets(void **state)
{
    (void)state;
    write_long_scene("jets.yaml", "evaluator: forward, jets: 20000, ", "160 mm");
    place_survives(SIGINT, "jets.yaml", "interrupted-jets");
}

/* Minutes of drops on texels that are cut out in less than a second, then the evaluation ends within a part of one. */
static void an_evaluation_is_left_at_once(void **state)
{
    (void)state;
    char scene[16384];
    size_t used = (size_t)snprintf(scene, sizeof scene,
                                   "geometry: [{file: room.obj}]\n"
                                   "cavity: [0.5 m, 0.5 m, 0.5 m]\n"
                                   "catalogue: catalogue.yaml\n"
                                   "simulate: {texel: 8 mm, trajectory: drag}\n"
                                   "nozzles:\n");
    for (int i = 0; i < 100; i++)
        used += (size_t)snprintf(scene + used, sizeof scene - used,
                                 "  - {name: N%d, type: ball, position: [0.5, 0.5, %g], axis: [0, 0, -1], pressure: "
                                 "2 bar}\n",
                                 i, 0.2 + 0.005 * i);
    write_file("drops.yaml", scene);
    interrupt_after(begin("simulate", "drops.yaml", "left"), 3, SIGINT);
    char *said = read_file(".out", NULL);
    assert_string_equal(said, "");
    free(said);
    assert_null(read_file("left/result.json", NULL));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(out_of_time_place_writes_the_best_so_far),
        cmocka_unit_test(interrupting_place_writes_the_best_so_far),
        cmocka_unit_test(so_does_asking_it_to_end),
        cmocka_unit_test(so_does_interrupting_a_search_by_jets),
        cmocka_unit_test(an_evaluation_is_left_at_once),
    };
    return cmocka_run_group_tests(tests, open_workplace, close_workplace);
}
