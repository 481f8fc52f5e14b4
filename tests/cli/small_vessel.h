/* A vessel of 80 mm, washed by nozzles of hundredths of a litre a minute: small.yaml in the workplace. */
#ifndef TESTS_CLI_SMALL_VESSEL_H
#define TESTS_CLI_SMALL_VESSEL_H

#include "workplace.h"

static const char small_yaml[] =
    "geometry:\n"
    "  - {file: room.obj, scale: 0.08}\n"
    "cavity: [40 mm, 40 mm, 40 mm]\n"
    "criterion: {flux: 1 L/min/m2}\n"
    "catalogue: drops.yaml\n"
    "nozzles:\n"
    "  - {name: N1, type: drop, position: [40 mm, 40 mm, 72 mm], axis: [0, 0, -1], pressure: 2 bar}\n"
    "simulate: {texel: 4 mm}\n"
    "place:\n"
    "  coverage: 70 %\n"
    "  max_nozzles: 2\n"
    "  pressure: 2 bar\n"
    "  refine: none\n"
    "  mounts:\n"
    "    - port: {name: P1, position: [24 mm, 24 mm, 76 mm], axis: [0, 0, -1], tilt: 30 deg}\n"
    "    - port: {name: P2, position: [56 mm, 56 mm, 76 mm], axis: [0, 0, -1], tilt: 30 deg}\n";

static const char drops_yaml[] = "nozzles:\n"
                                 "  - {name: drop, pattern: full_cone, angle: 120 deg, flow: 0.04 L/min, at: 2 bar}\n"
                                 "  - {name: wide, pattern: full_cone, angle: 160 deg, flow: 0.06 L/min, at: 2 bar}\n";

static inline void write_small_vessel(void)
{
    write_file("small.yaml", small_yaml);
    write_file("drops.yaml", drops_yaml);
}

#endif
