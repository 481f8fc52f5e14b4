/* An order of which the first few lie all over: what ends early has seen something of everything. */
#ifndef OPTIMIZER_STRIDED_H
#define OPTIMIZER_STRIDED_H

#include <stddef.h>

/* Item `i` of `count` in that order, i < count: each comes once. */
size_t sp_strided(size_t i, size_t count);

#endif
