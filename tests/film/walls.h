/* Walls put together by hand, and the film on them from liquid that the test itself lays on. */
#ifndef TESTS_FILM_WALLS_H
#define TESTS_FILM_WALLS_H

#include "../spray/shapes.h"

#include "film/film.h"
#include "film/laminar.h"
#include "spray/state/state.h"

typedef struct {
    sp_mesh *mesh;
    sp_surface surfaces[SHAPE_PARTS + 1];
    sp_evaluator *evaluator;
    const sp_patches *cells;
    sp_film *film;
    double *arriving, *per_width;
    sp_film_ends ends;
    double all; /* m³/s, that arrives */
} walls;

static inline sp_setup walls_setup(walls *w, sp_mesh *mesh, sp_cavity_kind cavity, sp_vec3 point, double texel)
{
    *w = (walls){.mesh = mesh};
    for (size_t i = 0; i <= SHAPE_PARTS; i++)
        w->surfaces[i] = (sp_surface){.clean = true, .rebound = 1};
    sp_setup setup = sp_setup_default();
    setup.mesh = mesh;
    setup.surfaces = w->surfaces;
    setup.cavity = cavity;
    setup.cavity_point = point;
    setup.up = sp_v(0, 0, 1);
    setup.gravity = 9.81;
    setup.fidelity.texel = texel;
    setup.fidelity.method = SP_METHOD_INVERSE;
    return setup;
}

/* The film on the evaluator's own patches, however many. */
static inline void walls_start(walls *w, const sp_setup *setup)
{
    sp_error error = {0};
    w->evaluator = sp_evaluator_create(setup, &error);
    assert_string_equal(error.message, "");
    const sp_evaluator *e = w->evaluator;
    w->cells = &e->patches;
    w->film = sp_film_create(&(sp_film_surface){.mesh = w->mesh,
                                                .atlas = e->atlas,
                                                .tracer = e->tracer,
                                                .cells = w->cells,
                                                .cell_of = (const uint32_t(*)[2])e->texel_patch,
                                                .down = sp_v(0, 0, -1),
                                                .wave = sp_film_wave(&setup->liquid, setup->gravity)},
                             &error);
    assert_string_equal(error.message, "");
    assert_non_null(w->film);
    w->arriving = calloc(w->cells->count + 1, sizeof(double));
    w->per_width = calloc(w->cells->count + 1, sizeof(double));
    assert_true(w->arriving && w->per_width);
}

static inline void walls_open(walls *w, sp_mesh *mesh, sp_cavity_kind cavity, sp_vec3 point, double texel)
{
    sp_setup setup = walls_setup(w, mesh, cavity, point, texel);
    walls_start(w, &setup);
}

static inline void walls_close(walls *w)
{
    sp_film_destroy(w->film);
    sp_evaluator_destroy(w->evaluator);
    sp_mesh_destroy(w->mesh);
    free(w->arriving);
    free(w->per_width);
}

/* What lies in a box and faces more or less along `normal` (zero: whichever way). */
typedef struct {
    sp_vec3 low, high, normal;
} region;

static inline bool region_holds(const region *r, const walls *w, size_t cell)
{
    sp_vec3 p = w->cells->point[cell];
    return p.x >= r->low.x && p.x <= r->high.x && p.y >= r->low.y && p.y <= r->high.y && p.z >= r->low.z &&
           p.z <= r->high.z && sp_dot(w->cells->normal[cell], r->normal) >= 0.5 * sp_dot(r->normal, r->normal);
}

/* Lays `per_area` (m/s) on all cells of a region, and nothing elsewhere; then lets it run. */
static inline void walls_rain(walls *w, region where, double per_area)
{
    sp_error error = {0};
    w->all = 0;
    for (size_t i = 0; i < w->cells->count; i++) {
        w->arriving[i] = region_holds(&where, w, i) ? per_area * w->cells->area[i] : 0;
        w->all += w->arriving[i];
    }
    assert_true(w->all > 0);
    assert_true(sp_film_run(w->film, w->arriving, w->per_width, &w->ends, &error));
    double sum = w->ends.left + w->ends.astray + w->ends.held;
    if (!(fabs(sum - w->all) <= 1e-12 * w->all))
        fail_msg("%.17g arrives, %.17g ends", w->all, sum);
    for (size_t i = 0; i < w->cells->count; i++)
        assert_true(w->per_width[i] >= 0 && isfinite(w->per_width[i]));
}

/* Where all ends, as shares of what arrives. */
static inline void assert_ends(const walls *w, double left, double astray, double held, double within)
{
    sp_film_ends share = {w->ends.left / w->all, w->ends.astray / w->all, w->ends.held / w->all};
    if (!(fabs(share.left - left) <= within && fabs(share.astray - astray) <= within &&
          fabs(share.held - held) <= within))
        fail_msg("left %g, astray %g, held %g; expected %g, %g, %g", share.left, share.astray, share.held, left, astray,
                 held);
}

/* Of the region's area, what any film is on. */
static inline double wet_share(const walls *w, region where)
{
    double area = 0, wet = 0;
    for (size_t i = 0; i < w->cells->count; i++)
        if (region_holds(&where, w, i)) {
            area += w->cells->area[i];
            wet += w->per_width[i] > 0 ? w->cells->area[i] : 0;
        }
    assert_true(area > 0);
    return wet / area;
}

/* The mean flow per width on a region, m²/s. */
static inline double mean_film(const walls *w, region where)
{
    double area = 0, sum = 0;
    for (size_t i = 0; i < w->cells->count; i++)
        if (region_holds(&where, w, i)) {
            area += w->cells->area[i];
            sum += w->per_width[i] * w->cells->area[i];
        }
    assert_true(area > 0);
    return sum / area;
}

static inline void assert_near(const char *what, double found, double expected, double within)
{
    if (!(fabs(found - expected) <= within * fabs(expected)))
        fail_msg("%s: %g found, %g expected", what, found, expected);
}

#endif
