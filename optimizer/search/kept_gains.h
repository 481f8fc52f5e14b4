/* What rows of fields gain on a layout, kept up column by column from one layout to the next: most change few patches.
 */
#ifndef OPTIMIZER_KEPT_GAINS_H
#define OPTIMIZER_KEPT_GAINS_H

#include "scoring/wetness.h"

/* A patch as a layout leaves it. */
typedef struct {
    float hit, film, wet, dry;
    float lack; /* worth per m² that it has still to gain */
} sp_left_over;

static inline sp_left_over sp_left_over_of(float credit, float hit, float film, float dry)
{
    float wet = film > hit ? film : hit;
    return (sp_left_over){hit, film, wet, dry, wet >= SP_ENOUGH ? 0 : dry * (1 - credit * wet)};
}

/* One on which nothing can be gained, and which is like no other. */
static const sp_left_over sp_nothing_left = {.hit = INFINITY, .wet = INFINITY};

/* False where no row's gain can differ between the two. */
static inline bool sp_left_over_differs(const sp_left_over *a, const sp_left_over *b)
{
    bool same = a->hit >= b->hit && a->hit <= b->hit && a->film >= b->film && a->film <= b->film && a->dry >= b->dry &&
                a->dry <= b->dry;
    return !same && (a->wet < SP_ENOUGH || b->wet < SP_ENOUGH);
}

/* What a field's value adds to a patch that is not wet yet, per m²; without a branch, for many at a time. */
static inline float sp_more_worth(bool single, float credit, float had, float dry, float more)
{
    float lack = 1 - credit * had, sum = had + more, most = more > had ? more : had, has = single ? most : sum;
    float plenty = has >= SP_ENOUGH ? lack : credit * (has - had);
    return dry * (more < 0 ? -more * lack : plenty);
}

/* The same of a field's value and its film. */
static inline float sp_more_worth_of_both(bool single, float credit, sp_left_over at, float field, float film)
{
    float more = field > 0 ? field : 0, edge = field < 0 ? 1 + field : 1, sum = at.hit + more;
    float hit = !single ? sum : more > at.hit ? more : at.hit, runs = at.film + film, wet = hit > runs ? hit : runs;
    return at.lack - (wet >= SP_ENOUGH ? 0 : at.dry * edge * (1 - credit * wet));
}

/* What the rows bring to one patch, as sp_placed's fields; film NULL: none is asked for. */
typedef struct {
    size_t count;
    const uint32_t *row;
    const float *field, *film; /* [count] */
} sp_column;

/* Brings `gain`, by row, share of all, from what the patch was to what it is. */
void sp_column_keep_up(bool single, float credit, float area, const sp_column *column, sp_left_over was,
                       sp_left_over is, double *gain);

/* A layout's patches, and what every row gains on it. */
typedef struct {
    size_t patch_count;
    float *hit, *film, *dry; /* [patch_count]; film NULL: none is asked for */
    double *gain;            /* [rows], share of all */
    bool found;              /* false: nothing is known yet */
} sp_kept_gains;

/* False where memory ran out; sp_kept_gains_free takes what there is then. */
bool sp_kept_gains_create(size_t patch_count, size_t row_count, bool film, sp_kept_gains *kept);
void sp_kept_gains_free(sp_kept_gains *kept);
/* Says that the gains are those of a layout that leaves the patches so; film as in creation. */
void sp_kept_gains_note(sp_kept_gains *kept, const float *hit, const float *film, const float *dry);

static inline sp_left_over sp_kept_at(const sp_kept_gains *kept, float credit, size_t p)
{
    return sp_left_over_of(credit, kept->hit[p], kept->film ? kept->film[p] : 0, kept->dry[p]);
}

#endif
