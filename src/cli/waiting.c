/* How threads wait for one another. */
#include "cli.h"

#include <stdlib.h>
#include <sys/auxv.h>
#include <unistd.h>

/* The OpenMP runtime asks the environment when it is loaded, before main(): so the program is run once more, as the
 * same process, where nobody has said how threads are to wait. A program that the loader was given by name (no base of
 * a loader then) could not be found again. */
void cli_sleep_while_waiting(char *const *arguments)
{
    char path[4096];
    if (getenv("OMP_WAIT_POLICY") || getauxval(AT_BASE) == 0)
        return;
    ssize_t length = readlink("/proc/self/exe", path, sizeof path - 1);
    if (length <= 0 || setenv("OMP_WAIT_POLICY", "passive", 1) != 0)
        return;
    path[length] = 0;
    execv(path, arguments);
}
