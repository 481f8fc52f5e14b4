/* Nozzles: what a catalogue says of a type, what a layout says of each one, and what leaves them. */
#ifndef SPRAYPLAN_NOZZLE_H
#define SPRAYPLAN_NOZZLE_H

#include <sprayplan/error.h>
#include <sprayplan/export.h>
#include <sprayplan/vector.h>

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define SP_NAME 64 /* bytes of a name, the terminating zero included */
#define SP_URL 256 /* the same of an address */

typedef enum {
    SP_PATTERN_FULL_CONE,
    SP_PATTERN_HOLLOW_CONE,
    SP_PATTERN_FLAT_FAN,
    SP_PATTERN_SOLID_STREAM,
    SP_PATTERN_CLUSTER,  /* several of these on one body */
    SP_PATTERN_ROTATING, /* one of the first four turned, averaged over time */
    SP_PATTERN_MEASURED, /* an image of liquid per solid angle */
} sp_pattern;

/* How the jet of a rotating type turns. Its pattern is given about an axis of its own. That of one which turns about
 * one axis leans by `tilt` from the body's, which is the nozzle's z; at roll 0 the jet's x, along which a fan is wide,
 * lies in the plane of both, and `roll` turns it out of that. In a two-axis head `jets` of them, evenly spread, point
 * outwards from a hub that turns about an axis across the body's, gears[0]/gears[1] times for every turn of the body;
 * when it starts the first points along z, and the hub turns it towards x. */
typedef struct {
    sp_pattern jet;    /* one of the first four; in a two-axis head a cone or stream no wider than 90 deg */
    double tilt, roll; /* rad, [0, π] and any; one axis only */
    unsigned jets;     /* 0: about one axis only */
    unsigned gears[2]; /* teeth, > 0, as follows; two axes only */
    double speed;      /* rad/s of the body; 0: not known */
    unsigned turns;    /* of the body in a run; 0: until the tracks repeat */
} sp_rotation;

typedef struct {
    double density;         /* kg/m³ */
    double viscosity;       /* Pa s */
    double surface_tension; /* N/m, of liquids */
} sp_fluid;

/* What a measured pattern sprays: liquid per solid angle by azimuth and polar angle, with all that follows from it. */
typedef struct sp_patternation sp_patternation;
#define SP_PATTERNATION_COLUMNS 4096 /* at most */
#define SP_PATTERNATION_ROWS 1024    /* at most */
/* values: [rows][columns], liquid per steradian in any measure, 0 or more and not all 0. Columns are azimuth, a full
 * turn from the nozzle frame's x towards its y; rows polar angle, from the axis to half of `angle` (rad, full, 1e-6
 * to 2π); each value is of its column's and row's middle. Between these it goes linearly with azimuth and with the
 * polar angle's cosine; the axis has the mean of the first row, and the last row reaches to the edge. The values are
 * copied. NULL on error, which says where a wrong value is. */
SP_API sp_patternation *sp_patternation_create(const float *values, size_t columns, size_t rows, double angle,
                                               sp_error *error);
SP_API void sp_patternation_destroy(sp_patternation *patternation);
/* The liquid of an image that leaves at one speed, or at one near to it. */
typedef struct {
    sp_patternation *patternation; /* owned */
    double share;                  /* of the image's liquid */
    double speed;                  /* of the nozzle's exit speed */
} sp_speed_layer;
#define SP_SPEEDS 16 /* layers of an image at most */
/* What sp_patternation_create makes of these values, in layers of one speed each. speeds: [rows][columns], of the
 * nozzle's exit speed, above 0 and at most 10 where there is liquid, of any value where there is none. Layers' speeds
 * are 5 % apart, or more where SP_SPEEDS would not do; liquid of a speed between two goes to both, so that its mean
 * speed is its own. Returns how many layers there are, slowest first, 0 on error, which says where a wrong value is. */
SP_API size_t sp_patternation_layers(const float *values, const float *speeds, size_t columns, size_t rows,
                                     double angle, sp_speed_layer layers[SP_SPEEDS], sp_error *error);

/* The step between settings, as it was given: `count` units, each of `unit` in SI, so that every setting is a short
 * number in that unit. Count 0: anything can be set. */
typedef struct {
    double count, unit;
} sp_step;
/* SI; 0 where anything can be set. */
static inline double sp_step_size(sp_step step)
{
    return step.count * step.unit;
}

/* How liquid flies. With drag what leaves a nozzle flies as drops that air at rest holds back (see sp_drag_of): the far
 * end of a bracket, since a spray carries air along. Auto never takes it. */
typedef enum { SP_TRAJECTORY_AUTO, SP_TRAJECTORY_LINE, SP_TRAJECTORY_PARABOLA, SP_TRAJECTORY_DRAG } sp_trajectory;

/* A catalogue entry. Plain data; angles are full opening angles. */
typedef struct {
    char name[SP_NAME];
    sp_pattern pattern;
    sp_rotation rotation;        /* rotating types only, of which angle, hollow and thickness are their jet's */
    double angle;                /* rad, (0, 2π] for cones, (0, 2π] for fans; 0 for clusters */
    double hollow;               /* share of the angle that is empty, [0, 1); hollow cones only */
    double thickness;            /* rad, (0, π]; flat fans only */
    double flow;                 /* m³/s of water (1000 kg/m³) at pressure `at`, 0 or more */
    double at;                   /* Pa, > 0 */
    double exponent;             /* n in Q = K dp^n, [0, 1] */
    double cv;                   /* v0 = cv sqrt(2 dp / rho), [0, 1] */
    double drop;                 /* diameter of the drops, m */
    sp_trajectory trajectory;    /* of its liquid; auto: as the simulation's does. A cluster's members have its own */
    double angle_min, angle_max; /* rad; equal to angle where not adjustable */
    double flow_min, flow_max;   /* m³/s of water at `at`; equal to flow where not adjustable */
    char order_code[SP_NAME];    /* by which its maker sells it; "" where it has none */
    char url[SP_URL];            /* of its page; "" where it has none, else as sp_is_url */
    char thread[SP_NAME];        /* by which it is screwed in; "": not known */
    char insert[SP_NAME];        /* what is put into its body; "": nothing, or not known */
    double body;                 /* m, diameter of the hole that it passes; 0: not known */
    /* What can be set: angles from its own, rated flows from its own, pressures from 0. */
    sp_step angle_step, flow_step, pressure_step;
    size_t member_count;       /* clusters only, 1 to SP_MEMBERS */
    struct sp_member *members; /* [member_count], owned by whoever made the type: of a scene's, the scene */
    /* Measured types only, whose angle is their image's: borrowed, of a scene's types from the scene; and the file that
     * it was read from, as the catalogue names it, "" for none. */
    const sp_patternation *patternation;
    char image[SP_URL];
} sp_nozzle_type;

#define SP_MEMBERS 1000 /* of a cluster at most */

/* One pattern of a cluster, such as a hole of a spray ball, in the frame of its body (sp_nozzle_frame). */
typedef struct sp_member {
    sp_nozzle_type type; /* its pattern and angles, no cluster; its flow and exit speed follow from the body's */
    sp_vec3 offset;      /* m, from the body's position */
    sp_vec3 axis;        /* unit */
    double roll;         /* rad; its own frame follows from axis and roll as a nozzle's does, the body's z being up */
    double share;        /* of the body's flow, in proportion to the other members'; > 0 */
    double speed;        /* of the body's exit speed; 0: the same */
} sp_member;

/* True of an http or https address that fits and has neither spaces nor control characters nor quotes: a page may link
 * it. */
SP_API bool sp_is_url(const char *text);

/* One nozzle of a layout. All that is a number is finite. */
typedef struct {
    char name[SP_NAME];
    const sp_nozzle_type *type; /* borrowed from the catalogue */
    sp_vec3 position;           /* m */
    sp_vec3 axis;               /* unit */
    double roll;                /* rad */
    double pressure;            /* Pa, 0 or more */
    double angle;               /* rad, as its type's; 0: the type's own */
    double flow;                /* m³/s as sprayed, at this pressure, of this liquid; 0: from type and pressure */
    double speed;               /* m/s at the exit; 0: from type and pressure */
    uint64_t jets;              /* of the forward evaluator; 0: the simulation's */
    bool keep;                  /* every proposal contains it */
} sp_nozzle;

typedef struct {
    size_t count;
    sp_nozzle *nozzles; /* [count], owned */
} sp_layout;

/* A layout of `count` copies of nozzles (NULL: all zero). The types stay borrowed. */
SP_API sp_layout *sp_layout_create(const sp_nozzle *nozzles, size_t count, sp_error *error);
SP_API void sp_layout_destroy(sp_layout *layout);
/* Whether both are of one type, stand in one place and are aimed and set alike, whatever their names. */
SP_API bool sp_nozzles_spray_alike(const sp_nozzle *a, const sp_nozzle *b);
/* Whether the edges of their sprays lie in one place, however much each sprays: both stand in one place, are aimed and
 * shaped alike, and as fast. Of clusters that is known only where both are of one type. */
SP_API bool sp_nozzles_share_edges(const sp_nozzle *a, const sp_nozzle *b, const sp_fluid *liquid);
/* Whether another nozzle of the layout shares nozzle i's edges and sprays more, or as much and comes before it: where
 * nozzle i meets a criterion alone, so does that one. */
SP_API bool sp_layout_repeats(const sp_layout *layout, size_t i, const sp_fluid *liquid);
/* The first nozzle before nozzle i whose body its own overlaps, bodies being balls of their types' diameters about the
 * nozzles' positions; where a type has none, one in the same place up to 1e-6 m. SIZE_MAX for none. `text`: that they
 * overlap, as a clause of plain text, "P2 and P5 stand in one place: their bodies overlap"; "" for none. */
#define SP_OVERLAP_TEXT 240
SP_API size_t sp_layout_overlap(const sp_layout *layout, size_t i, char text[SP_OVERLAP_TEXT]);
/* Σ flow, m³/s. */
SP_API double sp_layout_flow(const sp_layout *layout, const sp_fluid *liquid);

/* Q = K dp^n √(1000/rho), m³/s. Nozzle makers' catalogues: K from one point, which is for water. */
SP_API double sp_nozzle_flow(const sp_nozzle *nozzle, const sp_fluid *liquid);
/* The same for a type at a pressure (Pa) and a rated flow (m³/s of water at type->at), for instance one that refinement
 * sets. */
SP_API double sp_type_flow(const sp_nozzle_type *type, double rated_flow, double pressure, const sp_fluid *liquid);
/* v0 = Cv √(2 dp/rho), m/s (Bernoulli), unless the nozzle sets its own. */
SP_API double sp_nozzle_speed(const sp_nozzle *nozzle, const sp_fluid *liquid);
/* The opening angle in force, rad, as sp_spray_create takes it: of what rotates its jet's; of a cluster that of the
 * smallest cone about the body's axis that would hold all its patterns if they had no offsets. */
SP_API double sp_nozzle_angle(const sp_nozzle *nozzle);
/* The angle that reports show, rad: the same, but of what rotates that of the smallest cone about its axis that holds
 * all that it sprays. A jet of 1 deg says nothing of a head that sprays all round. */
SP_API double sp_nozzle_cone(const sp_nozzle *nozzle);

/* The nozzle's frame in world coordinates, right-handed and orthonormal. */
typedef struct {
    sp_vec3 x, y, z;
} sp_frame;
/* z along axis; x = unit(up × axis), or where the axis is within 1e-6 rad of vertical world y × axis (with y up:
 * world z × axis); y = z × x; then roll turns x, y about z. `up` is (0,0,1) or (0,1,0). */
SP_API sp_frame sp_nozzle_frame(sp_vec3 axis, double roll, sp_vec3 up);

/* How many patterns a nozzle has: its cluster's members, else 1. */
SP_API size_t sp_nozzle_pattern_count(const sp_nozzle *nozzle);
/* Nozzles of one pattern each that together spray what this one does: its members, in their order, or itself. They have
 * the body's name and exit speed, or their part of it, their shares of its flow, and of its jets, where it sets their
 * number, at least one each. patterns: [sp_nozzle_pattern_count], the caller's; their types are borrowed from the
 * nozzle's. A member along the body's axis, without offset, that has all the flow is to the bit the plain nozzle. `up`
 * as for sp_nozzle_frame.
 */
SP_API void sp_nozzle_patterns(const sp_nozzle *nozzle, const sp_fluid *liquid, sp_vec3 up, sp_nozzle *patterns);
/* False, with an error that names the type, of one whose pattern or trajectory is none, or whose angle, hollow,
 * thickness or rotation is beyond what is said above; of a measured type without patternation, and of a cluster without
 * members, with more than SP_MEMBERS, or with a member that is a cluster or not whole, or whose share is not above 0.
 * Whatever takes a nozzle or a layout asks that first, and of nozzles what is said of these; it fails with
 * SP_ERROR_ARGUMENT. */
SP_API bool sp_type_is_valid(const sp_nozzle_type *type, sp_error *error);

/* A pattern ready for use: liquid per solid angle, uniform inside its region unless it rotates or is measured. The
 * region of each kind: cones by polar angle about z, fans by longitude atan2(x, z) and latitude asin(y),
 * what rotates by the polar angles about z that its jet comes to, what is measured by where there is any liquid. The
 * angles of what rotates are its jet's. */
typedef struct {
    sp_pattern kind;
    double inner, outer;               /* cones: polar angles, rad */
    double half_width, half_thickness; /* fans: longitude and latitude, rad */
    sp_pattern jet;                    /* what rotates: the pattern that turns */
    bool two_axes;                     /* what rotates: on a hub */
    sp_vec3 spindle;                   /* what rotates: the axis turned about, unit, in the jet's frame */
    const sp_patternation *measured;   /* what is measured: borrowed from the type */
    double solid_angle;                /* sr; this and what follows come from the angles, see sp_spray_settle */
    double low, high;                  /* the polar angles about z between which it sprays, rad */
    double inner_chord2, outer_chord2; /* cones: squared chords from the axis to these angles; 4: no edge */
    double inner_sine, outer_sine;     /* of these angles, from the chords */
    double height, rise;               /* fans: sine and cosine of half_thickness */
    double end_sine, end_cosine;       /* of half_width */
    bool even;                         /* see sp_spray_is_uniform */
} sp_spray;
SP_API sp_spray sp_spray_create(const sp_nozzle_type *type, double angle);
/* Works out what follows from a pattern's kind and angles, after these were changed. */
SP_API void sp_spray_settle(sp_spray *spray);
/* True where the liquid is as dense all over the region: 1/solid_angle. Of any other that is the most there is, also of
 * means. */
static inline bool sp_spray_is_uniform(const sp_spray *spray)
{
    return spray->even;
}
/* Share of the liquid per steradian (1/sr) in a unit direction of the nozzle's frame: 1/solid_angle inside, 0 outside.
 * Of what rotates the mean over time: about one axis that of its jet along the circle about the axis, in closed form;
 * of two-axis heads, whose gears run through all angles evenly, 1/(2π² sin ϑ) at the polar angle ϑ from the body's
 * axis, averaged over the jet's breadth. Of what is measured the image's, so that all directions together have 1. */
SP_API double sp_spray_intensity(const sp_spray *spray, sp_vec3 direction);
/* Signed angular distance (rad) from the direction to the region's edge, positive inside; its smooth counterpart for
 * refinement. Of what is measured to the ring or cone about the axis that just holds the region, which may have gaps.
 */
SP_API double sp_spray_margin(const sp_spray *spray, sp_vec3 direction);
/* Direction i of n, low-discrepancy and equal in area (Archimedes' map) or, where the liquid is not even, in liquid;
 * unit, in the nozzle's frame. Deterministic in (i, n, seed). */
SP_API sp_vec3 sp_spray_direction(const sp_spray *spray, uint64_t i, uint64_t n, uint64_t seed);
/* Half-angle (rad) of the smallest cone about z that holds the region. */
SP_API double sp_spray_reach(const sp_spray *spray);

/* Breadths over which sp_spray_share goes from all to nothing at an edge: the first length at which its step's slope,
 * seen as a filter, has a zero at the frequency of patches side by side. */
#define SP_SPRAY_BLUR 1.834
/* The share, 0 to 1, of a patch that lies inside the spray: how far the region, in `frame`, holds what is `breadth`
 * (rad) broad about a unit direction of the world. Edges are blurred by about as much: shares of patches side by side
 * come to the region's solid angle over theirs, also where the region is thinner than a patch. */
SP_API double sp_spray_share(const sp_spray *spray, const sp_frame *frame, sp_vec3 direction, double breadth);
/* Share of the liquid per steradian (1/sr), averaged over what is `breadth` (rad) broad about a unit direction of the
 * world, of which a part may lie outside of the region: sp_spray_share/solid_angle of uniform patterns. Of what rotates
 * it comes from differences of sp_spray_within over rings of about that breadth about the axis, so that no liquid is
 * lost however thin the jet. Of what is measured from its integral over squares on maps of equal area, whose bins are
 * 1/256 of its angle or finer; what is less broad than these has the density of its middle. */
SP_API double sp_spray_density(const sp_spray *spray, const sp_frame *frame, sp_vec3 direction, double breadth);
/* Of what rotates: the share of the liquid, 0 to 1, that leaves within a polar angle (rad) of the axis turned about. */
SP_API double sp_spray_within(const sp_spray *spray, double polar);
/* Of what rotates or is measured: no less and no more than these leaves per steradian (1/sr) at any polar angle (rad)
 * from one to another, nor of any mean over directions between them. Of what rotates close for cones and streams of
 * less than 180 deg turned about one axis and for full ones on a hub, else 0 and 1/solid_angle. */
SP_API void sp_spray_densities(const sp_spray *spray, double from, double to, double *least, double *most);
/* Beyond so many rad outside of the region no patch of this breadth has a share. */
SP_API double sp_spray_fringe(double breadth);

#ifdef __cplusplus
}
#endif
#endif
