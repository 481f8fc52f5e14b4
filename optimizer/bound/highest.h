/* The highest of any range of numbers, and the lowest of what ranges were given: binary trees over positions. */
#ifndef OPTIMIZER_HIGHEST_H
#define OPTIMIZER_HIGHEST_H

#include <sprayplan/error.h>

#include <stddef.h>

typedef struct {
    size_t count;
    float *top; /* [2 count], a node's children are 2 i and 2 i + 1; the numbers themselves begin at `count` */
} sp_highest;

bool sp_highest_create(size_t count, sp_highest *highest, sp_error *error);
void sp_highest_free(sp_highest *highest);
/* After the numbers were set. */
void sp_highest_build(sp_highest *highest);
/* Of [first, end); 0 where that is empty. */
float sp_highest_of(const sp_highest *highest, size_t first, size_t end);
/* Where the first of the highest stands. */
size_t sp_highest_at(const sp_highest *highest, size_t first, size_t end);

/* The same trees used downwards: clear, lower ranges, spread; then each number is the lowest that its position was
 * given, INFINITY where it was given none. */
void sp_lowest_clear(sp_highest *lowest);
void sp_lowest_lower(sp_highest *lowest, size_t first, size_t end, float value);
void sp_lowest_spread(sp_highest *lowest);

#endif
