/* The keys under `place` of a scene. */
#include "keys/blocks.h"

static const char *const words_objective[] = {"area_per_water", "min_water", "max_coverage", NULL};
static const char *const words_refine[] = {"none", NULL};

#define TILT                                                                                                           \
    {                                                                                                                  \
        .name = "tilt", .kind = SP_KEY_QUANTITY, .dimension = &sp_angle_unit, .range = SP_BETWEEN(0, M_PI),            \
        .standard = "0 deg", .says = "How far a nozzle's axis may lean from the mount's; 180 deg is any direction"     \
    }
#define NAME                                                                                                           \
    {                                                                                                                  \
        .name = "name", .kind = SP_KEY_TEXT, .absent = "none",                                                         \
        .says = "By which alternatives and the sheet call it. No two mounts the same"                                  \
    }
#define MOST                                                                                                           \
    {                                                                                                                  \
        .name = "max_nozzles", .kind = SP_KEY_COUNT, .range = SP_BETWEEN(1, SP_MAX_ITEMS), .absent = "any number",     \
        .says = "How many nozzles this mount takes besides kept ones"                                                  \
    }
#define COST                                                                                                           \
    {                                                                                                                  \
        .name = "cost", .kind = SP_KEY_TEXT, .absent = "nothing",                                                      \
        .says = "What each nozzle placed here must save to be worth its weld or fitting: water, such as 3 L/min, or "  \
                "money, such as "                                                                                      \
                "900 EUR, with what water is worth in `water_cost`"                                                    \
    }

static const sp_key place_keys[] = {
    {.name = "objective",
     .kind = SP_KEY_CHOICE,
     .words = words_objective,
     .standard = "area_per_water",
     .says = "What the best layout is: most covered area per water among those that reach `coverage`; least water that "
             "reaches it; "
             "most coverage within the limits. Where none reaches it the first two take the least water that covers "
             "within a tenth of a point of the most found"},
    {.name = "coverage",
     .kind = SP_KEY_QUANTITY,
     .dimension = &sp_share_unit,
     .range = SP_ABOVE_TO(0, 1),
     .standard = "99 %",
     .says = "What a layout has to cover of the area to be cleaned. Where less is attainable: that share of what is, "
             "and exit status 4"},
    {.name = "max_nozzles",
     .kind = SP_KEY_COUNT,
     .range = SP_BETWEEN(1, SP_MAX_ITEMS),
     .absent = "any number",
     .says = "Of a layout, kept nozzles included"},
    {.name = "max_water",
     .kind = SP_KEY_QUANTITY,
     .dimension = &sp_flow_unit,
     .range = SP_ABOVE(0),
     .absent = "any amount",
     .says = "Of all nozzles together, kept ones included"},
    {.name = "types", .kind = SP_KEY_TEXTS, .absent = "all of the catalogue", .says = "Names of types to choose from"},
    {.name = "pressure",
     .kind = SP_KEY_QUANTITIES,
     .dimension = &sp_pressure_unit,
     .range = SP_ABOVE(0),

     .says = "At which nozzles are placed, needed beside `mounts`; each of several may be chosen for each nozzle"},
    {.name = "clearance",
     .kind = SP_KEY_QUANTITY,
     .dimension = &sp_length_unit,
     .range = SP_FROM(0),
     .standard = "0",
     .says = "From a nozzle's position to any surface but the part of its mount, of a port the part nearest to it"},
    {.name = "mounts",
     .kind = SP_KEY_BLOCKS,
     .block = &sp_block_mount,
     .absent = "none",
     .says = "Where nozzles may be mounted"},
    {.name = "refine",
     .kind = SP_KEY_BLOCK,
     .block = &sp_block_refine,
     .words = words_refine,
     .absent = "each key has its own default",
     .says = "How far refinement may move each nozzle from its candidate pose; never out of its mount or its type's "
             "ranges"},
    {.name = "alternatives",
     .kind = SP_KEY_BLOCKS,
     .block = &sp_block_alternative,
     .absent = "none",
     .says = "Up to 12 ways to build it, worked out in one run and set side by side: what an alternative does not say "
             "is as above"},
    {.name = "water_cost",
     .kind = SP_KEY_TEXT,
     .absent = "costs are given as water",
     .says = "What water is worth, such as 40 EUR per L/min, for the whole life of the plant; a currency has three "
             "letters"},
    {.name = NULL}};
const sp_block sp_block_place = {"place", "the placement", NULL, place_keys};

static const sp_key refine_keys[] = {
    {.name = "position",
     .kind = SP_KEY_QUANTITY,
     .dimension = &sp_length_unit,
     .range = SP_FROM(0),
     .absent = "half of the mount's spacing, on a surface all of it",
     .says = "Along each axis that the mount leaves free"},
    {.name = "axis",
     .kind = SP_KEY_QUANTITY,
     .dimension = &sp_angle_unit,
     .range = SP_BETWEEN(0, M_PI),
     .standard = "15 deg",
     .says = "Where it points"},
    {.name = "roll", .kind = SP_KEY_FLAG, .standard = "true", .says = "Whether a fan may be turned about its axis"},
    {.name = "angle",
     .kind = SP_KEY_QUANTITY,
     .dimension = &sp_angle_unit,
     .range = SP_BETWEEN(0, 2 * M_PI),
     .absent = "the type's whole `angle_range`",
     .says = "Of a type with `angle_range`"},
    {.name = "flow",
     .kind = SP_KEY_QUANTITY,
     .dimension = &sp_share_unit,
     .range = SP_FROM(0),
     .absent = "the type's whole `flow_range`",
     .says = "Of a type with `flow_range`, as a share of its flow"},
    {.name = NULL}};
const sp_block sp_block_refine = {"refine", "refinement", NULL, refine_keys};

static const sp_key mount_keys[] = {
    {.name = "port",
     .kind = SP_KEY_BLOCK,
     .block = &sp_block_port,
     .says = "A fitting that is there, for one nozzle, perhaps on a lance"},
    {.name = "surface",
     .kind = SP_KEY_BLOCK,
     .block = &sp_block_surface,
     .says = "Points on a surface, where a nozzle may be welded in"},
    {.name = "line", .kind = SP_KEY_BLOCK, .block = &sp_block_line, .says = "Points along a line, such as a spray bar"},
    {.name = "box",
     .kind = SP_KEY_BLOCK,
     .block = &sp_block_box,
     .says = "Points in a box, such as a frame over a belt"},
    {.name = NULL}};
const sp_block sp_block_mount = {"mount", "a mount", "Just one of these keys", mount_keys};

static const sp_key port_keys[] = {
    {.name = "name", .kind = SP_KEY_TEXT, .required = true, .says = "No two mounts the same"},
    {.name = "position",
     .kind = SP_KEY_VECTOR,
     .required = true,
     .dimension = &sp_length_unit,
     .says = "Its mouth, from which depths count"},
    {.name = "axis", .kind = SP_KEY_DIRECTION, .absent = "down", .says = "Into the vessel"},
    TILT,
    {.name = "depth",
     .kind = SP_KEY_BLOCK,
     .block = &sp_block_depth,
     .absent = "0",
     .says = "How far along its axis a lance may reach"},
    {.name = "types", .kind = SP_KEY_TEXTS, .absent = "all that are to choose from", .says = "Names of types that fit"},
    {.name = "bore",
     .kind = SP_KEY_QUANTITY,
     .dimension = &sp_length_unit,
     .range = SP_ABOVE(0),
     .absent = "every type passes",
     .says = "Its width: types whose `body` is wider are not offered here, and a nozzle of one is refused"},
    {.name = "step",
     .kind = SP_KEY_BLOCK,
     .block = &sp_block_lance_step,
     .absent = "anything can be set",
     .says = "How far apart settings of the lance lie, which proposals keep to"},
    COST,
    {.name = NULL}};
const sp_block sp_block_port = {"port", "a port", NULL, port_keys};

static const sp_key depth_keys[] = {
    {.name = "from",
     .kind = SP_KEY_QUANTITY,
     .dimension = &sp_length_unit,
     .range = SP_FROM(0),
     .standard = "0",
     .says = "The least"},
    {.name = "to",
     .kind = SP_KEY_QUANTITY,
     .required = true,
     .dimension = &sp_length_unit,
     .range = SP_FROM(0),
     .says = "The most"},
    {.name = "spacing",
     .kind = SP_KEY_QUANTITY,
     .dimension = &sp_length_unit,
     .range = SP_ABOVE(0),

     .says = "Between depths that are tried first, needed where the two differ; refinement moves between"},
    {.name = NULL}};
const sp_block sp_block_depth = {"depth", "a lance", NULL, depth_keys};

static const sp_key lance_step_keys[] = {{.name = "depth",
                                          .kind = SP_KEY_QUANTITY,
                                          .dimension = &sp_length_unit,
                                          .range = SP_FROM(1e-6),
                                          .absent = "any depth",
                                          .says = "Depths, from the least on"},
                                         {.name = "tilt",
                                          .kind = SP_KEY_QUANTITY,
                                          .dimension = &sp_angle_unit,
                                          .range = SP_FROM(1e-6),
                                          .absent = "any tilt",
                                          .says = "Tilts from the port's axis"},
                                         {.name = NULL}};
const sp_block sp_block_lance_step = {"lance_step", "a step", NULL, lance_step_keys};

static const sp_key surface_keys[] = {
    {.name = "geometry",
     .kind = SP_KEY_COUNT,
     .required = true,
     .range = SP_BETWEEN(0, SP_MAX_ITEMS - 1),
     .says = "Which of the scene's geometry, from 0"},
    {.name = "part", .kind = SP_KEY_TEXT, .absent = "all parts", .says = "The name of a part of it"},
    {.name = "spacing",
     .kind = SP_KEY_QUANTITY,
     .required = true,
     .dimension = &sp_length_unit,
     .range = SP_ABOVE(0),
     .says = "Between points that are tried first; refinement moves between"},
    {.name = "standoff",
     .kind = SP_KEY_QUANTITY,
     .dimension = &sp_length_unit,
     .range = SP_FROM(0),
     .standard = "0",
     .says = "From the surface to the tip, along the normal, which is the mount's axis"},
    TILT,
    NAME,
    MOST,
    COST,
    {.name = NULL}};
const sp_block sp_block_surface = {"surface", "a surface", NULL, surface_keys};

#define SPACING                                                                                                        \
    {                                                                                                                  \
        .name = "spacing", .kind = SP_KEY_QUANTITY, .dimension = &sp_length_unit, .range = SP_ABOVE(0),                \
        .says = "Between points that are tried first, ends included; needed where there is more than a point. "        \
                "Refinement moves between"                                                                             \
    }
#define AXIS                                                                                                           \
    {                                                                                                                  \
        .name = "axis", .kind = SP_KEY_DIRECTION, .absent = "down", .says = "What nozzles lean from"                   \
    }
#define CORNER(key, what)                                                                                              \
    {                                                                                                                  \
        .name = key, .kind = SP_KEY_VECTOR, .required = true, .dimension = &sp_length_unit, .says = what               \
    }

static const sp_key line_keys[] = {
    CORNER("from", "One end"), CORNER("to", "The other"), SPACING, AXIS, TILT, NAME, MOST, COST, {.name = NULL}};
const sp_block sp_block_line = {"line", "a line", NULL, line_keys};

static const sp_key box_keys[] = {CORNER("min", "The corner of least coordinates"),
                                  CORNER("max", "The corner of greatest; a box may be flat"),
                                  SPACING,
                                  AXIS,
                                  TILT,
                                  NAME,
                                  MOST,
                                  COST,
                                  {.name = NULL}};
const sp_block sp_block_box = {"box", "a box", NULL, box_keys};

static const sp_key alternative_keys[] = {
    {.name = "name",
     .kind = SP_KEY_TEXT,
     .required = true,
     .says = "No two the same, and none of manual, greedy, proposed"},
    {.name = "mounts",
     .kind = SP_KEY_NAMED_BLOCKS,
     .block = &sp_block_limited_mount,
     .absent = "all",
     .says = "Names of mounts of `place`, or such a name with a limit"},
    {.name = "types", .kind = SP_KEY_TEXTS, .absent = "those of `place`", .says = "Names of types to choose from"},
    {.name = "pressure",
     .kind = SP_KEY_QUANTITIES,
     .dimension = &sp_pressure_unit,
     .range = SP_ABOVE(0),
     .absent = "as `place` has it",
     .says = "One or several to choose from"},
    {.name = "max_nozzles",
     .kind = SP_KEY_COUNT,
     .range = SP_BETWEEN(1, SP_MAX_ITEMS),
     .absent = "as `place` has it",
     .says = "Of a layout"},
    {.name = "max_water",
     .kind = SP_KEY_QUANTITY,
     .dimension = &sp_flow_unit,
     .range = SP_ABOVE(0),
     .absent = "as `place` has it",
     .says = "Of all nozzles together"},
    {.name = NULL}};
const sp_block sp_block_alternative = {"alternative", "an alternative", NULL, alternative_keys};

static const sp_key limited_mount_keys[] = {
    {.name = "mount", .kind = SP_KEY_TEXT, .required = true, .says = "The name of a mount of `place`, no port"},
    {.name = "max_nozzles",
     .kind = SP_KEY_COUNT,
     .required = true,
     .range = SP_BETWEEN(1, SP_MAX_ITEMS),
     .says = "How many nozzles it takes here, besides kept ones"},
    {.name = NULL}};
const sp_block sp_block_limited_mount = {"limited_mount", "a mount with a limit", NULL, limited_mount_keys};
