/* Mounting points: how many, where, inside and clear. */
#include "room.h"

#include "candidates/candidates.h"
#include "mesh/distance.h"

#include <sprayplan/fitting.h>

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

static double nearest_of_others(const room *r, const sp_site *site)
{
    double least = INFINITY;
    for (uint32_t t = 0; t < r->mesh->triangle_count; t++)
        if (r->mesh->part[t] != site->own)
            least = fmin(least, sp_distance(site->position, sp_triangle_nearest(r->mesh, t, site->position)));
    return least;
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
        assert_true(nearest_of_others(r, &sites.items[i]) >= clearance * (1 - 1e-9));
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
    /* no place of the lid is farther from a point than the spacing and what the samples leave open, hardly any farther
     * than refinement moves */
    const sp_place_options standard = sp_place_options_default();
    size_t within = 0, places = 0;
    for (double x = -0.95; x < 1; x += 0.1)
        for (double y = -0.95; y < 1; y += 0.1) {
            double nearest = INFINITY;
            for (size_t i = 0; i < sites.count; i++)
                nearest = fmin(nearest, sp_distance(sp_v(x, y, 1.95), sites.items[i].position));
            assert_true(nearest < 0.25 * 1.5);
            within += nearest <= sp_move_limit(&standard, &lid);
            places++;
        }
    assert_true(within >= 0.98 * places);
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

static double next_random(uint64_t *state)
{
    *state ^= *state >> 12;
    *state ^= *state << 25;
    *state ^= *state >> 27;
    return (double)((*state * 0x2545f4914f6cdd1du) >> 11) * 0x1p-53;
}

static sp_vec3 random_point(uint64_t *random, double edge, double top)
{
    double x = next_random(random), y = next_random(random), z = next_random(random);
    return sp_v(edge * (2 * x - 1), edge * (2 * y - 1), top * z);
}

/* How far a point is from the block's surface; negative inside. */
static double from_block(sp_vec3 p)
{
    double x = fabs(p.x) - 0.2, y = fabs(p.y) - 0.2, z = fabs(p.z - 1) - 0.2;
    double outside = sqrt(pow(fmax(x, 0), 2) + pow(fmax(y, 0), 2) + pow(fmax(z, 0), 2));
    return outside + fmin(0, fmax(x, fmax(y, z)));
}

/* How far a point is inside the room's walls, the lid left out where it is the mount's own; negative outside. */
static double from_walls(sp_vec3 p, bool without_lid)
{
    double side = fmin(1 - fabs(p.x), 1 - fabs(p.y));
    return fmin(side, fmin(p.z, without_lid && p.z < 2 ? INFINITY : 2 - p.z));
}

static bool belongs(sp_vec3 p, double clearance, bool without_lid)
{
    double walls = from_walls(p, without_lid), block = from_block(p);
    return walls > 0 && block > 0 && walls >= clearance && block >= clearance;
}

/* Points so near a limit that round-off or the lines of sight decide are not judged. */
static bool undecided(sp_vec3 p, double clearance, bool without_lid)
{
    double walls = from_walls(p, without_lid), block = from_block(p);
    return fabs(walls) < 1e-6 || fabs(block) < 1e-6 || fabs(walls - clearance) < 1e-6 || fabs(block - clearance) < 1e-6;
}

static bool holds_point(const sp_sites *sites, sp_vec3 p)
{
    for (size_t i = 0; i < sites->count; i++)
        if (sp_distance(sites->items[i].position, p) < 1e-9)
            return true;
    return false;
}

/* Random lines and boxes that stick out of the room and into the block: what stays is what geometry says, all of it and
 * nothing else. */
static void random_lines_and_boxes_keep_what_is_inside_and_clear(void **state)
{
    (void)state;
    room r;
    open_block_room(&r);
    uint64_t random = 3;
    size_t in = 0, out = 0;
    for (int trial = 0; trial < 60; trial++) {
        sp_vec3 a = random_point(&random, 1.2, 2.2), b = random_point(&random, 1.2, 2.2);
        double clearance = trial % 3 ? 0.15 * next_random(&random) : 0;
        sp_mount mount = {.kind = trial % 2 ? SP_MOUNT_LINE : SP_MOUNT_BOX, .axis = sp_v(0, 0, -1), .spacing = 0.3};
        bool line = mount.kind == SP_MOUNT_LINE;
        mount.from = line ? a : sp_v(fmin(a.x, b.x), fmin(a.y, b.y), fmin(a.z, b.z));
        mount.to = line ? b : sp_v(fmax(a.x, b.x), fmax(a.y, b.y), fmax(a.z, b.z));
        sp_vec3 edge = sp_sub(mount.to, mount.from);
        size_t nx = 1 + (size_t)ceil((line ? sp_length(edge) : edge.x) / 0.3),
               ny = line ? 1 : 1 + (size_t)ceil(edge.y / 0.3), nz = line ? 1 : 1 + (size_t)ceil(edge.z / 0.3),
               expected = 0;
        sp_place_options options = room_options();
        options.mounts = &mount;
        options.mount_count = 1;
        options.clearance = clearance;
        sp_sites sites = {0};
        sp_error error = {0};
        bool any = sp_sites_create(r.evaluator, &options, &sites, &error);
        bool doubtful = false;
        for (size_t i = 0; i < nx * ny * nz; i++) {
            double u = (double)(i % nx) / (double)(nx - 1), v = ny > 1 ? (double)(i / nx % ny) / (double)(ny - 1) : u,
                   w = nz > 1 ? (double)(i / nx / ny) / (double)(nz - 1) : u;
            sp_vec3 p = sp_v(mount.from.x + u * edge.x, mount.from.y + v * edge.y, mount.from.z + w * edge.z);
            bool here = belongs(p, clearance, false);
            if (undecided(p, clearance, false)) {
                doubtful = true;
                continue;
            }
            assert_true(holds_point(&sites, p) == here);
            expected += here;
            in += here;
            out += !here;
        }
        assert_true(doubtful || sites.count == expected);
        assert_true(any == (sites.count > 0));
        sp_sites_free(&sites);
    }
    assert_true(in > 200 && out > 200);
    room_close(&r);
}

/* Lances through the lid at random places and slants: up to the first wall that is not the lid's, and clear of all
 * others. */
static void random_lances_stop_before_what_is_in_their_way(void **state)
{
    (void)state;
    room r;
    open_block_room(&r);
    uint64_t random = 5;
    size_t in = 0, out = 0;
    for (int trial = 0; trial < 60; trial++) {
        sp_vec3 at = random_point(&random, 0.9, 0);
        sp_mount mount = {.kind = SP_MOUNT_PORT,
                          .position = sp_v(at.x, at.y, 2),
                          .depth_from = 0.05,
                          .depth_to = 2.2,
                          .depth_spacing = 0.05};
        mount.axis = sp_unit(sp_v(0.6 * (next_random(&random) - 0.5), 0.6 * (next_random(&random) - 0.5), -1));
        double clearance = 0.1 * next_random(&random);
        sp_place_options options = room_options();
        options.mounts = &mount;
        options.mount_count = 1;
        options.clearance = clearance;
        sp_sites sites = {0};
        sp_error error = {0};
        sp_sites_create(r.evaluator, &options, &sites, &error);
        bool blocked = false;
        for (size_t i = 0; i <= 43; i++) {
            double depth = 0.05 + 2.15 * (double)i / 43;
            sp_vec3 p = sp_along(mount.position, depth, mount.axis);
            for (double t = 0; t <= depth; t += 1e-3) {
                sp_vec3 on = sp_along(mount.position, t, mount.axis);
                blocked |= t > 0.01 && (from_block(on) < -1e-3 || from_walls(on, true) < -1e-3);
            }
            bool here = !blocked && belongs(p, clearance, true);
            if (undecided(p, clearance, true) || fabs(from_block(p)) < 5e-3 || fabs(from_walls(p, true)) < 5e-3)
                continue;
            assert_true(holds_point(&sites, p) == here);
            in += here;
            out += !here;
        }
        sp_sites_free(&sites);
    }
    assert_true(in > 200 && out > 200);
    room_close(&r);
}

/* A part smaller than a square of the spacing still has a place for a nozzle. */
static void small_parts_have_a_point(void **state)
{
    (void)state;
    room r;
    open_block_room(&r);
    sp_mount top = {.kind = SP_MOUNT_SURFACE, .geometry = 0, .part = 3, .spacing = 5, .standoff = 0.05};
    sp_sites sites = sites_of(&r, &top, 0);
    assert_int_equal(sites.count, 1);
    assert_true(fabs(sites.items[0].position.z - 1.25) < 1e-12 && sites.items[0].axis.z > 0.999);
    sp_sites_free(&sites);
    room_close(&r);
}

/* Axes stay within the tilt, reach its rim, and leave no direction within it far from all of them. */
static void axes_fill_the_tilt(void **state)
{
    (void)state;
    room r;
    open_block_room(&r);
    const double tilts[] = {0, 20 * DEGREE, 90 * DEGREE, M_PI};
    sp_nozzle_type cone = room_cone("cone", 60 * DEGREE, 10), fan = room_cone("fan", 60 * DEGREE, 10),
                   ball = room_cone("ball", 360 * DEGREE, 10);
    fan.pattern = SP_PATTERN_FLAT_FAN;
    fan.thickness = 8 * DEGREE;
    const sp_nozzle_type *types[] = {&cone, &fan, &ball};
    double pressure = 2e5;
    uint64_t random = 9;
    for (size_t t = 0; t < sizeof tilts / sizeof *tilts; t++) {
        sp_mount mount = {.kind = SP_MOUNT_BOX,
                          .axis = sp_unit(sp_v(0.3, -0.5, -0.8)),
                          .tilt = tilts[t],
                          .from = sp_v(0.5, 0.5, 1),
                          .to = sp_v(0.5, 0.5, 1)};
        sp_place_options options = room_options();
        options.types = types;
        options.type_count = 3;
        options.pressures = &pressure;
        options.pressure_count = 1;
        options.mounts = &mount;
        options.mount_count = 1;
        sp_sites sites = sites_of(&r, &mount, 0);
        sp_candidates candidates;
        sp_error error = {0};
        assert_true(sp_candidates_create(r.evaluator, &options, &sites, &candidates, &error));
        assert_int_equal(sp_candidates_axes(&candidates, 0, 2)->count, 1); /* a ball is the same whatever its axis */
        for (uint32_t variant = 0; variant < 2; variant++) {
            size_t count = sp_candidates_axes(&candidates, 0, variant)->count;
            double farthest = 0;
            for (uint32_t a = 0; a < count; a++) {
                sp_nozzle nozzle = sp_pose_nozzle(&candidates, &sites, (sp_pose){0, variant, a, 0}, sp_v(0, 0, 1));
                double lean = acos(fmin(1, fmax(-1, sp_dot(nozzle.axis, mount.axis))));
                assert_true(lean <= tilts[t] + 1e-7);
                assert_true(fabs(sp_length(nozzle.axis) - 1) < 1e-12);
                farthest = fmax(farthest, lean);
            }
            assert_true(fabs(farthest - tilts[t]) < 1e-7);
            for (int k = 0; k < 200; k++) {
                sp_vec3 d = sp_unit(sp_sub(random_point(&random, 1, 2), sp_v(0, 0, 1)));
                double nearest = M_PI;
                if (sp_dot(d, mount.axis) < cos(tilts[t]))
                    continue;
                for (uint32_t a = 0; a < count; a++) {
                    sp_nozzle nozzle = sp_pose_nozzle(&candidates, &sites, (sp_pose){0, variant, a, 0}, sp_v(0, 0, 1));
                    nearest = fmin(nearest, acos(fmin(1, fmax(-1, sp_dot(nozzle.axis, d)))));
                }
                assert_true(nearest < 10 * DEGREE);
            }
        }
        sp_candidates_free(&candidates);
        sp_sites_free(&sites);
    }
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

/* One limit for all of them, which names the mount of most points. */
static void all_mounts_together_have_a_limit(void **state)
{
    (void)state;
    room r;
    open_block_room(&r);
    sp_mount mounts[] = {{.kind = SP_MOUNT_LINE, .axis = sp_v(0, 0, -1), .to = sp_v(0, 0, 1), .spacing = 1.0 / 49998},
                         {.kind = SP_MOUNT_BOX, .axis = sp_v(0, 0, -1), .to = sp_v(0, 0, 1), .spacing = 1.0 / 50000}};
    snprintf(mounts[1].name, sizeof mounts[1].name, "rack");
    sp_place_options options = room_options();
    options.mounts = mounts;
    options.mount_count = 2;
    size_t all[2], usable[2];
    sp_error error = {0};
    assert_true(sp_place_count_points(r.evaluator, &options, all, usable, &error));
    assert_int_equal(all[0] + all[1], SP_MOUNTING_POINTS);
    mounts[0].spacing = 1.0 / 49999;
    assert_false(sp_place_count_points(r.evaluator, &options, all, usable, &error));
    assert_int_equal(error.kind, SP_ERROR_INPUT);
    assert_string_equal(error.message,
                        "mounts: box 'rack' (number 2): found 50001 mounting points, 100001 with those of all mounts, "
                        "expected at most 100000 in all: a longer spacing gives fewer");
    room_close(&r);
}

static void unusable_points_are_counted(void **state)
{
    (void)state;
    room r;
    open_block_room(&r);
    const sp_mount mounts[] = {{.kind = SP_MOUNT_PORT, .position = sp_v(5, 0, 1), .axis = sp_v(0, 0, -1)},
                               {.kind = SP_MOUNT_LINE,
                                .axis = sp_v(0, 0, -1),
                                .from = sp_v(0, 0.5, 1),
                                .to = sp_v(2, 0.5, 1),
                                .spacing = 0.5}};
    sp_place_options options = room_options();
    options.mounts = mounts;
    options.mount_count = 2;
    size_t all[2], usable[2];
    sp_error error = {0};
    assert_true(sp_place_count_points(r.evaluator, &options, all, usable, &error));
    assert_int_equal(all[0], 1);
    assert_int_equal(usable[0], 0);
    assert_int_equal(all[1], 5);
    assert_int_equal(usable[1], 2); /* the third lies in the wall */
    room_close(&r);
}

/* Near a corner a nozzle is welded to the wall that it stands off as the mount asks for, and points away from, also
 * where the other one is nearer; one that stands so off none to the nearest. */
static void welded_to_its_own_wall(void **state)
{
    (void)state;
    room r;
    open_block_room(&r);
    const sp_mount mount = {.kind = SP_MOUNT_SURFACE, .part = SP_NONE, .spacing = 0.5, .standoff = 0.1, .tilt = 1};
    const sp_nozzle_type type = {.name = "jet", .pattern = SP_PATTERN_FULL_CONE, .angle = 1, .flow = 1e-4, .at = 1e5};
    static const struct {
        sp_vec3 position, axis;
        double x, y, standoff; /* mm */
    } nozzles[] = {{{-0.9, -0.97, 0.5}, {1, 0, 0}, -1000, -970, 100},
                   {{-0.97, 0.9, 0.5}, {0, -1, 0}, -970, 1000, 100},
                   {{-0.9, -0.97, 0.5}, {0, 1, 0}, -900, -1000, 30}};
    for (size_t i = 0; i < 3; i++) {
        sp_nozzle nozzle = {.name = "N",
                            .type = &type,
                            .position = nozzles[i].position,
                            .axis = nozzles[i].axis,
                            .angle = 1,
                            .flow = 1e-4,
                            .pressure = 1e5};
        const sp_layout layout = {.count = 1, .nozzles = &nozzle};
        sp_error error = {0};
        sp_fitting_sheet *sheet = sp_fitting_sheet_create(&layout, &r.setup, &mount, 1, &error);
        assert_non_null(sheet);
        assert_true(fabs(sheet->rows[0].at.x_mm - nozzles[i].x) < 1e-9);
        assert_true(fabs(sheet->rows[0].at.y_mm - nozzles[i].y) < 1e-9);
        assert_true(fabs(sheet->rows[0].standoff_mm - nozzles[i].standoff) < 1e-9);
        sp_fitting_sheet_destroy(sheet);
    }
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
        cmocka_unit_test(lances_go_down_from_their_port),
        cmocka_unit_test(lines_and_boxes_include_their_ends),
        cmocka_unit_test(surfaces_are_covered_evenly),
        cmocka_unit_test(random_lines_and_boxes_keep_what_is_inside_and_clear),
        cmocka_unit_test(random_lances_stop_before_what_is_in_their_way),
        cmocka_unit_test(small_parts_have_a_point),
        cmocka_unit_test(axes_fill_the_tilt),
        cmocka_unit_test(nothing_left_is_an_error),
        cmocka_unit_test(all_mounts_together_have_a_limit),
        cmocka_unit_test(unusable_points_are_counted),
        cmocka_unit_test(welded_to_its_own_wall),
        cmocka_unit_test(distance_to_a_triangle),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
