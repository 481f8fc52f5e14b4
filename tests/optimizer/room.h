/* Rooms to place nozzles in: boxes seen from inside, and what the tests ask of a placement. */
#ifndef ROOM_H
#define ROOM_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include <sprayplan/place.h>

#define DEGREE (M_PI / 180)
#define LITRES_PER_MINUTE (1e-3 / 60)

/* Accuracy where none is asserted: points that measure a proposal's error and jets that count it again are few. */
#define ROOM_ACCURACY 0.2

#define ROOM_VERTICES 96
typedef struct {
    sp_vec3 vertices[ROOM_VERTICES];
    uint32_t triangles[ROOM_VERTICES][3];
    uint32_t part[ROOM_VERTICES];
    size_t vertex_count, triangle_count, part_count;
    const char *names[8];
} room_builder;

/* A rectangle from `corner` along a and b, its front towards a x b, of the last part begun. */
static inline void room_sheet(room_builder *b, sp_vec3 corner, sp_vec3 a, sp_vec3 c)
{
    uint32_t first = (uint32_t)b->vertex_count;
    b->vertices[b->vertex_count++] = corner;
    b->vertices[b->vertex_count++] = sp_add(corner, a);
    b->vertices[b->vertex_count++] = sp_add(sp_add(corner, a), c);
    b->vertices[b->vertex_count++] = sp_add(corner, c);
    const uint32_t halves[2][3] = {{first, first + 1, first + 2}, {first, first + 2, first + 3}};
    for (int i = 0; i < 2; i++) {
        memcpy(b->triangles[b->triangle_count], halves[i], sizeof halves[i]);
        b->part[b->triangle_count++] = (uint32_t)b->part_count - 1;
    }
}

static inline void room_part(room_builder *b, const char *name)
{
    b->names[b->part_count++] = name;
}

/* The box from low to high, its triangles facing outwards, the lid (high z) a part of its own. */
static inline void room_box(room_builder *b, sp_vec3 low, sp_vec3 high, const char *walls, const char *lid)
{
    sp_vec3 x = {high.x - low.x, 0, 0}, y = {0, high.y - low.y, 0}, z = {0, 0, high.z - low.z};
    room_part(b, walls);
    room_sheet(b, low, y, x);
    room_sheet(b, low, x, z);
    room_sheet(b, low, z, y);
    room_sheet(b, sp_add(low, x), y, z);
    room_sheet(b, sp_add(low, y), z, x);
    room_part(b, lid);
    room_sheet(b, sp_add(low, z), x, y);
}

typedef struct {
    sp_mesh *mesh;
    sp_surface surfaces[8];
    bool moves[8]; /* parts, where the setup has a sweep */
    sp_setup setup;
    sp_evaluator *evaluator;
} room;

static inline void room_open(room *r, const room_builder *b, double texel)
{
    sp_error error = {0};
    r->mesh = sp_mesh_create(b->vertices, b->vertex_count, b->triangles, b->triangle_count, b->part, b->names,
                             b->part_count, &error);
    assert_non_null(r->mesh);
    for (size_t i = 0; i < b->part_count; i++)
        r->surfaces[i] = (sp_surface){.clean = true, .rebound = 1, .moves = r->moves[i]};
    r->setup.mesh = r->mesh;
    r->setup.surfaces = r->surfaces;
    r->setup.fidelity.texel = texel;
    r->evaluator = sp_evaluator_create(&r->setup, &error);
    assert_string_equal(error.message, "");
    assert_non_null(r->evaluator);
}

static inline void room_close(room *r)
{
    sp_evaluator_destroy(r->evaluator);
    sp_mesh_destroy(r->mesh);
}

static inline sp_nozzle_type room_cone(const char *name, double angle, double litres)
{
    sp_nozzle_type type = {.pattern = SP_PATTERN_FULL_CONE,
                           .angle = angle,
                           .flow = litres * LITRES_PER_MINUTE,
                           .at = 2e5,
                           .exponent = 0.5,
                           .cv = 0.95,
                           .drop = 1e-3,
                           .angle_min = angle,
                           .angle_max = angle};
    type.flow_min = type.flow_max = type.flow;
    strncpy(type.name, name, SP_NAME - 1);
    return type;
}

/* Nothing is refined unless a test says so. */
static inline sp_place_options room_options(void)
{
    sp_place_options options = sp_place_options_default();
    options.refine = (sp_refine){0};
    return options;
}

/* m² that a layout covers, as the scene says; takes the layout. */
static inline double room_area_of(const room *r, sp_layout *layout)
{
    sp_error error = {0};
    sp_coverage *coverage = sp_evaluate(r->evaluator, layout, &error);
    assert_non_null(coverage);
    double area = coverage->covered_area;
    sp_coverage_destroy(coverage);
    sp_layout_destroy(layout);
    return area;
}

/* What every proposal must hold. */
static inline void room_check(const sp_proposal *proposal, const sp_place_options *options)
{
    assert_non_null(proposal->layout);
    assert_non_null(proposal->greedy);
    assert_int_equal(proposal->attainable != NULL, 1);
    assert_true(!options->max_nozzles || proposal->layout->count <= options->max_nozzles);
    assert_true(proposal->coverage->flow <= options->max_water * (1 + 1e-9));
    for (size_t i = 0; i < proposal->layout->count; i++)
        for (size_t j = 0; j < i; j++)
            assert_string_not_equal(proposal->layout->nozzles[i].name, proposal->layout->nozzles[j].name);
    for (size_t i = 1; i < proposal->front_count; i++) {
        assert_true(proposal->front[i].outlay > proposal->front[i - 1].outlay);
        assert_true(proposal->front[i].area > proposal->front[i - 1].area);
    }
    for (size_t i = 1; i < proposal->by_number_count; i++) {
        assert_true(proposal->by_number[i].nozzles > proposal->by_number[i - 1].nozzles);
        assert_true(proposal->by_number[i].area > proposal->by_number[i - 1].area);
    }
    for (size_t i = 0; i < proposal->front_count; i++) {
        double area = 0;
        for (size_t k = 0; k < proposal->by_number_count; k++)
            if (proposal->by_number[k].nozzles <= proposal->front[i].nozzles)
                area = proposal->by_number[k].area;
        assert_true(area >= proposal->front[i].area);
    }
    assert_true(proposal->coverage->covered_area <= proposal->attainable_area * (1 + 1e-12));
    const sp_certificate *certificate = &proposal->certificate;
    if (!certificate->computed)
        return;
    assert_true(certificate->area_bound >= certificate->counted);
    assert_true(certificate->area_bound <= certificate->whole);
    assert_true(certificate->water_bound <= proposal->outlay * (1 + 1e-9));
    assert_true(certificate->gap >= 0 && certificate->gap <= 1);
    for (size_t i = 0; i < proposal->front_count; i++)
        assert_true(proposal->front[i].bound >= proposal->front[i].counted);
}

#endif
