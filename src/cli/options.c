/* Command-line options. Long ones are to be written out: an abbreviation may come to mean something else. */
#include "cli.h"

#include "../scene/edit_distance.h"
#include "rays.h"
#include "topics.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define LEAST_TEXEL 1e-30 /* m: any surface has a number of them */

static bool wrong(const char *option, const char *found, const char *expected)
{
    fprintf(stderr, "sprayplan: %s: found \"%s\", expected %s\n", option, found, expected);
    return false;
}

static bool read_number(const char **text, double *value)
{
    char *end;
    errno = 0;
    *value = strtod(*text, &end);
    if (end == *text || errno == ERANGE || !isfinite(*value))
        return false;
    *text = end;
    return true;
}

static bool parse_threads(const char *text, int *threads)
{
    const char *rest = text;
    double value;
    if (!read_number(&rest, &value) || *rest || value != floor(value) || value < 1 || value > SP_THREADS)
        return wrong("--threads", text, "a whole number from 1 to 1024");
    *threads = (int)value;
    return true;
}

static bool parse_time_limit(const char *text, double *seconds)
{
    const char *rest = text;
    if (!read_number(&rest, seconds) || (*rest && strcmp(rest, "s")) || *seconds <= 0)
        return wrong("--time-limit", text, "seconds above 0");
    return true;
}

static bool parse_memory(const char *text, double *bytes)
{
    static const struct {
        const char *name;
        double bytes;
    } units[] = {{"B", 1},           {"kB", 1e3},           {"MB", 1e6},
                 {"GB", 1e9},        {"TB", 1e12},          {"KiB", 1024.0},
                 {"MiB", 1048576.0}, {"GiB", 1073741824.0}, {"TiB", 1099511627776.0}};
    const char *rest = text;
    double value;
    if (read_number(&rest, &value) && value > 0) {
        rest += strspn(rest, " ");
        for (size_t i = 0; i < sizeof units / sizeof *units; i++)
            if (!strcmp(rest, units[i].name)) {
                *bytes = value * units[i].bytes;
                return true;
            }
    }
    return wrong("--memory", text, "a size above 0 with its unit, as \"2 GB\" or 500MiB");
}

static bool parse_texel(const char *text, double *texel)
{
    sp_error error = {0};
    if (!sp_quantity_parse(text, "m", texel, &error) || *texel < LEAST_TEXEL)
        return wrong("--texel", text, "a length above 0 (1e-30 m at least), as 10mm or 0.01");
    return true;
}

/* As a scene's `unit`. */
static bool parse_unit(const char *text, double *unit)
{
    char one[64];
    sp_error error = {0};
    int length = snprintf(one, sizeof one, "1 %s", text);
    if (!*text || length >= (int)sizeof one || !sp_quantity_parse(one, "m", unit, &error) || *unit <= 0)
        return wrong("--unit", text, "a unit of length such as mm");
    return true;
}

static bool parse_packing(const char *text, sp_packing *packing)
{
    if (strcmp(text, "pixels") && strcmp(text, "skyline"))
        return wrong("--pack", text, "pixels or skyline");
    *packing = strcmp(text, "skyline") ? SP_PACKING_PIXELS : SP_PACKING_SKYLINE;
    return true;
}

static bool read_component(const char **text, double *component)
{
    return read_number(text, component) && fabs(*component) <= CLI_RAYS_LARGEST;
}

static bool parse_gravity(const char *text, sp_vec3 *gravity)
{
    const char *rest = text;
    if (read_component(&rest, &gravity->x) && *rest++ == ',' && read_component(&rest, &gravity->y) && *rest++ == ',' &&
        read_component(&rest, &gravity->z) && !*rest)
        return true;
    return wrong("--gravity", text, "gx,gy,gz in m/s2, up to 1e30 each");
}

static bool parse_accelerator(const char *text, sp_accelerator *accelerator)
{
    static const char *const names[] = {"bvh", "sah", "naive", "none"};
    static const sp_accelerator values[] = {SP_ACCELERATOR_BVH, SP_ACCELERATOR_SAH, SP_ACCELERATOR_NAIVE,
                                            SP_ACCELERATOR_NONE};
    for (int i = 0; i < 4; i++)
        if (!strcmp(text, names[i])) {
            *accelerator = values[i];
            return true;
        }
    return wrong("--accel", text, "bvh, sah, naive or none");
}

static bool parse_override(const char *text, cli_options *options)
{
    if (!strchr(text, '='))
        return wrong("--set", text, "KEY=VALUE");
    if (options->override_count == MAX_OVERRIDES)
        return wrong("--set", text, "at most 64 overrides");
    options->overrides[options->override_count++] = text;
    return true;
}

static bool parse_output(const char *text, const char **output)
{
    *output = text;
    return *text || wrong("-o", text, "a path");
}

static bool parse_repair(const char *text, const char **file)
{
    *file = text;
    return cli_names_obj(text) || wrong("--repair", text, "a file name ending in .obj");
}

/* What the command that takes it reads for itself. */
static bool keep(const char *text, const char **kept)
{
    *kept = text;
    return true;
}

static bool set(bool *flag)
{
    return *flag = true;
}

static bool take_option(cli_option_id option, const char *value, cli_options *options)
{
    switch (option) {
    case CLI_OUTPUT:
        return parse_output(value, &options->output);
    case CLI_JSON:
        return set(&options->json);
    case CLI_THREADS:
        return parse_threads(value, &options->threads);
    case CLI_TIME_LIMIT:
        return parse_time_limit(value, &options->time_limit);
    case CLI_QUIET:
        return set(&options->quiet);
    case CLI_PROVE:
        return set(&options->prove);
    case CLI_NO_LIVE:
        return set(&options->no_live);
    case CLI_FORCE:
        return set(&options->force);
    case CLI_SET:
        return parse_override(value, options);
    case CLI_UNIT:
        return parse_unit(value, &options->unit);
    case CLI_TEXEL:
        return parse_texel(value, &options->texel);
    case CLI_MEMORY:
        return parse_memory(value, &options->memory);
    case CLI_PACK:
        return parse_packing(value, &options->packing);
    case CLI_REUSE:
        return set(&options->reuse);
    case CLI_REPAIR:
        return parse_repair(value, &options->repair);
    case CLI_RAYS:
        return keep(value, &options->rays);
    case CLI_MODE:
        return keep(value, &options->mode);
    case CLI_TRAJECTORY:
        return keep(value, &options->trajectory);
    case CLI_GRAVITY:
        return parse_gravity(value, &options->gravity);
    case CLI_ACCEL:
        return parse_accelerator(value, &options->accelerator);
    case CLI_SCHEMA:
        return set(&options->schema);
    case CLI_HELP_ASKED:
        return set(&options->help);
    case CLI_VERSION:
        return set(&options->version);
    }
    return false;
}

/* What is closest to `text` of `count` names, or begins with it; NULL where none does. */
static const char *closest(const char *text, const char *(*name)(size_t index), size_t count)
{
    const char *found = NULL;
    size_t least = SIZE_MAX, length = strlen(text);
    for (size_t i = 0; i < count; i++) {
        size_t slips = name(i) ? sp_edit_distance(text, name(i)) : SIZE_MAX;
        if (name(i) && length > 1 && !strncmp(text, name(i), length))
            slips = 0;
        if (slips < least) {
            found = name(i);
            least = slips;
        }
    }
    return found;
}

static const char *option_name(size_t index)
{
    return cli_options_known[index].name;
}

static const char *command_name(size_t index)
{
    return cli_commands[index].name;
}

static bool unknown_option(const char *text)
{
    const char *meant = text[1] == '-' ? closest(text + 2, option_name, cli_option_count) : NULL;
    if (meant)
        fprintf(stderr, "sprayplan: unknown option %s; did you mean --%s?\n", text, meant);
    else
        fprintf(stderr, "sprayplan: unknown option %s\n", text);
    return false;
}

/* `what` is unknown, of which `meant` may have been meant; NULL: nothing. */
static void report_unknown(const char *what, const char *text, const char *meant)
{
    if (meant)
        fprintf(stderr, "sprayplan: unknown %s \"%s\"; did you mean %s?\n", what, text, meant);
    else
        fprintf(stderr, "sprayplan: unknown %s \"%s\"; see sprayplan help\n", what, text);
}

/* Commands, then topics. */
static const char *topic_name(size_t index)
{
    return index < CLI_COMMANDS ? command_name(index) : cli_topics[index - CLI_COMMANDS].name;
}

void cli_unknown_topic(const char *text)
{
    size_t count = CLI_COMMANDS;
    while (topic_name(count))
        count++;
    report_unknown("command or topic", text, closest(text, topic_name, count));
}

/* What is called `name`, of `length`, or has this letter; whether the command takes it shows later. NULL for none. */
static const cli_option *long_option(const char *name, size_t length)
{
    for (size_t i = 0; i < cli_option_count; i++) {
        const char *known = cli_options_known[i].name;
        if (known && strlen(known) == length && !strncmp(known, name, length))
            return &cli_options_known[i];
    }
    return NULL;
}

static const cli_option *short_option(char letter)
{
    for (size_t i = 0; i < cli_option_count; i++)
        if (letter && cli_options_known[i].letter == letter)
            return &cli_options_known[i];
    return NULL;
}

typedef struct {
    char **arguments, **end;
    cli_options *options;
    unsigned given; /* 1 << cli_option_id of each option that was */
} reader;

/* `rest`: what stands behind the option in its own argument, NULL for nothing. */
static bool take(reader *reader, const cli_option *option, const char *syntax, const char *rest)
{
    const char *value = rest ? rest : option->value && reader->arguments < reader->end ? *reader->arguments++ : NULL;
    if (option->value && !value) {
        fprintf(stderr, "sprayplan: %s: found nothing behind it, expected %s\n", syntax, option->value);
        return false;
    }
    reader->given |= 1u << option->id;
    return take_option(option->id, value, reader->options);
}

static bool read_long(reader *reader, const char *text)
{
    char syntax[CLI_SYNTAX];
    size_t length = strcspn(text + 2, "=");
    const cli_option *option = long_option(text + 2, length);
    if (!option) {
        snprintf(syntax, sizeof syntax, "%.*s", (int)length + 2, text);
        return unknown_option(syntax);
    }
    snprintf(syntax, sizeof syntax, "--%s", option->name);
    bool valued = text[length + 2] == '=';
    return (valued && !option->value) ? wrong(syntax, text + length + 3, "no value")
                                      : take(reader, option, syntax, valued ? text + length + 3 : NULL);
}

/* Letters may stand together; the last may have its value behind it. */
static bool read_letters(reader *reader, const char *text)
{
    for (const char *at = text + 1; *at; at++) {
        const char syntax[] = {'-', *at, 0};
        const cli_option *option = short_option(*at);
        if (!option)
            return unknown_option(syntax);
        if (option->value)
            return take(reader, option, syntax, at[1] ? at + 1 : NULL);
        if (!take(reader, option, syntax, NULL))
            return false;
    }
    return true;
}

/* The command, wherever it stands among the options, and then what it is to work on. */
static bool read_name(reader *reader, const char *text)
{
    cli_options *options = reader->options;
    if (options->command == CLI_COMMANDS) {
        size_t command = cli_command_named(text);
        options->command = command == SIZE_MAX ? CLI_COMMANDS : (cli_command_id)command;
        if (command == SIZE_MAX)
            report_unknown("command", text, closest(text, command_name, CLI_COMMANDS));
        return command != SIZE_MAX;
    }
    if (options->input_count == CLI_INPUTS_MOST) {
        fprintf(stderr, "sprayplan: found more than %d file names, expected no more\n", CLI_INPUTS_MOST);
        return false;
    }
    options->inputs[options->input_count++] = text;
    return true;
}

static bool read_all(reader *reader)
{
    bool names_only = false, good = true;
    while (good && reader->arguments < reader->end) {
        const char *text = *reader->arguments++;
        if (names_only || text[0] != '-' || !text[1])
            good = read_name(reader, text);
        else if (!strcmp(text, "--"))
            names_only = true;
        else if (text[1] == '-')
            good = read_long(reader, text);
        else
            good = read_letters(reader, text);
    }
    return good;
}

/* Whether the command takes whatever was given. */
static bool takes_all(const reader *reader)
{
    unsigned taken = 0, command = 1u << reader->options->command;
    for (size_t i = 0; i < cli_option_count; i++)
        if (cli_options_known[i].commands & command)
            taken |= 1u << cli_options_known[i].id;
    for (size_t i = 0; i < cli_option_count; i++) {
        const cli_option *option = &cli_options_known[i];
        if (!(reader->given & ~taken & 1u << option->id))
            continue;
        fprintf(stderr, "sprayplan: %s does not take %s%.*s\n", cli_commands[reader->options->command].name,
                option->name ? "--" : "-", option->name ? 64 : 1, option->name ? option->name : &option->letter);
        return false;
    }
    return true;
}

static bool has_inputs(const cli_options *options)
{
    const cli_command *command = &cli_commands[options->command];
    if (options->input_count >= command->least_inputs && options->input_count <= command->most_inputs)
        return true;
    fprintf(stderr, "sprayplan: %s: found %d file names, expected %s\n", command->name, options->input_count,
            command->most_inputs == 1 ? "one" : "two or more");
    return false;
}

bool cli_parse(int count, char **arguments, cli_options *options)
{
    *options = (cli_options){.command = CLI_COMMANDS,
                             .unit = 1,
                             .accelerator = SP_ACCELERATOR_BVH,
                             .arguments = arguments,
                             .argument_count = count};
    reader reader = {arguments, arguments + count, options, 0};
    if (!read_all(&reader))
        return false;
    if (options->help || options->version)
        return true;
    if (options->command == CLI_COMMANDS) {
        fprintf(stderr, "sprayplan: found no command\n");
        return false;
    }
    return takes_all(&reader) && has_inputs(options) && cli_reads_once(options);
}
