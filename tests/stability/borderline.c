/* Borderline: what lies at a criterion, a spray's edge or an occluder's to 1e-9 is found, what lies farther off is not;
 * and whatever round-off turns between two evaluations of one scene was found. */
#include "stage.h"

#define CLOSE 1e-9
#define FAR 1e-8

typedef struct {
    scene s;
    sp_nozzle_type type;
    sp_nozzle nozzle;
    sp_evaluator *evaluator;
    sp_layout *layout;
    sp_coverage *coverage;
    sp_borderline borderline;
    bool *found; /* [patches] */
} case_of;

static void case_close(case_of *c)
{
    free(c->found);
    sp_coverage_destroy(c->coverage);
    sp_layout_destroy(c->layout);
    sp_evaluator_destroy(c->evaluator);
    c->found = NULL;
    c->coverage = NULL;
    c->layout = NULL;
    c->evaluator = NULL;
}

/* Evaluates anew, after scene or nozzle were changed. */
static void case_run(case_of *c)
{
    sp_error error = {0};
    case_close(c);
    c->nozzle.type = &c->type;
    c->evaluator = scene_evaluator(&c->s);
    c->layout = sp_layout_create(&c->nozzle, 1, &error);
    c->coverage = sp_evaluate_inverse(c->evaluator, c->layout, &error);
    c->found = calloc(sp_evaluator_patches(c->evaluator)->count, sizeof *c->found);
    assert_true(sp_find_borderline(c->evaluator, c->layout, c->coverage, c->found, &c->borderline, &error));
    assert_no_error(&error);
    assert_true(c->borderline.known);
}

/* A floor under a nozzle, and a blade of 0.1 mm that may stand before it, whose edge passes through `edge`. */
static void open_floor(case_of *c, sp_trajectory trajectory, const sp_vec3 *edge)
{
    rectangle shapes[2] = {level_rectangle(1.2, 1.2, 0), {sp_v(5, 5, 0), sp_v(1e-4, 0, 0), sp_v(0, 1e-4, 0)}};
    if (edge)
        shapes[1] = (rectangle){sp_along(*edge, -0.1, sp_v(0.31, 1, 0)), sp_v(0.062, 0.2, 0), sp_v(0.2, -0.06, 0.01)};
    scene_open(&c->s, mesh_of_rectangles(shapes, 2), trajectory, 0.05 / COARSER);
    c->s.surfaces[1].clean = false;
}

static size_t patch_near(const sp_evaluator *evaluator, sp_vec3 place)
{
    const sp_patches *patches = sp_evaluator_patches(evaluator);
    size_t best = 0;
    for (size_t p = 1; p < patches->count; p++)
        if (sp_distance(patches->point[p], place) < sp_distance(patches->point[best], place))
            best = p;
    return best;
}

static void cone_over_floor(case_of *c, sp_trajectory trajectory)
{
    *c = (case_of){.type = spray_type(SP_PATTERN_FULL_CONE, 70)};
    c->nozzle = nozzle_at(&c->type, sp_v(0.013, -0.007, 0.7), sp_v(0.05, 0.02, -1), 6);
    open_floor(c, trajectory, NULL);
    case_run(c);
}

/* `number` of the setup or the type is what the patch has exactly; then a little more. */
static void assert_found_at(case_of *c, double *number, double exact, size_t patch, const char *what)
{
    static const double off[] = {0, 0.5 * CLOSE, -0.5 * CLOSE, FAR, -FAR};
    for (size_t i = 0; i < sizeof off / sizeof *off; i++) {
        *number = exact * (1 + off[i]);
        case_run(c);
        bool expected = fabs(off[i]) <= CLOSE;
        if (c->found[patch] != expected)
            fail_msg("%s off by %g: %s", what, off[i], expected ? "not found" : "found");
        assert_true(c->borderline.area <= 2.1 * sp_evaluator_patches(c->evaluator)->area[patch]);
    }
    print_message("%s: found to 1e-9, not at 1e-8\n", what);
}

static void at_the_criteria(void **state)
{
    (void)state;
    for (int t = SP_TRAJECTORY_LINE; t <= SP_TRAJECTORY_PARABOLA; t++) {
        case_of c;
        cone_over_floor(&c, (sp_trajectory)t);
        size_t patch = patch_near(c.evaluator, sp_v(0.23, 0.11, 0));
        const sp_deposits *d = &c.coverage->deposits;
        double flux = d->flux[patch], speed = d->speed_max[patch], incidence = d->incidence_min[patch];
        assert_true(d->jets[patch] == 1 && d->share[patch] == 1 && c.borderline.area == 0);
        sp_criterion *criterion = &c.s.setup.criterion, none = *criterion;
        assert_found_at(&c, &criterion->flux, flux, patch, "flux");
        *criterion = none;
        assert_found_at(&c, &criterion->incidence, incidence, patch, "incidence");
        *criterion = none;
        criterion->impact_speed = speed * (1 + FAR); /* all that falls as deep arrives as fast */
        case_run(&c);
        assert_false(c.found[patch]);
        criterion->impact_speed = speed * (1 - 0.5 * CLOSE);
        case_run(&c);
        assert_true(c.found[patch]);
        case_close(&c);
        scene_close(&c.s);
    }
}

/* The spray's opening angle is such that its edge passes through the patch's point, and is then turned a little. */
static void at_the_edge_of_a_spray(void **state)
{
    (void)state;
    static const sp_pattern patterns[] = {SP_PATTERN_FULL_CONE, SP_PATTERN_HOLLOW_CONE, SP_PATTERN_FLAT_FAN,
                                          SP_PATTERN_FLAT_FAN};
    for (int i = 0; i < 4; i++) {
        case_of c;
        cone_over_floor(&c, i % 2 ? SP_TRAJECTORY_LINE : SP_TRAJECTORY_PARABOLA);
        size_t patch = patch_near(c.evaluator, sp_v(0.23, 0.11, 0));
        c.type = spray_type(patterns[i], 90);
        sp_flight flight[2];
        assert_true(sp_flights(c.nozzle.position, sp_evaluator_patches(c.evaluator)->point[patch], 6,
                               sp_evaluator_gravity(c.evaluator, NULL), flight) > 0);
        sp_frame frame = sp_nozzle_frame(c.nozzle.axis, c.nozzle.roll, c.s.setup.up);
        sp_vec3 d = flight[0].direction, own = sp_v(sp_dot(d, frame.x), sp_dot(d, frame.y), sp_dot(d, frame.z));
        double polar = atan2(hypot(own.x, own.y), own.z);
        double *number = i == 1 ? &c.type.hollow : i == 2 ? &c.type.thickness : &c.type.angle;
        double exact = i == 0 ? 2 * polar : i == 1 ? polar / deg(45) : 2 * fabs(asin(own.y));
        if (i == 3) {
            exact = 2 * fabs(atan2(own.x, own.z));
            c.type.thickness = deg(60);
        }
        for (int k = -2; k <= 2; k++) { /* the edge is half of the angle off */
            double off = k * 0.5 * CLOSE * (abs(k) > 1 ? 10 : 1);
            *number = i == 1 ? exact + off / deg(45) : exact + 2 * off;
            case_run(&c);
            if (c.found[patch] != (fabs(off) <= CLOSE))
                fail_msg("pattern %d, edge off by %g rad: %sfound", i, off, c.found[patch] ? "" : "not ");
        }
        case_close(&c);
        scene_close(&c.s);
    }
}

/* A blade's edge passes through the flight's middle, and a little beside. */
static void at_the_edge_of_an_occluder(void **state)
{
    (void)state;
    for (int t = SP_TRAJECTORY_LINE; t <= SP_TRAJECTORY_PARABOLA; t++) {
        case_of c;
        cone_over_floor(&c, (sp_trajectory)t);
        sp_vec3 gravity = sp_evaluator_gravity(c.evaluator, NULL);
        size_t patch = patch_near(c.evaluator, sp_v(0.23, 0.11, 0));
        sp_vec3 target = sp_evaluator_patches(c.evaluator)->point[patch];
        sp_flight flight[2];
        assert_true(sp_flights(c.nozzle.position, target, 6, gravity, flight) > 0);
        sp_ray ray = {.origin = c.nozzle.position, .velocity = sp_scale(flight[0].direction, 6)};
        sp_vec3 middle = sp_ray_point(&ray, gravity, 0.5 * flight[0].time);
        sp_vec3 across = sp_unit(sp_cross(sp_ray_velocity(&ray, gravity, 0.5 * flight[0].time), sp_v(0.31, 1, 0)));
        double away = sp_distance(middle, c.nozzle.position);
        size_t jets = 0;
        for (int k = -3; k <= 3; k++) {
            static const double steps[] = {0, 0.1 * CLOSE, 0.9 * CLOSE, FAR};
            double off = (k < 0 ? -1 : 1) * steps[abs(k)];
            sp_vec3 edge = sp_along(middle, off * away, across);
            scene_close(&c.s);
            open_floor(&c, (sp_trajectory)t, &edge);
            case_run(&c);
            assert_true(sp_distance(sp_evaluator_patches(c.evaluator)->point[patch], target) == 0);
            jets += c.coverage->deposits.jets[patch] > 0;
            if (c.found[patch] != (fabs(off) <= CLOSE))
                fail_msg("an occluder's edge off by %g rad: %sfound", off, c.found[patch] ? "" : "not ");
            assert_true(c.borderline.area <= 2.1 * sp_evaluator_patches(c.evaluator)->area[patch]);
        }
        assert_true(jets == 3 || jets == 4); /* on one side of the edge */
        case_close(&c);
        scene_close(&c.s);
    }
}

/* A nozzle in the plane of a wall: whether any liquid comes to it is round-off, unless more is asked for than that. */
static void along_a_wall(void **state)
{
    (void)state;
    case_of c;
    cone_over_floor(&c, SP_TRAJECTORY_LINE);
    c.nozzle.position = sp_v(-0.9, 0.1, 0);
    c.nozzle.axis = sp_v(1, 0, 0);
    case_run(&c);
    assert_true(c.borderline.area > 0.5 * 1.44);
    c.s.setup.criterion.flux = 1e-9;
    case_run(&c);
    assert_true(c.borderline.area == 0);
    case_close(&c);
    scene_close(&c.s);
}

typedef struct {
    stage st;
    sp_evaluator *evaluator;
    sp_coverage *coverage;
    bool *found; /* [patches] */
} posed;

static void pose_stage(posed *p, sp_trajectory trajectory, double scale)
{
    sp_error error = {0};
    sp_transform pose = sp_transform_default();
    pose.scale = scale;
    stage_open(&p->st, trajectory, &pose, sp_v(0, 0, 1));
    p->evaluator = scene_evaluator(&p->st.s);
    p->coverage = sound_cover(p->evaluator, p->st.nozzles, 2, true);
    sp_layout *layout = sp_layout_create(p->st.nozzles, 2, &error);
    p->found = calloc(p->coverage->deposits.count, sizeof *p->found);
    assert_true(sp_find_borderline(p->evaluator, layout, p->coverage, p->found, &p->coverage->borderline, &error));
    assert_no_error(&error);
    sp_layout_destroy(layout);
}

static void pose_close(posed *p)
{
    free(p->found);
    sp_coverage_destroy(p->coverage);
    sp_evaluator_destroy(p->evaluator);
    stage_close(&p->st);
}

/* The furnished room has no symmetry; sizes that are no powers of two round everything otherwise. */
static void no_size_turns_another_verdict(void **state)
{
    (void)state;
    static const double scales[] = {0.1, 0.3, 3, 1e-6, 1e5};
    for (int t = SP_TRAJECTORY_LINE; t <= SP_TRAJECTORY_PARABOLA; t++) {
        posed home, other;
        pose_stage(&home, (sp_trajectory)t, 1);
        double area = home.coverage->area;
        assert_true(home.coverage->borderline.area <= 1e-6 * area);
        for (size_t i = 0; i < sizeof scales / sizeof *scales; i++) {
            pose_stage(&other, (sp_trajectory)t, scales[i]);
            const sp_deposits *a = &home.coverage->deposits, *b = &other.coverage->deposits;
            assert_int_equal(b->count, a->count);
            double worst = 0, rest = 0;
            for (size_t p = 0; p < a->count; p++) {
                if (home.found[p] || other.found[p])
                    continue;
                worst = fmax(worst, fabs(b->share[p] - a->share[p]));
                rest += (b->share[p] - a->share[p]) * sp_evaluator_patches(home.evaluator)->area[p] / area;
            }
            print_message("size %g, %s: borderline %.1e of the area; outside of it no share differs by more than %.1e, "
                          "coverage by %.1e\n",
                          scales[i], t == SP_TRAJECTORY_LINE ? "lines" : "parabolas",
                          home.coverage->borderline.area / area, worst, fabs(rest));
            assert_true(worst <= 1e-9 && fabs(rest) <= 1e-9);
            pose_close(&other);
        }
        pose_close(&home);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(at_the_criteria),
        cmocka_unit_test(at_the_edge_of_a_spray),
        cmocka_unit_test(at_the_edge_of_an_occluder),
        cmocka_unit_test(along_a_wall),
        cmocka_unit_test(no_size_turns_another_verdict),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
