/* What a result holds besides its designs: what each nozzle does, how and when it was made. */
#include "cli.h"

#include <stdlib.h>
#include <string.h>
#include <time.h>

#define LATE 0.5 /* of the time of full pictures: with less left they come first */

typedef struct {
    sp_design *designs; /* [design_count], with contributions that are ours */
    size_t design_count;
    char *command_line;
    char date[32];
    cli_left_out left_out;
    double pictures; /* s, of full size; 0 where nothing limits them */
} background;

static void background_free(background *added)
{
    for (size_t i = 0; added->designs && i < added->design_count; i++)
        sp_contributions_destroy((sp_contributions *)added->designs[i].contributions);
    free(added->designs);
    free(added->command_line);
}

/* Of one design; what a search has found is worth its report without them, where it is interrupted. */
static bool find_contributions_of(const cli_options *options, sp_design *design, sp_error *error)
{
    if (options->command == CLI_PLACE && cli_interrupted())
        return true;
    design->contributions = sp_contributions_create(design->evaluator, design->layout, design->coverage, error);
    return design->contributions != NULL;
}

/* For what reports them: a table on standard output does not, and it takes as long as evaluating the layouts. */
static bool find_contributions(const cli_options *options, background *added, sp_error *error)
{
    bool asked = options->output || options->json, in_time = cli_time_left() >= LATE * added->pictures, whole = true;
    for (size_t i = 0; asked && i < added->design_count; i++) {
        sp_design *design = &added->designs[i];
        if (!design->evaluator)
            continue;
        if (in_time && !find_contributions_of(options, design, error))
            return false;
        whole = whole && design->contributions;
    }
    if (!whole)
        cli_leave_out(&added->left_out, "what each nozzle brings");
    return true;
}

/* What there is no time for, as far as there is a limit; what was left out before comes first. */
static bool fit_into_time(const cli_options *options, sp_result *full, background *added, sp_error *error)
{
    for (size_t i = 0; i < full->left_out_count; i++)
        cli_leave_out(&added->left_out, "%s", full->left_out[i]);
    bool limited = isfinite(cli_time_left()) && options->output;
    return !limited || cli_time_left() <= 0 || sp_report_picture_time(full, &added->pictures, error);
}

/* As a shell reads it back. */
static char *command_line(const cli_options *options)
{
    size_t size = sizeof "sprayplan";
    for (int i = 0; i < options->argument_count; i++)
        size += 4 * strlen(options->arguments[i]) + 3;
    char *text = malloc(size), *at = text;
    if (!text)
        return NULL;
    at += sprintf(at, "sprayplan");
    for (int i = 0; i < options->argument_count; i++) {
        const char *argument = options->arguments[i];
        bool plain = *argument && strspn(argument, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                                                   "-_./,:=+@%") == strlen(argument);
        at += sprintf(at, plain ? " " : " '");
        for (; *argument; argument++)
            at += !plain && *argument == '\'' ? sprintf(at, "'\\''") : sprintf(at, "%c", *argument);
        at += sprintf(at, plain ? "" : "'");
    }
    return text;
}

/* UTC. SOURCE_DATE_EPOCH, as reproducible builds have it, stands for now where it is set. */
static void write_date(char *text, size_t size)
{
    const char *fixed = getenv("SOURCE_DATE_EPOCH");
    time_t now = fixed ? (time_t)strtoll(fixed, NULL, 10) : time(NULL);
    struct tm parts;
    text[0] = 0;
    if (gmtime_r(&now, &parts))
        strftime(text, size, "%Y-%m-%d %H:%M UTC", &parts);
}

/* What the first of the scenes asks for: all pictures of a report compare. */
static sp_picture_style picture_style(const cli_options *options, const sp_scene *const *scenes)
{
    for (int i = 0; i < options->input_count; i++)
        if (scenes[i])
            return sp_scene_picture_style(scenes[i]);
    return (sp_picture_style){0};
}

bool cli_report(const cli_options *options, const sp_result *result, const sp_scene *const *scenes,
                const cli_inputs *inputs, const sp_layout *layout, sp_error *error)
{
    background added = {.design_count = result->design_count,
                        .designs = malloc((result->design_count + 1) * sizeof *added.designs),
                        .command_line = command_line(options)};
    char *written = NULL;
    bool good = (added.designs && added.command_line) || sp_fail_memory(error);
    if (added.designs)
        memcpy(added.designs, result->designs, result->design_count * sizeof *added.designs);
    sp_result full = *result;
    full.designs = added.designs;
    full.style = picture_style(options, scenes);
    good = good && fit_into_time(options, &full, &added, error) && find_contributions(options, &added, error);
    if (good && isfinite(cli_time_left()) && options->output)
        full.picture_share = cli_picture_share(added.pictures, &added.left_out);
    full.left_out = added.left_out.list;
    full.left_out_count = added.left_out.count;
    write_date(added.date, sizeof added.date);
    full.inputs = inputs->list;
    full.input_count = inputs->count;
    full.command_line = added.command_line;
    full.date = added.date;
    good = good && cli_write(options, &full, scenes, layout, &written, error) && cli_print(options, &full, error);
    if (good)
        cli_say_written(options, written);
    free(written);
    background_free(&added);
    return good;
}
