/* Ctrl-C and the request to end, and how far a command has come, on standard error and only when that is a terminal. */
#include "cli.h"

#include "../clock.h"

#include <math.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define LONG 0.5 /* s without a word of the search: its evaluation is worth one */

enum { CELLS = 20, LINE = 79 };

/* How a line is taken back: by an escape code, by blanks where the terminal is to have none, or not at all. */
typedef enum { ERASES, BLANKS, KEEPS } terminal;

/* The program's own state, not the library's: a signal handler has no argument to find it by. */
static volatile sig_atomic_t interrupted;
static bool searching;
static struct {
    const char *const *stages; /* the plan's, see cli_progress_plan; NULL: none */
    size_t count, first, each, rounds, round;
    size_t number; /* of the stage that it is at, from 1; 0 before the first */
    char name[64];
    double began, drawn;
    double done;   /* of the stage, when that was reported last */
    bool unsteady; /* it has fallen since: it tells nothing of the time that is left */
    double ends;   /* when the time limit does; 0: none */
    terminal kind;
    bool on_screen;
} bar;

static void on_interrupt(int number)
{
    (void)number;
    interrupted = 1;
}

double cli_time_left(void)
{
    return bar.ends > 0 ? bar.ends - sp_now() : INFINITY;
}

bool cli_interrupted(void)
{
    return interrupted;
}

void cli_progress_end(void)
{
    if (bar.on_screen && bar.kind == ERASES)
        fputs("\r\033[K", stderr);
    else if (bar.on_screen && bar.kind == BLANKS)
        fprintf(stderr, "\r%*s\r", LINE, "");
    bar.on_screen = false;
}

const char *const cli_evaluation_stages[] = {"geometry",
                                             "accelerator|wet sides|atlas|settings",
                                             "simulate|jets|patches|film|liquid",
                                             "measured error|borderline|bound on lines",
                                             "report",
                                             NULL};

void cli_progress_plan(const char *const *stages, size_t first, size_t each, size_t rounds)
{
    size_t count = 0;
    while (stages[count])
        count++;
    bar.stages = stages;
    bar.count = count;
    bar.first = first;
    bar.each = each;
    bar.rounds = rounds;
    bar.round = bar.number = 0;
}

void cli_progress_rounds(size_t rounds)
{
    bar.rounds = rounds;
}

void cli_progress_round(size_t round)
{
    bar.round = round;
}

/* Whether `stage` is among "one|another". */
static bool is_among(const char *stage, const char *names)
{
    size_t length = strlen(stage);
    for (const char *at = names; at; at = strchr(at, '|') ? strchr(at, '|') + 1 : NULL)
        if (!strncmp(at, stage, length) && (at[length] == '|' || !at[length]))
            return true;
    return false;
}

/* It never falls: what is not planned, or was there before, belongs to the stage that the command is at. */
static void count_stage(const char *stage)
{
    size_t at = 0, rounds_before = 0;
    while (at < bar.count && !is_among(stage, bar.stages[at]))
        at++;
    if (at == bar.count)
        return;
    if (at >= bar.first)
        rounds_before = at < bar.first + bar.each ? bar.round : bar.rounds - 1;
    size_t number = at + 1 + rounds_before * bar.each;
    bar.number = number > bar.number ? number : bar.number;
}

static size_t all_stages(void)
{
    return bar.count + (bar.rounds - 1) * bar.each;
}

/* Of the whole that is known where there is a limit, or nothing else to come; else of the stage. */
static void append_time_left(char *line, size_t size, double time, double done)
{
    size_t used = strlen(line);
    bool last = bar.number == all_stages();
    if (bar.ends > time)
        snprintf(line + used, size - used, "  at most %.0f s left", bar.ends - time);
    else if (!(bar.ends > 0) && done > 0.02 && done < 1 && time - bar.began > 1 && !bar.unsteady)
        snprintf(line + used, size - used, "  %.0f s left%s", (time - bar.began) * (1 - done) / done,
                 last ? "" : " of this stage");
}

/* `done` below 0: not known. */
static void write_line(char *line, size_t size, const char *stage, double time, double done)
{
    char cells[CELLS + 1], number[48] = "";
    int filled = done < 0 ? 0 : done > 1 ? CELLS : (int)(done * CELLS);
    memset(cells, ' ', CELLS);
    memset(cells, '#', (size_t)filled);
    cells[CELLS] = 0;
    if (bar.number)
        snprintf(number, sizeof number, "[%zu/%zu] ", bar.number, all_stages());
    if (bar.kind == KEEPS)
        snprintf(line, size, "%s%s", number, stage);
    else if (done < 0)
        snprintf(line, size, "%s%-14s", number, stage);
    else
        snprintf(line, size, "%s%-14s [%s] %3.0f %%", number, stage, cells, 100 * done);
    if (bar.kind != KEEPS)
        append_time_left(line, size, time, done);
}

static void draw(const char *stage, double done)
{
    double time = sp_now();
    bool fresh = strcmp(stage, bar.name) != 0;
    if (fresh) {
        snprintf(bar.name, sizeof bar.name, "%s", stage);
        bar.began = time;
        bar.unsteady = false;
        count_stage(stage);
    }
    bar.unsteady = bar.unsteady || (!fresh && done < bar.done);
    bar.done = done;
    if (!fresh && (bar.kind == KEEPS || time - bar.drawn < 0.1))
        return;
    char line[LINE + 1];
    write_line(line, sizeof line, stage, time, done);
    bar.drawn = time;
    if (bar.kind == ERASES)
        fprintf(stderr, "\r\033[K%s", line);
    else if (bar.kind == BLANKS)
        fprintf(stderr, "\r%-*s", LINE, line);
    else
        fprintf(stderr, "%s\n", line);
    fflush(stderr);
    bar.on_screen = bar.kind != KEEPS;
}

static bool search_progress(void *user, const char *stage, double done)
{
    const bool *visible = user;
    if (*visible)
        draw(stage, done);
    return !interrupted;
}

/* Once a search has begun, its evaluations end whatever is asked: without them it has nothing to return. They are told
 * of where they last, and not between any two lines of a terminal that keeps all. */
static bool progress(void *user, const char *stage, double done)
{
    if (searching && (bar.kind == KEEPS || !(done > 0 && done < 1) || sp_now() - bar.drawn < LONG))
        return true;
    return search_progress(user, stage, done) || searching;
}

static terminal kind_of_terminal(void)
{
    const char *term = getenv("TERM"), *no_colour = getenv("NO_COLOR");
    if (!term || !*term || !strcmp(term, "dumb"))
        return KEEPS;
    return no_colour && *no_colour ? BLANKS : ERASES;
}

static bool is_visible(const cli_options *options)
{
    return !options->quiet && isatty(STDERR_FILENO);
}

void cli_progress_share(const cli_options *options, const char *stage, double done)
{
    bar.kind = kind_of_terminal();
    if (is_visible(options))
        draw(stage, done);
}

void cli_progress_stage(const cli_options *options, const char *stage)
{
    cli_progress_share(options, stage, -1);
}

sp_run cli_run(const cli_options *options)
{
    static bool visible;
    visible = is_visible(options);
    bar.kind = kind_of_terminal();
    if (options->time_limit > 0 && !(bar.ends > 0))
        bar.ends = sp_now() + options->time_limit;
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
    *clock = (cli_clock){.since = sp_now(), .processor = sp_clock(CLOCK_PROCESS_CPUTIME_ID)};
}

void cli_clock_stage(cli_clock *clock, const char *name)
{
    double time = sp_now(), processor = sp_clock(CLOCK_PROCESS_CPUTIME_ID);
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
