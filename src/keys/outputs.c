/* What commands print with --json that have no result.json: by command. */
#include "keys/outputs.h"

static const sp_key hit_keys[] = {
    {.name = "ray", .kind = SP_KEY_COUNT, .range = SP_FROM(0), .says = "Which of the file, from 0"},
    NUMBER("t", "When, s, of velocities in m/s"),
    {.name = "triangle",
     .kind = SP_KEY_COUNT,
     .range = SP_FROM(0),
     .says = "Which of the file, from 0, polygons as fans"},
    NUMBER("u", "Weight of the second corner of the triangle"),
    NUMBER("v", "Weight of the third"),
    NUMBER("x", "Where, m"),
    NUMBER("y", "Where, m"),
    NUMBER("z", "Where, m"),
    NUMBER("speed", "How fast it arrives, m/s"),
    NUMBER("incidence_deg", "From the normal of the triangle, whichever side is hit, 0 to 90"),
    {.name = NULL}};
static const sp_block hit = {"trace_hit", "a hit", NULL, hit_keys};

static const sp_key trace_keys[] = {OUTPUT_HEAD("trace"),
                                    {.name = "hits",
                                     .kind = SP_KEY_BLOCKS,
                                     .block = &hit,
                                     .says = "The nearest of each ray; null for one that hits nothing"},
                                    {.name = NULL}};
static const sp_block trace = {"trace_output", "what trace prints", NULL, trace_keys};

static const sp_key outputs_keys[] = {
    {.name = "check", .kind = SP_KEY_BLOCK, .block = &sp_block_check, .says = "What is in a scene and wrong with it"},
    {.name = "study",
     .kind = SP_KEY_BLOCK,
     .block = &sp_block_study,
     .says = "What speed costs in accuracy; the same is in study.json"},
    {.name = "atlas", .kind = SP_KEY_BLOCK, .block = &sp_block_atlas, .says = "Figures of a texture atlas"},
    {.name = "bench", .kind = SP_KEY_BLOCK, .block = &sp_block_bench, .says = "How fast every tree is on a mesh"},
    {.name = "trace", .kind = SP_KEY_BLOCK, .block = &trace, .says = "What rays of a file hit"},
    {.name = NULL}};
const sp_block sp_block_outputs = {"outputs", "outputs of commands",
                                   "One JSON object for each command, on standard output. What was not computed is "
                                   "absent, or null where that is said. `simulate`, `place` and `compare` print "
                                   "result.json",
                                   outputs_keys};
