#include "scoring/view.h"

#include <assert.h>
#include <stdlib.h>

#define PART SP_SIGHTING_PART
#define COLUMNS 5 /* of floats by arrival */

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

sp_vec3 sp_octahedron_decode(double u, double v)
{
    double z = 1 - fabs(u) - fabs(v);
    if (z >= 0)
        return sp_unit(sp_v(u, v, z));
    return sp_unit(sp_v(copysign(1 - fabs(v), u), copysign(1 - fabs(u), v), z));
}

/* Bins that lie together have numbers together: TILE x TILE of them are a block. */
#define TILE 4
#define TILES (SP_BINS_EDGE / TILE)
_Static_assert(TILE *TILE == SP_LANES, "a block is a tile");

static size_t number_of(size_t i, size_t j)
{
    return (j / TILE * TILES + i / TILE) * SP_LANES + j % TILE * TILE + i % TILE;
}

static uint16_t bin_of(sp_vec3 direction)
{
    double u, v;
    encode(direction, &u, &v);
    int i = (int)((u + 1) * (0.5 * SP_BINS_EDGE)), j = (int)((v + 1) * (0.5 * SP_BINS_EDGE));
    i = i < 0 ? 0 : i >= SP_BINS_EDGE ? SP_BINS_EDGE - 1 : i;
    j = j < 0 ? 0 : j >= SP_BINS_EDGE ? SP_BINS_EDGE - 1 : j;
    return (uint16_t)number_of((size_t)i, (size_t)j);
}

static sp_vec3 centre_of(const sp_bins *bins, size_t b)
{
    return sp_v((double)bins->x[b], (double)bins->y[b], (double)bins->z[b]);
}

static void set_block(sp_bins *bins, size_t block)
{
    sp_vec3 sum = {0};
    double cosine = 1;
    for (size_t i = 0; i < SP_LANES; i++)
        sum = sp_add(sum, centre_of(bins, block * SP_LANES + i));
    sp_vec3 centre = sp_unit(sum);
    for (size_t i = 0; i < SP_LANES; i++)
        cosine = fmin(cosine, sp_dot(centre, centre_of(bins, block * SP_LANES + i)));
    bins->block_x[block] = (float)centre.x;
    bins->block_y[block] = (float)centre.y;
    bins->block_z[block] = (float)centre.z;
    bins->block_radius[block] = (float)(acos(cosine) + 1e-3);
}

void sp_bins_create(sp_bins *bins)
{
    const double edge = 2.0 / SP_BINS_EDGE;
    for (size_t n = 0; n < SP_BINS; n++) {
        size_t i = n % SP_BINS_EDGE, j = n / SP_BINS_EDGE, b = number_of(i, j);
        double u = (double)i * edge - 1, v = (double)j * edge - 1;
        sp_vec3 centre = sp_octahedron_decode(u + 0.5 * edge, v + 0.5 * edge);
        double cosine = 1;
        /* A cell's sides are arcs of great circles, so that its corners lie farthest out. */
        for (int corner = 0; corner < 4; corner++)
            cosine =
                fmin(cosine, sp_dot(centre, sp_octahedron_decode(u + edge * (corner & 1), v + edge * (corner >> 1))));
        bins->x[b] = (float)centre.x;
        bins->y[b] = (float)centre.y;
        bins->z[b] = (float)centre.z;
        bins->radius[b] = (float)(acos(cosine) + 1e-3);
    }
    for (size_t i = 0; i < SP_BLOCKS; i++)
        set_block(bins, i);
}

size_t sp_sightings_work(size_t cells)
{
    return (PART + cells) * SP_REACH_WORK;
}

/* The arrivals at a patch follow one another. */
static bool take(const sp_reach *reach, double all, sp_sightings *sightings)
{
    size_t at = sightings->parts;
    if (!reach->count)
        return true;
    sp_sighting *part = sightings->part[at] = malloc(reach->count * sizeof *part);
    if (!part)
        return false;
    size_t cells = 0;
    for (size_t i = 0; i < reach->count; i++) {
        const sp_arrival *arrival = &reach->arrivals[i];
        sp_vec3 d = arrival->direction;
        part[i] = (sp_sighting){.x = (float)d.x,
                                .y = (float)d.y,
                                .z = (float)d.z,
                                .transfer = (float)(arrival->transfer * all),
                                .breadth = (float)arrival->breadth,
                                .part = (float)arrival->part,
                                .patch = arrival->patch,
                                .bin = bin_of(d),
                                .arc = arrival->arc,
                                .fails = !arrival->passes};
        cells += arrival->part < 1;
        assert(i == 0 || part[i - 1].patch <= part[i].patch); /* patches ascend, also within a bin then */
        sightings->any_marked |= part[i].fails;
        if (i && part[i - 1].patch == part[i].patch)
            part[i - 1].twice = part[i].twice = sightings->any_marked = true;
    }
    sightings->any_marked |= cells > 0;
    sightings->cells = cells > sightings->cells ? cells : sightings->cells;
    sightings->size[at] = reach->count;
    sightings->count += reach->count;
    sightings->parts++;
    return true;
}

bool sp_sightings_trace(const sp_evaluator *evaluator, const sp_site *site, sp_launch launch, double half_angle,
                        const uint8_t *known, sp_sightings *sightings, sp_error *error)
{
    size_t patches = sp_evaluator_patches(evaluator)->count;
    *sightings = (sp_sightings){.most_parts = patches / PART + 1};
    sightings->size = calloc(sightings->most_parts, sizeof *sightings->size);
    sightings->part = calloc(sightings->most_parts, sizeof *sightings->part);
    if (!sightings->size || !sightings->part)
        return sp_fail_memory(error);
    for (size_t first = 0; first < patches; first += PART) {
        sp_reach *reach = sp_evaluator_reach_part(evaluator, site->position, launch, site->axis, half_angle, first,
                                                  first + PART < patches ? first + PART : patches, known, error);
        if (!reach)
            return false;
        bool done = take(reach, sp_evaluator_patches(evaluator)->total_area, sightings);
        sp_reach_destroy(reach);
        if (!done)
            return sp_fail_memory(error);
    }
    return true;
}

void sp_sightings_note(const sp_sightings *sightings, uint8_t *known)
{
    for (size_t p = 0; p < sightings->parts; p++)
        for (size_t i = 0; i < sightings->size[p]; i++) {
            size_t bit = 2 * (size_t)sightings->part[p][i].patch + sightings->part[p][i].arc;
            known[bit / 8] |= (uint8_t)(1u << bit % 8);
        }
}

void sp_sightings_free(sp_sightings *sightings)
{
    for (size_t i = 0; i < sightings->parts; i++)
        free(sightings->part[i]);
    free(sightings->part);
    free(sightings->size);
    *sightings = (sp_sightings){0};
}

size_t sp_view_bytes(size_t count, bool any_marked)
{
    return (SP_BINS + 1 + count) * sizeof(uint32_t) +
           (3 * SP_BINS + 2 * SP_BLOCKS + COLUMNS * (count + SP_LANES)) * sizeof(float) +
           (any_marked ? count * (sizeof(float) + 2 * sizeof(uint8_t)) : 0);
}

/* The bins' starts first, then the arrays. */
static void lay_out(void *block, size_t count, bool any_marked, sp_view *view)
{
    size_t padded = count + SP_LANES;
    *view = (sp_view){.count = (uint32_t)count, .start = block};
    view->patch = view->start + SP_BINS + 1;
    view->broadest = (float *)(view->patch + count);
    view->cosine = view->broadest + SP_BINS;
    view->sine = view->cosine + SP_BINS;
    view->block_cosine = view->sine + SP_BINS;
    view->block_sine = view->block_cosine + SP_BLOCKS;
    float *columns = view->block_sine + SP_BLOCKS;
    float **column[COLUMNS] = {&view->x, &view->y, &view->z, &view->transfer, &view->sharp};
    for (size_t i = 0; i < COLUMNS; i++) {
        *column[i] = columns + i * padded;
        for (size_t k = count; k < padded; k++)
            (*column[i])[k] = 0;
    }
    view->part = any_marked ? columns + COLUMNS * padded : NULL;
    view->twice = any_marked ? (uint8_t *)(view->part + count) : NULL;
    view->fails = any_marked ? view->twice + count : NULL;
}

/* How far round its centre a bin's patches may lie in a pattern, and a block's bins. */
static void set_angles(const sp_bins *bins, sp_view *view)
{
    double most[SP_BLOCKS] = {0};
    for (size_t b = 0; b < SP_BINS; b++) {
        double angle = (double)bins->radius[b] + SP_OUTLINE_BLUR * (double)view->broadest[b];
        view->cosine[b] = (float)cos(angle);
        view->sine[b] = (float)sin(angle);
        most[b / SP_LANES] = fmax(most[b / SP_LANES], angle);
    }
    for (size_t i = 0; i < SP_BLOCKS; i++) {
        double angle = fmin(M_PI, (double)bins->block_radius[i] + most[i]);
        view->block_cosine[i] = (float)cos(angle);
        view->block_sine[i] = (float)sin(angle);
    }
}

void sp_view_write(const sp_sightings *sightings, const sp_bins *bins, void *block, sp_view *view)
{
    lay_out(block, sightings->count, sightings->any_marked, view);
    uint32_t *start = view->start, next[SP_BINS];
    for (size_t b = 0; b <= SP_BINS; b++)
        start[b] = 0;
    for (size_t p = 0; p < sightings->parts; p++)
        for (size_t i = 0; i < sightings->size[p]; i++)
            start[sightings->part[p][i].bin + 1]++;
    for (size_t b = 0; b < SP_BINS; b++)
        start[b + 1] += start[b];
    for (size_t b = 0; b < SP_BINS; b++)
        next[b] = start[b];
    for (size_t b = 0; b < SP_BINS; b++)
        view->broadest[b] = 0;
    for (size_t p = 0; p < sightings->parts; p++)
        for (size_t i = 0; i < sightings->size[p]; i++) {
            const sp_sighting *from = &sightings->part[p][i];
            assert(from->breadth > 0 && from->part >= 0 && from->part <= 1);
            uint32_t at = next[from->bin]++;
            view->x[at] = from->x;
            view->y[at] = from->y;
            view->z[at] = from->z;
            view->transfer[at] = from->transfer;
            view->patch[at] = from->patch;
            view->sharp[at] = 1 / from->breadth;
            view->broadest[from->bin] = fmaxf(view->broadest[from->bin], from->breadth);
            view->most = fmaxf(view->most, from->breadth);
            if (view->twice) {
                view->part[at] = from->part;
                view->twice[at] = from->twice;
                view->fails[at] = from->fails;
            }
        }
    for (size_t b = 0; b < SP_BINS; b++)
        assert(next[b] == start[b + 1]);
    set_angles(bins, view);
}
