/* Calls of ours that fail by plan: the linker leads those of what is linked with it here (--wrap). What shared
 * libraries call by themselves never fails. */
#ifndef CLI_FAULTS_H
#define CLI_FAULTS_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>

#define FAULT_PLACES 32768

typedef struct {
    atomic_long allocations, changes; /* counted so far: what asks for memory, what writes to the file system */
    long failing_allocation;          /* its number, from 1; 0: none */
    long failing_change;
    int cause;                      /* errno of the failing change; below 0: the process gets that signal before it */
    uintptr_t places[FAULT_PLACES]; /* by the number of the allocation less one, where in the code it was asked for */
    bool lasting; /* all that writes fails from then on; what renames and removes does not, as on a full disk */
} fault_plan;

/* In a program that is started with the environment variable SPRAYPLAN_FAULTS the plan lies in the file that it names.
 */
extern fault_plan *faults;

#endif
