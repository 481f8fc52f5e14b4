/* A mesh that is being mended: its triangles change, its vertices stay. One thing that mending does in a file each. */
#ifndef MESH_EDIT_H
#define MESH_EDIT_H

#include "mesh/half_edge.h"

typedef struct {
    const sp_mesh *mesh; /* as it was; without degenerate triangles */
    sp_half_edges edges; /* of the mesh */
    uint32_t *shell;     /* [mesh->triangle_count]: the least triangle that hangs together with it by edges */
    size_t count, room, part_room;
    uint32_t (*triangles)[3];   /* [count]: at first those of the mesh; first corner SP_NONE: taken out */
    uint32_t *part;             /* [count] */
    const bool *preferred;      /* [part_count], borrowed; NULL: no part is */
    sp_repair_account *account; /* borrowed: of yields and fillings */
} sp_mesh_edit;

/* For the menders `preferred` and `account` are to be set. The mesh must outlive it. False when memory runs out; then
 * there is nothing to close. */
bool sp_mesh_edit_open(sp_mesh_edit *edit, const sp_mesh *mesh, sp_error *error);
void sp_mesh_edit_close(sp_mesh_edit *edit);
bool sp_mesh_edit_add(sp_mesh_edit *edit, uint32_t a, uint32_t b, uint32_t c, uint32_t part, sp_error *error);
/* What the mesh is by now; with the parts of its mesh, also those that have no triangles. */
sp_mesh *sp_mesh_edit_mesh(const sp_mesh_edit *edit, sp_error *error);

/* Twice the area, along the normal, m². */
sp_vec3 sp_corners_area(const sp_mesh *mesh, const uint32_t corners[3]);
/* Whether a triangle made of another is neither turned by more than 60 degrees nor without area. */
bool sp_keeps_its_side(const sp_mesh *mesh, sp_vec3 area_before, const uint32_t corners[3]);

/* Mends once what can be mended at once, in the edit; *done: how much. `careful`: only within shells, only where
 * neighbours agree which side is the front, and what runs through others is not cut. False when memory runs out. */
typedef bool sp_mender(sp_mesh_edit *edit, bool careful, size_t *done, sp_error *error);

/* copies.c: takes out triangles that lie where the same one lies, as long as every edge has neighbours afterwards that
 * fit no worse: not those by which two bodies touch, nor a sheet's other side. What stays goes to a preferred part
 * where there is one among them. Done: triangles. */
sp_mender sp_take_out_copies;
/* turns.c: turns triangles over so that neighbours agree, as most of the surface that hangs together has it. What has
 * but one side, as a Möbius strip, stays as it is. Done: triangles. */
sp_mender sp_turn_over;
/* cracks.c: joins corners at cracks, the nearest first. Done: corners. */
sp_mender sp_join_cracks;
/* junctions.c: splits triangles where corners lie on their open edges and these are others' edges then. Done:
 * triangles. */
sp_mender sp_split_at_corners;
/* holes.c: puts a triangle where one is missing from a surface that goes on. Done: triangles. */
sp_mender sp_fill_holes;

#endif
