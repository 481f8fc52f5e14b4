#include "bound/tuples_work.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>

#define STEPS_LEAST 96 /* of the water, by which what is left of it is told apart */
#define STEPS_MOST 256 /* with more nozzles than that, none are few */

sp_tuples *sp_tuples_create(const sp_cover *cover, const sp_candidate_list *list, const sp_tuple_task *task,
                            sp_error *error)
{
    sp_tuples *o = calloc(1, sizeof *o);
    if (!o) {
        sp_fail_memory(error);
        return NULL;
    }
    *o = (sp_tuples){.cover = cover,
                     .list = list,
                     .water = task->water,
                     .most = task->most,
                     .floor = task->floor,
                     .bound = fmax(task->bound, task->floor),
                     .target = task->floor,
                     .least = INFINITY};
    size_t water = task->water;
    o->lightest = list->kind_count ? list->weight[list->kind_count - 1] : 0;
    if (!o->lightest || water / o->lightest > STEPS_MOST)
        return o;
    o->unit = (uint32_t)fmax(1, fmin(o->lightest, ceil((double)water / STEPS_LEAST)));
    if (water / o->unit > STEPS_MOST)
        return o;
    o->steps = water / o->unit;
    assert(o->unit <= o->lightest && o->steps <= STEPS_MOST);
    bool done = true;
    for (size_t k = 0; k < BY_MULTIPLIERS; k++) {
        o->most_priced[k] = malloc(list->kind_count * (o->steps + 1) * sizeof(double));
        done &= o->most_priced[k] != NULL;
    }
    done = done || sp_fail_memory(error);
    if (done && sp_tuples_find_items(o, task->u, task->price, error) && sp_bit_rows_create(cover, &o->sets, error))
        return o;
    sp_tuples_destroy(o);
    return NULL;
}

void sp_tuples_destroy(sp_tuples *o)
{
    if (!o)
        return;
    for (size_t k = 0; k < BY_MULTIPLIERS; k++)
        free(o->most_priced[k]);
    free(o->items);
    free(o->able);
    free(o->found);
    sp_bit_rows_free(&o->sets);
    free(o);
}

double sp_tuples_target(const sp_tuples *o, size_t candidates)
{
    float *above = malloc((o->count + 1) * sizeof *above);
    double target = o->bound;
    for (size_t i = 0; above && i < o->count; i++)
        above[i] = o->items[i].above;
    if (above && o->steps)
        target = fmax(o->least, sp_tuples_target_for(o, candidates, above, o->count));
    free(above);
    return target;
}

bool sp_tuples_bound(sp_tuples *o, double target, double work_most, sp_tuple_answer *answer, sp_error *error)
{
    *answer = (sp_tuple_answer){.bound = target};
    if (!o->steps || target < o->least)
        return true;
    o->target = target;
    o->work = 0;
    o->work_most = work_most;
    o->over = false;
    o->found_count = 0;
    bool done = sp_tuples_list_able(o, error), begun = !o->over;
    /* where it was broken off, candidates may be without sets */
    done = done && (!begun || !sp_cover_goes_on(o->cover) || sp_tuples_enumerate(o, error)) &&
           (o->over || sp_tuples_check_found(o, &answer->bound, error));
    answer->complete = done && !o->over && sp_cover_goes_on(o->cover);
    /* what was done of what is broken off depends on threads: all that it might have been counts */
    answer->work = answer->complete ? o->work : begun ? work_most : 0;
    return done;
}
