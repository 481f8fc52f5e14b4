/* The evaluator as a page runs it: handed what another evaluator found as plain arrays, asked for a layout again and
 * again, of which it traces only what has changed. Built for WebAssembly the functions marked here are what a page
 * calls; nothing is kept but in the handle. */
#ifndef LIVE_LIVE_H
#define LIVE_LIVE_H

#include <sprayplan/evaluator.h>

#ifdef __wasm__
#define SP_LIVE(name) __attribute__((export_name(#name))) name
#else
#define SP_LIVE(name) name
#endif

typedef struct sp_live sp_live;

/* What is handed over, by name; sizes follow from the bytes. */
typedef enum {
    SP_LIVE_SETTINGS,    /* double [SP_LIVE_SETTING_COUNT], by sp_live_setting */
    SP_LIVE_VERTICES,    /* double [vertices][3], m */
    SP_LIVE_TRIANGLES,   /* uint32_t [triangles][3] */
    SP_LIVE_PARTS,       /* uint32_t [triangles] */
    SP_LIVE_CLEAN,       /* uint8_t [parts] */
    SP_LIVE_NAMES,       /* char, the parts' names, each ended by 0 */
    SP_LIVE_CHARTS,      /* uint32_t [triangles] */
    SP_LIVE_UV,          /* double [triangles][3][2], as sp_atlas */
    SP_LIVE_CHART_PAGE,  /* uint32_t [charts] */
    SP_LIVE_CHART_TEXEL, /* double [charts], m */
    SP_LIVE_SIDES,       /* uint8_t [triangles], as sp_wet_arrays, as the next two */
    SP_LIVE_NODES,       /* uint8_t */
    SP_LIVE_CUTS,        /* double [][3] */
    SP_LIVE_TYPES,       /* double [types][SP_LIVE_TYPE_NUMBERS], see numbers.h */
    SP_LIVE_MEMBERS,     /* double [members][SP_LIVE_MEMBER_NUMBERS] */
    SP_LIVE_NOZZLES,     /* double [nozzles][SP_LIVE_NOZZLE_NUMBERS] */
    SP_LIVE_ARRAYS,
} sp_live_array;

typedef enum {
    SP_LIVE_DENSITY,      /* kg/m³ */
    SP_LIVE_UP_IS_Y,      /* 0: z */
    SP_LIVE_GRAVITY,      /* m/s² */
    SP_LIVE_FLUX,         /* m/s, of the criterion, as what follows */
    SP_LIVE_IMPACT_SPEED, /* m/s */
    SP_LIVE_INCIDENCE,    /* rad */
    SP_LIVE_SINGLE,       /* 0: nozzles add up */
    SP_LIVE_PARABOLA,     /* 0: lines */
    SP_LIVE_TEXEL,        /* m */
    SP_LIVE_CAVITY,       /* sp_cavity_kind */
    SP_LIVE_CAVITY_X,     /* m */
    SP_LIVE_CAVITY_Y,
    SP_LIVE_CAVITY_Z,
    SP_LIVE_ORIGIN_X, /* m, as sp_setup */
    SP_LIVE_ORIGIN_Y,
    SP_LIVE_ORIGIN_Z,
    SP_LIVE_PAGE_EDGE,
    SP_LIVE_PAGE_COUNT,
    SP_LIVE_SETTING_COUNT,
} sp_live_setting;

/* What comes of a layout. */
typedef enum {
    SP_LIVE_FIGURES,         /* double [SP_LIVE_FIGURE_COUNT], by sp_live_figure */
    SP_LIVE_PATCH_FLUX,      /* double [patches], as sp_deposits, as what follows */
    SP_LIVE_PATCH_SPEED,     /* double [patches] */
    SP_LIVE_PATCH_INCIDENCE, /* double [patches] */
    SP_LIVE_PATCH_IMPACT,    /* double [patches] */
    SP_LIVE_PATCH_SHARE,     /* double [patches] */
    SP_LIVE_SHADOW_LIST,     /* double [shadows][SP_LIVE_SHADOW_NUMBERS]: area, place, part, lack */
    SP_LIVE_SHADOW_OF,       /* uint32_t [patches], as sp_shadow_numbers */
    SP_LIVE_BOXES,           /* double [sp_live_boxes][6], as sp_tracer_leaves */
    SP_LIVE_LEGS,            /* double [sp_live_fly][SP_LIVE_LEG_NUMBERS]: from, to, rise and bounce of sp_path_leg */
} sp_live_result;
#define SP_LIVE_LEG_NUMBERS 8
#define SP_LIVE_SHADOW_NUMBERS 6
#define SP_LIVE_SHADOWS 10 /* the largest are reported */

typedef enum {
    SP_LIVE_COVERAGE,     /* a fraction */
    SP_LIVE_COVERED,      /* m² */
    SP_LIVE_FLOW,         /* m³/s */
    SP_LIVE_PATCHES,      /* how many there are */
    SP_LIVE_SHADOW_COUNT, /* in the list */
    SP_LIVE_TRACED,       /* nozzles that were traced for it */
    SP_LIVE_FIGURE_COUNT,
} sp_live_figure;

/* NULL where memory runs out. */
sp_live *SP_LIVE(sp_live_create)(void);
/* Accepts NULL. */
void SP_LIVE(sp_live_destroy)(sp_live *live);
/* Room for an array, the handle's, all 0; what it had before is gone. NULL where memory runs out. */
void *SP_LIVE(sp_live_hand_over)(sp_live *live, sp_live_array which, size_t bytes);
/* Makes the evaluator of what was handed over, types included. False with the handle's error. */
bool SP_LIVE(sp_live_open)(sp_live *live);
/* Evaluates the nozzles handed over, their order being who is who from one call to the next, on one patch in
 * stride², each standing for those beside it. */
bool SP_LIVE(sp_live_evaluate)(sp_live *live, unsigned stride);
/* Finds out all that a nozzle that was evaluated may reach from where it is, so that turning it traces nothing: takes
 * a few times as long as moving it, and is done ahead. */
bool SP_LIVE(sp_live_prepare)(sp_live *live, size_t index);
/* Finds the shadows of what was evaluated last. */
bool SP_LIVE(sp_live_find_shadows)(sp_live *live);
/* Whether nozzle `index` of those handed over can stand where it is (sp_evaluator_admits). */
bool SP_LIVE(sp_live_admits)(sp_live *live, size_t index);
/* The point of a part's surface (SP_NONE: of any) nearest to one: its place and its normal towards the liquid, double
 * [6], the handle's. NULL where the part has no triangle. */
const double *SP_LIVE(sp_live_foot)(sp_live *live, uint32_t part, double x, double y, double z);
/* Finds the boxes of the accelerator's leaves; how many there are, 0 where memory runs out. */
size_t SP_LIVE(sp_live_boxes)(sp_live *live);
/* Flies a few jets of nozzle `index` of those handed over, as sp_paths_fly; how many legs they have, 0 where it is off
 * or memory runs out. */
size_t SP_LIVE(sp_live_fly)(sp_live *live, size_t index);
const void *SP_LIVE(sp_live_tell)(sp_live *live, sp_live_result what);
/* What nozzle `index` brings by itself to each patch, m/s. NULL while it is off or new. */
const double *SP_LIVE(sp_live_alone)(sp_live *live, size_t index);
/* Why the last call failed. */
const char *SP_LIVE(sp_live_error)(sp_live *live);

#endif
