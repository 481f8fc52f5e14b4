/* How large each geometry file of a scene is, and which unit of length would make it as large as vessels are. */
#ifndef CLI_SIZE_H
#define CLI_SIZE_H

#include "boxes.h"

#include <sprayplan/scene.h>

#include <jansson.h>
#include <stdbool.h>
#include <stddef.h>

#define CLI_UNITS 5
typedef struct {
    sp_vec3 extent; /* m */
    double unit;    /* m, as the scene has it; 0: the file knows its own */
    bool plausible;
    size_t count;
    const char *name[CLI_UNITS]; /* [count] units other than that, the likeliest first; none where it is plausible */
    sp_vec3 in_unit[CLI_UNITS];  /* [count], m: the extent that it would have */
} cli_size;

cli_size cli_size_of(cli_box box, double unit);
/* Of each geometry file of a scene, by the boxes of its parts: [*count], malloc'd; NULL where memory runs out. */
cli_size *cli_sizes_of(const sp_scene *scene, const cli_box *part_box, size_t *count, sp_error *error);
/* An error about the texel may come of a wrong unit: then the question stands behind it. */
void cli_size_ask_after(const sp_scene *scene, sp_error *error);
/* A question for who wrote the scene. */
void cli_size_ask(const cli_size *size, unsigned long geometry, char *text, size_t length);
json_t *cli_size_json(const cli_size *size);

#endif
