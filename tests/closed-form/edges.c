/* The share of patches at a spray's edge: what one nozzle covers of a plate, against closed forms, where the spray is
 * narrower than a texel and where it is wider, and how smoothly that changes with the distance. */
#include "measure.h"

#define TEXEL 0.01

/* A plate below the nozzle, with texels of 10 mm. */
static sp_evaluator *plate_open(scene *s, double width)
{
    rectangle plate = level_rectangle(width, width, 0);
    scene_open(s, mesh_of_rectangles(&plate, 1), SP_TRAJECTORY_LINE, TEXEL);
    s->setup.fidelity.texel = TEXEL;
    return scene_evaluator(s);
}

static double covered_from(const sp_evaluator *evaluator, const sp_nozzle_type *type, double height, int place)
{
    /* anywhere over its texel, and fans turned anyhow */
    sp_vec3 position = sp_v(TEXEL * fmod(0.618 * place, 1), TEXEL * fmod(0.755 * place, 1), height);
    sp_nozzle nozzle = nozzle_at(type, position, sp_v(0, 0, -1), 0.3 + place);
    sp_coverage *coverage = scene_cover(evaluator, &nozzle, 1, true);
    double area = coverage->covered_area;
    sp_coverage_destroy(coverage);
    return area;
}

/* A cone straight down draws a disc of radius h tan(angle/2): streams of a degree, and cones that widen beyond a texel.
 */
static void discs_from_any_distance(void **state)
{
    (void)state;
    static const double angles[] = {1, 2, 5, 20};
    scene s;
    sp_evaluator *evaluator = plate_open(&s, 0.8);
    for (size_t i = 0; i < sizeof angles / sizeof *angles; i++) {
        sp_nozzle_type type = spray_type(SP_PATTERN_SOLID_STREAM, angles[i]);
        double worst = 0, jump = 0;
        for (int place = 0; place < 6; place++) {
            double before = 0;
            for (double height = 0.3; height < 1.2; height *= 1.01) {
                double radius = height * tan(deg(angles[i]) / 2);
                double ratio = covered_from(evaluator, &type, height, place) / (M_PI * radius * radius);
                worst = fmax(worst, fabs(ratio - 1));
                jump = before > 0 ? fmax(jump, fabs(ratio / before - 1)) : jump;
                before = ratio;
            }
        }
        print_message(
            "cone of %g deg, 0.3 to 1.2 m: error at most %.2f %%, from 1 %% of the distance to the next %.2f %%\n",
            angles[i], 100 * worst, 100 * jump);
        assert_true(worst < 0.03 && jump < 0.02);
    }
    sp_evaluator_destroy(evaluator);
    scene_close(&s);
}

/* A fan of half-width w, thin, draws a strip: its thickness times h² ∫ sec³ over its width. */
static void thin_fans(void **state)
{
    (void)state;
    static const double thicknesses[] = {0.2, 0.5, 1, 4};
    const double half = deg(20);
    scene s;
    sp_evaluator *evaluator = plate_open(&s, 1.2);
    for (size_t i = 0; i < sizeof thicknesses / sizeof *thicknesses; i++) {
        sp_nozzle_type type = spray_type(SP_PATTERN_FLAT_FAN, 40);
        type.thickness = deg(thicknesses[i]);
        int place = 0;
        double worst = 0, per_square = type.thickness * (tan(half) / cos(half) + log(tan(half) + 1 / cos(half)));
        for (double height = 0.3; height < 1.3; height *= 1.07) {
            double area = per_square * height * height;
            worst = fmax(worst, fabs(covered_from(evaluator, &type, height, place++) / area - 1));
        }
        print_message("fan of 40 x %g deg, 0.3 to 1.3 m: error at most %.2f %%\n", thicknesses[i], 100 * worst);
        assert_true(worst < 0.03);
    }
    sp_evaluator_destroy(evaluator);
    scene_close(&s);
}

/* Hollow cones however thin keep their rings. */
static void thin_rings(void **state)
{
    (void)state;
    static const double hollows[] = {0.5, 0.9, 0.97, 0.995};
    scene s;
    sp_evaluator *evaluator = plate_open(&s, 0.8);
    for (size_t i = 0; i < sizeof hollows / sizeof *hollows; i++) {
        sp_nozzle_type type = spray_type(SP_PATTERN_HOLLOW_CONE, 30);
        type.hollow = hollows[i];
        int place = 0;
        double worst = 0, outer = tan(deg(15)), inner = tan(hollows[i] * deg(15));
        for (double height = 0.3; height < 1.2; height *= 1.07) {
            double area = M_PI * height * height * (outer * outer - inner * inner);
            worst = fmax(worst, fabs(covered_from(evaluator, &type, height, place++) / area - 1));
        }
        print_message("ring of 30 deg, %g of it hollow, 0.3 to 1.2 m: error at most %.2f %%\n", hollows[i],
                      100 * worst);
        assert_true(worst < 0.03);
    }
    sp_evaluator_destroy(evaluator);
    scene_close(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(discs_from_any_distance),
        cmocka_unit_test(thin_fans),
        cmocka_unit_test(thin_rings),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
