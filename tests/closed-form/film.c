/* The film that runs down walls, against closed forms and a rule of the field. */
#include "../film/walls.h"
#include "measure.h"

#include "spray/rundown.h"

#define LAID 1e-4            /* m/s */
#define LITRES (1e-3 / 60.0) /* m³/s per L/min */

static const region everywhere = {{-9, -9, -9}, {9, 9, 9}, {0, 0, 0}};

/* Of liquid on the upper half of a ball: Γ = q R tan(ϑ/2) there, from 2π R sin ϑ Γ = q 2π R² (1 - cos ϑ). The mean of
 * its relative error, by area, down to the equator. */
static double ball_error(double texel)
{
    walls w;
    walls_open(&w, mesh_of_sphere(1, 5), SP_CAVITY_OUTSIDE, sp_v(0, 0, 0), texel);
    walls_rain(&w, (region){{-9, -9, 0}, {9, 9, 9}, {0, 0, 0}}, LAID);
    assert_ends(&w, 1, 0, 0, 1e-12);
    double sum = 0, area = 0;
    for (size_t i = 0; i < w.cells->count; i++) {
        sp_vec3 p = w.cells->point[i];
        if (p.z < 0)
            continue;
        double expected = LAID * tan(0.5 * acos(p.z / sp_length(p)));
        sum += w.cells->area[i] * fabs(w.per_width[i] / expected - 1);
        area += w.cells->area[i];
    }
    walls_close(&w);
    return sum / area;
}

static void ball(void **state)
{
    (void)state;
    printf("ball %g %g %g\n", ball_error(.04), ball_error(.02), ball_error(.01));
}

static void funnel(void **state)
{
    (void)state;
    for (int k = 0; k < 3; k++) {
    shape s = shape_create();
    shape_part(&s, "funnel");
    const double profile[2][2] = {{0.05, 0}, {0.6, 0.4}};
    shape_turned(&s, profile, 2, 96);
    walls w;
    walls_open(&w, shape_mesh(&s), SP_CAVITY_OUTSIDE, sp_v(0, 0, 0), 0.04 / (1 << k));
    region upper = {{-1, -1, 0.35}, {1, 1, 0.41}, {0, 0, 1}};
    walls_rain(&w, upper, LAID);
    double sum = 0, area = 0, worst = 0, bias = 0;
    for (size_t i = 0; i < w.cells->count; i++) {
        sp_vec3 p = w.cells->point[i];
        double r = hypot(p.x, p.y);
        if (p.z > 0.3 || r < 0.1 || w.cells->normal[i].z < 0)
            continue;
        double e = w.per_width[i] / (w.all / (2 * M_PI * r)) - 1;
        sum += w.cells->area[i] * fabs(e);
        bias += w.cells->area[i] * e;
        worst = fmax(worst, fabs(e));
        area += w.cells->area[i];
    }
    printf("funnel %zu: mean %g bias %g worst %g; left %g\n", w.cells->count, sum / area, bias / area, worst, w.ends.left / w.all);
    walls_close(&w);
    }
}

static void vertical(void **state)
{
    (void)state;
    for (int k = 0; k < 2; k++) {
        shape s = shape_create();
        shape_part(&s, "wall");
        const double profile[2][2] = {{0.5, 1}, {0.5, 0}};
        if (k)
            shape_turned(&s, profile, 2, 64);
        else
            shape_sheet(&s, sp_v(0, 0, 0), sp_v(1.3, 0, 0), sp_v(0, 0, 1), 3);
        walls w;
        double texel = 0.023;
        walls_open(&w, shape_mesh(&s), SP_CAVITY_OUTSIDE, sp_v(0, 0, 0), texel);
        walls_rain(&w, everywhere, LAID);
        double worst = 0;
        size_t n = 0;
        for (size_t i = 0; i < w.cells->count; i++) {
            if (fabs(w.cells->area[i] / (texel * texel) - 1) > 1e-9)
                continue;
            double expected = LAID * (1 - w.cells->point[i].z + 0.5 * texel);
            worst = fmax(worst, fabs(w.per_width[i] / expected - 1));
            n++;
        }
        printf("vertical %d: worst %g of %zu/%zu\n", k, worst, n, w.cells->count);
        walls_close(&w);
    }
}

static double variance_at(const walls *w, double z, double band)
{
    double weight = 0, first = 0, second = 0;
    for (size_t i = 0; i < w->cells->count; i++) {
        sp_vec3 p = w->cells->point[i];
        if (fabs(p.z - z) > band || w->cells->normal[i].y > 0)
            continue;
        double own = w->cells->area[i] * w->per_width[i];
        weight += own;
        first += own * p.x;
        second += own * p.x * p.x;
    }
    return second / weight - first / weight * first / weight;
}

static void spread(void **state)
{
    (void)state;
    for (int k = 0; k < 6; k++) {
        double a = (const double[]){0, 10, 20, 30, 45, 70}[k] * M_PI / 180, h = 0.01;
        shape s = shape_create();
        shape_part(&s, "plate");
        sp_vec3 x = sp_v(1.6 * cos(a), 0, 1.6 * sin(a)), y = sp_v(-1.5 * sin(a), 0, 1.5 * cos(a));
        shape_sheet(&s, sp_scale(sp_add(x, y), -0.5), x, y, 1);
        walls w;
        walls_open(&w, shape_mesh(&s), SP_CAVITY_OUTSIDE, sp_v(0, 0, 0), h);
        walls_rain(&w, (region){{-0.02, -1, 0.38}, {0.02, 1, 0.42}, {0, -1, 0}}, LAID);
        double found = variance_at(&w, -0.4, 0.02) - variance_at(&w, 0.2, 0.02);
        double expected = h * fabs(sin(a) * cos(a)) * (fabs(sin(a)) + fabs(cos(a))) * 0.6;
        printf("spread %g: sigma %g expected %g: %g\n", a * 180 / M_PI, sqrt(fabs(found)), sqrt(expected), sqrt(found / expected) - 1);
        walls_close(&w);
    }
}

#define SEGMENTS 96

/* A vessel of 1.2 m with Klöpper heads (DIN 28011) and an outlet, its front inside. */
static sp_mesh *domed_vessel(void)
{
    const double radius = 0.6, crown = 1.2, knuckle = 0.12, height = 1.46, outlet = 0.05;
    double profile[64][2];
    int count = 0;
    double joint = asin((radius - knuckle) / (crown - knuckle)), sunk = (crown - knuckle) * cos(joint);
    double start = asin(outlet / crown);
    for (int i = 0; i <= 16; i++) {
        double a = start + (joint - start) * i / 16;
        profile[count][0] = crown * sin(a);
        profile[count++][1] = sunk - crown * cos(a);
    }
    for (int i = 1; i <= 12; i++) {
        double a = joint + (M_PI / 2 - joint) * i / 12;
        profile[count][0] = radius - knuckle + knuckle * sin(a);
        profile[count++][1] = -knuckle * cos(a);
    }
    int half = count;
    for (int i = half - 1; i >= 0; i--) {
        profile[count][0] = i ? profile[i][0] : 0;
        profile[count][1] = height - (i ? profile[i][1] : sunk - crown);
        count++;
    }
    shape s = shape_create();
    shape_part(&s, "vessel");
    shape_turned(&s, (const double(*)[2])profile, count, SEGMENTS);
    return shape_mesh(&s);
}

static void rule(double texel, double z, double speed, double fluxc)
{
    walls w;
    sp_error error = {0};
    sp_setup setup = walls_setup(&w, domed_vessel(), SP_CAVITY_POINT, sp_v(0, 0, 0.7), texel);
    setup.criterion = (sp_criterion){.flux = fluxc * LITRES, .impact_speed = speed, .incidence = deg(85), .film = 10 * LITRES};
    w.evaluator = sp_evaluator_create(&setup, &error);
    assert_no_error(&error);
    const sp_nozzle_type up = {.name = "up", .pattern = SP_PATTERN_FULL_CONE, .angle = M_PI, .flow = 25 * 2 * M_PI * 0.6 * LITRES, .at = 2e5, .exponent = 0.5, .cv = 0.95};
    sp_nozzle nozzle = {.type = &up, .position = sp_v(0, 0, z), .axis = sp_v(0, 0, 1), .pressure = 2e5};
    sp_layout *layout = sp_layout_create(&nozzle, 1, &error);
    sp_coverage *c = sp_evaluate_inverse(w.evaluator, layout, &error);
    assert_no_error(&error);
    const sp_patches *cells = &w.evaluator->patches;
    double least = INFINITY, mean = 0, area = 0, above[3] = {0};
    for (size_t i = 0; i < cells->count; i++) {
        if (cells->point[i].z < 0 || cells->point[i].z > 1.46) continue;
        double f = c->deposits.film[i] / LITRES;
        least = fmin(least, f); mean += f * cells->area[i]; area += cells->area[i];
    }
    for (size_t i = 0; i < cells->count; i++) {
        double f = c->deposits.film[i] / LITRES;
        for (int k = 0; k < 3; k++)
            above[k] += (f >= (const double[]){10,25,30}[k] ? cells->area[i] : 0) / cells->total_area;
    }
    printf("vessel %g z %g: %zu cells, area %.3f, hit %.2f %%, hit or film %.2f %%; shell mean %g least %g; film >=10 %.3f 25 %.3f 30 %.3f; arriving %g of %g left %g held %g astray %g outline %g\n", texel, z, cells->count, c->area, 100 * (c->covered_area - c->film.area) / c->area,
        100 * c->fraction, mean / area, least, above[0], above[1], above[2], c->film.arriving / LITRES, c->flow / LITRES, c->film.left / LITRES, c->film.held / LITRES, c->film.astray / LITRES, c->film.per_outline / LITRES);
    sp_coverage_destroy(c);
    sp_layout_destroy(layout);
    walls_close(&w);
}

static void field_rule(void **state)
{
    (void)state;
    rule(.02, 1.40, 1, 1);
    rule(.02, 1.36, 1, 1);
    rule(.02, 1.46, 1, 1);
    rule(.02, 1.46 + .1, 1, 1);
    rule(.02, 1, 1, 1);
    rule(.01, 1.40, 1, 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ball),
        cmocka_unit_test(funnel),
        cmocka_unit_test(vertical),
        cmocka_unit_test(spread),
        cmocka_unit_test(field_rule),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
