/* The sheet that a fitter welds, sets and orders from: a layout measured from the setup's datum. */
#ifndef SPRAYPLAN_FITTING_H
#define SPRAYPLAN_FITTING_H

#include <sprayplan/export.h>
#include <sprayplan/place.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Decimals of a sheet's numbers: of mm none, of degrees one, of bar and L/min two; more where the steps of its mounts
 * and types need them for what can be set, and of lengths also on a small surface, as sp_place_decimals has it. Values
 * in mm and deg are rounded to these decimals, the others are only shown with them. */
typedef struct {
    int mm;                    /* all lengths */
    int deg;                   /* tilt, towards and turn */
    int angle_deg, bar, l_min; /* of sprays, pressures and flows; smaller flows as sp_told_decimals has it */
} sp_fitting_decimals;

/* A place as ruler and protractor give it from the datum: lengths to the sheet's decimals, azimuths in deg to .1, or as
 * much finer as makes half of the last decimal of a length at that radius. All NAN where there is none. */
typedef struct {
    double x_mm, y_mm;  /* along the datum's zero, and across it: along axis x zero */
    double height_mm;   /* along its axis */
    double radius_mm;   /* from its axis */
    double azimuth_deg; /* from zero towards axis x zero, [0, 360); 0 on the axis */
} sp_fitting_place;

/* One nozzle. What it does not have is NAN. */
typedef struct {
    const sp_nozzle *nozzle; /* borrowed of the layout */
    const sp_mount *mount;   /* borrowed; NULL where it sits on none */
    const char *fitting;     /* borrowed: the mount's name; of one that has none `part` */
    const char *part;        /* borrowed: the name of the part that it is welded to; "" but on a surface */
    double depth_mm;         /* in a port: from its position along its axis to the nozzle's */
    double standoff_mm;      /* on a surface: from the wall to the nozzle's position */
    sp_fitting_place at;     /* the port's position, or the weld: the wall's point nearest to the nozzle's position */
    sp_fitting_place tip;    /* the nozzle's position; in a port and on a surface where depth or standoff as they are
                              * rounded bring it, so that the two places and what lies between them agree */
    /* Its axis, deg: tilted by so much from straight down, which is against the datum's axis, towards this azimuth,
     * which is 0 where the tilt is 0 or 180. */
    double tilt_deg, towards_deg;
    /* The x of its frame, along which a fan is wide, about its axis from the level line that points to azimuth
     * towards + 90, clockwise seen along the axis; deg, of fans [0, 180), else [0, 360). NAN where a pattern is
     * the same at every turn. */
    double turn_deg;
    size_t circuit; /* index */
} sp_fitting_row;

/* Nozzles that are fed at one pressure. */
typedef struct {
    double pressure; /* Pa */
    double flow;     /* m³/s */
    size_t nozzles;
} sp_circuit;

typedef struct {
    const sp_setup *setup; /* borrowed */
    /* Two thirds, by area, of the walls that are to be cleaned and do not lie across the datum's axis turn about it, to
     * 10 deg of their normals: height, radius and azimuth say where things are, else x, y and height. */
    bool round;
    sp_fitting_decimals decimals;
    size_t count;
    sp_fitting_row *rows; /* [count], in the layout's order; owned */
    size_t circuit_count;
    sp_circuit *circuits; /* by rising pressure; owned */
} sp_fitting_sheet;

/* Of a layout of the setup, whose mounts (see sp_mount_at) may be NULL for none. All that is given is borrowed. */
SP_API sp_fitting_sheet *sp_fitting_sheet_create(const sp_layout *layout, const sp_setup *setup, const sp_mount *mounts,
                                                 size_t mount_count, sp_error *error);
/* Accepts NULL. */
SP_API void sp_fitting_sheet_destroy(sp_fitting_sheet *sheet);

#ifdef __cplusplus
}
#endif
#endif
