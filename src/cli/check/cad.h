/* What check tells of CAD files. */
#ifndef CLI_CAD_H
#define CLI_CAD_H

#include <sprayplan/sprayplan.h>

#include <jansson.h>

/* How each was cut. */
void cli_cad_print(const sp_scene *scene, const sp_mesh *mesh);
json_t *cli_cad_json(const sp_scene *scene, const sp_mesh *mesh);
/* Volumes of the bodies beside those of their triangles (m³, [part_count], 0 of what is not closed). */
void cli_cad_print_volumes(const sp_mesh *mesh, const double *volumes);

#endif
