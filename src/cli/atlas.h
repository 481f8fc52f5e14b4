/* The texture atlas as the commands atlas and bench build and print it. */
#ifndef CLI_ATLAS_H
#define CLI_ATLAS_H

#include "cli.h"

#include <jansson.h>

typedef struct {
    sp_mesh *mesh; /* borrowed */
    sp_charts *charts;
    sp_atlas *atlas;
    sp_atlas_figures figures;
    cli_clock clock;   /* of its stages */
    size_t peak_bytes; /* on the heap, beyond the mesh */
} cli_atlas_work;

/* `texel` in m; 0: √(area/2²⁰), or what fits the longest edge on a page. Starts as {0}; to be cleared in any case. Of
 * the options it takes whether progress is reported: of the stages charts, texels and figures. */
bool cli_atlas_build(const cli_options *options, cli_atlas_work *work, sp_mesh *mesh, double texel, sp_packing packing,
                     sp_error *error);
/* The same with the texture coordinates of the mesh's own file, in the stages reuse and figures. */
bool cli_atlas_reuse(const cli_options *options, cli_atlas_work *work, sp_mesh *mesh, sp_error *error);
void cli_atlas_clear(cli_atlas_work *work);
/* Wall time of all stages, s. */
double cli_atlas_seconds(const cli_atlas_work *work);
/* The table that `atlas` prints. */
void cli_atlas_print(const cli_atlas_work *work);
/* The object that `atlas --json` prints; NULL when memory runs out. */
json_t *cli_atlas_json(const cli_atlas_work *work);

#endif
