/* Results: figures as JSON and CSV, and folders of files that appear whole or not at all. */
#ifndef SPRAYPLAN_RESULT_H
#define SPRAYPLAN_RESULT_H

#include <sprayplan/place.h>
#include <sprayplan/scene.h>

#ifdef __cplusplus
extern "C" {
#endif

/* One layout and what it does, on its own evaluator. Everything is borrowed. */
typedef struct {
    const char *name; /* "manual", "greedy", "proposed", or a file's name when comparing */
    const sp_evaluator *evaluator;
    const sp_layout *layout;
    const sp_coverage *coverage;
} sp_design;

/* What a command found. Everything is borrowed. designs[0] is not special; pictures and layout.yaml are for the design named
 * "proposed", or the only one. */
typedef struct {
    const char *command; /* "simulate", "place", "compare" */
    const char *scene;   /* the scene's path as given; for compare the first */
    size_t design_count;
    const sp_design *designs;
    const sp_proposal *proposal; /* NULL unless the command is place */
    size_t stage_count;          /* stages besides the proposal's own, in order: "load", "atlas", ... */
    const sp_stage *stages;
} sp_result;

/* result.json as DESIGN §6. Malloc'd text, newline at the end, the caller frees. */
char *sp_result_json(const sp_result *result, sp_error *error);
/* nozzles.csv: one row a nozzle of `layout`: name,type,x_m,y_m,z_m,axis_x,axis_y,axis_z,roll_deg,angle_deg,pressure_bar,
 * flow_l_min,speed_m_s. Malloc'd. */
char *sp_nozzles_csv(const sp_layout *layout, const sp_fluid *liquid, sp_error *error);

/* A set of files that is written whole or not at all: each goes to a temporary name in `directory` (created where missing,
 * parents not), and commit renames them all; discard removes them. An existing file is replaced only by commit. */
typedef struct sp_output sp_output;
sp_output *sp_output_open(const char *directory, sp_error *error);
/* A path to write `name` to; owned by the output. */
const char *sp_output_path(sp_output *output, const char *name, sp_error *error);
bool sp_output_text(sp_output *output, const char *name, const char *text, sp_error *error);
bool sp_output_bytes(sp_output *output, const char *name, const void *bytes, size_t size, sp_error *error);
/* Both end the output; NULL is accepted. */
bool sp_output_commit(sp_output *output, sp_error *error);
void sp_output_discard(sp_output *output);

#ifdef __cplusplus
}
#endif
#endif
