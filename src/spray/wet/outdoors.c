/* What is seen through an opening of the space that is cleaned is not for that part of it: a floor beneath an outlet
 * would else carry the flood to the vessel's outside. Only where wet sides see the sky is there anything to tell apart.
 *
 * Think of the sides as rooms between which one walks along lines of sight: how likely is it to arrive in the liquid
 * before one gets under the sky? The liquid begins with what the cavity's point sees that hardly looks at the
 * sky, or that hangs together with much of what the point sees (an open tray). Sides from where the liquid is the
 * likely end belong to it, and so do flat and concave neighbours of what does, and whatever can be reached and sees no
 * sky even by way of others. The rest is outdoors. An opening that is narrow against what is behind it is never passed;
 * what is half open, such as a bell over a pot, may fall on either side. */
#include "spray/wet/flood_fill.h"

#include "mesh/half_edge.h"

#include <stdlib.h>

#define CERTAIN 0.75    /* a chance to end in the liquid that few lines are enough to tell */
#define LIKELY 0.25     /* the least chance that belongs to the liquid */
#define FAINT 0.02      /* the least chance of what liquid spreads to over flat and hollow edges */
#define FEW_LINES 3     /* the least that tell of a chance */
#define LINES 48        /* from each side that is still in doubt */
#define MUCH (1.0 / 16) /* of the directions from the cavity's point */
#define SKY_LEAST 4     /* one line in so many may reach the sky where the liquid begins */
#define STILL 1e-3      /* chances that change less are known */
#define MOST_SWEEPS 400
#define FLAT 1e-4 /* sine of the angle up to which two triangles are one plane */

typedef struct {
    const sp_flood *flood;
    bool *liquid;          /* candidates, from the flood */
    bool *in;              /* [sides], of them: known to be liquid */
    double *chance;        /* [sides] */
    double *sum;           /* [sides] */
    uint32_t *lines;       /* [sides] */
    sp_sight_link *sights; /* of what is in doubt */
    size_t sight_count;
    sp_half_edges edges;
} indoors;

static bool sees_sky(const sp_flood *flood, const bool *liquid)
{
    for (size_t i = 0; i < flood->sight_count; i++)
        if (flood->sights[i].to == SP_SKY && liquid[flood->sights[i].from])
            return true;
    return false;
}

static uint32_t shell_of_side(const sp_flood *flood, uint32_t side)
{
    return flood->shells->of[sp_face_triangle(flood->faces, side / 2)];
}

/* Where the liquid begins. */
static bool begin(indoors *known, sp_error *error)
{
    const sp_flood *flood = known->flood;
    size_t *of_shell = calloc(flood->shells->count + 1, sizeof *of_shell);
    uint32_t *sky = calloc(flood->sides + 1, sizeof *sky);
    if (!of_shell || !sky) {
        free(of_shell);
        free(sky);
        return sp_fail_memory(error);
    }
    size_t all = 0, begun = 0;
    for (size_t i = 0; i < flood->sight_count; i++) {
        known->lines[flood->sights[i].from] += flood->sights[i].to != SP_AMBIGUOUS;
        sky[flood->sights[i].from] += flood->sights[i].to == SP_SKY;
    }
    for (uint32_t side = 0; side < flood->sides; side++) {
        all += flood->seen[side];
        of_shell[shell_of_side(flood, side)] += flood->seen[side];
    }
    for (uint32_t side = 0; side < flood->sides; side++) {
        known->in[side] = flood->in_view[side] && (SKY_LEAST * sky[side] <= known->lines[side] ||
                                                   (double)of_shell[shell_of_side(flood, side)] >= MUCH * (double)all);
        begun += known->in[side];
    }
    for (uint32_t side = 0; side < flood->sides && begun == 0; side++)
        known->in[side] = flood->in_view[side];
    free(of_shell);
    free(sky);
    return true;
}

/* One step of the walk for all; returns how many sides turn out to be liquid. */
static size_t sweep(indoors *known, double bound, double *change)
{
    const sp_flood *flood = known->flood;
    size_t joined = 0;
    for (size_t side = 0; side < flood->sides; side++) {
        known->sum[side] = 0;
        known->lines[side] = 0;
    }
    size_t kept = 0;
    for (size_t i = 0; i < known->sight_count; i++) {
        sp_sight_link sight = known->sights[i];
        if (known->in[sight.from])
            continue;
        known->sights[kept++] = sight;
        known->lines[sight.from]++;
        if (sight.to != SP_SKY)
            known->sum[sight.from] += known->in[sight.to] ? 1 : known->chance[sight.to];
    }
    known->sight_count = kept;
    *change = 0;
    for (size_t side = 0; side < flood->sides; side++) {
        if (!known->liquid[side] || known->in[side] || !known->lines[side])
            continue;
        double chance = known->sum[side] / known->lines[side];
        *change = fmax(*change, fabs(chance - known->chance[side]));
        known->chance[side] = chance;
        if (chance >= bound && known->lines[side] >= FEW_LINES) {
            known->in[side] = true;
            joined++;
        }
    }
    return joined;
}

/* Whether two whole triangles at one edge are one plane or a hollow, seen from `side`. */
static bool flat_or_concave(const sp_mesh *mesh, uint32_t a, uint32_t b, uint32_t corner_of_b, unsigned side)
{
    sp_vec3 normal = sp_triangle_normal(mesh, a), tip = mesh->vertices[mesh->triangles[b][corner_of_b]];
    sp_vec3 to_tip = sp_sub(tip, mesh->vertices[mesh->triangles[a][0]]);
    double rise = sp_dot(normal, to_tip) * (side ? -1 : 1);
    sp_vec3 edge = mesh->vertices[mesh->triangles[b][(corner_of_b + 1) % 3]];
    return rise >= -FLAT * sp_distance(tip, edge);
}

/* Liquid spreads over flat and hollow edges; returns how many sides it gains. */
static size_t spread(indoors *known)
{
    const sp_flood *flood = known->flood;
    const sp_mesh *mesh = flood->setup->mesh;
    const uint32_t *root = flood->faces->cuts->root;
    size_t joined = 0;
    for (uint32_t h = 0; h < 3 * mesh->triangle_count; h++) {
        uint32_t other = known->edges.opposite[h], a = h / 3;
        if (other == SP_NONE || root[a] != SP_NONE || root[other / 3] != SP_NONE)
            continue;
        for (uint32_t side = 0; side < 2; side++) {
            uint32_t from = 2 * a + side, to = 2 * (other / 3) + side;
            if (!known->in[from] || known->in[to] || !known->liquid[to] || known->chance[to] < FAINT ||
                !flat_or_concave(mesh, a, other / 3, (other % 3 + 2) % 3, side))
                continue;
            known->in[to] = true;
            joined++;
        }
    }
    return joined;
}

/* Groups of sides that see each other but no sky are liquid; returns how many sides that gains. */
static size_t take_skyless(indoors *known, uint32_t *parent, bool *sky)
{
    const sp_flood *flood = known->flood;
    size_t joined = 0;
    for (uint32_t side = 0; side < flood->sides; side++) {
        parent[side] = side;
        sky[side] = false;
    }
    for (size_t i = 0; i < flood->sight_count; i++) {
        sp_sight_link sight = flood->sights[i];
        if (sight.to < flood->sides && !known->in[sight.from] && !known->in[sight.to])
            sp_set_join(parent, sight.from, sight.to);
    }
    for (size_t i = 0; i < flood->sight_count; i++)
        if (flood->sights[i].to == SP_SKY && !known->in[flood->sights[i].from])
            sky[sp_set_root(parent, flood->sights[i].from)] = true;
    for (uint32_t side = 0; side < flood->sides; side++) {
        if (known->in[side] || !known->liquid[side] || sky[sp_set_root(parent, side)])
            continue;
        known->in[side] = true;
        joined++;
    }
    return joined;
}

static bool settle(indoors *known, double bound, sp_error *error)
{
    size_t sides = known->flood->sides, joined = 1;
    uint32_t *parent = malloc((sides + 1) * sizeof *parent);
    bool *sky = malloc(sides + 1);
    free(known->sights);
    known->sights = malloc((known->flood->sight_count + 1) * sizeof *known->sights);
    if (!parent || !sky || !known->sights) {
        free(parent);
        free(sky);
        return sp_fail_memory(error);
    }
    known->sight_count = 0;
    for (size_t i = 0; i < known->flood->sight_count; i++) {
        sp_sight_link sight = known->flood->sights[i];
        if (known->liquid[sight.from] && !known->in[sight.from] && sight.to != SP_AMBIGUOUS)
            known->sights[known->sight_count++] = sight;
    }
    while (joined > 0) {
        double change = 1;
        joined = 0;
        for (int i = 0; i < MOST_SWEEPS && change > STILL; i++) {
            size_t more = sweep(known, bound, &change);
            more += more || i == 0 ? spread(known) : 0;
            joined += more;
            change = more ? 1 : change;
        }
        joined += take_skyless(known, parent, sky);
    }
    free(parent);
    free(sky);
    return true;
}

/* Casts more lines from what is still in doubt. */
static bool look_again(indoors *known, sp_flood *flood, sp_error *error)
{
    bool *doubt = malloc(flood->sides + 1);
    if (!doubt)
        return sp_fail_memory(error);
    for (size_t side = 0; side < flood->sides; side++)
        doubt[side] = known->liquid[side] && !known->in[side];
    size_t joined;
    bool done = sp_flood_cast(flood, doubt, SP_FLOOD_LINES, LINES, &joined, error);
    free(doubt);
    return done;
}

bool sp_flood_keep_indoors(sp_flood *flood, bool *liquid, double *left_out, sp_error *error)
{
    *left_out = 0;
    if (!sees_sky(flood, liquid))
        return true;
    size_t room = flood->sides + 1;
    indoors known = {.flood = flood,
                     .liquid = liquid,
                     .in = calloc(room, 1),
                     .chance = calloc(room, sizeof *known.chance),
                     .sum = calloc(room, sizeof *known.sum),
                     .lines = calloc(room, sizeof *known.lines)};
    bool done = known.in && known.chance && known.sum && known.lines;
    if (!done)
        sp_fail_memory(error);
    done = done && sp_half_edges_create(flood->setup->mesh, &known.edges, error) && begin(&known, error) &&
           settle(&known, CERTAIN, error) && look_again(&known, flood, error) && settle(&known, LIKELY, error);
    for (size_t side = 0; done && side < flood->sides; side++) {
        *left_out += liquid[side] && !known.in[side] ? flood->faces->area[side / 2] : 0;
        liquid[side] = liquid[side] && known.in[side];
    }
    free(known.in);
    free(known.sights);
    free(known.chance);
    free(known.sum);
    free(known.lines);
    sp_half_edges_destroy(&known.edges);
    return done;
}
