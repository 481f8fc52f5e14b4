#include "exact.h"

#include "places.h"
#include "spray/restore.h"
#include "unfolded.h"

#include <stdlib.h>
#include <string.h>

static bool pack_doubles(const double *values, size_t count, sp_packed *packed)
{
    int64_t *apart = malloc((count + 1) * sizeof *apart);
    for (size_t i = 0; apart && i < count; i++)
        apart[i] = sp_packed_apart(values[i], i ? values[i - 1] : 0);
    if (apart)
        sp_packed_numbers(packed, apart, count);
    free(apart);
    return apart != NULL;
}

static bool pack_unfolded(const sp_evaluator *evaluator, sp_packed *packed)
{
    sp_unfolded unfolded;
    bool done = sp_unfolded_create(&unfolded, evaluator);
    if (done) {
        sp_packed_bytes(packed, unfolded.rounded, sp_evaluator_atlas(evaluator)->chart_count);
        sp_packed_numbers(packed, unfolded.apart, unfolded.count);
    }
    sp_unfolded_free(&unfolded);
    return done;
}

static bool pack_wet(const sp_evaluator *evaluator, sp_packed *packed, sp_wet_told *told, sp_error *error)
{
    size_t triangles = sp_evaluator_setup(evaluator)->mesh->triangle_count;
    if (!sp_evaluator_tell_wet(evaluator, told, error))
        return false;
    sp_packed_bytes(packed, told->sides, triangles);
    sp_packed_bytes(packed, told->nodes, told->node_count);
    return pack_doubles(told->cut_count ? told->cuts[0] : NULL, 3 * told->cut_count, packed) || sp_fail_memory(error);
}

json_t *sp_viewer_exact(const sp_evaluator *evaluator, const sp_drawn_surface *surface, sp_packed *packed,
                        sp_error *error)
{
    const sp_mesh *mesh = sp_evaluator_setup(evaluator)->mesh;
    const sp_atlas *atlas = sp_evaluator_atlas(evaluator);
    sp_places_told told;
    bool done = sp_places_pack(mesh, packed, &told);
    sp_packed_words(packed, mesh->part, mesh->triangle_count, true);
    sp_packed_words(packed, atlas->chart, mesh->triangle_count, true);
    sp_packed_words(packed, atlas->chart_page, atlas->chart_count, true);
    done = done && pack_doubles(atlas->chart_texel, atlas->chart_count, packed) && pack_unfolded(evaluator, packed);
    sp_packed_words(packed, surface->triangles, surface->triangle_count, true);
    sp_wet_told wet = {0};
    json_t *about = NULL;
    if (!done)
        sp_fail_memory(error);
    else if (pack_wet(evaluator, packed, &wet, error))
        about = json_pack("{s:I, s:f, s:I, s:i, s:I, s:I, s:I, s:I, s:I}", "parts", (json_int_t)told.parts, "unit",
                          told.unit, "base", (json_int_t)told.base, "digits", told.digits, "vertices",
                          (json_int_t)mesh->vertex_count, "triangles", (json_int_t)mesh->triangle_count, "charts",
                          (json_int_t)atlas->chart_count, "nodes", (json_int_t)wet.node_count, "cuts",
                          (json_int_t)wet.cut_count);
    sp_wet_told_free(&wet);
    return about;
}
