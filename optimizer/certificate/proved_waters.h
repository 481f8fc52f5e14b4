/* Waters that a certificate has found prices for, and what each proved: where else prices would say most. */
#ifndef OPTIMIZER_PROVED_WATERS_H
#define OPTIMIZER_PROVED_WATERS_H

#include <stdbool.h>
#include <stddef.h>

typedef struct {
    double water, bound; /* units; m² that no layout of so much covers, by its own prices */
} sp_proved_water;

/* By rising water, none twice. Zeroed: none. */
typedef struct {
    size_t count, capacity;
    sp_proved_water *items;
} sp_proved_waters;

/* The lower bound stays, where there is one. False when memory runs out. */
bool sp_proved_waters_note(sp_proved_waters *waters, double water, double bound);
void sp_proved_waters_free(sp_proved_waters *waters);
/* What prices for so much water cannot be expected to come below: the chord between the neighbours, as the best bound
 * is all but concave in water (that of the linear program is). The upper and lower lines of the sandwich algorithm:
 * Rote, The convergence rate of the sandwich algorithm for approximating convex functions, Computing 48, 1992.
 * Expects at least one, of no more water. */
double sp_proved_waters_chord(const sp_proved_waters *waters, double water);

#endif
