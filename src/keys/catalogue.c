/* The keys of a catalogue of nozzle types. */
#include "keys/blocks.h"

#include <sprayplan/nozzle.h>

enum { MOST_JETS = 16, MOST_TURNS = 1000000, MOST_TEETH = 1000 };

static const char *const words_pattern[] = {"full_cone", "hollow_cone", "flat_fan", "solid_stream",
                                            "cluster",   "rotating",    "measured", NULL};
static const char *const words_trajectory[] = {"auto", "line", "parabola", "drag", NULL};

/* What a type, a member of a cluster and a jet that turns spray. */
#define PATTERN(where)                                                                                                 \
    {                                                                                                                  \
        .name = "pattern", .kind = SP_KEY_CHOICE, .required = true, .words = words_pattern, .says = where              \
    }
#define ANGLE                                                                                                          \
    {                                                                                                                  \
        .name = "angle", .kind = SP_KEY_QUANTITY, .dimension = &sp_angle_unit, .range = SP_ABOVE_TO(0, 2 * M_PI),      \
        .absent = "1 deg of a solid_stream; others need it, but for cluster and rotating",                             \
        .says = "The whole opening angle, as catalogues print it; of a fan the wide one; of an image what its rows "   \
                "go up to"                                                                                             \
    }
#define HOLLOW                                                                                                         \
    {                                                                                                                  \
        .name = "hollow", .kind = SP_KEY_QUANTITY, .dimension = &sp_share_unit, .range = SP_FROM_BELOW(0, 1),          \
        .says = "Of a hollow_cone, which needs it: the angle of the dry middle as a share of `angle`"                  \
    }
#define THICKNESS                                                                                                      \
    {                                                                                                                  \
        .name = "thickness", .kind = SP_KEY_QUANTITY, .dimension = &sp_angle_unit, .range = SP_ABOVE_TO(0, M_PI),      \
        .says = "Of a flat_fan, which needs it: its narrow opening angle"                                              \
    }
#define IMAGE                                                                                                          \
    {                                                                                                                  \
        .name = "image", .kind = SP_KEY_TEXT,                                                                          \
        .says = "Of measured, which needs it: a file beside the catalogue (PNG, TIFF, OpenEXR, PFM): columns are "     \
                "azimuth from x towards y, rows "                                                                      \
                "polar angle from "                                                                                    \
                "the axis to half of `angle`, values liquid per solid angle in any measure at the centres of pixels, " \
                "interpolated between them. A second channel is "                                                      \
                "speed, as a share of "                                                                                \
                "the exit speed"                                                                                       \
    }

static const sp_key catalogue_keys[] = {
    {.name = "nozzles", .kind = SP_KEY_BLOCKS, .required = true, .block = &sp_block_type, .says = "The types"},
    {.name = NULL}};
const sp_block sp_block_catalogue = {"catalogue", "a catalogue",
                                     "A catalogue is a YAML file that scenes name under `catalogue`. Quantities are "
                                     "written as in scenes. Liquid is uniform per "
                                     "solid angle within a pattern's region, unless an image says otherwise",
                                     catalogue_keys};

static const sp_key type_keys[] = {
    {.name = "name", .kind = SP_KEY_TEXT, .required = true, .says = "By which scenes call it. No two the same"},
    PATTERN("What it sprays. cluster: several patterns on one body, such as a spray ball's holes. rotating: a jet that "
            "is turned; "
            "its mean over time. measured: an image"),
    ANGLE,
    HOLLOW,
    THICKNESS,
    {.name = "flow",
     .kind = SP_KEY_QUANTITIES,
     .required = true,
     .dimension = &sp_flow_unit,
     .range = SP_ABOVE(0),
     .says = "Of water, at `at`. At several pressures: a list, beside one of as many pressures, to which a power of "
             "the pressure is "
             "fitted; refused where that misses one by more than 10 %"},
    {.name = "at",
     .kind = SP_KEY_QUANTITIES,
     .required = true,
     .dimension = &sp_pressure_unit,
     .range = SP_ABOVE(0),
     .says = "The pressure difference at which it has that flow; of several the smallest first"},
    {.name = "exponent",
     .kind = SP_KEY_QUANTITY,
     .dimension = &sp_ratio_unit,
     .range = SP_ABOVE_TO(0, 1),
     .standard = "0.5",
     .says = "The power of the pressure by which flow grows; .46 for full cones with a vane. Not beside several flows, "
             "which tell it"},
    {.name = "cv",
     .kind = SP_KEY_QUANTITY,
     .dimension = &sp_ratio_unit,
     .range = SP_ABOVE_TO(0, 1),
     .standard = "0.95",
     .says = "Exit speed as a share of sqrt(2 pressure / density)"},
    {.name = "drop",
     .kind = SP_KEY_QUANTITY,
     .dimension = &sp_length_unit,
     .range = SP_ABOVE_TO(0, 0.5),
     .standard = "1 mm",
     .says = "The drops' diameter, which matters to drag alone"},
    {.name = "angle_range",
     .kind = SP_KEY_LIMITS,
     .dimension = &sp_angle_unit,
     .range = SP_ABOVE_TO(0, 2 * M_PI),
     .absent = "the angle cannot be set",
     .says = "Between which the angle can be set: only then refinement, or `angle` of a nozzle, changes it. Contains "
             "`angle`"},
    {.name = "flow_range",
     .kind = SP_KEY_LIMITS,
     .dimension = &sp_flow_unit,
     .range = SP_ABOVE(0),
     .absent = "the flow cannot be set",
     .says = "The same of the flow at `at`, of several pressures at the first"},
    {.name = "order_code", .kind = SP_KEY_TEXT, .absent = "none", .says = "For report, sheet and nozzles.csv"},
    {.name = "url",
     .kind = SP_KEY_TEXT,
     .absent = "none",
     .says = "Where it is sold: an address that begins with https:// or http://"},
    IMAGE,
    {.name = "members",
     .kind = SP_KEY_BLOCKS,
     .block = &sp_block_member,

     .says = "Of a cluster, which needs it: its patterns, at most 1000, which share the flow"},
    {.name = "rotation",
     .kind = SP_KEY_BLOCK,
     .block = &sp_block_rotation,

     .says = "Of rotating, which needs it: what turns, and how"},
    {.name = "thread", .kind = SP_KEY_TEXT, .absent = "none", .says = "For the sheet, such as G 1/2"},
    {.name = "insert", .kind = SP_KEY_TEXT, .absent = "none", .says = "For the sheet: what is fitted into the body"},
    {.name = "body",
     .kind = SP_KEY_QUANTITY,
     .dimension = &sp_length_unit,
     .range = SP_ABOVE(0),
     .absent = "it passes every port, and several may be proposed in one place but a port",
     .says = "The diameter of the hole that it passes. Nozzles are not proposed nearer to each other than their bodies "
             "allow"},
    {.name = "step",
     .kind = SP_KEY_BLOCK,
     .block = &sp_block_type_step,
     .absent = "anything can be set",
     .says = "How far apart its settings lie, which proposals keep to"},
    {.name = "trajectory",
     .kind = SP_KEY_CHOICE,
     .words = words_trajectory,
     .standard = "auto",
     .says = "How its liquid flies, whatever `simulate` says of the others; `auto` is as the others"},
    {.name = NULL}};
const sp_block sp_block_type = {"type", "a catalogue type", NULL, type_keys};

static const sp_key type_step_keys[] = {{.name = "angle",
                                         .kind = SP_KEY_QUANTITY,
                                         .dimension = &sp_angle_unit,
                                         .range = SP_FROM(1e-6),
                                         .absent = "any within `angle_range`",
                                         .says = "From the type's own angle; beside `angle_range` only"},
                                        {.name = "flow",
                                         .kind = SP_KEY_QUANTITY,
                                         .dimension = &sp_flow_unit,
                                         .range = SP_FROM(1e-9),
                                         .absent = "any within `flow_range`",
                                         .says = "From the type's own flow at `at`; beside `flow_range` only"},
                                        {.name = "pressure",
                                         .kind = SP_KEY_QUANTITY,
                                         .dimension = &sp_pressure_unit,
                                         .range = SP_FROM(1),
                                         .absent = "any",
                                         .says = "From 0"},
                                        {.name = NULL}};
const sp_block sp_block_type_step = {"type_step", "a step", NULL, type_step_keys};

static const sp_key member_keys[] = {
    PATTERN("What it sprays; any but cluster and rotating"),
    ANGLE,
    HOLLOW,
    THICKNESS,
    {.name = "axis",
     .kind = SP_KEY_DIRECTION,
     .standard = "[0, 0, 1]",
     .says = "Where it points, in the body's frame: z along the nozzle's axis, x level, turned by its roll. Not beside "
             "`ring`"},
    {.name = "offset",
     .kind = SP_KEY_VECTOR,
     .dimension = &sp_length_unit,
     .standard = "[0, 0, 0]",
     .says = "Where its liquid comes out, from the nozzle's position, in the body's frame"},
    {.name = "roll",
     .kind = SP_KEY_QUANTITY,
     .dimension = &sp_angle_unit,
     .range = SP_ANY,
     .standard = "0 deg",
     .says = "About its own axis, counted as if the body's z were upwards"},
    {.name = "share",
     .kind = SP_KEY_QUANTITY,
     .dimension = &sp_ratio_unit,
     .range = SP_ABOVE_TO(0, 1e6),
     .standard = "1",
     .says = "Of the flow, against the others' shares"},
    {.name = "ring",
     .kind = SP_KEY_BLOCK,
     .block = &sp_block_ring,
     .absent = "one alone",
     .says = "So many equal members around the body's axis"},
    IMAGE,
    {.name = NULL}};
const sp_block sp_block_member = {"member", "a member of a cluster", NULL, member_keys};

static const sp_key ring_keys[] = {
    {.name = "count", .kind = SP_KEY_COUNT, .required = true, .range = SP_BETWEEN(1, SP_MEMBERS), .says = "How many"},
    {.name = "polar",
     .kind = SP_KEY_QUANTITY,
     .required = true,
     .dimension = &sp_angle_unit,
     .range = SP_BETWEEN(0, M_PI),
     .says = "Of each one's axis from the body's"},
    {.name = "radius",
     .kind = SP_KEY_QUANTITY,
     .dimension = &sp_length_unit,
     .range = SP_FROM(0),
     .standard = "0",
     .says = "How far out along its axis each begins, from `offset`"},
    {.name = "phase",
     .kind = SP_KEY_QUANTITY,
     .dimension = &sp_angle_unit,
     .range = SP_ANY,
     .standard = "0 deg",
     .says = "Of the first one, from the body's x towards its y"},
    {.name = NULL}};
const sp_block sp_block_ring = {"ring", "a ring", NULL, ring_keys};

static const sp_key rotation_keys[] = {
    {.name = "jet", .kind = SP_KEY_BLOCK, .required = true, .block = &sp_block_jet, .says = "What is turned"},
    {.name = "jets",
     .kind = SP_KEY_COUNT,
     .range = SP_BETWEEN(1, MOST_JETS),

     .says = "Beside `gears`, which need it: how many of it, evenly spread round the hub and pointing outwards"},
    {.name = "gears",
     .kind = SP_KEY_COUNTS,
     .dimension = &sp_teeth_unit,
     .range = SP_BETWEEN(1, MOST_TEETH),
     .absent = "it turns about the nozzle's axis alone",
     .says = "Two axes: the hub turns as often as the first says about an axis across the nozzle's while the body "
             "turns as often as "
             "the second"},
    {.name = "speed",
     .kind = SP_KEY_QUANTITY,
     .dimension = &sp_turning_unit,
     .range = SP_ABOVE(0),
     .absent = "not known",
     .says = "Of the body, beside `gears`; tells how long the turns take"},
    {.name = "turns",
     .kind = SP_KEY_COUNT,
     .range = SP_BETWEEN(1, MOST_TURNS),
     .absent = "until the tracks repeat",
     .says = "Of the body, beside `gears`: after which the gaps between tracks are told"},
    {.name = NULL}};
const sp_block sp_block_rotation = {"rotation", "a rotation", NULL, rotation_keys};

static const sp_key jet_keys[] = {
    PATTERN("full_cone, hollow_cone, flat_fan or solid_stream; beside `gears` no fan"),
    ANGLE,
    HOLLOW,
    THICKNESS,
    {.name = "tilt",
     .kind = SP_KEY_QUANTITY,
     .dimension = &sp_angle_unit,
     .range = SP_BETWEEN(0, M_PI),
     .standard = "0 deg",
     .says = "How far its axis leans from the nozzle's. Not beside `gears`"},
    {.name = "roll",
     .kind = SP_KEY_QUANTITY,
     .dimension = &sp_angle_unit,
     .range = SP_ANY,
     .standard = "0 deg",
     .says = "About its own axis; at 0 a fan is wide in the plane of both axes. Not beside `gears`"},
    {.name = NULL}};
const sp_block sp_block_jet = {"jet", "a jet", NULL, jet_keys};
