/* Boxes around the parts of a mesh: how far something reaches along the axes, m. */
#ifndef CLI_BOXES_H
#define CLI_BOXES_H

#include <sprayplan/mesh.h>

typedef struct {
    sp_vec3 minimum, maximum;
} cli_box;
cli_box *cli_part_boxes(const sp_mesh *mesh); /* [part_count], malloc'd; NULL where memory ran out;
                                               * of a part without triangles from infinity to -infinity */
cli_box cli_box_join(cli_box a, cli_box b);
double cli_box_size(cli_box box); /* its longest edge */
double cli_box_step(cli_box box); /* m, what matters of places in it */

#endif
