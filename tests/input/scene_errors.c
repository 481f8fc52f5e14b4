/* Everything that can be wrong with a scene or a catalogue: where it is, what was found and what was expected, word for
 * word. */
#include "../scene/scratch.h"

#include <sprayplan/scene.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

typedef struct {
    const char *find, *replace; /* the slip, made in a file that is good */
    const char *expected;       /* to its end, or up to "..." */
} slip;

/* Quantities of each kind: no number, no unit, a wrong unit, out of range. */
static const slip quantities[] = {
    {"9.8 m/s2", "9.8",
     "scene.yaml:15:10: gravity: found '9.8', expected an acceleration of at least 0 such as 9.81 m/s2 (it has no "
     "unit)"},
    {"9.8 m/s2", "fast",
     "scene.yaml:15:10: gravity: found 'fast', expected an acceleration of at least 0 such as 9.81 m/s2"},
    {"9.8 m/s2", "9.8 m/s",
     "scene.yaml:15:10: gravity: found '9.8 m/s', expected an acceleration of at least 0 such as 9.81 m/s2 ('m/s' "
     "measures something else)"},
    {"9.8 m/s2", "-1 m/s2",
     "scene.yaml:15:10: gravity: found '-1 m/s2', expected an acceleration of at least 0 such as 9.81 m/s2"},
    {"9.8 m/s2", "[9.8 m/s2]",
     "scene.yaml:15:10: gravity: found a list of 1, expected an acceleration of at least 0 such as 9.81 m/s2"},
    {"9.8 m/s2", "981 gal",
     "scene.yaml:15:10: gravity: found '981 gal', expected an acceleration of at least 0 such as 9.81 m/s2 (gal is the "
     "Galileo here: write gpm for US gallons per minute, or L/min)"},
    {"9.8 m/s2", "inf m/s2",
     "scene.yaml:15:10: gravity: found 'inf m/s2', expected an acceleration of at least 0 such as 9.81 m/s2"},
    {"9.8 m/s2", "1e999 m/s2",
     "scene.yaml:15:10: gravity: found '1e999 m/s2', expected an acceleration of at least 0 such as 9.81 m/s2 (it is "
     "not finite)"},
    {"gravity: 9.8 m/s2",
     "gravity:", "scene.yaml:15:1: gravity: found nothing, expected an acceleration of at least 0 such as 9.81 m/s2"},
    {"1.1 g/cm3", "0 kg/m3",
     "scene.yaml:13:19: density: found '0 kg/m3', expected a density above 0 such as 1000 kg/m3"},
    {"2 mPa.s", "2 mPa",
     "scene.yaml:13:41: viscosity: found '2 mPa', expected a viscosity above 0 such as 1 mPa.s ('mPa' measures "
     "something else)"},
    {"40 mN/m", "0 mN/m",
     "scene.yaml:13:67: surface_tension: found '0 mN/m', expected a surface tension above 0 such as 72 mN/m"},
    {"20 uPa.s}", "20 uPa.s, surface_tension: 1 N/m}",
     "scene.yaml:14:48: surface_tension: found a key that the air does not have, expected one of density, "
     "viscosity"},
    {"20 uPa.s", "-2 uPa.s",
     "scene.yaml:14:38: viscosity: found '-2 uPa.s', expected a viscosity above 0 such as 1 mPa.s"},
    {"1 L/min/m2", "1 L/min",
     "scene.yaml:16:19: flux: found '1 L/min', expected a flux of at least 0 such as 1 L/min/m2 ('L/min' measures "
     "something else)"},
    {"1 L/min/m2", "-1 L/min/m2",
     "scene.yaml:16:19: flux: found '-1 L/min/m2', expected a flux of at least 0 such as 1 L/min/m2"},
    {"3.6 km/h", "3.6",
     "scene.yaml:16:45: impact_speed: found '3.6', expected a speed of at least 0 such as 1 m/s (it has no unit)"},
    {"60 deg, combine", "95 deg, combine",
     "scene.yaml:16:66: incidence: found '95 deg', expected an angle above 0 to 90 deg such as 30 deg"},
    {"60 deg, combine", "0 deg, combine",
     "scene.yaml:16:66: incidence: found '0 deg', expected an angle above 0 to 90 deg such as 30 deg"},
    {"60 deg, combine", "60, combine",
     "scene.yaml:16:66: incidence: found '60', expected an angle above 0 to 90 deg such as 30 deg (it has no unit)"},
    {"60 deg, combine", "60 %, combine",
     "scene.yaml:16:66: incidence: found '60 %', expected an angle above 0 to 90 deg such as 30 deg ('%' measures "
     "something else)"},
    {"unit: mm", "unit: bar",
     "scene.yaml:4:11: unit: found 'bar', expected a unit of length such as mm ('bar' measures something else)"},
    {"unit: mm", "unit: 25.4 mm",
     "scene.yaml:4:11: unit: found '25.4 mm', expected a unit of length such as mm ('25.4 mm' is no known unit)"},
    {"unit: mm", "unit: [mm]", "scene.yaml:4:11: unit: found a list of 1, expected a unit of length such as mm"},
    {"scale: 2", "scale: 0", "scene.yaml:5:12: scale: found '0', expected a number without unit above 0 such as 0.5"},
    {"scale: 2", "scale: 2 m",
     "scene.yaml:5:12: scale: found '2 m', expected a number without unit above 0 such as 0.5 ('m' measures something "
     "else)"},
    {"restitution: 0.5", "restitution: 1.5",
     "scene.yaml:8:18: restitution: found '1.5', expected a share from 0 to 1 such as 95 %"},
    {"rebound: 80 %", "rebound: 80", "scene.yaml:9:14: rebound: found '80', expected a share from 0 to 1 such as 95 %"},
    {"angle: 90 deg}", "angle: 90}",
     "scene.yaml:7:38: angle: found '90', expected an angle such as 30 deg (it has no unit)"},
    {"[0 mm, 100 mm, 0.5]", "[0 mm, 100 mm]",
     "scene.yaml:6:16: translate: found a list of 2, expected a list of three values such as [0, 0, 1]"},
    {"[0 mm, 100 mm, 0.5]", "[0 mm, 2 bar, 0.5]",
     "scene.yaml:6:23: translate: found '2 bar', expected a length such as 250 mm ('bar' measures something else)"},
    {"[0 mm, 100 mm, 0.5]", "5 mm",
     "scene.yaml:6:16: translate: found '5 mm', expected a list of three values such as [0, 0, 1]"},
    {"[0 mm, 100 mm, 0.5]", "[0 mm, [1], 0.5]",
     "scene.yaml:6:23: translate: found a list of 1, expected a length such as 250 mm"},
    {"[0 mm, 100 mm, 0.5]", "[0 mm, 2e30, -1e300]",
     "scene.yaml:6:16: translate: found a coordinate beyond 1e30 m, expected less"},
    {"axis: [0, 0, 2]", "axis: [0, 0, 0]",
     "scene.yaml:7:20: axis: found a vector of length 0, expected a direction such as [0, 0, -1]"},
    {"axis: [0, 0, -3]", "axis: [0, 0, -0.0]",
     "scene.yaml:19:61: axis: found a vector of length 0, expected a direction such as [0, 0, -1]"},
    {"axis: [0, 0, -3]", "axis: [0, 0, 1 m]",
     "scene.yaml:19:68: axis: found '1 m', expected a number without unit such as 0.5 ('m' measures something else)"},
    {"roll: -30 deg", "roll: -30",
     "scene.yaml:20:71: roll: found '-30', expected an angle such as 30 deg (it has no unit)"},
    {"pressure: 3 bar", "pressure: 0 bar",
     "scene.yaml:20:90: pressure: found '0 bar', expected a pressure above 0 such as 2 bar"},
    {"pressure: 3 bar", "pressure: 3 m",
     "scene.yaml:20:90: pressure: found '3 m', expected a pressure above 0 such as 2 bar ('m' measures something "
     "else)"},
    {"speed: 12 m/s", "speed: 0 m/s", "scene.yaml:21:45: speed: found '0 m/s', expected a speed above 0 such as 1 m/s"},
    {"texel: 5 mm", "texel: 0", "scene.yaml:27:10: texel: found '0', expected a length above 0 such as 250 mm"},
    {"accuracy: 2 %", "accuracy: 2",
     "scene.yaml:29:13: accuracy: found '2', expected a share above 0 to 1 such as 95 %"},
    {"accuracy: 2 %", "accuracy: 0",
     "scene.yaml:29:13: accuracy: found '0', expected a share above 0 to 1 such as 95 %"},
    {"coverage: 95 %", "coverage: 95",
     "scene.yaml:33:13: coverage: found '95', expected a share above 0 to 1 such as 95 %"},
    {"max_water: 200 L/min", "max_water: 200",
     "scene.yaml:35:14: max_water: found '200', expected a flow above 0 such as 12 L/min (it has no unit)"},
    {"clearance: 50 mm", "clearance: -50 mm",
     "scene.yaml:38:14: clearance: found '-50 mm', expected a length of at least 0 such as 250 mm"},
    {"[1 bar, 2 bar]", "[1 bar, 2]",
     "scene.yaml:37:21: pressure: found '2', expected a pressure above 0 such as 2 bar (it has no unit)"},
    {"tilt: 180 deg", "tilt: 181 deg",
     "scene.yaml:40:69: tilt: found '181 deg', expected an angle from 0 to 180 deg such as 30 deg"},
    {"from: 50 mm", "from: -50 mm",
     "scene.yaml:41:28: from: found '-50 mm', expected a length of at least 0 such as 250 mm"},
    {"spacing: 100 mm, standoff", "spacing: 0 mm, standoff",
     "scene.yaml:42:50: spacing: found '0 mm', expected a length above 0 such as 250 mm"},
    {"standoff: 50 mm", "standoff: -1",
     "scene.yaml:42:68: standoff: found '-1', expected a length of at least 0 such as 250 mm"},
    {"position: 20 mm", "position: -20 mm",
     "scene.yaml:45:22: position: found '-20 mm', expected a length of at least 0 such as 250 mm"},
    {"axis: 5 deg", "axis: 5",
     "scene.yaml:45:35: axis: found '5', expected an angle from 0 to 180 deg such as 30 deg (it has no unit)"},
    {"flow: 25 %}", "flow: -1 %}", "scene.yaml:45:76: flow: found '-1 %', expected a share of at least 0 such as 95 %"},
};

/* Keys unknown, twice, missing. */
static const slip keys[] = {
    {"up: y", "upp: y", "scene.yaml:1:1: upp: found a key that a scene does not have, expected 'up'"},
    {"gravity:", "color:",
     "scene.yaml:15:1: color: found a key that a scene does not have, expected one of up, geometry, cavity, caps, "
     "liquid, "
     "air, gravity, criterion, catalogue, nozzles, simulate, place, datum, report"},
    {"unit: mm", "units: mm", "scene.yaml:4:5: units: found a key that a geometry file does not have, expected 'unit'"},
    {"density: 1.1", "densty: 1.1",
     "scene.yaml:13:10: densty: found a key that the liquid does not have, expected 'density'"},
    {"flux: 1", "flow: 1", "scene.yaml:16:13: flow: found a key that the criterion does not have, expected 'flux'"},
    {"angle: 90 deg}", "angle: 90 deg, about: 3}",
     "scene.yaml:7:46: about: found a key that a rotation does not have, expected one of axis, angle"},
    {"roll: -30", "rol: -30", "scene.yaml:20:65: rol: found a key that a nozzle does not have, expected 'roll'"},
    {"simulate:\n", "simulate:\n  jet: 3\n",
     "scene.yaml:23:3: jet: found a key that the simulation does not have, expected 'jets'"},
    {"max_water:", "maxwater:",
     "scene.yaml:35:3: maxwater: found a key that the placement does not have, expected 'max_water'"},
    {"- line:", "- lines:", "scene.yaml:43:7: lines: found a key that a mount does not have, expected 'line'"},
    {"standoff:", "stand_off:",
     "scene.yaml:42:58: stand_off: found a key that a surface does not have, expected 'standoff'"},
    {"to: 400 mm, ", "to: 400 mm, too: 1, ",
     "scene.yaml:41:47: too: found a key that a lance does not have, expected 'to'"},
    {"roll: false", "twist: false",
     "scene.yaml:45:42: twist: found a key that refinement does not have, expected one of position, axis, roll, angle, "
     "flow"},
    {"tilt: 10 deg", "tilt: 10 deg, types: [cone]",
     "scene.yaml:43:77: types: found a key that a line does not have, expected one of from, to, spacing, axis, tilt, "
     "name, max_nozzles, cost"},
    {"gravity: 9.8", "up: z\ngravity: 9.8", "scene.yaml:15:1: up: found a second time, expected once"},
    {"jets: 5000", "jets: 5000, jets: 6000", "scene.yaml:21:65: jets: found a second time, expected once"},
    {"geometry:\n  -", "nozzle:\n  -",
     "scene.yaml:2:1: nozzle: found a key that a scene does not have, expected 'nozzles'"},
    {"  - file: tank.obj\n    unit", "  - unit",
     "scene.yaml:3:5: file: found nothing, expected this key in a geometry file"},
    {"axis: [0, 0, 2], ", "", "scene.yaml:7:13: axis: found nothing, expected this key in a rotation"},
    {"name: N2, ", "", "scene.yaml:20:5: name: found nothing, expected this key in a nozzle"},
    {", pressure: 2 bar}", "}", "scene.yaml:19:5: pressure: found nothing, expected this key in a nozzle"},
    {"axis: [1, 2, 2], ", "", "scene.yaml:20:5: axis: found nothing, expected this key in a nozzle"},
    {"name: P1, ", "", "scene.yaml:40:13: name: found nothing, expected this key in a port"},
    {"geometry: 1, ", "", "scene.yaml:42:16: geometry: found nothing, expected this key in a surface"},
    {"spacing: 100 mm, standoff", "standoff",
     "scene.yaml:42:16: spacing: found nothing, expected this key in a surface"},
    {"spacing: 100 mm, tilt", "tilt",
     "scene.yaml:43:13: spacing: found nothing, expected this key where there is more than a point"},
    {"to: 400 mm, ", "", "scene.yaml:41:21: to: found nothing, expected this key in a lance"},
    {", spacing: 50 mm}", "}",
     "scene.yaml:41:21: spacing: found nothing, expected this key where there is more than a point"},
    {"max: [1, 1, 0], ", "", "scene.yaml:44:12: max: found nothing, expected this key in a box"},
    {"  pressure: [1 bar, 2 bar]\n", "", "scene.yaml:32:3: pressure: found nothing, expected this key beside mounts"},
};

/* Values of the wrong kind, names that are not there, settings that contradict each other. */
static const slip kinds[] = {
    {"up: y", "up: x", "scene.yaml:1:5: up: found 'x', expected z or y"},
    {"up: y", "up: [y]", "scene.yaml:1:5: up: found a list of 1, expected z or y"},
    {"role: obstacle", "role: dirty", "scene.yaml:11:31: role: found 'dirty', expected clean or obstacle"},
    {"[0.1 m, 20 cm, 0.3]", "inside",
     "scene.yaml:12:9: cavity: found 'inside', expected a point such as [0 m, 0 m, 1 m], or outside"},
    {"[0.1 m, 20 cm, 0.3]", "[0.1 m, 20 cm]",
     "scene.yaml:12:9: cavity: found a list of 2, expected a list of three values such as [0, 0, 1]"},
    {"combine: single", "combine: mean", "scene.yaml:16:83: combine: found 'mean', expected sum or single"},
    {"liquid: {density: 1.1 g/cm3, viscosity: 2 mPa.s, surface_tension: 40 mN/m}", "liquid: water",
     "scene.yaml:13:9: liquid: found 'water', expected the keys of the liquid"},
    {"liquid: {density: 1.1 g/cm3, viscosity: 2 mPa.s, surface_tension: 40 mN/m}", "liquid: [1]",
     "scene.yaml:13:9: liquid: found a list of 1, expected the keys of the liquid"},
    {"name: N2", "name: N1", "scene.yaml:20:12: name: found 'N1', expected a name that no other nozzle has"},
    {"name: N2", "name: [N2]", "scene.yaml:20:12: name: found a list of 1, expected a name"},
    {"name: N2", "name: ''", "scene.yaml:20:12: name: found '', expected a name"},
    {"name: N2", "name: NNNNNNNNNNNNNNNNNNNNNNNNNNNNNNNNNNNNNNNNNNNNNNNNNNNNNNNNNNNNNNNN",
     "scene.yaml:20:12: name: found 'NNNNNNNNNNNNNNNNNNNNNNNNNNNNNNNNNNNNNNNNNNNNNNNNNNNNNNNNNNNNNNNN', expected a "
     "name of at most 63 bytes"},
    {"name: N2", "name: \"N\\t2\"",
     "scene.yaml:20:12: name: found a name with a control character, expected printable text"},
    {"type: set", "type: seet",
     "scene.yaml:20:22: type: found 'seet', expected a type of the catalogue, perhaps 'set'"},
    {"type: set", "type: nowhere",
     "scene.yaml:20:22: type: found 'nowhere', expected a type of the catalogue, which has 'cone' and others"},
    {"type: set", "type: {}",
     "scene.yaml:20:22: type: found a block of keys, expected the name of a type in the catalogue"},
    {"keep: true", "keep: yes", "scene.yaml:21:71: keep: found 'yes', expected true or false"},
    {"jets: 5000", "jets: 0", "scene.yaml:21:59: jets: found '0', expected a whole number from 1 to 1000000000000"},
    {"jets: 5000", "jets: 5e3", "scene.yaml:21:59: jets: found '5e3', expected a whole number from 1 to 1000000000000"},
    {"jets: 5000", "jets: -5", "scene.yaml:21:59: jets: found '-5', expected a whole number from 1 to 1000000000000"},
    {"jets: 5000", "jets: many",
     "scene.yaml:21:59: jets: found 'many', expected a whole number from 1 to 1000000000000"},
    {"angle: 100 deg, flow", "angle: 130 deg, flow",
     "scene.yaml:21:13: angle: found '130 deg', expected an angle within the range of 'set', 60 deg to 120 deg"},
    {"flow: 22 L/min", "flow: 60 L/min",
     "scene.yaml:21:28: flow: found '60 L/min', expected a flow within the range of 'set' at this pressure, 11.6775 "
     "L/min to 35.0325 L/min"},
    {"name: N1,", "name: N1, angle: 90 deg,",
     "scene.yaml:19:23: angle: found '90 deg', expected this key only with an adjustable type, and 'cone' has no "
     "angle_range"},
    {"name: N1,", "name: N1, flow: 12 L/min,",
     "scene.yaml:19:22: flow: found '12 L/min', expected this key only with an adjustable type, and 'cone' has no "
     "flow_range"},
    {"trajectory: line", "trajectory: curve",
     "scene.yaml:23:15: trajectory: found 'curve', expected auto, line, parabola or drag"},
    {"evaluator: forward", "evaluator: both",
     "scene.yaml:24:14: evaluator: found 'both', expected auto, forward or inverse"},
    {"reflections: 3", "reflections: -1",
     "scene.yaml:25:16: reflections: found '-1', expected a whole number from 0 to 1000"},
    {"reflections: 3", "reflections: 2.5",
     "scene.yaml:25:16: reflections: found '2.5', expected a whole number from 0 to 1000"},
    {"reflections: 3", "reflections: 1001",
     "scene.yaml:25:16: reflections: found '1001', expected a whole number from 0 to 1000"},
    {"jets: 20000", "jets: 0", "scene.yaml:26:9: jets: found '0', expected a whole number from 1 to 1000000000000"},
    {"texel: 5 mm", "texel: coarse",
     "scene.yaml:27:10: texel: found 'coarse', expected a length above 0 such as 250 mm"},
    {"splat: linear", "splat: cubic", "scene.yaml:28:10: splat: found 'cubic', expected nearest or linear"},
    {"seed: 18446744073709551615", "seed: 18446744073709551616",
     "scene.yaml:30:9: seed: found '18446744073709551616', expected a whole number from 0 to 18446744073709551615"},
    {"objective: max_coverage", "objective: most",
     "scene.yaml:32:14: objective: found 'most', expected area_per_water, min_water or max_coverage"},
    {"max_nozzles: 12", "max_nozzles: 0",
     "scene.yaml:34:16: max_nozzles: found '0', expected a whole number from 1 to 10000"},
    {"types: [fan, cone]", "types: [fan, fan]", "scene.yaml:36:16: types: found 'fan', expected each type once"},
    {"types: [fan, cone]", "types: []", "scene.yaml:36:10: types: found an empty list, expected a list of type names"},
    {"types: [fan, cone]", "types: fan", "scene.yaml:36:10: types: found 'fan', expected a list of type names"},
    {"types: [fan, cone]", "types: [fan, con]",
     "scene.yaml:36:16: types: found 'con', expected a type of the catalogue, perhaps 'cone'"},
    {"types: [jet]", "types: [water]",
     "scene.yaml:41:72: types: found 'water', expected a type of the catalogue, which has 'cone' and others"},
    {"[1 bar, 2 bar]", "[1 bar, 100 kPa]", "scene.yaml:37:21: pressure: found '100 kPa', expected each pressure once"},
    {"[1 bar, 2 bar]", "[]", "scene.yaml:37:13: pressure: found an empty list, expected a pressure or several"},
    {"refine: {position: 20 mm, axis: 5 deg, roll: false, angle: 20 deg, flow: 25 %}", "refine: all",
     "scene.yaml:45:11: refine: found 'all', expected none, or keys such as {position: 50 mm, axis: 15 deg}"},
    {"refine: {position: 20 mm, axis: 5 deg, roll: false, angle: 20 deg, flow: 25 %}", "refine: []",
     "scene.yaml:45:11: refine: found an empty list, expected none, or keys such as {position: 50 mm, axis: 15 deg}"},
    {"roll: false", "roll: 3 deg", "scene.yaml:45:48: roll: found '3 deg', expected true or false"},
    {"- line: {from", "- box: {min: [0,0,0], max: [0,0,0]}\n      line: {from",
     "scene.yaml:43:7: mounts: found 2 keys, expected one of port, surface, line, box"},
    {"    - line: {from: [0, 0, 0], to: [1, 0, 0], spacing: 100 mm, tilt: 10 deg}\n", "    - line\n",
     "scene.yaml:43:7: mounts: found 'line', expected the keys of a mount"},
    {"    - line: {from: [0, 0, 0], to: [1, 0, 0], spacing: 100 mm, tilt: 10 deg}\n",
     "    - {port: {name: P1, position: [0, 0, 0]}}\n",
     "scene.yaml:43:21: name: found 'P1', expected a name that no other port has"},
    {"geometry: 1,", "geometry: 2,", "scene.yaml:42:27: geometry: found '2', expected a whole number from 0 to 1"},
    {"part: lid", "part: roof",
     "scene.yaml:42:36: part: found 'roof', expected a part of that geometry: floor, wall_a, wall_b, lid"},
    {"to: 400 mm", "to: 40 mm", "scene.yaml:41:39: to: found '40 mm', expected a length of at least `from`, 0.05 m"},
    {"spacing: 100 mm, tilt", "spacing: 1 nm, tilt",
     "scene.yaml:43:55: spacing: found '1 nm', expected one that gives at most 100000 points, not 1000000000"},
    {"spacing: 150 mm", "spacing: 0.1 mm",
     "scene.yaml:44:54: spacing: found '0.1 mm', expected one that gives at most 100000 points, not 100020001"},
    {"max: [1, 1, 0]", "max: [1, -1, 0]",
     "scene.yaml:44:34: max: found a list of 3, expected no coordinate below that of `min`"},
};

/* Files that are missing. */
static const slip missing_files[] = {
    {"file: tank.obj", "file: missing.obj",
     "scene.yaml:3:11: file: found 'missing.obj', which cannot be opened (No such file or directory), expected a file, "
     "relative to the scene"},
    {"catalogue: catalogue.yaml", "catalogue: none.yaml",
     "scene.yaml:17:12: catalogue: found 'none.yaml', which cannot be opened (No such file or directory), expected a "
     "file, relative to the scene"},
    {"catalogue: catalogue.yaml", "catalogue: .",
     "scene.yaml:17:12: catalogue: found '.', which is no regular file, expected a file, relative to the scene"},
};

/* Files that are something else, parts that are not in them. */
static const slip files[] = {
    {"file: tank.obj", "file: tank.xyz",
     "scene.yaml:3:11: file: found 'tank.xyz', expected a file that ends in .obj, .stl, .ply, .step, .stp, .iges, "
     ".igs, .brep or .brp"},
    {"file: tank.obj", "file: tank",
     "scene.yaml:3:11: file: found 'tank', expected a file that ends in .obj, .stl, .ply, .step, .stp, .iges, .igs, "
     ".brep or .brp"},
    {"file: tank.obj", "file: tank.STEP",
     "scene.yaml:4:11: unit: found beside a STEP or IGES file, which knows its own, expected beside others only"},
    {"file: tank.obj", "file: tank.igs",
     "scene.yaml:4:11: unit: found beside a STEP or IGES file, which knows its own, expected beside others only"},
    {"file: tank.obj", "file: tank.brep",
     "scene.yaml:3:11: file: found 'tank.brep', which cannot be opened (No such file or directory), expected a file, "
     "relative to the scene"},
    {"file: tank.obj", "file: tank.obj\n    chord: 1 mm",
     "scene.yaml:4:12: chord: found beside a file of triangles, expected beside STEP, IGES and BREP only"},
    {"file: tank.obj", "file: tank.obj\n    angle: 5 deg",
     "scene.yaml:4:12: angle: found beside a file of triangles, expected beside STEP, IGES and BREP only"},
    {"file: tank.obj", "file: tank.brep\n    chord: 0 mm",
     "scene.yaml:4:12: chord: found '0 mm', expected a length above 0 such as 250 mm"},
    {"file: tank.obj", "file: tank.brep\n    angle: 91 deg", "scene.yaml:4:12: angle: found '91 deg', expected ..."},
    {"file: tank.obj", "file: [tank.obj]", "scene.yaml:3:11: file: found a list of 1, expected the path of a file"},
    {"file: tank.obj", "file: \"\"", "scene.yaml:3:11: file: found '', expected the path of a file"},
    {"catalogue: catalogue.yaml\n", "",
     "scene.yaml:18:22: type: found 'cone', expected a type of the catalogue, of which this scene has none "
     "(catalogue:)"},
    {"catalogue: catalogue.yaml", "catalogue: tank.obj",
     "tank.obj:1:1: catalogue: found 'v 0 0 0 v 1 0 0 v 0 1 0 v 0 0 1 g floor f 1 3 2 g wall_a f 1 2 4 g wall_b f 1 4 "
     "...', expected the keys of a catalogue"},
    {"[floor, \"wall_*\"]", "[floor, \"walls_*\"]",
     "scene.yaml:10:26: clean_parts: found 'walls_*', expected a name or glob that fits a part of this file: floor, "
     "wall_a, wall_b, lid"},
    {"[floor, \"wall_*\"]", "floor", "scene.yaml:10:18: clean_parts: found 'floor', expected a list of part names"},
    {"[floor, \"wall_*\"]", "[[floor]]",
     "scene.yaml:10:19: clean_parts: found a list of 1, expected the name of a part, or a glob such as baffle*"},
    {"role: obstacle", "role: obstacle, clean_parts: [lid]",
     "scene.yaml:11:54: clean_parts: found beside role: obstacle, expected with role: clean only"},
    {"geometry:\n  - file: tank.obj\n    unit: mm\n    scale: 2\n    translate: [0 mm, 100 mm, 0.5]\n    rotate: "
     "{axis: [0, 0, 2], angle: 90 deg}\n    restitution: 0.5\n    rebound: 80 %\n    clean_parts: [floor, "
     "\"wall_*\"]\n  - {file: stirrer.obj, role: obstacle}\n",
     "geometry: []\n", "scene.yaml:2:11: geometry: found an empty list, expected a list of 1 to 10000 files"},
};

/* Not YAML, or YAML that is refused. Where libfyaml says what is wrong, only the place is checked. */
static const slip syntax[] = {
    {"up: y", "up: [y", "scene.yaml:3:3: YAML: ..."},
    {"up: y", "up: \"y", "scene.yaml:1:5: YAML: ..."},
    {"up: y", "up: y\n up: z", "scene.yaml:1:5: YAML: ..."},
    {"up: y", "up: &u y", "scene.yaml:1:5: YAML: found an anchor, expected a value without one"},
    {"up: y", "up: *u", "scene.yaml:1:5: YAML: found an alias, expected its value written out"},
    {"up: y", "up: !!str y", "scene.yaml:1:5: YAML: found a tag, expected a value without one"},
    {"up: y", "? [a]\n: y", "scene.yaml:1:3: YAML: found a list or block as a key, expected a name"},
    {"up: y", "	up: y", "scene.yaml:1:1: YAML: ..."},
    {"up: y", "up: \"\\q\"", "scene.yaml:1:6: YAML: ..."},
    {"up: y", "up: y\n---\nup: z", "scene.yaml:2:1: YAML: found a second document, expected one"},
    {"up: y", "up: [[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]",
     "scene.yaml:1:36: YAML: found more than 32 levels of nesting, expected fewer"},
    {"up: y",
     "up: "
     "[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]"
     "]]]]]]]]]]]]]]]]]]]]]]]]]]]",
     "scene.yaml:1:36: YAML: found more than 32 levels of nesting, expected fewer"},
    {"up: y", "up: y\n<<: {up: z}",
     "scene.yaml:2:1: <<: found a key that a scene does not have, expected one of up, geometry, cavity, caps, liquid, "
     "air, "
     "gravity, criterion, catalogue, nozzles, simulate, place, datum, report"},
    {"up: y\ngeometry:", "geometry", "scene.yaml:1:1: YAML: ..."},
    {"up: y", "- up: y", "scene.yaml:2:1: YAML: ..."},
};

/* The same in the catalogue. */
static const slip catalogue_slips[] = {
    {"name: ring, ", "", "catalogue.yaml:3:5: name: found nothing, expected this key in a catalogue type"},
    {"name: ring", "name: cone", "catalogue.yaml:3:12: name: found 'cone', expected a name that no other type has"},
    {"pattern: hollow_cone, ", "", "catalogue.yaml:3:5: pattern: found nothing, expected this key in a catalogue type"},
    {"pattern: hollow_cone", "pattern: spiral",
     "catalogue.yaml:3:27: pattern: found 'spiral', expected full_cone, hollow_cone, flat_fan, solid_stream, cluster, "
     "rotating or measured"},
    {"angle: 90 deg, flow", "flow", "catalogue.yaml:2:5: angle: found nothing, expected this key in a full_cone"},
    {"angle: 90 deg, flow", "angle: 400 deg, flow",
     "catalogue.yaml:2:45: angle: found '400 deg', expected an angle above 0 to 360 deg such as 30 deg"},
    {"angle: 90 deg, flow", "angle: 0 deg, flow",
     "catalogue.yaml:2:45: angle: found '0 deg', expected an angle above 0 to 360 deg such as 30 deg"},
    {"hollow: 0.7, ", "", "catalogue.yaml:3:5: hollow: found nothing, expected this key in a hollow_cone"},
    {"hollow: 0.7", "hollow: 1",
     "catalogue.yaml:3:63: hollow: found '1', expected a share from 0 to below 1 such as 95 %"},
    {"thickness: 8 deg, ", "", "catalogue.yaml:4:5: thickness: found nothing, expected this key in a flat_fan"},
    {"thickness: 8 deg", "thickness: 200 deg",
     "catalogue.yaml:4:62: thickness: found '200 deg', expected an angle above 0 to 180 deg such as 30 deg"},
    {"angle: 90 deg, flow", "angle: 90 deg, hollow: 0.5, flow",
     "catalogue.yaml:2:61: hollow: found in a full_cone, expected in a hollow_cone only"},
    {"flow: 5 L/min", "thickness: 8 deg, flow: 5 L/min",
     "catalogue.yaml:5:51: thickness: found in a solid_stream, expected in a flat_fan only"},
    {"flow: 8 L/min, ", "", "catalogue.yaml:3:5: flow: found nothing, expected this key in a catalogue type"},
    {"at: 3 bar, ", "", "catalogue.yaml:3:5: at: found nothing, expected this key in a catalogue type"},
    {"flow: 2 gpm", "flow: 2 gal/min",
     "catalogue.yaml:4:75: flow: found '2 gal/min', expected a flow above 0 such as 12 L/min (gal is the Galileo here: "
     "write gpm for US gallons per minute, or L/min)"},
    {"flow: 2 gpm", "flow: 0 gpm",
     "catalogue.yaml:4:75: flow: found '0 gpm', expected a flow above 0 such as 12 L/min"},
    {"at: 40 psi", "at: 40",
     "catalogue.yaml:4:86: at: found '40', expected a pressure above 0 such as 2 bar (it has no unit)"},
    {"exponent: 0.46", "exponent: 1.5",
     "catalogue.yaml:3:104: exponent: found '1.5', expected a number without unit above 0 to 1 such as 0.5"},
    {"cv: 0.9", "cv: 90",
     "catalogue.yaml:4:98: cv: found '90', expected a number without unit above 0 to 1 such as 0.5"},
    {"drop: 2 mm", "drop: 0 mm",
     "catalogue.yaml:4:109: drop: found '0 mm', expected a length above 0 to 0.5 m such as 250 mm"},
    {"drop: 2 mm", "drop: 400",
     "catalogue.yaml:4:109: drop: found '400', expected a length above 0 to 0.5 m such as 250 mm"},
    {"drop: 2 mm", "rotation: {}", "catalogue.yaml:4:113: rotation: found in a flat_fan, expected in a rotating only"},
    {"drop: 2 mm", "drop: 2 mm, colour: red",
     "catalogue.yaml:4:115: colour: found a key that a catalogue type does not have, expected one of name, pattern, "
     "angle, hollow, thickness, flow, at, exponent, cv, drop, angle_range, flow_range, order_code, url, image, "
     "members, rotation, thread, insert, body, step, trajectory"},
    {"trajectory: line", "trajectory: curve",
     "catalogue.yaml:7:140: trajectory: found 'curve', expected auto, line, parabola or drag"},
    {"https://example.com/r", "javascript:alert(1)//",
     "catalogue.yaml:3:133: url: found 'javascript:alert(1)//?a=x&b=y', expected an address such as "
     "https://example.com/nozzle"},
    {"order_code: R-80", "order_code: [R]", "catalogue.yaml:3:122: order_code: found a list of 1, expected a name"},
    {"[60 deg, 120 deg]", "[60 deg]",
     "catalogue.yaml:7:19: angle_range: found a list of 1, expected a list of two values such as [30 deg, ...]"},
    {"[60 deg, 120 deg]", "60 deg",
     "catalogue.yaml:7:19: angle_range: found '60 deg', expected a list of two values such as [30 deg, ...]"},
    {"[60 deg, 120 deg]", "[120 deg, 60 deg]",
     "catalogue.yaml:7:19: angle_range: found '120 deg' before '60 deg', expected the smaller first"},
    {"[60 deg, 120 deg]", "[100 deg, 120 deg]",
     "catalogue.yaml:7:19: angle_range: found '100 deg' to '120 deg', expected a range that contains the type's own"},
    {"[10 L/min, 30 L/min]", "[10 L/min, 30 bar]",
     "catalogue.yaml:7:61: flow_range: found '30 bar', expected a flow above 0 such as 12 L/min ('bar' measures "
     "something else)"},
    {"pattern: solid_stream", "pattern: rotating",
     "catalogue.yaml:5:5: rotation: found nothing, expected this key in a rotating"},
    {"pattern: solid_stream", "pattern: rotating, rotation: 3",
     "catalogue.yaml:5:46: rotation: found '3', expected the keys of a rotation"},
    {"pattern: solid_stream", "pattern: rotating, rotation: {}",
     "catalogue.yaml:5:46: jet: found nothing, expected this key in a rotation"},
    {"pattern: solid_stream", "pattern: rotating, rotation: {jet: {pattern: rotating}}",
     "catalogue.yaml:5:62: pattern: found 'rotating', expected full_cone, hollow_cone, flat_fan or solid_stream "
     "in a jet"},
    {"pattern: solid_stream", "pattern: rotating, rotation: {jet: {pattern: cluster, members: []}}",
     "catalogue.yaml:5:62: pattern: found 'cluster', expected full_cone, hollow_cone, flat_fan or solid_stream "
     "in a jet"},
    {"pattern: solid_stream", "pattern: rotating, rotation: {jet: {pattern: flat_fan, angle: 60 deg}}",
     "catalogue.yaml:5:52: thickness: found nothing, expected this key in a flat_fan"},
    {"pattern: solid_stream", "pattern: rotating, rotation: {jet: {pattern: full_cone}}",
     "catalogue.yaml:5:52: angle: found nothing, expected this key in a full_cone"},
    {"pattern: solid_stream", "pattern: rotating, rotation: {jet: {angle: 60 deg}}",
     "catalogue.yaml:5:52: pattern: found nothing, expected this key in a jet"},
    {"pattern: solid_stream", "pattern: rotating, rotation: {jet: {pattern: solid_stream, tilt: 190 deg}}",
     "catalogue.yaml:5:82: tilt: found '190 deg', expected an angle from 0 to 180 deg such as 30 deg"},
    {"pattern: solid_stream", "pattern: rotating, angle: 60 deg, rotation: {jet: {pattern: solid_stream}}",
     "catalogue.yaml:5:43: angle: found in a rotating, expected in its jet"},
    {"pattern: solid_stream", "pattern: rotating, hollow: 0.5, rotation: {jet: {pattern: solid_stream}}",
     "catalogue.yaml:5:44: hollow: found in a rotating, expected in its jet"},
    {"pattern: solid_stream",
     "pattern: rotating, angle_range: [60 deg, 90 deg], rotation: {jet: {pattern: solid_stream}}",
     "catalogue.yaml:5:49: angle_range: found in a rotating, expected in another pattern only"},
    {"pattern: solid_stream", "pattern: rotating, rotation: {jet: {pattern: solid_stream, flow: 3 L/min}}",
     "catalogue.yaml:5:76: flow: found a key that a jet does not have, expected one of pattern, angle, hollow, "
     "thickness, tilt, roll"},
    {"pattern: solid_stream", "pattern: rotating, rotation: {jet: {pattern: solid_stream}, tilt: 3 deg}",
     "catalogue.yaml:5:77: tilt: found a key that a rotation does not have, expected one of jet, jets, gears, speed, "
     "turns"},
    {"pattern: solid_stream", "pattern: rotating, rotation: {jet: {pattern: solid_stream}, jets: 4}",
     "catalogue.yaml:5:83: jets: found '4', expected this key only beside gears, of what turns about two axes"},
    {"pattern: solid_stream", "pattern: rotating, rotation: {jet: {pattern: solid_stream}, speed: 4 rpm}",
     "catalogue.yaml:5:84: speed: found '4 rpm', expected this key only beside gears, of what turns about two axes"},
    {"pattern: solid_stream", "pattern: rotating, rotation: {jet: {pattern: solid_stream}, gears: [43, 47]}",
     "catalogue.yaml:5:46: jets: found nothing, expected this key beside gears"},
    {"pattern: solid_stream", "pattern: rotating, rotation: {jet: {pattern: solid_stream}, jets: 4, gears: 0.9}",
     "catalogue.yaml:5:93: gears: found '0.9', expected two numbers of teeth such as [43, 47]"},
    {"pattern: solid_stream",
     "pattern: rotating, rotation: {jet: {pattern: solid_stream}, jets: 4, gears: [43, 47, 50]}",
     "catalogue.yaml:5:93: gears: found a list of 3, expected two numbers of teeth such as [43, 47]"},
    {"pattern: solid_stream", "pattern: rotating, rotation: {jet: {pattern: solid_stream}, jets: 4, gears: [43, 0]}",
     "catalogue.yaml:5:98: gears: found '0', expected a number of teeth from 1 to 1000 such as 43"},
    {"pattern: solid_stream", "pattern: rotating, rotation: {jet: {pattern: solid_stream}, jets: 4, gears: [43, 4.5]}",
     "catalogue.yaml:5:98: gears: found '4.5', expected a whole number of teeth"},
    {"pattern: solid_stream", "pattern: rotating, rotation: {jet: {pattern: solid_stream}, jets: 17, gears: [43, 47]}",
     "catalogue.yaml:5:83: jets: found '17', expected a whole number from 1 to 16"},
    {"pattern: solid_stream",
     "pattern: rotating, rotation: {jet: {pattern: solid_stream}, jets: 4, gears: [43, 47], turns: 0}",
     "catalogue.yaml:5:110: turns: found '0', expected a whole number from 1 to 1000000"},
    {"pattern: solid_stream",
     "pattern: rotating, rotation: {jet: {pattern: solid_stream}, jets: 4, gears: [43, 47], speed: 3 m/s}",
     "catalogue.yaml:5:110: speed: found '3 m/s', expected a speed of rotation above 0 such as 3 rpm ('m/s' measures "
     "something else)"},
    {"pattern: solid_stream",
     "pattern: rotating, rotation: {jet: {pattern: solid_stream, tilt: 30 deg}, jets: 4, gears: [43, 47]}",
     "catalogue.yaml:5:82: tilt: found '30 deg', expected none beside gears: jets on a hub point outwards from it"},
    {"pattern: solid_stream",
     "pattern: rotating, rotation: {jet: {pattern: flat_fan, angle: 30 deg, thickness: 5 deg}, jets: 4, gears: [43, "
     "47]}",
     "catalogue.yaml:5:62: pattern: found 'flat_fan', expected full_cone, hollow_cone or solid_stream beside gears"},
    {"pattern: solid_stream",
     "pattern: rotating, rotation: {jet: {pattern: full_cone, angle: 91 deg}, jets: 4, gears: [43, 47]}",
     "catalogue.yaml:5:80: angle: found '91 deg', expected an angle of at most 90 deg beside gears"},
    {"pattern: solid_stream", "pattern: measured, angle: 90 deg",
     "catalogue.yaml:5:5: image: found nothing, expected this key in a measured"},
    {"pattern: solid_stream", "pattern: measured, image: fan.exr",
     "catalogue.yaml:5:5: angle: found nothing, expected this key in a measured"},
    {"drop: 2 mm", "image: fan.exr", "catalogue.yaml:4:110: image: found in a flat_fan, expected in a measured only"},
    {"pattern: solid_stream", "pattern: measured, angle: 90 deg, image: fan.exr, angle_range: [80 deg, 100 deg]",
     "catalogue.yaml:5:80: angle_range: found in a measured, expected in another pattern only"},
    {"pattern: solid_stream", "pattern: measured, angle: 361 deg, image: fan.exr",
     "catalogue.yaml:5:43: angle: found '361 deg', expected an angle above 0 to 360 deg such as 30 deg"},
    {"pattern: solid_stream", "pattern: measured, angle: 90 deg, image: [fan.exr]",
     "catalogue.yaml:5:58: image: found a list of 1, expected the path of a file"},
    {"pattern: solid_stream", "pattern: measured, angle: 90 deg, image: lost.exr",
     "catalogue.yaml:5:58: image: found 'lost.exr', which cannot be opened (No such file or directory), expected a "
     "file, relative to the catalogue"},
    {"pattern: solid_stream", "pattern: measured, angle: 90 deg, image: .",
     "catalogue.yaml:5:58: image: found '.', which is no regular file, expected a file, relative to the catalogue"},
    {"pattern: solid_stream", "pattern: measured, angle: 90 deg, image: tank.obj",
     "catalogue.yaml:5:58: image: found 'tank.obj': cannot be read: ..."},
    {"pattern: solid_stream", "pattern: rotating, rotation: {jet: {pattern: measured, image: fan.exr, angle: 9 deg}}",
     "catalogue.yaml:5:62: pattern: found 'measured', expected full_cone, hollow_cone, flat_fan or solid_stream "
     "in a jet"},
    {"pattern: solid_stream", "pattern: rotating, image: fan.exr, rotation: {jet: {pattern: solid_stream}}",
     "catalogue.yaml:5:43: image: found in a rotating, expected in a measured only"},
    {"nozzles:", "types:", "catalogue.yaml:1:1: types: found a key that a catalogue does not have, expected nozzles"},
    {"nozzles:", "nozzles: 3\nother:",
     "catalogue.yaml:2:1: other: found a key that a catalogue does not have, expected nozzles"},
    {"nozzles:\n", "nozzles:\n  - cone\n",
     "catalogue.yaml:2:5: nozzles: found 'cone', expected the keys of a catalogue type"},
    {"nozzles:\n", "nozzles:\n  -\n", "catalogue.yaml:2:3: name: found nothing, expected this key in a catalogue type"},
};

/* Clusters and their members. */
static const slip clusters[] = {
    {"flow: 40 L/min", "flow: 40 L/min\n    angle: 360 deg",
     "catalogue.yaml:11:12: angle: found in a cluster, expected angles in its members only"},
    {"flow: 40 L/min", "flow: 40 L/min\n    angle_range: [10 deg, 20 deg]",
     "catalogue.yaml:11:18: angle_range: found in a cluster, expected angles in its members only"},
    {"flow: 40 L/min", "flow: 40 L/min\n    thickness: 8 deg",
     "catalogue.yaml:11:16: thickness: found in a cluster, expected in a flat_fan only"},
    {"pattern: cluster", "pattern: solid_stream",
     "catalogue.yaml:13:7: members: found in a solid_stream, expected in a cluster only"},
    {"pattern: full_cone, angle: 90 deg, flow: 12 L/min", "pattern: cluster, flow: 12 L/min",
     "catalogue.yaml:2:5: members: found nothing, expected this key in a cluster"},
    {"pattern: full_cone, angle: 90 deg, flow: 12 L/min", "pattern: cluster, members: [], flow: 12 L/min",
     "catalogue.yaml:2:45: members: found an empty list, expected a list of patterns such as [{pattern: solid_stream, "
     "axis: [0, 0, 1]}, ...]"},
    {"pattern: full_cone, angle: 90 deg, flow: 12 L/min", "pattern: cluster, members: 12, flow: 12 L/min",
     "catalogue.yaml:2:45: members: found '12', expected a list of patterns such as [{pattern: solid_stream, "
     "axis: [0, 0, 1]}, ...]"},
    {"{pattern: solid_stream, offset: [0, 0, 14 mm], share: 2}", "ball",
     "catalogue.yaml:13:9: members: found 'ball', expected the keys of a member of a cluster"},
    {"{pattern: solid_stream, offset", "{offset",
     "catalogue.yaml:13:9: pattern: found nothing, expected this key in a member of a cluster"},
    {"{pattern: solid_stream, offset", "{pattern: cluster, offset",
     "catalogue.yaml:13:19: pattern: found 'cluster', expected full_cone, hollow_cone, flat_fan, solid_stream or "
     "measured in a cluster"},
    {"{pattern: solid_stream, offset", "{pattern: spiral, offset",
     "catalogue.yaml:13:19: pattern: found 'spiral', expected full_cone, hollow_cone, flat_fan, solid_stream, cluster, "
     "rotating or measured"},
    {"share: 2}", "flow: 2 L/min}",
     "catalogue.yaml:13:56: flow: found a key that a member of a cluster does not have, expected one of pattern, "
     "angle, hollow, thickness, axis, offset, roll, share, ring, image"},
    {"share: 2}", "share: 0}",
     "catalogue.yaml:13:63: share: found '0', expected a number without unit above 0 to 1e+06 such as 0.5"},
    {"share: 2}", "share: 2 L/min}",
     "catalogue.yaml:13:63: share: found '2 L/min', expected a number without unit above 0 to 1e+06 such as 0.5 "
     "('L/min' measures something else)"},
    {"[0, 0, 14 mm]", "14 mm",
     "catalogue.yaml:13:41: offset: found '14 mm', expected a list of three values such as [0, 0, 1]"},
    {"[0, 0, 14 mm]", "[0, 0, 14 deg]",
     "catalogue.yaml:13:48: offset: found '14 deg', expected a length such as 250 mm ('deg' measures something else)"},
    {"angle: 60 deg, thickness: 8 deg, axis", "angle: 60 deg, axis",
     "catalogue.yaml:14:9: thickness: found nothing, expected this key in a flat_fan"},
    {"[3, 0, 4]", "[0, 0, 0]",
     "catalogue.yaml:14:68: axis: found a vector of length 0, expected a direction such as [0, 0, -1]"},
    {"roll: 90 deg", "roll: 90",
     "catalogue.yaml:14:85: roll: found '90', expected an angle such as 30 deg (it has no unit)"},
    {"roll: 90 deg", "angle_range: [50 deg, 70 deg]",
     "catalogue.yaml:14:79: angle_range: found a key that a member of a cluster does not have, expected one of "
     "pattern, "
     "angle, hollow, thickness, axis, offset, roll, share, ring, image"},
    {"angle: 3 deg, ring", "axis: [0, 0, 1], ring",
     "catalogue.yaml:15:39: axis: found beside a ring, expected one of them"},
    {"count: 12, ", "", "catalogue.yaml:15:53: count: found nothing, expected this key in a ring"},
    {"count: 12", "count: 0", "catalogue.yaml:15:61: count: found '0', expected a whole number from 1 to 1000"},
    {"count: 12", "count: 999",
     "catalogue.yaml:15:9: members: found more than 1000 patterns, expected at most as many"},
    {"polar: 60 deg, ", "", "catalogue.yaml:15:53: polar: found nothing, expected this key in a ring"},
    {"polar: 60 deg", "polar: 181 deg",
     "catalogue.yaml:15:72: polar: found '181 deg', expected an angle from 0 to 180 deg such as 30 deg"},
    {"radius: 14 mm", "radius: -14 mm",
     "catalogue.yaml:15:88: radius: found '-14 mm', expected a length of at least 0 such as 250 mm"},
    {"phase: 10 deg", "turn: 10 deg",
     "catalogue.yaml:15:95: turn: found a key that a ring does not have, expected one of count, polar, radius, phase"},
};

#define SWEPT "role: obstacle, sweep: {from: [0, 0, -1], to: [0, 0, 2], speed: 3 m/min}}"

/* Geometry that moves, and what its criterion takes. */
static const slip sweeps[] = {
    {"role: obstacle}", SWEPT,
     "scene.yaml:16:19: flux: found beside a sweep, where it changes as the goods pass, expected dose, such as 2 L/m2"},
    {"flux: 1 L/min/m2", "dose: 2 L/m2",
     "scene.yaml:16:19: dose: found without geometry that has a sweep, expected flux: what stands has no pass over "
     "which liquid adds up"},
    {"flux: 1 L/min/m2", "dose: 2 L/min/m2",
     "scene.yaml:16:19: dose: found '2 L/min/m2', expected a dose of at least 0 such as 2 L/m2 ('L/min/m2' measures "
     "something else)"},
    {"role: obstacle}", "role: obstacle, sweep: {from: [0, 0, 1], to: [0, 0, 1], speed: 3 m/min}}",
     "scene.yaml:11:70: to: found the same place as from, expected another"},
    {"role: obstacle}", "role: obstacle, sweep: {from: [0, 0, 1], to: [0, 0, 2]}}",
     "scene.yaml:11:48: speed: found nothing, expected this key in a sweep"},
    {"role: obstacle}", "role: obstacle, sweep: {from: [0, 0, 1], to: [0, 0, 2], speed: 0 m/s}}",
     "scene.yaml:11:88: speed: found '0 m/s', expected a speed above 0 such as 1 m/s"},
    {"role: obstacle}", "role: obstacle, sweep: {from: [0, 0, 1], to: [0, 2], speed: 1 m/s}}",
     "scene.yaml:11:70: to: found a list of 2, expected a list of three values such as [0, 0, 1]"},
    {"role: obstacle}", SWEPT "\n  - {file: stirrer.obj, sweep: {from: [0, 0, -1], to: [0, 0, 2], speed: 4 m/min}}",
     "scene.yaml:12:32: sweep: found another one than of the geometry before it, expected the same: all that moves, "
     "moves together"},
};

/* What a fitter sets, and what he measures from. */
static const slip settings[] = {
    {"bore: 80 mm", "bore: 0 mm", "scene.yaml:41:84: bore: found '0 mm', expected a length above 0 such as 250 mm"},
    {"bore: 80 mm", "bore: 2 bar",
     "scene.yaml:41:84: bore: found '2 bar', expected a length above 0 such as 250 mm ('bar' measures something else)"},
    {"bore: 80 mm", "bore: 21 mm",
     "scene.yaml:41:72: types: found 'jet', which is 22 mm wide, expected types that pass the bore, 21 mm"},
    {"step: {depth: 10 mm, tilt", "step: {depth: 10 mm, roll",
     "scene.yaml:41:112: roll: found a key that a step does not have, expected one of depth, tilt"},
    {"step: {depth: 10 mm", "step: {depth: 0 mm",
     "scene.yaml:41:105: depth: found '0 mm', expected a length of at least 1e-06 such as 250 mm"},
    {"step: {depth: 10 mm", "step: {depth: [10 mm]",
     "scene.yaml:41:105: depth: found a list of 1, expected a length of at least 1e-06 such as 250 mm"},
    {"tilt: 15 deg}}", "tilt: 15}}",
     "scene.yaml:41:118: tilt: found '15', expected an angle of at least 5.72958e-05 deg such as 30 deg (it has no "
     "unit)"},
    {"step: {depth: 10 mm, tilt: 15 deg}", "step: 5 deg",
     "scene.yaml:41:97: step: found '5 deg', expected the keys of a step"},
    {"datum: {name: flange F1", "datum: {nam: flange F1",
     "scene.yaml:46:9: nam: found a key that a datum does not have, expected 'name'"},
    {"datum: {name: flange F1", "datum: {name: []", "scene.yaml:46:15: name: found an empty list, expected a name"},
    {"origin: [0, 1 m, 20 mm]", "origin: [0, 1 m]",
     "scene.yaml:46:34: origin: found a list of 2, expected a list of three values such as [0, 0, 1]"},
    {"axis: [0, 3, 4]", "axis: [0, 0, 0]",
     "scene.yaml:46:57: axis: found a vector of length 0, expected a direction such as [0, 0, -1]"},
    {"zero: [2, 0, 0]", "zero: [0, -6, -8]",
     "scene.yaml:46:74: zero: found a list of 3, expected a direction across the datum's axis"},
    {"axis: [0, 3, 4], zero: [2, 0, 0]", "axis: [-1, 0, 0]",
     "scene.yaml:46:8: zero: found nothing, expected this key beside an axis along x: the direction of azimuth 0"},
    {"datum: {name: flange F1, origin: [0, 1 m, 20 mm], axis: [0, 3, 4], zero: [2, 0, 0]}", "datum: here",
     "scene.yaml:46:8: datum: found 'here', expected the keys of a datum"},
};

/* The same of the catalogue. */
static const slip type_settings[] = {
    {"body: 22 mm", "body: 0 m", "catalogue.yaml:5:100: body: found '0 m', expected a length above 0 such as 250 mm"},
    {"thread: G-1-4", "thread: [G]", "catalogue.yaml:5:74: thread: found a list of 1, expected a name"},
    {"insert: n.7", "insert: ''", "catalogue.yaml:5:89: insert: found '', expected a name"},
    {"step: {angle: 5 deg", "step: {angle: -5 deg",
     "catalogue.yaml:7:86: angle: found '-5 deg', expected an angle of at least 5.72958e-05 deg such as 30 deg"},
    {"step: {angle: 5 deg, flow: 2 L/min", "step: {angle: 5 deg, flow: 2 bar",
     "catalogue.yaml:7:99: flow: found '2 bar', expected a flow of at least 1e-09 such as 12 L/min ('bar' measures "
     "something else)"},
    {"pressure: 0.5 bar", "pressure: .5",
     "catalogue.yaml:7:118: pressure: found '.5', expected a pressure of at least 1 such as 2 bar (it has no unit)"},
    {"pressure: 0.5 bar", "hollow: 1",
     "catalogue.yaml:7:108: hollow: found a key that a step does not have, expected one of angle, flow, pressure"},
    {"angle_range: [60 deg, 120 deg], ", "",
     "catalogue.yaml:7:54: angle: found in a type without angle_range, expected beside it only"},
    {"flow_range: [10 L/min, 30 L/min], ", "",
     "catalogue.yaml:7:65: flow: found in a type without flow_range, expected beside it only"},
};

static int failures;

static void compare(const char *slip_text, const char *found, const char *expected)
{
    size_t size = strlen(expected);
    bool open = size > 3 && strcmp(expected + size - 3, "...") == 0;
    if (open ? strncmp(found, expected, size - 3) == 0 : strcmp(found, expected) == 0)
        return;
    print_error("%s\n  gives    %s\n  expected %s\n", slip_text, found, expected);
    failures++;
}

static void try_slip(const slip *s, const char *original, const char *file, sp_error_kind kind)
{
    sp_error error = {0};
    char text[2000];
    char *changed = with(original, s->find, s->replace);
    scratch_write(file, changed);
    free(changed);
    sp_scene *scene = sp_scene_load("scene.yaml", &error);
    sp_error_text(&error, text, sizeof text);
    compare(s->replace, scene ? "a scene" : text, s->expected);
    if (!scene && error.kind != kind) {
        print_error("%s\n  gives an error of kind %d, expected %d\n", s->replace, error.kind, kind);
        failures++;
    }
    sp_scene_destroy(scene);
}

static void try_scenes(const slip *slips, size_t count, sp_error_kind kind)
{
    failures = 0;
    scratch_write("catalogue.yaml", catalogue);
    for (size_t i = 0; i < count; i++)
        try_slip(&slips[i], full_scene, "scene.yaml", kind);
    assert_int_equal(failures, 0);
}

static void try_catalogues(const slip *slips, size_t count, sp_error_kind kind)
{
    failures = 0;
    scratch_write("scene.yaml", full_scene);
    for (size_t i = 0; i < count; i++)
        try_slip(&slips[i], catalogue, "catalogue.yaml", kind);
    assert_int_equal(failures, 0);
}

#define COUNT(table) (sizeof(table) / sizeof *(table))

static void scene_quantities(void **state)
{
    (void)state;
    try_scenes(quantities, COUNT(quantities), SP_ERROR_INPUT);
}

static void scene_settings(void **state)
{
    (void)state;
    try_scenes(settings, COUNT(settings), SP_ERROR_INPUT);
}

static void scene_sweeps(void **state)
{
    (void)state;
    try_scenes(sweeps, COUNT(sweeps), SP_ERROR_INPUT);
}

static void scene_keys(void **state)
{
    (void)state;
    try_scenes(keys, COUNT(keys), SP_ERROR_INPUT);
}

static void scene_kinds(void **state)
{
    (void)state;
    try_scenes(kinds, COUNT(kinds), SP_ERROR_INPUT);
}

static void scene_files(void **state)
{
    (void)state;
    try_scenes(missing_files, COUNT(missing_files), SP_ERROR_INPUT);
    try_scenes(files, COUNT(files), SP_ERROR_INPUT);
}

static void scene_syntax(void **state)
{
    (void)state;
    try_scenes(syntax, COUNT(syntax), SP_ERROR_INPUT);
}

static void catalogues(void **state)
{
    (void)state;
    try_catalogues(catalogue_slips, COUNT(catalogue_slips), SP_ERROR_INPUT);
    try_catalogues(clusters, COUNT(clusters), SP_ERROR_INPUT);
    try_catalogues(type_settings, COUNT(type_settings), SP_ERROR_INPUT);
}

static void expect(const char *path, const char *expected)
{
    sp_error error = {0};
    char text[2000];
    assert_null(sp_scene_load(path, &error));
    sp_error_text(&error, text, sizeof text);
    assert_string_equal(text, expected);
}

/* The scene file itself; a mesh that is wrong inside is the mesh's error, in the mesh's lines. */
static void whole_files(void **state)
{
    (void)state;
    scratch_write("catalogue.yaml", catalogue);
    expect("nowhere/scene.yaml", "nowhere/scene.yaml: cannot open: No such file or directory");
    expect(".", ".: cannot read: Is a directory");
    scratch_write("scene.yaml", "");
    expect("scene.yaml", "scene.yaml:1:1: YAML: found nothing, expected a value");
    scratch_write("scene.yaml", "vessel");
    expect("scene.yaml", "scene.yaml:1:1: scene: found 'vessel', expected keys and values, such as geometry: ...");
    scratch_write_bytes("scene.yaml", "up: z\nge\0ometry", 15);
    expect("scene.yaml", "scene.yaml:2: YAML: found a zero byte, expected text");
    size_t size = (16u << 20) + 1;
    char *large = malloc(size);
    assert_non_null(large);
    memset(large, ' ', size);
    scratch_write_bytes("scene.yaml", large, size);
    free(large);
    expect("scene.yaml", "scene.yaml: found more than 16 MiB, expected a smaller file");
    sp_error error = {0};
    scratch_write("scene.yaml", "geometry: [{file: wrong.obj}]\n");
    scratch_write("wrong.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n");
    assert_null(sp_scene_load("scene.yaml", &error));
    assert_string_equal(error.file, "wrong.obj");
    assert_int_equal(error.line, 4);
}

typedef struct {
    const char *setting, *expected;
} override;

static const override overrides[] = {
    {"simulate.jets=many", "simulate.jets=many: jets: found 'many', expected a whole number from 1 to 1000000000000"},
    {"simulate.jetz=3", "simulate.jetz=3: jetz: found a key that the simulation does not have, expected 'jets'"},
    {"nozzles.jets=3",
     "nozzles.jets=3: found another key, expected one of simulate, place or report, such as simulate.jets"},
    {"simulate=3", "simulate=3: found another key, expected one of simulate, place or report, such as simulate.jets"},
    {"simulate.=3", "simulate.=3: found another key, expected one of simulate, place or report, such as simulate.jets"},
    {"=3", "=3: found another key, expected one of simulate, place or report, such as simulate.jets"},
    {"simulate..jets=3",
     "simulate..jets=3: found another key, expected one of simulate, place or report, such as simulate.jets"},
    {"report.quantity=speeds", "report.quantity=speeds: quantity: found 'speeds', expected flux, speed, speed_max, "
                               "incidence, incidence_min, impact, impact_max, jets, covered or charts"},
    {"report.scale=even", "report.scale=even: scale: found 'even', expected auto, linear, log or stepped"},
    {"report.colours=jet", "report.colours=jet: colours: found 'jet', expected viridis or cividis"},
    {"report.wireframe=yes", "report.wireframe=yes: wireframe: found 'yes', expected true or false"},
    {"report.colors=jet", "report.colors=jet: colors: found a key that what a report shows does not have, expected "
                          "'colours'"},
    {"simulate.jets", "simulate.jets: found no '=', expected a setting such as simulate.jets=20000"},
    {"simulate.jets=", "simulate.jets=: YAML: found nothing, expected a value"},
    {"simulate.jets=*a", "simulate.jets=*a: YAML: found an alias, expected its value written out"},
    {"place.objective.x=3",
     "place.objective.x=3: found a key below one that has a single value, expected a block there"},
    {"place.refine.axis=3",
     "place.refine.axis=3: axis: found '3', expected an angle from 0 to 180 deg such as 30 deg (it has no unit)"},
    {"place.refine={flow: 1 %, flow: 2 %}",
     "place.refine={flow: 1 %, flow: 2 %}: flow: found a second time, expected once"},
    {"place.max_water=60 gal/min", "place.max_water=60 gal/min: max_water: found '60 gal/min', expected a flow above 0 "
                                   "such as 12 L/min (gal is the Galileo "
                                   "here: write gpm for US gallons per minute, or L/min)"},
};

static void wrong_overrides(void **state)
{
    (void)state;
    failures = 0;
    scratch_write("scene.yaml", full_scene);
    scratch_write("catalogue.yaml", catalogue);
    for (size_t i = 0; i < COUNT(overrides); i++) {
        sp_error error = {0};
        char text[2000];
        sp_scene *scene = sp_scene_load_with("scene.yaml", &overrides[i].setting, 1, NULL, &error);
        sp_error_text(&error, text, sizeof text);
        compare(overrides[i].setting, scene ? "a scene" : text, overrides[i].expected);
        sp_scene_destroy(scene);
    }
    assert_int_equal(failures, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(scene_quantities), cmocka_unit_test(scene_keys),  cmocka_unit_test(scene_kinds),
        cmocka_unit_test(scene_sweeps),     cmocka_unit_test(scene_files), cmocka_unit_test(scene_settings),
        cmocka_unit_test(scene_syntax),     cmocka_unit_test(catalogues),  cmocka_unit_test(whole_files),
        cmocka_unit_test(wrong_overrides),
    };
    return cmocka_run_group_tests(tests, scratch_make, scratch_remove);
}
