/* What a patternator measured: an image of liquid per solid angle, made ready for every question that is asked of a
 * pattern. Directions are unit, in the nozzle's frame. */
#ifndef NOZZLE_PATTERNATION_H
#define NOZZLE_PATTERNATION_H

#include <sprayplan/nozzle.h>

/* Liquid (share) and solid angle where there is any (sr): of a bin, or of all bins before a corner. */
typedef struct {
    double liquid, wet;
} sp_held;

/* A hemisphere and 30° beyond it, or all of a narrower pattern, on Lambert's azimuthal equal-area map (1772), in square
 * bins. There the mean over a square costs the same few sums wherever it lies, and the axis is a place like any other.
 */
typedef struct {
    int half;      /* bins from the middle to each side; 0: no map */
    double bin;    /* edge, on the map: rad near its middle, √sr anywhere */
    double scale;  /* near 1: by how much bins were corrected, so that no liquid is lost */
    sp_held *sums; /* [2 half + 1][2 half + 1], at the bins' corners; u the slower */
} sp_pattern_map;

/* Nodes in azimuth are the columns' centres; in polar angle the axis, which has the mean of the first row, the rows'
 * centres and the edge, which has the last row. Between them values are linear in azimuth and in the height 1 - cos of
 * the polar angle: in these solid angle is even, and integrals are closed. */
struct sp_patternation {
    size_t columns, rows;   /* of nodes */
    double *height;         /* [rows], rising */
    double *node;           /* [rows][columns], share of the liquid per steradian */
    double *along;          /* [rows][columns + 1], rad/sr: over azimuth from the first node to each, and all round */
    double *within;         /* [rows], share of the liquid up to this height */
    double *least, *most;   /* [rows], of the nodes */
    double low, high;       /* rad, polar angles between which there is liquid */
    double densest;         /* of all nodes, 1/sr */
    double liquid;          /* all there is, in the image's own measure */
    sp_pattern_map maps[2]; /* towards the axis, and away from it where the pattern comes that far */
};

/* False, with an error, of an image that is no pattern. */
bool sp_patternation_check(const float *values, size_t columns, size_t rows, double angle, sp_error *error);
/* As sp_spray_intensity. */
double sp_patternation_at(const sp_patternation *own, sp_vec3 direction);
/* Where the shares u of the liquid leave nearer to the axis, and w of what leaves as near before it in azimuth. */
sp_vec3 sp_patternation_direction(const sp_patternation *own, double u, double w);
/* As sp_spray_densities. */
void sp_patternation_densities(const sp_patternation *own, double from, double to, double *least, double *most);

/* pattern_map.c. False where memory runs out. */
bool sp_pattern_maps_create(sp_patternation *own);
void sp_pattern_maps_free(sp_patternation *own);
/* Means over what is `breadth` (rad) broad about a direction: the share of the liquid per steradian, and the share of
 * it that gets any. */
sp_held sp_patternation_mean(const sp_patternation *own, sp_vec3 direction, double breadth);

#endif
