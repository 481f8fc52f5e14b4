/* The colour maps viridis of Smith, van der Walt and Firing (2015), and cividis of Nunez, Anderton and Renslow (2018),
 * both released under CC0. */
#include <sprayplan/image.h>

#include <math.h>

/* Every 15th of its 256 entries, sRGB; straight lines between them stay within 2/255 of it. */
static const double viridis[][3] = {
    {0.267004, 0.004874, 0.329415}, {0.281924, 0.089666, 0.412415}, {0.280255, 0.165693, 0.476498},
    {0.263663, 0.237631, 0.518762}, {0.237441, 0.305202, 0.541921}, {0.208623, 0.367752, 0.552675},
    {0.182256, 0.426184, 0.557120}, {0.159194, 0.482237, 0.558073}, {0.137770, 0.537492, 0.554906},
    {0.121148, 0.592739, 0.544641}, {0.128087, 0.647749, 0.523491}, {0.180653, 0.701402, 0.488189},
    {0.274149, 0.751988, 0.436601}, {0.395174, 0.797475, 0.367757}, {0.535621, 0.835785, 0.281908},
    {0.688944, 0.865448, 0.182725}, {0.845561, 0.887322, 0.099702}, {0.993248, 0.906157, 0.143936},
};

/* Every 17th of its 256 entries, sRGB; straight lines between them stay within 12/255 of it. */
static const double cividis[][3] = {
    {0.000000, 0.135112, 0.304751}, {0.000000, 0.181610, 0.421859}, {0.117612, 0.225935, 0.434308},
    {0.208926, 0.272546, 0.424809}, {0.279411, 0.318677, 0.423031}, {0.342246, 0.364939, 0.428559},
    {0.401418, 0.411790, 0.440708}, {0.458366, 0.459552, 0.460457}, {0.517920, 0.508454, 0.472707},
    {0.582087, 0.558670, 0.468118}, {0.648222, 0.610553, 0.454801}, {0.716177, 0.664384, 0.432386},
    {0.785965, 0.720438, 0.399613}, {0.857809, 0.778969, 0.353259}, {0.932180, 0.840159, 0.285880},
    {0.995737, 0.909344, 0.217772},
};

void sp_colour_of(sp_colours colours, double value, uint8_t rgb[3])
{
    const double(*points)[3] = colours == SP_COLOURS_CIVIDIS ? cividis : viridis;
    size_t count = colours == SP_COLOURS_CIVIDIS ? sizeof cividis / sizeof *cividis : sizeof viridis / sizeof *viridis;
    double place = value > 0 ? fmin(value, 1) * (double)(count - 1) : 0;
    size_t below = (size_t)fmin(place, (double)(count - 2));
    double share = place - (double)below;
    for (int k = 0; k < 3; ++k) {
        double level = (1 - share) * points[below][k] + share * points[below + 1][k];
        rgb[k] = (uint8_t)(255 * level + 0.5);
    }
}
