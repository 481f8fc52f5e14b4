#include "cad.h"

#include "../amounts.h"

#include <math.h>
#include <stdio.h>

/* How many geometry entries there are, each with a part at least. */
static uint32_t entries(const sp_mesh *mesh)
{
    return mesh->part_count ? mesh->parts[mesh->part_count - 1].geometry + 1 : 0;
}

void cli_cad_print(const sp_scene *scene, const sp_mesh *mesh)
{
    for (uint32_t i = 0; i < entries(mesh); i++) {
        const sp_cad_account *cad = sp_scene_cad(scene, i);
        if (!cad)
            continue;
        printf("CAD         file %lu: chord %.4g mm, angle %.4g deg, %zu triangles", (unsigned long)i, 1e3 * cad->chord,
               cad->angle * 180 / M_PI, cad->triangles);
        if (cad->mended)
            printf("; %zu without area mended", cad->mended);
        if (cad->sewn)
            printf("; %zu loose faces sewn within %.2g mm", cad->sewn, 1e3 * cad->sewing);
        printf("\n");
    }
}

json_t *cli_cad_json(const sp_scene *scene, const sp_mesh *mesh)
{
    json_t *list = json_array();
    for (uint32_t i = 0; i < entries(mesh); i++) {
        const sp_cad_account *cad = sp_scene_cad(scene, i);
        if (cad)
            json_array_append_new(list, json_pack("{s:I, s:f, s:f, s:I, s:I, s:I, s:f, s:I}", "geometry", (json_int_t)i,
                                                  "chord_m", cad->chord, "angle_rad", cad->angle, "triangles",
                                                  (json_int_t)cad->triangles, "mended_triangles",
                                                  (json_int_t)cad->mended, "sewn_faces", (json_int_t)cad->sewn,
                                                  "sewing_m", cad->sewing, "faults", (json_int_t)cad->faults));
    }
    return list;
}

/* m³, with the digits that tell a body's: eight decimals, of small ones more, of large ones no more than nine digits.
 */
static void volume_text(double volume, double body, char text[CLI_AMOUNT])
{
    enum { DECIMALS = 8, LEAST_DIGITS = 3 };
    int whole_digits = (int)fmax(log10(fabs(body)), 0);
    cli_amount_text(volume, body, whole_digits < DECIMALS ? DECIMALS - whole_digits : 0, LEAST_DIGITS, text);
}

void cli_cad_print_volumes(const sp_mesh *mesh, const double *volumes)
{
    bool any = false;
    for (size_t i = 0; i < mesh->part_count; i++) {
        double body = mesh->parts[i].volume, own = volumes[i];
        if (!(fabs(body) > 0))
            continue;
        if (!any)
            printf("\n%-8s %-24s %14s %14s %8s\n", "geometry", "body", "volume m3", "triangles m3", "off %");
        any = true;
        char text[CLI_AMOUNT];
        volume_text(body, body, text);
        printf("%-8lu %-24s %14s ", (unsigned long)mesh->parts[i].geometry, mesh->parts[i].name, text);
        volume_text(own, body, text);
        if (fabs(own) > 0)
            printf("%14s %8.3f\n", text, 100 * (own / body - 1));
        else
            printf("%14s\n", "not closed");
    }
}
