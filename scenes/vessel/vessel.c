/* Writes vessel.obj: a stirred vessel of 2 m³ as CAD would export it, in millimetres, z up, bottom tangent line at z =
 * 0.
 *
 * Inner diameter 1200, cylinder 1460 tall, Klöpper heads (DIN 28011), walls 6 thick: one closed body whose front faces
 * away from the metal, with an open outlet neck. Shaft, hubs and dip tube grow out of the upper head and share its
 * vertices. Blades and brackets are bodies of their own which end 1 mm before what carries them, so that no face runs
 * through metal; baffles are sheets without thickness, wet on both sides. */
#include "shapes.h"

#include <stdio.h>
#include <stdlib.h>

enum {
    RIM = 96,  /* segments of the shell */
    WIDE = 72, /* of the manway */
    ROUND = 32 /* of shaft and necks */
};

/* Size of the heads' triangles. On the knuckle they cut the corner by size² / (8 · 126), which has to stay well below
 * the wall's thickness, or the two skins would meet. */
static const double INNER = 32, OUTER = 40;

static const double WALL = 6;
static const double TOP = 1460; /* upper tangent line */
static const head BOTTOM_HEAD = {0, -1, 600, 1200, 120};
static const head TOP_HEAD = {1460, 1, 600, 1200, 120};

static const circle SHAFT = {0, 0, 25, ROUND};
static const circle OUTLET = {0, 0, 40, ROUND};
static const circle MANWAY = {0, -330, 180, WIDE};
static const double MANWAY_Z = 1780; /* underside of its lid */
static const double PORT_RADIUS = 25, PORT_CIRCLE = 360, PORT_Z = 1710;
static const double PORT_ANGLES[] = {30, 90, 150};
enum { PORTS = sizeof PORT_ANGLES / sizeof *PORT_ANGLES };
static const char *const PORT_NAMES[] = {"port_1", "port_2", "port_3"};
static const double DIP_CIRCLE = 430, DIP_ANGLE = 200, DIP_END = 40, DIP_TOP = 1710;
static const double DIP_RADIUS = 24, DIP_BORE = 20;

static circle round_at(double circle_radius, double degrees, double r)
{
    double angle = degrees * M_PI / 180;
    return (circle){circle_radius * cos(angle), circle_radius * sin(angle), r, ROUND};
}

static circle widened(circle circle, double by)
{
    circle.r += by;
    return circle;
}

static void shell(model *model)
{
    model_part(model, "shell");
    turn(model, 0, 0, RIM, (const double[][2]){{600, TOP}, {600, 0}}, 2, 50);
    turn(model, 0, 0, RIM, (const double[][2]){{606, 0}, {606, TOP}}, 2, 150);
}

static bool bottom(model *model)
{
    head outer = head_offset(&BOTTOM_HEAD, WALL);
    circle outside = widened(OUTLET, WALL);
    const double end = -350;
    model_part(model, "bottom_head");
    if (!head_surface(model, &BOTTOM_HEAD, &OUTLET, 1, RIM, INNER, true) ||
        !head_surface(model, &outer, &outside, 1, RIM, OUTER, false))
        return false;
    model_part(model, "outlet");
    pipe_to_head(model, &BOTTOM_HEAD, &OUTLET, end, true);
    turn(model, 0, 0, ROUND, (const double[][2]){{OUTLET.r, end}, {outside.r, end}}, 2, 10);
    pipe_to_head(model, &outer, &outside, end, false);
    return true;
}

/* The upper head with openings for the shaft, the dip tube, the manway and the ports. Outside, a lantern stands over
 * the shaft. */
static bool top(model *model, const head *outer, const circle *lantern)
{
    circle inside[3 + PORTS] = {SHAFT, MANWAY, round_at(DIP_CIRCLE, DIP_ANGLE, DIP_RADIUS)};
    circle outside[3 + PORTS] = {*lantern, widened(MANWAY, WALL), inside[2]};
    for (int i = 0; i < PORTS; ++i) {
        inside[3 + i] = round_at(PORT_CIRCLE, PORT_ANGLES[i], PORT_RADIUS);
        outside[3 + i] = widened(inside[3 + i], WALL);
    }
    model_part(model, "top_head");
    return head_surface(model, &TOP_HEAD, inside, 3 + PORTS, RIM, INNER, false) &&
           head_surface(model, outer, outside, 3 + PORTS, RIM, OUTER, true);
}

static void ports(model *model, const head *outer)
{
    for (int i = 0; i < PORTS; ++i) {
        circle bore = round_at(PORT_CIRCLE, PORT_ANGLES[i], PORT_RADIUS), outside = widened(bore, WALL);
        const double end = PORT_Z + WALL;
        model_part(model, PORT_NAMES[i]);
        pipe_to_head(model, &TOP_HEAD, &bore, PORT_Z, true);
        turn(model, bore.x, bore.y, ROUND, (const double[][2]){{0, PORT_Z}, {bore.r, PORT_Z}}, 2, 30);
        pipe_to_head(model, outer, &outside, end, false);
        turn(model, bore.x, bore.y, ROUND, (const double[][2]){{outside.r, end}, {0, end}}, 2, 40);
    }
}

/* Neck, flange and lid; the fourth port sits in the middle of the lid. */
static void manway(model *model, const head *outer)
{
    circle outside = widened(MANWAY, WALL);
    const double port = PORT_RADIUS, flange = 230, lid = MANWAY_Z + 20, blind = MANWAY_Z + 60;
    model_part(model, "manway");
    pipe_to_head(model, &TOP_HEAD, &MANWAY, MANWAY_Z, true);
    pipe_to_head(model, outer, &outside, MANWAY_Z - 20, false);
    model_part(model, "manway_lid");
    /* Rings of WIDE segments meet the neck; the port's bore has the same corners. */
    turn(model, MANWAY.x, MANWAY.y, WIDE, (const double[][2]){{port, MANWAY_Z}, {MANWAY.r, MANWAY_Z}}, 2, 30);
    turn(model, MANWAY.x, MANWAY.y, WIDE,
         (const double[][2]){{outside.r, MANWAY_Z - 20}, {flange, MANWAY_Z - 20}, {flange, lid}, {port + WALL, lid}}, 4,
         100);
    model_part(model, "port_4");
    turn(model, MANWAY.x, MANWAY.y, WIDE, (const double[][2]){{0, blind}, {port, blind}, {port, MANWAY_Z}}, 3, 30);
    turn(model, MANWAY.x, MANWAY.y, WIDE,
         (const double[][2]){{port + WALL, lid}, {port + WALL, blind + WALL}, {0, blind + WALL}}, 3, 60);
}

static void drive(model *model, const head *outer, const circle *lantern)
{
    model_part(model, "drive");
    pipe_to_head(model, outer, lantern, 1850, false);
    turn(model, 0, 0, ROUND, (const double[][2]){{lantern->r, 1850}, {110, 1850}, {110, 2050}, {0, 2050}}, 4, 150);
}

/* A dip tube with its bore, which is cleaned by pumping through it and therefore is a part of its own. */
static void dip_tube(model *model, const head *outer)
{
    circle tube = round_at(DIP_CIRCLE, DIP_ANGLE, DIP_RADIUS);
    const double cap = DIP_TOP + WALL;
    model_part(model, "dip_tube");
    turn(model, tube.x, tube.y, ROUND,
         (const double[][2]){{DIP_BORE, DIP_END}, {DIP_RADIUS, DIP_END}, {DIP_RADIUS, 1550}}, 3, 80);
    pipe_to_head(model, &TOP_HEAD, &tube, 1550, false);
    pipe_to_head(model, outer, &tube, cap, false);
    turn(model, tube.x, tube.y, ROUND, (const double[][2]){{DIP_RADIUS, cap}, {0, cap}}, 2, 40);
    model_part(model, "dip_tube_bore");
    turn(model, tube.x, tube.y, ROUND, (const double[][2]){{DIP_BORE, DIP_TOP}, {DIP_BORE, DIP_END}}, 2, 120);
    turn(model, tube.x, tube.y, ROUND, (const double[][2]){{0, DIP_TOP}, {DIP_BORE, DIP_TOP}}, 2, 40);
}

/* A Rushton turbine: six upright blades, slotted over the rim of a disc. */
static void rushton(model *model, double z)
{
    const double outline[8][2] = {{200, -40},   {200, 40},     {100, 40},   {100, 3.5},
                                  {151.5, 3.5}, {151.5, -3.5}, {100, -3.5}, {100, -40}};
    const int quads[3][4] = {{2, 3, 4, 1}, {4, 5, 0, 1}, {6, 7, 0, 5}};
    model_part(model, "impeller_rushton");
    turn(model, 0, 0, ROUND,
         (const double[][2]){{25, z - 50},
                             {45, z - 50},
                             {45, z - 2.5},
                             {150, z - 2.5},
                             {150, z + 2.5},
                             {45, z + 2.5},
                             {45, z + 50},
                             {25, z + 50}},
         8, 30);
    for (int i = 0; i < 6; ++i) {
        double angle = i * M_PI / 3;
        plate blade = {sp_v(0, 0, z), sp_v(cos(angle), sin(angle), 0), sp_v(0, 0, 1), 4};
        cut_plate(model, &blade, outline, 8, quads, 3);
    }
}

/* A turbine of four blades pitched by 45°. */
static void pitched(model *model, double z)
{
    model_part(model, "impeller_pitched");
    turn(model, 0, 0, ROUND, (const double[][2]){{25, z - 50}, {45, z - 50}, {45, z + 50}, {25, z + 50}}, 4, 30);
    for (int i = 0; i < 4; ++i) {
        double angle = i * M_PI / 2, c = sqrt(0.5);
        plate blade = {sp_v(0, 0, z), sp_v(cos(angle), sin(angle), 0), sp_v(-c * sin(angle), c * cos(angle), c), 6};
        cut_rectangle(model, &blade, 46, -45, 225, 45);
    }
}

static void agitator(model *model)
{
    const double low = 180, high = 850;
    rushton(model, low);
    pitched(model, high);
    model_part(model, "shaft");
    turn(model, 0, 0, ROUND, (const double[][2]){{0, low - 70}, {25, low - 70}, {25, low - 50}}, 3, 40);
    turn(model, 0, 0, ROUND, (const double[][2]){{25, low + 50}, {25, high - 50}}, 2, 40);
    turn(model, 0, 0, ROUND, (const double[][2]){{25, high + 50}, {25, 1600}}, 2, 40);
    pipe_to_head(model, &TOP_HEAD, &SHAFT, 1600, false);
}

/* Four baffles, a twelfth of the diameter wide, held off the wall by brackets. */
static void baffles(model *model)
{
    static const char *const sheets[] = {"baffle_1", "baffle_2", "baffle_3", "baffle_4"};
    for (int i = 0; i < 4; ++i) {
        double angle = M_PI / 4 + i * M_PI / 2;
        sp_vec3 out = sp_v(cos(angle), sin(angle), 0), across = sp_v(-sin(angle), cos(angle), 0);
        model_part(model, sheets[i]);
        sheet(model, sp_along(sp_v(0, 0, 40), 480, out), sp_scale(out, 100), sp_v(0, 0, 1360), 4, 40);
        model_part(model, "brackets");
        for (int j = 0; j < 3; ++j) {
            plate bracket = {sp_v(0, 0, 200 + 520 * j), out, across, 40};
            cut_rectangle(model, &bracket, 581, -5, 598.7, 5);
        }
    }
}

int main(int argc, char **argv)
{
    if (argc != 2) {
        fprintf(stderr, "usage: vessel FILE.obj\n");
        return 2;
    }
    model *model = model_create();
    head outer = head_offset(&TOP_HEAD, WALL);
    circle lantern = {0, 0, 60, ROUND};
    bool made = model && bottom(model) && top(model, &outer, &lantern);
    if (made) {
        shell(model);
        ports(model, &outer);
        manway(model, &outer);
        drive(model, &outer, &lantern);
        dip_tube(model, &outer);
        agitator(model);
        baffles(model);
    }
    made = made && model_write(model, argv[1]);
    if (made)
        printf("%s: %zu triangles\n", argv[1], model_triangles(model));
    else
        fprintf(stderr, "vessel: cannot write %s\n", argv[1]);
    model_destroy(model);
    return made ? 0 : 1;
}
