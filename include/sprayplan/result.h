/* Results: figures as JSON and CSV, and folders of files that appear whole or not at all. */
#ifndef SPRAYPLAN_RESULT_H
#define SPRAYPLAN_RESULT_H

#include <sprayplan/export.h>
#include <sprayplan/image.h>
#include <sprayplan/fitting.h>
#include <sprayplan/place.h>
#include <sprayplan/scene.h>
#include <sprayplan/tracks.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The figures of one layout, as result.json holds them but in SI units. Reals that were not computed are NAN, counts
 * that are not known SP_UNKNOWN, texts "". Texts are valid UTF-8. */
#define SP_UNKNOWN SIZE_MAX

/* What one more nozzle could do for a shadow, as sp_remedy. */
typedef struct {
    bool known;       /* false: it was not looked for, and nothing below means anything */
    char *type;       /* owned; "" where no candidate covers any of it */
    char *port;       /* owned; "" where it sits in none */
    sp_vec3 position; /* m */
    double area;      /* m² of the shadow */
    double flow;      /* m³/s */
} sp_remedy_figures;

typedef struct {
    double area;      /* m² */
    sp_vec3 centroid; /* m */
    char *part;       /* owned */
    int reachable;    /* 1 where most of it is attainable, 0 where not, -1: not known */
    sp_reason reason; /* where not, of most of what is not attainable of it; else unknown */
    sp_lack lack;     /* what liquid the layout brings there lacks; SP_LACK_NOTHING: not known */
    char *nozzle; /* owned; of the layout, that alone brings it most liquid; "" where none does or it is not known */
    sp_remedy_figures remedy;
} sp_shadow_figures;

/* One part that is to be cleaned. */
typedef struct {
    char *part;           /* owned */
    double area, covered; /* m² */
} sp_part_figures;

/* Share of the surface to be cleaned, from which on it is reported that area lies beyond the allowed nozzles: less is
 * no more than texels at edges. */
#define SP_BEYOND_TOLD 0.005

/* What of one part is not attainable. */
typedef struct {
    char *part;               /* owned */
    double area;              /* m², of all reasons */
    double areas[SP_REASONS]; /* m², by reason */
} sp_missing_figures;

typedef struct {
    char *name, *type;                         /* owned */
    char *order_code, *url;                    /* owned; of its type */
    char *overlap;                             /* owned; as sp_layout_overlap says, "" for none */
    sp_vec3 position;                          /* m */
    sp_vec3 axis;                              /* unit */
    double roll, angle, pressure, flow, speed; /* rad, rad (sp_nozzle_cone), Pa, m³/s, m/s */
    double alone, lost;                        /* m², as sp_contributions */
    double cost;                               /* m³/s, of its mount; unknown where no mount costs anything */
    bool fitting;                              /* of an alternative: wants a fitting made for it, as sp_proposal */
    sp_track_gaps tracks;                      /* of a two-axis head */
} sp_nozzle_figures;

typedef struct {
    char *name; /* owned */
    size_t triangles;
    double area, clean_area;            /* of the geometry, m² */
    double attainable_area;             /* m², with whatever a reported layout covers */
    double beyond_area;                 /* m² of that which a reported layout covers and no allowed nozzle reaches */
    double missing_area[SP_REASONS];    /* m² that are not attainable, by reason */
    size_t missing_count;               /* of parts that are not wholly attainable */
    sp_missing_figures *missing;        /* owned; those of most area first */
    bool criterion_known;               /* false: nothing in `criterion` means anything */
    sp_criterion criterion;             /* what was asked for */
    char trajectory[16], evaluator[16]; /* "line", "parabola" or "drag"; "forward" or "inverse" */
    size_t reflections, jets;           /* jets: per nozzle, unknown for the inverse evaluator */
    size_t jets_wanted;                 /* per nozzle, where they are fewer; else unknown */
    double texel;                       /* m */
    double error_estimate, misjudged;   /* of this layout, as sp_measured_error */
    double error_bound;                 /* of flying along lines, as sp_line_error */
    double borderline;                  /* m², as sp_borderline */
    double flow, covered_area;          /* m³/s, m² */
    double coverage, of_attainable;     /* fractions */
    double area_per_water;              /* m² per m³/s */
    double flux_min, flux_mean, flux_p05, flux_max; /* m³/s per m² */
    double pass; /* s, over which goods that move pass, and these are means: times it they are doses; NAN: none move */
    double landed_clean, landed_other, left, unfollowed; /* m³/s, as sp_balance */
    sp_film_balance film;                                /* as sp_coverage */
    bool shadows_known;                                  /* false: there may be some though none is here */
    size_t shadow_count;                                 /* at most SP_SHADOWS_KEPT, largest first */
    sp_shadow_figures *shadows;                          /* owned */
    size_t nozzle_count;
    sp_nozzle_figures *nozzles; /* owned */
    size_t fittings;            /* nozzles that want one; unknown but of alternatives */
    double mount_cost;          /* m³/s, of all its nozzles; unknown where no mount costs anything */
    sp_water_cost water_cost;   /* as sp_design */
    size_t part_count;
    sp_part_figures *parts; /* owned; those that are to be cleaned, in the mesh's order */
} sp_figures;

#define SP_SHADOWS_KEPT 100

/* The name of a reason in result.json, "no_line_of_reach" for instance; NULL for attainable and unknown. */
SP_API const char *sp_reason_key(sp_reason reason);
/* The same for readers, "no line of reach", by what was asked for. */
SP_API const char *sp_reason_text(const sp_figures *figures, sp_reason reason);
/* The name of a lack in result.json, "no_nozzle_in_reach" for instance; NULL for none. */
SP_API const char *sp_lack_key(sp_lack lack);
/* The same for readers, "no nozzle in reach". */
SP_API const char *sp_lack_text(sp_lack lack);
/* Index in `missing` of the part of which the reason keeps most out of reach, of equal ones the first; given one such
 * index as `last`, of the next; SP_UNKNOWN before the first and after the last. */
SP_API size_t sp_missing_next(const sp_figures *figures, sp_reason reason, size_t last);
/* How many parts come after that one in this order, SP_UNKNOWN being before the first, and in *area what the reason
 * keeps out of reach of them together, m². */
SP_API size_t sp_missing_after(const sp_figures *figures, sp_reason reason, size_t last, double *area);

/* What a layout costs: water and mounts, m³/s, and in the currency of its water_cost; NAN where that is not known. */
SP_API double sp_figures_price(const sp_figures *figures);
SP_API double sp_figures_money(const sp_figures *figures);
/* Whether two layouts are of one surface, by its triangles and, up to round-off, its areas. */
SP_API bool sp_same_surface(const sp_figures *a, const sp_figures *b);
/* Whether the figures say on which surface the layout is; whether all that say so are on the same one. */
SP_API bool sp_figures_tell_surface(const sp_figures *figures);
SP_API bool sp_figures_share_surface(const sp_figures *figures, size_t count);
/* Whether all were counted on texels of one length, up to round-off, apart from those that give none. */
SP_API bool sp_figures_share_texel(const sp_figures *figures, size_t count);
/* Whether the same was asked of both layouts, up to round-off, or of neither it is known what; whether that holds of
 * all of them. */
SP_API bool sp_same_criterion(const sp_figures *a, const sp_figures *b);
SP_API bool sp_figures_share_criterion(const sp_figures *figures, size_t count);
/* Whether nothing is asked of how much arrives, so that one nozzle more would do where what it brings is as asked. */
SP_API bool sp_figures_ask_no_amount(const sp_figures *figures);
/* What was asked for, as a clause of plain text: "at least 1 L/min/m2, at least 2 m/s"; "not told" where it is not. */
#define SP_CRITERION_TEXT 200
SP_API void sp_criterion_clause(const sp_figures *figures, char text[SP_CRITERION_TEXT]);
/* Accepts NULL. */
SP_API void sp_figures_destroy(sp_figures *figures, size_t count);

/* Reads the layouts of a result.json, which may come from a stranger: every key, type, range and length is checked, and
 * an error names the file and the key's path (syntax errors: line and column). Keys that no result.json of this
 * version has are ignored. Returns *count figures, destroyed by the caller. */
SP_API sp_figures *sp_figures_read(const char *path, size_t *count, sp_error *error);

/* One layout and what it does, on its own evaluator; or only figures of one (read from a result.json), the evaluator,
 * layout and coverage then being NULL: it has rows in tables but no pictures. Everything is borrowed. */
typedef struct {
    const char *name; /* "manual", "greedy", "proposed", or a file's name when comparing */
    const sp_evaluator *evaluator;
    const sp_layout *layout;
    const sp_coverage *coverage;
    const sp_figures *figures;             /* NULL where there is an evaluator; what several designs show that are the
                                            * same nozzles is one list of nozzles */
    const sp_contributions *contributions; /* of its nozzles; NULL where they were not worked out */
    const sp_mount *mounts;                /* [mount_count], that its nozzles may sit on; NULL for none */
    size_t mount_count;
    const double *costs;            /* [layout->count], m³/s; NULL: those of the mounts that its nozzles lie on */
    size_t remedy_count;            /* of its shadows, the largest first */
    const sp_remedy *remedies;      /* [remedy_count] */
    sp_water_cost water_cost;       /* none where a scene gives none */
    const sp_proposal *alternative; /* that it is, where a scene asks for alternatives; NULL elsewhere */
} sp_design;

/* A file that was read. */
#define SP_SHA256 65 /* hexadecimal digits, and the terminating zero */
typedef struct {
    const char *path; /* as it was opened, borrowed */
    char sha256[SP_SHA256];
} sp_input;
/* The SHA-256 of a file's bytes (FIPS 180-4). False with an error of the file where it cannot be read. */
SP_API bool sp_file_sha256(const char *path, char sha256[SP_SHA256], sp_error *error);

/* What may be changed in a page that evaluates layouts itself. Everything is borrowed. */
typedef struct {
    sp_place_options options; /* mounts, types and pressures to choose from */
    const char *scene;        /* a scene (sp_scene_text) in place of whose nozzles others may be written */
} sp_editing;

/* What a command found. Everything is borrowed. designs[0] is not special; pictures and layout.yaml are for the design
 * named "proposed", or of alternatives that of `proposal`, or the only one. */
typedef struct {
    const char *command; /* "simulate", "place", "compare" */
    const char *scene;   /* the scene's path as given; for compare the first */
    size_t design_count;
    const sp_design *designs;
    const sp_proposal *proposal; /* NULL unless the command is place; of alternatives the best */
    size_t stage_count;          /* stages besides the proposal's own, in order: "load", "atlas", ... */
    const sp_stage *stages;
    size_t input_count; /* files that were read; 0: not known */
    const sp_input *inputs;
    /* For the page's foot alone, so that result.json is the same of the same scene: the command as it was given, and
     * when. NULL: not known. */
    const char *command_line, *date;
    /* What there was no time for besides stages of the placement, in words of plain text: "the error of greedy". */
    size_t left_out_count;
    const char *const *left_out;
    /* Edge of the page's pictures, of what is best; 0: all of it. Below 0: no pictures, nor anything else that shows
     * patches: the page has no viewer, and of other files there are tables, nozzles and layouts alone. */
    double picture_share;
    sp_picture_style style;    /* of the pictures and models of all designs */
    const sp_editing *editing; /* NULL: the page evaluates no other layouts */
} sp_result;

/* The proposal that speaks of design `index`: the alternative that it is, or the result's. NULL where there is none. */
SP_API const sp_proposal *sp_result_proposal(const sp_result *result, size_t index);
/* True where the result is of alternatives. */
SP_API bool sp_result_has_alternatives(const sp_result *result);
/* True where mounts of what was placed cost something, so that prices decide, not water alone. */
SP_API bool sp_result_is_costly(const sp_result *result);
/* The design whose layout the result's proposal is; SP_UNKNOWN where there is none. */
SP_API size_t sp_result_proposed(const sp_result *result);
/* Why that is proposed and not another alternative, as a clause of plain text; "" without alternatives. */
#define SP_CHOICE_TEXT 160
SP_API void sp_result_choice(const sp_result *result, char text[SP_CHOICE_TEXT]);

/* What layouts were looked for within, as a clause of plain text: "2 nozzles (max_nozzles) and 40 L/min (max_water)";
 * "" without such limits. */
#define SP_LIMITS_TEXT 120
SP_API void sp_limits_clause(const sp_proposal *proposal, char text[SP_LIMITS_TEXT]);

/* Whether the limits of a proposal allow so many nozzles with so much water, m³/s. */
SP_API bool sp_limits_allow(const sp_proposal *proposal, size_t nozzles, double flow);
/* Whether the proposal is more nozzles, or takes more water, than these limits allow: the nozzles to keep are. */
SP_API bool sp_exceeds_limits(const sp_proposal *proposal);

/* Whether the proposal was to cover most and takes less water than is allowed: bounds on layouts of as much water then
 * do not tell how near to the best it is. False where every layout was looked at, or the bound is the whole surface. */
SP_API bool sp_allows_more_water(const sp_proposal *proposal);

/* Where the scene's own nozzles ("manual"), within the limits, are better than the proposal by its objective, that they
 * are and why, as a sentence of plain text; "" elsewhere. `figures` are all designs'. */
#define SP_OWN_TEXT 160
SP_API void sp_result_own_better(const sp_result *result, const sp_figures *figures, char text[SP_OWN_TEXT]);
/* True where the coverage of the layouts counts liquid that walls throw back, which search and certificate do not. */
SP_API bool sp_result_counts_thrown_back(const sp_result *result);

/* Decimals to show a value with: `least`, or as many more as give it `digits` significant digits, 9 at most. `least`
 * for what is not finite, or rounds to 0 with all 9. */
SP_API int sp_told_decimals(double value, int least, int digits);
/* Decimals of places in m, and of areas in m², of the geometry that a layout is in: `least` where its surface to be
 * cleaned is 1 m² or more, and of less as many more as show places and areas on it as exactly. */
SP_API int sp_place_decimals(const sp_figures *figures, int least);
SP_API int sp_area_decimals(const sp_figures *figures, int least);
/* The same of water in L/min: the tenth from 10 L/min on, three significant digits below. */
SP_API int sp_water_decimals(double l_min);
/* A proved lower bound of water, in L/min, rounded down to these decimals. */
SP_API double sp_water_at_least(double l_min);
/* `part` of `whole` as an upper bound: per cent, rounded up to two decimals but for round-off. */
SP_API double sp_percent_at_most(double part, double whole);

/* The figures of every design, in order [design_count]. With a proposal, attainable is what it calls attainable and
 * what any design on the same evaluator that it speaks of covers. The caller destroys. */
SP_API sp_figures *sp_result_figures(const sp_result *result, sp_error *error);

/* What was made of the geometry that an evaluator is on, in clauses of plain text (UTF-8) for readers. */
typedef struct {
    char text[360];
    bool doubtful; /* it is about what is not sound, or had to be mended */
} sp_geometry_clause;
#define SP_GEOMETRY_CLAUSES 12
/* Returns how many. */
SP_API size_t sp_geometry_clauses(const sp_evaluator *evaluator, sp_geometry_clause clauses[SP_GEOMETRY_CLAUSES]);

/* result.json, its keys as `sprayplan help result` has them; `geometry`, `criterion` and `fidelity` stand in each
 * layout where the designs differ in them, and where they differ in nothing but what is attainable, the rest of
 * `geometry` once more beside the layouts. Malloc'd text, newline at the end, the caller frees. */
SP_API char *sp_result_json(const sp_result *result, sp_error *error);
/* nozzles.csv: one row a nozzle of a sheet:
 * name,type,x_m,y_m,z_m,axis_x,axis_y,axis_z,roll_deg,angle_deg,pressure_bar,flow_l_min,speed_m_s,order_code,url,
 * in numbers that read as just these values where a scene has them with these units, the angle as sp_nozzle_cone gives
 * it, then what the sheet says, empty where that is nothing:
 * thread,insert,mounting,fitting,depth_mm,standoff_mm,fitting_x_mm,fitting_y_mm,fitting_height_mm,fitting_radius_mm,
 * fitting_azimuth_deg,tip_x_mm,tip_y_mm,tip_height_mm,tip_radius_mm,tip_azimuth_deg,tilt_deg,towards_deg,turn_deg,
 * circuit,circuit_l_min
 * with port, weld, line or box for the mounting, nothing for a nozzle on no mount, and circuits counted from 1.
 * A text that begins with =, +, -, @, a tab or a line's end has an apostrophe in front, so that no spreadsheet takes it
 * for a formula. Malloc'd. */
SP_API char *sp_nozzles_csv(const sp_fitting_sheet *sheet, sp_error *error);
/* The same of `count` sheets one after the other, with a column `layout` in front that holds their names. */
SP_API char *sp_all_nozzles_csv(const sp_fitting_sheet *const *sheets, const char *const *layouts, size_t count,
                                sp_error *error);
/* How a nozzle is mounted: port, weld, line, box or nothing. */
SP_API const char *sp_mounting_key(const sp_mount *mount);

/* A place to look at first. */
typedef struct {
    uint32_t patch;
    sp_vec3 place;    /* m, as they are written */
    const char *part; /* its name, borrowed of the mesh */
    double received;  /* what the criterion counts there (counted flux, or film), as a share of what it asks for; NAN
                       * where it asks for neither */
    double flux;      /* all that arrives, m³/s per m² */
    double speed, incidence; /* mean, m/s and rad; NAN where nothing arrives */
    sp_lack lack;
} sp_swab;
#define SP_SWABS 10
/* The worst places of a design with an evaluator, worst first: those that receive the least share of what the criterion
 * asks for, of equally bad ones those farthest from anything covered, counted in patches, 20 % of the geometry's
 * diagonal apart where they can be; no two nearer to each other than 5 %. */
SP_API bool sp_find_swabs(const sp_design *design, sp_swab swabs[SP_SWABS], size_t *count, sp_error *error);
/* swabs.csv: number,part,x_m,y_m,z_m,received_percent,flux_l_min_m2,speed_m_s,incidence_deg,lack. What is not known is
 * empty; texts as in nozzles.csv. Malloc'd. */
SP_API char *sp_swabs_csv(const sp_design *design, sp_error *error);

/* A set of files that is written whole or not at all: each goes to a folder .sprayplan-new-* in `directory`
 * (created where missing, with its parents), and commit moves them all; discard removes them. An existing file is
 * replaced only by commit, after all of the set is on the disk. Sets of several processes or threads do not mix: one
 * commit at a time, the others wait for up to 30 s. A process that is killed leaves the old files, or, killed while it
 * moves them, a folder .sprayplan-commit from which the next commit moves the rest. */
typedef struct sp_output sp_output;
SP_API sp_output *sp_output_open(const char *directory, sp_error *error);
/* Names a file that was read: asking for a path that would replace it then fails. A file that does not exist is no
 * error. */
SP_API bool sp_output_protect(sp_output *output, const char *path, sp_error *error);
/* The set is what a run has to say of a scene: commit removes what an earlier run left that is not replaced (figures,
 * pictures, models and pages, where the folder's result.json or study.json is ours, and with them layout.yaml and those
 * of alternatives, unless somebody has edited them). */
SP_API bool sp_output_supersede(sp_output *output, sp_error *error);
/* A path to write `name` (no slash in it) to; owned by the output. */
SP_API const char *sp_output_path(sp_output *output, const char *name, sp_error *error);
SP_API bool sp_output_text(sp_output *output, const char *name, const char *text, sp_error *error);
/* Where the error names a path that sp_output_path gave, it then names the file that was to be written in its place.
 * Both may be NULL. */
SP_API void sp_output_tell(const sp_output *output, sp_error *error);
SP_API bool sp_output_bytes(sp_output *output, const char *name, const void *bytes, size_t size, sp_error *error);
/* A scene for people to edit, as which it begins with the digest of all that follows: a file of that name which is not
 * as it was written that way is replaced only where `force` says so, and fails otherwise. */
SP_API bool sp_output_scene(sp_output *output, const char *name, const char *text, bool force, sp_error *error);
/* The same question before there is a text. */
SP_API bool sp_output_may_replace(sp_output *output, const char *name, bool force, sp_error *error);
/* The names asked for so far, in order; owned by the output. */
SP_API size_t sp_output_count(const sp_output *output);
SP_API const char *sp_output_name(const sp_output *output, size_t index);
/* Both end the output; NULL is accepted (commit then fails and keeps the error). Where a file cannot be moved, commit
 * puts back what it had replaced. */
SP_API bool sp_output_commit(sp_output *output, sp_error *error);
SP_API void sp_output_discard(sp_output *output);

#ifdef __cplusplus
}
#endif
#endif
