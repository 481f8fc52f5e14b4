/* Writes the image of a vaned full cone of 90 deg as a patternator might find it; all of it is made up: more liquid
 * towards the rim, less in the middle, a fall over the last degrees, a vane's four lobes, and one side a little
 * stronger. OpenEXR, a row for each degree from the axis to 50 deg, a column for each 5 deg of azimuth; liquid per
 * steradian, 1 about the middle. */
#include <sprayplan/image.h>

#include <math.h>
#include <stdio.h>

#define PI 3.14159265358979323846

enum { COLUMNS = 72, ROWS = 50 };

static double liquid(double azimuth, double polar)
{
    double rim = exp(-pow((polar - 37) / 7, 2)), fall = 0.5 * erfc((polar - 45) / 2);
    double lobes = 1 + 0.06 * sin(4 * azimuth) * polar / 45, side = 1 + 0.05 * cos(azimuth - 1) * polar / 45;
    double value = fall * (1 + 0.8 * rim) * lobes * side;
    return value > 0.001 ? value : 0; /* less is not measured */
}

int main(int count, char **arguments)
{
    static float values[ROWS][COLUMNS];
    static const char *const channels[] = {"Y"};
    const sp_exr_part part = {"liquid per steradian", COLUMNS, ROWS, &values[0][0]};
    sp_error error = {0};
    if (count != 2) {
        fprintf(stderr, "usage: heavy_rim OUT.exr\n");
        return 2;
    }
    for (int row = 0; row < ROWS; row++)
        for (int column = 0; column < COLUMNS; column++)
            values[row][column] = (float)liquid(2 * PI * (column + 0.5) / COLUMNS, row + 0.5);
    if (sp_image_write_exr(arguments[1], &part, 1, channels, 1, &error))
        return 0;
    fprintf(stderr, "%s: %s\n", arguments[1], error.message);
    return 1;
}
