/* Candidates as sets of texels, one bit each, so that what several of them cover together is counted 64 texels at a
 * time. Texels of a word are of nearly the same area, and count as the largest of them. */
#ifndef OPTIMIZER_BIT_ROWS_H
#define OPTIMIZER_BIT_ROWS_H

#include "bound/cover.h"

typedef struct {
    size_t words;    /* of a row */
    double unit;     /* m² */
    uint32_t *area;  /* [words], units of a texel, rounded upwards */
    uint32_t *place; /* [texels], which bit; UINT32_MAX: its area counts for nothing */
    size_t count, capacity;
    uint64_t *bits; /* [count x words] */
    double *edge;   /* [count], m² that its edges cover by themselves at most, of texels not among its bits */
    size_t *start;  /* [count + 1], of these */
    size_t edges, room;
    uint32_t *edge_at;  /* [edges], which bit it would be */
    float *edge_covers; /* [edges], m² */
} sp_bit_rows;

/* Without rows. */
bool sp_bit_rows_create(const sp_cover *cover, sp_bit_rows *sets, sp_error *error);
void sp_bit_rows_free(sp_bit_rows *sets);
/* Appends a row: a bit where it brings a share of `least` at least, above 0. */
bool sp_bit_rows_add(sp_bit_rows *sets, const sp_cover *cover, const sp_rows *rows, size_t row, double least,
                     sp_error *error);
/* Of all rows. */
double sp_bit_rows_bytes(const sp_bit_rows *sets);
/* m² of a row's bits that are not among `had` [words], rounded upwards; and what its edges cover beside these. */
double sp_bit_rows_gain(const sp_bit_rows *sets, size_t row, const uint64_t *had);
double sp_bit_rows_edge(const sp_bit_rows *sets, size_t row, const uint64_t *had);

#endif
