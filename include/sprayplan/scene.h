/* Scene files: YAML with units to plain structs, and back. */
#ifndef SPRAYPLAN_SCENE_H
#define SPRAYPLAN_SCENE_H

#include <sprayplan/cad.h>
#include <sprayplan/export.h>
#include <sprayplan/image.h>
#include <sprayplan/place.h>

#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Any number of threads may load, write and parse at a time, each its own scene. udunits2, which is not reentrant, is
 * entered by one of them at a time; nobody else in the program may call it meanwhile. */
typedef struct sp_scene sp_scene;

/* Reads a scene, its catalogue and its geometry. What lies four diagonals of the geometry or more from (0, 0, 0) is
 * moved to a local origin (see sp_setup): setup, layout and mounts are all in the setup's coordinates. Every error
 * names file, line, column and key, what was found and what was expected. */
SP_API sp_scene *sp_scene_load(const char *path, sp_error *error);
/* The same with settings of `simulate:`, `place:` and `report:` overridden, each "simulate.jets=20000" or
 * "place.refine=none"; the value is YAML as it would stand in the file. Errors in an override name it in place of the
 * file. `run`: its progress callback is called while CAD files are read, and may cancel; NULL for none. */
SP_API sp_scene *sp_scene_load_with(const char *path, const char *const *overrides, size_t count, const sp_run *run,
                                    sp_error *error);
/* The same of what is left of a stream, which may be a pipe and stays open. `name` stands for the scene's path in
 * messages and results; other files are looked up from the working directory. */
SP_API sp_scene *sp_scene_load_stream(FILE *stream, const char *name, const char *const *overrides, size_t count,
                                      const sp_run *run, sp_error *error);
/* Accepts NULL. Everything that the functions below return belongs to the scene. */
SP_API void sp_scene_destroy(sp_scene *scene);

SP_API const char *sp_scene_path(const sp_scene *scene);
SP_API const sp_setup *sp_scene_setup(const sp_scene *scene);          /* NULL for NULL */
SP_API const sp_layout *sp_scene_layout(const sp_scene *scene);        /* the engineer's own, may have no nozzles */
SP_API sp_place_options sp_scene_place_options(const sp_scene *scene); /* defaults for NULL */
SP_API sp_picture_style sp_scene_picture_style(const sp_scene *scene); /* what `report:` asks for; default for NULL */
SP_API bool sp_scene_has_place(const sp_scene *scene);                 /* the file has a `place:` block with mounts */
SP_API bool sp_scene_lists_nozzles(const sp_scene *scene);             /* the file has `nozzles:`, which may be none */

/* What water is worth, `water_cost` of `place:`. */
#define SP_CURRENCY 4
typedef struct {
    double money;               /* per m³/s; 0: not given */
    char currency[SP_CURRENCY]; /* ISO 4217; "" */
} sp_water_cost;
SP_API sp_water_cost sp_scene_water_cost(const sp_scene *scene); /* none for NULL */

/* The alternatives of `place:`, each by itself a placement: place's settings but for its own mounts (in place's order),
 * types, pressures and limits. `index` below the count. */
SP_API size_t sp_scene_alternative_count(const sp_scene *scene); /* 0 for NULL */
SP_API const char *sp_scene_alternative_name(const sp_scene *scene, size_t index);
SP_API sp_place_options sp_scene_alternative_options(const sp_scene *scene, size_t index);

/* How the CAD file of geometry entry `geometry` was cut into triangles; NULL for entries that are none. */
SP_API const sp_cad_account *sp_scene_cad(const sp_scene *scene, size_t geometry);

/* The `unit` of geometry entry `geometry`, m; 0 for STEP and IGES, which know their own. */
SP_API double sp_scene_file_unit(const sp_scene *scene, size_t geometry);

/* The files that the scene was read from: its own, the geometry, the catalogue. The path is malloc'd, NULL with an
 * error. */
SP_API size_t sp_scene_file_count(const sp_scene *scene); /* 0 for NULL */
SP_API char *sp_scene_file_path(const sp_scene *scene, size_t index, sp_error *error);
/* Gives an error of input "key: ..." that names no line the place of that key in the scene, or that of the scene's
 * first key where it has none: what computes with a scene's settings does not know where they stand. */
SP_API void sp_scene_locate(const sp_scene *scene, sp_error *error);

/* The scene as YAML text with `layout` in place of its nozzles and `fidelity` (nothing left to auto) under `simulate:`,
 * its paths relative to `directory`, its numbers reading back exactly, CAD files as finely cut. Lines that auto took
 * stay `trajectory: auto`: written as `line` they would pass for the truth. Malloc'd, the caller frees. */
SP_API char *sp_scene_text(const sp_scene *scene, const sp_layout *layout, const sp_fidelity *fidelity,
                           const char *directory, sp_error *error);

/* "12.5 L/min" -> SI by udunits; `unit` names the dimension expected ("m3/s"). For values outside scene files (--texel,
 * --unit). A bare number is a length in m or without dimension. */
SP_API bool sp_quantity_parse(const char *text, const char *unit, double *value, sp_error *error);

#ifdef __cplusplus
}
#endif
#endif
