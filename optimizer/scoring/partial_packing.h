/* Partial layouts from rank to rank. */
#ifndef OPTIMIZER_PARTIAL_PACKING_H
#define OPTIMIZER_PARTIAL_PACKING_H

#include "ranks/messages.h"
#include "scoring/partial.h"

/* A nozzle, whose type is packed as the number of a variant that has it. */
void sp_pack_nozzle(const sp_search *search, const sp_nozzle *nozzle, sp_outgoing *outgoing);
/* False where there is none to unpack. */
bool sp_unpack_nozzle(const sp_search *search, sp_gathered *gathered, size_t rank, sp_nozzle *nozzle);

/* The partial layout's nozzles, with their fields on the search's patches. */
void sp_pack_partial(const sp_search *search, const sp_partial *partial, sp_outgoing *outgoing);
/* *partial becomes the one that comes next from the rank, to the last bit; where none is, it stays as it was. */
bool sp_unpack_partial(const sp_search *search, sp_gathered *gathered, size_t rank, sp_partial *partial,
                       sp_error *error);

#endif
