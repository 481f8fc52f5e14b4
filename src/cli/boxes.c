#include "boxes.h"

#include <stdlib.h>

cli_box cli_box_join(cli_box a, cli_box b)
{
    sp_vec3 p = a.minimum, q = b.minimum, r = a.maximum, s = b.maximum;
    return (cli_box){sp_v(fmin(p.x, q.x), fmin(p.y, q.y), fmin(p.z, q.z)),
                     sp_v(fmax(r.x, s.x), fmax(r.y, s.y), fmax(r.z, s.z))};
}

double cli_box_size(cli_box box)
{
    sp_vec3 edge = sp_sub(box.maximum, box.minimum);
    return fmax(edge.x, fmax(edge.y, edge.z));
}

double cli_box_step(cli_box box)
{
    return 1e-6 * cli_box_size(box);
}

cli_box *cli_part_boxes(const sp_mesh *mesh)
{
    cli_box *boxes = malloc((mesh->part_count + 1) * sizeof *boxes);
    for (size_t i = 0; boxes && i < mesh->part_count; i++)
        boxes[i] = (cli_box){sp_v(INFINITY, INFINITY, INFINITY), sp_v(-INFINITY, -INFINITY, -INFINITY)};
    for (size_t i = 0; boxes && i < mesh->triangle_count; i++)
        for (int corner = 0; corner < 3; corner++) {
            sp_vec3 p = mesh->vertices[mesh->triangles[i][corner]];
            boxes[mesh->part[i]] = cli_box_join(boxes[mesh->part[i]], (cli_box){p, p});
        }
    return boxes;
}
