#include "ranks/mpi/module.h"

#include "clock.h"

#include <limits.h>
#include <mpi.h>
#include <stdlib.h>
#include <time.h>

#define SPINS 2000 /* questions to MPI before a process that waits sleeps between them: others may want its core */
#define NAP 20000  /* ns of sleep, at first */
#define NAP_LONG 500000
#define NAPS 200 /* of the short ones */
/* s that one who has been asked to end waits for the others: the first, which can write what it has, and those that
 * nothing but the first can help. */
#define PATIENCE_FIRST 5.0
#define PATIENCE_OTHERS 60.0

static double patience;

/* Of MPI's own waiting a process that is gone would never let go. */
static bool await(MPI_Request *request, bool (*ends)(void))
{
    double asked = 0;
    for (size_t round = 0;; round++) {
        int there = 0;
        if (MPI_Test(request, &there, MPI_STATUS_IGNORE) != MPI_SUCCESS)
            return false;
        if (there)
            return true;
        if (round < SPINS)
            continue;
        if (ends && ends()) {
            asked = asked > 0 ? asked : sp_now();
            if (sp_now() - asked > patience)
                return false;
        }
        nanosleep(&(struct timespec){0, round < SPINS + NAPS ? NAP : NAP_LONG}, NULL);
    }
}

static void start(size_t *own, size_t *count)
{
    int rank, size, threads;
    MPI_Init_thread(NULL, NULL, MPI_THREAD_FUNNELED, &threads);
    MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    patience = rank ? PATIENCE_OTHERS : PATIENCE_FIRST;
    *own = (size_t)rank;
    *count = (size_t)size;
}

static bool gather(const void *own, size_t size, void *all, bool (*ends)(void))
{
    MPI_Request request;
    return MPI_Iallgather(own, (int)size, MPI_BYTE, all, (int)size, MPI_BYTE, MPI_COMM_WORLD, &request) ==
               MPI_SUCCESS &&
           await(&request, ends);
}

static bool gather_words(const uint64_t *own, const size_t *words, uint64_t *all, bool (*ends)(void))
{
    MPI_Request request;
    int rank, count;
    size_t first = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &count);
    int *counts = malloc(2 * (size_t)count * sizeof *counts), *firsts = counts ? counts + count : NULL;
    for (int i = 0; counts && i < count; first += words[i++]) {
        counts[i] = (int)words[i];
        firsts[i] = (int)first;
    }
    /* 16 GiB are more than what every process has to hold afterwards leaves room for */
    bool there = counts && first <= INT_MAX &&
                 MPI_Iallgatherv(own, counts[rank], MPI_UINT64_T, all, counts, firsts, MPI_UINT64_T, MPI_COMM_WORLD,
                                 &request) == MPI_SUCCESS &&
                 await(&request, ends);
    free(counts);
    return there;
}

static void finish(void)
{
    MPI_Finalize();
}

static void abandon(int status)
{
    MPI_Abort(MPI_COMM_WORLD, status);
}

__attribute__((visibility("default"))) const sp_mpi *sp_mpi_module(void)
{
    static const sp_mpi mpi = {start, gather, gather_words, finish, abandon};
    return &mpi;
}
