#include "search/exhaustive.h"

#include "scoring/bodies.h"
#include "scoring/mount_capacity.h"
#include "spray/criterion.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

#define POSES_MOST 250      /* numbers of one byte */
#define LAYOUTS_MOST 100000 /* fewer than 2^17, so that none has 17 nozzles: its parts alone would be as many */
#define ROUND_OFF 1e-12     /* of a sum, in whatever order it is added up */
#define WORK_MOST 5e8       /* patches that all layouts go through */

/* One thread's way through the layouts that begin with one pose; with `together` NULL they are counted only. */
typedef struct {
    const sp_search *search;
    const sp_poses_alone *poses;
    sp_exhaustive_limits limits;
    sp_exhaustive_record now;
    sp_alone *together;            /* [SP_EVERY_NOZZLES + 1], of the first so many nozzles */
    sp_exhaustive_record *records; /* of `first` on, [layouts that begin so] */
    size_t count;
} walker;

static uint32_t mount_of(const walker *w, size_t pose)
{
    return w->search->sites->items[w->poses->poses[pose].site].mount;
}

static double flow_of(const walker *w, size_t pose)
{
    return w->search->candidates->variants[w->poses->poses[pose].variant].flow;
}

static bool is_clear(const walker *w, size_t pose)
{
    sp_body own = sp_pose_body(w->search, &w->poses->poses[pose]);
    bool clear = sp_body_clear_of_kept(w->search, own);
    for (size_t i = 0; clear && i < w->now.count; i++)
        clear = !sp_body_overlaps(own, sp_pose_body(w->search, &w->poses->poses[w->now.pose[i]]));
    return clear;
}

static bool has_place(const walker *w, size_t pose)
{
    uint32_t mount = mount_of(w, pose);
    double flow = w->now.flow + flow_of(w, pose);
    double outlay = w->now.outlay + sp_outlay_at(w->search, mount, flow_of(w, pose));
    size_t there = 0;
    for (size_t i = 0; i < w->now.count; i++)
        there += mount_of(w, w->now.pose[i]) == mount;
    return there < sp_mount_left(w->search, mount) && sp_number_allows(w->search, w->now.count) &&
           outlay <= w->limits.outlay && flow <= w->limits.water && is_clear(w, pose);
}

/* What a pose and those before it come to on all patches; m² that they cover. */
static double join(const walker *w, const sp_alone *before, const sp_alone *one, const sp_alone *both)
{
    const sp_criterion *criterion = &sp_evaluator_setup(w->poses->evaluator)->criterion;
    double area = 0;
    for (size_t p = 0; p < w->poses->patches; p++) {
        both->even[p] = sp_combined(criterion, before->even[p], one->even[p]);
        both->dry[p] = before->dry[p] * one->dry[p];
        bool by_film = false;
        if (both->film) {
            both->film[p] = before->film[p] + one->film[p];
            by_film = both->film[p] >= criterion->film * (1 - ROUND_OFF);
        }
        const sp_wetting wetting = {both->even[p], both->dry[p], 0};
        area += w->poses->area[p] * (by_film ? 1 : sp_wetting_share(&wetting, criterion->flux * (1 - ROUND_OFF)));
    }
    return area;
}

static void visit(walker *w, size_t pose)
{
    const sp_exhaustive_record before = w->now;
    assert(pose < w->poses->count);
    if (before.count + 1 == SP_EVERY_NOZZLES) {
        w->count = LAYOUTS_MOST + 1;
        return;
    }
    w->now.pose[w->now.count++] = (uint8_t)pose;
    w->now.flow += flow_of(w, pose);
    w->now.outlay += sp_outlay_at(w->search, mount_of(w, pose), flow_of(w, pose));
    if (w->together) {
        w->now.area = join(w, &w->together[before.count], &w->poses->alone[pose], &w->together[w->now.count]);
        w->records[w->count] = w->now;
    }
    w->count++;
    for (size_t next = pose + 1; next < w->poses->count && w->count <= LAYOUTS_MOST; next++)
        if (has_place(w, next))
            visit(w, next);
    w->now = before;
}

static walker start_of(const sp_search *search, const sp_poses_alone *poses, sp_exhaustive_limits limits)
{
    return (walker){.search = search,
                    .poses = poses,
                    .limits = limits,
                    .now = {.outlay = search->kept_flow, .flow = search->kept_flow}};
}

/* starts [count + 1]: where layouts that begin with each pose are kept; false where they are too many. */
static bool number_layouts(const sp_search *search, const sp_poses_alone *poses, sp_exhaustive_limits limits,
                           size_t *starts)
{
    walker w = start_of(search, poses, limits);
    for (size_t pose = 0; pose < poses->count && w.count <= LAYOUTS_MOST; pose++) {
        starts[pose] = w.count;
        if (has_place(&w, pose))
            visit(&w, pose);
    }
    starts[poses->count] = w.count;
    return w.count <= LAYOUTS_MOST && (double)w.count * (double)poses->patches <= WORK_MOST;
}

static void free_together(sp_alone *together)
{
    for (size_t i = 1; together && i <= SP_EVERY_NOZZLES; i++)
        sp_alone_free(&together[i]);
    free(together);
}

/* The first is the kept nozzles' own, borrowed. */
static sp_alone *create_together(const sp_poses_alone *poses)
{
    sp_alone *together = calloc(SP_EVERY_NOZZLES + 1, sizeof *together);
    bool done = together != NULL;
    for (size_t i = 1; done && i <= SP_EVERY_NOZZLES; i++)
        done = sp_alone_create(poses->evaluator, NULL, &together[i], NULL);
    if (done) {
        together[0] = poses->alone[poses->count];
        return together;
    }
    free_together(together);
    return NULL;
}

/* Goes through all layouts; the same for any number of threads. */
static bool go_through(const sp_search *search, const sp_poses_alone *poses, sp_exhaustive_limits limits,
                       const size_t *starts, sp_exhaustive_record *records, sp_error *error)
{
    bool done = true;
#pragma omp parallel num_threads(sp_threads(&search->options->run)) reduction(&& : done)
    {
        sp_alone *together = create_together(poses);
        done = together != NULL;
#pragma omp for schedule(dynamic, 1)
        for (size_t pose = 0; pose < poses->count; pose++) {
            walker w = start_of(search, poses, limits);
            w.together = together;
            w.records = records + starts[pose];
            if (together && has_place(&w, pose))
                visit(&w, pose);
            assert(!together || w.count == starts[pose + 1] - starts[pose]);
        }
        free_together(together);
    }
    return done || sp_fail_memory(error);
}

static int cheapest_first(const void *left, const void *right)
{
    const sp_exhaustive_record *a = left, *b = right;
    if (a->outlay != b->outlay)
        return a->outlay < b->outlay ? -1 : 1;
    if (a->area != b->area)
        return a->area > b->area ? -1 : 1;
    return memcmp(a->pose, b->pose, sizeof a->pose);
}

/* Whether every type that the mount is offered has a body, of which no two are in one place. */
static bool all_have_bodies(const sp_search *search, uint32_t mount)
{
    bool all = true;
    for (size_t k = 0; k < search->candidates->variant_count; k++)
        all = all && (!sp_candidates_axes(search->candidates, mount, k)->count ||
                      search->candidates->variants[k].type->body > 0);
    return all;
}

/* Whether all that a layout may be is among those that take no pose twice. */
static bool is_whole(const sp_search *search)
{
    bool once = true;
    for (uint32_t m = 0; m < search->options->mount_count; m++)
        once = once && (sp_mount_left(search, m) <= 1 || all_have_bodies(search, m));
    return once || (search->alone && !search->runoffs);
}

static bool look_at_all(const sp_search *search, sp_exhaustive_limits limits, sp_deadline *deadline, const char *stage,
                        sp_exhaustive *every, sp_error *error)
{
    size_t *starts = malloc((every->poses.count + 1) * sizeof *starts);
    bool done = starts || sp_fail_memory(error), few = done && number_layouts(search, &every->poses, limits, starts);
    bool evaluated = few;
    if (few)
        done = sp_poses_alone_evaluate(search, deadline, stage, &every->poses, &evaluated, error);
    if (done && evaluated) {
        size_t count = starts[every->poses.count];
        every->records = malloc((count + 1) * sizeof *every->records);
        done = (every->records || sp_fail_memory(error)) &&
               go_through(search, &every->poses, limits, starts, every->records, error);
        every->count = done ? count : 0;
        if (done)
            qsort(every->records, count, sizeof *every->records, cheapest_first);
    }
    free(starts);
    return done;
}

bool sp_exhaustive_create(const sp_search *search, const sp_evaluator *evaluator, sp_exhaustive_limits limits,
                          sp_deadline *deadline, const char *stage, sp_exhaustive *every, sp_error *error)
{
    *every = (sp_exhaustive){.whole = is_whole(search)};
    if (sp_evaluator_fidelity(evaluator)->method == SP_METHOD_FORWARD || !sp_deadline_goes_on(deadline, stage, 1))
        return true;
    return sp_poses_alone_list(search, evaluator, POSES_MOST, &every->poses, error) &&
           (!every->poses.count || look_at_all(search, limits, deadline, stage, every, error));
}

void sp_exhaustive_free(sp_exhaustive *every)
{
    sp_poses_alone_free(&every->poses);
    free(every->records);
    *every = (sp_exhaustive){0};
}
