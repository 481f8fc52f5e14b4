/* Mounting points: how many, where, inside and clear. */
#include "room.h"

#include "distance.h"
#include "mounts.h"

/* A room of 2 m with a closed block of 0.4 m in its middle. */
static void open_block_room(room *r)
{
    room_builder b = {0};
    room_box(&b, sp_v(-1, -1, 0), sp_v(1, 1, 2), "walls", "lid");
    room_box(&b, sp_v(-0.2, -0.2, 0.8), sp_v(0.2, 0.2, 1.2), "block", "top");
    *r = (room){.setup = sp_setup_default()};
    r->setup.cavity = SP_CAVITY_POINT;
    r->setup.cavity_point = sp_v(0.6, 0.6, 0.5);
    room_open(r, &b, 0.1);
}

static sp_sites sites_of(const room *r, const sp_mount *mount, double clearance)
{
    sp_place_options options = room_options();
    options.mounts = mount;
    options.mount_count = 1;
    options.clearance = clearance;
    sp_sites sites;
    sp_error error = {0};
    assert_true(sp_sites_create(r->evaluator, &options, &sites, &error));
    for (size_t i = 0; i < sites.count; i++) {
        assert_true(sp_evaluator_inside(r->evaluator, sites.items[i].position));
        assert_true(sp_is_clear(r->mesh, sites.items[i].position, clearance, sites.items[i].own));
    }
    return sites;
}

static void lances_go_down_from_their_port(void **state)
{
    (void)state;
    room r;
    open_block_room(&r);
    sp_mount mount = {.kind = SP_MOUNT_PORT,
                      .position = sp_v(0.6, 0, 2),
                      .axis = sp_v(0, 0, -1),
                      .depth_from = 0.05,
                      .depth_to = 0.45,
                      .depth_spacing = 0.1};
    sp_sites sites = sites_of(&r, &mount, 0.05);
    assert_int_equal(sites.count, 5);
    for (size_t i = 0; i < 5; i++)
        assert_true(fabs(sites.items[i].position.z - (1.95 - 0.1 * (double)i)) < 1e-12);
    sp_sites_free(&sites);

    /* above the block: the tip stays clear of it, and none comes out below */
    mount.position.x = 0;
    mount.depth_to = 1.95;
    sites = sites_of(&r, &mount, 0.05);
    assert_int_equal(sites.count, 8);
    sp_sites_free(&sites);
    room_close(&r);
}

static void lines_and_boxes_include_their_ends(void **state)
{
    (void)state;
    room r;
    open_block_room(&r);
    sp_mount line = {.kind = SP_MOUNT_LINE,
                     .axis = sp_v(0, 0, -1),
                     .spacing = 0.3,
                     .from = sp_v(-0.5, 0.5, 1.5),
                     .to = sp_v(0.5, 0.5, 1.5)};
    sp_sites sites = sites_of(&r, &line, 0.1);
    assert_int_equal(sites.count, 5); /* 1 m in four steps of 0.25 m */
    assert_true(sites.items[0].position.x == -0.5 && sites.items[4].position.x == 0.5);
    sp_sites_free(&sites);

    /* 5 x 5 x 5 points, of which the 3 x 3 x 3 of the block and those within 0.1 m of it are out: x, y, z within 0.3 m
     */
    sp_mount box = {.kind = SP_MOUNT_BOX,
                    .axis = sp_v(0, 0, -1),
                    .spacing = 0.2,
                    .from = sp_v(-0.4, -0.4, 0.6),
                    .to = sp_v(0.4, 0.4, 1.4)};
    sites = sites_of(&r, &box, 0.1);
    assert_int_equal(sites.count, 125 - 27);
    sp_sites_free(&sites);

    /* without clearance the block's inside is out all the same */
    sp_mount inside = {
        .kind = SP_MOUNT_BOX, .axis = sp_v(0, 0, -1), .spacing = 0.6, .from = sp_v(0, 0, 1), .to = sp_v(0.6, 0, 1)};
    sites = sites_of(&r, &inside, 0);
    assert_int_equal(sites.count, 1);
    assert_true(sites.items[0].position.x == 0.6);
    sp_sites_free(&sites);

    sp_mount point = {.kind = SP_MOUNT_BOX, .axis = sp_v(0, 0, -1), .from = sp_v(0.5, 0.5, 1), .to = sp_v(0.5, 0.5, 1)};
    sites = sites_of(&r, &point, 0);
    assert_int_equal(sites.count, 1);
    sp_sites_free(&sites);
    room_close(&r);
}

static void surfaces_are_covered_evenly(void **state)
{
    (void)state;
    room r;
    open_block_room(&r);
    sp_mount lid = {.kind = SP_MOUNT_SURFACE, .geometry = 0, .part = 1, .spacing = 0.25, .standoff = 0.05};
    sp_sites sites = sites_of(&r, &lid, 0);
    assert_in_range(sites.count, 40, 81); /* 64 squares of the spacing */
    for (size_t i = 0; i < sites.count; i++) {
        sp_vec3 p = sites.items[i].position;
        assert_true(fabs(p.z - 1.95) < 1e-12);
        assert_true(sp_distance(sites.items[i].axis, sp_v(0, 0, -1)) < 1e-12);
        for (size_t j = 0; j < i; j++)
            assert_true(sp_distance(p, sites.items[j].position) >= 0.25 - 1e-12);
    }
    /* no place of the lid is farther from a point than the spacing and what the samples leave open */
    for (double x = -0.95; x < 1; x += 0.1)
        for (double y = -0.95; y < 1; y += 0.1) {
            double nearest = INFINITY;
            for (size_t i = 0; i < sites.count; i++)
                nearest = fmin(nearest, sp_distance(sp_v(x, y, 1.95), sites.items[i].position));
            assert_true(nearest < 0.25 * 1.5);
        }
    sp_sites_free(&sites);

    /* all parts: the walls' inside and the block's outside */
    lid.part = SP_NONE;
    lid.spacing = 0.5;
    sites = sites_of(&r, &lid, 0);
    bool on_block = false;
    for (size_t i = 0; i < sites.count; i++) {
        sp_vec3 p = sites.items[i].position;
        assert_true(fabs(p.x) < 1 && fabs(p.y) < 1 && p.z > 0 && p.z < 2);
        on_block |= fabs(p.x) < 0.3 && fabs(p.y) < 0.3 && p.z > 0.7 && p.z < 1.3;
    }
    assert_true(on_block);
    sp_sites_free(&sites);
    room_close(&r);
}

static void nothing_left_is_an_error(void **state)
{
    (void)state;
    room r;
    open_block_room(&r);
    sp_mount mount = {.kind = SP_MOUNT_BOX, .axis = sp_v(0, 0, -1), .from = sp_v(0, 0, 1), .to = sp_v(0, 0, 1)};
    sp_place_options options = room_options();
    options.mounts = &mount;
    options.mount_count = 1;
    sp_sites sites;
    sp_error error = {0};
    assert_false(sp_sites_create(r.evaluator, &options, &sites, &error));
    assert_int_equal(error.kind, SP_ERROR_INPUT);
    mount.to.x = 1;
    mount.spacing = 1e-9;
    error = (sp_error){0};
    assert_false(sp_sites_create(r.evaluator, &options, &sites, &error));
    assert_int_equal(error.kind, SP_ERROR_INPUT);
    room_close(&r);
}

static void distance_to_a_triangle(void **state)
{
    (void)state;
    const sp_vec3 corners[3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const uint32_t triangle[1][3] = {{0, 1, 2}};
    sp_error error = {0};
    sp_mesh *mesh = sp_mesh_create(corners, 3, triangle, 1, NULL, NULL, 1, &error);
    assert_non_null(mesh);
    const struct {
        sp_vec3 point, nearest;
    } cases[] = {{{0.2, 0.2, 1}, {0.2, 0.2, 0}}, {{-1, -1, 1}, {0, 0, 0}},    {{2, -1, 0}, {1, 0, 0}},
                 {{-1, 2, 0}, {0, 1, 0}},        {{0.5, -2, 1}, {0.5, 0, 0}}, {{-2, 0.5, 1}, {0, 0.5, 0}},
                 {{1, 1, 2}, {0.5, 0.5, 0}}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        assert_true(sp_distance(sp_triangle_nearest(mesh, 0, cases[i].point), cases[i].nearest) < 1e-14);
    sp_mesh_destroy(mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lances_go_down_from_their_port), cmocka_unit_test(lines_and_boxes_include_their_ends),
        cmocka_unit_test(surfaces_are_covered_evenly),    cmocka_unit_test(nothing_left_is_an_error),
        cmocka_unit_test(distance_to_a_triangle),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
