/* Messages among ranks: each sends what it has done of what was dealt out, all of it to all. */
#ifndef RANKS_MESSAGES_H
#define RANKS_MESSAGES_H

#include <sprayplan/ranks.h>

#include <stdbool.h>
#include <stdint.h>

/* How many work together, 1 where the others are lost, and which of them this one is. */
size_t sp_ranks_count(const sp_ranks *ranks);
size_t sp_ranks_own(const sp_ranks *ranks);
/* Who does part i of what is dealt out: to and fro, as parts are often longer the later they come, or by turns. */
static inline size_t sp_ranks_owner(const sp_ranks *ranks, size_t i)
{
    size_t count = sp_ranks_count(ranks), at = i % (2 * count);
    return at < count ? at : 2 * count - 1 - at;
}
static inline bool sp_ranks_mine(const sp_ranks *ranks, size_t i)
{
    return sp_ranks_owner(ranks, i) == sp_ranks_own(ranks);
}

/* From sp_ranks_part until sp_ranks_rejoin each does its own: what it decides there by the clock or since it was asked
 * to end is known to it alone, and it may call nothing here. sp_ranks_apart: between the two. */
void sp_ranks_part(sp_ranks *ranks);
void sp_ranks_rejoin(sp_ranks *ranks);
bool sp_ranks_apart(const sp_ranks *ranks);

/* Bytes in the making: what one rank sends. {0} at first. */
typedef struct {
    size_t count, capacity;
    unsigned char *bytes;
    bool lacks_memory;
} sp_outgoing;
void sp_pack(sp_outgoing *outgoing, const void *bytes, size_t size);
void sp_outgoing_free(sp_outgoing *outgoing);

/* What all ranks sent, each part read once from its beginning. */
typedef struct {
    size_t count;     /* of ranks; 0: nobody was asked */
    size_t *at, *end; /* [count] of `bytes` */
    unsigned char *bytes;
} sp_gathered;
/* All-to-all: sends to all and receives from all; `what` is the same on all ranks, or they have come apart. From a
 * single rank nothing comes, nor from ranks that are lost: what was dealt out to them is as though it had not been
 * begun. Frees `outgoing`. False with an error, and nothing to free, where memory runs out or a rank has failed. */
bool sp_ranks_gather(sp_ranks *ranks, const char *what, sp_outgoing *outgoing, sp_gathered *gathered, sp_error *error);
/* Reads on in what a rank sent; false, and `bytes` as they were, where that is not there. */
bool sp_unpack(sp_gathered *gathered, size_t rank, void *bytes, size_t size);
void sp_gathered_free(sp_gathered *gathered);

/* The highest of what all ranks have, of each of a few values; as they are where the others are lost. */
enum { SP_VALUES_MOST = 4 };
bool sp_ranks_highest(sp_ranks *ranks, const char *what, double *values, size_t count, sp_error *error);

#endif
