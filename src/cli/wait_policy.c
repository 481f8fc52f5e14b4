/* How threads wait for one another. */
#include "cli.h"

#include <stdlib.h>
#ifdef __linux__
#include <sys/auxv.h>
#include <unistd.h>
#endif

/* The OpenMP runtime asks the environment when it is loaded, before main(): so the program is run once more, as the
 * same process, where nobody has said how threads are to wait. A program that the loader was given by name (no base of
 * a loader then) could not be found again; nor can one where there is no /proc. */
void cli_sleep_while_waiting(char *const *arguments)
{
#ifdef __linux__
    char path[4096];
    if (getenv("OMP_WAIT_POLICY") || getauxval(AT_BASE) == 0)
        return;
    ssize_t length = readlink("/proc/self/exe", path, sizeof path - 1);
    bool whole = length > 0 && (size_t)length < sizeof path - 1;
    if (!whole || setenv("OMP_WAIT_POLICY", "passive", 1) != 0)
        return;
    path[length] = 0;
    execv(path, arguments);
#else
    (void)arguments;
#endif
}
