/* Follows Sutherland and Hodgman, "Reentrant polygon clipping" (1974). */
#include "atlas/texels/clip.h"

#include <string.h>

/* Keeps the side of coordinate `axis` that is at least `bound` (sign 1) or at most (sign -1). */
static void clip(const sp_polygon *in, int axis, double bound, double sign, sp_polygon *out)
{
    out->count = 0;
    for (int i = 0; i < in->count; i++) {
        const double *p = in->point[i], *q = in->point[(i + 1) % in->count];
        double dp = sign * (p[axis] - bound), dq = sign * (q[axis] - bound);
        if (dp >= 0 && out->count < CLIP_POINTS)
            memcpy(out->point[out->count++], p, sizeof out->point[0]);
        if ((dp > 0 && dq < 0) || (dp < 0 && dq > 0)) {
            if (out->count == CLIP_POINTS)
                continue;
            double *cut = out->point[out->count++];
            cut[1 - axis] = p[1 - axis] + dp / (dp - dq) * (q[1 - axis] - p[1 - axis]);
            cut[axis] = bound;
        }
    }
}

void sp_clip_row(const double triangle[3][2], uint32_t row, sp_polygon *strip)
{
    sp_polygon whole = {.count = 3}, upper;
    memcpy(whole.point, triangle, 3 * sizeof whole.point[0]);
    clip(&whole, 1, row, 1, &upper);
    clip(&upper, 1, row + 1.0, -1, strip);
}

void sp_clip_column(const sp_polygon *strip, uint32_t column, sp_polygon *cell)
{
    sp_polygon right;
    clip(strip, 0, column, 1, &right);
    clip(&right, 0, column + 1.0, -1, cell);
}

double sp_polygon_area(const sp_polygon *polygon)
{
    double twice = 0;
    for (int i = 2; i < polygon->count; i++) {
        const double *o = polygon->point[0], *p = polygon->point[i - 1], *q = polygon->point[i];
        twice += (p[0] - o[0]) * (q[1] - o[1]) - (p[1] - o[1]) * (q[0] - o[0]);
    }
    return 0.5 * twice;
}
