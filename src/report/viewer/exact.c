#include "exact.h"

#include "spray/restore.h"
#include "unfolded.h"

#include <stdlib.h>
#include <string.h>

/* How a coordinate is told: a whole number over a power of ten, times a unit, is what a file with so many decimals
 * reads as. What that misses follows as a difference of bits. */
typedef struct {
    double parts, unit; /* value = number / parts * unit */
} decimals;

static double read_back(const decimals *told, double number)
{
    return number / told->parts * told->unit;
}

static double number_of(const decimals *told, double value)
{
    return rint(fmin(fmax(value / told->unit * told->parts, -INT32_MAX), INT32_MAX));
}

/* That under which most coordinates are told whole. */
static decimals decimals_of(const sp_mesh *mesh)
{
    static const double units[] = {1, 1e-3, 1e-2, 0.0254, 0.3048};
    const double *values = &mesh->vertices[0].x;
    decimals best = {1, 1};
    size_t most = 0;
    for (size_t u = 0; u < sizeof units / sizeof *units; u++)
        for (int digits = 0; digits < 10; digits++) {
            decimals tried = {pow(10, digits), units[u]};
            size_t whole = 0;
            for (size_t i = 0; i < 3 * mesh->vertex_count; i++)
                whole += read_back(&tried, number_of(&tried, values[i])) == values[i];
            if (whole > most) {
                most = whole;
                best = tried;
            }
        }
    return best;
}

static bool pack_vertices(const sp_mesh *mesh, const decimals *told, sp_packed *packed)
{
    size_t count = mesh->vertex_count;
    const double *values = &mesh->vertices[0].x;
    uint32_t *numbers = malloc((count + 1) * sizeof *numbers);
    int64_t *missed = malloc((3 * count + 1) * sizeof *missed);
    for (size_t k = 0; numbers && missed && k < 3; k++) {
        for (size_t i = 0; i < count; i++) {
            double number = number_of(told, values[3 * i + k]);
            numbers[i] = (uint32_t)(int32_t)number;
            missed[k * count + i] = sp_packed_apart(values[3 * i + k], read_back(told, number));
        }
        sp_packed_words(packed, numbers, count, true);
    }
    if (numbers && missed)
        sp_packed_numbers(packed, missed, 3 * count);
    bool done = numbers && missed;
    free(numbers);
    free(missed);
    return done;
}

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
    decimals told = decimals_of(mesh);
    bool done = pack_vertices(mesh, &told, packed);
    sp_packed_split(packed, mesh->triangles[0], 3 * mesh->triangle_count);
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
        about = json_pack("{s:f, s:f, s:I, s:I, s:I, s:I, s:I}", "parts", told.parts, "unit", told.unit, "vertices",
                          (json_int_t)mesh->vertex_count, "triangles", (json_int_t)mesh->triangle_count, "charts",
                          (json_int_t)atlas->chart_count, "nodes", (json_int_t)wet.node_count, "cuts",
                          (json_int_t)wet.cut_count);
    sp_wet_told_free(&wet);
    return about;
}
