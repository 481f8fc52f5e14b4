#include "search/few_jets.h"

#include <stdlib.h>

#define JETS_LEAST 1.5e4    /* fewer tell little of layouts much alike */
#define JETS_EACH_PATCH 1.5 /* with several nozzles and reflections, several times as many impacts */
#define WORTH 2             /* times fewer jets, at least */
#define WATER_APART 0.03    /* share by which the outlays of counted layouts differ, at least */
#define AREA_APART 0.001    /* the same of the area */
#define STRIDE_MOST 8       /* of the first layouts that are counted */

uint64_t sp_few_jets(const sp_search *search, const sp_evaluator *fine)
{
    const sp_fidelity *fidelity = sp_evaluator_fidelity(fine);
    double jets = fmax(JETS_LEAST, JETS_EACH_PATCH * (double)search->patch_count);
    bool moves = sp_evaluator_setup(fine)->sweep.speed > 0;
    if (fidelity->method != SP_METHOD_FORWARD || moves || (double)fidelity->jets < WORTH * jets)
        return 0;
    return (uint64_t)jets;
}

bool sp_aim_by_few_jets(sp_front *front, const sp_search *search, double target, double area, sp_error *error)
{
    double flattery = front->measured.area - area;
    sp_front_point counted = front->measured;
    counted.area = area;
    return sp_front_count(front, search, &front->best, &counted, error) &&
           (!front->draft_jets || sp_front_aim(front, search, target + flattery, error));
}

/* Layouts of a front of drafts: those by water, and those by number that are not among them. */
typedef struct {
    sp_front front;
    size_t count, apart_count;
    const sp_front_entry **entries;
    size_t *apart; /* [apart_count], those that tell something of the front */
    bool *counted; /* [count] */
} drafts;

static bool is_listed(const drafts *d, const sp_front_point *point)
{
    for (size_t i = 0; i < d->count; i++)
        if (sp_point_same(&d->entries[i]->point, point))
            return true;
    return false;
}

/* Whether it takes and covers clearly more than the last one that does. */
static bool is_apart(const drafts *d, const sp_front_point *point)
{
    const sp_front_point *last = d->apart_count ? &d->entries[d->apart[d->apart_count - 1]]->point : NULL;
    double area = sp_evaluator_patches(d->front.fine)->total_area;
    return !last || (point->outlay > last->outlay * (1 + WATER_APART) && point->area > last->area + AREA_APART * area);
}

static bool allocate(drafts *d, sp_error *error)
{
    size_t most = d->front.by_water.count + d->front.by_number.count + 1;
    d->entries = malloc(most * sizeof *d->entries);
    d->apart = malloc(most * sizeof *d->apart);
    d->counted = calloc(most, sizeof *d->counted);
    return (d->entries && d->apart && d->counted) || sp_fail_memory(error);
}

static void drafts_free(drafts *d)
{
    free(d->entries);
    free(d->apart);
    free(d->counted);
}

/* The best is counted before all. */
static void list(drafts *d)
{
    const sp_front_list *by_water = &d->front.by_water, *by_number = &d->front.by_number;
    for (size_t i = 0; i < by_water->count; i++) {
        d->entries[d->count] = &by_water->entries[i];
        if (is_apart(d, &by_water->entries[i].point))
            d->apart[d->apart_count++] = d->count;
        d->count++;
    }
    for (size_t i = 0; i < by_number->count; i++)
        if (!is_listed(d, &by_number->entries[i].point)) {
            d->entries[d->count] = &by_number->entries[i];
            d->apart[d->apart_count++] = d->count++;
        }
    for (size_t i = 0; i < d->count; i++)
        d->counted[i] = sp_point_same(&d->entries[i]->point, &d->front.measured);
}

/* Counts draft i, once; *area, m², stays what it is where there is no time. */
static bool count(drafts *d, size_t i, sp_front *front, const sp_search *search, double *area, sp_error *error)
{
    sp_front_point point = {.area = -1};
    if (d->counted[i])
        return true;
    d->counted[i] = true;
    bool done = sp_front_note(front, search, &d->entries[i]->partial, &point, error);
    if (done && point.area >= 0)
        *area = point.area;
    return done;
}

/* The draft that takes least of those that cover so much and were not counted yet; d->count where there is none. */
static size_t least_that_covers(const drafts *d, double area)
{
    size_t least = d->count;
    for (size_t i = 0; i < d->count; i++)
        if (!d->counted[i] && d->entries[i]->point.area >= area &&
            (least == d->count || d->entries[i]->point.outlay < d->entries[least]->point.outlay))
            least = i;
    return least;
}

/* As long as the target is not reached, the next that would reach it if drafts flatter it as they did the last. */
static bool reach(drafts *d, sp_front *front, const sp_search *search, sp_error *error)
{
    double flattery = d->front.measured.area - front->measured.area;
    while (front->measured.area < front->target) {
        size_t next = least_that_covers(d, front->target + flattery);
        double area = -1;
        if (next == d->count)
            break;
        if (!count(d, next, front, search, &area, error))
            return false;
        if (area >= 0)
            flattery = d->entries[next]->point.area - area;
    }
    return true;
}

/* Every eighth, then those between, and so on: time may end before the last. */
static bool count_all(drafts *d, sp_front *front, const sp_search *search, sp_error *error)
{
    bool done = true;
    double area;
    for (size_t stride = STRIDE_MOST; stride > 0; stride /= 2)
        for (size_t i = 0; done && i < d->apart_count; i += stride)
            done = count(d, d->apart[i], front, search, &area, error);
    return done;
}

/* What has been counted on the way is known for nothing, however short the time is; what bettered it since may be gone:
 * it could not be set, or was a draft. */
static bool enter_counted(sp_front *front, const sp_search *search, sp_error *error)
{
    bool done = true;
    for (size_t i = 0; done && i < front->counted.count; i++)
        done =
            sp_front_note(front, search, &front->counted.entries[i].partial, &front->counted.entries[i].point, error);
    return done;
}

static bool count_best(const drafts *d, sp_front *front, const sp_search *search, sp_error *error)
{
    const sp_partial *best = &d->front.best;
    for (size_t i = 0; i < front->counted.count; i++) {
        const sp_partial *counted = &front->counted.entries[i].partial;
        if (counted->count == best->count && counted->outlay == best->outlay && counted->covered == best->covered)
            return true;
    }
    return sp_front_measure(front, search, best, NULL, error);
}

bool sp_count_by_all_jets(sp_front *front, const sp_search *search, double target, sp_error *error)
{
    if (!front->draft_jets)
        return enter_counted(front, search, error);
    drafts d = {.front = *front};
    if (!allocate(&d, error)) {
        drafts_free(&d);
        return false;
    }
    list(&d);
    *front = sp_front_anew(&d.front);
    front->draft_jets = 0;
    sp_jet_cache_free(&front->jet_cache);
    front->target = target;
    bool done = enter_counted(front, search, error) && count_best(&d, front, search, error) &&
                reach(&d, front, search, error) && count_all(&d, front, search, error);
    sp_front_free(&d.front);
    drafts_free(&d);
    return done;
}
