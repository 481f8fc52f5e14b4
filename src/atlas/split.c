#include "atlas/split.h"

#include <math.h>

#define ALIKE 1e-6 /* relative differences of less are taken for round-off */

static void middle_of(const sp_sheet *sheet, size_t i, double middle[2])
{
    for (int k = 0; k < 2; k++)
        middle[k] = (sheet->at[sheet->corner[i][0]][k] + sheet->at[sheet->corner[i][1]][k] +
                     sheet->at[sheet->corner[i][2]][k]) /
                    3;
}

/* The direction in which triangles are spread most: of the larger eigenvector of their middles' covariance. */
static void long_axis(const sp_sheet *sheet, double centre[2], double axis[2])
{
    double xx = 0, xy = 0, yy = 0, middle[2];
    centre[0] = centre[1] = 0;
    for (size_t i = 0; i < sheet->triangle_count; i++) {
        middle_of(sheet, i, middle);
        for (int k = 0; k < 2; k++)
            centre[k] += middle[k] / (double)sheet->triangle_count;
    }
    for (size_t i = 0; i < sheet->triangle_count; i++) {
        middle_of(sheet, i, middle);
        double x = middle[0] - centre[0], y = middle[1] - centre[1];
        xx += x * x;
        xy += x * y;
        yy += y * y;
    }
    /* Where no direction stands out, that of the first triangle, not of round-off. */
    bool round = hypot(2 * xy, xx - yy) <= ALIKE * (xx + yy);
    double angle = round ? 0 : 0.5 * atan2(2 * xy, xx - yy);
    axis[0] = cos(angle);
    axis[1] = sin(angle);
}

void sp_split(const sp_sheet *sheet, uint32_t *region, uint32_t below, uint32_t above)
{
    double centre[2], axis[2], middle[2];
    long_axis(sheet, centre, axis);
    size_t counts[2] = {0, 0};
    for (size_t i = 0; i < sheet->triangle_count; i++) {
        middle_of(sheet, i, middle);
        double along = (middle[0] - centre[0]) * axis[0] + (middle[1] - centre[1]) * axis[1];
        bool far = along > ALIKE * (fabs(middle[0] - centre[0]) + fabs(middle[1] - centre[1]));
        region[sheet->triangle[i]] = far ? above : below;
        counts[far]++;
    }
    if (counts[0] && counts[1])
        return;
    for (size_t i = 0; i < sheet->triangle_count; i++) /* all lie on one place, or nowhere */
        region[sheet->triangle[i]] = i < sheet->triangle_count / 2 ? below : above;
}
