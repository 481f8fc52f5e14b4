/* The program without its modules, and where it is installed. */
#include "workplace.h"

static void run(const char *command)
{
    char line[2048];
    snprintf(line, sizeof line, "cd '%s' && %s", workplace, command);
    assert_int_equal(system(line), 0);
}

static void missing(const char *file)
{
    char *told = read_file(".err", NULL);
    if (!strstr(told, "a part of sprayplan is not installed") || !strstr(told, file))
        fail_msg("%s", told);
    free(told);
}

/* What needs no module works; what does says which part is missing, and ends in an error. */
static void a_part_that_is_missing_is_named(void **state)
{
    (void)state;
    if (access(INSTALLED_MODULES, F_OK) == 0) {
        print_message("there is a sprayplan in %s, whose modules would be found\n", INSTALLED_MODULES);
        skip();
    }
    run("cp '" BINARY_DIR "/sprayplan' alone");
    run("./alone --version >.out && ./alone check room.yaml >.out && ./alone simulate room.yaml >.out");
    run("{ ./alone simulate room.yaml -o pictures >.out 2>.err; test $? -eq 1; }");
    missing("sprayplan-images.so");
    /* before the search, which would find no mounting point */
    run("{ ./alone place room.yaml --set place.clearance=9 >.out 2>.err; test $? -eq 1; }");
    missing("sprayplan-ceres.so");
    /* the first of those that mpirun started says it, the others nothing */
    run("{ OMPI_COMM_WORLD_SIZE=2 OMPI_COMM_WORLD_RANK=0 ./alone place room.yaml >.out 2>.err; test $? -eq 1; }");
    missing("sprayplan-mpi.so");
    run("OMPI_COMM_WORLD_SIZE=2 OMPI_COMM_WORLD_RANK=1 ./alone place room.yaml >.out 2>.err && test ! -s .out && "
        "test ! -s .err");
}

/* Installed anywhere, it finds its modules there, and links none of what they are for. */
static void an_installed_program_finds_its_modules(void **state)
{
    (void)state;
    run("cmake --install '" BINARY_DIR "' --prefix \"$PWD/usr\" >.out");
    run("usr/bin/sprayplan simulate room.yaml -o pictures >.out && test -s pictures/coverage.png");
    run("usr/bin/sprayplan place room.yaml >.out");
    run("! ldd usr/bin/sprayplan | grep -E 'OpenImageIO|ceres|glog|libTK|libmpi'");
    run("test ! -e '" BINARY_DIR
        "/libexec' || usr/libexec/sprayplan/sprayplan-cad 2>&1 | grep -q 'starts this program'");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_part_that_is_missing_is_named, open_workplace, close_workplace),
        cmocka_unit_test_setup_teardown(an_installed_program_finds_its_modules, open_workplace, close_workplace),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
