/* The keys that `bench --json` prints, and `atlas --json`, which is among them. Kept in their order. */
#include "keys/outputs.h"

static const char *const words_accelerator[] = {"bvh", "sah", "naive", "none", "embree-fast", "embree-robust", NULL};
static const char *const words_query[] = {"nearest", "occluded", NULL};
static const char *const words_mode[] = {"cone", "grid", "incoherent", "surface", NULL};
static const char *const words_trajectory[] = {"line", "parabola", NULL};

#define ACCELERATOR                                                                                                    \
    {                                                                                                                  \
        .name = "accelerator", .kind = SP_KEY_CHOICE, .words = words_accelerator, .says = "Which tree, or none"        \
    }

static const sp_key stage_keys[] = {
    {.name = "name", .kind = SP_KEY_TEXT, .says = "Such as charts"}, NUMBER("seconds", "Wall time"), {.name = NULL}};
static const sp_block stage = {"atlas_stage", "a stage", NULL, stage_keys};

static const sp_key atlas_keys[] = {
    OUTPUT_HEAD("atlas"),
    COUNT("triangles", "That were unfolded"),
    COUNT("charts", "Pieces that lie flat"),
    COUNT("charts_le4", "Those of at most four triangles"),
    NUMBER("seam_over_sqrt_area", "Length of the cuts over the square root of the area"),
    NUMBER("strain_mean", "By how much lengths are changed, weighted by area"),
    NUMBER("strain95", "The 95th percentile of that"),
    NUMBER("strain_max", "The most"),
    NUMBER("utilisation", "Flat area over the area of the pages"),
    COUNT("pages", "Square images"),
    COUNT("texels", "That lie on charts"),
    COUNT("shared_texels", "Those of more than one connected patch"),
    COUNT("overlaps", "Pairs of triangles that overlap in a chart"),
    NUMBER("area_error", "Of the texels' area together, as a share of the surface"),
    NUMBER("seconds", "Of all stages, wall time"),
    {.name = "stages", .kind = SP_KEY_BLOCKS, .block = &stage, .says = "In their order"},
    COUNT("peak_bytes", "At most held at a time"),
    NUMBER("texel_m", "Edge of a texel"),
    COUNT("page_texels", "Along the edge of a page"),
    NUMBER("uv_scale_m", "Edge of a page: what a texture coordinate of 1 is"),
    {.name = NULL}};
const sp_block sp_block_atlas = {"atlas_output", "what atlas prints", NULL, atlas_keys};

static const sp_key load_keys[] = {NUMBER("seconds", "Reading and joining corners"),
                                   COUNT("bytes", "Of the mesh"),
                                   COUNT("peak_bytes", "At most held at a time"),
                                   {.name = NULL}};
static const sp_block load = {"bench_load", "reading the mesh", NULL, load_keys};

static const sp_key build_keys[] = {ACCELERATOR,
                                    COUNT("threads", "That built it"),
                                    NUMBER("seconds", "The median"),
                                    COUNT("bytes", "Besides the mesh"),
                                    {.name = NULL}};
static const sp_block build = {"bench_build", "building a tree", NULL, build_keys};

static const sp_key trace_keys[] = {
    ACCELERATOR,
    {.name = "variant", .kind = SP_KEY_TEXT, .says = "Rays one by one, in waves, or in packets of so many"},
    {.name = "query", .kind = SP_KEY_CHOICE, .words = words_query, .says = "What is asked of each ray"},
    {.name = "mode", .kind = SP_KEY_CHOICE, .words = words_mode, .says = "How rays lie to each other"},
    {.name = "sorted", .kind = SP_KEY_FLAG, .says = "Whether they were put in order first"},
    {.name = "trajectory", .kind = SP_KEY_CHOICE, .words = words_trajectory, .says = "How they fly"},
    COUNT("threads", "That traced"),
    COUNT("rays", "That were traced"),
    COUNT("hits", "Those that hit something"),
    NUMBER("mrays_per_second", "Millions of rays a second"),
    NUMBER("sort_seconds", "Putting them in order, of which the figure above is without"),
    NUMBER("wrong_share", "Of all rays, those whose hit is another than that found without a tree"),
    NUMBER("missed_share", "Those that should have hit and did not"),
    {.name = NULL}};
static const sp_block trace = {"bench_trace", "tracing rays", NULL, trace_keys};

static const sp_key meshes_keys[] = {NUMBER("cube", "Of 1200 triangles, s"),
                                     NUMBER("horse", "Of 39698 triangles, s"),
                                     NUMBER("elephant", "Of 22840 triangles, s"),
                                     {.name = NULL}};
static const sp_block meshes = {"bench_2008", "figures of 2008 by mesh", NULL, meshes_keys};

#define THEN                                                                                                           \
    {                                                                                                                  \
        .name = "seconds_2008", .kind = SP_KEY_BLOCK, .block = &meshes, .says = "What the study found, where it did"   \
    }
static const sp_key tree_keys[] = {ACCELERATOR, NUMBER("seconds", "On one thread"), THEN, {.name = NULL}};
static const sp_block tree = {"bench_tree", "building a tree as in 2008", NULL, tree_keys};
static const sp_key jets_keys[] = {ACCELERATOR,
                                   COUNT("rays", "That were traced"),
                                   COUNT("hits", "Of these"),
                                   NUMBER("seconds", "With their deposits written"),
                                   THEN,
                                   {.name = NULL}};
static const sp_block jets = {"bench_jets", "jets as in 2008", NULL, jets_keys};
static const sp_key unfolding_keys[] = {NUMBER("seconds", "Of the atlas"), THEN, {.name = NULL}};
static const sp_block unfolding = {"bench_unfolding", "the atlas as in 2008", NULL, unfolding_keys};

static const sp_key tables_keys[] = {
    {.name = "table_4_2", .kind = SP_KEY_BLOCKS, .block = &tree, .says = "Building trees"},
    {.name = "table_4_3", .kind = SP_KEY_BLOCKS, .block = &jets, .says = "Straight jets"},
    {.name = "table_4_4", .kind = SP_KEY_BLOCKS, .block = &jets, .says = "Parabolic jets"},
    {.name = "table_4_5", .kind = SP_KEY_BLOCK, .block = &unfolding, .says = "The texture atlas"},
    {.name = NULL}};
static const sp_block tables = {"bench_study", "tables of a study of 2008", NULL, tables_keys};

static const sp_key bench_keys[] = {
    OUTPUT_HEAD("bench"),
    {.name = "mesh", .kind = SP_KEY_TEXT, .says = "As it was given"},
    COUNT("triangles", "Of the mesh"),
    {.name = "load", .kind = SP_KEY_BLOCK, .block = &load, .says = "Reading it"},
    {.name = "build", .kind = SP_KEY_BLOCKS, .block = &build, .says = "Of each tree and number of threads"},
    {.name = "trace", .kind = SP_KEY_BLOCKS, .block = &trace, .says = "Of each way to trace"},
    {.name = "atlas", .kind = SP_KEY_BLOCK, .block = &sp_block_atlas, .says = "As `atlas --json` prints it"},
    {.name = "study",
     .kind = SP_KEY_BLOCK,
     .block = &tables,
     .says = "The same as a study of 2008 measured, on its machines"},
    {.name = "embree", .kind = SP_KEY_TEXT, .says = "Embree's version, where it took part"},
    {.name = NULL}};
const sp_block sp_block_bench = {"bench_output", "what bench prints", NULL, bench_keys};
