/* A scene in memory, and who reads what of it. */
#ifndef SCENE_STATE_H
#define SCENE_STATE_H

#include "scene/read.h"

#include <sprayplan/scene.h>

/* An image of the catalogue's types. */
typedef struct {
    char *path; /* seen from the working directory */
    double angle;
    bool speeds;                      /* it says how fast */
    size_t layer_count;               /* 1 where it does not */
    sp_speed_layer layers[SP_SPEEDS]; /* [layer_count], which types borrow */
} sp_scene_image;

/* One of place's alternatives. */
typedef struct {
    char name[SP_NAME];
    sp_place_options options; /* borrows of what follows, and of the scene what is not its own */
    sp_mount *mounts;         /* owned, as the following; NULL: the scene's */
    double *pressures;
    const sp_nozzle_type **types;
} sp_scene_alternative;

struct sp_scene {
    char *path;
    char *directory; /* that holds the scene, "." where the path names none */
    bool streamed;   /* the scene lies in no directory: files are seen from the working directory */
    sp_yaml *tree;   /* the scene as it stands, overrides applied */
    sp_mesh *mesh;
    sp_surface *surfaces; /* [mesh->part_count] */
    sp_run run;           /* while it is read */
    size_t cad_count;
    sp_cad_account *cads;    /* [cad_count], one for each geometry entry; all zeros where that is no CAD file */
    double *file_units;      /* [cad_count], m per unit of the file as the scene has it; 0: the file knows its own */
    bool reuse;              /* of the files' own texture coordinates */
    sp_unfolding **unfolded; /* [cad_count] where reused, else NULL */
    sp_cap *caps;            /* [setup.cap_count] */
    double dose;             /* m³/m², of the criterion; 0: none */
    size_t type_count;
    sp_nozzle_type *types;
    size_t image_count;
    sp_scene_image *images; /* [image_count] */
    sp_setup setup;
    sp_picture_style style;
    sp_layout *layout;
    sp_place_options place;
    sp_water_cost water_cost;
    size_t mount_count;
    sp_mount *mounts;
    const sp_nozzle_type ***mount_types; /* [mount_count], what a port's `types` points to */
    double *pressures;
    const sp_nozzle_type **place_types;
    size_t alternative_count;
    sp_scene_alternative *alternatives;
};

/* scene.c: what scene->tree says, a map, into a scene with a path, a directory and what is there by default. */
bool sp_scene_read(sp_scene *scene, const sp_reader *reader);

/* Each reads its block into the scene; an absent block leaves the defaults. In this order. */
bool sp_scene_read_geometry(sp_scene *scene, const sp_reader *reader);
bool sp_scene_read_physics(sp_scene *scene, const sp_reader *reader);
bool sp_scene_read_datum(sp_scene *scene, const sp_reader *reader);
bool sp_scene_read_catalogue(sp_scene *scene, const sp_reader *reader);
bool sp_scene_read_nozzles(sp_scene *scene, const sp_reader *reader);
bool sp_scene_read_simulate(sp_scene *scene, const sp_reader *reader);
bool sp_scene_read_place(sp_scene *scene, const sp_reader *reader);
bool sp_scene_read_report(sp_scene *scene, const sp_reader *reader);

/* cost.c: `water_cost` of place, before mounts; and `cost` of a mount, m³/s. Absent: none. */
bool sp_scene_read_water_cost(sp_scene *scene, const sp_reader *reader, const sp_yaml *place);
bool sp_scene_read_cost(const sp_scene *scene, const sp_reader *reader, const sp_yaml *mount, double *cost);
/* `pressure`: one or a list of them, malloc'd; absent: none. */
bool sp_scene_read_pressures(const sp_fields *in, double **pressures, size_t *count);
/* alternatives.c: the list in `place:`, all else of which has been read; no node: none. */
bool sp_scene_read_alternatives(sp_scene *scene, const sp_reader *reader, const sp_yaml *list);
void sp_scene_free_alternatives(sp_scene *scene);

/* sweep.c: the sweep of one piece of geometry; absent: *moves is false. All of a scene are the same. */
bool sp_scene_read_sweep(sp_scene *scene, const sp_reader *reader, const sp_yaml *piece, bool *moves);
/* What the criterion asks for of goods that move, once all pieces are read: a dose, as its mean flux. */
bool sp_scene_settle_dose(sp_scene *scene, const sp_reader *reader);

/* Puts "simulate.jets=20000" into the tree. */
bool sp_scene_override(sp_yaml *tree, const char *setting, sp_error *error);

/* What the tree of a catalogue says. */
bool sp_scene_read_types_of(sp_scene *scene, const sp_reader *reader, const sp_yaml *catalogue);
/* What a catalogue type, or a member of a cluster, sprays: `pattern`, and the angles that belong to it. */
bool sp_scene_read_pattern(const sp_fields *in, sp_nozzle_type *type);
bool sp_scene_read_shape(const sp_fields *in, sp_nozzle_type *type);
/* flow_points.c: flow, pressure and exponent of a catalogue type. */
/* `trajectory`: auto, line, parabola or drag; unchanged where it is not there. */
bool sp_scene_read_trajectory(const sp_fields *in, sp_trajectory *trajectory);
bool sp_scene_read_flow(const sp_reader *reader, const sp_yaml *map, sp_nozzle_type *type);
/* patternation.c: the image of a measured type, whose angle has been read, into the scene. With speeds it becomes a
 * cluster of patterns in one place, each as fast as its layer, malloc'd into type->members, which no member of one can
 * be. */
bool sp_scene_read_image(sp_scene *scene, const sp_reader *reader, const sp_yaml *node, sp_nozzle_type *type);
/* cluster.c: the members of a cluster, malloc'd into type->members, also where it fails. */
bool sp_scene_read_members(sp_scene *scene, const sp_reader *reader, const sp_yaml *node, sp_nozzle_type *type);
/* The catalogue's type of that name; NULL with an error at `node`. */
const sp_nozzle_type *sp_scene_find_type(const sp_scene *scene, const sp_reader *reader, const sp_yaml *node,
                                         const char *key);
/* rotation.c: what makes a rotating type a two-axis head, of the map under `rotation`; the jet has been read. */
bool sp_scene_read_gears(const sp_reader *reader, const sp_yaml *rotation, sp_nozzle_type *type);
/* A list of type names under `key`, malloc'd into *types; absent: none. */
bool sp_scene_read_types(const sp_scene *scene, const sp_reader *reader, const sp_yaml *map, const char *key,
                         const sp_nozzle_type ***types, size_t *count);

/* `file` as the scene names it, seen from the working directory. Malloc'd. */
char *sp_path_join(const char *directory, const char *file, sp_error *error);
char *sp_path_directory(const char *path, sp_error *error);
/* `path` (seen from the working directory) as seen from `directory`, which need not exist yet. Malloc'd. */
char *sp_path_relative(const char *path, const char *directory, sp_error *error);
/* What paths in the scene are relative to, in words. */
static inline const char *sp_scene_place_of_files(const sp_scene *scene)
{
    return scene->streamed ? "the working directory" : "the scene";
}
/* A file named under `key`, relative to a directory, that of `owner` ("the scene"), exists and can be opened. Returns
 * its path as sp_path_join does, NULL with an error. */
char *sp_scene_file(const char *directory, const char *owner, const sp_reader *reader, const sp_yaml *node,
                    const char *key);

#endif
