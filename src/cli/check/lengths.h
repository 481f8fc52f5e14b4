/* Lengths and places as plain decimals, to what matters of the thing that they belong to. */
#ifndef CLI_LENGTHS_H
#define CLI_LENGTHS_H

#include <sprayplan/vector.h>

enum { CLI_LENGTH = 48, CLI_POINT = 4 * CLI_LENGTH };

/* m; with as many decimals as tell steps of `step` (m) apart, without idle zeros. */
void cli_length_text(double length, double step, char text[CLI_LENGTH]);
/* Its three coordinates, each followed by the unit: " m", or "". */
void cli_point_text(sp_vec3 point, double step, const char *unit, char text[CLI_POINT]);

#endif
