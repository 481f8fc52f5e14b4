/* The commands, their options, and what else there is to know of them. */
#include "usage.h"

#include <stdint.h>
#include <string.h>

const char cli_purpose[] =
    "Proposes where to put spray nozzles: traces the liquid from nozzles to the surfaces of a vessel or machine, "
    "records what reaches every patch of it, and searches for the layout that covers the most area per unit water.";

const char cli_conventions[] =
    "Options may stand anywhere, also before the command, and behind -- stand none. A - in place of a file is standard "
    "input, for scenes, meshes (OBJ, STL or PLY) and rays; other files that such a scene names are looked up from the "
    "working directory.";

const cli_command cli_commands[CLI_COMMANDS] = {
    [CLI_CHECK] = {"check", "SCENE", "what is in a scene, what is wrong with it, diagnosis of its mesh",
                   "Reads the scene, its catalogue and its geometry, and tells what is in them and what is doubtful: "
                   "open, non-manifold and flipped edges, cracks, bits that are loose, openings through which the "
                   "liquid gets out of the cavity, hollows that cannot drain, units that make no sense, nozzles of the "
                   "scene's own that go against the port that they stand in. Of what is wrong in a file it names file, "
                   "line and column.\n\n"
                   "With -o a picture of the wet surface, wet.png, is written.",
                   "sprayplan check vessel.yaml -o out/check", 1, 1},
    [CLI_SIMULATE] = {"simulate", "SCENE", "evaluate the scene's own nozzles",
                      "Finds what the nozzles that the scene lists cover, how much liquid arrives where, what stays in "
                      "the shadow, and how far these figures are off.",
                      "sprayplan simulate vessel.yaml -o out/mine", 1, 1},
    [CLI_PLACE] = {"place", "SCENE", "propose a layout, and compare it with the scene's own nozzles",
                   "Searches, among all poses that the scene's mounts allow, for the layout that reaches the coverage "
                   "asked for with the least water (or what else `place: objective` says), refines it, proves how near "
                   "to the best it is, and compares it with the nozzles that the scene lists. The proposal is written "
                   "as a scene again, layout.yaml.\n\n"
                   "Ctrl-C ends the search: the best layout so far is written then, and called that. Under mpirun "
                   "several processes work out one proposal together.",
                   "sprayplan place vessel.yaml -o out/vessel", 1, 1},
    [CLI_COMPARE] =
        {"compare", "A B...", "scenes or results side by side, in one report",
         "Each is a scene, whose own nozzles are evaluated, or a result.json that simulate or place wrote, or "
         "its folder, whose figures are taken as they are.",
         "sprayplan compare vessel.yaml out/vessel/result.json -o out/compared", 2, CLI_INPUTS_MOST},
    [CLI_STUDY] =
        {"study", "SCENE", "measure speed against accuracy on this scene",
         "Evaluates the scene's own nozzles in every way there is, and tells the error, seconds and memory of "
         "each; where the scene has mounts, placements with cheaper and dearer settings follow.",
         "sprayplan study vessel.yaml -o out/study", 1, 1},
    [CLI_ATLAS] =
        {"atlas", "MESH", "texture atlas alone: the mesh with texture coordinates, and figures",
         "Unfolds a surface (OBJ, STL, PLY, STEP, IGES or BREP) to a texture atlas and prints how good it is. "
         "With -o the mesh is written in m, with its texture coordinates, and a picture of every page beside it.",
         "sprayplan atlas vessel.obj -o unfolded.obj --unit mm --texel 10mm", 1, 1},
    [CLI_TRACE] =
        {"trace", "MESH", "nearest hits of given lines or parabolas, as CSV",
         "Prints, for every ray of a file, the triangle that it hits first, where, when, how fast and at what "
         "angle, in m and m/s; nothing but its number, with --json null, for a ray that hits none. Rays and triangles "
         "are numbered from 0 as in their files.",
         "sprayplan trace vessel.obj --rays rays.csv --unit mm --gravity 0,0,-9.81", 1, 1},
    [CLI_BENCH] = {"bench", "MESH", "build, trace and atlas timings of every accelerator on a mesh",
                   "Traces the same rays with every accelerator in turn and prints what building and tracing took.",
                   "sprayplan bench vessel.obj --unit mm --mode cone", 1, 1},
    [CLI_HELP] = {"help", "[COMMAND|TOPIC]", "what a command does, or what the keys of a file mean",
                  "Of a command prints the same as COMMAND --help; of a topic (scene, catalogue, result, files, "
                  "outputs) every key, what it may be, what is so without it and what it means; without either, what "
                  "there is.",
                  "sprayplan help scene", 0, 1},
};

#define OF(command) (1u << (command))
enum {
    ALL = (1u << CLI_COMMANDS) - 1,
    ON_SCENES = OF(CLI_CHECK) | OF(CLI_SIMULATE) | OF(CLI_PLACE) | OF(CLI_COMPARE) | OF(CLI_STUDY),
};

const cli_option cli_options_known[] = {
    {CLI_OUTPUT, 'o', NULL, "DIR", ON_SCENES,
     "The folder to write to, made where it is missing. Without it nothing is "
     "written."},
    {CLI_OUTPUT, 'o', NULL, "OUT.obj", OF(CLI_ATLAS), "The file to write to; pictures of its pages go beside it."},
    {CLI_SET, 0, "set", "KEY=VALUE", ON_SCENES,
     "Override a setting of simulate:, place: or report: in the scene, as --set simulate.jets=20000 or --set "
     "place.refine=none. May be given again and again."},
    {CLI_REPAIR, 0, "repair", "OUT.obj", OF(CLI_CHECK),
     "Write a mended copy of the geometry, in m and placed as in the scene; of several files OUT-0.obj, OUT-1.obj and "
     "so on. No file that is read is replaced. Name it in the scene instead of the file that it is of, without unit, "
     "scale, rotate, translate, chord and angle. Mended: cracks of up to 1e-4 of the diagonal, edges cut more finely "
     "on one side, triangles that face the other side than most around them, are there twice or have no area, and "
     "single ones that are missing from a surface that goes on beside them: an opening of that shape, as in a screen, "
     "is shut as well, so what was put in is told with the largest places. Of copies in different parts a part to be "
     "cleaned keeps its own, else the first does; which part lost what is told. Left: wider openings, ends of pipes, "
     "crossings, loose bits, which side a closed shell faces."},
    {CLI_TIME_LIMIT, 0, "time-limit", "S", OF(CLI_PLACE),
     "End after S seconds with the best layout so far. What is cut short or left out is named."},
    {CLI_TIME_LIMIT, 0, "time-limit", "S", OF(CLI_STUDY), "End after S seconds with what there is."},
    {CLI_MEMORY, 0, "memory", "SIZE", OF(CLI_PLACE),
     "What all that candidates can reach may take, as \"2 GB\" (default 1 GB). Less takes longer; the answer does not "
     "depend on it."},
    {CLI_PROVE, 0, "prove", NULL, OF(CLI_PLACE), "Spend the time limit on closing the gap between proposal and bound."},
    {CLI_NO_LIVE, 0, "no-live", NULL, OF(CLI_SIMULATE) | OF(CLI_PLACE),
     "Leave the evaluator, by which the page evaluates changed layouts, out of report.html."},
    {CLI_FORCE, 0, "force", NULL, OF(CLI_SIMULATE) | OF(CLI_PLACE),
     "Replace layout.yaml, and those of alternatives, where they were edited since they were written."},
    {CLI_UNIT, 0, "unit", "UNIT", OF(CLI_ATLAS) | OF(CLI_TRACE) | OF(CLI_BENCH),
     "The unit of the file's coordinates, such as mm or inch. Default: m."},
    {CLI_TEXEL, 0, "texel", "L", OF(CLI_ATLAS),
     "Edge length of a texel, as 10mm or 0.01 (m). Default: a million texels for the surface, "
     "fewer where a piece of it is too long for a page of such."},
    {CLI_PACK, 0, "pack", "HOW", OF(CLI_ATLAS),
     "pixels: charts lie in each other's hollows (default); skyline: their boxes do not overlap."},
    {CLI_REUSE, 0, "reuse", NULL, OF(CLI_ATLAS), "Keep the texture coordinates that an OBJ file has."},
    {CLI_RAYS, 0, "rays", "FILE", OF(CLI_TRACE),
     "The rays, needed: lines ox,oy,oz,vx,vy,vz in m and m/s; # begins a comment."},
    {CLI_RAYS, 0, "rays", "N", OF(CLI_BENCH), "How many rays a mode has (default 262144)."},
    {CLI_GRAVITY, 0, "gravity", "GX,GY,GZ", OF(CLI_TRACE),
     "m/s2: makes the rays parabolas, and lets a velocity of 0 be a drop that is let go. Default: lines."},
    {CLI_ACCEL, 0, "accel", "WHICH", OF(CLI_TRACE), "The accelerator: bvh (default), sah, naive or none."},
    {CLI_MODE, 0, "mode", "MODE", OF(CLI_BENCH), "cone, grid, incoherent or surface. Default: all."},
    {CLI_TRAJECTORY, 0, "trajectory", "WHICH", OF(CLI_BENCH), "line or parabola. Default: both."},
    {CLI_SCHEMA, 0, "schema", NULL, OF(CLI_HELP),
     "Print a JSON Schema of a scene, a catalogue or a result (default: scene), by which editors check and complete."},
    {CLI_JSON, 0, "json", NULL, ALL, "Print one JSON object on standard output, and nothing else there."},
    {CLI_THREADS, 0, "threads", "N", ALL,
     "How many threads to use. Default: one per core. The answer does not depend on it."},
    {CLI_QUIET, 'q', "quiet", NULL, ALL, "No progress and no summary."},
    {CLI_HELP_ASKED, 'h', "help", NULL, ALL, "Print what the command does and which options it takes."},
    {CLI_VERSION, 'V', "version", NULL, ALL, "Print the version."},
};
const size_t cli_option_count = sizeof cli_options_known / sizeof *cli_options_known;

const cli_term cli_statuses[] = {
    {"0", "Done."},
    {"1", "Anything else, as a file that cannot be written, or no memory."},
    {"2", "Wrong usage."},
    {"3", "Bad input, which includes a nozzle that stands in a wall or outside the cavity."},
    {"4", "Done, but the proposal does not reach the coverage asked for; the best layout is written."},
    {"130", "Interrupted by Ctrl-C or SIGTERM; place and study still write what there is."},
    {NULL, NULL},
};

const cli_term cli_environment[] = {
    {"OMP_NUM_THREADS", "How many threads to use where --threads does not say."},
    {"OMP_WAIT_POLICY", "How threads wait for one another. Default: passive, they sleep."},
    {"NO_COLOR", "Set to anything, it keeps escape codes off the terminal."},
    {"TERM", "dumb keeps them off as well, and no line is written over."},
    {"SOURCE_DATE_EPOCH", "The time that a report calls now, in seconds since 1970, so that it is the same again."},
    {NULL, NULL},
};

const cli_term cli_files[] = {
    {"layout.yaml",
     "The proposal, or what was simulated, as a scene with no setting left to auto; of alternatives that "
     "are not proposed layout-1.yaml and so on."},
    {"result.json", "All figures; the same as --json prints."},
    {"report.html", "All of it for readers, in one page that needs no network."},
    {"nozzles.csv", "The nozzles with all that a fitter sets; nozzles-all.csv has those of several layouts."},
    {"nozzles.stl", "A body for each nozzle, in the unit of the scene's first geometry file."},
    {"swabs.csv", "The worst places, where to look first."},
    {"coverage.png", "The coverage, in false colours."},
    {"deposits.exr", "Every recorded quantity on the texture atlas."},
    {"model.glb", "The geometry in false colours, for any viewer."},
    {"surface.vtp, texels.vtp", "Triangles and patches with their quantities, for ParaView."},
    {NULL, NULL},
};

bool cli_option_is_common(const cli_option *option)
{
    return option->commands == ALL;
}

size_t cli_command_named(const char *name)
{
    for (size_t i = 0; i < CLI_COMMANDS; i++)
        if (!strcmp(cli_commands[i].name, name))
            return i;
    return SIZE_MAX;
}

void cli_option_syntax(const cli_option *option, char text[CLI_SYNTAX])
{
    const char letter[] = {'-', option->letter, '\0'};
    snprintf(text, CLI_SYNTAX, "%s%s%s%s%s%s", option->letter ? letter : "", option->letter && option->name ? ", " : "",
             option->name ? "--" : "", option->name ? option->name : "", option->value ? " " : "",
             option->value ? option->value : "");
}

void cli_each_option(FILE *to, unsigned commands, bool common,
                     void (*print)(FILE *to, const char *term, const char *text))
{
    for (size_t i = 0; i < cli_option_count; i++) {
        const cli_option *option = &cli_options_known[i];
        char syntax[CLI_SYNTAX];
        if (!(option->commands & commands) || cli_option_is_common(option) != common)
            continue;
        cli_option_syntax(option, syntax);
        print(to, syntax, option->text);
    }
}
