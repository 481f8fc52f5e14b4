/* CAD files: what sprayplan-cad is asked, and a mesh of what it sends. */
#include <sprayplan/cad.h>

#include "mesh/cad/mend.h"
#include "mesh/cad/process.h"
#include "mesh/locales.h"
#include "module/module.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

#define MM 1e-3 /* m: the lengths of OpenCASCADE, whatever the file's */
/* What the program may take: so much, and so much more for a byte of the file. */
#define MEMORY 2e9
#define MEMORY_PER_BYTE 200.0
#define SECONDS 40.0
#define SECONDS_PER_BYTE 40e-6
#define LOAD 10.0 /* wall time in that processor time, on a busy machine */

static const char *const kinds[] = {[SP_CAD_STEP] = "step", [SP_CAD_IGES] = "iges", [SP_CAD_BREP] = "brep"};

sp_cad_kind sp_cad_kind_of(const char *path)
{
    static const struct {
        const char *extension;
        sp_cad_kind kind;
    } known[] = {{".step", SP_CAD_STEP}, {".stp", SP_CAD_STEP},  {".iges", SP_CAD_IGES},
                 {".igs", SP_CAD_IGES},  {".brep", SP_CAD_BREP}, {".brp", SP_CAD_BREP}};
    const char *dot = strrchr(path, '.');
    for (size_t i = 0; dot && i < sizeof known / sizeof *known; i++)
        if (strcasecmp(dot, known[i].extension) == 0)
            return known[i].kind;
    return SP_CAD_NONE;
}

sp_cad_options sp_cad_options_default(void)
{
    return (sp_cad_options){.angle = 10 * M_PI / 180};
}

/* Numbers for the command line, whatever this program's language. */
typedef struct {
    char unit[40], chord[40], most[40], angle[40], bytes[40], seconds[40];
} texts;

static bool write_numbers(texts *numbers, double unit, const sp_cad_options *options, double size, sp_error *error)
{
    locale_t c = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    if (c == (locale_t)0)
        return sp_fail_memory(error);
    locale_t before = uselocale(c);
    snprintf(numbers->unit, sizeof numbers->unit, "%.17g", unit);
    snprintf(numbers->chord, sizeof numbers->chord, "%.17g", options->chord);
    snprintf(numbers->most, sizeof numbers->most, "%.17g", options->chord_most);
    snprintf(numbers->angle, sizeof numbers->angle, "%.17g", options->angle);
    snprintf(numbers->bytes, sizeof numbers->bytes, "%.17g", MEMORY + MEMORY_PER_BYTE * size);
    snprintf(numbers->seconds, sizeof numbers->seconds, "%.0f", SECONDS + SECONDS_PER_BYTE * size);
    uselocale(before);
    freelocale(c);
    return true;
}

static bool find_program(const char *path, char *program, size_t size, sp_error *error)
{
    return sp_module_program("sprayplan-cad", program, size) ||
           sp_fail(
               error, SP_ERROR_FILE, path, 0, 0,
               "cannot be read: the program sprayplan-cad, which reads STEP, IGES and BREP, is not installed; it is "
               "sprayplan's component `cad`, built where OpenCASCADE is (Debian: libocct-data-exchange-dev)");
}

static bool run(const char *path, double size, double unit, const sp_cad_options *options, sp_cad_stream *stream,
                sp_error *error)
{
    char program[4096];
    texts numbers;
    if (!find_program(path, program, sizeof program, error) || !write_numbers(&numbers, unit, options, size, error))
        return false;
    char *const arguments[] = {program,         (char *)kinds[sp_cad_kind_of(path)],
                               (char *)path,    numbers.unit,
                               numbers.chord,   numbers.most,
                               numbers.angle,   numbers.bytes,
                               numbers.seconds, NULL};
    return sp_cad_process_run(arguments, LOAD * (SECONDS + SECONDS_PER_BYTE * size), stream, &options->run, error);
}

static bool check(const char *path, double unit, const sp_cad_options *options, double *size, sp_error *error)
{
    struct stat status;
    sp_cad_kind kind = sp_cad_kind_of(path);
    if (kind == SP_CAD_NONE)
        return sp_fail(error, SP_ERROR_INPUT, path, 0, 0,
                       "found a file of unknown kind, expected .step, .stp, .iges, .igs, .brep or .brp");
    if (!(unit > 0 && isfinite(unit)) || (kind != SP_CAD_BREP && fabs(unit - 1) > 0))
        return sp_fail(error, SP_ERROR_ARGUMENT, path, 0, 0,
                       "found a unit of %g m, expected a positive one, and 1 for a file that knows its own", unit);
    if (!(options->chord >= 0 && isfinite(options->chord) && options->chord_most >= 0 && options->angle > 0 &&
          options->angle <= M_PI))
        return sp_fail(error, SP_ERROR_ARGUMENT, path, 0, 0,
                       "found a chord of %g m and an angle of %g rad, expected 0 or more, and above 0 to pi",
                       options->chord, options->angle);
    if (stat(path, &status) != 0 || access(path, R_OK) != 0)
        return sp_fail(error, SP_ERROR_INPUT, path, 0, 0, "cannot be opened: %s", strerror(errno));
    if (!S_ISREG(status.st_mode))
        return sp_fail(error, SP_ERROR_INPUT, path, 0, 0, "found no regular file, expected one");
    *size = (double)status.st_size;
    return true;
}

static sp_mesh *make_mesh(const char *path, const sp_cad_stream *stream, sp_cad_account *account, sp_error *error)
{
    sp_soup *soup = stream->soup;
    *account = (sp_cad_account){.chord = stream->fineness.chord,
                                .angle = stream->fineness.angle,
                                .triangles = soup->triangle_count,
                                .sewn = (size_t)stream->fineness.sewn,
                                .sewing = stream->fineness.sewing,
                                .faults = (size_t)stream->faults};
    memcpy(account->fault, stream->fault, sizeof account->fault);
    if (soup->triangle_count == 0) {
        sp_fail(error, SP_ERROR_INPUT, path, 0, 0, "found no surface, expected some%s%s", stream->faults ? "; " : "",
                stream->fault);
        return NULL;
    }
    sp_mesh *mesh = sp_cad_mend(sp_soup_mesh(soup, error), &account->mended, error);
    for (size_t i = 0; mesh && i < mesh->part_count; i++)
        mesh->parts[i].volume = stream->volumes[i];
    if (!mesh || mesh->triangle_count > 0)
        return mesh;
    sp_fail(error, SP_ERROR_INPUT, path, 0, 0, "found only triangles without area, expected at least one with some");
    sp_mesh_destroy(mesh);
    return NULL;
}

sp_mesh *sp_cad_load(const char *path, double unit, const sp_cad_options *options, sp_cad_account *account,
                     sp_error *error)
{
    if (!path || !options)
        return NULL;
    double size = 0;
    sp_cad_account own;
    if (!check(path, unit, options, &size, error))
        return NULL;
    sp_soup soup = {0};
    sp_cad_stream stream = sp_cad_stream_open(path, &soup);
    bool good = run(path, size, sp_cad_kind_of(path) == SP_CAD_BREP ? unit : MM, options, &stream, error);
    sp_mesh *mesh = good ? make_mesh(path, &stream, account ? account : &own, error) : NULL;
    sp_cad_stream_clear(&stream);
    sp_soup_clear(&soup);
    return mesh;
}
