/* The program: options that commands share, and one function a command. */
#ifndef CLI_H
#define CLI_H

#include "usage.h"

#include <sprayplan/sprayplan.h>

#include <jansson.h>
#include <stdbool.h>
#include <stdio.h>

/* Exit status. */
enum { EXIT_DONE = 0, EXIT_OTHER = 1, EXIT_USAGE = 2, EXIT_INPUT = 3, EXIT_SHORT = 4, EXIT_INTERRUPTED = 130 };

#define MAX_OVERRIDES 64

typedef struct {
    cli_command_id command;
    const char
        *inputs[CLI_INPUTS_MOST]; /* [input_count], what stands on the command line besides command and options */
    int input_count;
    char *const *arguments; /* all that follows the program's name */
    int argument_count;
    bool json, quiet, help, version, prove, no_live, force, schema;
    int threads;
    double time_limit;  /* s, 0: none */
    double memory;      /* bytes, 0: not given */
    const char *output; /* -o, or NULL */
    const char *repair; /* --repair, or NULL */
    const char *overrides[MAX_OVERRIDES];
    size_t override_count;
    double unit;  /* m per unit of the mesh */
    double texel; /* m, 0: not given */
    sp_packing packing;
    bool reuse;
    const char *rays;              /* file, or for bench how many; or NULL */
    const char *mode, *trajectory; /* or NULL */
    sp_vec3 gravity;               /* m/s² */
    sp_accelerator accelerator;
} cli_options;

/* reading.c: - stands for standard input wherever a scene, a mesh or rays are read. */
bool cli_is_standard_input(const char *path);
/* What messages and results call it. */
const char *cli_input_name(const char *path);
/* Where the file is that is read, so that it is not written to. */
const char *cli_input_path(const char *path);
/* False, after a message on standard error, where it would have to be read twice. */
bool cli_reads_once(const cli_options *options);
sp_scene *cli_load_scene(const char *path, const cli_options *options, const sp_run *run, sp_error *error);
/* The mesh that is its only file, in m. */
sp_mesh *cli_load_mesh(const cli_options *options, sp_error *error);
/* To be closed, unless it is stdin. */
FILE *cli_open(const char *path, sp_error *error);

/* wait_policy.c: lets threads sleep where they wait for one another, instead of asking again and again, which takes the
 * processor from other programs and from one another. Before the first thread; starts the program anew with all of its
 * arguments, or returns where there is nothing to do or it cannot. */
void cli_sleep_while_waiting(char *const *arguments);

/* options.c: fills options from the arguments after the program's name; false after a message on standard error, with
 * the command as far as it was read, else CLI_COMMANDS. */
bool cli_parse(int count, char **arguments, cli_options *options);
/* Says that `help` tells of nothing that is called so, and what may have been meant. */
void cli_unknown_topic(const char *text);

/* progress.c: Ctrl-C, SIGTERM and the bar on standard error. */
/* The stages of a command, in order, NULL behind the last. One may be of several that the library names, as "exchange|
 * front". From `first` on, `each` of them come `rounds` times. Kept. */
void cli_progress_plan(const char *const *stages, size_t first, size_t each, size_t rounds);
/* Those of commands that evaluate layouts as they are; the report's is the last, and comes once. */
extern const char *const cli_evaluation_stages[];
void cli_progress_rounds(size_t rounds);
/* Which round begins, from 0. */
void cli_progress_round(size_t round);
/* A stage, and how much of it is done (0 to 1). */
void cli_progress_share(const cli_options *options, const char *stage, double done);
/* One of which nobody tells how far it is. */
void cli_progress_stage(const cli_options *options, const char *stage);
sp_run cli_run(const cli_options *options);
/* For a search that returns its best so far when it is interrupted; evaluations that run by cli_run() are not cut short
 * from then on. */
sp_run cli_search_run(const cli_options *options);
bool cli_interrupted(void);
/* Seconds until --time-limit is over, negative afterwards; INFINITY without. */
double cli_time_left(void);
void cli_progress_end(void);

/* ranks.c: joins the processes that mpirun started, until it leaves them; NULL where there are none. Only the first is
 * to write and to print. */
bool cli_join(sp_error *error);
sp_ranks *cli_ranks(void);
void cli_leave(void);

/* progress.c: seconds, by the clock and of the processor, of what a command does, in order; a stage that comes again
 * adds up. */
typedef struct {
    sp_stage stages[8];
    size_t count;
    double since, processor;
} cli_clock;
void cli_clock_start(cli_clock *clock);
void cli_clock_stage(cli_clock *clock, const char *name);

/* meter.c: bytes held on the heap, by the program's own code and the library's. */
void cli_meter_start(void);
size_t cli_meter_peak(void); /* the most since the start, beyond what was held then */

/* picture_time.c: what follows the work that --time-limit is for has to fit into it as well. */
/* How long errors, pictures and files will take, s, judged by drawing small pictures of `design`; `count` such designs
 * will be reported. 0 without a limit. */
bool cli_picture_time(const cli_options *options, const sp_design *design, size_t count, double *seconds,
                      sp_error *error);
/* What is left out for lack of time, in words. */
enum { CLI_LEFT_OUT = 8, CLI_LEFT_OUT_TEXT = 80 };
typedef struct {
    size_t count;
    char texts[CLI_LEFT_OUT][CLI_LEFT_OUT_TEXT];
    const char *list[CLI_LEFT_OUT];
} cli_left_out;
__attribute__((format(printf, 2, 3))) void cli_leave_out(cli_left_out *left_out, const char *format, ...);
/* How large the pictures are to be, as picture_share, with so many seconds for them at full size; what that leaves out.
 */
double cli_picture_share(double full, cli_left_out *left_out);
/* Of the seconds of full pictures, what all files beside them take. */
#define CLI_FILES 0.4

/* main.c: the error on standard error; the exit status that it means. Where several ranks fail alike one of them tells
 * it. */
int cli_fail(const sp_error *error);
/* The exit status of a command that has done all; said on standard error where it was interrupted too late to stop. */
int cli_done(void);

/* One a command. */
int cli_check(const cli_options *options);
int cli_simulate(const cli_options *options);
int cli_place(const cli_options *options);
int cli_compare(const cli_options *options);
int cli_trace(const cli_options *options);
int cli_atlas(const cli_options *options);
int cli_bench(const cli_options *options);
int cli_study(const cli_options *options);
int cli_help(const cli_options *options);

/* inputs.c: files that were read. Their digests are taken as soon as they were, since they may be edited meanwhile;
 * what came through a pipe or standard input is gone, and is left out. */
typedef struct {
    sp_input *list; /* [count], their paths are ours */
    size_t count;
} cli_inputs;
/* Once each. False, with an error, where one cannot be read again. */
bool cli_inputs_add(cli_inputs *inputs, const char *path, sp_error *error);
/* `path`: of the scene, as it was given. */
bool cli_inputs_add_scene(cli_inputs *inputs, const char *path, const sp_scene *scene, sp_error *error);
bool cli_inputs_join(cli_inputs *inputs, const cli_inputs *more, sp_error *error);
void cli_inputs_free(cli_inputs *inputs);

/* scene.c: what simulate, place and check begin with. */
typedef struct {
    sp_scene *scene;
    cli_inputs inputs; /* of the scene, where files or JSON are asked for */
    sp_evaluator *evaluator;
} cli_scene;
/* `evaluates`: settings left to auto are chosen for the scene's own nozzles. */
bool cli_scene_open(cli_scene *opened, const char *path, const cli_options *options, bool evaluates, cli_clock *clock,
                    sp_error *error);
void cli_scene_close(cli_scene *opened);
/* Opens the first input, does the work with it and closes it; the exit status. */
typedef int cli_work(const cli_options *options, const cli_scene *opened, cli_clock *clock, sp_error *error);
int cli_with_scene(const cli_options *options, bool evaluates, cli_work *work);

/* False, with an error, of a nozzle that is in a wall or outside, or in a port that it does not pass. */
bool cli_admits(const cli_scene *opened, const sp_nozzle *nozzle, sp_error *error);
/* idle_mounts.c: warns of each mount of the scene's on which no nozzle can stand. False where memory runs out. */
typedef void cli_warning_handler(void *user, const char *text);
bool cli_warn_of_idle_mounts(const cli_scene *opened, cli_warning_handler *warn, void *user, sp_error *error);
/* ports.c: warns of nozzles of the scene's own that stand in a port against its types, tilt, depths or steps, or where
 * another does, and of ports that are there twice. */
void cli_warn_of_port_breaches(const cli_scene *opened, cli_warning_handler *warn, void *user);
/* long_texel.c: whether the texel that is set is too long for patches to follow the surface; that, and what may be
 * meant, as a sentence. */
enum { CLI_LONG_TEXEL = 240 };
bool cli_warn_of_long_texel(const sp_setup *setup, char text[CLI_LONG_TEXEL]);
/* large_threshold.c: whether the criterion asks for more liquid than nozzles bring; that, as a sentence. */
enum { CLI_LARGE_THRESHOLD = 240 };
bool cli_warn_of_large_threshold(const sp_setup *setup, char text[CLI_LARGE_THRESHOLD]);
/* kept_limits.c: warns of limits of `place` and of its alternatives that the nozzles to be kept go beyond. */
void cli_warn_of_kept_limits(const cli_scene *opened, cli_warning_handler *warn, void *user);
/* A layout with its coverage, and the scene's mounts. */
sp_design cli_design(const cli_scene *opened, const char *name, const sp_evaluator *evaluator, const sp_layout *layout,
                     const sp_coverage *coverage);
/* What the layout does and where its liquid goes; NULL with an error, for instance where a nozzle is in a wall. */
sp_coverage *cli_simulated(const cli_scene *opened, const sp_layout *layout, sp_error *error);
/* How much of it round-off could turn, into coverage->borderline, where the inverse evaluator counted it. */
bool cli_find_borderline(const sp_evaluator *evaluator, const sp_layout *layout, sp_coverage *coverage,
                         sp_error *error);
/* Whether flights are along lines and something can be proved of what that changes; that, into coverage->line_error,
 * where it can be. */
bool cli_bounds_lines(const sp_evaluator *evaluator);
bool cli_bound_lines(const sp_evaluator *evaluator, const sp_layout *layout, sp_coverage *coverage, sp_error *error);
/* Both, and how far it is off, into coverage->measured.
 * False, and the error kept, given NULL. */
bool cli_measure(const sp_evaluator *evaluator, const sp_layout *layout, sp_coverage *coverage, sp_error *error);

/* As cli_fail, with the place in the scene of the setting that the error is about. */
int cli_fail_in(const cli_scene *opened, sp_error *error);

/* alternatives_order.c: the order [count, at least 1] in which the scene's alternatives are placed: each after those of
 * which it allows all layouts, of others the first one first. Malloc'd; NULL where memory runs out. */
size_t *cli_order_alternatives(const sp_scene *scene);

/* output.c: whether files of these names (the last is NULL) can be written where -o says, asked before the work that
 * they are to hold; layouts that were edited are not written over without --force. `scene`, whose files they must not
 * replace, may be NULL. True without -o. */
bool cli_output_ready(const cli_options *options, const sp_scene *scene, const char *const *names, sp_error *error);
extern const char *const cli_result_files[]; /* of simulate and place */
/* The file that an alternative of place's is written to as a scene, where it is not the proposed one. */
enum { CLI_LAYOUT_NAME = 40 };
void cli_layout_name(size_t alternative, char name[CLI_LAYOUT_NAME]);

/* A folder in which no file that was read can be replaced, of the command line or of the scenes [count], which may be
 * NULL. */
sp_output *cli_output_open(const cli_options *options, const char *folder, const sp_scene *const *scenes, int count,
                           sp_error *error);

/* output.c: whether a file's name ends in .obj and has something before that. */
bool cli_names_obj(const char *path);
/* output.c: the folder that a file lies in, "." where its path names none; malloc'd, NULL where memory runs out. */
char *cli_folder_of(const char *path);

/* written.c: ends the output as sp_output_commit does; *written is then what cli_say_written is to say, NULL where it
 * failed. The caller frees. */
bool cli_commit(sp_output *output, const char *folder, char **written, sp_error *error);
/* What was written, NULL for nothing: on standard output, beside JSON on standard error, where nothing more than that
 * is there. */
void cli_say_written(const cli_options *options, const char *written);

/* report.c: what simulate, place and compare end with: files where -o says, and the result on standard output. `scenes`
 * [input_count], NULL for what is none. `layout`, which is written as a scene after the first one, NULL: no
 * layout.yaml; with alternatives so are those of the others. */
bool cli_report(const cli_options *options, const sp_result *result, const sp_scene *const *scenes,
                const cli_inputs *inputs, const sp_layout *layout, sp_error *error);

/* output.c: the files, as cli_report; `written` as cli_commit. */
bool cli_write(const cli_options *options, const sp_result *result, const sp_scene *const *scenes,
               const sp_layout *layout, char **written, sp_error *error);
/* What check leaves: wet.png. True without -o. */
bool cli_write_wet(const cli_options *options, const cli_scene *opened, sp_error *error);
/* differing.c: nothing where all have all in common. */
void cli_print_differing(const sp_result *result, const sp_figures *figures);
/* summary.c: an object, which it takes, on standard output. False where memory ran out: what could not be written shows
 * at the end. */
bool cli_print_object(json_t *object, int digits);
/* The result as JSON or as a table on standard output. */
bool cli_print(const cli_options *options, const sp_result *result, sp_error *error);

#endif
