/* Winding numbers: how often closed shells go round a point. */
#ifndef SPRAY_WINDING_H
#define SPRAY_WINDING_H

#include "spray/wet/shells.h"

typedef struct sp_winding sp_winding;

/* Of the closed shells. Mesh and shells are borrowed; their turns may change later. */
sp_winding *sp_winding_create(const sp_mesh *mesh, const sp_shells *shells, sp_error *error);
/* Accepts NULL. */
void sp_winding_destroy(sp_winding *winding);

/* The sum over all shells, each by its turn: above 0 in what they enclose with their normals outwards. */
int sp_winding_at(const sp_winding *winding, sp_vec3 point);
/* Of one shell alone as it is drawn, and of all but that one. */
int sp_winding_of(const sp_winding *winding, sp_vec3 point, uint32_t shell);
int sp_winding_without(const sp_winding *winding, sp_vec3 point, uint32_t shell);

#endif
