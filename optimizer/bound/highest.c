#include "bound/highest.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>

bool sp_highest_create(size_t count, sp_highest *highest, sp_error *error)
{
    *highest = (sp_highest){.count = count, .top = count > SIZE_MAX / 16 ? NULL : calloc(2 * count + 2, sizeof(float))};
    return highest->top || sp_fail_memory(error);
}

void sp_highest_free(sp_highest *highest)
{
    free(highest->top);
    *highest = (sp_highest){0};
}

void sp_highest_build(sp_highest *highest)
{
    float *top = highest->top;
    for (size_t i = highest->count; i-- > 1;)
        top[i] = fmaxf(top[2 * i], top[2 * i + 1]);
}

float sp_highest_of(const sp_highest *highest, size_t first, size_t end)
{
    float most = 0;
    for (size_t a = first + highest->count, b = end + highest->count; a < b; a /= 2, b /= 2) {
        if (a % 2)
            most = fmaxf(most, highest->top[a++]);
        if (b % 2)
            most = fmaxf(most, highest->top[--b]);
    }
    return most;
}

size_t sp_highest_at(const sp_highest *highest, size_t first, size_t end)
{
    float most = sp_highest_of(highest, first, end);
    while (end - first > 1) {
        size_t middle = first + (end - first) / 2;
        if (sp_highest_of(highest, first, middle) >= most)
            end = middle;
        else
            first = middle;
    }
    return first;
}

void sp_lowest_clear(sp_highest *lowest)
{
    for (size_t i = 0; i < 2 * lowest->count; i++)
        lowest->top[i] = INFINITY;
}

void sp_lowest_lower(sp_highest *lowest, size_t first, size_t end, float value)
{
    float *top = lowest->top;
    for (size_t a = first + lowest->count, b = end + lowest->count; a < b; a /= 2, b /= 2) {
        if (a % 2) {
            top[a] = fminf(top[a], value);
            a++;
        }
        if (b % 2) {
            b--;
            top[b] = fminf(top[b], value);
        }
    }
}

void sp_lowest_spread(sp_highest *lowest)
{
    float *top = lowest->top;
    for (size_t i = 1; i < lowest->count; i++) {
        top[2 * i] = fminf(top[2 * i], top[i]);
        top[2 * i + 1] = fminf(top[2 * i + 1], top[i]);
    }
}
