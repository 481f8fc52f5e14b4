#include "bound/coarse.h"

#include "bound/iterate.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

#define EACH 4 /* texels of a group: neighbours, as they are numbered */

typedef struct {
    sp_cover cover;
    float *area; /* [groups] */
    sp_rows rows;
    float *strengthened; /* [rows.used]; NULL: no inequalities */
    sp_dual dual;
} coarse;

static void coarse_free(coarse *o)
{
    free(o->area);
    free(o->strengthened);
    sp_rows_free(&o->rows);
    sp_dual_free(&o->dual);
}

/* The shares of a row, and strengthened, as means by area; returns in how many groups. */
static size_t group_row(const sp_dual *dual, const sp_rows *rows, size_t row, const sp_valid_inequalities *inequalities,
                        const float *area, uint32_t *group, float *share, float *strengthened)
{
    size_t count = 0;
    for (size_t i = rows->start[row]; i < rows->start[row + 1]; i++) {
        uint32_t t = rows->texel[i], g = t / EACH;
        float part = area[g] > 0 ? dual->cover->area[t] / area[g] : 0;
        if (!(part > 0))
            continue;
        if (!count || group[count - 1] != g) {
            group[count] = g;
            share[count] = strengthened[count] = 0;
            count++;
        }
        assert(part <= 1 && (count < 2 || group[count - 2] < g));
        share[count - 1] += part * sp_share_of(rows->share[i]);
        strengthened[count - 1] +=
            inequalities ? part * sp_share_strengthened(inequalities, dual->u.kind[t], rows->share[i]) : 0;
    }
    return count;
}

static bool group_rows(coarse *o, const sp_dual *dual, const sp_rows *rows, const sp_valid_inequalities *inequalities,
                       sp_error *error)
{
    size_t groups = o->cover.texel_count;
    uint32_t *group = malloc((groups + 1) * sizeof *group);
    float *share = malloc((groups + 1) * sizeof *share);
    o->strengthened = malloc((rows->used + 1) * sizeof *o->strengthened);
    bool done = (group && share && o->strengthened) || sp_fail_memory(error);
    for (size_t c = 0; done && c < rows->count; c++) {
        size_t count = group_row(dual, rows, c, inequalities, o->area, group, share, o->strengthened + o->rows.used);
        done = sp_rows_add(&o->rows, rows->key[c], rows->port[c], rows->tier[c], group, share, count, error);
    }
    free(group);
    free(share);
    return done;
}

static bool prepare(coarse *o, const sp_dual *dual, const sp_rows *rows, const sp_valid_inequalities *inequalities,
                    sp_error *error)
{
    const sp_cover *fine = dual->cover;
    o->cover = *fine;
    o->cover.texel_count = (fine->texel_count + EACH - 1) / EACH;
    o->cover.area = o->area = calloc(o->cover.texel_count + 1, sizeof *o->area);
    if (!o->area)
        return sp_fail_memory(error);
    for (size_t t = 0; t < fine->texel_count; t++)
        o->area[t / EACH] += fine->area[t];
    return group_rows(o, dual, rows, inequalities, error) && sp_dual_create(&o->cover, &o->dual, error) &&
           sp_dual_make_room(&o->dual, rows->count, error);
}

/* Where the iterations stand, to the groups. Multipliers there, and of resources, are of as many texels at a time. */
static void restrict_to_groups(coarse *o, const sp_dual *dual, const sp_rows *rows)
{
    sp_multipliers *u = &o->dual.u;
    memset(u->plain, 0, o->cover.texel_count * sizeof *u->plain);
    for (size_t t = 0; t < dual->texels; t++) {
        u->plain[t / EACH] += dual->u.plain[t];
        u->strengthened[t / EACH] += dual->u.strengthened[t];
    }
    for (size_t c = 0; c < rows->count; c++)
        o->dual.x[c] = dual->x[c];
    for (size_t r = 0; r < 2 + o->cover.port_count; r++)
        o->dual.dual_resource[r] = EACH * dual->dual_resource[r];
    o->dual.weight = EACH * dual->weight;
}

/* And back, from the best that was found there. */
static void spread_from_groups(const coarse *o, sp_dual *dual, const sp_rows *rows)
{
    const sp_multipliers *u = &o->dual.multipliers;
    for (size_t t = 0; t < dual->texels; t++) {
        size_t g = t / EACH;
        float part = o->area[g] > 0 ? dual->cover->area[t] / o->area[g] : 0, area = dual->cover->area[t];
        float plain = part * u->plain[g];
        dual->u.plain[t] = plain < area ? plain : area;
        float strengthened = part * u->strengthened[g], room = area - dual->u.plain[t];
        dual->u.strengthened[t] = strengthened < room ? strengthened : room;
    }
    for (size_t c = 0; c < rows->count; c++)
        dual->x[c] = o->dual.choice[c];
    for (size_t r = 0; r < 2 + o->cover.port_count; r++)
        dual->dual_resource[r] = o->dual.dual_resource[r] / EACH;
    dual->weight = o->dual.weight / EACH;
}

bool sp_coarse_solve(sp_dual *dual, const sp_rows *rows, const sp_dual_task *task, sp_error *error)
{
    coarse o = {0};
    bool done = prepare(&o, dual, rows, task->inequalities, error);
    if (done) {
        sp_dual_task own = *task;
        own.strengthened = task->inequalities ? o.strengthened : NULL;
        restrict_to_groups(&o, dual, rows);
        done = sp_dual_iterate(&o.dual, &o.rows, &own, error);
    }
    if (done)
        spread_from_groups(&o, dual, rows);
    coarse_free(&o);
    return done;
}
