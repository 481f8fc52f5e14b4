/* Quantities by udunits2. A unit system belongs to whoever created it; any number of threads may do so at a time. */
#ifndef SCENE_UNITS_H
#define SCENE_UNITS_H

#include <sprayplan/error.h>
#include <sprayplan/keys.h>

#include <stdbool.h>
#include <stddef.h>

typedef struct sp_units sp_units;

/* udunits' own system with `deg` and what makers' sheets have added. */
sp_units *sp_units_create(sp_error *error);
void sp_units_destroy(sp_units *units);

/* Reads "12.5 L/min" to SI. On failure returns false with what is wrong in `why`, empty where it is not a quantity at
 * all. */
bool sp_units_read(const sp_units *units, const char *text, const sp_dimension *dimension, double *value, char *why,
                   size_t size);
/* How much the unit of such a text is in SI, 1 where a bare number is meant. */
bool sp_units_of(const sp_units *units, const char *text, const sp_dimension *dimension, double *factor, char *why,
                 size_t size);
/* The same for a unit alone: "mm" to 0.001. */
bool sp_units_factor(const sp_units *units, const char *unit, const sp_dimension *dimension, double *factor, char *why,
                     size_t size);

#define SP_UNITS_NUMBER 48 /* bytes of a number of any long double, the terminating zero included */
/* The shortest decimal number of units of `factor` that reads as just this value. False, and one that reads as a value
 * next to it, where there is none: never where long double has more digits than double. */
bool sp_units_number(double value, double factor, char number[SP_UNITS_NUMBER]);

#endif
