/* The vessel as faces in named parts, written as an OBJ file. Millimetres, z up. */
#ifndef VESSEL_MODEL_H
#define VESSEL_MODEL_H

#include <sprayplan/vector.h>

#include <stdbool.h>
#include <stddef.h>

typedef struct model model;

/* NULL when memory runs out. Once an allocation has failed, faces are ignored and writing fails. */
model *model_create(void);
void model_destroy(model *model);
/* Faces that follow belong to the part of this name (borrowed, a literal). */
void model_part(model *model, const char *name);
/* A convex face of three or four corners, anticlockwise seen from its front. Coordinates are rounded to 0.1 µm, so that
 * faces which meet at a point name the same vertex whatever the last bits of the computation. Corners that coincide are
 * merged; a face with fewer than three left is dropped. */
void model_face(model *model, const sp_vec3 *corners, int count);
/* Once all faces fan out into triangles. */
size_t model_triangles(const model *model);
/* False where the file cannot be written or memory ran out. */
bool model_write(const model *model, const char *path);

#endif
