/* Random instances of maximum coverage: nozzles over a floor with walls on it that cast shadows. */
#ifndef INSTANCE_H
#define INSTANCE_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "bound/cover.h"

#define INSTANCE_TIERS 3
#define INSTANCE_WALLS 24

typedef struct {
    sp_cover cover;
    sp_rows rows;
    float *area;
    uint32_t weight[INSTANCE_TIERS];
} instance;

/* Marsaglia, Xorshift RNGs, 2003. */
static inline double instance_random(uint64_t *state)
{
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    return (double)(*state >> 11) * 0x1p-53;
}

static inline bool instance_crosses(const double w[4], double x, double y, double u, double v)
{
    double a = (w[2] - w[0]) * (y - w[1]) - (w[3] - w[1]) * (x - w[0]);
    double b = (w[2] - w[0]) * (v - w[1]) - (w[3] - w[1]) * (u - w[0]);
    double c = (u - x) * (w[1] - y) - (v - y) * (w[0] - x), d = (u - x) * (w[3] - y) - (v - y) * (w[2] - x);
    return a * b < 0 && c * d < 0;
}

/* One nozzle straight down: full cones of three flows and angles, flux as the inverse square of distance times the
 * cosine at the floor; 1 is enough. `plenty`: how strong they are; at 1 most of what a cone holds gets enough, at 0.3 a
 * good part of it does not. */
static inline void instance_add(instance *i, size_t edge, const double (*walls)[4], size_t wall_count, bool single,
                                size_t port, double plenty, uint64_t *seed, uint32_t *texels, float *shares)
{
    static const double half_angles[INSTANCE_TIERS] = {0.62, 0.85, 1.1};
    double x = instance_random(seed), y = instance_random(seed), high = 0.09 + 0.16 * instance_random(seed);
    uint32_t tier = (uint32_t)(INSTANCE_TIERS * instance_random(seed));
    double cosine = cos(half_angles[tier]), strength = 0.03 * plenty * i->weight[tier] / (2 * M_PI * (1 - cosine));
    size_t count = 0;
    for (size_t t = 0; t < edge * edge; t++) {
        double u = ((double)(t % edge) + 0.5) / (double)edge, v = ((double)(t / edge) + 0.5) / (double)edge;
        double far = sqrt((u - x) * (u - x) + (v - y) * (v - y) + high * high);
        bool hit = high >= cosine * far;
        for (size_t w = 0; hit && w < wall_count; w++)
            hit = !instance_crosses(walls[w], x, y, u, v);
        double flux = strength * high / (far * far * far);
        if (!hit || (single && flux < 1))
            continue;
        texels[count] = (uint32_t)t;
        shares[count++] = (float)fmin(1, flux);
    }
    sp_error error = {0};
    assert_true(sp_rows_add(&i->rows, i->rows.count, port, tier, texels, shares, count, &error));
}

/* `ports`: so many, the first quarter of the candidates spread over them. */
static inline void instance_create(instance *i, size_t candidates, size_t edge, bool single, size_t nozzles,
                                   size_t water, size_t ports, double plenty, uint64_t seed)
{
    *i = (instance){.weight = {8, 13, 20}};
    i->area = malloc(edge * edge * sizeof *i->area);
    uint32_t *texels = malloc(edge * edge * sizeof *texels);
    float *shares = malloc(edge * edge * sizeof *shares);
    double walls[INSTANCE_WALLS][4];
    for (size_t t = 0; t < edge * edge; t++)
        i->area[t] = 1 / (float)(edge * edge);
    for (size_t w = 0; w < INSTANCE_WALLS; w++) {
        walls[w][0] = instance_random(&seed);
        walls[w][1] = instance_random(&seed);
        walls[w][2] = walls[w][0] + 0.2 * (instance_random(&seed) - 0.5);
        walls[w][3] = walls[w][1] + 0.2 * (instance_random(&seed) - 0.5);
    }
    for (size_t c = 0; c < candidates; c++)
        instance_add(i, edge, walls, INSTANCE_WALLS, single, ports && 4 * c < candidates ? c % ports : SP_NO_PORT,
                     plenty, &seed, texels, shares);
    free(texels);
    free(shares);
    i->cover = (sp_cover){.texel_count = edge * edge,
                          .area = i->area,
                          .tier_count = INSTANCE_TIERS,
                          .weight = i->weight,
                          .port_count = ports,
                          .nozzles = nozzles,
                          .water = water,
                          .repeats = !single,
                          .whole = single,
                          .threads = 1};
}

static inline void instance_free(instance *i)
{
    sp_rows_free(&i->rows);
    free(i->area);
}

#endif
