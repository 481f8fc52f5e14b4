#include "scoring/visibility_work.h"

#include "scoring/strided.h"

#include "ranks/messages.h"

#include <stdlib.h>

/* Arrivals of cells in a view that has not been traced yet: nearer to a wall than a hundredth of a texel there may be
 * more. */
#define CELLS 4000
#define BATCH 16        /* sites of a rank traced between two looks at clock and memory */
#define BATCH_HURRIED 4 /* the same where time is short */
#define TIME_SHARE 0.5  /* of a time limit, that tracing may take */
#define SCORING 1.2e-6  /* s of processor that greedy takes for a pose until there is a first nozzle, roughly */
#define FIRST_SHARE 0.6 /* of the time that is left, that this may take */

/* Bytes that views may take. */
static double room_of(const sp_visibility *visibility)
{
    return visibility->memory - fmin(SP_PRINTS_SHARE * visibility->memory, visibility->prints);
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

/* Bytes that one buffer takes for views of so many arrivals: the view, its sightings and the tracing. */
static double buffer_bytes(size_t arrivals, size_t cells, bool any_marked)
{
    return (double)sp_view_bytes(arrivals, any_marked) + (double)arrivals * sizeof(sp_sighting) +
           (double)sp_sightings_work(cells);
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

static bool pass_on(const sp_error *failure, sp_error *error)
{
    if (failure->kind == SP_OK)
        return true;
    return sp_fail(error, failure->kind, failure->file, failure->line, failure->column, "%s", failure->message);
}

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
    if (sp_visibility_trace(visibility, at, &sightings, &error)) {
        survey->sizes[at] = sightings.count;
        survey->cells[at] = sightings.cells;
        survey->any_marked[at] = sightings.any_marked;
        if (!visibility->known[at])
            sp_sightings_note(&sightings, sp_visibility_sights(visibility, at));
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

static sp_ranks *ranks_of(const sp_survey *survey)
{
    return survey->visibility->options->run.ranks;
}

/* View `i` of those in the strided order. */
static size_t view_at(const sp_survey *survey, size_t i)
{
    size_t launches = survey->visibility->launch_count;
    return sp_strided(i / launches, survey->visibility->site_count) * launches + i % launches;
}

static bool is_mine(const sp_survey *survey, size_t at)
{
    return sp_ranks_mine(ranks_of(survey), at / survey->visibility->launch_count);
}

/* What is in sight in the others' views, and how large these are. */
static bool share_batch(sp_survey *survey, size_t first, size_t end, sp_error *error)
{
    sp_visibility *visibility = survey->visibility;
    sp_outgoing outgoing = {0};
    sp_gathered gathered;
    for (size_t i = first; sp_ranks_count(ranks_of(survey)) > 1 && i < end; i++) {
        size_t at = view_at(survey, i);
        if (!is_mine(survey, at))
            continue;
        sp_pack(&outgoing, &survey->sizes[at], sizeof survey->sizes[at]);
        sp_pack(&outgoing, &survey->cells[at], sizeof survey->cells[at]);
        sp_pack(&outgoing, &survey->any_marked[at], sizeof survey->any_marked[at]);
        sp_pack(&outgoing, sp_visibility_sights(visibility, at), visibility->sight_bytes);
        sp_pack(&outgoing, &visibility->known[at], sizeof visibility->known[at]);
    }
    if (!sp_ranks_gather(ranks_of(survey), "views", &outgoing, &gathered, error))
        return false;
    for (size_t i = first; i < end; i++) {
        size_t at = view_at(survey, i), rank = sp_ranks_owner(ranks_of(survey), at / visibility->launch_count);
        if (!is_mine(survey, at) && sp_unpack(&gathered, rank, &survey->sizes[at], sizeof survey->sizes[at]) &&
            sp_unpack(&gathered, rank, &survey->cells[at], sizeof survey->cells[at]) &&
            sp_unpack(&gathered, rank, &survey->any_marked[at], sizeof survey->any_marked[at]) &&
            sp_unpack(&gathered, rank, sp_visibility_sights(visibility, at), visibility->sight_bytes))
            sp_unpack(&gathered, rank, &visibility->known[at], sizeof visibility->known[at]);
    }
    sp_gathered_free(&gathered);
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
    double room = room_of(visibility), work = buffer_bytes(most, most_cells(visibility->evaluator), true);
    survey->kept = (double)(sites * visibility->launch_count) * (double)visibility->sight_bytes;
    survey->threads = sp_threads(&options->run);
    if ((double)survey->threads * work > room)
        survey->threads = 1;
    size_t batch = batch_of(options);
    for (size_t first = 0; first < sites; first += batch) {
        size_t end = first + batch < sites ? first + batch : sites;
        /* out of time the first batch is traced all the same, so that there is something to choose from */
        if (!sp_deadline_goes_on(deadline, "visibility", (double)first / (double)sites) &&
            (first || deadline->cancelled)) {
            visibility->hurried = true;
            break;
        }
        if (first && options->run.time_limit > 0 &&
            (sp_deadline_elapsed(deadline) > TIME_SHARE * options->run.time_limit ||
             too_many(visibility, end, deadline))) {
            visibility->hurried = deadline->interrupted = true;
            sp_deadline_cut(deadline, "visibility");
            break;
        }
        double views = BATCH * (double)visibility->launch_count * (double)sp_view_bytes(most, true);
        bool keep = survey->kept + views + (double)survey->threads * work <= room;
        if (!survey_batch(survey, first, end, keep, error))
            return false;
        visibility->bytes =
            fmax(visibility->bytes,
                 survey->kept + (double)survey->threads * buffer_bytes(visibility->largest, visibility->cells, true));
    }
    return true;
}

/* Keeps as many more views as there is room for besides the buffers. */
static bool fill(sp_survey *survey, double room, sp_error *error)
{
    sp_visibility *visibility = survey->visibility;
    size_t views = visibility->site_count * visibility->launch_count;
    survey->threads = visibility->buffer_count;
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

/* As many buffers as threads and memory allow, and with what is left as many views as fit. */
static bool furnish(sp_survey *survey, sp_error *error)
{
    sp_visibility *visibility = survey->visibility;
    size_t views = visibility->site_count * visibility->launch_count, missing = 0;
    double room = room_of(visibility),
           work = buffer_bytes(visibility->largest, visibility->cells, survey->twice_at_all);
    double sights = (double)views * (double)visibility->sight_bytes, needed = sights + work;
    if (needed > room)
        return sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0,
                       "memory: %g bytes found, expected %.0f or more for what is in sight of %zu mounting points and "
                       "to trace one of them",
                       visibility->memory, needed + fmin(needed, visibility->prints), visibility->site_count);
    visibility->buffer_count = (int)fmin(sp_threads(&visibility->options->run), floor((room - sights) / work));
    double buffers = visibility->buffer_count * work;
    if (!fill(survey, room - buffers, error))
        return false;
    for (size_t at = 0; at < views; at++)
        missing += visibility->known[at] && !visibility->views[at].start;
    visibility->bytes = fmax(visibility->bytes, survey->kept + (missing ? buffers : 0));
    return !missing || sp_view_buffers_create(visibility, survey->twice_at_all, error);
}

bool sp_visibility_survey(sp_visibility *visibility, sp_deadline *deadline, sp_error *error)
{
    size_t views = visibility->site_count * visibility->launch_count;
    sp_survey survey = {.visibility = visibility,
                        .sizes = calloc(views + 1, sizeof *survey.sizes),
                        .cells = calloc(views + 1, sizeof *survey.cells),
                        .any_marked = calloc(views + 1, sizeof *survey.any_marked)};
    bool done = (survey.sizes && survey.cells && survey.any_marked) || sp_fail_memory(error);
    done = done && survey_all(&survey, deadline, error) && furnish(&survey, error);
    free(survey.sizes);
    free(survey.cells);
    free(survey.any_marked);
    return done;
}
