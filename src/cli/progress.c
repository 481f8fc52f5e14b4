/* Ctrl-C and the request to end, and the progress bar on standard error, only when that is a terminal. */
#include "cli.h"

#include <signal.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

/* The program's own state, not the library's: a signal handler has no argument to find it by. */
static volatile sig_atomic_t interrupted;
static bool searching;
static struct {
    char stage[64];
    double began, drawn;
    bool on_screen;
} bar;

static double read_clock(clockid_t clock)
{
    struct timespec time = {0};
    clock_gettime(clock, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

static double now(void)
{
    return read_clock(CLOCK_MONOTONIC);
}

static void on_interrupt(int number)
{
    (void)number;
    interrupted = 1;
}

bool cli_interrupted(void)
{
    return interrupted;
}

void cli_progress_end(void)
{
    if (bar.on_screen)
        fputs("\r\033[K", stderr);
    bar.on_screen = false;
}

static void draw(const char *stage, double done)
{
    enum { WIDTH = 30 };
    char cells[WIDTH + 1];
    double time = now();
    if (strcmp(stage, bar.stage)) {
        snprintf(bar.stage, sizeof bar.stage, "%s", stage);
        bar.began = time;
        bar.drawn = 0;
    }
    if (time - bar.drawn < 0.1)
        return;
    bar.drawn = time;
    int filled = done < 0 ? 0 : done > 1 ? WIDTH : (int)(done * WIDTH);
    memset(cells, ' ', WIDTH);
    memset(cells, '#', (size_t)filled);
    cells[WIDTH] = 0;
    fprintf(stderr, "\r\033[K%-14s [%s] %3.0f %%", stage, cells, 100 * done);
    if (done > 0.02 && time - bar.began > 1)
        fprintf(stderr, "  %.0f s left", (time - bar.began) * (1 - done) / done);
    fflush(stderr);
    bar.on_screen = true;
}

static bool search_progress(void *user, const char *stage, double done)
{
    const bool *visible = user;
    if (*visible)
        draw(stage, done);
    return !interrupted;
}

/* Once a search has begun, its evaluations end whatever is asked: without them it has nothing to return. */
static bool progress(void *user, const char *stage, double done)
{
    return search_progress(user, stage, done) || searching;
}

sp_run cli_run(const cli_options *options)
{
    static bool visible;
    visible = !options->quiet && isatty(STDERR_FILENO);
    /* SIGTERM is what timeout(1), schedulers and shutting down send: no reason to lose what was found. The second of
     * either ends the program at once. */
    struct sigaction action = {.sa_handler = on_interrupt, .sa_flags = (int)SA_RESETHAND};
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
    return (sp_run){
        .threads = options->threads, .progress = progress, .user = &visible, .time_limit = options->time_limit};
}

sp_run cli_search_run(const cli_options *options)
{
    sp_run run = cli_run(options);
    run.progress = search_progress;
    run.ranks = cli_ranks();
    searching = true;
    return run;
}

void cli_clock_start(cli_clock *clock)
{
    *clock = (cli_clock){.since = now(), .processor = read_clock(CLOCK_PROCESS_CPUTIME_ID)};
}

void cli_clock_stage(cli_clock *clock, const char *name)
{
    double time = now(), processor = read_clock(CLOCK_PROCESS_CPUTIME_ID);
    size_t at = 0;
    while (at < clock->count && strcmp(clock->stages[at].name, name))
        at++;
    if (at < sizeof clock->stages / sizeof *clock->stages) {
        sp_stage *stage = &clock->stages[at];
        if (at == clock->count) {
            *stage = (sp_stage){0};
            snprintf(stage->name, sizeof stage->name, "%s", name);
            clock->count++;
        }
        stage->seconds += time - clock->since;
        stage->processor_seconds += processor - clock->processor;
    }
    clock->since = time;
    clock->processor = processor;
}
