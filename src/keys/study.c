/* The keys of study.json, which `study --json` prints too. Kept in its order. */
#include "keys/outputs.h"

static const char *const words_trajectory[] = {"line", "parabola", "drag", NULL};
static const char *const words_evaluator[] = {"forward", "inverse", NULL};
static const char *const words_judged[] = {"points", "jets", NULL};
static const char *const words_along[] = {"texel", "jets", NULL};

#define TRAJECTORY                                                                                                     \
    {                                                                                                                  \
        .name = "trajectory", .kind = SP_KEY_CHOICE, .words = words_trajectory, .says = "How liquid flies"             \
    }
#define EVALUATOR                                                                                                      \
    {                                                                                                                  \
        .name = "evaluator", .kind = SP_KEY_CHOICE, .words = words_evaluator, .says = "By which it is counted"         \
    }
#define REFLECTIONS COUNT("reflections", "Off walls")
#define JETS COUNT("jets_per_nozzle", "Of the forward evaluator")
#define TEXEL NUMBER("texel_m", "Edge of the texels")

static const sp_key run_speed_keys[] = {NUMBER("prepare_s", "Tree, wet sides and atlas, wall time"),
                                        NUMBER("evaluate_s", "One layout, wall time"),
                                        NUMBER("prepare_cpu_s", "The same of all threads together"),
                                        NUMBER("evaluate_cpu_s", "The same of all threads together"),
                                        FLAG("on_front", "Whether no other run has less error and takes less time"),
                                        FLAG("on_front_misjudged", "The same of misjudged area"),
                                        COUNT("memory_bytes", "At most held at a time, beyond the geometry"),
                                        {.name = NULL}};
static const sp_block run_speed = {"study_run_speed", "how fast a run is", NULL, run_speed_keys};

static const sp_key run_keys[] = {
    EVALUATOR,
    TRAJECTORY,
    REFLECTIONS,
    JETS,
    TEXEL,
    FLAG("chosen", "Whether these are the scene's own settings"),
    COUNT("texels", "In which the surface is counted"),
    NUMBER("coverage", "Of the surface to be cleaned"),
    NUMBER("error", "Mean difference to the reference, in points of coverage"),
    NUMBER("two_standard_errors", "Of that"),
    NUMBER("misjudged", "Mean size of the difference"),
    {.name = "speed", .kind = SP_KEY_BLOCK, .block = &run_speed, .says = "What differs between runs and machines"},
    {.name = NULL}};
static const sp_block run = {"study_run", "one combination of settings", NULL, run_keys};

static const sp_key order_keys[] = {
    {.name = "along", .kind = SP_KEY_CHOICE, .words = words_along, .says = "Which setting varies"},
    EVALUATOR,
    TRAJECTORY,
    REFLECTIONS,
    JETS,
    TEXEL,
    COUNT("runs", "In the series"),
    NUMBER("error", "The power of the texel's length, or of one over the jets, that the error goes with"),
    NUMBER("misjudged", "The same of misjudged area"),
    {.name = NULL}};
static const sp_block order = {"study_order", "how fast a series comes nearer", NULL, order_keys};

static const sp_key reference_keys[] = {
    {.name = "judged_by",
     .kind = SP_KEY_CHOICE,
     .words = words_judged,
     .says = "Points that are judged in closed form, or a run of many jets"},
    EVALUATOR,
    TRAJECTORY,
    REFLECTIONS,
    JETS,
    TEXEL,
    COUNT("points", "That were compared"),
    NUMBER("coverage", "Of the surface to be cleaned"),
    NUMBER("two_standard_errors", "Of that, as the points are a sample"),
    NUMBER("error_without_reflections", "Of a run of jets, against points judged in closed form"),
    NUMBER("film_texel_m", "Length of the cells that film is routed on"),
    {.name = NULL}};
static const sp_block reference = {"study_reference", "what is compared with", NULL, reference_keys};

static const sp_key place_speed_keys[] = {NUMBER("seconds", "Until the layout was there, wall time"),
                                          NUMBER("cpu_s", "The same of all threads together"),
                                          NUMBER("limit_s", "That it was given"),
                                          COUNT("memory_bytes", "At most held at a time, beyond the geometry"),
                                          {.name = NULL}};
static const sp_block place_speed = {"study_place_speed", "how fast a placement is", NULL, place_speed_keys};

static const sp_key place_keys[] = {
    TRAJECTORY,
    TEXEL,
    FLAG("refined", "Whether poses were refined between the candidates"),
    {.name = "shift",
     .kind = SP_KEY_COUNT,
     .range = SP_BETWEEN(-1, 1),
     .says = "Of three alike: texels 3 % finer than the group's, those, or 3 % coarser"},
    FLAG("ended_early", "Whether the limit cut it short"),
    FLAG("reached", "Whether it covers what was asked for"),
    COUNT("nozzles", "Of the layout"),
    NUMBER("water_l_min", "Of the layout"),
    NUMBER("price_l_min", "The same and what its mounts cost, where they cost something"),
    NUMBER("coverage", "By its own evaluator"),
    NUMBER("confirmed", "Share of points of the surface that are covered"),
    NUMBER("two_standard_errors", "Of that"),
    {.name = "speed", .kind = SP_KEY_BLOCK, .block = &place_speed, .says = "What differs between runs and machines"},
    {.name = NULL}};
static const sp_block place = {"study_place", "a placement", NULL, place_keys};

static const sp_key study_keys[] = {
    OUTPUT_HEAD("study"),
    {.name = "scene", .kind = SP_KEY_TEXT, .says = "As it was given"},
    NUMBER("clean_area_m2", "What is to be cleaned, and counted"),
    FLAG("interrupted", "Whether it was stopped before its end"),
    {.name = "runs", .kind = SP_KEY_BLOCKS, .block = &run, .says = "In the order of the grid, the scene's own last"},
    {.name = "orders", .kind = SP_KEY_BLOCKS, .block = &order, .says = "Of series where one setting alone varies"},
    {.name = "reference", .kind = SP_KEY_BLOCK, .block = &reference, .says = "What runs are compared with"},
    {.name = "notes", .kind = SP_KEY_TEXTS, .says = "What is left out, as sentences"},
    {.name = "place", .kind = SP_KEY_BLOCKS, .block = &place, .says = "Placements, in groups of three"},
    {.name = "place_limited",
     .kind = SP_KEY_BLOCKS,
     .block = &place,
     .says = "Those with little time, whose layouts depend on the machine"},
    {.name = NULL}};
const sp_block sp_block_study = {"study_output", "what study prints, and study.json", NULL, study_keys};
