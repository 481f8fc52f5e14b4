#include "module/module.h"

#include <dlfcn.h>
#include <pthread.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* What lies below a prefix, and the prefix: of the program's folder in the build and when installed, then absolute. */
static const char below[] = SPRAYPLAN_MODULES_BELOW;
static const char *const prefixes[] = {"", "../", NULL};

/* The folder of the running program with its slash, at most `size` bytes with the zero; empty where unknown. */
static void program_folder(char *folder, size_t size)
{
    ssize_t length = readlink("/proc/self/exe", folder, size - 1);
    while (length > 0 && folder[length - 1] != '/')
        length--;
    folder[length > 0 ? length : 0] = '\0';
}

static void *open_file(const char *file)
{
    char folder[2048], path[4096];
    program_folder(folder, sizeof folder);
    for (const char *const *prefix = prefixes; folder[0] && *prefix; prefix++) {
        snprintf(path, sizeof path, "%s%s%s/%s", folder, *prefix, below, file);
        if (access(path, R_OK) == 0)
            return dlopen(path, RTLD_LAZY | RTLD_LOCAL);
    }
    snprintf(path, sizeof path, "%s/%s", SPRAYPLAN_MODULES, file);
    return dlopen(path, RTLD_LAZY | RTLD_LOCAL);
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
