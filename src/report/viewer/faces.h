/* Which vertices triangles have, told in few bytes; their order and every number stay. */
#ifndef REPORT_VIEWER_FACES_H
#define REPORT_VIEWER_FACES_H

#include "packed.h"

#include <sprayplan/mesh.h>

/* Adds the arrays that surface.js reads as faces: told by the triangles before, or where that deflates to more, as
 * where the order of triangles repeats itself, as differences. False where memory runs out. */
bool sp_faces_pack(const sp_mesh *mesh, sp_packed *packed);

#endif
