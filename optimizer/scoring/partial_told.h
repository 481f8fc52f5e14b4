/* Partial layouts from rank to rank. */
#ifndef OPTIMIZER_PARTIAL_TOLD_H
#define OPTIMIZER_PARTIAL_TOLD_H

#include "ranks/gather.h"
#include "scoring/partial.h"

/* A nozzle, whose type is told as the number of a variant that has it. */
void sp_tell_nozzle(const sp_search *search, const sp_nozzle *nozzle, sp_told *told);
/* False where none is to be heard. */
bool sp_hear_nozzle(const sp_search *search, sp_heard *heard, size_t rank, sp_nozzle *nozzle);

/* The partial layout's nozzles, with their fields on the search's patches. */
void sp_tell_partial(const sp_search *search, const sp_partial *partial, sp_told *told);
/* *partial becomes the one that is heard next from the rank, to the last bit; where none is, it stays as it was. */
bool sp_hear_partial(const sp_search *search, sp_heard *heard, size_t rank, sp_partial *partial, sp_error *error);

#endif
