#include "size.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* m, the longest edge of a file's box: vessels, machines and what stands in them lie between. */
#define SMALLEST 0.01
#define LARGEST 50.0
/* What another unit has to make of it to be named: no nozzle, but a vessel. */
#define SMALLEST_VESSEL 0.05
#define USUAL 2.0

static const struct {
    const char *name;
    double metres;
} units[CLI_UNITS] = {{"mm", 1e-3}, {"cm", 1e-2}, {"inch", 0.0254}, {"ft", 0.3048}, {"m", 1}};

static double longest(sp_vec3 extent)
{
    return fmax(extent.x, fmax(extent.y, extent.z));
}

/* How many times too large or too small. */
static double oddness(sp_vec3 extent)
{
    return fabs(log(longest(extent) / USUAL));
}

/* Those that are less odd come first. */
static void put(cli_size *size, const char *name, sp_vec3 extent)
{
    size_t at = size->count++;
    for (; at > 0 && oddness(size->in_unit[at - 1]) > oddness(extent); at--) {
        size->name[at] = size->name[at - 1];
        size->in_unit[at] = size->in_unit[at - 1];
    }
    size->name[at] = name;
    size->in_unit[at] = extent;
}

cli_size cli_size_of(cli_box box, double unit)
{
    cli_size size = {.extent = sp_sub(box.maximum, box.minimum), .unit = unit};
    size.plausible = longest(size.extent) >= SMALLEST && longest(size.extent) <= LARGEST;
    for (size_t i = 0; !size.plausible && unit > 0 && i < CLI_UNITS; i++) {
        sp_vec3 extent = sp_scale(size.extent, units[i].metres / unit);
        if (fabs(units[i].metres / unit - 1) > 1e-6 && longest(extent) >= SMALLEST_VESSEL && longest(extent) <= LARGEST)
            put(&size, units[i].name, extent);
    }
    return size;
}

cli_size *cli_sizes_of(const sp_scene *scene, const cli_box *part_box, size_t *count, sp_error *error)
{
    const sp_mesh *mesh = sp_scene_setup(scene)->mesh;
    cli_size *sizes = calloc(mesh->part_count + 1, sizeof *sizes);
    *count = 0;
    if (!sizes) {
        sp_fail_memory(error);
        return NULL;
    }
    for (size_t i = 0; i < mesh->part_count;) {
        uint32_t geometry = mesh->parts[i].geometry;
        cli_box box = part_box[i];
        for (; i < mesh->part_count && mesh->parts[i].geometry == geometry; i++)
            box = cli_box_join(box, part_box[i]);
        sizes[(*count)++] = cli_size_of(box, sp_scene_file_unit(scene, geometry));
    }
    return sizes;
}

void cli_size_ask_after(const sp_scene *scene, sp_error *error)
{
    if (error->kind != SP_ERROR_INPUT || strncmp(error->message, "texel: ", strlen("texel: ")) != 0)
        return;
    size_t count = 0;
    cli_box *boxes = cli_part_boxes(sp_scene_setup(scene)->mesh);
    cli_size *sizes = boxes ? cli_sizes_of(scene, boxes, &count, NULL) : NULL;
    for (size_t i = 0; i < count; i++) {
        size_t used = strlen(error->message);
        if (sizes[i].plausible || used + 2 >= sizeof error->message)
            continue;
        strcpy(error->message + used, "; ");
        cli_size_ask(&sizes[i], i, error->message + used + 2, sizeof error->message - used - 2);
    }
    free(sizes);
    free(boxes);
}

void cli_size_ask(const cli_size *size, unsigned long geometry, char *text, size_t length)
{
    size_t used = (size_t)snprintf(text, length, "geometry: file %lu is %.4g m x %.4g m x %.4g m: is %s", geometry,
                                   size->extent.x, size->extent.y, size->extent.z,
                                   size->count        ? "the unit "
                                   : (size->unit > 0) ? "`unit` the unit of its coordinates?"
                                                      : "the unit right that it states?");
    for (size_t i = 0; i < size->count && used < length; i++)
        used += (size_t)snprintf(text + used, length - used, "%s%s (%.3g m x %.3g m x %.3g m)%s",
                                 !i                     ? ""
                                 : i + 1 == size->count ? " or "
                                                        : ", ",
                                 size->name[i], size->in_unit[i].x, size->in_unit[i].y, size->in_unit[i].z,
                                 i + 1 == size->count ? "?" : "");
}

json_t *cli_size_json(const cli_size *size)
{
    json_t *likelier = json_array();
    for (size_t i = 0; i < size->count; i++)
        json_array_append_new(likelier, json_pack("{s:s, s:[fff]}", "unit", size->name[i], "extent_m",
                                                  size->in_unit[i].x, size->in_unit[i].y, size->in_unit[i].z));
    return json_pack("{s:[fff], s:o, s:b, s:o}", "extent_m", size->extent.x, size->extent.y, size->extent.z, "unit_m",
                     size->unit > 0 ? json_real(size->unit) : json_null(), "plausible", (int)size->plausible,
                     "likelier_units", likelier);
}
