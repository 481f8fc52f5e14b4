/* Triangle meshes: reading, welding, diagnosis. */
#ifndef SPRAYPLAN_MESH_H
#define SPRAYPLAN_MESH_H

#include <sprayplan/error.h>
#include <sprayplan/export.h>
#include <sprayplan/vector.h>

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

#define SP_NONE UINT32_MAX /* no such triangle, texel, patch, ... */

/* A named group of triangles (OBJ group or object, STL solid, a body of a CAD file). */
typedef struct {
    char *name;
    uint32_t geometry; /* which geometry file of the scene it came from; 0 for a mesh that stands alone */
    double volume;     /* m³, of the CAD file's body itself, below 0 where its faces point inwards; 0: not known */
} sp_part;

/* A welded triangle mesh. Vertices with equal coordinates are one; degenerate triangles (two equal corners, or no area)
 * are kept out of `triangles` but remain in `source_triangles`, which holds what the file held, in its order, polygons
 * cut into two triangles fewer than they have corners. Everything is owned by the mesh and read-only once made. */
typedef struct {
    size_t vertex_count;
    sp_vec3 *vertices; /* [vertex_count], m */
    size_t triangle_count;
    uint32_t (*triangles)[3]; /* [triangle_count], anticlockwise seen from the front */
    uint32_t *part;           /* [triangle_count], index into parts */
    uint32_t *source;         /* [triangle_count], index into source_triangles */
    size_t source_triangle_count;
    uint32_t (*source_triangles)[3]; /* [source_triangle_count] */
    uint32_t *source_part;           /* [source_triangle_count] */
    size_t part_count;
    sp_part *parts; /* [part_count] */
    size_t tangled; /* polygons of the file whose outline crosses itself: cut as a fan from their first corner */
} sp_mesh;

#define SP_PLACES 10
/* How often something is wrong with a mesh, and where it is so at first. */
typedef struct {
    size_t count;
    bool more;                /* perhaps: there was too much to look at all of it */
    sp_vec3 place[SP_PLACES]; /* [min(count, SP_PLACES)], m: the middle of an edge, a triangle, a shell's widest one */
} sp_flaw;

/* What can be wrong with a mesh as a surface. */
typedef struct {
    sp_flaw degenerate;          /* source triangles kept out */
    sp_flaw open_edges;          /* edges of one triangle */
    sp_flaw non_manifold_edges;  /* edges of three or more triangles */
    sp_flaw flipped_edges;       /* edges of two triangles that disagree which side is the front */
    sp_flaw duplicate_triangles; /* triangles with the same three corners as an earlier one */
    sp_flaw cracks;              /* ends of open edges that lie very near another's and are not joined to it */
    sp_flaw crossings;           /* pairs of triangles of one shell that run through each other; not of one plane */
    sp_flaw inside_out;          /* closed shells that enclose what is in no other with their fronts: rooms, or wrong */
    sp_flaw bits;                /* shells that are not closed and have next to no area */
    double crack;                /* m, how near is very near */
    size_t shells;               /* connected through shared edges */
    size_t closed_shells;        /* shells without open, non-manifold or flipped edges */
    double area;                 /* m² */
    sp_vec3 minimum, maximum;    /* box around all vertices in use, m; both zero for an empty mesh */
} sp_mesh_diagnosis;

/* Reads an OBJ, STL or PLY file (recognised by its extension, upper or lower case; text or binary by its content), or a
 * CAD file as sp_cad_load does by default. Coordinates are multiplied by `unit` (m per unit of the file). Triangles
 * before any group get the part "default" (STL: the solid's name, or "default"; PLY knows no groups). Polygons are cut
 * into triangles within their outline, seen along Newell's normal: a fan from the first corner where that is right.
 * Returns NULL with file and line for whatever does not follow the format, for indices out of range, numbers that are
 * not finite or beyond 1e30 m, and for files without a triangle of some area. Holds at no time more than ten times the
 * file's size and 64 MiB (CAD files have limits of their own): polygons of so few bytes a corner that their mesh would
 * are refused. Names of parts are UTF-8; what is not is taken for Latin-1. The caller destroys. */
SP_API sp_mesh *sp_mesh_load(const char *path, double unit, sp_error *error);
/* The same of what is left of a stream, which may be a pipe and stays open; `name` stands for the path in messages.
 * PLY, STL and OBJ are recognised by how they begin; CAD files are refused. */
SP_API sp_mesh *sp_mesh_load_stream(FILE *stream, const char *name, double unit, sp_error *error);

/* Builds a welded mesh from `vertex_count` points and `triangle_count` triangles, all copied. `part` may be NULL: all
 * in one part; `part_names` [part_count] likewise. Fails for indices out of range and numbers that are not finite or
 * beyond 1e30 m; a mesh without triangles is allowed. */
SP_API sp_mesh *sp_mesh_create(const sp_vec3 *vertices, size_t vertex_count, const uint32_t (*triangles)[3],
                               size_t triangle_count, const uint32_t *part, const char *const *part_names,
                               size_t part_count, sp_error *error);

/* Accepts NULL. */
SP_API void sp_mesh_destroy(sp_mesh *mesh);

/* p -> rotate(scale p) + translate, rotate being a row-major matrix. */
typedef struct {
    double scale;
    double rotate[3][3];
    sp_vec3 translate; /* m */
} sp_transform;

/* The identity. */
SP_API sp_transform sp_transform_default(void);
/* Rotation by `angle` (rad) about `axis` (any length but 0), Rodrigues' formula. */
SP_API void sp_transform_rotation(sp_transform *transform, sp_vec3 axis, double angle);
SP_API sp_vec3 sp_transform_point(const sp_transform *transform, sp_vec3 point);

/* One mesh of several, in order, mesh i moved by transforms[i]; its parts get geometry = i. Vertices of different
 * meshes are not welded; within each, points that rounding makes equal are. Fails for transforms that mirror or
 * flatten. The inputs are copied and stay the caller's. */
SP_API sp_mesh *sp_mesh_join(const sp_mesh *const *meshes, const sp_transform *transforms, size_t count,
                             sp_error *error);

/* Returns false only when memory runs out. */
SP_API bool sp_mesh_diagnose(const sp_mesh *mesh, sp_mesh_diagnosis *diagnosis, sp_error *error);

/* Triangles that one part lost to another, in which they lay too. */
typedef struct {
    uint32_t part, to; /* parts of the mesh */
    size_t triangles;
    double area; /* m² */
} sp_yield;

/* A triangle that was put in. */
typedef struct {
    sp_vec3 place; /* its middle, m */
    double area;   /* m² */
} sp_filling;

/* What mending did, and what was wrong before and after it. */
typedef struct {
    size_t dropped; /* degenerate triangles */
    size_t copies;  /* triangles taken out that lay where the same one lies, for no reason */
    size_t joined;  /* corners at cracks that were moved onto another */
    size_t split;   /* triangles split at corners of others that lay on their open edges */
    size_t turned;  /* triangles turned over, as most of what hangs together by edges is turned */
    size_t filled;  /* triangles put where one was missing between three others or two */
    size_t yield_count;
    sp_yield yields[SP_PLACES]; /* [yield_count], in the order of their first triangles; of copies in one part none */
    size_t other_yields;        /* triangles that went between further pairs of parts */
    double filled_area;         /* m² */
    sp_filling fillings[SP_PLACES]; /* [min(filled, SP_PLACES)], the largest, in order */
    sp_mesh_diagnosis before, after;
} sp_repair_account;

/* A mended copy, which the caller destroys; NULL only when memory runs out. `preferred` [part_count]: of copies in
 * different parts the one that stays goes to a part that is preferred, where one of them is; else, or where it is NULL,
 * the first stays. Corners move by no more than
 * before.crack, and only where they lie on open edges; no surface is taken away but what is there twice. Nothing that
 * would leave more of any flaw is done, with two exceptions: the rim of a sheet that was there twice is open once it is
 * there once, and a shell that was closed or made to agree may face inwards, as most of it did. Bodies that touch,
 * sheets drawn with both sides, openings wider than one triangle or into whose plane no neighbour goes on (one within
 * 30 degrees, or two within 60), as the ends of pipes, crossings, bits and which side a closed shell faces
 * stay as they are. A sound mesh comes out with the same triangles, and so does what was mended. Parts keep their
 * numbers, also where they have lost all triangles. */
SP_API sp_mesh *sp_mesh_repair(const sp_mesh *mesh, const bool *preferred, sp_repair_account *account, sp_error *error);

/* Writes the triangles with some area, in m, and the vertices that they use, as OBJ text with a group for each part. It
 * reads back to the same last bit; names lose what OBJ has no way to write: a `#` that begins a word, a backslash at
 * the end. Fails with SP_ERROR_FILE. */
SP_API bool sp_mesh_write_obj(const sp_mesh *mesh, const char *path, sp_error *error);

/* The area in m² and the unit normal (anticlockwise front) of one triangle. */
SP_API double sp_triangle_area(const sp_mesh *mesh, uint32_t triangle);
SP_API sp_vec3 sp_triangle_normal(const sp_mesh *mesh, uint32_t triangle);
/* (1-u-v) a + u b + v c */
SP_API sp_vec3 sp_triangle_point(const sp_mesh *mesh, uint32_t triangle, double u, double v);
/* The weights of the second and third corner at the foot of the perpendicular from `point` onto the triangle's plane;
 * whether that lies within the triangle. */
SP_API bool sp_triangle_weights(const sp_mesh *mesh, uint32_t triangle, sp_vec3 point, double *u, double *v);
/* Sum over all triangles, m². */
SP_API double sp_mesh_area(const sp_mesh *mesh);
/* What each part encloses by its triangles alone, m³, into volumes[part_count]: below 0 where they face inwards, 0 for
 * a part that is not closed. False only when memory runs out. */
SP_API bool sp_mesh_volumes(const sp_mesh *mesh, double *volumes, sp_error *error);
/* The box around all triangles, m; both zero for an empty mesh. Returns its diagonal. */
SP_API double sp_mesh_box(const sp_mesh *mesh, sp_vec3 *low, sp_vec3 *high);

#ifdef __cplusplus
}
#endif
#endif
