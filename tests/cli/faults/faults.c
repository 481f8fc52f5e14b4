#include "faults.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <unistd.h>

static fault_plan own;
fault_plan *faults = &own;

__attribute__((constructor)) static void map_plan(void)
{
    const char *name = getenv("SPRAYPLAN_FAULTS");
    if (!name)
        return;
    int file = open(name, O_RDWR | O_CLOEXEC);
    void *plan = mmap(NULL, sizeof own, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    close(file);
    if (plan == MAP_FAILED)
        abort();
    faults = plan;
}

static bool allocation_fails(const void *place)
{
    long before = atomic_fetch_add(&faults->allocations, 1);
    if (before < FAULT_PLACES)
        faults->places[before] = (uintptr_t)place;
    if (before + 1 != faults->failing_allocation)
        return false;
    errno = ENOMEM;
    return true;
}

static bool change_fails(bool takes_room)
{
    long number = atomic_fetch_add(&faults->changes, 1) + 1;
    bool later = faults->lasting && takes_room && number > faults->failing_change;
    if (!faults->failing_change || (number != faults->failing_change && !later))
        return false;
    if (faults->cause < 0) {
        raise(-faults->cause);
        return false;
    }
    errno = faults->cause;
    return true;
}

/* clang-format off: one line a function. */
#define ALLOCATES(type, name, parameters, arguments)                                                                   \
    type __real_##name parameters;                                                                                     \
    type __wrap_##name parameters;                                                                                     \
    type __wrap_##name parameters                                                                                      \
    {                                                                                                                  \
        return allocation_fails(__builtin_return_address(0)) ? NULL : __real_##name arguments;                         \
    }
#define CHANGES(name, parameters, arguments)                                                                           \
    int __real_##name parameters;                                                                                      \
    int __wrap_##name parameters;                                                                                      \
    int __wrap_##name parameters                                                                                       \
    {                                                                                                                  \
        return change_fails(false) ? -1 : __real_##name arguments;                                                     \
    }

ALLOCATES(void *, malloc, (size_t size), (size))
ALLOCATES(void *, calloc, (size_t count, size_t size), (count, size))
ALLOCATES(void *, realloc, (void *block, size_t size), (block, size))
ALLOCATES(void *, aligned_alloc, (size_t unit, size_t size), (unit, size))
ALLOCATES(char *, strdup, (const char *text), (text))
ALLOCATES(char *, strndup, (const char *text, size_t size), (text, size))
ALLOCATES(char *, realpath, (const char *path, char *whole), (path, whole))

CHANGES(renameat, (int from, const char *name, int to, const char *other), (from, name, to, other))
CHANGES(linkat, (int from, const char *name, int to, const char *other, int flags), (from, name, to, other, flags))
CHANGES(unlinkat, (int folder, const char *name, int flags), (folder, name, flags))
CHANGES(rmdir, (const char *path), (path))
CHANGES(fsync, (int file), (file))
/* clang-format on */

ssize_t __real_getline(char **text, size_t *capacity, FILE *file);
ssize_t __wrap_getline(char **text, size_t *capacity, FILE *file);
int __real_mkdir(const char *path, mode_t mode);
int __wrap_mkdir(const char *path, mode_t mode);
int __real_mkdirat(int folder, const char *name, mode_t mode);
int __wrap_mkdirat(int folder, const char *name, mode_t mode);
char *__real_mkdtemp(char *path);
char *__wrap_mkdtemp(char *path);
int __real_openat(int folder, const char *name, int flags, ...);
int __wrap_openat(int folder, const char *name, int flags, ...);
FILE *__real_fopen(const char *path, const char *mode);
FILE *__wrap_fopen(const char *path, const char *mode);
size_t __real_fwrite(const void *bytes, size_t size, size_t count, FILE *file);
size_t __wrap_fwrite(const void *bytes, size_t size, size_t count, FILE *file);
int __real_fclose(FILE *file);
int __wrap_fclose(FILE *file);

ssize_t __wrap_getline(char **text, size_t *capacity, FILE *file)
{
    return allocation_fails(__builtin_return_address(0)) ? -1 : __real_getline(text, capacity, file);
}

int __wrap_mkdir(const char *path, mode_t mode)
{
    return change_fails(true) ? -1 : __real_mkdir(path, mode);
}

int __wrap_mkdirat(int folder, const char *name, mode_t mode)
{
    return change_fails(true) ? -1 : __real_mkdirat(folder, name, mode);
}

char *__wrap_mkdtemp(char *path)
{
    return change_fails(true) ? NULL : __real_mkdtemp(path);
}

int __wrap_openat(int folder, const char *name, int flags, ...)
{
    va_list rest;
    va_start(rest, flags);
    mode_t mode = flags & O_CREAT ? va_arg(rest, mode_t) : 0;
    va_end(rest);
    return (flags & O_CREAT) && change_fails(true) ? -1 : __real_openat(folder, name, flags, mode);
}

FILE *__wrap_fopen(const char *path, const char *mode)
{
    return mode[0] != 'r' && change_fails(true) ? NULL : __real_fopen(path, mode);
}

static bool is_written(FILE *file)
{
    return file != stdout && file != stderr && (fcntl(fileno(file), F_GETFL) & O_ACCMODE) != O_RDONLY;
}

/* What fails has written half. */
size_t __wrap_fwrite(const void *bytes, size_t size, size_t count, FILE *file)
{
    if (!is_written(file) || !change_fails(true))
        return __real_fwrite(bytes, size, count, file);
    int cause = errno;
    size_t written = __real_fwrite(bytes, size, count / 2, file);
    errno = cause;
    return written;
}

/* What fails has lost what was not yet written. */
int __wrap_fclose(FILE *file)
{
    if (!is_written(file) || !change_fails(true))
        return __real_fclose(file);
    int cause = errno, lost = ftruncate(fileno(file), 0);
    __real_fclose(file);
    errno = cause;
    return lost < 0 ? lost : EOF;
}
