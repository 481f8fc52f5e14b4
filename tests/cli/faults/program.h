/* Runs of the program in which one call fails. */
#ifndef CLI_FAULTS_PROGRAM_H
#define CLI_FAULTS_PROGRAM_H

#include "../workplace.h"
#include "faults.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/mman.h>

/* No run may take longer: it hangs. */
#define HANGS_SECONDS 300

/* The plan that the next run keeps to. */
static fault_plan *plan;

static int open_faults(void **state)
{
    if (open_workplace(state))
        return -1;
    char path[600];
    snprintf(path, sizeof path, "%s/.plan", workplace);
    int file = open(path, O_RDWR | O_CREAT | O_EXCL, 0600);
    if (file < 0 || ftruncate(file, sizeof *plan) != 0)
        return -1;
    plan = mmap(NULL, sizeof *plan, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    close(file);
    return plan == MAP_FAILED || setenv("SPRAYPLAN_FAULTS", path, 1) ? -1 : 0;
}

static int close_faults(void **state)
{
    munmap(plan, sizeof *plan);
    return close_workplace(state);
}

/* Runs `sprayplan-faults <arguments>` in the workplace, through the shell. Its status is -SIGNAL where one ended it. */
static outcome run_faulty(const char *arguments)
{
    char line[4096];
    snprintf(line, sizeof line, "cd '%s' && exec '%s/tests/sprayplan-faults' %s >.out 2>.err </dev/null", workplace,
             BINARY_DIR, arguments);
    plan->allocations = plan->changes = 0;
    pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        alarm(HANGS_SECONDS);
        execl("/bin/sh", "sh", "-c", line, (char *)NULL);
        _exit(127);
    }
    int status;
    assert_int_equal(waitpid(child, &status, 0), child);
    return (outcome){WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status), read_file(".out", NULL),
                     read_file(".err", NULL)};
}

#endif
