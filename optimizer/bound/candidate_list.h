/* All candidates in one list in which those that are alike stand together: heavier ones first, and within a weight as
 * their owner orders them. */
#ifndef OPTIMIZER_CANDIDATE_LIST_H
#define OPTIMIZER_CANDIDATE_LIST_H

#include "bound/cover.h"

typedef struct {
    void *user;
    size_t count; /* candidates */
    size_t kind_count;
    size_t *kind_start; /* [kind_count + 1] */
    uint32_t *weight;   /* [kind_count], units of water, falling */
    size_t run_count;
    size_t *run_start; /* [run_count + 1]: runs of one port, within one kind */
    size_t *run_port;  /* [run_count], SP_NO_PORT: none */
    /* price[position] = what the candidate is worth at multipliers u, rounded upwards; 0 where it is not alive. */
    bool (*price)(void *user, const sp_multipliers *u, const uint8_t *alive, float *price, sp_error *error);
    /* Appends the candidate's row, its position as key. */
    bool (*row)(void *user, size_t position, sp_rows *rows, sp_error *error);
    int threads; /* that may ask for rows at a time */
} sp_candidate_list;

/* What all lists have in common; frees nothing of the owner's. */
void sp_candidate_list_free(sp_candidate_list *list);
/* The kind, the run of a position. */
size_t sp_candidate_list_kind(const sp_candidate_list *list, size_t position);
size_t sp_candidate_list_run(const sp_candidate_list *list, size_t position);

#endif
