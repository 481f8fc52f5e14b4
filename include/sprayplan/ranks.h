/* Ranks: processes that mpirun started, on one machine or on many, which work out one placement together. */
#ifndef SPRAYPLAN_RANKS_H
#define SPRAYPLAN_RANKS_H

#include <sprayplan/error.h>
#include <sprayplan/export.h>

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* All processes of a run. Every one loads the same scene and calls sp_place with the same options, whose sp_run names
 * them: what is dealt out to them is gathered by all before it is used, so that all hold the same, and come to what one
 * process comes to. Whatever takes `ranks` is called by all of them, in the same order, from the thread that joined;
 * NULL stands for this process alone. */
typedef struct sp_ranks sp_ranks;

/* Joins the others where the environment says that there are some (OMPI_COMM_WORLD_SIZE or PMI_SIZE above 1); else
 * *ranks is NULL, and nothing of MPI is loaded. `ends`, which may be NULL, says whether this process has been asked to
 * end: it then waits for the others no longer than a few seconds. Once in a process. Fails with SP_ERROR_FILE where
 * there are others and the module that speaks MPI is missing. */
SP_API bool sp_ranks_join(bool (*ends)(void), sp_ranks **ranks, sp_error *error);
/* Waits for all the others, and frees. */
SP_API void sp_ranks_leave(sp_ranks *ranks);

/* Whether this process is the first, by its environment; also where it could not join. The first is the one to write
 * and to print. */
SP_API bool sp_ranks_first(void);
/* True where any process says so. */
SP_API bool sp_ranks_any(sp_ranks *ranks, bool own);
/* The others do not answer any more; this one, the first, goes on alone with what it has. */
SP_API bool sp_ranks_lost(const sp_ranks *ranks);
/* To be called by a process that has failed, before it leaves: of all that still work the next call fails.
 * True where this one is to say what went wrong: of those that failed at the same place the first. */
SP_API bool sp_ranks_fail(sp_ranks *ranks);

#ifdef __cplusplus
}
#endif
#endif
