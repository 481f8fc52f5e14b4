#include "falling_film.h"

#include "stream_spread.h"
#include "film/laminar.h"
#include "mesh/diagnosis/flaw.h"
#include "nozzle/pattern.h"
#include "resolution.h"

#include <stdlib.h>
#include <string.h>

#define CELLS_MOST 30000.0 /* film varies over lengths far above a texel's: 80 mm instead of 5 change .4 points */
#define SPECK 0.1          /* of a cell: less is the sliver of one */

/* The evaluator of all wet sides, with nothing asked for. */
static sp_evaluator *create_walls(const sp_evaluator *evaluator, sp_error *error)
{
    sp_evaluator *walls = sp_evaluator_share(evaluator, evaluator->fidelity.texel, error);
    if (!walls)
        return NULL;
    walls->everything = true;
    walls->fidelity.texel = fmax(walls->fidelity.texel, sp_texel_of(walls, CELLS_MOST));
    walls->setup.criterion = (sp_criterion){.incidence = M_PI / 2};
    walls->fidelity.method = SP_METHOD_INVERSE;
    walls->fidelity.reflections = 0;
    walls->fidelity.splat = SP_SPLAT_NEAREST;
    if (sp_texels_create(walls, NULL, error))
        return walls;
    sp_evaluator_destroy(walls);
    return NULL;
}

static void find_cells(const sp_evaluator *evaluator, sp_falling_film *falling_film)
{
    const sp_patches *patches = &evaluator->patches;
    for (size_t i = 0; i < patches->count; i++) {
        uint32_t triangle = patches->triangle[i];
        double u, v;
        sp_triangle_weights(evaluator->setup.mesh, triangle, patches->point[i], &u, &v);
        falling_film->cell[i] = falling_film->walls->texel_patch[sp_atlas_texel(falling_film->walls->atlas, triangle, u,
                                                                                v)][patches->side[i] == SP_SIDE_BACK];
    }
}

static int by_place(const void *left, const void *right)
{
    const double *a = left, *b = right;
    return a[0] != b[0] ? (a[0] > b[0]) - (a[0] < b[0]) : (a[1] > b[1]) - (a[1] < b[1]);
}

/* Takes points off the end of a hull as long as `next` makes them hollow. */
static size_t shave(double (*hull)[2], size_t count, size_t least, const double next[2])
{
    while (count >= least + 2) {
        const double *a = hull[count - 2], *b = hull[count - 1];
        if ((b[0] - a[0]) * (next[1] - a[1]) - (b[1] - a[1]) * (next[0] - a[0]) > 0)
            break;
        count--;
    }
    return count;
}

/* The length of the convex hull of points in a plane, sorted (monotone chain). hull: [2 count + 1] */
static double hull_length(const double (*at)[2], size_t count, double (*hull)[2])
{
    size_t found = 0;
    for (size_t i = 0; i < count; i++) {
        found = shave(hull, found, 0, at[i]);
        memcpy(hull[found++], at[i], sizeof *hull);
    }
    size_t lower = found ? found - 1 : 0;
    for (size_t i = count; i-- > 1;) {
        found = shave(hull, found, lower, at[i - 1]);
        memcpy(hull[found++], at[i - 1], sizeof *hull);
    }
    double length = 0;
    for (size_t i = 1; i < found; i++)
        length += hypot(hull[i][0] - hull[i - 1][0], hull[i][1] - hull[i - 1][1]);
    return length;
}

/* Around all walls, seen from above. */
static bool measure_girth(const sp_evaluator *walls, double *girth)
{
    const sp_patches *cells = &walls->patches;
    sp_vec3 up = sp_unit(walls->setup.up), x = sp_unit(sp_cross(up, sp_v(up.z, up.x, up.y))), y = sp_cross(up, x);
    double(*at)[2] = malloc((cells->count + 1) * sizeof *at),
    (*hull)[2] = malloc((2 * cells->count + 1) * sizeof *hull);
    for (size_t i = 0; at && i < cells->count; i++) {
        at[i][0] = sp_dot(cells->point[i], x);
        at[i][1] = sp_dot(cells->point[i], y);
    }
    bool done = at && hull;
    if (done) {
        qsort(at, cells->count, sizeof *at, by_place);
        *girth = hull_length((const double(*)[2])at, cells->count, hull);
    }
    free(at);
    free(hull);
    return done;
}

static bool goes_before(const sp_hollow *a, const sp_hollow *b)
{
    return a->drains != b->drains ? b->drains : a->area > b->area;
}

/* The worst of all pools, without specks that hold nothing. */
static void list_hollows(sp_falling_film *falling_film)
{
    double texel = falling_film->walls->fidelity.texel, speck = SPECK * texel * texel;
    size_t count, *kept = &falling_film->hollow_count;
    const sp_film_pool *pools = sp_film_pools(falling_film->film, &count);
    for (size_t i = 0; i < count; i++) {
        sp_hollow hollow = {falling_film->walls->patches.point[pools[i].lowest], pools[i].area, pools[i].drains};
        size_t at = *kept;
        while (at > 0 && goes_before(&hollow, &falling_film->hollows[at - 1]))
            at--;
        if (at == SP_HOLLOWS || (hollow.drains && hollow.area < speck))
            continue;
        *kept += *kept < SP_HOLLOWS;
        memmove(&falling_film->hollows[at + 1], &falling_film->hollows[at], (*kept - at - 1) * sizeof hollow);
        falling_film->hollows[at] = hollow;
    }
}

/* Where film may be lost. */
static bool find_cracks(const sp_mesh *mesh, sp_mesh_diagnosis *flaws, sp_error *error)
{
    sp_half_edges edges = {0};
    flaws->crack = SP_CRACK * sp_mesh_box(mesh, &flaws->minimum, &flaws->maximum);
    bool done = sp_half_edges_create(mesh, &edges, error) && sp_diagnose_cracks(mesh, &edges, flaws, error);
    sp_half_edges_destroy(&edges);
    return done;
}

bool sp_falling_film_create(sp_evaluator *evaluator, sp_error *error)
{
    if (!(evaluator->setup.criterion.film > 0))
        return true;
    sp_falling_film *falling_film = evaluator->falling_film = calloc(1, sizeof *falling_film);
    if (!falling_film)
        return sp_fail_memory(error);
    falling_film->cell = malloc((evaluator->patches.count + 1) * sizeof *falling_film->cell);
    if (!falling_film->cell)
        return sp_fail_memory(error);
    falling_film->walls = evaluator->everything ? evaluator : create_walls(evaluator, error);
    if (!falling_film->walls)
        return false;
    const sp_evaluator *walls = falling_film->walls;
    if (!sp_evaluator_stage(evaluator, "film", 0, error))
        return false;
    falling_film->film =
        sp_film_create(&(sp_film_surface){.mesh = walls->setup.mesh,
                                          .atlas = walls->atlas,
                                          .tracer = walls->tracer,
                                          .cells = &walls->patches,
                                          .cell_of = (const uint32_t(*)[2])walls->texel_patch,
                                          .down = sp_scale(sp_unit(walls->setup.up), -1),
                                          .wave = sp_film_wave(&walls->setup.liquid, walls->setup.gravity)},
                       error);
    if (!falling_film->film)
        return false;
    find_cells(evaluator, falling_film);
    list_hollows(falling_film);
    return (measure_girth(walls, &falling_film->girth) || sp_fail_memory(error)) &&
           (evaluator->everything || find_cracks(walls->setup.mesh, &falling_film->flaws, error));
}

void sp_falling_film_destroy(sp_evaluator *evaluator)
{
    sp_falling_film *falling_film = evaluator->falling_film;
    if (!falling_film)
        return;
    if (falling_film->walls != evaluator)
        sp_evaluator_destroy(falling_film->walls);
    sp_film_destroy(falling_film->film);
    free(falling_film->cell);
    free(falling_film);
}

/* Of the layout the nozzles that are solid streams, or those that are not. */
static sp_layout *part_of_layout(const sp_layout *layout, bool streams, sp_error *error)
{
    sp_layout *part = sp_layout_create(layout->nozzles, layout->count, error);
    for (size_t i = part ? part->count : 0; i-- > 0;)
        if (sp_type_is_stream(part->nozzles[i].type) != streams)
            part->nozzles[i] = part->nozzles[--part->count];
    return part;
}

/* What arrives (m³/s) on every cell. */
static bool add_hits(const sp_evaluator *walls, const sp_layout *layout, double *hits, sp_error *error)
{
    sp_coverage *hit = sp_evaluate_inverse(walls, layout, error);
    for (size_t i = 0; hit && i < walls->patches.count; i++)
        hits[i] = hit->deposits.flux[i] * walls->patches.area[i];
    sp_coverage_destroy(hit);
    return hit;
}

/* The same of solid streams, each spread over its disc. */
static bool add_streams(const sp_evaluator *walls, const sp_layout *streams, double *arriving, sp_error *error)
{
    const sp_fluid *liquid = &walls->setup.liquid;
    sp_stream_spread discs;
    double *hits = malloc((walls->patches.count + 1) * sizeof *hits);
    bool done = sp_stream_spread_create(&walls->patches, &discs, error) && (hits || sp_fail_memory(error));
    for (size_t i = 0; done && i < streams->count; i++) {
        sp_layout one = {.count = 1, .nozzles = &streams->nozzles[i]};
        done = add_hits(walls, &one, hits, error);
        if (done)
            sp_stream_spread_add(&discs, liquid, sp_nozzle_flow(one.nozzles, liquid), hits, arriving);
    }
    sp_stream_spread_free(&discs);
    free(hits);
    return done;
}

/* What comes to every cell (m³/s) before it runs down. */
static bool find_arriving(const sp_falling_film *falling_film, const sp_layout *layout, double *arriving,
                          sp_error *error)
{
    sp_evaluator walls = *falling_film->walls; /* as the liquid hits them, before it runs down */
    walls.falling_film = NULL;
    walls.stage = walls.stage ? walls.stage : "film";
    sp_layout *streams = part_of_layout(layout, true, error);
    sp_layout *sprays = streams ? part_of_layout(layout, false, error) : NULL;
    bool done = sprays && add_hits(&walls, sprays, arriving, error) &&
                (!streams->count || add_streams(&walls, streams, arriving, error));
    sp_layout_destroy(sprays);
    sp_layout_destroy(streams);
    return done;
}

bool sp_falling_film_find(const sp_falling_film *falling_film, const sp_layout *layout, sp_coverage *coverage,
                          sp_error *error)
{
    size_t count = falling_film->walls->patches.count;
    double *flow = malloc((count + 1) * sizeof *flow), *film = malloc((count + 1) * sizeof *film);
    sp_film_balance *balance = &coverage->film;
    sp_film_ends ends = {0};
    *balance = (sp_film_balance){.known = true};
    bool done = ((flow && film) || sp_fail_memory(error)) && find_arriving(falling_film, layout, flow, error) &&
                sp_film_run(falling_film->film, flow, film, &ends, error);
    for (size_t i = 0; done && i < count; i++)
        balance->arriving += flow[i];
    for (size_t i = 0; done && i < coverage->deposits.count; i++)
        coverage->deposits.film[i] = falling_film->cell[i] == SP_NONE ? 0 : film[falling_film->cell[i]];
    balance->left = ends.left;
    balance->astray = ends.astray;
    balance->held = ends.held;
    balance->per_girth = falling_film->girth > 0 ? balance->arriving / falling_film->girth : 0;
    free(flow);
    free(film);
    return done;
}
