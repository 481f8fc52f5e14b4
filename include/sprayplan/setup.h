/* The setup: what is sprayed, with what liquid, what counts as clean, and how faithfully to simulate. Plain data. */
#ifndef SPRAYPLAN_SETUP_H
#define SPRAYPLAN_SETUP_H

#include <sprayplan/atlas.h>
#include <sprayplan/cad.h>
#include <sprayplan/export.h>
#include <sprayplan/mesh.h>
#include <sprayplan/nozzle.h>
#include <sprayplan/run.h>

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* What a part of the mesh is in the scene. */
typedef struct {
    bool clean;         /* is to be cleaned; otherwise an obstacle that only blocks and reflects */
    double restitution; /* e, 0 to 1; what comes less high over a wall than 2^-30 of the geometry's farthest coordinate
                         * stays there all the same */
    double rebound;     /* share of the liquid that flies on where e > 0, 0 to 1 */
    bool moves;         /* with the setup's sweep */
} sp_surface;

/* Goods that are conveyed past fixed nozzles: all parts that move are at first displaced by `from` from where the mesh
 * has them, and at constant speed come to be displaced by `to`. Every flux is then the mean over the pass, also that on
 * parts that stand, which the goods may shade; while liquid flies the goods are taken to stand still. Which sides are
 * wet, and whether a point lies in the cavity, is decided with the goods where the mesh has them. */
typedef struct {
    sp_vec3 from, to; /* m; unequal where anything moves */
    double speed;     /* m/s, > 0 where anything moves; 0: nothing does */
} sp_sweep;
/* Duration of the pass, s; 0 where nothing moves. A dose (m³/m²) is the mean flux times this duration. */
SP_API double sp_sweep_duration(const sp_sweep *sweep);
/* The farthest that the goods come from where the mesh has them, m; 0 where nothing moves. */
SP_API double sp_sweep_reach(const sp_sweep *sweep);

typedef enum {
    SP_CAVITY_NONE,    /* every triangle counts once and takes liquid from either side */
    SP_CAVITY_POINT,   /* the space seen, wall to wall, from a point */
    SP_CAVITY_OUTSIDE, /* the space around the geometry */
} sp_cavity_kind;

/* A round lid for the flood that finds the wet sides, and for nothing else: it shuts an opening that the geometry has
 * and the vessel in use has not. Liquid flies through it, and it is neither counted nor seen. */
typedef struct {
    sp_vec3 point;  /* its middle, m */
    sp_vec3 normal; /* either way, any length but 0 */
    double radius;  /* m, > 0 */
} sp_cap;

typedef enum { SP_COMBINE_SUM, SP_COMBINE_SINGLE } sp_combine;

/* What covers: all conditions must hold; with none (0, 0, π/2) any liquid covers. */
typedef struct {
    double flux; /* m³/s per m², 0: none; of goods that move the mean over the pass: the dose over its duration */
    double impact_speed; /* m/s, 0: none */
    double incidence;    /* rad, π/2: none */
    sp_combine combine;
    double film; /* m²/s, 0: none; else a film with this flow per width covers the patch that it runs down, whatever
                  * the other conditions say. Needs a cavity and gravity */
} sp_criterion;

typedef enum { SP_METHOD_AUTO, SP_METHOD_FORWARD, SP_METHOD_INVERSE } sp_method;
typedef enum { SP_SPLAT_NEAREST, SP_SPLAT_LINEAR } sp_splat;

/* The scene's `simulate:` block. sp_evaluator_fidelity has it with nothing left to auto; of sp_evaluator_create the
 * texel is then such that the surface to be cleaned, each wet side for itself, has 100,000 texels, however large the
 * rest is. */
typedef struct {
    sp_trajectory trajectory;
    sp_method method;
    int reflections; /* -1: auto */
    uint64_t jets;   /* per nozzle, whose patterns share them; 0: auto */
    double texel;    /* m; 0: auto. Shorter on thin parts: at most an eighth of their girth (sp_charts_girth) */
    sp_splat splat;
    double accuracy; /* points of coverage, as a fraction, 0 to 1 */
    uint64_t seed;
} sp_fidelity;

/* What fitters measure from: heights along `axis` above `origin`, azimuths about the axis from `zero` towards
 * axis x zero, which is anticlockwise seen against the axis. */
typedef struct {
    char name[SP_NAME]; /* what it is for readers; "": the geometry's own axes */
    sp_vec3 origin;     /* m, in the coordinates that are read and written */
    sp_vec3 axis, zero; /* unit, square to each other */
} sp_datum;

typedef struct {
    const sp_mesh *mesh;        /* borrowed: all geometry, in the setup's coordinates, as every point of a layout too */
    const sp_surface *surfaces; /* borrowed: [mesh->part_count] */
    sp_cad_account cad; /* of the CAD files in it: the coarsest chord and angle, the widest sewing, all counts together,
                         * the first fault; all zeros where there are none */
    sp_cavity_kind cavity;
    sp_vec3 cavity_point; /* m; for SP_CAVITY_POINT */
    /* m: where the setup's (0, 0, 0) lies in the coordinates that are read and written; (0, 0, 0) but for a scene that
     * lies far from theirs. */
    sp_vec3 origin;
    sp_transform file;  /* from the coordinates of the first geometry file, in its own unit, to those; the identity but
                         * for a scene: what is to be loaded beside that file is written in its coordinates */
    sp_datum datum;     /* default the origin, z and x; of a scene its up in place of z */
    const sp_cap *caps; /* borrowed: [cap_count]; NULL for none */
    size_t cap_count;
    /* borrowed: [unfolded_count], the files that make up the mesh, each as it lays its triangles flat. NULL: the
     * surface is unfolded here. */
    const sp_unfolding *const *unfolded;
    size_t unfolded_count;
    double unfolded_texel; /* m, > 0 where there are any: on texels so long the atlas is as they have it, on others
                            * their charts are packed anew */
    sp_sweep sweep;        /* speed 0: nothing moves */
    sp_fluid liquid;       /* default water: 1000 kg/m³, 1 mPa s */
    sp_fluid air;          /* 1.2 kg/m³, 18 µPa s */
    sp_vec3 up;            /* (0,0,1) or (0,1,0) */
    double gravity;        /* m/s², along -up */
    sp_criterion criterion;
    sp_fidelity fidelity;
    sp_run run;
} sp_setup;

/* The defaults of a scene file, with no mesh. */
SP_API sp_setup sp_setup_default(void);

/* True where any surface throws back liquid that hits it. */
SP_API bool sp_setup_throws_back(const sp_setup *setup);
/* A point of the setup (m) in the coordinates that are read and written. */
SP_API sp_vec3 sp_setup_outside(const sp_setup *setup, sp_vec3 point);
/* `point` rounded as writing it in those coordinates and reading it again rounds it, m: where they are far from the
 * setup's own, they are coarser. A layout of such points covers the same when it has been written and read again. */
SP_API sp_vec3 sp_setup_told(const sp_setup *setup, sp_vec3 point);

#ifdef __cplusplus
}
#endif
#endif
