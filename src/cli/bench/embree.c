/* The module that calls Embree, where it was built. */
#include "bench.h"

#include <dlfcn.h>
#include <string.h>
#include <unistd.h>

/* It lies beside the program, wherever that was called from; it stays open until the program ends. */
const bench_embree *bench_embree_load(void)
{
    static const char name[] = "sprayplan-embree.so";
    char path[4096];
    ssize_t length = readlink("/proc/self/exe", path, sizeof path - sizeof name);
    while (length > 0 && path[length - 1] != '/')
        length--;
    if (length <= 0)
        return NULL;
    memcpy(path + length, name, sizeof name);
    void *module = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    void *symbol = module ? dlsym(module, "bench_embree_open") : NULL;
    if (!symbol)
        return NULL;
    bench_embree_open_function *open;
    memcpy(&open, &symbol, sizeof open); /* ISO C has no cast from data to function pointers */
    return open();
}
