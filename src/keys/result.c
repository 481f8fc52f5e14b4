/* The keys of result.json, which --json prints too. Kept in its order. */
#include "keys/blocks.h"

static const char *const words_trajectory[] = {"line", "parabola", "drag", NULL};
static const char *const words_evaluator[] = {"forward", "inverse", NULL};
static const char *const words_combine[] = {"sum", "single", NULL};
static const char *const words_reason[] = {"no_line_of_reach", "reflection_only", "too_slow",
                                           "too_slanted",      "too_little_flux", NULL};
static const char *const words_lack[] = {"no_nozzle_in_reach", "too_slow", "too_slanted", "too_little_flux", NULL};

static const sp_key result_input_keys[] = {
    {.name = "file", .kind = SP_KEY_TEXT, .says = "As the command or the scene names it"},
    {.name = "sha256", .kind = SP_KEY_TEXT, .says = "Its digest"},
    {.name = NULL}};
static const sp_block result_input = {"result_input", "an input", NULL, result_input_keys};

#define NO_LINE                                                                                                        \
    "Nothing sprayed from a mounting point, aimed in any way that mount and type allow, arrives at the point that a "  \
    "patch is judged by, m2"
static const sp_key unattainable_keys[] = {
    {.name = "no_line_of_reach", .kind = SP_KEY_NUMBER, .says = NO_LINE},
    {.name = "reflection_only", .kind = SP_KEY_NUMBER, .says = "Only what walls throw back gets there, m2"},
    {.name = "too_slow", .kind = SP_KEY_NUMBER, .says = "What arrives is slower than `impact_speed`, m2"},
    {.name = "too_slanted", .kind = SP_KEY_NUMBER, .says = "What arrives is more slanted than `incidence`, m2"},
    {.name = "too_little_flux",
     .kind = SP_KEY_NUMBER,
     .says = "All that is allowed together does not bring `flux`, or, without one, takes more nozzles or water, m2"},
    {.name = NULL}};
static const sp_block unattainable = {"unattainable", "area out of reach by reason", NULL, unattainable_keys};

static const sp_key unattainable_part_keys[] = {
    {.name = "part", .kind = SP_KEY_TEXT, .says = "Its name"},
    {.name = "area_m2", .kind = SP_KEY_NUMBER, .says = "Of it, out of reach"},
    {.name = "no_line_of_reach", .kind = SP_KEY_NUMBER, .says = NO_LINE},
    {.name = "reflection_only", .kind = SP_KEY_NUMBER, .says = "Only what walls throw back gets there, m2"},
    {.name = "too_slow", .kind = SP_KEY_NUMBER, .says = "What arrives is slower than `impact_speed`, m2"},
    {.name = "too_slanted", .kind = SP_KEY_NUMBER, .says = "What arrives is more slanted than `incidence`, m2"},
    {.name = "too_little_flux",
     .kind = SP_KEY_NUMBER,
     .says = "All that is allowed together does not bring `flux`, or, without one, takes more nozzles or water, m2"},
    {.name = NULL}};
static const sp_block unattainable_part = {"unattainable_part", "a part with area out of reach", NULL,
                                           unattainable_part_keys};

static const sp_key account_keys[] = {
    {.name = "left_out_triangles", .kind = SP_KEY_COUNT, .range = SP_FROM(0), .says = "Triangles without area"},
    {.name = "cad_chord_m", .kind = SP_KEY_NUMBER, .says = "How far triangles lie off CAD surfaces"},
    {.name = "cad_mended_triangles",
     .kind = SP_KEY_COUNT,
     .range = SP_FROM(0),
     .says = "Triangles without area that were merged with others"},
    {.name = "cad_sewn_faces", .kind = SP_KEY_COUNT, .range = SP_FROM(0), .says = "Faces of no solid that were sewn"},
    {.name = "cad_faults", .kind = SP_KEY_COUNT, .range = SP_FROM(0), .says = "Faults that may cost surface or size"},
    {.name = "closed_shells", .kind = SP_KEY_COUNT, .range = SP_FROM(0), .says = "Taken for bodies and rooms"},
    {.name = "turned_shells", .kind = SP_KEY_COUNT, .range = SP_FROM(0), .says = "Drawn inside out and turned round"},
    {.name = "open_shells",
     .kind = SP_KEY_COUNT,
     .range = SP_FROM(0),
     .says = "Taken for sheets, of which both sides count"},
    {.name = "open_shells_m2", .kind = SP_KEY_NUMBER, .says = "Their area"},
    {.name = "inside_m2", .kind = SP_KEY_NUMBER, .says = "What lies in other bodies and is not counted"},
    {.name = "touching_m2", .kind = SP_KEY_NUMBER, .says = "What lies on other surface and is not counted"},
    {.name = "wet_on_both_sides_m2",
     .kind = SP_KEY_NUMBER,
     .says = "What of closed shells is wet on both sides: something is wrong with the geometry"},
    {.name = "outdoors_m2", .kind = SP_KEY_NUMBER, .says = "What is seen through openings alone and is not counted"},
    {.name = "crack_corners",
     .kind = SP_KEY_COUNT,
     .range = SP_FROM(0),
     .says = "Where film is asked for: corners on open edges that lie very near others, as film may be lost there"},
    {.name = "crack_m", .kind = SP_KEY_NUMBERS, .says = "Where the first of these lies"},
    {.name = NULL}};
static const sp_block account = {"account", "what was made of the geometry", NULL, account_keys};

static const sp_key result_geometry_keys[] = {
    {.name = "triangles", .kind = SP_KEY_COUNT, .range = SP_FROM(0), .says = "In all files"},
    {.name = "area_m2", .kind = SP_KEY_NUMBER, .says = "Of all triangles, one side"},
    {.name = "clean_area_m2",
     .kind = SP_KEY_NUMBER,
     .says = "What is to be cleaned and is wet, by side: what coverage is of"},
    {.name = "attainable_area_m2",
     .kind = SP_KEY_NUMBER,
     .says = "Of it, patches that nozzles at the mounting points, aimed in any way that mounts and types allow, could "
             "cover within the limits, each for itself and judged at one point; and patches that a reported layout "
             "covers half of or more. Never less than what such a layout covers. Of `place` only"},
    {.name = "unattainable_m2", .kind = SP_KEY_BLOCK, .block = &unattainable, .says = "The rest by reason"},
    {.name = "unattainable_by_part",
     .kind = SP_KEY_BLOCKS,
     .block = &unattainable_part,
     .says = "The same by part, those of most area first"},
    {.name = "account", .kind = SP_KEY_BLOCK, .block = &account, .says = "What was made of the triangles"},
    {.name = NULL}};
static const sp_block result_geometry = {"result_geometry", "the geometry", NULL, result_geometry_keys};

static const sp_key result_criterion_keys[] = {
    {.name = "flux_l_min_m2", .kind = SP_KEY_NUMBER, .says = "The least liquid per area and time"},
    {.name = "dose_l_m2", .kind = SP_KEY_NUMBER, .says = "The least per area of goods that move, in its place"},
    {.name = "impact_speed_m_s", .kind = SP_KEY_NUMBER, .says = "The least that counts"},
    {.name = "incidence_rad", .kind = SP_KEY_NUMBER, .says = "The greatest that counts, from the normal"},
    {.name = "combine", .kind = SP_KEY_CHOICE, .words = words_combine, .says = "As in the scene"},
    {.name = "film_l_min_m", .kind = SP_KEY_NUMBER, .says = "Or so much film, per metre of width"},
    {.name = NULL}};
static const sp_block result_criterion = {"result_criterion", "what covered means", NULL, result_criterion_keys};

static const sp_key chosen_keys[] = {{.name = "trajectory", .kind = SP_KEY_TEXT, .says = "Why"},
                                     {.name = "evaluator", .kind = SP_KEY_TEXT, .says = "Why"},
                                     {.name = "reflections", .kind = SP_KEY_TEXT, .says = "Why"},
                                     {.name = "jets_per_nozzle", .kind = SP_KEY_TEXT, .says = "Why"},
                                     {.name = "texel_m", .kind = SP_KEY_TEXT, .says = "Why"},
                                     {.name = NULL}};
static const sp_block chosen = {"auto", "why settings left to auto are as they are", NULL, chosen_keys};

static const sp_key fidelity_keys[] = {
    {.name = "trajectory", .kind = SP_KEY_CHOICE, .words = words_trajectory, .says = "How liquid flew"},
    {.name = "evaluator", .kind = SP_KEY_CHOICE, .words = words_evaluator, .says = "Which evaluator"},
    {.name = "reflections",
     .kind = SP_KEY_COUNT,
     .range = SP_FROM(0),
     .says = "How often liquid was followed after a wall had thrown it back"},
    {.name = "jets_per_nozzle", .kind = SP_KEY_COUNT, .range = SP_FROM(0), .says = "Forward only"},
    {.name = "jets_wanted_per_nozzle",
     .kind = SP_KEY_COUNT,
     .range = SP_FROM(0),
     .says = "How many so short a texel wants, where fewer were flown"},
    {.name = "texel_m", .kind = SP_KEY_NUMBER, .says = "Edge of a texel"},
    {.name = "error_estimate",
     .kind = SP_KEY_NUMBER,
     .says = "Of the worst layout: how far its coverage is off by how it was computed"},
    {.name = "misjudged", .kind = SP_KEY_NUMBER, .says = "The same of area that is wrong either way"},
    {.name = "error_bound", .kind = SP_KEY_NUMBER, .says = "The same of what is proved of lines against parabolas"},
    {.name = "auto", .kind = SP_KEY_BLOCK, .block = &chosen, .says = "Why settings left to `auto` are as they are"},
    {.name = NULL}};
static const sp_block fidelity = {"fidelity", "how it was computed", NULL, fidelity_keys};

static const sp_key range_keys[] = {
    {.name = "min", .kind = SP_KEY_NUMBER, .says = "Over the clean area"},
    {.name = "mean", .kind = SP_KEY_NUMBER, .says = "By area"},
    {.name = "p05", .kind = SP_KEY_NUMBER, .says = "What 95 % of the area has at least"},
    {.name = "max", .kind = SP_KEY_NUMBER, .says = "The greatest"},
    {.name = NULL}};
static const sp_block range = {"range", "least, mean, 5th percentile and greatest", NULL, range_keys};

static const sp_key price_keys[] = {
    {.name = "mounts_l_min", .kind = SP_KEY_NUMBER, .says = "What its mounts cost, as water"},
    {.name = "total_l_min", .kind = SP_KEY_NUMBER, .says = "That and its water"},
    {.name = "money", .kind = SP_KEY_NUMBER, .says = "The same as money"},
    {.name = "currency", .kind = SP_KEY_TEXT, .says = "Of three letters"},
    {.name = NULL}};
static const sp_block price = {"price", "what it costs", NULL, price_keys};

static const sp_key liquid_ends_keys[] = {
    {.name = "on_clean_surface", .kind = SP_KEY_NUMBER, .says = "Stays on what is to be cleaned, L/min"},
    {.name = "on_other_surface", .kind = SP_KEY_NUMBER, .says = "On obstacles and dry sides"},
    {.name = "left", .kind = SP_KEY_NUMBER, .says = "Flies out of the geometry"},
    {.name = "not_followed", .kind = SP_KEY_NUMBER, .says = "Is thrown back from a wall and not followed further"},
    {.name = NULL}};
static const sp_block liquid_ends = {"liquid_ends", "where the liquid goes", NULL, liquid_ends_keys};

static const sp_key result_film_keys[] = {
    {.name = "covered_area_m2", .kind = SP_KEY_NUMBER, .says = "What film covers and impact does not"},
    {.name = "arriving_l_min", .kind = SP_KEY_NUMBER, .says = "On wet surface at the first impact"},
    {.name = "left_l_min", .kind = SP_KEY_NUMBER, .says = "Of it, runs or drips out"},
    {.name = "astray_l_min", .kind = SP_KEY_NUMBER, .says = "Drips on surface that is not wet"},
    {.name = "held_l_min", .kind = SP_KEY_NUMBER, .says = "Stands where it cannot drain"},
    {.name = "per_girth_l_min_m",
     .kind = SP_KEY_NUMBER,
     .says = "Arriving over the length around all wet walls seen from above: the measure of rules of thumb, not what "
             "the criterion asks for"},
    {.name = NULL}};
static const sp_block result_film = {"result_film", "what runs down", NULL, result_film_keys};

static const sp_key result_part_keys[] = {{.name = "part", .kind = SP_KEY_TEXT, .says = "Its name"},
                                          {.name = "area_m2", .kind = SP_KEY_NUMBER, .says = "To be cleaned"},
                                          {.name = "covered_area_m2", .kind = SP_KEY_NUMBER, .says = "Of it, covered"},
                                          {.name = "coverage", .kind = SP_KEY_NUMBER, .says = "Their ratio"},
                                          {.name = NULL}};
static const sp_block result_part = {"result_part", "a part", NULL, result_part_keys};

static const sp_key remedy_keys[] = {{.name = "covers_m2",
                                      .kind = SP_KEY_NUMBER,
                                      .says = "How much of the shadow the best candidate covers; 0: none does"},
                                     {.name = "type", .kind = SP_KEY_TEXT, .says = "Its type"},
                                     {.name = "port", .kind = SP_KEY_TEXT, .says = "Its port, where it is in one"},
                                     {.name = "position_m", .kind = SP_KEY_NUMBERS, .says = "Its place"},
                                     {.name = "water_l_min", .kind = SP_KEY_NUMBER, .says = "Its flow"},
                                     {.name = NULL}};
static const sp_block remedy = {"remedy", "one more nozzle for a shadow", NULL, remedy_keys};

static const sp_key shadow_keys[] = {
    {.name = "area_m2", .kind = SP_KEY_NUMBER, .says = "Not covered"},
    {.name = "centroid_m", .kind = SP_KEY_NUMBERS, .says = "Its middle, which need not lie on the surface"},
    {.name = "part", .kind = SP_KEY_TEXT, .says = "That most of it lies on"},
    {.name = "reachable", .kind = SP_KEY_FLAG, .says = "Whether most of it is attainable; of `place` only"},
    {.name = "reason", .kind = SP_KEY_CHOICE, .words = words_reason, .says = "Why not, where it is not"},
    {.name = "lack", .kind = SP_KEY_CHOICE, .words = words_lack, .says = "What most of it lacks of this layout"},
    {.name = "nozzle", .kind = SP_KEY_TEXT, .says = "That brings most liquid there"},
    {.name = "remedy",
     .kind = SP_KEY_BLOCK,
     .block = &remedy,
     .says = "The candidate that covers most of it as one more nozzle; of `place`, of the ten largest"},
    {.name = NULL}};
static const sp_block shadow = {"shadow", "a shadow: connected surface that is not covered", NULL, shadow_keys};

static const sp_key tracks_keys[] = {
    {.name = "turns", .kind = SP_KEY_COUNT, .range = SP_FROM(0), .says = "Of its body"},
    {.name = "seconds", .kind = SP_KEY_NUMBER, .says = "That they take"},
    {.name = "reached_m2", .kind = SP_KEY_NUMBER, .says = "Surface that its jets reach"},
    {.name = "mean_gap_m", .kind = SP_KEY_NUMBER, .says = "From there to the middle of the nearest track, by area"},
    {.name = "p95_gap_m", .kind = SP_KEY_NUMBER, .says = "What 95 % lie within"},
    {.name = "greatest_gap_m", .kind = SP_KEY_NUMBER, .says = "The greatest"},
    {.name = NULL}};
static const sp_block tracks = {"tracks", "how far the surface is from the tracks of a two-axis head", NULL,
                                tracks_keys};

static const sp_key result_nozzle_keys[] = {
    {.name = "name", .kind = SP_KEY_TEXT, .says = "Of the scene, or given by `place`"},
    {.name = "type", .kind = SP_KEY_TEXT, .says = "Of the catalogue"},
    {.name = "order_code", .kind = SP_KEY_TEXT, .says = "The type's"},
    {.name = "overlap",
     .kind = SP_KEY_TEXT,
     .absent = "none",
     .says = "Whose body of those before it its own overlaps, as a clause: such a layout cannot be built"},
    {.name = "url", .kind = SP_KEY_TEXT, .says = "The type's"},
    {.name = "position_m", .kind = SP_KEY_NUMBERS, .says = "As in the scene"},
    {.name = "axis", .kind = SP_KEY_NUMBERS, .says = "A unit vector"},
    {.name = "roll_rad", .kind = SP_KEY_NUMBER, .says = "As in the scene"},
    {.name = "angle_rad",
     .kind = SP_KEY_NUMBER,
     .says = "Opening angle as set; of clusters and what rotates that of the cone that holds all they spray"},
    {.name = "pressure_pa", .kind = SP_KEY_NUMBER, .says = "Difference across it"},
    {.name = "flow_l_min", .kind = SP_KEY_NUMBER, .says = "Of this liquid at this pressure"},
    {.name = "speed_m_s", .kind = SP_KEY_NUMBER, .says = "Exit speed"},
    {.name = "alone_m2", .kind = SP_KEY_NUMBER, .says = "What it covers by itself"},
    {.name = "lost_without_m2", .kind = SP_KEY_NUMBER, .says = "What the others cover less than all"},
    {.name = "new_fitting", .kind = SP_KEY_FLAG, .says = "true where it is in no port; of alternatives only"},
    {.name = "cost_l_min", .kind = SP_KEY_NUMBER, .says = "What its mount costs, as water"},
    {.name = "tracks", .kind = SP_KEY_BLOCK, .block = &tracks, .says = "Of a two-axis head"},
    {.name = NULL}};
static const sp_block result_nozzle = {"result_nozzle", "a nozzle", NULL, result_nozzle_keys};

static const sp_key result_layout_keys[] = {
    {.name = "name",
     .kind = SP_KEY_TEXT,
     .says = "manual: the scene's own; greedy: the best on the candidates; proposed; an alternative's name; or of "
             "`compare` a file"},
    {.name = "water_l_min", .kind = SP_KEY_NUMBER, .says = "Of all nozzles"},
    {.name = "covered_area_m2", .kind = SP_KEY_NUMBER, .says = "Where the criterion holds"},
    {.name = "coverage", .kind = SP_KEY_NUMBER, .says = "That over the clean area"},
    {.name = "error_estimate",
     .kind = SP_KEY_NUMBER,
     .says = "How far that is off by how it was computed: measured at points in closed form, in points of coverage"},
    {.name = "misjudged", .kind = SP_KEY_NUMBER, .says = "Area that is wrong either way, as a share"},
    {.name = "error_bound",
     .kind = SP_KEY_NUMBER,
     .says = "What lines may change against parabolas, proved, as a share"},
    {.name = "borderline_m2", .kind = SP_KEY_NUMBER, .says = "Area that round-off could judge either way"},
    {.name = "coverage_of_attainable",
     .kind = SP_KEY_NUMBER,
     .says = "Covered over attainable area, where all was looked into"},
    {.name = "area_per_water", .kind = SP_KEY_NUMBER, .says = "m2 covered per L/min"},
    {.name = "flux_l_min_m2", .kind = SP_KEY_BLOCK, .block = &range, .says = "Of liquid that arrives"},
    {.name = "new_fittings",
     .kind = SP_KEY_COUNT,
     .range = SP_FROM(0),
     .says = "Nozzles in no port; of alternatives only"},
    {.name = "price", .kind = SP_KEY_BLOCK, .block = &price, .says = "Where mounts cost something"},
    {.name = "dose_l_m2", .kind = SP_KEY_BLOCK, .block = &range, .says = "Of goods that move"},
    {.name = "pass_s", .kind = SP_KEY_NUMBER, .says = "How long they take"},
    {.name = "liquid_l_min", .kind = SP_KEY_BLOCK, .block = &liquid_ends, .says = "Where the liquid goes"},
    {.name = "film", .kind = SP_KEY_BLOCK, .block = &result_film, .says = "Where the criterion asks for film"},
    {.name = "parts", .kind = SP_KEY_BLOCKS, .block = &result_part, .says = "Coverage by part"},
    {.name = "shadows", .kind = SP_KEY_BLOCKS, .block = &shadow, .says = "The largest first"},
    {.name = "nozzles", .kind = SP_KEY_BLOCKS, .block = &result_nozzle, .says = "In their order"},
    {.name = "geometry",
     .kind = SP_KEY_BLOCK,
     .block = &result_geometry,
     .says = "As the result's own, where layouts differ in it or, as alternatives do, in what is attainable"},
    {.name = "criterion",
     .kind = SP_KEY_BLOCK,
     .block = &result_criterion,
     .says = "The same, where they differ in it; absent where it is not known"},
    {.name = "fidelity", .kind = SP_KEY_BLOCK, .block = &fidelity, .says = "The same"},
    {.name = NULL}};
static const sp_block result_layout = {"result_layout", "a layout", NULL, result_layout_keys};

static const sp_key target_keys[] = {
    {.name = "coverage", .kind = SP_KEY_NUMBER, .says = "Asked for"},
    {.name = "coverage_aimed_at", .kind = SP_KEY_NUMBER, .says = "Less where less is attainable"},
    {.name = "reached",
     .kind = SP_KEY_FLAG,
     .says = "Whether the proposal covers what was asked for, not only what was aimed at, within the limits"},
    {.name = NULL}};
static const sp_block target = {"target", "what was asked for", NULL, target_keys};

static const sp_key front_point_keys[] = {
    {.name = "water_l_min", .kind = SP_KEY_NUMBER, .says = "Of all nozzles"},
    {.name = "price_l_min", .kind = SP_KEY_NUMBER, .says = "With what mounts cost, where they do"},
    {.name = "coverage", .kind = SP_KEY_NUMBER, .says = "The best found for it"},
    {.name = "nozzles", .kind = SP_KEY_COUNT, .range = SP_FROM(0), .says = "How many"},
    {.name = "new_fittings", .kind = SP_KEY_COUNT, .range = SP_FROM(0), .says = "Of alternatives"},
    {.name = "coverage_on_texels",
     .kind = SP_KEY_NUMBER,
     .says = "The same on the texels of the certificate, without what walls throw back"},
    {.name = "coverage_bound",
     .kind = SP_KEY_NUMBER,
     .says = "What no layout of the candidates exceeds there with so much water"},
    {.name = "coverage_bound_every_aim",
     .kind = SP_KEY_NUMBER,
     .says = "The same of every axis, roll, angle and flow at the candidates' mounting points"},
    {.name = NULL}};
static const sp_block front_point = {"front_point", "a point of the front", NULL, front_point_keys};

static const sp_key number_point_keys[] = {
    {.name = "nozzles", .kind = SP_KEY_COUNT, .range = SP_FROM(0), .says = "How many"},
    {.name = "water_l_min", .kind = SP_KEY_NUMBER, .says = "Of all nozzles"},
    {.name = "price_l_min", .kind = SP_KEY_NUMBER, .says = "With what mounts cost, where they do"},
    {.name = "coverage", .kind = SP_KEY_NUMBER, .says = "The best found"},
    {.name = "new_fittings", .kind = SP_KEY_COUNT, .range = SP_FROM(0), .says = "Of alternatives"},
    {.name = NULL}};
static const sp_block number_point = {"number_point", "a point of the front by nozzles", NULL, number_point_keys};

static const sp_key forward_check_keys[] = {
    {.name = "coverage", .kind = SP_KEY_NUMBER, .says = "By jets, without film"},
    {.name = "difference", .kind = SP_KEY_NUMBER, .says = "That less the inverse evaluation"},
    {.name = "tolerance", .kind = SP_KEY_NUMBER, .says = "The accuracy asked for, or what so many jets can tell"},
    {.name = "agrees", .kind = SP_KEY_FLAG, .says = "Whether the difference is within that"},
    {.name = "jets", .kind = SP_KEY_COUNT, .range = SP_FROM(0), .says = "How many were flown"},
    {.name = "texels", .kind = SP_KEY_COUNT, .range = SP_FROM(0), .says = "That both count on"},
    {.name = NULL}};
static const sp_block forward_check = {"forward_check", "the proposal counted by jets", NULL, forward_check_keys};

static const sp_key every_aim_keys[] = {
    {.name = "mounting_points",
     .kind = SP_KEY_COUNT,
     .range = SP_FROM(0),
     .says = "At which every axis, roll, angle and flow that is allowed is considered"},
    {.name = "coverage_bound_same_water", .kind = SP_KEY_NUMBER, .says = "No layout covers more with as much water"},
    {.name = "water_bound_same_coverage_l_min", .kind = SP_KEY_NUMBER, .says = "None covers as much with less"},
    {.name = "coverage_bound_same_price",
     .kind = SP_KEY_NUMBER,
     .says = "In place of the first, where mounts cost something"},
    {.name = "price_bound_same_coverage_l_min", .kind = SP_KEY_NUMBER, .says = "In place of the second"},
    {.name = "gap", .kind = SP_KEY_NUMBER, .says = "(bound - found) / bound"},
    {.name = NULL}};
static const sp_block every_aim = {"every_aim", "bounds for every aim", NULL, every_aim_keys};

static const sp_key certificate_keys[] = {
    {.name = "method", .kind = SP_KEY_TEXT, .says = "How it was proved"},
    {.name = "coverage", .kind = SP_KEY_NUMBER, .says = "The proposal's, on these texels"},
    {.name = "coverage_bound_same_water", .kind = SP_KEY_NUMBER, .says = "No layout covers more with as much water"},
    {.name = "water_bound_same_coverage_l_min", .kind = SP_KEY_NUMBER, .says = "None covers as much with less"},
    {.name = "coverage_bound_same_price",
     .kind = SP_KEY_NUMBER,
     .says = "In place of the first, where mounts cost something"},
    {.name = "price_bound_same_coverage_l_min", .kind = SP_KEY_NUMBER, .says = "In place of the second"},
    {.name = "gap", .kind = SP_KEY_NUMBER, .says = "(bound - found) / bound"},
    {.name = "candidates", .kind = SP_KEY_COUNT, .range = SP_FROM(0), .says = "Poses"},
    {.name = "own_poses", .kind = SP_KEY_COUNT, .range = SP_FROM(0), .says = "Of layouts found, besides"},
    {.name = "texels", .kind = SP_KEY_COUNT, .range = SP_FROM(0), .says = "That it counts"},
    {.name = "every_aim",
     .kind = SP_KEY_BLOCK,
     .block = &every_aim,
     .says = "A second proof, of every aim; not of clusters, rotating types and film"},
    {.name = NULL}};
static const sp_block certificate = {"certificate", "how much better any layout could be",
                                     "Proved of layouts of the candidate poses and of the poses of layouts found, on "
                                     "the texels of the certificate, by inverse coverage",
                                     certificate_keys};

static const sp_key stage_keys[] = {{.name = "name", .kind = SP_KEY_TEXT, .says = "What was done"},
                                    {.name = "seconds", .kind = SP_KEY_NUMBER, .says = "By the clock"},
                                    {.name = "processor_seconds", .kind = SP_KEY_NUMBER, .says = "Of all threads"},
                                    {.name = NULL}};
static const sp_block stage = {"stage", "a stage", NULL, stage_keys};

/* Of a proposal, which a result has one of or an alternative each; and how it came about. */
#define PROPOSAL                                                                                                       \
    {.name = "target", .kind = SP_KEY_BLOCK, .block = &target, .says = "What was asked for; of `place`"},              \
        {.name = "front",                                                                                              \
         .kind = SP_KEY_BLOCKS,                                                                                        \
         .block = &front_point,                                                                                        \
         .says = "The best found for rising water, or price; of `place`"},                                             \
        {.name = "front_by_nozzles",                                                                                   \
         .kind = SP_KEY_BLOCKS,                                                                                        \
         .block = &number_point,                                                                                       \
         .says = "The best found for rising numbers of nozzles; of `place`"},                                          \
        {.name = "forward_check",                                                                                      \
         .kind = SP_KEY_BLOCK,                                                                                         \
         .block = &forward_check,                                                                                      \
         .says = "The proposal counted again by jets; of `place`"},                                                    \
    {                                                                                                                  \
        .name = "certificate", .kind = SP_KEY_BLOCK, .block = &certificate,                                            \
        .says = "How much better any layout could be; of `place`"                                                      \
    }
#define COURSE                                                                                                         \
    {.name = "stages", .kind = SP_KEY_BLOCKS, .block = &stage, .says = "How long it took"},                            \
    {                                                                                                                  \
        .name = "cut_short", .kind = SP_KEY_TEXTS,                                                                     \
        .says = "What was cut short or left out for lack of time, or because it was interrupted; where all was done, " \
                "absent"                                                                                               \
    }

static const sp_key result_alternative_keys[] = {
    {.name = "name", .kind = SP_KEY_TEXT, .says = "As the scene has it; its layout is under `layouts`"},
    PROPOSAL,
    COURSE,
    {.name = NULL}};
static const sp_block result_alternative = {"result_alternative", "an alternative", NULL, result_alternative_keys};

static const sp_key result_keys[] = {
    {.name = "sprayplan", .kind = SP_KEY_TEXT, .says = "The version"},
    {.name = "command", .kind = SP_KEY_TEXT, .says = "simulate, place or compare"},
    {.name = "scene", .kind = SP_KEY_TEXT, .says = "The file"},
    {.name = "inputs", .kind = SP_KEY_BLOCKS, .block = &result_input, .says = "What was read, pipes aside"},
    {.name = "geometry",
     .kind = SP_KEY_BLOCK,
     .block = &result_geometry,
     .says = "What is to be cleaned: as far as it is that of all layouts"},
    {.name = "criterion",
     .kind = SP_KEY_BLOCK,
     .block = &result_criterion,
     .says = "What covered means; what is not asked for is absent"},
    {.name = "fidelity", .kind = SP_KEY_BLOCK, .block = &fidelity, .says = "How it was computed"},
    {.name = "layouts", .kind = SP_KEY_BLOCKS, .block = &result_layout, .says = "One after the other"},
    PROPOSAL,
    {.name = "proposed", .kind = SP_KEY_TEXT, .says = "Which alternative is; where there are some"},
    {.name = "proposed_for", .kind = SP_KEY_TEXT, .says = "Why"},
    {.name = "alternatives",
     .kind = SP_KEY_BLOCKS,
     .block = &result_alternative,
     .says = "Of each what was found and proved"},
    COURSE,
    {.name = NULL}};
const sp_block sp_block_result = {
    "result", "a result",
    "What simulate, place and compare find: result.json with -o, and what --json prints. Shares are 0 to 1, lengths m "
    "in the scene's coordinates; a key's unit is the end of its name. What was not computed is absent, never zero. The "
    "same scene and seed give the same bytes, but for seconds",
    result_keys};
