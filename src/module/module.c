#define _GNU_SOURCE /* dladdr */
#include "module/module.h"

#include <dlfcn.h>
#include <pthread.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* To the prefix from the folder of the program, and of the shared library: in the build, and as installed, the library
 * in lib/ or in a folder for the architecture below that. */
static const char *const from_program[] = {"", "../", NULL};
static const char *const from_library[] = {"", "../", "../../", NULL};

/* Cuts a path of `length` bytes after its last slash; empty where it has none. */
static void keep_folder(char *path, ssize_t length)
{
    while (length > 0 && path[length - 1] != '/')
        length--;
    path[length > 0 ? length : 0] = '\0';
}

/* The folder of the running program with its slash, at most `size` bytes with the zero; empty where unknown. */
static void program_folder(char *folder, size_t size)
{
    keep_folder(folder, readlink("/proc/self/exe", folder, size - 1));
}

static bool is_program(const char *path)
{
    struct stat own, other;
    return stat("/proc/self/exe", &own) == 0 && stat(path, &other) == 0 && own.st_dev == other.st_dev &&
           own.st_ino == other.st_ino;
}

/* The same of the shared library that this is in; empty where it is in the program itself. */
static void library_folder(char *folder, size_t size)
{
    Dl_info info;
    static const char here;
    folder[0] = '\0';
    if (dladdr(&here, &info) && info.dli_fname && strlen(info.dli_fname) < size && !is_program(info.dli_fname))
        keep_folder(strcpy(folder, info.dli_fname), (ssize_t)strlen(info.dli_fname));
}

static bool find_below(const char *folder, const char *const *prefix, const char *below, const char *file, char *path,
                       size_t size)
{
    for (; folder[0] && *prefix; prefix++) {
        snprintf(path, size, "%s%s%s/%s", folder, *prefix, below, file);
        if (access(path, R_OK) == 0)
            return true;
    }
    return false;
}

/* The path of a file `below` the program's or the library's prefix, or else in `installed`. */
static void find_file(const char *below, const char *installed, const char *file, char *path, size_t size)
{
    char program[2048], library[2048];
    program_folder(program, sizeof program);
    library_folder(library, sizeof library);
    if (!find_below(program, from_program, below, file, path, size) &&
        !find_below(library, from_library, below, file, path, size))
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
