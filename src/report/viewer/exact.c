/* exact.js does the same the other way round: whatever is changed here is changed there. */
#include "exact.h"

#include "packed.h"
#include "vertex_code.h"
#include "spray/restore.h"
#include "unfolded.h"

#include <stdlib.h>
#include <string.h>

/* Each as what it is more than the one before, in the order of the walk or as they stand; false where memory runs out.
 */
static bool encode_words(const uint32_t *values, const uint32_t *order, size_t count, sp_coder *coder)
{
    sp_number_model *model = calloc(1, sizeof *model);
    for (size_t i = 0; model && i < count; i++) {
        int64_t before = !i ? 0 : order ? values[order[i - 1]] : values[i - 1];
        sp_code_number(coder, model, (order ? values[order[i]] : values[i]) - before);
    }
    free(model);
    return model != NULL;
}

static bool encode_doubles(const double *values, size_t count, sp_coder *coder)
{
    sp_number_model *model = calloc(1, sizeof *model);
    for (size_t i = 0; model && i < count; i++)
        sp_code_number(coder, model, sp_packed_apart(values[i], i ? values[i - 1] : 0));
    free(model);
    return model != NULL;
}

/* The first of a triangle's nodes and cuts. */
typedef struct {
    size_t node, cut;
} place;

static bool is_partly(uint8_t sides)
{
    return (sides & 3) != sides >> 2;
}

/* How many nodes a triangle has from the first on, and cuts among them. */
static place count_nodes(const sp_wet_arrays *wet, size_t first)
{
    place found = {0, 0};
    for (size_t open = 1; open; open--, found.node++)
        if (wet->nodes[first + found.node] == SP_WET_CUT) {
            found.cut++;
            open += 2;
        }
    return found;
}

static place *find_places(const sp_wet_arrays *wet, size_t triangles)
{
    place *places = malloc((triangles + 1) * sizeof *places), next = {0, 0};
    for (size_t t = 0; places && t < triangles; t++) {
        places[t] = next;
        if (!is_partly(wet->sides[t]))
            continue;
        place own = count_nodes(wet, next.node);
        next.node += own.node;
        next.cut += own.cut;
    }
    return places;
}

typedef struct {
    sp_byte_model sides, nodes;
    sp_number_model cuts[3];
} wet_models;

static void encode_nodes(const sp_wet_arrays *wet, place first, wet_models *models, sp_coder *coder)
{
    place count = count_nodes(wet, first.node);
    for (size_t i = 0; i < count.node; i++)
        sp_code_byte(coder, &models->nodes, wet->nodes[first.node + i]);
    for (size_t i = 0; i < 3 * count.cut; i++)
        sp_code_number(coder, &models->cuts[i % 3], sp_packed_apart(wet->cuts[first.cut + i / 3][i % 3], 0));
}

/* Triangle by triangle: its sides, and how it is cut. */
static bool encode_wet(const sp_evaluator *evaluator, const sp_triangle_order *walk, sp_coder *coder,
                       sp_wet_arrays *wet, sp_error *error)
{
    if (!sp_evaluator_wet_arrays(evaluator, wet, error))
        return false;
    place *places = find_places(wet, walk->count);
    wet_models *models = calloc(1, sizeof *models);
    bool done = places && models;
    for (size_t i = 0; done && i < walk->count; i++) {
        uint32_t triangle = walk->triangle[i];
        sp_code_byte(coder, &models->sides, wet->sides[triangle]);
        if (is_partly(wet->sides[triangle]))
            encode_nodes(wet, places[triangle], models, coder);
    }
    free(places);
    free(models);
    return done || sp_fail_memory(error);
}

static int ascending(const void *a, const void *b)
{
    uint32_t one = *(const uint32_t *)a, two = *(const uint32_t *)b;
    return one < two ? -1 : one > two;
}

/* Which triangles are drawn, by their numbers in the walk, ascending in each range. */
static bool encode_drawn(const sp_drawn_surface *surface, const sp_triangle_order *walk, sp_coder *coder)
{
    uint32_t *number = malloc((walk->count + 1) * sizeof *number);
    uint32_t *drawn = malloc((surface->triangle_count + 1) * sizeof *drawn);
    bool done = number && drawn;
    for (uint32_t i = 0; done && i < walk->count; i++)
        number[walk->triangle[i]] = i;
    for (size_t i = 0; done && i < surface->triangle_count; i++)
        drawn[i] = number[surface->triangles[i]];
    for (size_t i = 0; done && i < surface->range_count; i++)
        qsort(drawn + surface->ranges[i].first, surface->ranges[i].count, sizeof *drawn, ascending);
    done = done && encode_words(drawn, NULL, surface->triangle_count, coder);
    free(number);
    free(drawn);
    return done;
}

static bool encode_surface(const sp_evaluator *evaluator, const sp_triangle_order *walk, sp_coder *coder,
                           sp_vertices_encoded *vertices)
{
    const sp_mesh *mesh = sp_evaluator_setup(evaluator)->mesh;
    const sp_atlas *atlas = sp_evaluator_atlas(evaluator);
    return sp_vertices_encode(mesh, walk, coder, vertices) &&
           encode_words(mesh->part, walk->triangle, walk->count, coder) &&
           encode_words(atlas->chart_page, NULL, atlas->chart_count, coder) &&
           encode_doubles(atlas->chart_texel, atlas->chart_count, coder) && sp_unfolded_encode(evaluator, walk, coder);
}

json_t *sp_viewer_exact(const sp_evaluator *evaluator, const sp_drawn_surface *surface, sp_coder *coder,
                        sp_error *error)
{
    const sp_mesh *mesh = sp_evaluator_setup(evaluator)->mesh;
    const sp_atlas *atlas = sp_evaluator_atlas(evaluator);
    sp_triangle_order walk;
    sp_vertices_encoded vertices;
    sp_wet_arrays wet = {0};
    json_t *about = NULL;
    if (!sp_triangle_order_create(&walk, mesh, atlas, coder) || !encode_surface(evaluator, &walk, coder, &vertices) ||
        !encode_drawn(surface, &walk, coder))
        sp_fail_memory(error);
    else if (encode_wet(evaluator, &walk, coder, &wet, error))
        about = json_pack("{s:I, s:f, s:I, s:i, s:I, s:I, s:I, s:I, s:I}", "parts", (json_int_t)vertices.parts, "unit",
                          vertices.unit, "base", (json_int_t)vertices.base, "digits", vertices.digits, "vertices",
                          (json_int_t)mesh->vertex_count, "triangles", (json_int_t)mesh->triangle_count, "charts",
                          (json_int_t)atlas->chart_count, "nodes", (json_int_t)wet.node_count, "cuts",
                          (json_int_t)wet.cut_count);
    sp_wet_arrays_free(&wet);
    sp_triangle_order_free(&walk);
    return about;
}
