/* CAD files: how finely they are cut into triangles, and what came of it. */
#ifndef SPRAYPLAN_CAD_H
#define SPRAYPLAN_CAD_H

#include <sprayplan/export.h>
#include <sprayplan/mesh.h>
#include <sprayplan/run.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum {
    SP_CAD_NONE, /* no CAD file by its extension */
    SP_CAD_STEP, /* .step, .stp; in any case */
    SP_CAD_IGES, /* .iges, .igs */
    SP_CAD_BREP, /* .brep, .brp: OpenCASCADE's own, the only one that does not know its unit of length */
} sp_cad_kind;

SP_API sp_cad_kind sp_cad_kind_of(const char *path);

typedef struct {
    double chord;      /* m: how far triangles may lie off the surface; 0: a thousandth of the geometry's diagonal, */
    double chord_most; /* m: but no more than this; 0: whatever */
    double angle;      /* rad: how far edges of neighbouring triangles may turn, > 0 */
    sp_run run;        /* progress and cancelling */
} sp_cad_options;

/* Chord 0, 10 degrees: whatever the chord, cylinders keep their area to 0.13 % and spheres to 0.3 %. */
SP_API sp_cad_options sp_cad_options_default(void);

/* What was kept, and what was wrong with the file. */
typedef struct {
    double chord, angle; /* m, rad */
    size_t triangles;    /* as made, with those that have no area */
    size_t mended;       /* triangles without area that were dropped, or split their neighbours in their place */
    size_t sewn;         /* faces that were in no solid, */
    double sewing;       /* sewn to others nearer than this, m */
    size_t faults;       /* what OpenCASCADE could not make sense of, or cannot have made right */
    char fault[200];     /* the first of them */
} sp_cad_account;

/* Reads a CAD file by the program sprayplan-cad, which is started for it. STEP and IGES files know their unit of
 * length: for these `unit` must be 1; for BREP it is m per unit of the file. A part is a solid, a shell sewn from loose
 * faces, or what remains of these; its name is the path of names through the assembly, "vessel/agitator/blade", those
 * after the first of a name get "#2" and so on. Parts without triangles are left out. Bodies' exact volumes are in the
 * parts. `account` may be NULL. NULL with an error that names the file, also where the program is not installed, dies
 * on the file or takes too much time or memory for its size. The caller destroys. Any number of threads may load at a
 * time. */
SP_API sp_mesh *sp_cad_load(const char *path, double unit, const sp_cad_options *options, sp_cad_account *account,
                            sp_error *error);

#ifdef __cplusplus
}
#endif
#endif
