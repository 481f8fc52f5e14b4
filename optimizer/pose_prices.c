#include "pose_prices.h"

#include "scoring.h"

#include <omp.h>
#include <stdlib.h>
#include <string.h>

#define EDGE 2e-6          /* how far off single precision may see a pattern's edge (cosine, sine) */
#define BIN_EDGE 1e-4      /* rad, the same for bins */
#define UPWARDS (1 + 4e-6) /* more than the rounding of a price in single precision */
#define ROWS_AT_A_TIME 300

/* The pose of highest price of a site and make. */
typedef struct {
    sp_pose pose;
    double price;
} best;

/* One thread's own. */
typedef struct {
    float *worth;          /* [arrivals of a view], price that it brings to a make */
    double total[SP_BINS]; /* of worth */
    uint32_t list[SP_BINS];
    size_t listed;            /* bins of any worth */
    float beyond[SP_BINS];    /* by bin: cosine of the angle at and beyond which the make misses all of it */
    float within[SP_BINS][2]; /* cosines between which it holds all of it; the first above 1: never */
    uint8_t *seen;            /* [texels] */
} scratch;

struct sp_pose_prices {
    const sp_search *search;
    const sp_cover *cover;
    const uint32_t *tier_of;
    const float *need;
    const size_t *ports;
    uint8_t **twice; /* [views], NULL or [arrivals]: whether the view's other arc reaches the texel too */
    size_t most;     /* arrivals of a view */
    best *bests;     /* [sites x makes] */
    int threads;
    scratch *scratches; /* [threads] */
    float *field;       /* [texels] */
    uint32_t *texels;
    float *shares;
};

static bool find_twice(sp_pose_prices *prices, size_t at)
{
    const sp_view *view = &prices->search->visibility->views[at];
    uint8_t *seen = prices->scratches[0].seen;
    if (!view->start)
        return true;
    bool any = false;
    for (uint32_t i = 0; i < view->count; i++)
        any |= ++seen[view->patch[i]] > 1;
    if (any && !(prices->twice[at] = malloc(view->count)))
        return false;
    for (uint32_t i = 0; any && i < view->count; i++)
        prices->twice[at][i] = seen[view->patch[i]] > 1;
    for (uint32_t i = 0; i < view->count; i++)
        seen[view->patch[i]] = 0;
    return true;
}

static bool allocate(sp_pose_prices *prices)
{
    const sp_search *search = prices->search;
    size_t views = search->sites->count * search->candidates->speed_count, texels = search->patch_count + 1;
    for (size_t i = 0; i < views; i++)
        if (search->visibility->views[i].start && search->visibility->views[i].count > prices->most)
            prices->most = search->visibility->views[i].count;
    prices->twice = calloc(views + 1, sizeof *prices->twice);
    prices->bests = calloc(search->sites->count + 1, search->candidates->make_count * sizeof *prices->bests);
    prices->scratches = calloc((size_t)prices->threads, sizeof *prices->scratches);
    prices->field = malloc(texels * sizeof *prices->field);
    prices->texels = malloc(texels * sizeof *prices->texels);
    prices->shares = malloc(texels * sizeof *prices->shares);
    if (!prices->twice || !prices->bests || !prices->scratches || !prices->field || !prices->texels || !prices->shares)
        return false;
    for (int i = 0; i < prices->threads; i++) {
        prices->scratches[i].worth = malloc((prices->most + 1) * sizeof *prices->scratches[i].worth);
        prices->scratches[i].seen = calloc(texels, 1);
        if (!prices->scratches[i].worth || !prices->scratches[i].seen)
            return false;
    }
    for (size_t i = 0; i < views; i++)
        if (!find_twice(prices, i))
            return false;
    return true;
}

sp_pose_prices *sp_pose_prices_create(const sp_search *search, const sp_cover *cover, const uint32_t *tier_of,
                                      const float *need, const size_t *ports, sp_error *error)
{
    sp_pose_prices *prices = malloc(sizeof *prices);
    if (!prices)
        return sp_fail_memory(error);
    *prices = (sp_pose_prices){.search = search,
                               .cover = cover,
                               .tier_of = tier_of,
                               .need = need,
                               .ports = ports,
                               .threads = sp_threads(&search->options->run)};
    if (allocate(prices))
        return prices;
    sp_pose_prices_destroy(prices);
    return sp_fail_memory(error);
}

void sp_pose_prices_destroy(sp_pose_prices *prices)
{
    if (!prices)
        return;
    size_t views = prices->search->sites->count * prices->search->candidates->speed_count;
    for (size_t i = 0; prices->twice && i < views; i++)
        free(prices->twice[i]);
    for (int i = 0; prices->scratches && i < prices->threads; i++) {
        free(prices->scratches[i].worth);
        free(prices->scratches[i].seen);
    }
    free(prices->twice);
    free(prices->bests);
    free(prices->scratches);
    free(prices->field);
    free(prices->texels);
    free(prices->shares);
    free(prices);
}

/* The share of what a texel needs that a flux brings, rounded upwards. */
static inline float share_of(const sp_pose_prices *prices, uint32_t texel, float flux, bool twice)
{
    float ratio = flux / prices->need[texel] * (float)(1 + SP_FIELD_MARGIN);
    if (ratio >= 1)
        return 1;
    if (!(ratio > 0))
        return 0;
    /* two arcs of one nozzle add up, even where one nozzle alone must do */
    return prices->search->single && !twice ? 0 : ratio;
}

/* What each arrival of a view brings to a make, and each bin in all. */
static void prepare_worth(const sp_pose_prices *prices, scratch *own, size_t at, const sp_make *make, const float *u)
{
    const sp_view *view = &prices->search->visibility->views[at];
    const uint8_t *twice = prices->twice[at];
    double threshold = prices->search->threshold;
    float strength = threshold > 0 ? (float)(make->flow / (make->spray.solid_angle * threshold)) : INFINITY;
    own->listed = 0;
    for (uint32_t b = 0; b < SP_BINS; b++) {
        double total = 0;
        for (uint32_t i = view->start[b]; i < view->start[b + 1]; i++) {
            uint32_t texel = view->patch[i];
            own->worth[i] =
                u[texel] > 0 ? u[texel] * share_of(prices, texel, strength * view->transfer[i], twice && twice[i]) : 0;
            total += (double)own->worth[i];
        }
        own->total[b] = total;
        if (total > 0)
            own->list[own->listed++] = b;
    }
}

static void prepare_bins(const sp_pose_prices *prices, scratch *own, const sp_make *make)
{
    const sp_bins *bins = &prices->search->visibility->bins;
    bool cone = make->spray.kind != SP_PATTERN_FLAT_FAN;
    for (size_t i = 0; i < own->listed; i++) {
        size_t b = own->list[i];
        double radius = (double)bins->radius[b] + BIN_EDGE, outer = make->reach + radius;
        own->beyond[b] = outer >= M_PI ? -2 : (float)cos(outer);
        outer = make->spray.outer - radius;
        double inner = make->spray.inner > 0 ? make->spray.inner + radius : -1;
        bool holds = cone && outer > 0 && outer > inner;
        own->within[b][0] = !holds ? 2 : make->spray.outer >= M_PI ? -2 : (float)cos(outer);
        own->within[b][1] = inner < 0 ? 2 : (float)cos(inner);
    }
}

/* The pattern of a pose, its edges moved outwards. */
typedef struct {
    bool fan;
    float x[3], y[3], z[3];
    float inner, outer, width, thickness;
} region;

static void narrow(sp_vec3 v, float out[3])
{
    out[0] = (float)v.x;
    out[1] = (float)v.y;
    out[2] = (float)v.z;
}

static region region_of(const sp_pose_prices *prices, const sp_make *make, sp_pose pose)
{
    const sp_search *search = prices->search;
    sp_vec3 up = sp_evaluator_setup(search->coarse)->up;
    sp_nozzle nozzle = sp_pose_nozzle(search->candidates, search->sites, pose, up);
    sp_frame frame = sp_nozzle_frame(nozzle.axis, nozzle.roll, up);
    region r = {.fan = make->spray.kind == SP_PATTERN_FLAT_FAN,
                .inner = make->spray.inner > 0 ? (float)(cos(make->spray.inner) + EDGE) : 2,
                .outer = (float)(cos(make->spray.outer) - EDGE),
                .width = (float)(cos(make->spray.half_width) - EDGE),
                .thickness = (float)(sin(make->spray.half_thickness) + EDGE)};
    narrow(frame.x, r.x);
    narrow(frame.y, r.y);
    narrow(frame.z, r.z);
    return r;
}

static inline float dot(const float a[3], float x, float y, float z)
{
    return a[0] * x + a[1] * y + a[2] * z;
}

static inline bool holds(const region *r, const sp_view *view, uint32_t i)
{
    float z = dot(r->z, view->x[i], view->y[i], view->z[i]);
    if (!r->fan)
        return z >= r->outer && z <= r->inner;
    if (fabsf(dot(r->y, view->x[i], view->y[i], view->z[i])) > r->thickness)
        return false;
    float x = dot(r->x, view->x[i], view->y[i], view->z[i]);
    return z >= r->width * sqrtf(x * x + z * z) - (float)EDGE;
}

/* Whether a bin, `z` its centre's cosine to the axis, has no direction in the pattern. */
static inline bool missed(const sp_bins *bins, const scratch *own, const region *r, uint32_t b, float z)
{
    if (z < own->beyond[b])
        return true;
    /* sin(a + b) <= sin a + b */
    return r->fan &&
           fabsf(dot(r->y, bins->x[b], bins->y[b], bins->z[b])) > r->thickness + bins->radius[b] + (float)BIN_EDGE;
}

/* The pose's price, or less than `least` where it cannot come to that. */
static double price_of(const sp_pose_prices *prices, const scratch *own, const sp_view *view, const region *r,
                       double least)
{
    const sp_bins *bins = &prices->search->visibility->bins;
    uint32_t split[SP_BINS];
    size_t splits = 0;
    double whole = 0, most = 0;
    for (size_t k = 0; k < own->listed; k++) {
        uint32_t b = own->list[k];
        float z = dot(r->z, bins->x[b], bins->y[b], bins->z[b]);
        if (missed(bins, own, r, b, z))
            continue;
        if (z >= own->within[b][0] && z <= own->within[b][1]) {
            whole += own->total[b];
        } else {
            most += own->total[b];
            split[splits++] = b;
        }
    }
    if ((whole + most) * UPWARDS <= least)
        return 0;
    for (size_t k = 0; k < splits; k++) {
        uint32_t b = split[k];
        for (uint32_t i = view->start[b]; i < view->start[b + 1]; i++)
            whole += holds(r, view, i) ? (double)own->worth[i] : 0;
    }
    return whole * UPWARDS;
}

/* What a site's pose of a make must be worth to matter: more than is on offer, or than is needed. */
static double least_of(const sp_pose_prices *prices, size_t port, size_t tier, const double *needed,
                       const sp_offers *offers)
{
    double offered =
        port == SP_NO_PORT ? offers->free[tier * offers->most] : offers->port[port * offers->tier_count + tier];
    return prices->cover->weight[tier] > prices->cover->water ? INFINITY : fmin(offered, needed[tier]);
}

/* The best pose of every make at a site, of those that matter. */
static void price_site(sp_pose_prices *prices, scratch *own, uint32_t site, const float *u, const double *needed,
                       const sp_offers *offers)
{
    const sp_candidates *candidates = prices->search->candidates;
    uint32_t mount = prices->search->sites->items[site].mount;
    for (uint32_t k = 0; k < candidates->make_count; k++) {
        const sp_make *make = &candidates->makes[k];
        best *found = &prices->bests[site * candidates->make_count + k];
        size_t axes = sp_candidates_axes(candidates, mount, k)->count;
        size_t at = site * candidates->speed_count + make->speed_class;
        const sp_view *view = &prices->search->visibility->views[at];
        double least = least_of(prices, prices->ports[mount], prices->tier_of[k], needed, offers);
        *found = (best){.price = 0};
        if (!axes || !view->start || !isfinite(least) || prices->search->port_taken[mount])
            continue;
        prepare_worth(prices, own, at, make, u);
        prepare_bins(prices, own, make);
        for (uint32_t a = 0; a < axes; a++)
            for (uint32_t r = 0; r < make->roll_count; r++) {
                sp_pose pose = {site, k, a, r};
                region pattern = region_of(prices, make, pose);
                double price = price_of(prices, own, view, &pattern, fmax(found->price, least));
                if (price > fmax(found->price, least))
                    *found = (best){pose, price};
            }
    }
}

static uint64_t key_of(const sp_pose_prices *prices, sp_pose pose)
{
    const sp_candidates *candidates = prices->search->candidates;
    uint32_t mount = prices->search->sites->items[pose.site].mount;
    uint64_t key = candidates->pose_start[pose.site];
    for (uint32_t k = 0; k < pose.make; k++)
        key += sp_candidates_axes(candidates, mount, k)->count * candidates->makes[k].roll_count;
    return key + (uint64_t)pose.axis * candidates->makes[pose.make].roll_count + pose.roll;
}

bool sp_pose_prices_row(const sp_pose_prices *prices, const float *field, uint64_t key, size_t port, uint32_t tier,
                        sp_rows *rows, sp_error *error)
{
    size_t count = 0;
    for (uint32_t t = 0; t < prices->search->patch_count; t++) {
        if (!(field[t] > 0) || !(prices->need[t] > 0))
            continue;
        float share = share_of(prices, t, field[t], false);
        if (share > 0) {
            prices->texels[count] = t;
            prices->shares[count++] = share;
        }
    }
    return sp_rows_add(rows, key, port, tier, prices->texels, prices->shares, count, error);
}

bool sp_pose_prices_add(const sp_pose_prices *prices, sp_pose pose, sp_rows *rows, sp_error *error)
{
    sp_field_pose(prices->search, pose, prices->field);
    return sp_pose_prices_row(prices, prices->field, key_of(prices, pose),
                              prices->ports[prices->search->sites->items[pose.site].mount], prices->tier_of[pose.make],
                              rows, error);
}

typedef struct {
    double excess;
    size_t at;
} entry;

static int by_excess(const void *a, const void *b)
{
    const entry *p = a, *q = b;
    if (p->excess != q->excess)
        return p->excess > q->excess ? -1 : 1;
    return (p->at > q->at) - (p->at < q->at);
}

static int by_key(const void *a, const void *b)
{
    uint64_t p = *(const uint64_t *)a, q = *(const uint64_t *)b;
    return (p > q) - (p < q);
}

/* Appends the best of the bests that are worth more than needed. */
static bool hand_out(const sp_pose_prices *prices, const double *needed, sp_rows *rows, sp_error *error)
{
    size_t count = prices->search->sites->count * prices->search->candidates->make_count, found = 0, had = rows->count;
    entry *entries = malloc((count + 1) * sizeof *entries);
    uint64_t *keys = malloc((had + 1) * sizeof *keys);
    bool done = entries && keys;
    if (!done)
        sp_fail_memory(error);
    for (size_t i = 0; done && i < count; i++) {
        double need = needed[prices->tier_of[prices->bests[i].pose.make]], price = prices->bests[i].price;
        if (price > need)
            entries[found++] = (entry){need > 0 ? price / need : price * 1e30, i};
    }
    for (size_t i = 0; done && i < had; i++)
        keys[i] = rows->key[i];
    if (done) {
        qsort(keys, had, sizeof *keys, by_key);
        qsort(entries, found, sizeof *entries, by_excess);
    }
    for (size_t i = 0, given = 0; done && i < found && given < ROWS_AT_A_TIME; i++) {
        sp_pose pose = prices->bests[entries[i].at].pose;
        uint64_t key = key_of(prices, pose);
        if (bsearch(&key, keys, had, sizeof *keys, by_key))
            continue;
        done = sp_pose_prices_add(prices, pose, rows, error);
        given++;
    }
    free(entries);
    free(keys);
    return done;
}

static bool price_poses(void *user, const float *u, const double *needed, sp_offers *offers, sp_rows *rows,
                        sp_error *error)
{
    sp_pose_prices *prices = user;
    const sp_search *search = prices->search;
    size_t makes = search->candidates->make_count, sites = search->sites->count;
#pragma omp parallel for num_threads(prices->threads) schedule(dynamic, 1)
    for (size_t i = 0; i < sites; i++)
        price_site(prices, &prices->scratches[omp_get_thread_num()], (uint32_t)i, u, needed, offers);
    for (size_t i = 0; i < sites * makes; i++)
        if (prices->bests[i].price > 0)
            sp_offers_add(offers, prices->ports[search->sites->items[i / makes].mount], prices->tier_of[i % makes],
                          prices->bests[i].price);
    return hand_out(prices, needed, rows, error);
}

sp_pricer sp_pose_pricer(sp_pose_prices *prices)
{
    return (sp_pricer){prices, price_poses};
}
