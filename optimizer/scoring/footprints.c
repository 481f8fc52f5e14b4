#include "scoring/footprints.h"

#include "mesh/grow.h"

#include <pthread.h>
#include <stdlib.h>

#define BATCH 64 /* poses between two looks at clock and memory */

struct sp_footprints {
    sp_search search;     /* of which only what does not change is used */
    sp_footprint **known; /* [poses], by number; NULL: not traced */
    sp_footprint **added; /* [added_count], of nozzles in no candidate's pose */
    size_t added_count, added_capacity;
    double bytes;
    size_t filled; /* poses of lower numbers, of types that no pattern kernel sums, were all traced */
    bool closed;   /* what is not known brings nothing */
    bool lacking;  /* some are not known */
    pthread_mutex_t lock;
    sp_error failure;
};

static const sp_footprint nothing = {0};

static bool any_nonuniform(const sp_candidates *candidates)
{
    for (size_t k = 0; k < candidates->variant_count; k++)
        if (!sp_type_is_uniform(candidates->variants[k].type))
            return true;
    return false;
}

bool sp_footprints_create(const sp_search *search, sp_footprints **footprints, sp_error *error)
{
    *footprints = NULL;
    if (!any_nonuniform(search->candidates))
        return true;
    sp_footprints *made = calloc(1, sizeof *made);
    if (!made)
        return sp_fail_memory(error);
    made->search = *search;
    made->known = calloc(search->candidates->pose_start[search->sites->count] + 1, sizeof *made->known);
    if (!made->known) {
        free(made);
        return sp_fail_memory(error);
    }
    pthread_mutex_init(&made->lock, NULL);
    *footprints = made;
    return true;
}

void sp_footprints_destroy(sp_footprints *footprints)
{
    if (!footprints)
        return;
    for (size_t i = 0; i < footprints->search.candidates->pose_start[footprints->search.sites->count]; i++)
        if (footprints->known[i]) {
            sp_footprint_free(footprints->known[i]);
            free(footprints->known[i]);
        }
    for (size_t i = 0; i < footprints->added_count; i++) {
        sp_footprint_free(footprints->added[i]);
        free(footprints->added[i]);
    }
    free(footprints->added);
    free(footprints->known);
    pthread_mutex_destroy(&footprints->lock);
    free(footprints);
}

static sp_footprint *trace(const sp_footprints *footprints, sp_pose pose, sp_error *error)
{
    const sp_search *search = &footprints->search;
    sp_vec3 up = sp_evaluator_setup(search->coarse)->up;
    sp_nozzle nozzle = sp_pose_nozzle(search->candidates, search->sites, pose, up);
    sp_footprint *footprint = malloc(sizeof *footprint);
    sp_error refused = {0};
    if (!footprint)
        return sp_fail_memory(error);
    *footprint = nothing;
    /* a hole may stick in a wall where the mounting point does not */
    bool admitted = sp_evaluator_admits(search->coarse, &nozzle, &refused);
    if (refused.kind == SP_ERROR_MEMORY)
        sp_fail_memory(error);
    else if (!admitted || sp_footprint_trace(search, &nozzle, footprint, error))
        return footprint;
    free(footprint);
    return NULL;
}

/* Keeps what was traced, or drops it where another thread was quicker, which traced the same. */
static const sp_footprint *keep(sp_footprints *footprints, size_t number, sp_footprint *traced, const sp_error *error)
{
    const sp_footprint *kept = &nothing;
    pthread_mutex_lock(&footprints->lock);
    if (!traced)
        footprints->failure = *error;
    else if (!footprints->known[number]) {
        footprints->known[number] = traced;
        footprints->bytes += (double)(sizeof *traced + traced->count * sizeof *traced->prints);
        kept = traced;
        traced = NULL;
    } else
        kept = footprints->known[number];
    pthread_mutex_unlock(&footprints->lock);
    if (traced) {
        sp_footprint_free(traced);
        free(traced);
    }
    return kept;
}

static const sp_footprint *known(sp_footprints *footprints, size_t number)
{
    pthread_mutex_lock(&footprints->lock);
    const sp_footprint *found = footprints->known[number];
    pthread_mutex_unlock(&footprints->lock);
    return found;
}

const sp_footprint *sp_footprints_look(sp_footprints *footprints, sp_pose pose)
{
    size_t number = sp_candidates_number(footprints->search.candidates, footprints->search.sites, pose);
    const sp_footprint *found = known(footprints, number);
    if (found || footprints->closed)
        return found ? found : &nothing;
    sp_error error = {0};
    return keep(footprints, number, trace(footprints, pose, &error), &error);
}

const sp_footprint *sp_footprints_add(sp_footprints *footprints, const sp_nozzle *nozzle, sp_error *error)
{
    if (!sp_grow(&footprints->added, &footprints->added_capacity, footprints->added_count + 1,
                 sizeof *footprints->added))
        return sp_fail_memory(error);
    sp_footprint *footprint = malloc(sizeof *footprint);
    if (!footprint)
        return sp_fail_memory(error);
    if (!sp_footprint_trace(&footprints->search, nozzle, footprint, error)) {
        free(footprint);
        return NULL;
    }
    return footprints->added[footprints->added_count++] = footprint;
}

bool sp_footprints_include(sp_footprints *footprints, sp_pose pose, sp_error *error)
{
    size_t number = sp_candidates_number(footprints->search.candidates, footprints->search.sites, pose);
    sp_error own = {0};
    if (!known(footprints, number))
        keep(footprints, number, trace(footprints, pose, &own), &own);
    return sp_footprints_sound(footprints, error);
}

bool sp_footprints_know(const sp_footprints *footprints, uint32_t site, uint32_t variant)
{
    const sp_search *search = &footprints->search;
    return sp_candidates_number(search->candidates, search->sites, (sp_pose){site, variant, 0, 0}) < footprints->filled;
}

bool sp_footprints_whole(const sp_footprints *footprints)
{
    return !footprints || !footprints->lacking;
}

bool sp_footprints_sound(const sp_footprints *footprints, sp_error *error)
{
    const sp_error *failure = footprints ? &footprints->failure : NULL;
    if (!failure || failure->kind == SP_OK)
        return true;
    return sp_fail(error, failure->kind, failure->file, failure->line, failure->column, "%s", failure->message);
}

/* The poses that no pattern kernel sums; NULL when memory runs out. */
static sp_pose *list_poses(const sp_search *search, size_t *count)
{
    const sp_candidates *candidates = search->candidates;
    sp_pose *poses = malloc((candidates->pose_start[search->sites->count] + 1) * sizeof *poses);
    *count = 0;
    for (uint32_t site = 0; poses && site < search->sites->count; site++)
        for (uint32_t k = 0; k < candidates->variant_count; k++) {
            size_t axes = sp_candidates_axes(candidates, search->sites->items[site].mount, k)->count;
            for (uint32_t a = 0; a < axes && !sp_type_is_uniform(candidates->variants[k].type); a++)
                for (uint32_t r = 0; r < candidates->variants[k].roll_count; r++)
                    poses[(*count)++] = (sp_pose){site, k, a, r};
        }
    return poses;
}

/* Beside the views. */
static bool has_room(const sp_footprints *footprints, size_t poses, sp_error *error)
{
    const sp_visibility *views = footprints->search.visibility;
    return views->bytes + footprints->bytes <= views->memory ||
           sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0,
                   "memory: %g bytes found, expected more for what %zu poses of clusters, and of types that do not "
                   "spray evenly, bring to %zu patches; or fewer mounting points, or less tilt",
                   views->memory, poses, footprints->search.patch_count);
}

/* Where some poses and the last one's whole block end. */
static size_t end_of_batch(const sp_pose *poses, size_t first, size_t count)
{
    size_t end = first + BATCH < count ? first + BATCH : count;
    while (end < count && poses[end].site == poses[end - 1].site && poses[end].variant == poses[end - 1].variant)
        end++;
    return end;
}

bool sp_footprints_fill(sp_footprints *footprints, sp_deadline *deadline, sp_error *error)
{
    size_t count;
    sp_pose *poses = list_poses(&footprints->search, &count);
    int threads = sp_threads(&footprints->search.options->run);
    bool done = poses || sp_fail_memory(error);
    for (size_t first = 0, end; done && first < count; first = end) {
        end = end_of_batch(poses, first, count);
        /* out of time the first are traced all the same, so that there is something to choose from */
        if (!sp_deadline_goes_on(deadline, "footprints", (double)first / (double)count) &&
            (first || deadline->cancelled)) {
            footprints->lacking = true;
            break;
        }
#pragma omp parallel for num_threads(threads) schedule(dynamic, 1)
        for (size_t i = first; i < end; i++)
            sp_footprints_look(footprints, poses[i]);
        done = has_room(footprints, count, error) && sp_footprints_sound(footprints, error);
        footprints->filled =
            1 + sp_candidates_number(footprints->search.candidates, footprints->search.sites, poses[end - 1]);
    }
    footprints->closed = true;
    free(poses);
    return done;
}
