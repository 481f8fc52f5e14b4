/* The installed library: a program that was compiled against it, by pkg-config or CMake, shared or static, runs and
 * finds the library's modules; what its headers do not declare it does not export. */
#include "workplace.h"

static void run(const char *command)
{
    char line[4096];
    snprintf(line, sizeof line, "cd '%s' && export LD_LIBRARY_PATH=\"$PWD/usr/" LIBRARIES "\" && %s", workplace,
             command);
    if (system(line) != 0)
        fail_msg("%s", command);
}

/* README's example beside its vessel, and an installation. */
static int install_once(void **state)
{
    if (open_workplace(state) != 0)
        return -1;
    run("cp '" SOURCE_DIR "'/tests/cli/readme/* . && cp '" BINARY_DIR "/tests/readme_example.c' .");
    run("cmake --install '" BINARY_DIR "' --prefix \"$PWD/usr\" >.out");
    return 0;
}

/* The example proposes something, for which it needs Ceres' module: beside the shared library, or beside a program that
 * has the static one in it. */
static void expect_proposal(const char *program)
{
    char line[256];
    snprintf(line, sizeof line, "%s >.out && grep -Eq '^[0-9]+\\.[0-9] %% of the surface with [0-9]+ L/min$' .out",
             program);
    run(line);
}

static void pkg_config_links_it(void **state)
{
    (void)state;
    run("export PKG_CONFIG_PATH=\"$PWD/usr/" LIBRARIES
        "/pkgconfig\" && test \"$(pkg-config --modversion sprayplan)\" = "
        "$(usr/bin/sprayplan --version | cut -d' ' -f2) && cc readme_example.c $(pkg-config --cflags --libs sprayplan) "
        "-o shared && cc readme_example.c $(pkg-config --cflags sprayplan) -Wl,-Bstatic "
        "-L\"$PWD/usr/" LIBRARIES
        "\" -lsprayplan -Wl,-Bdynamic $(pkg-config --libs --static sprayplan) -o usr/bin/static");
    run("ldd shared | grep -q 'libsprayplan\\.so\\.0 => ' && ! ldd usr/bin/static | grep libsprayplan");
    expect_proposal("./shared");
    expect_proposal("env -u LD_LIBRARY_PATH usr/bin/static");
}

static void cmake_links_it(void **state)
{
    (void)state;
    write_file("CMakeLists.txt", "cmake_minimum_required(VERSION 3.25)\n"
                                 "project(example LANGUAGES C)\n"
                                 "find_package(sprayplan 0.1 REQUIRED COMPONENTS static)\n"
                                 "add_executable(shared readme_example.c)\n"
                                 "target_link_libraries(shared PRIVATE sprayplan::sprayplan)\n"
                                 "add_executable(static readme_example.c)\n"
                                 "target_link_libraries(static PRIVATE sprayplan::static)\n");
    run("cmake -S . -B made -DCMAKE_PREFIX_PATH=\"$PWD/usr\" >.out && cmake --build made >.out");
    run("ldd made/shared | grep -q 'libsprayplan\\.so\\.0 => ' && ! ldd made/static | grep libsprayplan");
    expect_proposal("env -u LD_LIBRARY_PATH made/shared");
    expect_proposal("env -u LD_LIBRARY_PATH sh -c 'cp made/static usr/bin/static && usr/bin/static'");
}

/* All that is exported is declared in a header. */
static void only_what_headers_declare_is_exported(void **state)
{
    (void)state;
    run("nm -D --defined-only usr/" LIBRARIES
        "/libsprayplan.so | cut -d' ' -f3 | sort -u >exported && test -s exported && "
        "grep -ohE '\\bsp_[a-z0-9_]+' usr/include/sprayplan/*.h | sort -u >declared && "
        "comm -23 exported declared >more && cat more >&2 && test ! -s more");
    run("grep -hE '^SP_API' usr/include/sprayplan/*.h | grep -oE 'sp_[a-z0-9_]+\\(' | tr -d '(' | sort -u >promised && "
        "comm -13 exported promised >less && cat less >&2 && test ! -s less");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pkg_config_links_it),
        cmocka_unit_test(cmake_links_it),
        cmocka_unit_test(only_what_headers_declare_is_exported),
    };
    return cmocka_run_group_tests(tests, install_once, close_workplace);
}
