/* What check mends: an OBJ file for each geometry file of the scene, in m, placed as the scene places it. */
#ifndef CLI_REPAIR_H
#define CLI_REPAIR_H

#include "../cli.h"

#include <jansson.h>

typedef struct {
    uint32_t geometry; /* which of the scene */
    char *path;        /* owned */
    sp_repair_account account;
    size_t first_part, part_count; /* of the scene's mesh, in this file */
    double *part_area;             /* [2 part_count], m², owned: of each part before, then after */
} cli_mended;

typedef struct {
    size_t count;
    cli_mended *files; /* [count], in the order of the scene's geometry */
} cli_repair;

/* Writes where --repair says: OUT.obj, or OUT-0.obj, OUT-1.obj, .. where there are several. All appear or none, and no
 * file that was read is replaced. Without --repair there are no files. */
bool cli_repair_write(const cli_options *options, const sp_scene *scene, cli_repair *repair, sp_error *error);
/* Accepts what was never written, if it is all zeros. */
void cli_repair_clear(cli_repair *repair);

/* `setup` is of the scene that was mended. */
void cli_repair_print(const cli_repair *repair, const sp_setup *setup);
/* null without --repair. */
json_t *cli_repair_json(const cli_repair *repair, const sp_setup *setup);

#endif
