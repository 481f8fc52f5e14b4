/* Modules: what needs large libraries lies in a shared object of its own, opened when it is first called, so that the
 * rest of the program starts at once; what may crash is a program of its own. */
#ifndef MODULE_MODULE_H
#define MODULE_MODULE_H

#include <sprayplan/error.h>

#include <stdbool.h>
#include <stddef.h>

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

/* The path of a program that belongs to the library, to be started; false where there is none. Searched likewise, below
 * libexec. */
bool sp_module_program(const char *file, char *path, size_t size);

#endif
