/* The keys that `check --json` prints. Kept in its order. */
#include "keys/outputs.h"

static const char *const words_role[] = {"clean", "obstacle", NULL};
static const char *const words_outside[] = {"outside", NULL};

static const sp_key mesh_keys[] = {COUNT("triangles", "Those with some area, of all files"),
                                   COUNT("vertices", "Equal ones counted once"),
                                   NUMBER("area_m2", "One side of each triangle"),
                                   COUNT("tangled_polygons", "Polygons whose outline crosses itself"),
                                   COUNT("degenerate", "Triangles without area"),
                                   COUNT("open_edges", "Edges of one triangle alone"),
                                   COUNT("non_manifold_edges", "Edges of three or more triangles"),
                                   COUNT("flipped_edges", "Edges where neighbours face different sides"),
                                   COUNT("duplicate_triangles", "Triangles that are there twice"),
                                   COUNT("shells", "What hangs together by edges"),
                                   COUNT("closed_shells", "Shells without open edges"),
                                   NUMBERS("minimum_m", "Least x, y and z of its box"),
                                   NUMBERS("maximum_m", "Greatest x, y and z of its box"),
                                   {.name = NULL}};
static const sp_block mesh = {"check_mesh", "a mesh", NULL, mesh_keys};

static const sp_key flaw_keys[] = {
    COUNT("count", "How many there are"),
    {.name = "perhaps_more", .kind = SP_KEY_FLAG, .says = "Whether counting was given up at so many"},
    NUMBERS("places_m", "Where the first of them are, each x, y and z"),
    {.name = NULL}};
static const sp_block flaw = {"check_flaw", "a kind of flaw", NULL, flaw_keys};

#define FLAW(key, what)                                                                                                \
    {                                                                                                                  \
        .name = key, .kind = SP_KEY_BLOCK, .block = &flaw, .says = what                                                \
    }
static const sp_key flaws_keys[] = {FLAW("degenerate", "Triangles without area"),
                                    FLAW("duplicate_triangles", "Triangles that are there twice"),
                                    FLAW("open_edges", "Edges of one triangle alone"),
                                    FLAW("cracks", "Corners on open edges that lie next to others and are not joined"),
                                    FLAW("non_manifold_edges", "Edges of three or more triangles"),
                                    FLAW("flipped_edges", "Edges where neighbours face different sides"),
                                    FLAW("crossings", "Triangles of one shell that run through each other"),
                                    FLAW("inside_out", "Shells that are drawn inside out"),
                                    FLAW("bits", "Loose bits with next to no area"),
                                    {.name = NULL}};
static const sp_block flaws = {"check_flaws", "flaws of a mesh", NULL, flaws_keys};

static const sp_key filling_keys[] = {
    NUMBERS("place_m", "Its middle: x, y and z"), NUMBER("area_m2", "Its area"), {.name = NULL}};
static const sp_block filling = {"check_filling", "a triangle that was put in", NULL, filling_keys};

static const sp_key yield_keys[] = {
    {.name = "part", .kind = SP_KEY_TEXT, .says = "That lost triangles which lay in another as well"},
    {.name = "to", .kind = SP_KEY_TEXT, .says = "The part that kept them"},
    COUNT("triangles", "So many"),
    NUMBER("area_m2", "Their area"),
    {.name = NULL}};
static const sp_block yield = {"check_yield", "copies of another part", NULL, yield_keys};

static const sp_key repair_keys[] = {
    COUNT("geometry", "Which of the scene's geometry, from 0"),
    {.name = "file", .kind = SP_KEY_TEXT, .says = "That the mended copy was written to"},
    COUNT("joined_corners", "Corners at cracks that were joined"),
    COUNT("split_triangles", "Triangles that were split at others' corners"),
    COUNT("turned_triangles", "Triangles that were turned over"),
    COUNT("filled_triangles", "Missing triangles that were put in"),
    COUNT("copies", "Triangles that were there twice and taken out"),
    COUNT("dropped_triangles", "Triangles without area that were dropped"),
    NUMBERS("area_m2", "Before and after"),
    NUMBERS("shells", "Before and after"),
    NUMBERS("closed_shells", "Before and after"),
    {.name = "flaws_before", .kind = SP_KEY_BLOCK, .block = &flaws, .says = "As `flaws`, of the file"},
    {.name = "flaws_after", .kind = SP_KEY_BLOCK, .block = &flaws, .says = "As `flaws`, of the mended copy"},
    NUMBERS("clean_parts_area_m2", "Of what is to be cleaned, before and after"),
    NUMBER("filled_area_m2", "What was put in"),
    BLOCKS("largest_filled", filling, "The largest triangles that were put in"),
    BLOCKS("copies_of_other_parts", yield, "Which part lost triangles to which"),
    {.name = "lost_parts", .kind = SP_KEY_TEXTS, .says = "Names of parts that are gone"},
    {.name = NULL}};
static const sp_block repair = {"check_repair", "a mended file", NULL, repair_keys};

static const sp_key likelier_keys[] = {{.name = "unit", .kind = SP_KEY_TEXT, .says = "Such as mm"},
                                       NUMBERS("extent_m", "What the file would measure in it along x, y and z"),
                                       {.name = NULL}};
static const sp_block likelier = {"check_unit", "a unit that may be meant", NULL, likelier_keys};

static const sp_key size_keys[] = {
    NUMBERS("extent_m", "Of the file's box along x, y and z"),
    NUMBER("unit_m", "The unit of its coordinates; null where the file states its own"),
    {.name = "plausible", .kind = SP_KEY_FLAG, .says = "Whether vessels and machines are about so large"},
    BLOCKS("likelier_units", likelier, "Units in which they would be, the likeliest first"),
    {.name = NULL}};
static const sp_block size = {"check_size", "how large a file is", NULL, size_keys};

static const sp_key cad_keys[] = {COUNT("geometry", "Which of the scene's geometry, from 0"),
                                  NUMBER("chord_m", "How far triangles may lie off the surface"),
                                  NUMBER("angle_rad", "How far neighbouring ones may turn"),
                                  COUNT("triangles", "As made, with those that have no area"),
                                  COUNT("mended_triangles", "Triangles without area that were merged with others"),
                                  COUNT("sewn_faces", "Faces of no solid that were sewn"),
                                  NUMBER("sewing_m", "How far apart they may have been"),
                                  COUNT("faults", "Faults that may cost surface or size"),
                                  {.name = NULL}};
static const sp_block cad = {"check_cad", "a CAD file", NULL, cad_keys};

static const sp_key part_keys[] = {
    COUNT("geometry", "Which of the scene's geometry, from 0"),
    {.name = "name", .kind = SP_KEY_TEXT, .says = "As the file has it"},
    {.name = "role", .kind = SP_KEY_CHOICE, .words = words_role, .says = "What it is in the scene"},
    COUNT("triangles", "Of it"),
    NUMBER("area_m2", "One side of each triangle"),
    NUMBER("wet_area_m2", "Sides that face the liquid"),
    NUMBER("dry_area_m2", "Sides that do not"),
    NUMBER("inside_area_m2", "In other solids"),
    NUMBER("touching_area_m2", "On other surfaces"),
    NUMBERS("minimum_m", "Least x, y and z of its box; null where it has no triangles"),
    NUMBERS("maximum_m", "Greatest x, y and z of its box; null where it has no triangles"),
    NUMBER("volume_m3", "That its triangles enclose; null where they are not closed"),
    NUMBER("body_volume_m3", "Of the body in a CAD file; null where it is none"),
    {.name = NULL}};
static const sp_block part = {"check_part", "a part", NULL, part_keys};

static const sp_key sweep_keys[] = {NUMBER("travel_m", "How far goods move"),
                                    NUMBER("speed_m_s", "How fast"),
                                    NUMBER("duration_s", "Of the pass"),
                                    COUNT("positions", "At which the pass is looked at"),
                                    {.name = NULL}};
static const sp_block sweep = {"check_sweep", "a pass", NULL, sweep_keys};

static const sp_key cap_keys[] = {NUMBERS("point_m", "Its middle: x, y and z"),
                                  NUMBERS("normal", "Its direction"),
                                  NUMBER("radius_m", "Its radius"),
                                  {.name = NULL}};
static const sp_block cap = {"check_cap", "a cap", NULL, cap_keys};

static const sp_key opening_keys[] = {
    NUMBERS("place_m", "Its middle: x, y and z"),
    NUMBER("width_m", "How wide it is"),
    NUMBER("share", "Of all lines of sight that leave, those through it"),
    {.name = "cap", .kind = SP_KEY_BLOCK, .block = &cap, .says = "A cap that shuts it; null where none was found"},
    {.name = NULL}};
static const sp_block opening = {"check_opening", "an opening", NULL, opening_keys};

static const sp_key hollow_keys[] = {NUMBERS("place_m", "Its lowest point: x, y and z"),
                                     NUMBER("area_m2", "What runs down to it"),
                                     {.name = "drains", .kind = SP_KEY_FLAG, .says = "Whether liquid gets out there"},
                                     {.name = NULL}};
static const sp_block hollow = {"check_hollow", "a place that film runs down to", NULL, hollow_keys};

static const sp_key check_keys[] = {
    OUTPUT_HEAD("check"),
    {.name = "scene", .kind = SP_KEY_TEXT, .says = "As it was given"},
    {.name = "mesh", .kind = SP_KEY_BLOCK, .block = &mesh, .says = "Of all files together"},
    {.name = "flaws", .kind = SP_KEY_BLOCK, .block = &flaws, .says = "What is wrong with it, and where first"},
    BLOCKS("repair", repair, "What --repair made of each file; null without it"),
    BLOCKS("sizes", size, "Of each file"),
    BLOCKS("cad", cad, "Of each CAD file"),
    BLOCKS("parts", part, "Of each part"),
    {.name = "cavity_m",
     .kind = SP_KEY_NUMBERS,
     .words = words_outside,
     .says = "The point of the cavity; null where the scene names none"},
    {.name = "sweep", .kind = SP_KEY_BLOCK, .block = &sweep, .says = "Of goods that move; null where nothing does"},
    BLOCKS("openings", opening, "Those of the cavity that are most seen through"),
    COUNT("more_openings", "The others that were found"),
    BLOCKS("hollows", hollow, "Where film gathers"),
    NUMBER("outdoors_m2", "Surface that is seen through openings, and left out"),
    NUMBER("beyond_caps_m2", "Surface beyond `caps`"),
    NUMBER("clean_area_m2", "What is to be cleaned, and counted"),
    COUNT("patches", "In which it is counted"),
    NUMBER("texel_m", "Their edge"),
    COUNT("nozzles", "Of the scene's own"),
    {.name = "warnings", .kind = SP_KEY_TEXTS, .says = "What looks wrong, as sentences"},
    {.name = NULL}};
const sp_block sp_block_check = {"check_output", "what check prints", NULL, check_keys};
