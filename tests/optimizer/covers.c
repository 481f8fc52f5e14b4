/* Coverings whose least number is known, found by the real placement: equal caps on the sphere, equal discs over the
 * unit disc and the unit square. Each pattern is 2 % wider than the optimum needs. */
#include "room.h"

#define PRESSURE 2e5
#define SLACK 1.08 /* edges are blurred by about a texel, and need as much to spare */

/* Of each kind, the first so many are tried. */
#ifdef SPRAYPLAN_SANITIZE
#define TRIED 1
#else
#define TRIED 4
#endif

typedef struct {
    sp_mesh *mesh;
    sp_surface surface;
    sp_setup setup;
    sp_evaluator *evaluator;
    sp_nozzle_type type;
    const sp_nozzle_type *types[1];
    double pressure;
    sp_mount mount;
    sp_place_options options;
    double needed; /* nozzles that every cover takes at least, however aimed, as far as that was proved */
} scene;

static void scene_open(scene *s, const sp_vec3 *vertices, size_t vertex_count, const uint32_t (*triangles)[3],
                       size_t triangle_count, double half_angle, double texel)
{
    sp_error error = {0};
    const char *name = "target";
    uint32_t *part = calloc(triangle_count, sizeof *part);
    assert_non_null(part);
    s->mesh = sp_mesh_create(vertices, vertex_count, triangles, triangle_count, part, &name, 1, &error);
    free(part);
    assert_non_null(s->mesh);
    s->surface = (sp_surface){.clean = true, .rebound = 1};
    s->setup = sp_setup_default();
    s->setup.mesh = s->mesh;
    s->setup.surfaces = &s->surface;
    s->setup.fidelity.trajectory = SP_TRAJECTORY_LINE;
    s->setup.fidelity.texel = texel;
    s->setup.fidelity.accuracy = ROOM_ACCURACY;
    s->evaluator = sp_evaluator_create(&s->setup, &error);
    assert_string_equal(error.message, "");
    s->type = room_cone("equal", 2 * half_angle, 10);
    s->types[0] = &s->type;
    s->pressure = PRESSURE;
    s->options = room_options();
    s->options.objective = SP_OBJECTIVE_MIN_WATER;
    s->options.coverage = 0.99999;
    s->options.types = s->types;
    s->options.type_count = 1;
    s->options.pressures = &s->pressure;
    s->options.pressure_count = 1;
    s->options.mounts = &s->mount;
    s->options.mount_count = 1;
    /* anywhere within the mount */
    s->options.refine = (sp_refine){.position = 1, .axis = 60 * DEGREE};
}

/* The least number found; with it the scene is closed. */
static size_t scene_place(scene *s)
{
    sp_error error = {0};
    sp_proposal *proposal = sp_place(s->evaluator, &s->options, &error);
    assert_string_equal(error.message, "");
    assert_non_null(proposal);
    room_check(proposal, &s->options);
    assert_true(proposal->reached);
    size_t greedy = proposal->greedy->count, count = proposal->layout->count;
    double seconds = 0;
    for (size_t i = 0; i < proposal->stage_count; i++)
        seconds += proposal->stages[i].seconds;
    print_message("  on the candidates %zu, refined %zu, %.1f s\n", greedy, count, seconds);
    assert_true(count <= greedy);
    if (proposal->certificate.every_aim.computed)
        s->needed = proposal->certificate.every_aim.water_bound / s->type.flow;
    sp_proposal_destroy(proposal);
    sp_evaluator_destroy(s->evaluator);
    sp_mesh_destroy(s->mesh);
    return count;
}

/* A square of n x n cells on [-1, 1]², mapped by `shape`. */
typedef sp_vec3 (*shape)(double u, double v, int face);

#define CELLS 24
static size_t scene_place_shape(scene *s, shape map, int faces, double half_angle, double texel)
{
    size_t side = CELLS + 1, vertex_count = 0, triangle_count = 0;
    sp_vec3 *vertices = malloc((size_t)faces * side * side * sizeof *vertices);
    uint32_t(*triangles)[3] = malloc((size_t)faces * CELLS * CELLS * 2 * sizeof *triangles);
    assert_true(vertices && triangles);
    for (int face = 0; face < faces; face++) {
        uint32_t first = (uint32_t)vertex_count;
        for (size_t j = 0; j < side; j++)
            for (size_t i = 0; i < side; i++)
                vertices[vertex_count++] = map(2.0 * (double)i / CELLS - 1, 2.0 * (double)j / CELLS - 1, face);
        for (uint32_t j = 0; j < CELLS; j++)
            for (uint32_t i = 0; i < CELLS; i++) {
                uint32_t a = first + j * (uint32_t)side + i, b = a + 1, c = a + (uint32_t)side, d = c + 1;
                const uint32_t halves[2][3] = {{a, b, d}, {a, d, c}};
                memcpy(triangles[triangle_count], halves, sizeof halves);
                triangle_count += 2;
            }
    }
    scene_open(s, vertices, vertex_count, (const uint32_t(*)[3])triangles, triangle_count, half_angle, texel);
    free(vertices);
    free(triangles);
    return scene_place(s);
}

/* The faces of a cube blown up to the unit sphere, at equal angles. */
static sp_vec3 sphere(double u, double v, int face)
{
    double a = tan(0.25 * M_PI * u), b = tan(0.25 * M_PI * v), sign = face % 2 ? -1 : 1;
    switch (face / 2) {
    case 0:
        return sp_unit(sp_v(sign, a, b));
    case 1:
        return sp_unit(sp_v(a, sign, b));
    default:
        return sp_unit(sp_v(a, b, sign));
    }
}

/* The square's rings blown up to circles. */
static sp_vec3 disc(double u, double v, int face)
{
    (void)face;
    double ring = fmax(fabs(u), fabs(v)), length = hypot(u, v);
    return length > 0 ? sp_v(u * ring / length, v * ring / length, 0) : sp_v(0, 0, 0);
}

static sp_vec3 square(double u, double v, int face)
{
    (void)face;
    return sp_v(0.5 * u, 0.5 * v, 0);
}

/* Half-angles of the optimal coverings: tetrahedron, octahedron's faces' and icosahedron's circumscribed caps. */
static void caps_on_the_sphere(void **state)
{
    (void)state;
    static const struct {
        double degrees;
        size_t number;
    } known[] = {{70.5288, 4}, {54.7356, 6}, {37.3774, 12}};
    for (size_t i = 0; i < sizeof known / sizeof *known && i < TRIED; i++) {
        scene s = {.mount = {.kind = SP_MOUNT_BOX, .axis = sp_v(0, 0, -1), .tilt = M_PI}};
        size_t count = scene_place_shape(&s, sphere, 6, SLACK * known[i].degrees * DEGREE, 0.09);
        if (count != known[i].number)
            fail_msg("caps of %g deg: %zu, expected %zu", known[i].degrees, count, known[i].number);
        /* the nozzles' one place is given, so that what holds for every aim holds for all covers; a proof that says
         * little is one that does not even know how much of the sphere a cap is, but for the patches at its edge,
         * which count whole where an aim is not known exactly */
        double share = 0.5 * (1 - cos(SLACK * known[i].degrees * DEGREE));
        print_message("  every cover takes %.2f or more\n", s.needed);
        assert_true(s.needed <= (double)known[i].number + 1e-9 && s.needed + 1e-3 >= floor(1 / share) - 1);
    }
}

static void discs_over(shape shape, double half, const double *radii, const size_t *numbers, size_t known, double texel)
{
    for (size_t i = 0; i < known && i < TRIED; i++) {
        scene s = {.mount = {.kind = SP_MOUNT_BOX,
                             .axis = sp_v(0, 0, -1),
                             .spacing = 0.25 * half,
                             .from = sp_v(-half, -half, 1),
                             .to = sp_v(half, half, 1)}};
        size_t count = scene_place_shape(&s, shape, 1, atan(SLACK * radii[i]), texel);
        if (count != numbers[i])
            fail_msg("discs of radius %g: %zu, expected %zu", radii[i], count, numbers[i]);
    }
}

/* Radii of the optimal coverings of the unit disc: Neville 1915 for five, Bezdek 1979 for five and six. */
static void discs_over_the_disc(void **state)
{
    (void)state;
    static const double radii[] = {0.707107, 0.609383, 0.555906, 0.5};
    static const size_t numbers[] = {4, 5, 6, 7};
    discs_over(disc, 1, radii, numbers, 4, 0.05);
}

/* Of the unit square: Tarnai and Gáspár 1995. */
static void discs_over_the_square(void **state)
{
    (void)state;
    static const double radii[] = {0.353554, 0.326161, 0.274292};
    static const size_t numbers[] = {4, 5, 7};
    discs_over(square, 0.5, radii, numbers, 3, 0.025);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(caps_on_the_sphere),
        cmocka_unit_test(discs_over_the_disc),
        cmocka_unit_test(discs_over_the_square),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
