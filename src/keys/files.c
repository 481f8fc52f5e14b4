/* The files that simulate and place write with -o, and what stands in each. */
#include "keys/blocks.h"

static const sp_key deposits_keys[] = {
    {.name = "flux", .kind = SP_KEY_NUMBER, .says = "All liquid that arrives, m3/s per m2"},
    {.name = "jets", .kind = SP_KEY_NUMBER, .says = "How many jets (forward) or arcs (inverse) arrive"},
    {.name = "speed", .kind = SP_KEY_NUMBER, .says = "Mean impact speed, weighted by liquid, m/s"},
    {.name = "speed_max", .kind = SP_KEY_NUMBER, .says = "The greatest, m/s"},
    {.name = "incidence",
     .kind = SP_KEY_NUMBER,
     .says = "Mean angle between jet and the wall's normal, weighted by liquid, rad"},
    {.name = "incidence_min", .kind = SP_KEY_NUMBER, .says = "The least, rad"},
    {.name = "impact",
     .kind = SP_KEY_NUMBER,
     .says = "Mean pressure of the component across the wall, density times its speed squared, Pa"},
    {.name = "impact_max", .kind = SP_KEY_NUMBER, .says = "The greatest, Pa"},
    {.name = "covered", .kind = SP_KEY_NUMBER, .says = "Share of the texel that is covered"},
    {.name = "area", .kind = SP_KEY_NUMBER, .says = "What of the surface it holds that counts, m2"},
    {.name = "film",
     .kind = SP_KEY_NUMBER,
     .says = "What runs down it, m3/s per m of width; 0 where the criterion does not ask"},
    {.name = "chart", .kind = SP_KEY_NUMBER, .says = "The number of its chart"},
    {.name = NULL}};
static const sp_block deposits = {"deposits", "channels of the texture atlas",
                                  "Floats in SI units, one pixel a texel, 0 (chart: -1) where no surface lies; a part "
                                  "of the file is a page, `-back` of sheets' back sides",
                                  deposits_keys};

static const sp_key surface_keys[] = {
    {.name = "part", .kind = SP_KEY_NUMBER, .says = "Its part, counted in `part_names` from 0"},
    {.name = "side", .kind = SP_KEY_NUMBER, .says = "0: both sides as one, 1: the front, 2: the back"},
    {.name = "area", .kind = SP_KEY_NUMBER, .says = "What of it counts, m2"},
    {.name = "covered", .kind = SP_KEY_NUMBER, .says = "Share of that"},
    {.name = "flux", .kind = SP_KEY_NUMBER, .says = "Mean, m3/s per m2"},
    {.name = "speed", .kind = SP_KEY_NUMBER, .says = "Weighted by liquid, m/s"},
    {.name = "incidence", .kind = SP_KEY_NUMBER, .says = "Weighted by liquid, rad"},
    {.name = NULL}};
static const sp_block surface = {"surface", "arrays of cells",
                                 "The wet sides of all triangles, in m; what is not cleaned is NaN", surface_keys};

static const sp_key texels_keys[] = {
    {.name = "normal", .kind = SP_KEY_NUMBERS, .says = "Towards the liquid"},
    {.name = "part", .kind = SP_KEY_NUMBER, .says = "Its part, counted in `part_names` from 0"},
    {.name = "side", .kind = SP_KEY_NUMBER, .says = "0: both sides as one, 1: the front, 2: the back"},
    {.name = NULL}};
static const sp_block texels = {"texels", "arrays of points",
                                "Every patch as a point, in m: what deposits.exr holds under the same names, and these",
                                texels_keys};

static const sp_key nozzles_csv_keys[] = {
    {.name = "name", .kind = SP_KEY_TEXT, .says = "As in the scene"},
    {.name = "type", .kind = SP_KEY_TEXT, .says = "Of the catalogue"},
    {.name = "x_m", .kind = SP_KEY_NUMBER, .says = "Its position along x"},
    {.name = "y_m", .kind = SP_KEY_NUMBER, .says = "The same along y"},
    {.name = "z_m", .kind = SP_KEY_NUMBER, .says = "The same along z"},
    {.name = "axis_x", .kind = SP_KEY_NUMBER, .says = "Where it points, along x"},
    {.name = "axis_y", .kind = SP_KEY_NUMBER, .says = "The same along y"},
    {.name = "axis_z", .kind = SP_KEY_NUMBER, .says = "The same along z"},
    {.name = "roll_deg", .kind = SP_KEY_NUMBER, .says = "About its axis"},
    {.name = "angle_deg",
     .kind = SP_KEY_NUMBER,
     .says = "Opening angle as set; of clusters and what rotates that of the cone that holds all they spray"},
    {.name = "pressure_bar", .kind = SP_KEY_NUMBER, .says = "Difference across it"},
    {.name = "flow_l_min", .kind = SP_KEY_NUMBER, .says = "Of this liquid at this pressure"},
    {.name = "speed_m_s", .kind = SP_KEY_NUMBER, .says = "Exit speed"},
    {.name = "order_code", .kind = SP_KEY_TEXT, .says = "The type's"},
    {.name = "url", .kind = SP_KEY_TEXT, .says = "The type's"},
    {.name = "thread", .kind = SP_KEY_TEXT, .says = "The type's"},
    {.name = "insert", .kind = SP_KEY_TEXT, .says = "The type's"},
    {.name = "mounting", .kind = SP_KEY_TEXT, .says = "port, weld, line or box"},
    {.name = "fitting",
     .kind = SP_KEY_TEXT,
     .says = "The name of port or mount; of a surface without one the part to weld to"},
    {.name = "depth_mm", .kind = SP_KEY_NUMBER, .says = "How far the lance reaches in"},
    {.name = "standoff_mm", .kind = SP_KEY_NUMBER, .says = "From the wall to the tip"},
    {.name = "fitting_x_mm",
     .kind = SP_KEY_NUMBER,
     .says = "The port's mouth, or where to weld, along the zero of the datum"},
    {.name = "fitting_y_mm", .kind = SP_KEY_NUMBER, .says = "The same a quarter turn on"},
    {.name = "fitting_height_mm", .kind = SP_KEY_NUMBER, .says = "The same along the axis of the datum"},
    {.name = "fitting_radius_mm", .kind = SP_KEY_NUMBER, .says = "Of a round vessel, from that axis"},
    {.name = "fitting_azimuth_deg",
     .kind = SP_KEY_NUMBER,
     .says = "Of a round vessel, about that axis, from the zero of the datum"},
    {.name = "tip_x_mm", .kind = SP_KEY_NUMBER, .says = "The tip, along the zero of the datum"},
    {.name = "tip_y_mm", .kind = SP_KEY_NUMBER, .says = "The same a quarter turn on"},
    {.name = "tip_height_mm", .kind = SP_KEY_NUMBER, .says = "The same along the axis of the datum"},
    {.name = "tip_radius_mm", .kind = SP_KEY_NUMBER, .says = "Of a round vessel, from that axis"},
    {.name = "tip_azimuth_deg",
     .kind = SP_KEY_NUMBER,
     .says = "Of a round vessel, about that axis, from the zero of the datum"},
    {.name = "tilt_deg", .kind = SP_KEY_NUMBER, .says = "From straight down, against the axis of the datum"},
    {.name = "towards_deg", .kind = SP_KEY_NUMBER, .says = "The azimuth that the spray leans to"},
    {.name = "turn_deg",
     .kind = SP_KEY_NUMBER,
     .says = "Clockwise seen along the spray, from the level line a quarter turn on from there"},
    {.name = "circuit", .kind = SP_KEY_NUMBER, .says = "Nozzles of one pressure, from 1"},
    {.name = "circuit_l_min", .kind = SP_KEY_NUMBER, .says = "What that circuit has to supply"},
    {.name = NULL}};
static const sp_block nozzles_csv = {
    "nozzles_csv", "columns of the sheet",
    "What a fitter welds, sets and orders, rounded to 1 mm and 0.1 deg, or finer where a `step` or a small part needs "
    "it; place and axis of the spray are layout.yaml's, and its angle is not rounded",
    nozzles_csv_keys};

static const sp_key swabs_keys[] = {
    {.name = "number", .kind = SP_KEY_COUNT, .range = SP_FROM(1), .says = "From 1"},
    {.name = "part", .kind = SP_KEY_TEXT, .says = "That it lies on"},
    {.name = "x_m", .kind = SP_KEY_NUMBER, .says = "Its position along x"},
    {.name = "y_m", .kind = SP_KEY_NUMBER, .says = "The same along y"},
    {.name = "z_m", .kind = SP_KEY_NUMBER, .says = "The same along z"},
    {.name = "received_percent", .kind = SP_KEY_NUMBER, .says = "What the criterion counts there, of what it asks for"},
    {.name = "flux_l_min_m2", .kind = SP_KEY_NUMBER, .says = "All that arrives"},
    {.name = "speed_m_s", .kind = SP_KEY_NUMBER, .says = "Mean"},
    {.name = "incidence_deg", .kind = SP_KEY_NUMBER, .says = "Mean"},
    {.name = "lack", .kind = SP_KEY_TEXT, .says = "As `lack` of a shadow in result.json; empty where it is covered"},
    {.name = NULL}};
static const sp_block swabs = {"swabs", "columns",
                               "The ten worst places of the layout, at least 5 % of the diagonal apart, equally bad "
                               "ones farther where they can be: where to take samples first",
                               swabs_keys};

static const sp_key files_keys[] = {
    {.name = "report.html", .kind = SP_KEY_FILE, .says = "The report: one file that asks nothing of any server"},
    {.name = "result.json", .kind = SP_KEY_FILE, .says = "All figures; see the reference of results"},
    {.name = "layout.yaml",
     .kind = SP_KEY_FILE,
     .says = "The layout as a scene, of which `simulate` makes the same figures; alternatives that are not proposed "
             "are layout-1.yaml and so on"},
    {.name = "nozzles.csv",
     .kind = SP_KEY_FILE,
     .block = &nozzles_csv,
     .says = "The sheet; nozzles-all.csv has the rows of several, behind a column `layout`"},
    {.name = "swabs.csv", .kind = SP_KEY_FILE, .block = &swabs, .says = "Where to take samples"},
    {.name = "coverage.png", .kind = SP_KEY_FILE, .says = "The texture atlas in the colours of the report"},
    {.name = "deposits.exr", .kind = SP_KEY_FILE, .block = &deposits, .says = "What every texel receives"},
    {.name = "model.glb",
     .kind = SP_KEY_FILE,
     .says = "The surface in the colours of the report, a node a part and a nozzle; for any viewer"},
    {.name = "surface.vtp", .kind = SP_KEY_FILE, .block = &surface, .says = "For ParaView"},
    {.name = "texels.vtp", .kind = SP_KEY_FILE, .block = &texels, .says = "For ParaView"},
    {.name = "nozzles.stl",
     .kind = SP_KEY_FILE,
     .says = "A body for each nozzle, in the coordinates and unit of the scene's first geometry file"},
    {.name = "wet.png", .kind = SP_KEY_FILE, .says = "Of `check`: what the liquid can get at, cut open and whole"},
    {.name = NULL}};
const sp_block sp_block_files = {"files", "files of a result",
                                 "Those of the proposed layout, of `simulate` of the scene's own; other layouts have "
                                 "theirs with -manual, -greedy. They appear together, whole or not at all",
                                 files_keys};
