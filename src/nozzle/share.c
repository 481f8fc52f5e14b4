/* How much of a patch lies inside a spray. A patch is small against the way to it, so that its image in the sphere of
 * directions is a parallelogram about the direction of its point; the spray's edge is blurred by as much, along its own
 * normal. The blur is odd about the edge in a coordinate in which solid angle is even (the squared chord to a cone's
 * axis, the height over a fan's middle, Archimedes), so that over patches side by side the shares come to the region's
 * own solid angle, however thin it is; a plain test of the points would let it fall between them. */
#include <sprayplan/nozzle.h>

/* Breadths over which an edge goes from all to nothing: the first length at which the step's slope, seen as a filter,
 * has a zero at the lattice's own frequency. */
#define BLUR 1.834
#define ROUND_OFF 1e-6      /* share that is none, or that all lacks */
#define LEAST_SQUARE 0.0025 /* of the square of its greatest, is a patch's breadth taken to be at least */

/* 0 to 1, with two even derivatives at either end (Perlin, Improving noise, 2002): what is left of a lattice's own
 * wavelengths after it is under 1 %. */
static double smooth_step(double t)
{
    t = fmin(1, fmax(0, t));
    return t * t * t * (10 + t * (6 * t - 15));
}

/* How a patch lies to an axis. */
typedef struct {
    double chord2; /* from its direction to the axis, squared */
    double square; /* sp_breadth's */
    double less2;  /* |less|² */
    double along2; /* (less · the way from it to the axis)² */
} sp_aspect;

/* A disc as small as the patch's image, or smaller: the image's ellipse, widened to hold the disc where that is wider,
 * takes what liquid the disc has. */
static double spot_share(double edge2, double chord2, const sp_aspect *aspect)
{
    double minor = fmax(aspect->square - aspect->less2, edge2 / (BLUR * BLUR));
    double stretch = (aspect->square - minor) / (minor * (aspect->less2 + 1e-300));
    double distance2 = (chord2 + aspect->along2 * stretch) / aspect->square;
    return edge2 / (BLUR * BLUR * sqrt(aspect->square * minor)) * smooth_step(1 - distance2 / (2 * BLUR * BLUR));
}

/* The share within the polar angle whose chord's square is edge2 (4: all directions). */
static double disc_share(double edge2, const sp_aspect *aspect)
{
    double small = BLUR * BLUR * aspect->square;
    if (edge2 <= 0 || edge2 >= 4)
        return edge2 > 0;
    double apart = edge2 - aspect->chord2, sine2_edge = edge2 * (1 - edge2 / 4);
    if (edge2 >= small && 4 - edge2 >= small && apart * apart >= small * sine2_edge)
        return apart > 0;
    if (edge2 < fmin(small, 2))
        return spot_share(edge2, aspect->chord2, aspect);
    if (4 - edge2 < small)
        return 1 - spot_share(4 - edge2, 4 - aspect->chord2, aspect);
    /* the breadth across the edge, and what a step there changes the squared chord by: twice the edge's sine */
    double sine2 = aspect->chord2 * (1 - aspect->chord2 / 4) + 1e-30, whole = aspect->square * sine2;
    double broad2 = fmax(whole - aspect->along2, LEAST_SQUARE * whole) / sine2;
    return smooth_step(0.5 + apart / (2 * BLUR * sqrt(broad2 * sine2_edge)));
}

static double chord2(double angle)
{
    double sine = 2 * sin(0.5 * fmin(angle, M_PI));
    return angle >= M_PI ? 4 : sine * sine;
}

static double cone_share(const sp_spray *spray, const sp_frame *frame, sp_vec3 direction, const sp_breadth *breadth)
{
    sp_vec3 to_axis = sp_sub(frame->z, direction);
    double along = sp_dot(breadth->less, frame->z);
    sp_aspect aspect = {sp_dot(to_axis, to_axis), breadth->square, sp_dot(breadth->less, breadth->less), along * along};
    double outer = disc_share(chord2(spray->outer), &aspect);
    return spray->inner > 0 ? fmax(0, outer - disc_share(chord2(spray->inner), &aspect)) : outer;
}

/* The share on the side to which `normal` points of the plane at `height` above the middle. */
static double half_share(double height, sp_vec3 normal, sp_vec3 direction, const sp_breadth *breadth)
{
    double above = sp_dot(direction, normal), apart = above - height;
    if (4 * apart * apart >= BLUR * BLUR * breadth->square)
        return apart > 0;
    double along = sp_dot(breadth->less, normal);
    double whole = breadth->square * fmax(1 - above * above, LEAST_SQUARE);
    double blur = BLUR * sqrt(fmax(whole - along * along, LEAST_SQUARE * whole));
    return smooth_step(0.5 + apart / blur);
}

static double fan_share(const sp_spray *spray, const sp_frame *frame, sp_vec3 direction, const sp_breadth *breadth)
{
    double share = 1;
    if (spray->half_thickness < M_PI / 2) {
        double height = sin(spray->half_thickness);
        share = half_share(-height, frame->y, direction, breadth) +
                half_share(-height, sp_scale(frame->y, -1), direction, breadth) - 1;
    }
    if (share <= 0 || spray->half_width >= M_PI)
        return fmax(0, share);
    double c = cos(spray->half_width), s = sin(spray->half_width);
    double ends = half_share(0, sp_along(sp_scale(frame->z, s), -c, frame->x), direction, breadth) +
                  half_share(0, sp_along(sp_scale(frame->z, s), c, frame->x), direction, breadth);
    return share * (c >= 0 ? fmax(0, ends - 1) : fmin(1, ends));
}

double sp_spray_share(const sp_spray *spray, const sp_frame *frame, sp_vec3 direction, const sp_breadth *breadth)
{
    double share = spray->kind == SP_PATTERN_FLAT_FAN ? fan_share(spray, frame, direction, breadth)
                                                      : cone_share(spray, frame, direction, breadth);
    return share > 1 - ROUND_OFF ? 1 : share < ROUND_OFF ? 0 : share;
}

double sp_spray_fringe(double square)
{
    return sqrt(2) * BLUR * sqrt(square);
}
