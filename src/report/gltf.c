#include "gltf.h"

#include <sprayplan/sprayplan.h>

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Constants of the glTF 2.0 specification. */
enum {
    GLTF_UNSIGNED_SHORT = 5123,
    GLTF_UNSIGNED_INT = 5125,
    GLTF_FLOAT = 5126,
    GLTF_ARRAY_BUFFER = 34962,
    GLTF_ELEMENT_ARRAY_BUFFER = 34963,
    GLTF_NEAREST = 9728,
    GLTF_CLAMP_TO_EDGE = 33071,
};

json_int_t sp_gltf_add(sp_gltf *gltf, sp_gltf_list list, json_t *entry)
{
    if (!gltf->lists[list])
        gltf->lists[list] = json_array();
    json_int_t index = (json_int_t)json_array_size(gltf->lists[list]);
    if (json_array_append_new(gltf->lists[list], entry) != 0)
        gltf->bytes.failed = true;
    return index;
}

static json_int_t add_view(sp_gltf *gltf, const void *bytes, size_t length, int target)
{
    json_t *view = json_pack("{s:i, s:I, s:I}", "buffer", 0, "byteOffset", (json_int_t)gltf->bytes.length, "byteLength",
                             (json_int_t)length);
    if (target)
        json_object_set_new(view, "target", json_integer(target));
    sp_text_append(&gltf->bytes, bytes, length);
    sp_text_append(&gltf->bytes, "\0\0\0", (4 - length % 4) % 4);
    return sp_gltf_add(gltf, SP_GLTF_VIEWS, view);
}

static json_t *reals(const float *values, int count)
{
    json_t *list = json_array();
    for (int i = 0; i < count; ++i)
        json_array_append_new(list, json_real((double)values[i]));
    return list;
}

json_int_t sp_gltf_add_vectors(sp_gltf *gltf, const float *values, size_t count, int width)
{
    float low[3] = {values[0], values[1], values[width - 1]}, high[3] = {values[0], values[1], values[width - 1]};
    for (size_t i = 0; i < count; ++i)
        for (int k = 0; k < width; ++k) {
            low[k] = fminf(low[k], values[i * (size_t)width + (size_t)k]);
            high[k] = fmaxf(high[k], values[i * (size_t)width + (size_t)k]);
        }
    json_int_t view = add_view(gltf, values, count * (size_t)width * sizeof *values, GLTF_ARRAY_BUFFER);
    return sp_gltf_add(gltf, SP_GLTF_ACCESSORS,
                       json_pack("{s:I, s:i, s:I, s:s, s:o, s:o}", "bufferView", view, "componentType", GLTF_FLOAT,
                                 "count", (json_int_t)count, "type", width == 3 ? "VEC3" : "VEC2", "min",
                                 reals(low, width), "max", reals(high, width)));
}

json_int_t sp_gltf_add_indices(sp_gltf *gltf, const uint32_t *indices, size_t count, size_t vertices)
{
    bool small = vertices <= UINT16_MAX; /* the largest number restarts a strip, so no vertex may have it */
    size_t width = small ? 2 : 4;
    uint8_t *bytes = malloc(count * width);
    if (!bytes) {
        gltf->bytes.failed = true;
        return -1;
    }
    for (size_t i = 0; i < count; ++i)
        for (size_t k = 0; k < width; ++k)
            bytes[i * width + k] = (uint8_t)(indices[i] >> (8 * k) & 0xff);
    json_int_t view = add_view(gltf, bytes, count * width, GLTF_ELEMENT_ARRAY_BUFFER);
    free(bytes);
    return sp_gltf_add(gltf, SP_GLTF_ACCESSORS,
                       json_pack("{s:I, s:i, s:I, s:s}", "bufferView", view, "componentType",
                                 small ? GLTF_UNSIGNED_SHORT : GLTF_UNSIGNED_INT, "count", (json_int_t)count, "type",
                                 "SCALAR"));
}

json_int_t sp_gltf_add_texture(sp_gltf *gltf, const uint8_t *png, size_t size)
{
    if (!gltf->lists[SP_GLTF_SAMPLERS])
        sp_gltf_add(gltf, SP_GLTF_SAMPLERS,
                    json_pack("{s:i, s:i, s:i, s:i}", "magFilter", GLTF_NEAREST, "minFilter", GLTF_NEAREST, "wrapS",
                              GLTF_CLAMP_TO_EDGE, "wrapT", GLTF_CLAMP_TO_EDGE));
    json_int_t view = add_view(gltf, png, size, 0);
    json_int_t image =
        sp_gltf_add(gltf, SP_GLTF_IMAGES, json_pack("{s:I, s:s}", "bufferView", view, "mimeType", "image/png"));
    return sp_gltf_add(gltf, SP_GLTF_TEXTURES, json_pack("{s:i, s:I}", "sampler", 0, "source", image));
}

/* IEC 61966-2-1. */
static double linear_light(uint8_t value)
{
    double level = value / 255.0;
    return level <= 0.04045 ? level / 12.92 : pow((level + 0.055) / 1.055, 2.4);
}

json_int_t sp_gltf_add_material(sp_gltf *gltf, const char *name, const uint8_t colour[3], json_int_t texture,
                                bool double_sided)
{
    json_t *pbr = json_pack("{s:f, s:f}", "metallicFactor", 0.0, "roughnessFactor", 1.0);
    if (texture >= 0)
        json_object_set_new(pbr, "baseColorTexture", json_pack("{s:I}", "index", texture));
    else
        json_object_set_new(
            pbr, "baseColorFactor",
            json_pack("[f,f,f,f]", linear_light(colour[0]), linear_light(colour[1]), linear_light(colour[2]), 1.0));
    return sp_gltf_add(gltf, SP_GLTF_MATERIALS,
                       json_pack("{s:s, s:o, s:b, s:{s:{}}}", "name", name, "pbrMetallicRoughness", pbr, "doubleSided",
                                 (int)double_sided, "extensions", "KHR_materials_unlit"));
}

/* The quaternion of a rotation matrix, from the largest of its four parts (Shepperd 1978). */
json_t *sp_gltf_rotation(sp_frame frame)
{
    const double m[3][3] = {
        {frame.x.x, frame.y.x, frame.z.x}, {frame.x.y, frame.y.y, frame.z.y}, {frame.x.z, frame.y.z, frame.z.z}};
    double trace = m[0][0] + m[1][1] + m[2][2], q[4];
    int i = m[1][1] > m[0][0] ? 1 : 0;
    i = m[2][2] > m[i][i] ? 2 : i;
    int j = (i + 1) % 3, k = (i + 2) % 3;
    if (trace > m[i][i]) {
        q[3] = 1 + trace;
        q[0] = m[2][1] - m[1][2];
        q[1] = m[0][2] - m[2][0];
        q[2] = m[1][0] - m[0][1];
    } else {
        q[i] = 1 + m[i][i] - m[j][j] - m[k][k];
        q[j] = m[j][i] + m[i][j];
        q[k] = m[k][i] + m[i][k];
        q[3] = m[k][j] - m[j][k];
    }
    double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    return json_pack("[f,f,f,f]", q[0] / length, q[1] / length, q[2] / length, q[3] / length);
}

static char *document(const sp_gltf *gltf)
{
    static const char *const names[SP_GLTF_LISTS] = {
        [SP_GLTF_ACCESSORS] = "accessors", [SP_GLTF_VIEWS] = "bufferViews", [SP_GLTF_IMAGES] = "images",
        [SP_GLTF_TEXTURES] = "textures",   [SP_GLTF_SAMPLERS] = "samplers", [SP_GLTF_MATERIALS] = "materials",
        [SP_GLTF_MESHES] = "meshes",       [SP_GLTF_NODES] = "nodes"};
    json_t *root = json_pack("{s:{s:s, s:s}, s:i, s:[{s:[i]}]}", "asset", "version", "2.0", "generator",
                             "sprayplan " SP_VERSION, "scene", 0, "scenes", "nodes", 0);
    for (int i = 0; i < SP_GLTF_LISTS; ++i)
        if (gltf->lists[i])
            json_object_set(root, names[i], gltf->lists[i]);
    if (gltf->lists[SP_GLTF_MATERIALS])
        json_object_set_new(root, "extensionsUsed", json_pack("[s]", "KHR_materials_unlit"));
    if (gltf->bytes.length)
        json_object_set_new(root, "buffers", json_pack("[{s:I}]", "byteLength", (json_int_t)gltf->bytes.length));
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

bool sp_gltf_write(sp_gltf *gltf, const char *path, sp_error *error)
{
    char *json = gltf->bytes.failed ? NULL : document(gltf);
    bool done = json ? write_file(path, json, &gltf->bytes, error) : sp_fail_memory(error) != NULL;
    free(json);
    return done;
}

void sp_gltf_free(sp_gltf *gltf)
{
    for (int i = 0; i < SP_GLTF_LISTS; ++i)
        json_decref(gltf->lists[i]);
    free(gltf->bytes.text);
    *gltf = (sp_gltf){0};
}
