/* glTF 2.0 with everything in one binary file. */
#ifndef REPORT_GLTF_H
#define REPORT_GLTF_H

#include "result/growing_text.h"

#include <sprayplan/setup.h>

#include <jansson.h>

/* Lists of the document, by index; empty ones are left out of it. */
typedef enum {
    SP_GLTF_ACCESSORS,
    SP_GLTF_VIEWS,
    SP_GLTF_IMAGES,
    SP_GLTF_TEXTURES,
    SP_GLTF_SAMPLERS,
    SP_GLTF_MATERIALS,
    SP_GLTF_MESHES,
    SP_GLTF_NODES,
    SP_GLTF_LISTS
} sp_gltf_list;

/* Starts as {0}; what could not be allocated shows in the end. */
typedef struct {
    sp_text bytes; /* the binary chunk */
    json_t *lists[SP_GLTF_LISTS];
} sp_gltf;

/* Takes the entry over; its index in its list. */
json_int_t sp_gltf_add(sp_gltf *gltf, sp_gltf_list list, json_t *entry);
/* An accessor of `count` (at least 1) vectors of `width` (2 or 3) floats, with their box. */
json_int_t sp_gltf_add_vectors(sp_gltf *gltf, const float *values, size_t count, int width);
/* An accessor of `count` (at least 1) indices, in 16 bits where `vertices` of them fit. */
json_int_t sp_gltf_add_indices(sp_gltf *gltf, const uint32_t *indices, size_t count, size_t vertices);
/* A texture of a PNG file's bytes, its pixels as they are. */
json_int_t sp_gltf_add_texture(sp_gltf *gltf, const uint8_t *png, size_t size);
/* A material of one colour (sRGB) or texture (-1: none) that no light changes. */
json_int_t sp_gltf_add_material(sp_gltf *gltf, const char *name, const uint8_t colour[3], json_int_t texture,
                                bool double_sided);
/* A node's "rotation" from where its axes point to, unit. */
json_t *sp_gltf_rotation(sp_frame frame);

/* The file, of which node 0 is the scene. */
bool sp_gltf_write(sp_gltf *gltf, const char *path, sp_error *error);
void sp_gltf_free(sp_gltf *gltf);

#endif
