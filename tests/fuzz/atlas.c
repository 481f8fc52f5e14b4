/* OBJ files that hold an atlas, as atlas --reuse reads them. */
#include "atlas/reuse.h"
#include "mesh.h"

#include <math.h>

#define MOST_TEXELS 1024.0 /* more would take time, and show nothing new */
#define MOST_EDGE 96.0     /* of a page in texels: the same */

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

/* Metres of a page's edge, where the file doesn't say it those that keep the area. */
static double page_length(const sp_unfolding *unfolding, const sp_mesh *mesh)
{
    double flat = 0;
    for (size_t t = 0; t < unfolding->triangle_count; t++) {
        const double(*uv)[2] = unfolding->uv[t];
        flat +=
            0.5 * fabs((uv[1][0] - uv[0][0]) * (uv[2][1] - uv[0][1]) - (uv[1][1] - uv[0][1]) * (uv[2][0] - uv[0][0]));
    }
    double length = unfolding->page_edge * unfolding->texel;
    return length > 0 && isfinite(length) ? length : sqrt(sp_mesh_area(mesh) / flat);
}

/* The file's own texel where neither surface nor page has too many of it. */
static double texel_to_ask(const sp_unfolding *unfolding, const sp_mesh *mesh)
{
    double area = sp_mesh_area(mesh), edge = unfolding->page_edge;
    if (edge >= 1 && edge <= MOST_EDGE && edge == floor(edge) && unfolding->texel > 0 && isfinite(unfolding->texel) &&
        area <= MOST_TEXELS * unfolding->texel * unfolding->texel)
        return 0;
    double least = page_length(unfolding, mesh) / MOST_EDGE;
    return fmax(sqrt(area / 100), isfinite(least) ? least : 0);
}

/* `own`: at the file's own texel. */
static sp_atlas *read_atlas(const sp_mesh *mesh, const char *name, const char *text, size_t size, bool own,
                            sp_error *error)
{
    sp_unfolding *unfolding = sp_unfolding_parse(name, text, size, 1, error);
    const sp_unfolding *files[] = {unfolding};
    sp_atlas *atlas =
        unfolding ? sp_atlas_of_files(mesh, files, 1, own ? 0 : texel_to_ask(unfolding, mesh), error) : NULL;
    sp_unfolding_destroy(unfolding);
    return atlas;
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
    sp_atlas *again = read_atlas(surface, "again", text, strlen(text), true, &error);
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
        sp_atlas *atlas = read_atlas(mesh, "strange", text, size, false, &error);
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
