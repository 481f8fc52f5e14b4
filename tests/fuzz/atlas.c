/* OBJ files that hold an atlas, as atlas --reuse reads them. */
#include "atlas/reuse.h"
#include "mesh.h"

#include <math.h>

#define MOST_TEXELS 4096.0 /* more would take time, and show nothing new */

bool target_accepted;

static sp_mesh *read_surface(const char *text, size_t size)
{
    sp_error error = {0};
    sp_soup soup = {0};
    bool good = sp_obj_read("strange", text, size, 1, &soup, &error) && soup.triangle_count > 0;
    sp_mesh *mesh = good ? weld_soup(&soup) : NULL;
    sp_soup_clear(&soup);
    return mesh;
}

/* The file's own texel where that is not too small, else one that is asked for. */
static double texel_to_ask(const sp_mesh *mesh, const char *text)
{
    double page_edge, texel, area = sp_mesh_area(mesh);
    if (sscanf(text, SP_ATLAS_MARK "%lf %lf", &page_edge, &texel) == 2 && area <= MOST_TEXELS * texel * texel &&
        page_edge >= 1 && page_edge <= MOST_TEXELS && page_edge == floor(page_edge))
        return 0;
    return sqrt(area / 100);
}

static void require_sound(const sp_atlas *atlas, const sp_mesh *mesh)
{
    REQUIRE(atlas->triangle_count == mesh->triangle_count && atlas->page_edge > 0 && atlas->texel > 0);
    REQUIRE(atlas->chart_count > 0 && atlas->page_count > 0 && atlas->page_count <= atlas->chart_count);
    for (size_t t = 0; t < atlas->triangle_count; t++) {
        REQUIRE(atlas->chart[t] < atlas->chart_count && atlas->chart_page[atlas->chart[t]] < atlas->page_count);
        for (int i = 0; i < 3; i++)
            for (int k = 0; k < 2; k++)
                REQUIRE(atlas->uv[t][i][k] >= 0 && atlas->uv[t][i][k] < atlas->page_edge);
    }
}

/* What is written and read is the same, and is written the same again. */
static void require_written(const sp_atlas *atlas, const sp_mesh *mesh)
{
    sp_error error = {0};
    char *text = sp_atlas_obj(atlas, mesh, &error);
    REQUIRE(text);
    sp_mesh *surface = read_surface(text, strlen(text));
    REQUIRE(surface && surface->triangle_count == mesh->triangle_count);
    sp_atlas *again = sp_atlas_read(surface, "again", text, strlen(text), 0, &error);
    if (!again)
        fprintf(stderr, "%s in\n%s", error.message, text);
    REQUIRE(again && again->chart_count == atlas->chart_count && again->texel_count == atlas->texel_count);
    char *text_again = sp_atlas_obj(again, surface, &error);
    REQUIRE(text_again && strcmp(text, text_again) == 0);
    free(text_again);
    free(text);
    sp_atlas_destroy(again);
    sp_mesh_destroy(surface);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    sp_error error = {0};
    meter_start();
    char *text = target_text(data, size);
    sp_mesh *mesh = read_surface(text, size);
    target_accepted = false;
    if (mesh && mesh->triangle_count) {
        sp_atlas *atlas = sp_atlas_read(mesh, "strange", text, size, texel_to_ask(mesh, text), &error);
        require_frugal(size);
        target_accepted = atlas != NULL;
        REQUIRE(target_accepted == (error.kind == SP_OK));
        if (atlas) {
            require_sound(atlas, mesh);
            require_written(atlas, mesh);
        } else {
            require_located(&error, "strange", data, size);
        }
        sp_atlas_destroy(atlas);
    }
    sp_mesh_destroy(mesh);
    free(text);
    return 0;
}
