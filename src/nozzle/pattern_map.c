/* Means of a patternation. The parts of its cells between nodes, each no longer than half a bin, are dealt out to the
 * bins that hold their middles, where values that are linear either way have their mean. A bin gets the mean of its
 * parts times its own area: even patterns stay exactly even, however many parts a bin happens to hold. What that adds
 * to all the liquid, or takes from it, is put right by one factor. */
#include "patternation.h"

#include <stdlib.h>

#define BINS_LEAST 256 /* from the middle to a side */
#define MARGIN 3       /* bins beyond a pattern's edge */
#define FULL 1.5       /* height of a map that is not ended by the pattern: 30° beyond the hemisphere */
#define ROUND_OFF 1e-6 /* share that all may lack */
#define NOTHING 1e-12  /* of all solid angle with liquid: what sums come to where there is none */

/* A bin while it is filled. */
typedef struct {
    double liquid, wet, all; /* the last two of parts, sr */
} bin;

typedef struct {
    const sp_patternation *own;
    sp_pattern_map *map;
    bin *bins;   /* [2 half][2 half] */
    bool behind; /* it is the map away from the axis */
} dealing;

/* How far from the map's middle a height is. */
static double radius_at(const dealing *deal, double height)
{
    return sqrt(2 * fmax(0, deal->behind ? 2 - height : height));
}

static void deal_part(const dealing *deal, double radius, double azimuth, double value, double area)
{
    int half = deal->map->half;
    double u = radius * cos(azimuth) / deal->map->bin + half, v = radius * sin(azimuth) / deal->map->bin + half;
    if (!(u >= 0 && u < 2 * half && v >= 0 && v < 2 * half))
        return;
    bin *at = &deal->bins[(size_t)u * 2 * (size_t)half + (size_t)v];
    at->all += area;
    at->liquid += value * area;
    at->wet += value > 0 ? area : 0;
}

/* Between two heights; `t` is the middle's share of the way from one row of nodes (NULL: dry) to the next. */
static void deal_ring(const dealing *deal, double low, double high, const double *nodes, double t)
{
    size_t columns = deal->own->columns;
    double middle = radius_at(deal, 0.5 * (low + high)), width = 2 * M_PI / (double)columns;
    int parts = (int)ceil(fmax(1, 2 * middle * width / deal->map->bin));
    double area = (high - low) * width / parts, start = 0, end = 0;
    for (size_t i = 0; i < columns; i++) {
        size_t next = (i + 1) % columns;
        if (nodes) {
            start = nodes[i] + t * (nodes[columns + i] - nodes[i]);
            end = nodes[next] + t * (nodes[columns + next] - nodes[next]);
        }
        for (int k = 0; k < parts; k++) {
            double s = (k + 0.5) / parts;
            deal_part(deal, middle, ((double)i + 0.5 + s) * width, start + s * (end - start), area);
        }
    }
}

static void deal_band(const dealing *deal, double low, double high, const double *nodes)
{
    double inner = radius_at(deal, low), outer = radius_at(deal, high);
    int rings = (int)ceil(fmax(1, 2 * fabs(outer - inner) / deal->map->bin));
    double before = low;
    for (int k = 0; k < rings; k++) {
        double radius = inner + (outer - inner) * (k + 1) / rings, height = 0.5 * radius * radius;
        double next = k + 1 == rings ? high : deal->behind ? 2 - height : height;
        deal_ring(deal, before, next, nodes, (0.5 * (before + next) - low) / (high - low));
        before = next;
    }
}

static void deal_all(const dealing *deal)
{
    const sp_patternation *own = deal->own;
    const double *height = own->height;
    double reach = (deal->map->half + MARGIN) * deal->map->bin, end = fmin(2, deal->behind ? 2 : 0.5 * reach * reach);
    for (size_t j = 0; j + 1 < own->rows; j++)
        deal_band(deal, height[j], height[j + 1], &own->node[j * own->columns]);
    if (end > height[own->rows - 1])
        deal_band(deal, height[own->rows - 1], end, NULL);
}

/* What a bin holds when its parts are as large as it is; nothing is known of one without parts, beyond the map. */
static sp_held whole(const bin *at, double area)
{
    return at->all > 0 ? (sp_held){at->liquid / at->all * area, at->wet / at->all * area} : (sp_held){0, 0};
}

/* All bins within the map's circle hold parts on all of their area. */
static void find_scale(const dealing *deal)
{
    sp_pattern_map *map = deal->map;
    int half = map->half;
    double dealt = 0, held = 0;
    for (int i = 0; i < 2 * half; i++)
        for (int k = 0; k < 2 * half; k++) {
            const bin *at = &deal->bins[(size_t)i * 2 * (size_t)half + (size_t)k];
            if (hypot(i + 0.5 - half, k + 0.5 - half) < half - 1) {
                dealt += at->liquid;
                held += whole(at, map->bin * map->bin).liquid;
            }
        }
    map->scale = held > 0 ? dealt / held : 1;
}

static void add_up(const dealing *deal)
{
    sp_pattern_map *map = deal->map;
    size_t side = 2 * (size_t)map->half, corners = side + 1;
    for (size_t k = 0; k < corners; k++)
        map->sums[k] = (sp_held){0, 0};
    for (size_t i = 0; i < side; i++) {
        sp_held row = {0, 0}, *before = &map->sums[i * corners], *sums = before + corners;
        sums[0] = row;
        for (size_t k = 0; k < side; k++) {
            sp_held held = whole(&deal->bins[i * side + k], map->bin * map->bin);
            row.liquid += map->scale * held.liquid;
            row.wet += held.wet;
            sums[k + 1] = (sp_held){before[k + 1].liquid + row.liquid, before[k + 1].wet + row.wet};
        }
    }
}

static bool create_map(sp_patternation *own, bool behind, double reach)
{
    sp_pattern_map *map = &own->maps[behind];
    size_t half = fmax(BINS_LEAST, fmax((double)own->rows, (double)own->columns / 6));
    map->half = (int)half;
    map->bin = reach / (double)(half - MARGIN);
    map->sums = malloc((2 * half + 1) * (2 * half + 1) * sizeof *map->sums);
    dealing deal = {own, map, calloc(4 * half * half, sizeof *deal.bins), behind};
    bool done = map->sums && deal.bins;
    if (done) {
        deal_all(&deal);
        find_scale(&deal);
        add_up(&deal);
    }
    free(deal.bins);
    return done;
}

bool sp_pattern_maps_create(sp_patternation *own)
{
    double edge = own->height[own->rows - 1];
    if (edge <= 1)
        return create_map(own, false, sqrt(2 * edge));
    return create_map(own, false, sqrt(2 * FULL)) && create_map(own, true, sqrt(2 * FULL));
}

void sp_pattern_maps_free(sp_patternation *own)
{
    for (int k = 0; k < 2; k++)
        free(own->maps[k].sums);
}

/* A place among the bins along one axis of the map. */
typedef struct {
    size_t bin;
    double part; /* of it, 0 to 1 */
} spot;

static spot spot_of(const sp_pattern_map *map, double x)
{
    double at = fmin(2 * map->half, fmax(0, x / map->bin + map->half)), bin = fmin(floor(at), 2 * map->half - 1);
    return (spot){(size_t)bin, at - bin};
}

/* What lies before a place along both. */
static sp_held before(const sp_pattern_map *map, spot u, spot v)
{
    const sp_held *near = &map->sums[u.bin * (2 * (size_t)map->half + 1) + v.bin], *far = near + 2 * map->half + 1;
    double a = (1 - u.part) * (1 - v.part), b = (1 - u.part) * v.part, c = u.part * (1 - v.part), d = u.part * v.part;
    return (sp_held){a * near[0].liquid + b * near[1].liquid + c * far[0].liquid + d * far[1].liquid,
                     a * near[0].wet + b * near[1].wet + c * far[0].wet + d * far[1].wet};
}

/* Squares half as broad, in three rows of three, that weigh 1, 2 and 1 each way: as a filter that has a double zero at
 * the frequency of patches side by side. */
static sp_held filter(const sp_pattern_map *map, double u, double v, double breadth)
{
    static const double corners[4] = {-0.75, -0.25, 0.25, 0.75};
    spot across[4], along[4];
    sp_held sum = {0, 0};
    for (int i = 0; i < 4; i++) {
        across[i] = spot_of(map, u + corners[i] * breadth);
        along[i] = spot_of(map, v + corners[i] * breadth);
    }
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 4; k++) {
            sp_held held = before(map, across[i], along[k]);
            double sign = (i < 2) == (k < 2) ? 1 : -1;
            sum.liquid += sign * held.liquid;
            sum.wet += sign * held.wet;
        }
    size_t side = 2 * (size_t)map->half;
    if (sum.wet <= NOTHING * map->sums[side * (side + 2)].wet)
        return (sp_held){0, 0};
    double weight = 1 / (4 * breadth * breadth);
    return (sp_held){weight * sum.liquid, weight * sum.wet};
}

sp_held sp_patternation_mean(const sp_patternation *own, sp_vec3 direction, double breadth)
{
    const sp_pattern_map *map = &own->maps[direction.z < 0 && own->maps[1].half > 0];
    double forwards = 1 + (map == own->maps ? direction.z : -direction.z);
    if (breadth < map->bin) {
        double density = sp_patternation_at(own, direction);
        return (sp_held){density, density > 0};
    }
    if (forwards < 2 - FULL) /* beyond the map, and so beyond the pattern */
        return (sp_held){0, 0};
    double to_map = sqrt(2 / forwards);
    sp_held mean = filter(map, to_map * direction.x, to_map * direction.y, breadth);
    double share = mean.wet > 1 - ROUND_OFF ? 1 : mean.wet;
    return (sp_held){fmin(own->densest * share, fmax(0, mean.liquid)), share};
}
