/* Traces the same rays with everything that can, in turn, several times: what is compared has had the same machine. */
#include "sets.h"

#include <omp.h>
#include <stdlib.h>
#include <string.h>

const char *const bench_mode_names[MODES] = {"cone", "grid", "incoherent", "surface"};
const char *const bench_trajectory_names[TRAJECTORIES] = {"line", "parabola"};
const char *const bench_query_names[QUERIES] = {"nearest", "occluded"};

enum { MOST_ROUNDS = 9, LEAST_ROUNDS = 3, BLOCK = 4096, MOST_CONTESTANTS = 64 };
static const double ENOUGH = 0.8; /* s of tracing after which there are no more rounds than needed */

/* One way of tracing. */
typedef struct {
    int accelerator, threads, chords;
    const char *variant;
    bool wave;                /* ours: all rays in one call */
    bool coherent;            /* what Embree is told */
    bench_embree_variant how; /* Embree's */
    bench_embree_work *work;  /* Embree's */
    const bench_set *set;
    double seconds[MOST_ROUNDS];
} contestant;

typedef struct {
    const bench_scaffold *scaffold;
    const bench_case *of;
    bench_query query;
    const uint32_t *reference; /* [all rays], triangles */
    contestant list[MOST_CONTESTANTS];
    size_t count;
    sp_hit *hits;   /* [all rays] */
    bool *occluded; /* [all rays] */
} race;

static bench_size size_for(int accelerator)
{
    return accelerator == OWN_NONE                              ? SIZE_LOOP
           : accelerator == OWN_SAH || accelerator == OWN_NAIVE ? SIZE_TREE
                                                                : SIZE_FULL;
}

static void enter(race *race, contestant who)
{
    if (race->count == MOST_CONTESTANTS)
        abort();
    who.set = &race->of->sets[size_for(who.accelerator)];
    race->list[race->count++] = who;
}

static void enter_own(race *race, int threads)
{
    for (int at = 0; at < OWN; at++) {
        enter(race, (contestant){.accelerator = at, .threads = 1, .variant = "single"});
        enter(race, (contestant){.accelerator = at, .threads = 1, .variant = "wave", .wave = true});
        if (threads > 1 && size_for(at) == SIZE_FULL)
            enter(race, (contestant){.accelerator = at, .threads = threads, .variant = "wave", .wave = true});
    }
}

static bool is_coherent(const bench_case *of)
{
    return of->mode == MODE_GRID || of->sorted;
}

static void enter_embree_lines(race *race, int threads)
{
    static const char *const names[] = {"single", "packet16", "stream", "stream16"};
    for (int at = EMBREE_FAST; at <= EMBREE_ROBUST; at++)
        for (int how = BENCH_EMBREE_SINGLE; how <= BENCH_EMBREE_STREAM16; how++) {
            contestant who = {
                .accelerator = at, .threads = 1, .variant = names[how], .how = how, .coherent = is_coherent(race->of)};
            enter(race, who);
            who.threads = threads;
            if (threads > 1 && (how == BENCH_EMBREE_PACKET16 || how == BENCH_EMBREE_STREAM))
                enter(race, who);
        }
}

static void enter_embree_chords(race *race)
{
    static const struct {
        int chords;
        const char *single, *packet, *coherent;
    } cuts[] = {{8, "chords-8-single", "chords-8-packet16", "chords-8-coherent16"},
                {16, "chords-16-single", "chords-16-packet16", "chords-16-coherent16"},
                {32, "chords-32-single", "chords-32-packet16", "chords-32-coherent16"},
                {64, "chords-64-single", "chords-64-packet16", "chords-64-coherent16"}};
    for (size_t i = 0; i < sizeof cuts / sizeof *cuts; i++) {
        contestant who = {.accelerator = EMBREE_FAST, .threads = 1, .chords = cuts[i].chords};
        who.variant = cuts[i].single;
        who.how = BENCH_EMBREE_SINGLE;
        enter(race, who);
        who.variant = cuts[i].packet;
        who.how = BENCH_EMBREE_PACKET16;
        enter(race, who);
        who.variant = cuts[i].coherent;
        who.coherent = true;
        if (is_coherent(race->of))
            enter(race, who);
    }
}

static void run_own(const race *race, const contestant *who)
{
    const sp_tracer *tracer = race->scaffold->tracers[who->accelerator];
    const bench_set *set = who->set;
    sp_vec3 gravity = race->of->gravity;
    bool nearest = race->query == QUERY_NEAREST;
    if (who->wave && nearest)
        sp_trace_nearest_many(tracer, set->rays, set->count, gravity, who->threads, race->hits);
    else if (who->wave)
        sp_trace_occluded_many(tracer, set->rays, set->count, gravity, who->threads, race->occluded);
    else if (nearest)
        for (size_t i = 0; i < set->count; i++)
            race->hits[i] = sp_trace_nearest(tracer, &set->rays[i], gravity);
    else
        for (size_t i = 0; i < set->count; i++)
            race->occluded[i] = sp_trace_occluded(tracer, &set->rays[i], gravity);
}

static void run_embree(const race *race, const contestant *who)
{
    const bench_embree *embree = race->scaffold->embree;
    size_t count = who->set->count;
    if (who->threads == 1) {
        embree->work_run(who->work, 0, count);
        return;
    }
#pragma omp parallel for schedule(dynamic) num_threads(who->threads)
    for (size_t first = 0; first < count; first += BLOCK)
        embree->work_run(who->work, first, count - first < BLOCK ? count - first : BLOCK);
}

/* Embree's rays are laid out beforehand, and not timed: the program would have them so. */
static bool run_once(const race *race, contestant *who, size_t round)
{
    const bench_embree *embree = race->scaffold->embree;
    bool is_own = who->accelerator < OWN;
    if (!is_own) {
        bench_embree_task task = {.variant = who->how,
                                  .occluded = race->query == QUERY_OCCLUDED,
                                  .coherent = who->coherent,
                                  .rays = who->set->rays,
                                  .count = who->set->count,
                                  .chords = who->chords,
                                  .gravity = race->of->gravity,
                                  .span = (const double(*)[2])who->set->span};
        who->work = embree->work_create(race->scaffold->scenes[who->accelerator], &task);
        if (!who->work)
            return false;
        embree->work_reset(who->work);
    }
    double start = sp_now();
    if (is_own)
        run_own(race, who);
    else
        run_embree(race, who);
    who->seconds[round] = sp_now() - start;
    return true;
}

static uint32_t answer(const race *race, const contestant *who, size_t i)
{
    if (who->accelerator >= OWN)
        return race->scaffold->embree->work_triangle(who->work, i);
    return race->query == QUERY_NEAREST ? race->hits[i].triangle : race->occluded[i] ? 0 : SP_NONE;
}

/* Counts the answers of the run just made. */
static void count_answers(const race *race, const contestant *who, bench_trace_row *row)
{
    row->rays = who->set->count;
    for (size_t i = 0; i < who->set->count; i++) {
        uint32_t found = answer(race, who, i), expected = race->reference[who->set->order[i]];
        row->hits += found != SP_NONE;
        if (expected != SP_NONE && found == SP_NONE)
            row->missed++;
        else if (race->query == QUERY_NEAREST ? found != expected : expected == SP_NONE && found != SP_NONE)
            row->wrong++;
    }
}

static bool add_row(bench_trace *trace, const bench_trace_row *row, sp_error *error)
{
    if (trace->count == trace->room) {
        size_t room = trace->room ? 2 * trace->room : 256;
        bench_trace_row *rows = realloc(trace->rows, room * sizeof *rows);
        if (!rows)
            return sp_fail_memory(error);
        trace->rows = rows;
        trace->room = room;
    }
    trace->rows[trace->count++] = *row;
    return true;
}

/* All rounds of one race. The bare loop runs once. */
static bool run_race(race *race, const sp_run *run, bench_trace *trace, sp_error *error)
{
    bench_trace_row rows[MOST_CONTESTANTS];
    size_t round = 0;
    double start = sp_now();
    memset(rows, 0, sizeof rows);
    for (; round < MOST_ROUNDS && (round < LEAST_ROUNDS || sp_now() - start < ENOUGH); round++)
        for (size_t i = 0; i < race->count; i++) {
            contestant *who = &race->list[i];
            if (round > 0 && who->accelerator == OWN_NONE)
                continue;
            if (!run_once(race, who, round))
                return sp_fail_memory(error);
            if (round == 0)
                count_answers(race, who, &rows[i]);
            if (who->accelerator >= OWN)
                race->scaffold->embree->work_destroy(who->work);
            if (!run->progress(run->user, bench_mode_names[race->of->mode], (double)i / (double)race->count))
                return sp_fail(error, SP_ERROR_INTERRUPTED, NULL, 0, 0, "interrupted");
        }
    for (size_t i = 0; i < race->count; i++) {
        contestant *who = &race->list[i];
        bench_trace_row *row = &rows[i];
        row->accelerator = who->accelerator;
        snprintf(row->variant, sizeof row->variant, "%s", who->variant);
        row->query = race->query;
        row->mode = race->of->mode;
        row->sorted = race->of->sorted;
        row->trajectory = race->of->trajectory;
        row->threads = who->threads;
        row->sort_seconds = who->set->sort_seconds;
        double seconds = bench_median(who->seconds, who->accelerator == OWN_NONE ? 1 : round);
        row->rays_per_second = (double)row->rays / (seconds + row->sort_seconds);
        if (!add_row(trace, row, error))
            return false;
    }
    return true;
}

typedef struct {
    const bench_scaffold *scaffold;
    const bench_stage *stage;
    const bench_wish *wish;
    sp_ray *rays;        /* [wish->rays] */
    sp_hit *hits;        /* [wish->rays] */
    bool *occluded;      /* [wish->rays] */
    uint32_t *reference; /* [wish->rays], what the first of our accelerators hits */
} arena;

static bool run_case(const arena *arena, const bench_case *of, const sp_run *run, bench_trace *trace, sp_error *error)
{
    for (int query = 0; query < QUERIES; query++) {
        if (of->mode == MODE_SURFACE && query == QUERY_NEAREST)
            continue;
        race race = {.scaffold = arena->scaffold,
                     .of = of,
                     .query = query,
                     .reference = arena->reference,
                     .hits = arena->hits,
                     .occluded = arena->occluded};
        enter_own(&race, arena->wish->threads);
        if (arena->scaffold->embree && of->trajectory == TRAJECTORY_LINE)
            enter_embree_lines(&race, arena->wish->threads);
        else if (arena->scaffold->embree && (query == QUERY_NEAREST || of->mode == MODE_SURFACE))
            enter_embree_chords(&race);
        if (!run_race(&race, run, trace, error))
            return false;
    }
    return true;
}

static bool run_mode(const arena *arena, bench_mode mode, bench_trajectory trajectory, const sp_run *run,
                     bench_trace *trace, sp_error *error)
{
    size_t count = arena->wish->rays;
    bench_rays_make(arena->stage, mode, trajectory, arena->rays, count);
    sp_trace_nearest_many(arena->scaffold->tracers[OWN_BVH], arena->rays, count, bench_gravity(trajectory),
                          arena->wish->threads, arena->hits);
    for (size_t i = 0; i < count; i++)
        arena->reference[i] = arena->hits[i].triangle;
    for (int sorted = 0; sorted <= (mode != MODE_INCOHERENT); sorted++) {
        bench_case of;
        bool good =
            bench_case_create(&of, arena->stage, arena->rays, count, mode, trajectory, sorted) || sp_fail_memory(error);
        good = good && run_case(arena, &of, run, trace, error);
        bench_case_clear(&of);
        if (!good)
            return false;
    }
    return true;
}

bool bench_trace_all(const bench_scaffold *scaffold, const bench_stage *stage, const bench_wish *wish,
                     const sp_run *run, bench_trace *trace, sp_error *error)
{
    size_t room = wish->rays;
    arena arena = {.scaffold = scaffold,
                   .stage = stage,
                   .wish = wish,
                   .rays = malloc(room * sizeof *arena.rays),
                   .hits = malloc(room * sizeof *arena.hits),
                   .occluded = malloc(room * sizeof *arena.occluded),
                   .reference = malloc(room * sizeof *arena.reference)};
    bool good = (arena.rays && arena.hits && arena.occluded && arena.reference) || sp_fail_memory(error);
    for (int trajectory = 0; good && trajectory < TRAJECTORIES; trajectory++)
        for (int mode = 0; good && wish->trajectories[trajectory] && mode < MODES; mode++)
            if (wish->modes[mode])
                good = run_mode(&arena, mode, trajectory, run, trace, error);
    free(arena.rays);
    free(arena.hits);
    free(arena.occluded);
    free(arena.reference);
    return good;
}

void bench_trace_clear(bench_trace *trace)
{
    free(trace->rows);
}
