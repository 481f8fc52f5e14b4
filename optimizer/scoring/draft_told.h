/* Drafts from rank to rank. */
#ifndef OPTIMIZER_DRAFT_TOLD_H
#define OPTIMIZER_DRAFT_TOLD_H

#include "ranks/gather.h"
#include "scoring/draft.h"

/* A nozzle, whose type is told as the number of a variant that has it. */
void sp_tell_nozzle(const sp_search *search, const sp_nozzle *nozzle, sp_told *told);
/* False where none is to be heard. */
bool sp_hear_nozzle(const sp_search *search, sp_heard *heard, size_t rank, sp_nozzle *nozzle);

/* The draft's nozzles, with their fields on the search's patches. */
void sp_tell_draft(const sp_search *search, const sp_draft *draft, sp_told *told);
/* *draft becomes the one that is heard next from the rank, to the last bit; where none is, it stays as it was. */
bool sp_hear_draft(const sp_search *search, sp_heard *heard, size_t rank, sp_draft *draft, sp_error *error);

#endif
