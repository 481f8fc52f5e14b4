/* What is asked of MPI. The module that answers is built where MPI is found, and opened where mpirun started more than
 * one process. */
#ifndef RANKS_MPI_MODULE_H
#define RANKS_MPI_MODULE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* All but `abandon` are called by every process, in the same order, from the thread that started. The gathering ones
 * return false where the others do not answer: MPI says so, or `ends` does and has for some seconds. After that only
 * `abandon` may be called, or nothing. */
typedef struct {
    void (*start)(size_t *own, size_t *count);
    /* `all` [count x size] becomes what every process has in `own`, by rank. */
    bool (*gather)(const void *own, size_t size, void *all, bool (*ends)(void));
    /* The same of words[rank] words of each. */
    bool (*gather_words)(const uint64_t *own, const size_t *words, uint64_t *all, bool (*ends)(void));
    void (*finish)(void);
    /* Ends all processes at once. */
    void (*abandon)(int status);
} sp_mpi;

/* The one function of the module, named "sp_mpi_module". */
const sp_mpi *sp_mpi_module(void);

#endif
