/* A tank for tests of the report: a cylinder with dished ends, a dip tube that throws a shadow and an obstacle, two
 * layouts. */
#ifndef TESTS_REPORT_TANK_H
#define TESTS_REPORT_TANK_H

#include <sprayplan/sprayplan.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define TANK_RADIUS 0.6
#define TANK_HEIGHT 1.2
#define TANK_DISH 0.22

typedef struct {
    sp_vec3 *points;
    uint32_t (*triangles)[3];
    uint32_t *part;
    size_t point_count, triangle_count;
} tank_builder;

/* A surface of revolution about a vertical axis through (x, y); `profile` is (radius, z) pairs. The front is on the
 * right of the profile's direction: a profile that climbs an outer wall faces inwards where `inwards`. */
static void tank_revolve(tank_builder *b, double x, double y, const double (*profile)[2], int rings, int around,
                         bool inwards, uint32_t part)
{
    size_t base = b->point_count;
    for (int i = 0; i < rings; ++i)
        for (int k = 0; k < around; ++k) {
            double turn = 2 * M_PI * k / around;
            b->points[b->point_count++] =
                sp_v(x + profile[i][0] * cos(turn), y + profile[i][0] * sin(turn), profile[i][1]);
        }
    for (int i = 0; i + 1 < rings; ++i)
        for (int k = 0; k < around; ++k) {
            uint32_t a = (uint32_t)(base + (size_t)(i * around + k)),
                     c = (uint32_t)(base + (size_t)(i * around + (k + 1) % around));
            uint32_t d = a + (uint32_t)around, e = c + (uint32_t)around;
            const uint32_t outward[2][3] = {{a, c, e}, {a, e, d}};
            for (int t = 0; t < 2; ++t) {
                uint32_t *triangle = b->triangles[b->triangle_count];
                triangle[0] = outward[t][0];
                triangle[1] = outward[t][inwards ? 2 : 1];
                triangle[2] = outward[t][inwards ? 1 : 2];
                b->part[b->triangle_count++] = part;
            }
        }
}

/* At which of its corners a triangle begins where that is to follow no rule. */
static inline int tank_turn(size_t triangle)
{
    return (int)((uint32_t)triangle * 2654435761u >> 16) % 3;
}

/* Parts: shell, "dip <tube>" and motor, the last an obstacle outside of what is cleaned. */
static sp_mesh *tank_mesh(int around, sp_error *error)
{
    enum { DISH = 8, MOST = 200000 };
    static const char *const names[] = {"shell", "dip <tube>", "shaft"};
    tank_builder b = {malloc(MOST * sizeof *b.points), malloc(MOST * sizeof *b.triangles),
                      malloc(MOST * sizeof *b.part), 0, 0};
    double profile[2 * DISH + 12][2];
    int rings = 0;
    for (int i = 0; i <= DISH; ++i, ++rings) {
        double angle = M_PI / 2 * i / DISH;
        profile[rings][0] = TANK_RADIUS * fmax(sin(angle), 1e-3);
        profile[rings][1] = -TANK_DISH * cos(angle);
    }
    for (int i = 1; i <= 8; ++i, ++rings) {
        profile[rings][0] = TANK_RADIUS;
        profile[rings][1] = TANK_HEIGHT * i / 8;
    }
    for (int i = DISH - 1; i >= 0; --i, ++rings) {
        double angle = M_PI / 2 * i / DISH;
        profile[rings][0] = TANK_RADIUS * fmax(sin(angle), 1e-3);
        profile[rings][1] = TANK_HEIGHT + TANK_DISH * cos(angle);
    }
    tank_revolve(&b, 0, 0, (const double(*)[2])profile, rings, around, true, 0);
    const double tube[][2] = {{1e-3, 0.1}, {0.04, 0.1}, {0.04, 0.5}, {0.04, 0.9}, {0.04, 1.36}};
    tank_revolve(&b, 0.3, 0.05, tube, 5, 24, false, 1);
    const double shaft[][2] = {{1e-3, 0.25}, {0.16, 0.25}, {0.16, 0.29}, {0.03, 0.29}, {0.03, 1.41}};
    tank_revolve(&b, 0, 0, shaft, 5, 32, false, 2);
    sp_mesh *mesh = sp_mesh_create(b.points, b.point_count, (const uint32_t(*)[3])b.triangles, b.triangle_count, b.part,
                                   names, 3, error);
    free(b.points);
    free(b.triangles);
    free(b.part);
    return mesh;
}

static const sp_surface tank_surfaces[3] = {{true, 0, 1, false}, {true, 0, 1, false}, {false, 0, 1, false}};

static inline sp_setup tank_setup(const sp_mesh *mesh, double texel)
{
    sp_setup setup = sp_setup_default();
    setup.mesh = mesh;
    setup.surfaces = tank_surfaces;
    setup.cavity = SP_CAVITY_POINT;
    setup.cavity_point = sp_v(-0.3, 0, 0.7);
    setup.criterion = (sp_criterion){.flux = 2 / 6e4, .incidence = 85 * M_PI / 180};
    setup.fidelity.texel = texel;
    return setup;
}

static const sp_nozzle_type tank_types[2] = {{.name = "full-cone-120",
                                              .pattern = SP_PATTERN_FULL_CONE,
                                              .angle = 2.0944,
                                              .flow = 15 / 6e4,
                                              .at = 2e5,
                                              .exponent = 0.46,
                                              .cv = 0.95,
                                              .drop = 1e-3,
                                              .angle_min = 2.0944,
                                              .angle_max = 2.0944,
                                              .flow_min = 15 / 6e4,
                                              .flow_max = 15 / 6e4},
                                             {.name = "flat-fan-90 & co",
                                              .pattern = SP_PATTERN_FLAT_FAN,
                                              .angle = M_PI / 2,
                                              .thickness = 0.2,
                                              .flow = 8 / 6e4,
                                              .at = 2e5,
                                              .exponent = 0.5,
                                              .cv = 0.95,
                                              .drop = 1e-3,
                                              .angle_min = M_PI / 2,
                                              .angle_max = M_PI / 2,
                                              .flow_min = 8 / 6e4,
                                              .flow_max = 8 / 6e4,
                                              .order_code = "F<90>",
                                              .url = "https://example.com/f?a=1&b=2"}};

static const sp_nozzle tank_manual[3] = {
    {.name = "N1", .type = &tank_types[0], .position = {0.3, -0.25, 1.25}, .axis = {0, 0, -1}, .pressure = 2e5},
    {.name = "N2", .type = &tank_types[0], .position = {-0.3, 0.25, 1.25}, .axis = {0, 0, -1}, .pressure = 2e5},
    {.name = "N3 <b>",
     .type = &tank_types[1],
     .position = {-0.35, -0.2, 1.2},
     .axis = {0, 0, -1},
     .roll = 0.5,
     .pressure = 2e5}};

static const sp_nozzle tank_proposed[4] = {
    {.name = "P1",
     .type = &tank_types[0],
     .position = {-0.35, -0.1, 1.1},
     .axis = {0.447213595499958, 0, 0.894427190999916},
     .pressure = 2e5},
    {.name = "P2",
     .type = &tank_types[0],
     .position = {-0.3, 0.25, 1.0},
     .axis = {0.6, -0.3, -0.74161984870956632},
     .pressure = 2e5},
    {.name = "P3", .type = &tank_types[0], .position = {0.1, -0.4, 0.9}, .axis = {0, 0.6, -0.8}, .pressure = 2e5},
    {.name = "P4", .type = &tank_types[0], .position = {0.45, 0.2, 0.8}, .axis = {-0.8, -0.6, 0}, .pressure = 2e5}};

#endif
