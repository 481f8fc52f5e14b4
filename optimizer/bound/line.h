/* All candidates in one line in which those that are alike stand together: heavier ones first, and within a weight as
 * their owner orders them. A part of the line that branch and bound looks at is a range of positions. */
#ifndef OPTIMIZER_LINE_H
#define OPTIMIZER_LINE_H

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
    /* Where the range, two candidates at least, falls apart best: inside it. */
    size_t (*cut)(void *user, size_t first, size_t end);
    /* price[position] = what the candidate is worth at prices u, rounded upwards; 0 where it is not alive. */
    bool (*price)(void *user, const sp_prices *u, const uint8_t *alive, float *price, sp_error *error);
    /* Appends the candidate's row, its position as key. */
    bool (*row)(void *user, size_t position, sp_rows *rows, sp_error *error);
} sp_line;

/* What all lines have in common; frees nothing of the owner's. */
void sp_line_free(sp_line *line);
/* The kind, the run of a position. */
size_t sp_line_kind(const sp_line *line, size_t position);
size_t sp_line_run(const sp_line *line, size_t position);

/* Candidates that all lie in memory, those that cover much the same side by side. */
typedef struct {
    const sp_cover *cover;
    const sp_rows *rows;
    size_t *order; /* [rows], row at each position */
    sp_line line;
} sp_stored_line;

/* Borrows cover and rows. */
bool sp_stored_line_create(const sp_cover *cover, const sp_rows *rows, sp_stored_line *stored, sp_error *error);
void sp_stored_line_free(sp_stored_line *stored);

#endif
