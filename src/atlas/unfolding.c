/* What files say of how their triangles are laid flat. */
#include "atlas/reuse.h"
#include "mesh/file.h"
#include "mesh/texture.h"

#include <locale.h>
#include <stdlib.h>
#include <string.h>

/* What sp_atlas_obj noted in the file's first line; whether it is sound is found later. */
static void read_mark(sp_unfolding *unfolding, const char *text, double unit)
{
    char *end;
    if (strncmp(text, SP_ATLAS_MARK, sizeof SP_ATLAS_MARK - 1) != 0)
        return;
    unfolding->page_edge = strtod(text + sizeof SP_ATLAS_MARK - 1, &end);
    unfolding->texel = strtod(end, &end) * unit;
}

sp_unfolding *sp_unfolding_parse(const char *path, const char *text, size_t size, double unit, sp_error *error)
{
    sp_texture texture;
    if (!sp_texture_read(path, text, size, &texture, error))
        return NULL;
    sp_unfolding *unfolding = calloc(1, sizeof *unfolding);
    char *copy = strdup(path);
    if (!unfolding || !copy) {
        free(unfolding);
        free(copy);
        sp_texture_free(&texture);
        return sp_fail_memory(error);
    }
    *unfolding = (sp_unfolding){.path = copy,
                                .triangle_count = texture.triangle_count,
                                .uv = texture.uv,
                                .page = texture.page,
                                .line = texture.line};
    read_mark(unfolding, text, unit);
    return unfolding;
}

sp_unfolding *sp_unfolding_read(const char *path, double unit, sp_error *error)
{
    if (!path)
        return NULL;
    size_t size;
    char *text = sp_read_file(path, &size, error);
    locale_t c = text ? newlocale(LC_ALL_MASK, "C", (locale_t)0) : (locale_t)0;
    sp_unfolding *unfolding = NULL;
    if (c != (locale_t)0) {
        locale_t before = uselocale(c);
        unfolding = sp_unfolding_parse(path, text, size, unit, error);
        uselocale(before);
        freelocale(c);
    } else if (text) {
        sp_fail_memory(error);
    }
    free(text);
    return unfolding;
}

void sp_unfolding_destroy(sp_unfolding *unfolding)
{
    if (!unfolding)
        return;
    free(unfolding->path);
    free(unfolding->uv);
    free(unfolding->page);
    free(unfolding->line);
    free(unfolding);
}

sp_atlas *sp_atlas_reuse(const sp_mesh *mesh, const char *path, double texel, sp_error *error)
{
    sp_unfolding *unfolding = mesh ? sp_unfolding_read(path, 1, error) : NULL;
    const sp_unfolding *files[] = {unfolding};
    sp_atlas *atlas = unfolding ? sp_atlas_of_files(mesh, files, 1, texel, error) : NULL;
    sp_unfolding_destroy(unfolding);
    return atlas;
}
