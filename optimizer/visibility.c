#include "visibility.h"

#include <stdlib.h>

#define PATCHES_MOST 20000.0
#define PATCHES_LEAST 500.0
#define RAYS_MOST 1e8 /* patches times views */
#define MEMORY 1e9    /* bytes, for all views, where the options do not say */
#define ARRIVAL_BYTES 20.0
#define COARSER 1.1    /* patches fewer than what should fit, where a first attempt did not */
#define BATCH 16       /* sites traced between two looks at clock and memory */
#define TIME_SHARE 0.5 /* of a time limit, that tracing may take */

/* The octahedron unfolded onto [-1, 1]²: Cigolle et al., A survey of efficient representations for independent unit
 * vectors, JCGT 2014. */
static void encode(sp_vec3 d, double *u, double *v)
{
    double scale = 1 / (fabs(d.x) + fabs(d.y) + fabs(d.z));
    *u = d.x * scale;
    *v = d.y * scale;
    if (d.z < 0) {
        double x = *u, y = *v;
        *u = copysign(1 - fabs(y), x);
        *v = copysign(1 - fabs(x), y);
    }
}

static sp_vec3 decode(double u, double v)
{
    double z = 1 - fabs(u) - fabs(v);
    if (z >= 0)
        return sp_unit(sp_v(u, v, z));
    return sp_unit(sp_v(copysign(1 - fabs(v), u), copysign(1 - fabs(u), v), z));
}

static size_t bin_of(sp_vec3 direction)
{
    double u, v;
    encode(direction, &u, &v);
    int i = (int)((u + 1) * (0.5 * SP_BINS_EDGE)), j = (int)((v + 1) * (0.5 * SP_BINS_EDGE));
    i = i < 0 ? 0 : i >= SP_BINS_EDGE ? SP_BINS_EDGE - 1 : i;
    j = j < 0 ? 0 : j >= SP_BINS_EDGE ? SP_BINS_EDGE - 1 : j;
    return (size_t)(j * SP_BINS_EDGE + i);
}

static void bins_create(sp_bins *bins)
{
    const double edge = 2.0 / SP_BINS_EDGE;
    for (size_t b = 0; b < SP_BINS; b++) {
        double u = (double)(b % SP_BINS_EDGE) * edge - 1, v = (double)(b / SP_BINS_EDGE) * edge - 1;
        sp_vec3 centre = decode(u + 0.5 * edge, v + 0.5 * edge);
        double cosine = 1;
        /* A cell's sides are arcs of great circles, so that its corners lie farthest out. */
        for (int corner = 0; corner < 4; corner++)
            cosine = fmin(cosine, sp_dot(centre, decode(u + edge * (corner & 1), v + edge * (corner >> 1))));
        bins->x[b] = (float)centre.x;
        bins->y[b] = (float)centre.y;
        bins->z[b] = (float)centre.z;
        bins->radius[b] = (float)(acos(cosine) + 1e-3);
    }
}

static double memory_of(const sp_place_options *options)
{
    return options->memory > 0 ? options->memory : MEMORY;
}

double sp_visibility_needed(const sp_place_options *options, const sp_candidates *candidates, const sp_site *site,
                            size_t speed)
{
    double reach = -1;
    for (size_t k = 0; k < candidates->make_count; k++)
        if (candidates->makes[k].speed_class == speed && sp_candidates_axes(candidates, site->mount, k)->count)
            reach = fmax(reach, candidates->makes[k].reach);
    return reach < 0 ? reach : fmin(M_PI, reach + options->mounts[site->mount].tilt + 1e-6);
}

static size_t view_bytes(size_t count)
{
    return (SP_BINS + 1 + count) * sizeof(uint32_t) + 4 * (count + SP_LANES) * sizeof(float);
}

static bool view_allocate(sp_view *view, size_t count)
{
    /* one block: the bins' starts first, then the arrays */
    size_t padded = count + SP_LANES;
    char *block = malloc(view_bytes(count));
    if (!block)
        return false;
    view->count = (uint32_t)count;
    view->start = (uint32_t *)block;
    view->patch = view->start + SP_BINS + 1;
    float *columns = (float *)(view->patch + count), **column[] = {&view->x, &view->y, &view->z, &view->transfer};
    for (size_t i = 0; i < 4; i++) {
        *column[i] = columns + i * padded;
        for (size_t k = count; k < padded; k++)
            (*column[i])[k] = 0;
    }
    return true;
}

static bool view_create(const sp_reach *reach, sp_view *view)
{
    size_t passing = 0;
    for (size_t i = 0; i < reach->count; i++)
        passing += reach->arrivals[i].passes;
    if (!view_allocate(view, passing))
        return false;
    uint32_t *start = view->start;
    for (size_t b = 0; b <= SP_BINS; b++)
        start[b] = 0;
    for (size_t i = 0; i < reach->count; i++)
        if (reach->arrivals[i].passes)
            start[bin_of(reach->arrivals[i].direction) + 1]++;
    for (size_t b = 0; b < SP_BINS; b++)
        start[b + 1] += start[b];
    uint32_t next[SP_BINS];
    for (size_t b = 0; b < SP_BINS; b++)
        next[b] = start[b];
    for (size_t i = 0; i < reach->count; i++) {
        const sp_arrival *arrival = &reach->arrivals[i];
        if (!arrival->passes)
            continue;
        uint32_t at = next[bin_of(arrival->direction)]++;
        view->x[at] = (float)arrival->direction.x;
        view->y[at] = (float)arrival->direction.y;
        view->z[at] = (float)arrival->direction.z;
        view->transfer[at] = (float)arrival->transfer;
        view->patch[at] = arrival->patch;
    }
    return true;
}

static bool site_trace(const sp_place_options *options, const sp_site *site, const sp_candidates *candidates,
                       const sp_evaluator *coarse, sp_view *views, sp_error *error)
{
    for (size_t s = 0; s < candidates->speed_count; s++) {
        double half_angle = sp_visibility_needed(options, candidates, site, s);
        if (half_angle < 0)
            continue;
        sp_reach *reach =
            sp_evaluator_reach_passing(coarse, site->position, candidates->speeds[s], site->axis, half_angle, error);
        if (!reach)
            return false;
        bool done = view_create(reach, &views[s]);
        sp_reach_destroy(reach);
        if (!done)
            return sp_fail_memory(error);
    }
    return true;
}

/* Site `i` of the order in which to trace: strided, so that a run that ends early has seen something of every mount. */
static size_t strided(size_t i, size_t count)
{
    size_t stride = (size_t)(0.6180339887 * (double)count) | 1;
    for (;; stride += 2) {
        size_t a = stride, b = count;
        while (b) {
            size_t r = a % b;
            a = b;
            b = r;
        }
        if (a == 1)
            return i * stride % count;
    }
}

static void views_free(sp_visibility *visibility)
{
    for (size_t i = 0; visibility->views && i < visibility->site_count * visibility->speed_count; i++)
        free(visibility->views[i].start);
    free(visibility->views);
    visibility->views = NULL;
}

/* The sites first to end of the strided order; their bytes are added up. */
static bool trace_batch(const sp_place_options *options, const sp_sites *sites, const sp_candidates *candidates,
                        size_t first, size_t end, sp_visibility *visibility, double *bytes, sp_error *error)
{
    sp_error failure = {0};
    int threads = sp_threads(&options->run);
#pragma omp parallel for num_threads(threads) schedule(dynamic, 1)
    for (size_t i = first; i < end; i++) {
        size_t site = strided(i, sites->count);
        sp_error mine = {0};
        if (!site_trace(options, &sites->items[site], candidates, visibility->evaluator,
                        &visibility->views[site * candidates->speed_count], &mine)) {
#pragma omp critical(sp_visibility_failure)
            failure = mine;
        }
    }
    for (size_t i = first; i < end; i++)
        for (size_t s = 0; s < candidates->speed_count; s++) {
            const sp_view *view = &visibility->views[strided(i, sites->count) * candidates->speed_count + s];
            *bytes += view->start ? (double)view_bytes(view->count) : 0;
            visibility->largest = view->count > visibility->largest ? view->count : visibility->largest;
        }
    if (failure.kind == SP_OK)
        return true;
    return sp_fail(error, failure.kind, failure.file, failure.line, failure.column, "%s", failure.message);
}

bool sp_visibility_create(const sp_evaluator *coarse, const sp_place_options *options, const sp_sites *sites,
                          const sp_candidates *candidates, sp_watch *watch, sp_visibility *visibility, sp_error *error)
{
    *visibility =
        (sp_visibility){.evaluator = coarse, .site_count = sites->count, .speed_count = candidates->speed_count};
    bins_create(&visibility->bins);
    visibility->views = calloc(sites->count, candidates->speed_count * sizeof *visibility->views);
    bool done = visibility->views || sp_fail_memory(error);
    double bytes = 0;
    for (size_t first = 0; done && visibility->share <= 1 && first < sites->count; first += BATCH) {
        /* out of time the first batch is traced all the same, so that there is something to choose from */
        if (!sp_watch_goes_on(watch, "visibility", (double)first / (double)sites->count) && (first || watch->cancelled))
            break;
        if (first && options->run.time_limit > 0 && sp_watch_elapsed(watch) > TIME_SHARE * options->run.time_limit) {
            watch->interrupted = true;
            break;
        }
        size_t end = first + BATCH < sites->count ? first + BATCH : sites->count;
        done = trace_batch(options, sites, candidates, first, end, visibility, &bytes, error);
        visibility->share = bytes / memory_of(options);
        if (visibility->share > 1) /* what all would take */
            visibility->share *= (double)sites->count / (double)end;
    }
    if (!done)
        sp_visibility_free(visibility);
    else if (visibility->share > 1)
        views_free(visibility);
    return done;
}

bool sp_visibility_fit(const sp_evaluator *fine, const sp_place_options *options, const sp_sites *sites,
                       const sp_candidates *candidates, sp_watch *watch, sp_evaluator **resampled,
                       sp_visibility *visibility, sp_error *error)
{
    double area = sp_evaluator_patches(fine)->total_area, memory = memory_of(options);
    double views = (double)sites->count * (double)candidates->speed_count;
    double patches = fmin(PATCHES_MOST, fmin(RAYS_MOST, memory / ARRIVAL_BYTES) / views);
    for (*resampled = NULL;;) {
        patches = fmax(PATCHES_LEAST, patches);
        double texel = sqrt(area / patches);
        if (texel > 1.1 * sp_evaluator_fidelity(fine)->texel) {
            *resampled = sp_evaluator_resample(fine, texel, error);
            if (!*resampled)
                return false;
        }
        if (!sp_visibility_create(*resampled ? *resampled : fine, options, sites, candidates, watch, visibility, error))
            return false;
        if (visibility->share <= 1)
            return true;
        double share = visibility->share;
        sp_visibility_free(visibility);
        sp_evaluator_destroy(*resampled);
        *resampled = NULL;
        if (patches <= PATCHES_LEAST)
            return sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0,
                           "memory: %g bytes found, expected about %.2g or more for what %zu mounting points reach",
                           memory, share * memory, sites->count);
        patches = fmin(patches, (double)sp_evaluator_patches(fine)->count) / (COARSER * share);
    }
}

void sp_visibility_free(sp_visibility *visibility)
{
    views_free(visibility);
    *visibility = (sp_visibility){0};
}
