/* Where a mesh's vertices are, encoded to the last bit in few: as whole numbers of the file that they were read from,
 * each as what it is off from where the triangle before it lets it be expected. */
#ifndef REPORT_VIEWER_VERTEX_CODE_H
#define REPORT_VIEWER_VERTEX_CODE_H

#include "triangle_order.h"

/* value = number / parts * unit. A number has no more than so many digits to `base`, and zeros behind them. What that
 * misses is a difference of bits. */
typedef struct {
    double parts, unit, base;
    int digits;
} sp_vertices_encoded;

/* False where memory runs out. */
bool sp_vertices_encode(const sp_mesh *mesh, const sp_triangle_order *walk, sp_coder *coder,
                        sp_vertices_encoded *format);

#endif
