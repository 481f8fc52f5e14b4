/* Maximum coverage: candidates as sparse rows over texels, of which some may be chosen within number, water and ports.
 *
 * A texel counts as covered only where the shares of the chosen candidates come to at least 1. With liquid that adds up
 * a share is min(1, flux over what the texel still needs); where one nozzle alone must do, it is 1 or 0. Where a texel
 * may be covered in several ways, a candidate's share is the greatest of theirs. Where a candidate's spray ends within
 * a texel it covers a part of it alone; no more of the texel is covered than these parts come to, unless shares on all
 * of it come to 1. */
#ifndef OPTIMIZER_COVER_H
#define OPTIMIZER_COVER_H

#include "bound/knapsack.h"
#include "bound/valid_inequality.h"

#include <math.h>

#define SP_NO_PORT SIZE_MAX
#define SP_OWN_KEY UINT64_MAX

typedef struct {
    size_t texel_count;
    const float *area;      /* [texel_count], m²; 0: is covered anyway, or counts for nothing */
    double base;            /* m² that are covered whatever is chosen, besides */
    size_t tier_count;      /* of candidates, by water */
    const uint32_t *weight; /* [tier_count], whole units of water, above 0 */
    size_t port_count;      /* each holds one candidate at most */
    size_t nozzles, water;  /* most that may be chosen; units */
    const bool *sums;       /* [water + 1], whether any candidates come to just so much; NULL: all may */
    bool repeats;           /* a candidate without a port may be chosen more than once */
    bool whole;             /* every share is 1: nothing to strengthen */
    int threads;
    /* Asked now and then, from any thread; once false always false: then solves and pricings break off, and what they
     * were about proves nothing. NULL: go on. */
    bool (*goes_on)(void *user);
    void *user;
} sp_cover;

static inline bool sp_cover_goes_on(const sp_cover *cover)
{
    return !cover->goes_on || cover->goes_on(cover->user);
}

typedef struct {
    size_t count, capacity;
    size_t *start; /* [count + 1] */
    size_t *port;  /* [count], SP_NO_PORT: none */
    uint32_t *tier;
    uint64_t *key; /* which candidate it is; SP_OWN_KEY: a nozzle of a layout that was found */
    size_t used, room;
    uint32_t *texel; /* [used], ascending in a row */
    float *share; /* [used], above 0, at most 1; or below 0: of so much of the texel a whole share (see sp_share_of) */
} sp_rows;

/* What a row's entry counts for in sums of plain shares; and of strengthened ones: a candidate covers the part of a
 * texel that lies at its spray's edge by itself or not at all. */
static inline float sp_share_of(float share)
{
    return fabsf(share);
}
static inline float sp_share_strengthened(const sp_valid_inequalities *inequalities, size_t kind, float share)
{
    return share < 0 ? -share : sp_strengthen(inequalities, kind, share);
}

/* Appends a row of `count` texels; false when memory runs out. */
bool sp_rows_add(sp_rows *rows, uint64_t key, size_t port, uint32_t tier, const uint32_t *texels, const float *shares,
                 size_t count, sp_error *error);
/* Appends all of `more`. */
bool sp_rows_append(sp_rows *rows, const sp_rows *more, sp_error *error);
/* Keeps the rows that are marked, in their order. */
void sp_rows_keep(sp_rows *rows, const bool *marked);
void sp_rows_free(sp_rows *rows);
/* All keys, rising; malloc'd, NULL when memory runs out. And whether a key is among some. */
uint64_t *sp_rows_keys(const sp_rows *rows);
bool sp_keys_hold(const uint64_t *keys, size_t count, uint64_t key);

/* Lagrange multipliers of texels, m²: of their shares, and of what one of the inequalities makes of these. */
typedef struct {
    const sp_valid_inequalities *inequalities; /* NULL: only shares count */
    float *plain, *strengthened;               /* [texels], plain + strengthened <= area */
    uint8_t *kind;                             /* [texels], which inequality */
} sp_multipliers;

bool sp_multipliers_create(const sp_cover *cover, sp_multipliers *multipliers, sp_error *error);
void sp_multipliers_copy(const sp_cover *cover, const sp_multipliers *from, sp_multipliers *to);
void sp_multipliers_free(sp_multipliers *multipliers);

/* What a row is worth; rounded upwards. */
double sp_rows_price(const sp_rows *rows, size_t row, const sp_multipliers *multipliers);
/* The area, Σ (area - multiplier), that multipliers leave: what no candidate has to bring. Rounded upwards. */
double sp_cover_rest(const sp_cover *cover, const sp_multipliers *multipliers);

#endif
