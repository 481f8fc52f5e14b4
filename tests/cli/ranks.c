/* place by several processes that mpirun started: the same files as by one, one message, and an end whatever happens.
 */
#include "results.h"

#include <dirent.h>
#include <signal.h>
#include <time.h>

/* That any number of ranks gives the same bytes is seen without sanitizers; there two run all that several do. */
#ifdef SPRAYPLAN_SANITIZE
#define LEAST_RANKS 2
#define MOST_RANKS 2
#else
#define LEAST_RANKS 1
#define MOST_RANKS 4
#endif

/* Any user, more ranks than cores; what MPI itself leaves allocated is its own affair. */
#define MPIRUN                                                                                                         \
    "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 ASAN_OPTIONS=detect_leaks=0 SOURCE_DATE_EPOCH=0 exec "  \
    "mpirun --oversubscribe "
#define PLACE "'" BINARY_DIR "/sprayplan' place --threads 1 "

#ifdef HAS_MPI
static const bool built = true;
#else
static const bool built = false;
#endif

static void skip_without_mpi(void)
{
    if (built && system("command -v mpirun >/dev/null") == 0)
        return;
    print_message("mpirun, or the module that was to be built with MPI, is missing (Debian: libopenmpi-dev, "
                  "openmpi-bin)\n");
    skip();
}

static int run_in(const char *folder, const char *command)
{
    char line[4096];
    snprintf(line, sizeof line, "cd '%s/%s' && %s >.out 2>.err </dev/null", workplace, folder, command);
    int status = system(line);
    assert_true(WIFEXITED(status));
    return WEXITSTATUS(status);
}

/* A folder with the room, whose scene is `scene`, and what place makes of it in `out` by `ranks` ranks; 0: without
 * mpirun. */
static void place_by(size_t ranks, const char *scene, const char *folder)
{
    char line[2048];
    snprintf(line, sizeof line, "mkdir '%s/%s' && cd '%s' && cp room.obj catalogue.yaml types.yaml '%s'", workplace,
             folder, workplace, folder);
    assert_int_equal(system(line), 0);
    snprintf(line, sizeof line, "%s/scene.yaml", folder);
    write_file(line, scene);
    if (ranks)
        snprintf(line, sizeof line, MPIRUN "-n %zu " PLACE "scene.yaml -o out", ranks);
    else
        snprintf(line, sizeof line, "SOURCE_DATE_EPOCH=0 exec " PLACE "scene.yaml -o out");
    int status = run_in(folder, line);
    if (status != 0 && status != 4) {
        snprintf(line, sizeof line, "%s/.err", folder);
        fail_msg("%s", read_file(line, NULL));
    }
}

/* All files are the same to the last byte, seconds aside; so is what was printed. */
static void are_the_same(const char *a, const char *b)
{
    char line[2048];
    static const char seconds[] =
        "/\"(processor_)?seconds\"/d; /^<tr><th scope=\"row\">[a-z ]+<.th><td>[0-9.]+<.td><.tr>$/d";
    snprintf(
        line, sizeof line,
        "diff .out '../%s/.out' && test \"$(ls out)\" = \"$(ls '../%s/out')\" && test -s out/layout.yaml && for file "
        "in $(ls out); do sed -E '%s' out/$file >ours; sed -E '%s' '../%s/out/'$file >theirs; cmp ours theirs || "
        "{ echo $file; exit 1; }; done",
        a, a, seconds, seconds, a);
    char command[4096];
    snprintf(command, sizeof command, "cd '%s/%s' && %s", workplace, b, line);
    assert_int_equal(system(command), 0);
}

/* One process without mpirun, and `least` to `most` ranks, ever twice as many. */
static void compare(const char *scene, const char *name, size_t least, size_t most)
{
    char plain[64], other[64];
    snprintf(plain, sizeof plain, "%s-plain", name);
    place_by(0, scene, plain);
    for (size_t count = least; count <= most; count *= 2) {
        snprintf(other, sizeof other, "%s-%zu", name, count);
        place_by(count, scene, other);
        are_the_same(plain, other);
    }
}

/* Nozzles that refinement may turn, ports and a surface, too much asked for, and prices. */
static const char wide_yaml[] =
    "geometry:\n"
    "  - file: room.obj\n"
    "cavity: [0.5 m, 0.5 m, 0.5 m]\n"
    "criterion: {flux: 4 L/min/m2}\n"
    "catalogue: types.yaml\n"
    "simulate: {texel: 120 mm}\n"
    "place:\n"
    "  coverage: 99.9 %\n"
    "  max_nozzles: 4\n"
    "  pressure: 2 bar\n"
    "  mounts:\n"
    "    - port: {name: P1, position: [0.3 m, 0.3 m, 1 m], axis: [0, 0, -1], tilt: 30 deg, depth: {from: 100 mm, to: "
    "500 mm, spacing: 200 mm}}\n"
    "    - surface: {geometry: 0, part: walls, spacing: 500 mm, standoff: 40 mm, tilt: 30 deg}\n";

static const char types_yaml[] =
    "nozzles:\n"
    "  - {name: cone, pattern: full_cone, angle: 90 deg, angle_range: [60 deg, 120 deg], flow: 6 L/min, at: 2 bar, "
    "flow_range: [4 L/min, 8 L/min]}\n"
    "  - {name: fan, pattern: flat_fan, angle: 100 deg, thickness: 20 deg, flow: 4 L/min, at: 2 bar}\n"
    "  - name: pair\n"
    "    pattern: cluster\n"
    "    flow: 8 L/min\n"
    "    at: 2 bar\n"
    "    members:\n"
    "      - {pattern: full_cone, angle: 60 deg}\n"
    "      - {pattern: full_cone, angle: 60 deg, axis: [1, 0, 1]}\n";

static void any_number_of_ranks_gives_the_same_bytes(void **state)
{
    (void)state;
    skip_without_mpi();
    write_file("types.yaml", types_yaml);
    compare(room_yaml, "room", LEAST_RANKS, MOST_RANKS);
}

static void so_it_does_with_much_to_refine(void **state)
{
    (void)state;
    skip_without_mpi();
    if (!COMPARES_THREADS)
        skip();
    write_file("types.yaml", types_yaml);
    compare(wide_yaml, "wide", 4, 4);
}

static void an_error_is_reported_once(void **state)
{
    (void)state;
    skip_without_mpi();
    assert_int_equal(run_in(".", MPIRUN "-n 3 " PLACE "nowhere.yaml"), 3);
    char *told = read_file(".err", NULL), *first = strstr(told, "nowhere.yaml");
    assert_non_null(first);
    assert_null(strstr(first + 1, "nowhere.yaml"));
    free(told);
    write_room_with("outside.yaml", "position: [0.3 m, 0.3 m, 1 m]", "position: [7.3 m, 0.3 m, 1 m]");
    assert_int_equal(run_in(".", MPIRUN "-n 3 " PLACE "outside.yaml --set place.clearance=9"), 3);
    told = read_file(".err", NULL);
    first = strstr(told, "outside.yaml");
    assert_non_null(first);
    assert_null(strstr(first + 1, "outside.yaml"));
    free(told);
}

static void all_end_at_the_time_limit(void **state)
{
    (void)state;
    skip_without_mpi();
    write_long_scene("long.yaml", "", "60 mm");
    int status = run_in(".", MPIRUN "-n 3 " PLACE "long.yaml --time-limit 3 --quiet -o limited");
    assert_true(status == 0 || status == 4);
    json_t *result = json_file("limited/result.json");
    layout_named(result, "proposed");
    json_decref(result);
}

/* The process of this rank that `parent`, mpirun, has started, 0: not yet. */
static pid_t process_of(pid_t parent, int rank)
{
    char path[300], line[1 << 16], wanted[64];
    pid_t found = 0;
    snprintf(wanted, sizeof wanted, "OMPI_COMM_WORLD_RANK=%d", rank);
    DIR *all = opendir("/proc");
    for (struct dirent *entry; all && !found && (entry = readdir(all));) {
        int own = atoi(entry->d_name), above = 0;
        snprintf(path, sizeof path, "/proc/%s/stat", entry->d_name);
        FILE *file = own > 0 ? fopen(path, "r") : NULL;
        if (!file)
            continue;
        bool child = fscanf(file, "%*d (%*[^)]) %*c %d", &above) == 1 && above == parent;
        fclose(file);
        snprintf(path, sizeof path, "/proc/%s/environ", entry->d_name);
        file = child ? fopen(path, "r") : NULL;
        size_t size = file ? fread(line, 1, sizeof line - 1, file) : 0;
        line[size] = 0;
        for (size_t at = 0; at < size && !found; at += strlen(line + at) + 1)
            found = strcmp(line + at, wanted) ? 0 : own;
        if (file)
            fclose(file);
    }
    if (all)
        closedir(all);
    return found;
}

/* Three ranks at work on the long scene for some seconds of processor. */
static pid_t begin(const char *how, pid_t ranks[3])
{
    struct timespec pause = {0, 20000000}, worked = {0};
    char line[1024];
    snprintf(line, sizeof line,
             "cd '%s' && " MPIRUN "%s -n 3 " PLACE "long.yaml -o ended --quiet >.out 2>.err </dev/null", workplace,
             how);
    write_long_scene("long.yaml", "", "60 mm");
    pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        execl("/bin/sh", "sh", "-c", line, (char *)NULL);
        _exit(127);
    }
    for (int rank = 0; rank < 3; rank++)
        while (!(ranks[rank] = process_of(child, rank))) {
            assert_int_equal(waitpid(child, NULL, WNOHANG), 0);
            nanosleep(&pause, NULL);
        }
    clockid_t clock;
    assert_int_equal(clock_getcpuclockid(ranks[0], &clock), 0);
    while (worked.tv_sec < 2) {
        assert_int_equal(waitpid(child, NULL, WNOHANG), 0);
        nanosleep(&pause, NULL);
        assert_int_equal(clock_gettime(clock, &worked), 0);
    }
    return child;
}

/* False of one that has ended, also where nobody has asked for its status. */
static bool is_there(pid_t process)
{
    char path[64], state = 'X';
    snprintf(path, sizeof path, "/proc/%d/stat", (int)process);
    FILE *file = fopen(path, "r");
    if (file) {
        if (fscanf(file, "%*d (%*[^)]) %c", &state) != 1)
            state = 'X';
        fclose(file);
    }
    return state != 'X' && state != 'Z';
}

static int await(pid_t child)
{
    int status;
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status));
    return WEXITSTATUS(status);
}

static void the_best_so_far_is_there(const char *message)
{
    char *told = read_file(".err", NULL);
    if (!strstr(told, message))
        fail_msg("%s", told);
    free(told);
    json_t *result = json_file("ended/result.json");
    layout_named(result, "proposed");
    json_decref(result);
}

/* Whichever of them is asked. */
static void all_end_where_one_is_asked_to(void **state)
{
    (void)state;
    skip_without_mpi();
    pid_t ranks[3], child = begin("", ranks);
    assert_int_equal(kill(ranks[2], SIGTERM), 0);
    assert_int_equal(await(child), 130);
    the_best_so_far_is_there("interrupted; this is the best layout so far");
}

/* mpirun asks the others to end and then ends them. */
static void none_hangs_where_one_is_killed(void **state)
{
    (void)state;
    skip_without_mpi();
    pid_t ranks[3], child = begin("", ranks);
    assert_int_equal(kill(ranks[1], SIGKILL), 0);
    assert_int_not_equal(await(child), 0);
    for (int rank = 0; rank < 3; rank++)
        while (is_there(ranks[rank]))
            nanosleep(&(struct timespec){0, 20000000}, NULL);
}

/* Where mpirun leaves the others alone, which it does when asked to, whoever asks them to end sees the first do so. */
static void the_first_writes_what_it_has_where_others_were_killed(void **state)
{
    (void)state;
    skip_without_mpi();
    pid_t ranks[3], child = begin("--enable-recovery", ranks);
    assert_int_equal(kill(ranks[1], SIGKILL), 0);
    assert_int_equal(kill(ranks[2], SIGKILL), 0);
    assert_int_equal(kill(ranks[0], SIGTERM), 0);
    await(child);
    the_best_so_far_is_there("the other ranks being gone; this is the best layout so far");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(any_number_of_ranks_gives_the_same_bytes),
        cmocka_unit_test(so_it_does_with_much_to_refine),
        cmocka_unit_test(an_error_is_reported_once),
        cmocka_unit_test(all_end_at_the_time_limit),
        cmocka_unit_test(all_end_where_one_is_asked_to),
        cmocka_unit_test(none_hangs_where_one_is_killed),
        cmocka_unit_test(the_first_writes_what_it_has_where_others_were_killed),
    };
    return cmocka_run_group_tests(tests, open_workplace, close_workplace);
}
