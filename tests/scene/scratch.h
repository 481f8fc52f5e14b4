/* A folder of its own for each test program, with the files that scenes need; the program works in it. */
#ifndef TESTS_SCENE_SCRATCH_H
#define TESTS_SCENE_SCRATCH_H

#include <assert.h>
#include <ftw.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static char scratch[] = "/tmp/sprayplan-scene-XXXXXX";

static inline void scratch_write_bytes(const char *name, const char *bytes, size_t size)
{
    FILE *file = fopen(name, "wb");
    if (!file || fwrite(bytes, 1, size, file) != size || fclose(file) != 0)
        abort();
}

static inline void scratch_write(const char *name, const char *text)
{
    scratch_write_bytes(name, text, strlen(text));
}

/* A tetrahedron with legs of 1, its faces the parts floor, wall_a, wall_b and lid. */
static const char tetrahedron[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
                                  "g floor\nf 1 3 2\ng wall_a\nf 1 2 4\ng wall_b\nf 1 4 3\ng lid\nf 2 3 4\n";
static const char catalogue[] =
    "nozzles:\n"
    "  - {name: cone, pattern: full_cone, angle: 90 deg, flow: 12 L/min, at: 2 bar}\n"
    "  - {name: ring, pattern: hollow_cone, angle: 80 deg, hollow: 0.7, flow: 8 L/min, at: 3 bar, exponent: 0.46, "
    "order_code: R-80, url: 'https://example.com/r?a=x&b=y'}\n"
    "  - {name: fan, pattern: flat_fan, angle: 60 deg, thickness: 8 deg, flow: 2 gpm, at: 40 psi, cv: 0.9, drop: 2 "
    "mm}\n"
    "  - {name: jet, pattern: solid_stream, flow: 5 L/min, at: 2 bar, thread: G-1-4, insert: n.7, body: 22 mm}\n"
    "  - {name: set, pattern: full_cone, angle: 90 deg, flow: 20 L/min, at: 2 bar,\n"
    "     angle_range: [60 deg, 120 deg], flow_range: [10 L/min, 30 L/min], "
    "step: {angle: 5 deg, flow: 2 L/min, pressure: 0.5 bar}, trajectory: line}\n"
    "  - name: ball\n"
    "    pattern: cluster\n"
    "    flow: 40 L/min\n"
    "    at: 1.5 bar\n"
    "    members:\n"
    "      - {pattern: solid_stream, offset: [0, 0, 14 mm], share: 2}\n"
    "      - {pattern: flat_fan, angle: 60 deg, thickness: 8 deg, axis: [3, 0, 4], roll: 90 deg}\n"
    "      - {pattern: solid_stream, angle: 3 deg, ring: {count: 12, polar: 60 deg, radius: 14 mm, phase: 10 deg}}\n";

static inline int scratch_make(void **state)
{
    (void)state;
    if (!mkdtemp(scratch) || chdir(scratch) != 0)
        return -1;
    scratch_write("tank.obj", tetrahedron);
    scratch_write("stirrer.obj", tetrahedron);
    scratch_write("catalogue.yaml", catalogue);
    return 0;
}

static inline int scratch_forget(const char *path, const struct stat *status, int type, struct FTW *walk)
{
    (void)status, (void)type, (void)walk;
    return remove(path);
}

static inline int scratch_remove(void **state)
{
    (void)state;
    return chdir("/") || nftw(scratch, scratch_forget, 8, FTW_DEPTH | FTW_PHYS);
}

/* `text` with the first `find` replaced; the caller frees. */
static inline char *with(const char *text, const char *find, const char *replace)
{
    const char *at = strstr(text, find);
    if (!at)
        abort();
    char *changed = malloc(strlen(text) + strlen(replace) + 1);
    if (!changed)
        abort();
    sprintf(changed, "%.*s%s%s", (int)(at - text), text, replace, at + strlen(find));
    return changed;
}

/* A scene that uses every key. */
static const char full_scene[] =
    "up: y\n"
    "geometry:\n"
    "  - file: tank.obj\n"
    "    unit: mm\n"
    "    scale: 2\n"
    "    translate: [0 mm, 100 mm, 0.5]\n"
    "    rotate: {axis: [0, 0, 2], angle: 90 deg}\n"
    "    restitution: 0.5\n"
    "    rebound: 80 %\n"
    "    clean_parts: [floor, \"wall_*\"]\n"
    "  - {file: stirrer.obj, role: obstacle}\n"
    "cavity: [0.1 m, 20 cm, 0.3]\n"
    "liquid: {density: 1.1 g/cm3, viscosity: 2 mPa.s, surface_tension: 40 mN/m}\n"
    "air: {density: 1.3 kg/m3, viscosity: 20 uPa.s}\n"
    "gravity: 9.8 m/s2\n"
    "criterion: {flux: 1 L/min/m2, impact_speed: 3.6 km/h, incidence: 60 deg, combine: single}\n"
    "catalogue: catalogue.yaml\n"
    "nozzles:\n"
    "  - {name: N1, type: cone, position: [0, 10 mm, 0.2], axis: [0, 0, -3], pressure: 2 bar}\n"
    "  - {name: N2, type: set, position: [0, 0, 0], axis: [1, 2, 2], roll: -30 deg, pressure: 3 bar,\n"
    "     angle: 100 deg, flow: 22 L/min, speed: 12 m/s, jets: 5000, keep: true}\n"
    "simulate:\n"
    "  trajectory: line\n"
    "  evaluator: forward\n"
    "  reflections: 3\n"
    "  jets: 20000\n"
    "  texel: 5 mm\n"
    "  splat: linear\n"
    "  accuracy: 2 %\n"
    "  seed: 18446744073709551615\n"
    "place:\n"
    "  objective: max_coverage\n"
    "  coverage: 95 %\n"
    "  max_nozzles: 12\n"
    "  max_water: 200 L/min\n"
    "  types: [fan, cone]\n"
    "  pressure: [1 bar, 2 bar]\n"
    "  clearance: 50 mm\n"
    "  mounts:\n"
    "    - port: {name: P1, position: [0, 0, 1], axis: [0, 0, -2], tilt: 180 deg,\n"
    "             depth: {from: 50 mm, to: 400 mm, spacing: 50 mm}, types: [jet], bore: 80 mm, "
    "step: {depth: 10 mm, tilt: 15 deg}}\n"
    "    - surface: {geometry: 1, part: lid, spacing: 100 mm, standoff: 50 mm, tilt: 45 deg}\n"
    "    - line: {from: [0, 0, 0], to: [1, 0, 0], spacing: 100 mm, tilt: 10 deg}\n"
    "    - box: {min: [0, 0, 0], max: [1, 1, 0], spacing: 150 mm, axis: [1, 0, 0]}\n"
    "  refine: {position: 20 mm, axis: 5 deg, roll: false, angle: 20 deg, flow: 25 %}\n"
    "datum: {name: flange F1, origin: [0, 1 m, 20 mm], axis: [0, 3, 4], zero: [2, 0, 0]}\n";

#endif
