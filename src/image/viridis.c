/* The colour map viridis of Smith, van der Walt and Firing (2015), released under CC0. */
#include <sprayplan/image.h>

#include <math.h>

/* Every 15th of its 256 entries, sRGB; straight lines between them stay within 2/255 of it. */
#define POINTS 18
static const double control_points[POINTS][3] = {
    {0.267004, 0.004874, 0.329415}, {0.281924, 0.089666, 0.412415}, {0.280255, 0.165693, 0.476498},
    {0.263663, 0.237631, 0.518762}, {0.237441, 0.305202, 0.541921}, {0.208623, 0.367752, 0.552675},
    {0.182256, 0.426184, 0.557120}, {0.159194, 0.482237, 0.558073}, {0.137770, 0.537492, 0.554906},
    {0.121148, 0.592739, 0.544641}, {0.128087, 0.647749, 0.523491}, {0.180653, 0.701402, 0.488189},
    {0.274149, 0.751988, 0.436601}, {0.395174, 0.797475, 0.367757}, {0.535621, 0.835785, 0.281908},
    {0.688944, 0.865448, 0.182725}, {0.845561, 0.887322, 0.099702}, {0.993248, 0.906157, 0.143936},
};

void sp_viridis(double value, uint8_t rgb[3])
{
    double place = value > 0 ? fmin(value, 1) * (POINTS - 1) : 0;
    int below = (int)fmin(place, POINTS - 2);
    double share = place - below;
    for (int k = 0; k < 3; ++k) {
        double level = (1 - share) * control_points[below][k] + share * control_points[below + 1][k];
        rgb[k] = (uint8_t)(255 * level + 0.5);
    }
}
