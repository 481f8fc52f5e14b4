#include "scoring/visibility.h"

#include "ranks/gather.h"

#include <pthread.h>
#include <stdlib.h>

#define PATCHES_MOST 30000.0
#define HURRIED_PATCHES_MOST 1700.0 /* the same where time is short; what is found is refined on the final ones */
#define PATCHES_LEAST 500.0
#define SAME 1.2           /* times longer texels are not worth patches of the search's own */
#define RAYS_MOST 1e8      /* patches times views */
#define SWEEPS_MOST 1.2e10 /* patches times poses */
#define DRAG_PATCHES_MOST 10000.0
#define DRAG_RAYS_MOST 7e6 /* the same with drag, where flights have to be looked for */
#define FILM_PATCHES_MOST 8000.0
#define FILM_SWEEPS_MOST 2e9 /* the same, where film runs down */
#define PASS_PATCHES_MOST 8000.0
#define PASS_RAYS_MOST 5e6   /* patches times positions times views, where goods move */
#define PASS_SWEEPS_MOST 2e9 /* patches times positions times poses */
#define MEMORY 1e9           /* bytes, for all views and footprints, where the options do not say */
#define PRINT 16.0           /* bytes of a patch's part of a footprint, and of the footprint itself */
#define PRINTS_SHARE 0.5     /* of the memory, that all footprints may take */
#define CELLS                                                                                                          \
    4000                /* arrivals of cells in a view that has not been traced yet: nearer to a wall than a hundredth \
                         * of a texel there may be more */
#define BATCH 16        /* sites of a rank traced between two looks at clock and memory */
#define BATCH_HURRIED 4 /* the same where time is short */
#define TIME_SHARE 0.5  /* of a time limit, that tracing may take */
#define SCORING 1.2e-6  /* s of processor that greedy takes for a pose until there is a first nozzle, roughly */
#define FIRST_SHARE 0.6 /* of the time that is left, that this may take */

struct sp_desks {
    pthread_mutex_t lock;
    pthread_cond_t left;
    sp_desk *items; /* [desk_count] */
    sp_desk *idle;
    sp_error failure;
};

static double memory_of(const sp_place_options *options)
{
    return options->memory > 0 ? options->memory : MEMORY;
}

/* Bytes that views may take. */
static double room_of(const sp_visibility *visibility)
{
    return visibility->memory - fmin(PRINTS_SHARE * visibility->memory, visibility->prints);
}

double sp_visibility_needed(const sp_place_options *options, const sp_candidates *candidates, const sp_site *site,
                            size_t launch)
{
    double reach = -1;
    for (size_t k = 0; k < candidates->variant_count; k++)
        if (candidates->variants[k].launch == launch && sp_type_is_uniform(candidates->variants[k].type) &&
            sp_candidates_axes(candidates, site->mount, k)->count)
            reach = fmax(reach, candidates->variants[k].reach);
    return reach < 0 ? reach : fmin(M_PI, reach + options->mounts[site->mount].tilt + 1e-6);
}

/* Arrivals that a view of all patches may have before it is traced, and of these of cells at a time. */
static size_t most_arrivals(const sp_evaluator *evaluator)
{
    return 2 * sp_evaluator_patches(evaluator)->count * sp_evaluator_positions(evaluator) + CELLS;
}
static size_t most_cells(const sp_evaluator *evaluator)
{
    size_t positions = sp_evaluator_positions(evaluator);
    return CELLS + (positions > 1 ? 2 * SP_SIGHTING_PART * positions : 0);
}

/* Bytes that one desk takes for views of so many arrivals: the view, its sightings and the tracing. */
static double desk_bytes(size_t arrivals, size_t cells, bool any_marked)
{
    return (double)sp_view_bytes(arrivals, any_marked) + (double)arrivals * sizeof(sp_sighting) +
           (double)sp_sightings_work(cells);
}

static uint8_t *sights_of(const sp_visibility *visibility, size_t at)
{
    return &visibility->sights[at * visibility->sight_bytes];
}

/* Traces view `at`, or works it out again; false also where there is nothing to see: then error stays as it is. */
static bool trace(const sp_visibility *visibility, size_t at, sp_sightings *sightings, sp_error *error)
{
    const sp_site *site = &visibility->sites->items[at / visibility->launch_count];
    size_t launch = at % visibility->launch_count;
    double half_angle = sp_visibility_needed(visibility->options, visibility->candidates, site, launch);
    const uint8_t *known = visibility->known[at] ? sights_of(visibility, at) : NULL;
    *sightings = (sp_sightings){0};
    return half_angle >= 0 && sp_sightings_trace(visibility->evaluator, site, visibility->candidates->launches[launch],
                                                 half_angle, known, sightings, error);
}

/* Site `i` of the order in which to trace: strided, so that a run that ends early has seen something of every mount. */
static size_t strided(size_t i, size_t count)
{
    size_t stride = (size_t)(0.6180339887 * (double)count) | 1;
    for (;; stride += 2) {
        size_t a = stride, b = count;
        while (b) {
            size_t r = a % b;
            a = b;
            b = r;
        }
        if (a == 1)
            return i * stride % count;
    }
}

/* The tracing of all views for the first time. */
typedef struct {
    sp_visibility *visibility;
    size_t *sizes;     /* [views], arrivals */
    size_t *cells;     /* [views], the same of cells, see sp_sightings */
    bool *any_marked;  /* [views] */
    bool twice_at_all; /* in some view */
    int threads;
    double kept; /* bytes of views, and of what is known of all */
    sp_error failure;
} sp_survey;

static void fail(sp_survey *survey, const sp_error *error)
{
#pragma omp critical(sp_visibility_failure)
    survey->failure = *error;
}

/* Traces a view, and keeps it or only its size. */
static void survey_view(sp_survey *survey, size_t at, bool keep)
{
    sp_visibility *visibility = survey->visibility;
    sp_sightings sightings;
    sp_error error = {0};
    if (trace(visibility, at, &sightings, &error)) {
        survey->sizes[at] = sightings.count;
        survey->cells[at] = sightings.cells;
        survey->any_marked[at] = sightings.any_marked;
        if (!visibility->known[at])
            sp_sightings_note(&sightings, sights_of(visibility, at));
        visibility->known[at] = true;
        void *block = keep ? malloc(sp_view_bytes(sightings.count, sightings.any_marked)) : NULL;
        if (block)
            sp_view_write(&sightings, &visibility->bins, block, &visibility->views[at]);
        else if (keep)
            sp_fail_memory(&error);
    }
    sp_sightings_free(&sightings);
    if (error.kind != SP_OK)
        fail(survey, &error);
}

static bool pass_on(const sp_error *failure, sp_error *error)
{
    if (failure->kind == SP_OK)
        return true;
    return sp_fail(error, failure->kind, failure->file, failure->line, failure->column, "%s", failure->message);
}

static sp_ranks *ranks_of(const sp_survey *survey)
{
    return survey->visibility->options->run.ranks;
}

/* View `i` of those in the strided order. */
static size_t view_at(const sp_survey *survey, size_t i)
{
    size_t launches = survey->visibility->launch_count;
    return strided(i / launches, survey->visibility->site_count) * launches + i % launches;
}

static bool is_mine(const sp_survey *survey, size_t at)
{
    return sp_ranks_mine(ranks_of(survey), at / survey->visibility->launch_count);
}

/* What is in sight in the others' views, and how large these are. */
static bool share_batch(sp_survey *survey, size_t first, size_t end, sp_error *error)
{
    sp_visibility *visibility = survey->visibility;
    sp_told told = {0};
    sp_heard heard;
    for (size_t i = first; sp_ranks_count(ranks_of(survey)) > 1 && i < end; i++) {
        size_t at = view_at(survey, i);
        if (!is_mine(survey, at))
            continue;
        sp_tell(&told, &survey->sizes[at], sizeof survey->sizes[at]);
        sp_tell(&told, &survey->cells[at], sizeof survey->cells[at]);
        sp_tell(&told, &survey->any_marked[at], sizeof survey->any_marked[at]);
        sp_tell(&told, sights_of(visibility, at), visibility->sight_bytes);
        sp_tell(&told, &visibility->known[at], sizeof visibility->known[at]);
    }
    if (!sp_ranks_gather(ranks_of(survey), "views", &told, &heard, error))
        return false;
    for (size_t i = first; i < end; i++) {
        size_t at = view_at(survey, i), rank = sp_ranks_owner(ranks_of(survey), at / visibility->launch_count);
        if (!is_mine(survey, at) && sp_hear(&heard, rank, &survey->sizes[at], sizeof survey->sizes[at]) &&
            sp_hear(&heard, rank, &survey->cells[at], sizeof survey->cells[at]) &&
            sp_hear(&heard, rank, &survey->any_marked[at], sizeof survey->any_marked[at]) &&
            sp_hear(&heard, rank, sights_of(visibility, at), visibility->sight_bytes))
            sp_hear(&heard, rank, &visibility->known[at], sizeof visibility->known[at]);
    }
    sp_heard_free(&heard);
    return true;
}

/* The sites first to end of the strided order, each rank its own. */
static bool survey_batch(sp_survey *survey, size_t first, size_t end, bool keep, sp_error *error)
{
    sp_visibility *visibility = survey->visibility;
    size_t launches = visibility->launch_count;
#pragma omp parallel for num_threads(survey->threads) schedule(dynamic, 1)
    for (size_t i = first * launches; i < end * launches; i++)
        if (is_mine(survey, view_at(survey, i)))
            survey_view(survey, view_at(survey, i), keep);
    if (!pass_on(&survey->failure, error) || !share_batch(survey, first * launches, end * launches, error))
        return false;
    for (size_t i = first * launches; i < end * launches; i++) {
        size_t at = view_at(survey, i);
        visibility->largest = survey->sizes[at] > visibility->largest ? survey->sizes[at] : visibility->largest;
        visibility->cells = survey->cells[at] > visibility->cells ? survey->cells[at] : visibility->cells;
        survey->twice_at_all |= survey->any_marked[at];
        if (visibility->views[at].start)
            survey->kept += (double)sp_view_bytes(survey->sizes[at], survey->any_marked[at]);
    }
    return true;
}

static size_t batch_of(const sp_place_options *options)
{
    size_t threads = (size_t)sp_threads(&options->run), few = threads > BATCH_HURRIED ? threads : BATCH_HURRIED;
    return (sp_run_hurries(&options->run) && few < BATCH ? few : BATCH) * sp_ranks_count(options->run.ranks);
}

/* Whether time is so short that the poses of so many sites leave none for more than a first nozzle. */
static bool too_many(const sp_visibility *visibility, size_t sites, sp_deadline *deadline)
{
    double all = (double)visibility->candidates->pose_start[visibility->site_count];
    double poses = all * (double)sites / (double)visibility->site_count;
    return sp_run_hurries(&visibility->options->run) &&
           SCORING * poses > FIRST_SHARE * sp_deadline_left(deadline) * sp_deadline_pace(deadline);
}

/* All sites as far as time allows. Views are kept while it is certain that there is room for them, for those of a
 * whole batch and for every thread's work. */
static bool survey_all(sp_survey *survey, sp_deadline *deadline, sp_error *error)
{
    sp_visibility *visibility = survey->visibility;
    const sp_place_options *options = visibility->options;
    size_t sites = visibility->site_count, most = most_arrivals(visibility->evaluator);
    double room = room_of(visibility), work = desk_bytes(most, most_cells(visibility->evaluator), true);
    survey->kept = (double)(sites * visibility->launch_count) * (double)visibility->sight_bytes;
    survey->threads = sp_threads(&options->run);
    if ((double)survey->threads * work > room)
        survey->threads = 1;
    size_t batch = batch_of(options);
    for (size_t first = 0; first < sites; first += batch) {
        size_t end = first + batch < sites ? first + batch : sites;
        /* out of time the first batch is traced all the same, so that there is something to choose from */
        if (!sp_deadline_goes_on(deadline, "visibility", (double)first / (double)sites) &&
            (first || deadline->cancelled))
            break;
        if (first && options->run.time_limit > 0 &&
            (sp_deadline_elapsed(deadline) > TIME_SHARE * options->run.time_limit ||
             too_many(visibility, end, deadline))) {
            deadline->interrupted = true;
            sp_deadline_cut(deadline, "visibility");
            break;
        }
        double views = BATCH * (double)visibility->launch_count * (double)sp_view_bytes(most, true);
        bool keep = survey->kept + views + (double)survey->threads * work <= room;
        if (!survey_batch(survey, first, end, keep, error))
            return false;
        visibility->bytes =
            fmax(visibility->bytes,
                 survey->kept + (double)survey->threads * desk_bytes(visibility->largest, visibility->cells, true));
    }
    return true;
}

/* Keeps as many more views as there is room for besides the desks. */
static bool fill(sp_survey *survey, double room, sp_error *error)
{
    sp_visibility *visibility = survey->visibility;
    size_t views = visibility->site_count * visibility->launch_count;
    survey->threads = visibility->desk_count;
    for (size_t first = 0, end; first < views && survey->failure.kind == SP_OK; first = end) {
        bool chosen[BATCH] = {0};
        end = first + BATCH < views ? first + BATCH : views;
        for (size_t at = first; at < end; at++) {
            double bytes = (double)sp_view_bytes(survey->sizes[at], survey->any_marked[at]);
            chosen[at - first] = visibility->known[at] && !visibility->views[at].start && survey->kept + bytes <= room;
            survey->kept += chosen[at - first] ? bytes : 0;
        }
#pragma omp parallel for num_threads(survey->threads) schedule(dynamic, 1)
        for (size_t at = first; at < end; at++)
            if (chosen[at - first])
                survey_view(survey, at, true);
    }
    return pass_on(&survey->failure, error);
}

static bool desks_create(sp_visibility *visibility, bool any_marked, sp_error *error)
{
    sp_desks *desks = visibility->desks = calloc(1, sizeof *desks);
    if (!desks)
        return sp_fail_memory(error);
    pthread_mutex_init(&desks->lock, NULL);
    pthread_cond_init(&desks->left, NULL);
    desks->items = calloc((size_t)visibility->desk_count, sizeof *desks->items);
    for (int i = 0; desks->items && i < visibility->desk_count; i++) {
        sp_desk *desk = &desks->items[i];
        *desk = (sp_desk){
            .block = malloc(sp_view_bytes(visibility->largest, any_marked)), .at = SIZE_MAX, .next = desks->idle};
        if (!desk->block)
            return sp_fail_memory(error);
        desks->idle = desk;
    }
    return desks->items || sp_fail_memory(error);
}

/* As many desks as threads and memory allow, and with what is left as many views as fit. */
static bool furnish(sp_survey *survey, sp_error *error)
{
    sp_visibility *visibility = survey->visibility;
    size_t views = visibility->site_count * visibility->launch_count, missing = 0;
    double room = room_of(visibility), work = desk_bytes(visibility->largest, visibility->cells, survey->twice_at_all);
    double sights = (double)views * (double)visibility->sight_bytes, needed = sights + work;
    if (needed > room)
        return sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0,
                       "memory: %g bytes found, expected %.0f or more for what is in sight of %zu mounting points and "
                       "to trace one of them",
                       visibility->memory, needed + fmin(needed, visibility->prints), visibility->site_count);
    visibility->desk_count = (int)fmin(sp_threads(&visibility->options->run), floor((room - sights) / work));
    double desks = visibility->desk_count * work;
    if (!fill(survey, room - desks, error))
        return false;
    for (size_t at = 0; at < views; at++)
        missing += visibility->known[at] && !visibility->views[at].start;
    visibility->bytes = fmax(visibility->bytes, survey->kept + (missing ? desks : 0));
    return !missing || desks_create(visibility, survey->twice_at_all, error);
}

/* Of poses that no sweep knows, each of which is traced by itself; and how many such poses there are. */
static double patterns_to_trace(const sp_sites *sites, const sp_candidates *candidates, double *poses)
{
    double patterns = 0;
    for (size_t i = 0; i < sites->count; i++)
        for (size_t k = 0; k < candidates->variant_count; k++) {
            const sp_variant *variant = &candidates->variants[k];
            double count =
                (double)(sp_candidates_axes(candidates, sites->items[i].mount, k)->count * variant->roll_count);
            if (sp_type_is_uniform(variant->type))
                continue;
            *poses += count;
            patterns += count * (double)sp_nozzle_pattern_count(&(sp_nozzle){.type = variant->type});
        }
    return patterns;
}

bool sp_visibility_create(const sp_evaluator *coarse, const sp_place_options *options, const sp_sites *sites,
                          const sp_candidates *candidates, sp_deadline *deadline, sp_visibility *visibility,
                          sp_error *error)
{
    size_t views = sites->count * candidates->launch_count, patches = sp_evaluator_patches(coarse)->count;
    double footprints = 0;
    patterns_to_trace(sites, candidates, &footprints);
    *visibility = (sp_visibility){.evaluator = coarse,
                                  .options = options,
                                  .sites = sites,
                                  .candidates = candidates,
                                  .site_count = sites->count,
                                  .launch_count = candidates->launch_count,
                                  .sight_bytes = patches / 4 + 1,
                                  .memory = memory_of(options),
                                  .prints = footprints * PRINT * ((double)patches + 1)};
    sp_survey survey = {.visibility = visibility};
    sp_bins_create(&visibility->bins);
    visibility->views = calloc(views + 1, sizeof *visibility->views);
    visibility->known = calloc(views + 1, sizeof *visibility->known);
    visibility->sights = calloc(views + 1, visibility->sight_bytes);
    survey.sizes = calloc(views + 1, sizeof *survey.sizes);
    survey.cells = calloc(views + 1, sizeof *survey.cells);
    survey.any_marked = calloc(views + 1, sizeof *survey.any_marked);
    bool done = visibility->views && visibility->known && visibility->sights && survey.sizes && survey.cells &&
                survey.any_marked;
    done = done || sp_fail_memory(error);
    done = done && survey_all(&survey, deadline, error) && furnish(&survey, error);
    free(survey.sizes);
    free(survey.cells);
    free(survey.any_marked);
    if (!done)
        sp_visibility_free(visibility);
    return done;
}

/* Patches on whose texels goods that move are looked at in few enough positions: with p patches of texels t, p t² being
 * the surface, p / t times the way over which they move is what a view has at most. */
static double patches_that_pass(const sp_evaluator *fine, double views, double poses, double most)
{
    const sp_sweep *sweep = &sp_evaluator_setup(fine)->sweep;
    double finer = sp_evaluator_fidelity(fine)->texel, count = (double)sp_evaluator_patches(fine)->count;
    double each = fmin(PASS_RAYS_MOST / views, PASS_SWEEPS_MOST / poses);
    double patches = cbrt(pow(each * finer / sp_distance(sweep->from, sweep->to), 2) * count);
    return fmax(PATCHES_LEAST, fmin(fmin(most, PASS_PATCHES_MOST), patches));
}

static bool any_drops(const sp_candidates *candidates)
{
    for (size_t i = 0; i < candidates->launch_count; i++)
        if (candidates->launches[i].fronts)
            return true;
    return false;
}

bool sp_visibility_fit(const sp_evaluator *fine, const sp_place_options *options, const sp_sites *sites,
                       const sp_candidates *candidates, sp_deadline *deadline, sp_evaluator **resampled,
                       sp_visibility *visibility, sp_error *error)
{
    double views = (double)sites->count * (double)candidates->launch_count, footprints = 0;
    double poses = (double)candidates->pose_start[sites->count];
    views += patterns_to_trace(sites, candidates, &footprints);
    const sp_setup *setup = sp_evaluator_setup(fine);
    bool film = setup->criterion.film > 0, drag = any_drops(candidates);
    double most = film ? FILM_PATCHES_MOST : PATCHES_MOST, sweeps = film ? FILM_SWEEPS_MOST : SWEEPS_MOST;
    most = fmin(most, PRINTS_SHARE * memory_of(options) / (PRINT * fmax(1, footprints)));
    most = drag ? fmin(most, DRAG_PATCHES_MOST) : most;
    most = sp_run_hurries(&options->run) ? fmin(most, HURRIED_PATCHES_MOST) : most;
    double rays = drag ? DRAG_RAYS_MOST : RAYS_MOST;
    double patches = fmax(PATCHES_LEAST, fmin(most, fmin(rays / views, sweeps / poses)));
    double finer = sp_evaluator_fidelity(fine)->texel;
    if (setup->sweep.speed > 0)
        patches = patches_that_pass(fine, views, poses, most);
    double texel = finer * sqrt((double)sp_evaluator_patches(fine)->count / patches);
    *resampled = NULL;
    if (film || texel > SAME * finer) {
        *resampled = sp_evaluator_resample(fine, fmax(texel, finer), error);
        if (!*resampled)
            return false;
    }
    if (sp_visibility_create(*resampled ? *resampled : fine, options, sites, candidates, deadline, visibility, error))
        return true;
    sp_evaluator_destroy(*resampled);
    *resampled = NULL;
    return false;
}

void sp_visibility_free(sp_visibility *visibility)
{
    sp_desks *desks = visibility->desks;
    for (size_t i = 0; visibility->views && i < visibility->site_count * visibility->launch_count; i++)
        free(visibility->views[i].start);
    for (int i = 0; desks && desks->items && i < visibility->desk_count; i++)
        free(desks->items[i].block);
    if (desks) {
        pthread_mutex_destroy(&desks->lock);
        pthread_cond_destroy(&desks->left);
        free(desks->items);
    }
    free(desks);
    free(visibility->views);
    free(visibility->known);
    free(visibility->sights);
    *visibility = (sp_visibility){0};
}

bool sp_visibility_sound(const sp_visibility *visibility, sp_error *error)
{
    return !visibility->desks || pass_on(&visibility->desks->failure, error);
}

static sp_desk *take_desk(sp_desks *desks)
{
    pthread_mutex_lock(&desks->lock);
    while (!desks->idle)
        pthread_cond_wait(&desks->left, &desks->lock);
    sp_desk *desk = desks->idle;
    desks->idle = desk->next;
    pthread_mutex_unlock(&desks->lock);
    return desk;
}

void sp_visibility_leave(const sp_visibility *visibility, sp_desk **desk)
{
    sp_desks *desks = visibility->desks;
    if (!*desk)
        return;
    pthread_mutex_lock(&desks->lock);
    (*desk)->next = desks->idle;
    desks->idle = *desk;
    *desk = NULL;
    pthread_cond_signal(&desks->left);
    pthread_mutex_unlock(&desks->lock);
}

const sp_view *sp_visibility_look(const sp_visibility *visibility, uint32_t site, size_t launch, sp_desk **desk)
{
    size_t at = site * visibility->launch_count + launch;
    const sp_view *kept = &visibility->views[at];
    if (kept->start || !visibility->known[at])
        return kept;
    if (!*desk)
        *desk = take_desk(visibility->desks);
    if ((*desk)->at == at)
        return &(*desk)->view;
    sp_sightings sightings;
    sp_error error = {0};
    (*desk)->at = at;
    if (trace(visibility, at, &sightings, &error))
        sp_view_write(&sightings, &visibility->bins, (*desk)->block, &(*desk)->view);
    else {
        (*desk)->view = (sp_view){0};
        (*desk)->at = SIZE_MAX;
        pthread_mutex_lock(&visibility->desks->lock);
        visibility->desks->failure = error;
        pthread_mutex_unlock(&visibility->desks->lock);
    }
    sp_sightings_free(&sightings);
    return &(*desk)->view;
}
