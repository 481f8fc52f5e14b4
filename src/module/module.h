/* Modules: what needs large libraries lies in a shared object of its own, opened when it is first called, so that the
 * rest of the program starts at once. */
#ifndef MODULE_MODULE_H
#define MODULE_MODULE_H

#include <sprayplan/error.h>

#include <stdbool.h>

typedef void sp_module_function(void);

/* A module and the one function of it that is called; static, with the first two set. */
typedef struct {
    const char *file, *name;
    bool tried;
    sp_module_function *function;
    sp_error problem;
} sp_module;

/* The module's function, to be cast to its own type; NULL where there is none, and why. The first call opens the
 * module, which stays open; threads may call at once. It is searched beside the program, as built and as installed,
 * and where this library was installed. */
sp_module_function *sp_module_open(sp_module *module, sp_error *error);

#endif
