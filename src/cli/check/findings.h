/* What `check` finds in a scene, and how it is reported. */
#ifndef CLI_FINDINGS_H
#define CLI_FINDINGS_H

#include "flaws.h"
#include "lengths.h"
#include "repair.h"
#include "../cli.h"
#include "../size.h"

enum { CLI_WARNINGS = 100 };

typedef struct {
    const cli_scene *opened;
    sp_mesh_diagnosis mesh;
    double *part_area;         /* [part_count], m² */
    sp_part_sides *part_sides; /* [part_count] */
    size_t *part_triangles;
    double *part_volume; /* [part_count], m³, of its triangles; 0 where they are not closed */
    cli_box *part_box;   /* [part_count] */
    size_t size_count;
    cli_size *sizes;    /* [size_count], of each geometry file */
    double beyond_caps; /* m² */
    cli_repair repair;
    char warnings[CLI_WARNINGS][320];
    size_t warning_count;
} cli_findings;

static inline const sp_setup *cli_findings_setup(const cli_findings *found)
{
    return sp_evaluator_setup(found->opened->evaluator);
}

/* A point of the evaluator's in the coordinates of the scene's file. */
static inline sp_vec3 cli_findings_outside(const cli_findings *found, sp_vec3 point)
{
    return sp_setup_outside(cli_findings_setup(found), point);
}

/* m, what matters of places in the scene. */
static inline double cli_findings_step(const cli_findings *found)
{
    return cli_box_step((cli_box){found->mesh.minimum, found->mesh.maximum});
}

/* Adds what looks wrong. False when memory runs out. */
bool cli_findings_warn(cli_findings *found, sp_error *error);
/* Prints all for people, or as one JSON object; `output` is the folder that pictures went to, or NULL. False when
 * memory runs out. */
void cli_findings_print(const cli_findings *found, const char *output);
bool cli_findings_print_json(const cli_findings *found);

#endif
