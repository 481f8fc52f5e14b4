#include "scoring/strided.h"

size_t sp_strided(size_t i, size_t count)
{
    size_t stride = (size_t)(0.6180339887 * (double)count) | 1;
    for (;; stride += 2) {
        size_t a = stride, b = count;
        while (b) {
            size_t r = a % b;
            a = b;
            b = r;
        }
        if (a == 1)
            return i * stride % count;
    }
}
