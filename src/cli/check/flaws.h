/* What check tells of a mesh's flaws, and where they are. */
#ifndef CLI_FLAWS_H
#define CLI_FLAWS_H

#include <sprayplan/sprayplan.h>

#include <jansson.h>

/* Places in the coordinates of the scene's file. */
void cli_flaws_outside(const sp_setup *setup, sp_mesh_diagnosis *mesh);
/* Those that there are; false where there are none. */
bool cli_flaws_print(const sp_mesh_diagnosis *mesh);
/* Those that there were or are, before and after something. */
void cli_flaws_print_change(const sp_mesh_diagnosis *before, const sp_mesh_diagnosis *after);
json_t *cli_flaws_json(const sp_mesh_diagnosis *mesh);

#endif
