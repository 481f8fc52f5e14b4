#include "module/module.h"

#include <dlfcn.h>
#include <pthread.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* What lies below a prefix: of the program's folder in the build and when installed, then absolute. */
static const char *const prefixes[] = {"", "../", NULL};

/* The folder of the running program with its slash, at most `size` bytes with the zero; empty where unknown. */
static void program_folder(char *folder, size_t size)
{
    ssize_t length = readlink("/proc/self/exe", folder, size - 1);
    while (length > 0 && folder[length - 1] != '/')
        length--;
    folder[length > 0 ? length : 0] = '\0';
}

/* The path of a file `below` the program's folder, or else in `installed`. */
static void find_file(const char *below, const char *installed, const char *file, char *path, size_t size)
{
    char folder[2048];
    program_folder(folder, sizeof folder);
    for (const char *const *prefix = prefixes; folder[0] && *prefix; prefix++) {
        snprintf(path, size, "%s%s%s/%s", folder, *prefix, below, file);
        if (access(path, R_OK) == 0)
            return;
    }
    snprintf(path, size, "%s/%s", installed, file);
}

static void *open_file(const char *file)
{
    char path[4096];
    find_file(SPRAYPLAN_MODULES_BELOW, SPRAYPLAN_MODULES, file, path, sizeof path);
    return dlopen(path, RTLD_LAZY | RTLD_LOCAL);
}

bool sp_module_program(const char *file, char *path, size_t size)
{
    find_file(SPRAYPLAN_PROGRAMS_BELOW, SPRAYPLAN_PROGRAMS, file, path, size);
    return access(path, X_OK) == 0;
}

static void find(sp_module *module)
{
    module->tried = true;
    void *opened = open_file(module->file);
    void *symbol = opened ? dlsym(opened, module->name) : NULL;
    if (symbol)
        memcpy(&module->function, &symbol, sizeof symbol); /* ISO C has no cast from data to function pointers */
    else
        sp_fail(&module->problem, SP_ERROR_FILE, NULL, 0, 0, "a part of sprayplan is not installed: %s", dlerror());
}

sp_module_function *sp_module_open(sp_module *module, sp_error *error)
{
    static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
    pthread_mutex_lock(&mutex);
    if (!module->tried)
        find(module);
    pthread_mutex_unlock(&mutex);
    if (!module->function)
        sp_fail(error, module->problem.kind, NULL, 0, 0, "%s", module->problem.message);
    return module->function;
}
