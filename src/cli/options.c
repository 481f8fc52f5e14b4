/* Command-line options. */
#include "cli.h"

#include <errno.h>
#include <getopt.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    JSON = 256,
    THREADS,
    TIME_LIMIT,
    QUIET,
    HELP,
    VERSION,
    SET,
    TEXEL,
    RAYS,
    GRAVITY,
    ACCEL,
    MODE,
    TRAJECTORY,
    MEMORY,
    PROVE,
    PACK,
    REUSE,
    REPAIR,
    NO_LIVE
};

static const struct option long_options[] = {
    {"json", no_argument, NULL, JSON},
    {"threads", required_argument, NULL, THREADS},
    {"time-limit", required_argument, NULL, TIME_LIMIT},
    {"quiet", no_argument, NULL, QUIET},
    {"help", no_argument, NULL, HELP},
    {"version", no_argument, NULL, VERSION},
    {"set", required_argument, NULL, SET},
    {"texel", required_argument, NULL, TEXEL},
    {"pack", required_argument, NULL, PACK},
    {"reuse", no_argument, NULL, REUSE},
    {"repair", required_argument, NULL, REPAIR},
    {"no-live", no_argument, NULL, NO_LIVE},
    {"rays", required_argument, NULL, RAYS},
    {"gravity", required_argument, NULL, GRAVITY},
    {"accel", required_argument, NULL, ACCEL},
    {"mode", required_argument, NULL, MODE},
    {"trajectory", required_argument, NULL, TRAJECTORY},
    {"memory", required_argument, NULL, MEMORY},
    {"prove", no_argument, NULL, PROVE},
    {NULL, 0, NULL, 0},
};

/* Which flags of cli_command.options an option belongs to; 0: every command has it. */
static unsigned flag_of(int option)
{
    switch (option) {
    case 'o':
        return OPTION_OUTPUT;
    case SET:
        return OPTION_SET;
    case TIME_LIMIT:
        return OPTION_TIME_LIMIT;
    case TEXEL:
    case PACK:
    case REUSE:
        return OPTION_ATLAS;
    case MEMORY:
        return OPTION_MEMORY;
    case PROVE:
        return OPTION_PROVE;
    case NO_LIVE:
        return OPTION_NO_LIVE;
    case REPAIR:
        return OPTION_REPAIR;
    case RAYS:
        return OPTION_RAYS | OPTION_BENCH;
    case MODE:
    case TRAJECTORY:
        return OPTION_BENCH;
    case GRAVITY:
    case ACCEL:
        return OPTION_RAYS;
    default:
        return 0;
    }
}

static const char *name_of(int option)
{
    static const char *const names[] = {[SET - JSON] = "--set",         [TIME_LIMIT - JSON] = "--time-limit",
                                        [TEXEL - JSON] = "--texel",     [PACK - JSON] = "--pack",
                                        [REUSE - JSON] = "--reuse",     [RAYS - JSON] = "--rays",
                                        [GRAVITY - JSON] = "--gravity", [ACCEL - JSON] = "--accel",
                                        [MODE - JSON] = "--mode",       [TRAJECTORY - JSON] = "--trajectory",
                                        [MEMORY - JSON] = "--memory",   [PROVE - JSON] = "--prove",
                                        [REPAIR - JSON] = "--repair",   [NO_LIVE - JSON] = "--no-live"};
    return option == 'o' ? "-o" : names[option - JSON];
}

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
    if (!read_number(&rest, &value) || *rest || value != floor(value) || value < 1 || value > 1024)
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
    if (!sp_quantity_parse(text, "m", texel, &error) || *texel <= 0)
        return wrong("--texel", text, "a length above 0, as 10mm or 0.01");
    return true;
}

static bool parse_packing(const char *text, sp_packing *packing)
{
    if (strcmp(text, "pixels") && strcmp(text, "skyline"))
        return wrong("--pack", text, "pixels or skyline");
    *packing = strcmp(text, "skyline") ? SP_PACKING_PIXELS : SP_PACKING_SKYLINE;
    return true;
}

static bool parse_gravity(const char *text, sp_vec3 *gravity)
{
    const char *rest = text;
    if (read_number(&rest, &gravity->x) && *rest++ == ',' && read_number(&rest, &gravity->y) && *rest++ == ',' &&
        read_number(&rest, &gravity->z) && !*rest)
        return true;
    return wrong("--gravity", text, "gx,gy,gz in m/s2");
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

static bool take_option(int option, const char *value, cli_options *options, bool *help)
{
    switch (option) {
    case 'o':
        options->output = value;
        return *value || wrong("-o", value, "a path");
    case JSON:
        options->json = true;
        return true;
    case THREADS:
        return parse_threads(value, &options->threads);
    case TIME_LIMIT:
        return parse_time_limit(value, &options->time_limit);
    case QUIET:
        options->quiet = true;
        return true;
    case PROVE:
        options->prove = true;
        return true;
    case NO_LIVE:
        options->no_live = true;
        return true;
    case SET:
        return parse_override(value, options);
    case TEXEL:
        return parse_texel(value, &options->texel);
    case MEMORY:
        return parse_memory(value, &options->memory);
    case PACK:
        return parse_packing(value, &options->packing);
    case REUSE:
        options->reuse = true;
        return true;
    case REPAIR:
        options->repair = value;
        return cli_names_obj(value) || wrong("--repair", value, "a file name ending in .obj");
    case RAYS:
        options->rays = value;
        return true;
    case MODE:
        options->mode = value;
        return true;
    case TRAJECTORY:
        options->trajectory = value;
        return true;
    case GRAVITY:
        return parse_gravity(value, &options->gravity);
    case ACCEL:
        return parse_accelerator(value, &options->accelerator);
    case HELP:
        *help = true;
        return true;
    case VERSION:
        options->version = true;
        return true;
    default:
        return false;
    }
}

bool cli_parse(const cli_command *command, int count, char **arguments, cli_options *options, bool *help)
{
    *options = (cli_options){.accelerator = SP_ACCELERATOR_BVH, .arguments = arguments, .argument_count = count};
    int option;
    while ((option = getopt_long(count, arguments, "o:h", long_options, NULL)) != -1) {
        unsigned flag = flag_of(option);
        if (flag && !(command->options & flag)) {
            fprintf(stderr, "sprayplan: %s does not take %s\n", command->name, name_of(option));
            return false;
        }
        if (option == '?' || !take_option(option == 'h' ? HELP : option, optarg, options, help))
            return false;
    }
    options->inputs = (const char *const *)(arguments + optind);
    options->input_count = count - optind;
    if (*help || options->version)
        return true;
    if (options->input_count < command->least_inputs || options->input_count > command->most_inputs) {
        fprintf(stderr, "sprayplan: %s: found %d file names, expected %s\n", command->name, options->input_count,
                command->most_inputs == 1 ? "one" : "two or more");
        return false;
    }
    return true;
}
