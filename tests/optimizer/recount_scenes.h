/* Scenes on which proposals and their bounds are counted again: unlike the example vessel, and each about one thing
 * that search, certificate and evaluator might see differently. Texels are as many as the search takes, so that all
 * count on the same. */
#ifndef RECOUNT_SCENES_H
#define RECOUNT_SCENES_H

#include "room.h"

#include <sprayplan/evaluator.h>

#define RECOUNT_TYPES 4
#define RECOUNT_HOLES 9 /* of a spray ball */
#define RECOUNT_MOUNTS 4

typedef struct {
    room room;
    sp_nozzle_type types[RECOUNT_TYPES];
    const sp_nozzle_type *type_list[RECOUNT_TYPES];
    double pressures[2];
    sp_mount mounts[RECOUNT_MOUNTS];
    sp_nozzle kept[2];
    size_t kept_count;
    sp_layout *layout; /* of the kept */
    sp_patternation *patternation;
    sp_place_options options;
} recount_scene;

/* What a scene is before it is opened: a hall of 10 x 10 x 6 m or a chamber of 2 x 1.4 x 1.2 m, with no more in it. */
static inline void scene_begin(recount_scene *s, room_builder *b, bool hall)
{
    *s = (recount_scene){.pressures = {2e5, 4e5}};
    *b = (room_builder){0};
    s->room.setup = sp_setup_default();
    s->room.setup.cavity = SP_CAVITY_POINT;
    s->room.setup.fidelity.method = SP_METHOD_INVERSE;
    s->room.setup.fidelity.trajectory = SP_TRAJECTORY_LINE;
    s->room.setup.fidelity.accuracy = ROOM_ACCURACY; /* proposals are counted again here in another way */
    s->room.setup.cavity_point = hall ? sp_v(0.3, 0.2, 4.9) : sp_v(0.05, 0.02, 1.1);
    if (hall)
        room_box(b, sp_v(-5, -5, 0), sp_v(5, 5, 6), "walls", "lid");
    else
        room_box(b, sp_v(-1, -0.7, 0), sp_v(1, 0.7, 1.2), "walls", "lid");
    s->options = room_options();
    s->options.clearance = 0.02;
    s->options.objective = SP_OBJECTIVE_MAX_COVERAGE;
    s->options.pressure_count = 1;
    s->options.mount_count = 1;
    s->mounts[0] = hall ? (sp_mount){.kind = SP_MOUNT_LINE,
                                     .axis = sp_v(0, 0, -1),
                                     .tilt = 60 * DEGREE,
                                     .spacing = 3.3,
                                     .from = sp_v(-3.3, 0.4, 5),
                                     .to = sp_v(3.3, 0.4, 5)}
                        : (sp_mount){.kind = SP_MOUNT_LINE,
                                     .axis = sp_v(0, 0, -1),
                                     .tilt = 60 * DEGREE,
                                     .spacing = 0.7,
                                     .from = sp_v(-0.7, 0.1, 0.95),
                                     .to = sp_v(0.7, 0.1, 0.95)};
}

static inline void scene_type(recount_scene *s, sp_pattern pattern, double angle, double thin, double litres)
{
    sp_nozzle_type *type = &s->types[s->options.type_count];
    *type = room_cone((const char *[]){"one", "two", "three", "four"}[s->options.type_count], angle * DEGREE, litres);
    type->pattern = pattern;
    if (pattern == SP_PATTERN_FLAT_FAN)
        type->thickness = thin * DEGREE;
    if (pattern == SP_PATTERN_HOLLOW_CONE)
        type->hollow = thin;
    s->type_list[s->options.type_count++] = type;
}

/* What points into the scene is set once it lies where it stays. */
static inline void scene_open(recount_scene *s, const room_builder *b, double texel)
{
    sp_error error = {0};
    room_open(&s->room, b, texel);
    s->options.types = s->type_list;
    s->options.pressures = s->pressures;
    s->options.mounts = s->mounts;
    if (s->kept_count) {
        s->layout = sp_layout_create(s->kept, s->kept_count, &error);
        assert_non_null(s->layout);
        s->options.kept = s->layout;
    }
}

static inline void scene_close(recount_scene *s)
{
    sp_layout_destroy(s->layout);
    sp_patternation_destroy(s->patternation);
    room_close(&s->room);
}

static inline void fans_in_a_hall(recount_scene *s, double texel)
{
    room_builder b;
    scene_begin(s, &b, true);
    scene_type(s, SP_PATTERN_FLAT_FAN, 90, 1, 12);
    scene_type(s, SP_PATTERN_FLAT_FAN, 60, 2, 19);
    s->options.max_nozzles = 4;
    s->options.max_water = 60 * LITRES_PER_MINUTE;
    scene_open(s, &b, texel);
}

static inline void streams_in_a_hall(recount_scene *s, double texel)
{
    room_builder b;
    scene_begin(s, &b, true);
    scene_type(s, SP_PATTERN_SOLID_STREAM, 1, 0, 9);
    scene_type(s, SP_PATTERN_SOLID_STREAM, 2, 0, 23);
    s->options.max_nozzles = 4;
    scene_open(s, &b, texel);
}

static inline void hollow_cones_in_a_hall(recount_scene *s, double texel)
{
    room_builder b;
    scene_begin(s, &b, true);
    scene_type(s, SP_PATTERN_HOLLOW_CONE, 60, 0.97, 14);
    scene_type(s, SP_PATTERN_HOLLOW_CONE, 100, 0.97, 31);
    s->room.setup.criterion.flux = 0.2 * LITRES_PER_MINUTE;
    s->options.max_nozzles = 3;
    scene_open(s, &b, texel);
}

/* Three ports, the first taken by a kept nozzle, another kept one beside them; flux that half suffices. */
static inline void ports_and_kept(recount_scene *s, double texel)
{
    room_builder b;
    scene_begin(s, &b, false);
    scene_type(s, SP_PATTERN_FULL_CONE, 120, 0, 16);
    scene_type(s, SP_PATTERN_FULL_CONE, 50, 0, 6.3);
    scene_type(s, SP_PATTERN_FLAT_FAN, 80, 6, 5.1);
    s->room.setup.criterion.flux = 4 * LITRES_PER_MINUTE;
    for (int i = 0; i < 3; i++)
        s->mounts[i] = (sp_mount){.kind = SP_MOUNT_PORT,
                                  .name = {'A', (char)('1' + i)},
                                  .position = sp_v(-0.6 + 0.6 * i, 0.2, 1.1),
                                  .axis = sp_v(0, 0, -1),
                                  .tilt = 40 * DEGREE,
                                  .depth_to = 0.3,
                                  .depth_spacing = 0.3};
    s->options.mount_count = 3;
    s->kept[0] = (sp_nozzle){.name = "first",
                             .type = &s->types[0],
                             .position = sp_v(-0.6, 0.2, 0.9),
                             .axis = sp_v(0, 0, -1),
                             .pressure = 2e5,
                             .keep = true};
    s->kept[1] = (sp_nozzle){.name = "second",
                             .type = &s->types[1],
                             .position = sp_v(0.4, -0.4, 0.5),
                             .axis = sp_unit(sp_v(0.5, 0.2, -1)),
                             .pressure = 2e5,
                             .keep = true};
    s->kept_count = 2;
    scene_open(s, &b, texel);
}

/* Flows without a common measure. */
static inline void little_water(recount_scene *s, double texel)
{
    room_builder b;
    scene_begin(s, &b, false);
    scene_type(s, SP_PATTERN_FULL_CONE, 90, 0, 7.1234567);
    scene_type(s, SP_PATTERN_FULL_CONE, 60, 0, M_PI);
    scene_type(s, SP_PATTERN_FULL_CONE, 40, 0, M_SQRT2);
    s->room.setup.criterion.flux = 2 * LITRES_PER_MINUTE;
    s->pressures[0] = 2.3e5;
    s->options.max_water = 16.4 * LITRES_PER_MINUTE;
    s->mounts[0].tilt = 45 * DEGREE;
    scene_open(s, &b, texel);
}

/* Angles and flows that refinement sets. */
static inline void few_nozzles(recount_scene *s, double texel)
{
    room_builder b;
    scene_begin(s, &b, false);
    scene_type(s, SP_PATTERN_FULL_CONE, 80, 0, 11);
    scene_type(s, SP_PATTERN_FLAT_FAN, 70, 12, 8);
    s->types[0].angle_min = 60 * DEGREE;
    s->types[0].angle_max = 110 * DEGREE;
    s->types[0].flow_min = 0.7 * s->types[0].flow;
    s->types[0].flow_max = 1.3 * s->types[0].flow;
    s->room.setup.criterion =
        (sp_criterion){.flux = 3 * LITRES_PER_MINUTE, .impact_speed = 5, .incidence = 70 * DEGREE};
    s->options.max_nozzles = 3;
    scene_open(s, &b, texel);
}

static inline void one_alone(recount_scene *s, double texel)
{
    room_builder b;
    scene_begin(s, &b, false);
    scene_type(s, SP_PATTERN_FULL_CONE, 90, 0, 14);
    scene_type(s, SP_PATTERN_HOLLOW_CONE, 80, 0.8, 7);
    scene_type(s, SP_PATTERN_FLAT_FAN, 80, 10, 6);
    s->room.setup.criterion.flux = 6 * LITRES_PER_MINUTE;
    s->room.setup.criterion.combine = SP_COMBINE_SINGLE;
    s->options.max_nozzles = 4;
    scene_open(s, &b, texel);
}

/* A box stands on the floor and another on it, a sheet hangs between; low pressure bends both arcs down. */
static inline void parts_and_parabolas(recount_scene *s, double texel)
{
    room_builder b;
    scene_begin(s, &b, false);
    room_box(&b, sp_v(-0.5, -0.3, 0), sp_v(-0.1, 0.1, 0.4), "box", "top");
    room_box(&b, sp_v(-0.4, -0.2, 0.4), sp_v(-0.2, 0, 0.6), "small", "small top");
    room_part(&b, "baffle");
    room_sheet(&b, sp_v(0.4, -0.5, 0.3), sp_v(0, 0.8, 0), sp_v(0.1, 0, 0.6));
    scene_type(s, SP_PATTERN_FULL_CONE, 100, 0, 9);
    scene_type(s, SP_PATTERN_FLAT_FAN, 60, 5, 4.3);
    s->room.setup.fidelity.trajectory = SP_TRAJECTORY_PARABOLA;
    s->room.setup.criterion.flux = 2.5 * LITRES_PER_MINUTE;
    s->pressures[0] = 0.06e5;
    s->mounts[0].from.z = s->mounts[0].to.z = 0.8;
    s->mounts[0].tilt = 150 * DEGREE;
    s->options.max_nozzles = 3;
    scene_open(s, &b, texel);
}

/* On most of the walls it takes two, on some three. */
static inline void weak_flux(recount_scene *s, double texel)
{
    room_builder b;
    scene_begin(s, &b, false);
    scene_type(s, SP_PATTERN_FULL_CONE, 120, 0, 12);
    scene_type(s, SP_PATTERN_FULL_CONE, 360, 0, 37);
    scene_type(s, SP_PATTERN_FULL_CONE, 70, 0, 5.7);
    s->room.setup.criterion.flux = 9 * LITRES_PER_MINUTE;
    s->options.max_nozzles = 5;
    s->options.max_water = 90 * LITRES_PER_MINUTE;
    scene_open(s, &b, texel);
}

static inline void any_liquid(recount_scene *s, double texel)
{
    room_builder b;
    scene_begin(s, &b, false);
    scene_type(s, SP_PATTERN_FULL_CONE, 40, 0, 4);
    scene_type(s, SP_PATTERN_FLAT_FAN, 200, 8, 7.5);
    scene_type(s, SP_PATTERN_HOLLOW_CONE, 120, 0.9, 6.2);
    s->pressures[0] = 1e5;
    s->options.pressure_count = 2;
    s->options.max_water = 33 * LITRES_PER_MINUTE;
    scene_open(s, &b, texel);
}

/* Few poses, so that looking at layouts one by one comes near to its end. */
static inline void proved(recount_scene *s, double texel)
{
    room_builder b;
    scene_begin(s, &b, false);
    scene_type(s, SP_PATTERN_FULL_CONE, 30, 0, 3);
    scene_type(s, SP_PATTERN_FLAT_FAN, 50, 3, 2.2);
    s->mounts[0].tilt = 0;
    s->mounts[0].spacing = 0.2;
    s->options.max_nozzles = 4;
    s->options.prove = true;
    s->room.setup.criterion.flux = 5 * LITRES_PER_MINUTE;
    scene_open(s, &b, texel);
}

/* Nozzles one or two texels off a wall, some along it: the texels beside them are cut. */
static inline void off_the_wall(recount_scene *s, double texel)
{
    room_builder b;
    scene_begin(s, &b, false);
    scene_type(s, SP_PATTERN_FULL_CONE, 360, 0, 17);
    scene_type(s, SP_PATTERN_FULL_CONE, 80, 0, 6);
    scene_type(s, SP_PATTERN_FLAT_FAN, 90, 14, 5);
    s->room.setup.criterion.flux = 5 * LITRES_PER_MINUTE;
    s->mounts[0].from = sp_v(-1 + 1.3 * texel, -0.5, 0.6);
    s->mounts[0].to = sp_v(-1 + 2.6 * texel, 0.5, 0.6);
    s->mounts[0].spacing = 0.4;
    s->mounts[0].tilt = 90 * DEGREE;
    s->options.max_nozzles = 3;
    scene_open(s, &b, texel);
}

/* The same with so little pressure that all falls within a few texels. */
static inline void feeble_off_the_wall(recount_scene *s, double texel)
{
    room_builder b;
    scene_begin(s, &b, false);
    scene_type(s, SP_PATTERN_FULL_CONE, 360, 0, 17);
    scene_type(s, SP_PATTERN_FULL_CONE, 80, 0, 6);
    s->room.setup.fidelity.trajectory = SP_TRAJECTORY_PARABOLA;
    s->room.setup.criterion.flux = 15 * LITRES_PER_MINUTE;
    s->pressures[0] = 700;
    s->mounts[0].from = sp_v(-1 + 0.8 * texel, -0.5, 0.6);
    s->mounts[0].to = sp_v(-1 + 2.6 * texel, 0.5, 0.6);
    s->mounts[0].spacing = 0.4;
    s->mounts[0].tilt = 90 * DEGREE;
    s->options.max_nozzles = 3;
    scene_open(s, &b, texel);
}

#define FILM_TEXEL 0.08  /* the shortest of which a search with film takes as many as there are, soon enough */
#define GOODS_TEXEL 0.07 /* the same of goods that move, where patches have positions besides */

/* Film that runs down from several nozzles together, over boxes that stand on the floor; on the lid and the floor none
 * runs. */
static inline void film_over_boxes(recount_scene *s, double texel)
{
    room_builder b;
    scene_begin(s, &b, false);
    room_box(&b, sp_v(-0.5, -0.3, 0), sp_v(-0.1, 0.1, 0.5), "box", "top");
    room_box(&b, sp_v(0.3, 0, 0), sp_v(0.6, 0.4, 0.3), "other", "other top");
    scene_type(s, SP_PATTERN_FULL_CONE, 110, 0, 12);
    scene_type(s, SP_PATTERN_FLAT_FAN, 80, 6, 5.2);
    scene_type(s, SP_PATTERN_SOLID_STREAM, 2, 0, 6.1);
    s->room.setup.criterion =
        (sp_criterion){.flux = 8 * LITRES_PER_MINUTE, .incidence = 60 * DEGREE, .film = 5 * LITRES_PER_MINUTE};
    s->room.setup.gravity = 9.81;
    s->mounts[0].tilt = 40 * DEGREE;
    s->mounts[0].axis = sp_unit(sp_v(0.4, 0.3, -1));
    s->options.max_nozzles = 4;
    s->options.max_water = 40 * LITRES_PER_MINUTE;
    scene_open(s, &b, fmax(texel, FILM_TEXEL));
}

/* So few poses that every layout can be tried. */
static inline void film_of_few(recount_scene *s, double texel)
{
    room_builder b;
    scene_begin(s, &b, false);
    room_box(&b, sp_v(-0.2, -0.3, 0), sp_v(0.2, 0.1, 0.5), "box", "top");
    scene_type(s, SP_PATTERN_FULL_CONE, 70, 0, 9);
    scene_type(s, SP_PATTERN_HOLLOW_CONE, 100, 0.7, 6.4);
    scene_type(s, SP_PATTERN_SOLID_STREAM, 3, 0, 4);
    s->room.setup.criterion =
        (sp_criterion){.flux = 6 * LITRES_PER_MINUTE, .incidence = 80 * DEGREE, .film = 4 * LITRES_PER_MINUTE};
    s->room.setup.gravity = 9.81;
    s->mounts[0].tilt = 0;
    s->mounts[0].axis = sp_unit(sp_v(0.6, 0.5, 0.2));
    s->mounts[0].spacing = 0.2;
    s->options.max_nozzles = 3;
    scene_open(s, &b, fmax(texel, FILM_TEXEL));
}

/* Where one nozzle alone must hit, films still add up; one is kept. */
static inline void film_and_one_alone(recount_scene *s, double texel)
{
    room_builder b;
    scene_begin(s, &b, false);
    scene_type(s, SP_PATTERN_FULL_CONE, 120, 0, 9);
    scene_type(s, SP_PATTERN_HOLLOW_CONE, 100, 0.8, 7);
    s->room.setup.criterion = (sp_criterion){.flux = 12 * LITRES_PER_MINUTE,
                                             .incidence = 80 * DEGREE,
                                             .combine = SP_COMBINE_SINGLE,
                                             .film = 4 * LITRES_PER_MINUTE};
    s->room.setup.gravity = 9.81;
    s->mounts[0].tilt = 120 * DEGREE;
    s->options.max_nozzles = 4;
    s->kept[0] = (sp_nozzle){.name = "first",
                             .type = &s->types[0],
                             .position = sp_v(-0.5, 0, 0.8),
                             .axis = sp_unit(sp_v(-1, 0.2, 0.4)),
                             .pressure = 2e5,
                             .keep = true};
    s->kept_count = 1;
    scene_open(s, &b, fmax(texel, FILM_TEXEL));
}

/* A spray ball with three rings of holes, a hub off its mounting point that turns a fan, and a plain cone. The ball's
 * last hole is a cone whose edge crosses patches that other holes hit. */
static inline void scene_bodies(recount_scene *s)
{
    static sp_member holes[RECOUNT_HOLES];
    for (int i = 0; i < RECOUNT_HOLES; i++) {
        double polar = (30 + 40 * (i % 3)) * DEGREE, turn = 2 * M_PI * i / RECOUNT_HOLES;
        sp_vec3 out = sp_v(sin(polar) * cos(turn), sin(polar) * sin(turn), cos(polar));
        holes[i] = (sp_member){
            .type = room_cone("hole", 20 * DEGREE, 1), .offset = sp_scale(out, 0.04), .axis = out, .share = 1};
    }
    holes[RECOUNT_HOLES - 1].type = room_cone("hole", 80 * DEGREE, 1);
    holes[RECOUNT_HOLES - 1].share = 4;
    scene_type(s, SP_PATTERN_CLUSTER, 0, 0, 15);
    scene_type(s, SP_PATTERN_ROTATING, 100, 0, 9);
    scene_type(s, SP_PATTERN_FULL_CONE, 70, 0, 5);
    s->types[0].angle = s->types[0].angle_min = s->types[0].angle_max = 0;
    s->types[0].members = holes;
    s->types[0].member_count = RECOUNT_HOLES;
    s->types[1].rotation = (sp_rotation){.jet = SP_PATTERN_FLAT_FAN, .tilt = 35 * DEGREE};
    s->types[1].thickness = 8 * DEGREE;
    s->mounts[0].tilt = 25 * DEGREE;
    s->options.max_nozzles = 3;
}

static inline void open_bodies_and_boxes(recount_scene *s, sp_trajectory trajectory, double texel)
{
    room_builder b;
    scene_begin(s, &b, false);
    room_box(&b, sp_v(-0.5, -0.3, 0), sp_v(-0.1, 0.1, 0.5), "box", "top");
    scene_bodies(s);
    s->room.setup.fidelity.trajectory = trajectory;
    s->room.setup.criterion.flux = 1.5 * LITRES_PER_MINUTE;
    scene_open(s, &b, texel);
}

static inline void bodies_and_boxes(recount_scene *s, double texel)
{
    open_bodies_and_boxes(s, SP_TRAJECTORY_PARABOLA, texel);
}

/* One body alone must do, with all its holes; a kept ball. */
static inline void bodies_alone(recount_scene *s, double texel)
{
    room_builder b;
    scene_begin(s, &b, false);
    scene_bodies(s);
    s->room.setup.criterion.flux = 2.5 * LITRES_PER_MINUTE;
    s->room.setup.criterion.combine = SP_COMBINE_SINGLE;
    s->kept[0] = (sp_nozzle){.name = "first",
                             .type = &s->types[0],
                             .position = sp_v(0.5, 0.3, 0.7),
                             .axis = sp_unit(sp_v(0.3, 0.2, -1)),
                             .pressure = 2e5,
                             .keep = true};
    s->kept_count = 1;
    scene_open(s, &b, texel);
}

static inline void bodies_and_film(recount_scene *s, double texel)
{
    room_builder b;
    scene_begin(s, &b, false);
    scene_bodies(s);
    s->room.setup.criterion =
        (sp_criterion){.flux = 8 * LITRES_PER_MINUTE, .incidence = 80 * DEGREE, .film = 5 * LITRES_PER_MINUTE};
    s->room.setup.gravity = 9.81;
    s->mounts[0].axis = sp_unit(sp_v(0.6, 0.5, 0.2));
    scene_open(s, &b, fmax(texel, FILM_TEXEL));
}

/* Few enough to try every layout. */
static inline void bodies_of_few(recount_scene *s, double texel)
{
    bodies_and_boxes(s, texel);
    s->mounts[0].tilt = 0;
}

/* A block that is carried through the chamber over the floor, which it shades; its walls take what they take meanwhile.
 */
static inline void carry_a_block(recount_scene *s, room_builder *b, double texel)
{
    room_box(b, sp_v(-0.2, -0.3, 0.1), sp_v(0.2, 0.25, 0.4), "block", "block top");
    s->room.moves[2] = s->room.moves[3] = true;
    s->room.setup.sweep = (sp_sweep){.from = {-0.6, 0, 0}, .to = {0.7, 0.05, 0}, .speed = 0.1};
    scene_open(s, b, fmax(texel, GOODS_TEXEL));
}

static inline void goods_in_a_chamber(recount_scene *s, double texel)
{
    room_builder b;
    scene_begin(s, &b, false);
    scene_type(s, SP_PATTERN_FULL_CONE, 70, 0, 12);
    scene_type(s, SP_PATTERN_FLAT_FAN, 80, 6, 7.3);
    s->room.setup.fidelity.trajectory = SP_TRAJECTORY_PARABOLA;
    s->room.setup.criterion = (sp_criterion){.flux = 1.5 * LITRES_PER_MINUTE, .incidence = 75 * DEGREE};
    s->options.max_nozzles = 4;
    s->options.max_water = 40 * LITRES_PER_MINUTE;
    carry_a_block(s, &b, texel);
}

/* So few poses that every layout can be tried. */
static inline void goods_of_few(recount_scene *s, double texel)
{
    room_builder b;
    scene_begin(s, &b, false);
    scene_type(s, SP_PATTERN_FULL_CONE, 90, 0, 9);
    scene_type(s, SP_PATTERN_HOLLOW_CONE, 100, 0.7, 6.4);
    s->room.setup.criterion.flux = 1.2 * LITRES_PER_MINUTE;
    s->mounts[0].tilt = 0;
    s->mounts[0].axis = sp_unit(sp_v(0.4, 0.3, -1));
    s->mounts[0].spacing = 0.25;
    s->options.max_nozzles = 3;
    carry_a_block(s, &b, texel);
}

/* Balls and turning fans by which goods pass. */
static inline void goods_and_bodies(recount_scene *s, double texel)
{
    room_builder b;
    scene_begin(s, &b, false);
    scene_bodies(s);
    s->room.setup.criterion =
        (sp_criterion){.flux = 1.5 * LITRES_PER_MINUTE, .impact_speed = 5, .incidence = 80 * DEGREE};
    s->mounts[0].tilt = 0;
    s->mounts[0].axis = sp_unit(sp_v(0.3, 0.2, -1));
    carry_a_block(s, &b, texel);
}

/* An image with a heavy side, a light one and a gap, so that roll and axis matter; beside it a plain cone. */
static inline void measured_patterns(recount_scene *s, double texel)
{
    enum { COLUMNS = 24, ROWS = 20 };
    room_builder b;
    sp_error error = {0};
    float values[ROWS * COLUMNS];
    for (int i = 0; i < ROWS * COLUMNS; i++) {
        double turn = 2 * M_PI * (i % COLUMNS + 0.5) / COLUMNS;
        values[i] = (float)(i / COLUMNS > 8 && turn > 4 && turn < 5 ? 0 : 1 + 0.8 * cos(turn));
    }
    scene_begin(s, &b, false);
    room_box(&b, sp_v(-0.5, -0.3, 0), sp_v(-0.1, 0.1, 0.5), "box", "top");
    scene_type(s, SP_PATTERN_MEASURED, 110, 0, 8);
    scene_type(s, SP_PATTERN_FULL_CONE, 70, 0, 5);
    s->types[0].patternation = s->patternation = sp_patternation_create(values, COLUMNS, ROWS, 110 * DEGREE, &error);
    assert_non_null(s->patternation);
    s->room.setup.fidelity.trajectory = SP_TRAJECTORY_PARABOLA;
    s->room.setup.criterion.flux = 1.5 * LITRES_PER_MINUTE;
    s->mounts[0].tilt = 40 * DEGREE;
    s->options.max_nozzles = 3;
    scene_open(s, &b, texel);
}

#define DRAG_TEXEL 0.2 /* the same: flights take long to find */

/* Drops of a tenth of a millimetre and of one in one chamber, which fall steeply; some fall from where they stop. */
static inline void mist_and_drops(recount_scene *s, double texel)
{
    room_builder b;
    scene_begin(s, &b, false);
    room_box(&b, sp_v(-0.5, -0.3, 0), sp_v(-0.1, 0.1, 0.5), "box", "top");
    scene_type(s, SP_PATTERN_FULL_CONE, 90, 0, 9);
    scene_type(s, SP_PATTERN_FULL_CONE, 70, 0, 6);
    scene_type(s, SP_PATTERN_FLAT_FAN, 80, 9, 5);
    s->types[0].drop = 1e-4;
    s->types[0].flow_min = 0.7 * s->types[0].flow;
    s->types[0].flow_max = 1.3 * s->types[0].flow;
    s->types[1].drop = 1e-3;
    s->types[2].drop = 2.5e-4;
    s->room.setup.fidelity.trajectory = SP_TRAJECTORY_DRAG;
    s->room.setup.criterion = (sp_criterion){.flux = 2.5 * LITRES_PER_MINUTE, .incidence = 80 * DEGREE};
    s->mounts[0].from.z = s->mounts[0].to.z = 0.8;
    s->mounts[0].spacing = 1.4;
    s->mounts[0].tilt = 40 * DEGREE;
    s->options.max_nozzles = 2;
    scene_open(s, &b, fmax(texel, DRAG_TEXEL));
}

/* Streams that break up on their way, one of them soon, beside a fan of drops; one is kept, of a flow of its own. */
static inline void streams_that_break_up(recount_scene *s, double texel)
{
    room_builder b;
    scene_begin(s, &b, false);
    scene_type(s, SP_PATTERN_SOLID_STREAM, 12, 0, 4);
    scene_type(s, SP_PATTERN_SOLID_STREAM, 20, 0, 0.6);
    scene_type(s, SP_PATTERN_FLAT_FAN, 100, 8, 7);
    s->types[0].drop = s->types[1].drop = 3e-4;
    s->types[1].flow_min = 0.5 * s->types[1].flow;
    s->types[1].flow_max = 2 * s->types[1].flow;
    s->types[2].drop = 5e-4;
    s->room.setup.fidelity.trajectory = SP_TRAJECTORY_DRAG;
    s->room.setup.criterion = (sp_criterion){.flux = LITRES_PER_MINUTE, .impact_speed = 2, .incidence = 85 * DEGREE};
    s->pressures[0] = 0.6e5;
    s->options.pressure_count = 2;
    s->mounts[0].spacing = 1.4;
    s->mounts[0].tilt = 40 * DEGREE;
    s->options.max_nozzles = 3;
    s->kept[0] = (sp_nozzle){.name = "first",
                             .type = &s->types[1],
                             .position = sp_v(0.5, 0.3, 0.7),
                             .axis = sp_unit(sp_v(0.3, 0.2, -1)),
                             .pressure = 2e5,
                             .flow = 0.9 * LITRES_PER_MINUTE,
                             .keep = true};
    s->kept_count = 1;
    scene_open(s, &b, fmax(texel, DRAG_TEXEL));
}

/* What no pattern kernel sums, with drag. */
static inline void bodies_of_drops(recount_scene *s, double texel)
{
    open_bodies_and_boxes(s, SP_TRAJECTORY_DRAG, fmax(texel, DRAG_TEXEL));
    s->mounts[0].tilt = 0;
}

/* Goods that pass drops: so few poses that every layout can be tried. */
static inline void goods_and_drops(recount_scene *s, double texel)
{
    room_builder b;
    scene_begin(s, &b, false);
    scene_type(s, SP_PATTERN_FULL_CONE, 90, 0, 9);
    scene_type(s, SP_PATTERN_FLAT_FAN, 100, 12, 6.4);
    s->types[0].drop = 2.5e-4;
    s->types[1].drop = 8e-4;
    s->room.setup.fidelity.trajectory = SP_TRAJECTORY_DRAG;
    s->room.setup.criterion = (sp_criterion){.flux = 1.2 * LITRES_PER_MINUTE, .incidence = 80 * DEGREE};
    s->mounts[0].tilt = 0;
    s->mounts[0].axis = sp_unit(sp_v(0.4, 0.3, -1));
    s->mounts[0].spacing = 1.4;
    s->options.max_nozzles = 3;
    carry_a_block(s, &b, fmax(texel, DRAG_TEXEL));
}

typedef struct {
    const char *name;
    bool hall;
    bool refined;   /* where one look must do */
    bool sanitized; /* quick enough for a look under the sanitizers, and therefore looked at there alone */
    void (*open)(recount_scene *scene, double texel);
} recount_case;

static const recount_case recount_cases[] = {
    {"thin fans in a hall", true, false, false, fans_in_a_hall},
    {"streams in a hall", true, true, true, streams_in_a_hall},
    {"hollow cones of 0.97", true, false, false, hollow_cones_in_a_hall},
    {"ports, two kept", false, true, false, ports_and_kept},
    {"little water", false, false, false, little_water},
    {"few nozzles", false, true, false, few_nozzles},
    {"one alone must do", false, false, false, one_alone},
    {"parts, both arcs", false, true, true, parts_and_parabolas},
    {"weak flux", false, true, false, weak_flux},
    {"any liquid", false, false, false, any_liquid},
    {"proved", false, false, false, proved},
    {"off the wall", false, false, true, off_the_wall},
    {"off the wall, refined", false, true, false, off_the_wall},
    {"feeble, off the wall", false, false, false, feeble_off_the_wall},
    {"measured patterns", false, true, false, measured_patterns},
    {"film over boxes", false, false, true, film_over_boxes},
    {"film over boxes, refined", false, true, false, film_over_boxes},
    {"film and one alone", false, false, false, film_and_one_alone},
    {"film of few, every layout", false, false, false, film_of_few},
    {"bodies and boxes", false, true, false, bodies_and_boxes},
    {"one body alone", false, false, true, bodies_alone},
    {"bodies and film", false, false, false, bodies_and_film},
    {"bodies of few, every layout", false, false, false, bodies_of_few},
    {"goods in a chamber, refined", false, false, false, goods_in_a_chamber},
    {"goods of few, every layout", false, false, false, goods_of_few},
    {"goods and bodies", false, false, true, goods_and_bodies},
    {"goods and drops, every layout", false, false, false, goods_and_drops},
    {"mist and drops", false, true, false, mist_and_drops},
    {"streams that break up", false, false, false, streams_that_break_up},
    {"bodies of drops", false, false, false, bodies_of_drops},
};
#define RECOUNT_CASES (sizeof recount_cases / sizeof *recount_cases)

#endif
