/* The vessel in false colour as a binary glTF 2.0 model: the atlas pages are its textures. A wall's wet side is drawn
 * and its dry side is not, so that a viewer looks through the near wall. */
#include "layers.h"
#include "scaled_files.h"

#include "result/growing_text.h"

#include <sprayplan/image.h>
#include <sprayplan/report.h>
#include <sprayplan/sprayplan.h>

#include <errno.h>
#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Constants of the glTF 2.0 specification. */
enum {
    GLTF_FLOAT = 5126,
    GLTF_ARRAY_BUFFER = 34962,
    GLTF_TRIANGLES = 4,
    GLTF_NEAREST = 9728,
    GLTF_CLAMP_TO_EDGE = 33071,
};

typedef struct {
    const sp_layers *layers;
    const sp_coverage *coverage;
    sp_flux_scale scale;
    sp_text bytes; /* the binary chunk */
    json_t *views, *accessors, *images, *textures, *materials, *primitives;
    sp_error *error;
} model;

/* Index of the next entry of a list that this appends to; a failed append shows in the end. */
static json_int_t append(json_t *list, json_t *entry)
{
    json_int_t index = (json_int_t)json_array_size(list);
    return json_array_append_new(list, entry) == 0 ? index : -1;
}

static json_int_t add_view(model *m, const void *bytes, size_t length, int target)
{
    json_t *view = json_pack("{s:i, s:I, s:I}", "buffer", 0, "byteOffset", (json_int_t)m->bytes.length, "byteLength",
                             (json_int_t)length);
    if (target)
        json_object_set_new(view, "target", json_integer(target));
    sp_text_append(&m->bytes, bytes, length);
    sp_text_append(&m->bytes, "\0\0\0", (4 - length % 4) % 4);
    return append(m->views, view);
}

static json_t *reals(const float *values, int count)
{
    json_t *list = json_array();
    for (int i = 0; i < count; ++i)
        json_array_append_new(list, json_real(values[i]));
    return list;
}

/* `count` points of `width` floats; with their box, which glTF asks for where they are positions. */
static json_int_t add_accessor(model *m, const float *values, size_t count, int width)
{
    float low[3] = {values[0], values[1], values[width - 1]}, high[3] = {values[0], values[1], values[width - 1]};
    for (size_t i = 0; i < count; ++i)
        for (int k = 0; k < width; ++k) {
            low[k] = fminf(low[k], values[i * (size_t)width + (size_t)k]);
            high[k] = fmaxf(high[k], values[i * (size_t)width + (size_t)k]);
        }
    json_int_t view = add_view(m, values, count * (size_t)width * sizeof *values, GLTF_ARRAY_BUFFER);
    return append(m->accessors, json_pack("{s:I, s:i, s:I, s:s, s:o, s:o}", "bufferView", view, "componentType",
                                          GLTF_FLOAT, "count", (json_int_t)count, "type", width == 3 ? "VEC3" : "VEC2",
                                          "min", reals(low, width), "max", reals(high, width)));
}

static void add_primitive(model *m, const float *positions, const float *uv, size_t count, json_int_t material)
{
    json_t *attributes = json_pack("{s:I}", "POSITION", add_accessor(m, positions, count, 3));
    if (uv)
        json_object_set_new(attributes, "TEXCOORD_0", json_integer(add_accessor(m, uv, count, 2)));
    append(m->primitives,
           json_pack("{s:o, s:I, s:i}", "attributes", attributes, "material", material, "mode", GLTF_TRIANGLES));
}

/* The page's corner of the texture is at its top left, as in the pictures. */
static void corner(const model *m, uint32_t triangle, int which, float position[3], float uv[2])
{
    const sp_mesh *mesh = sp_evaluator_setup(m->layers->evaluator)->mesh;
    const sp_atlas *atlas = sp_evaluator_atlas(m->layers->evaluator);
    sp_vec3 point = mesh->vertices[mesh->triangles[triangle][which]];
    position[0] = (float)point.x;
    position[1] = (float)point.y;
    position[2] = (float)point.z;
    uv[0] = (float)(atlas->uv[triangle][which][0] / atlas->page_edge);
    uv[1] = (float)(1 - atlas->uv[triangle][which][1] / atlas->page_edge);
}

/* page SP_NONE asks for what is wet and not cleaned. */
static bool belongs(const model *m, uint32_t triangle, uint32_t page, int layer)
{
    const sp_atlas *atlas = sp_evaluator_atlas(m->layers->evaluator);
    bool clean = sp_layers_clean(m->layers, triangle, layer);
    if (page == SP_NONE)
        return !clean && sp_layers_wet(m->layers, triangle, layer);
    return clean && atlas->chart_page[atlas->chart[triangle]] == page;
}

/* The triangles of one page and side, each with corners of its own; seen from the back their order is turned. */
static bool add_triangles(model *m, uint32_t page, int layer, json_int_t material)
{
    const sp_mesh *mesh = sp_evaluator_setup(m->layers->evaluator)->mesh;
    size_t count = 0, filled = 0;
    for (uint32_t t = 0; t < mesh->triangle_count; ++t)
        count += belongs(m, t, page, layer);
    if (count == 0)
        return true;
    float *positions = malloc(count * 9 * sizeof *positions), *uv = malloc(count * 6 * sizeof *uv);
    if (!positions || !uv) {
        free(positions);
        free(uv);
        return sp_fail_memory(m->error);
    }
    for (uint32_t t = 0; t < mesh->triangle_count; ++t) {
        if (!belongs(m, t, page, layer))
            continue;
        for (int k = 0; k < 3; ++k, ++filled)
            corner(m, t, layer ? 2 - k : k, positions + 3 * filled, uv + 2 * filled);
    }
    add_primitive(m, positions, page == SP_NONE ? NULL : uv, filled, material);
    free(positions);
    free(uv);
    return true;
}

static bool add_texture(model *m, uint32_t page, int layer, json_int_t *texture)
{
    int edge = (int)sp_evaluator_atlas(m->layers->evaluator)->page_edge;
    uint8_t *pixels =
        sp_layers_picture(m->layers, m->coverage, m->scale, page, layer, sp_colour_obstacle, true, m->error);
    size_t size = 0;
    uint8_t *png = pixels ? sp_image_encode_png(pixels, edge, edge, 3, &size, m->error) : NULL;
    free(pixels);
    if (!png)
        return false;
    json_int_t image =
        append(m->images, json_pack("{s:I, s:s}", "bufferView", add_view(m, png, size, 0), "mimeType", "image/png"));
    free(png);
    *texture = append(m->textures, json_pack("{s:i, s:I}", "sampler", 0, "source", image));
    return true;
}

static json_int_t add_material(model *m, const char *name, json_int_t texture)
{
    json_t *pbr = json_pack("{s:f, s:f}", "metallicFactor", 0.0, "roughnessFactor", 1.0);
    if (texture >= 0)
        json_object_set_new(pbr, "baseColorTexture", json_pack("{s:I}", "index", texture));
    else /* linear light, whereas the colour is sRGB */
        json_object_set_new(pbr, "baseColorFactor",
                            json_pack("[f,f,f,f]", pow(sp_colour_obstacle[0] / 255., 2.2),
                                      pow(sp_colour_obstacle[1] / 255., 2.2), pow(sp_colour_obstacle[2] / 255., 2.2),
                                      1.0));
    return append(m->materials, json_pack("{s:s, s:o, s:b}", "name", name, "pbrMetallicRoughness", pbr, "doubleSided",
                                          (int)m->layers->two_sided));
}

static bool add_page(model *m, uint32_t page, int layer)
{
    char name[48];
    json_int_t texture;
    snprintf(name, sizeof name, "page%u%s", (unsigned)page, layer ? "-back" : "");
    return add_texture(m, page, layer, &texture) && add_triangles(m, page, layer, add_material(m, name, texture));
}

static bool add_all(model *m)
{
    const sp_atlas *atlas = sp_evaluator_atlas(m->layers->evaluator);
    int sides = m->layers->two_sided ? 1 : 2;
    for (uint32_t page = 0; page < atlas->page_count; ++page)
        for (int layer = 0; layer < (m->layers->has_back ? 2 : 1); ++layer)
            if (!add_page(m, page, layer))
                return false;
    json_int_t grey = add_material(m, "not cleaned", -1);
    for (int layer = 0; layer < sides; ++layer)
        if (!add_triangles(m, SP_NONE, layer, grey))
            return false;
    return true;
}

/* Takes the lists over. glTF is y up; a model with z up is turned by -90 degrees about x. */
static char *document(model *m, const char *name)
{
    const sp_setup *setup = sp_evaluator_setup(m->layers->evaluator);
    bool z_up = setup->up.z > 0.5;
    sp_vec3 o = setup->origin, there = z_up ? sp_v(o.x, o.z, -o.y) : o;
    json_t *node = json_pack("{s:i}", "mesh", 0);
    /* floats do not tell a part from the next far from (0, 0, 0) */
    if (sp_length(o) > 0)
        json_object_set_new(node, "translation", json_pack("[f,f,f]", there.x, there.y, there.z));
    if (z_up)
        json_object_set_new(node, "rotation", json_pack("[f,f,f,f]", -sqrt(0.5), 0.0, 0.0, sqrt(0.5)));
    json_t *root =
        json_pack("{s:{s:s, s:s}, s:i, s:[{s:[i]}], s:[o], s:[{s:s, s:o}], s:o, s:o, s:o, s:o, s:[{s:i, s:i, "
                  "s:i, s:i}], s:o, s:[{s:I}]}",
                  "asset", "version", "2.0", "generator", "sprayplan " SP_VERSION, "scene", 0, "scenes", "nodes", 0,
                  "nodes", node, "meshes", "name", name, "primitives", m->primitives, "materials", m->materials,
                  "textures", m->textures, "images", m->images, "accessors", m->accessors, "samplers", "magFilter",
                  GLTF_NEAREST, "minFilter", GLTF_NEAREST, "wrapS", GLTF_CLAMP_TO_EDGE, "wrapT", GLTF_CLAMP_TO_EDGE,
                  "bufferViews", m->views, "buffers", "byteLength", (json_int_t)m->bytes.length);
    char *text = root ? json_dumps(root, JSON_COMPACT | JSON_REAL_PRECISION(9)) : NULL;
    json_decref(root);
    return text;
}

static void put_u32(uint8_t *bytes, size_t value)
{
    for (int k = 0; k < 4; ++k)
        bytes[k] = (uint8_t)(value >> (8 * k));
}

/* glTF 2.0, chapter 4: a header of 12 bytes, then the chunks, each padded to 4. */
static bool write_file(const char *path, const char *json, const sp_text *binary, sp_error *error)
{
    size_t json_size = strlen(json), padding = (4 - json_size % 4) % 4;
    size_t total = 12 + 8 + json_size + padding + 8 + binary->length;
    if (total > UINT32_MAX)
        return sp_fail(error, SP_ERROR_INPUT, path, 0, 0, "the model takes %zu bytes, more than glTF's 4 GiB", total);
    uint8_t header[20], chunk[8];
    memcpy(header, "glTF\2\0\0\0", 8);
    put_u32(header + 8, total);
    put_u32(header + 12, json_size + padding);
    memcpy(header + 16, "JSON", 4);
    put_u32(chunk, binary->length);
    memcpy(chunk + 4, "BIN", 4);
    FILE *file = fopen(path, "wb");
    bool written = file && fwrite(header, 20, 1, file) == 1 && fwrite(json, json_size, 1, file) == 1 &&
                   fwrite("   ", 1, padding, file) == padding && fwrite(chunk, 8, 1, file) == 1 &&
                   fwrite(binary->text, 1, binary->length, file) == binary->length;
    int cause = errno;
    if (file && fclose(file) != 0 && written) {
        written = false;
        cause = errno;
    }
    return written || sp_fail(error, SP_ERROR_FILE, path, 0, 0, "cannot be written: %s", strerror(cause));
}

bool sp_model_glb(const sp_design *design, sp_flux_scale scale, const char *path, sp_error *error)
{
    sp_layers layers;
    if (!sp_layers_create(&layers, design->evaluator, error))
        return false;
    model m = {.layers = &layers,
               .coverage = design->coverage,
               .scale = scale,
               .error = error,
               .views = json_array(),
               .accessors = json_array(),
               .images = json_array(),
               .textures = json_array(),
               .materials = json_array(),
               .primitives = json_array()};
    bool done = add_all(&m);
    char *name = sp_text_utf8(design->name);
    /* Takes the lists, so it runs in any case. */
    char *json = document(&m, name ? name : "");
    if (done && (!json || !name || m.bytes.failed)) {
        sp_fail_memory(error);
        done = false;
    }
    done = done && write_file(path, json, &m.bytes, error);
    free(name);
    free(json);
    free(m.bytes.text);
    sp_layers_free(&layers);
    return done;
}

bool sp_report_model_glb(const sp_design *design, const char *path, sp_error *error)
{
    return sp_model_glb(design, sp_flux_scale_of(design, 1), path, error);
}
