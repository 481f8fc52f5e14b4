/* Faces: the pieces of triangles whose sides each look into one space. */
#ifndef SPRAY_FACES_H
#define SPRAY_FACES_H

#include "spray/wet/cuts.h"
#include "spray/wet/winding.h"

/* What became of one side of a face. */
typedef enum {
    SP_FACE_FREE,     /* looks into free space */
    SP_FACE_OWN,      /* looks into its own solid */
    SP_FACE_INSIDE,   /* lies in another solid */
    SP_FACE_TOUCHING, /* lies on another surface */
    SP_FACE_NONE,     /* there is no such face: the triangle is cut */
} sp_face_state;

/* Face t is triangle t where that is whole, face triangle_count + c is cell c. Side 2 f is the front of face f, 2 f + 1
 * its back. */
typedef struct {
    const sp_mesh *mesh;
    const sp_cuts *cuts;
    size_t count;
    double *area;          /* [count], m² */
    size_t *corner_start;  /* [cell_count + 1], where the corners of a cell begin */
    uint8_t *corner_count; /* [cell_count + 1], 0 of a cell without area */
    double (*corners)[2];  /* weights of the second and third corner of the cell's triangle, round its largest piece */
    uint8_t *state;        /* [2 count], sp_face_state */
    uint32_t *stands_for;  /* [2 count], of touching sides: the side that counts in its place, or SP_NONE */
} sp_faces;

/* `solids` tells where material is, above -base; NULL: nowhere. All borrowed. */
bool sp_faces_create(sp_faces *faces, const sp_mesh *mesh, const sp_shells *shells, const sp_cuts *cuts,
                     const sp_winding *solids, int base, int threads, sp_error *error);
/* Accepts what was never created, if it is all zeros. */
void sp_faces_destroy(sp_faces *faces);

uint32_t sp_face_triangle(const sp_faces *faces, uint32_t face);
/* The face that holds a point of a triangle; *near where a cut is within the contact. */
uint32_t sp_face_at(const sp_faces *faces, uint32_t triangle, double u, double v, bool *near);
/* A point of a face by two numbers from 0 to 1, evenly by area, kept off its edges. */
sp_vec3 sp_face_point(const sp_faces *faces, uint32_t face, double first, double second);

#endif
