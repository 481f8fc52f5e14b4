/* Parabolas of one origin: put in the order of their directions, then traced in packets of neighbours. */
#include "trace/parabola/parabola_packet.h"
#include "trace/bvh/direction_order.h"

#include <assert.h>
#include <stdlib.h>

/* Coordinates up to which flights are followed, some more than the boxes with their padding; the most that speed times
 * way, and bend times way², may be; and the most that a way may be, for its own rounding. */
#define LIMIT 1.015625f
#define FARTHEST 4.0f
#define LONGEST 64.0f

enum {
    LEAST = 4, /* fewer are left over */
    /* Where a packet meets more triangles to a parabola than this, its parabolas are faster by themselves: so many of
     * the packets that follow are left over, too, before one is tried again, and twice as many each time, but for a
     * limit. */
    SPARSE = 4,
    REST_LEAST = 15,
    REST_MOST = 240,
};
static const float breadth = 0.25f; /* the most that the directions of a packet differ along an axis */

typedef struct {
    float direction[3];
    float first, last;
    uint32_t skip;
} scaled_ray;

typedef struct {
    const sp_bvh *bvh;
    const sp_ray *rays;
    size_t count;
    scaled_ray *scaled;           /* [count], as the rays */
    sp_direction_entry *order[2]; /* [count] */
    size_t taken;                 /* in order[0]: those that packets take */
    int steep;
    float origin[3], bend;
    double rate, span; /* power of two, and its inverse */
} common_origin;

void sp_parabola_packet_settle(sp_parabola_packet *v, int lane, uint32_t triangle)
{
    sp_hit hit = sp_parabola_ask(v->bvh, v->acceleration, &v->rays[v->ray[lane]], triangle, v->triangle[lane]);
    if (hit.triangle == SP_NONE)
        return;
    float way = (float)(hit.t * v->rate);
    v->triangle[lane] = hit.triangle;
    v->low[lane] = way - 2 * SP_BVH_PAD;
    v->high[lane] = v->any ? -1 : way + 2 * SP_BVH_PAD;
}

/* The way at which the coordinate leaves ±LIMIT for good. */
static inline float leave_straight(float place, float speed)
{
    return (LIMIT - (speed < 0 ? -place : place)) / fabsf(speed);
}

static inline float leave_steep(float place, float speed, float bend)
{
    float sign = bend < 0 ? 1 : -1, deep = place * sign + LIMIT;
    speed *= sign;
    bend *= sign;
    float root = sqrtf(speed * speed - 4 * bend * deep);
    return speed > 0 ? -0.5f * (speed + root) / bend : 2 * deep / (root - speed);
}

/* False where the flight is none that a packet takes. */
static inline bool scale_ray(const common_origin *c, const sp_ray *ray, scaled_ray *j, uint32_t *key)
{
    double velocity[3];
    float last = INFINITY, amount[3];
    sp_to_array(ray->velocity, velocity);
    for (int k = 0; k < 3; k++) {
        float speed = (float)(velocity[k] * c->bvh->scale * c->span);
        float leave = k == c->steep ? leave_steep(c->origin[k], speed, c->bend) : leave_straight(c->origin[k], speed);
        j->direction[k] = speed;
        last = leave < last ? leave : last;
        amount[k] = fabsf(speed);
    }
    /* without branches, which no processor could foresee */
    float more = amount[1] > amount[0] ? amount[1] : amount[0], fastest = amount[2] > more ? amount[2] : more;
    uint32_t is_z = amount[2] > more, z = 2 * is_z + ((amount[1] > amount[0]) & ~is_z);
    double end = ray->t_max * c->rate;
    last = end < last ? (float)end : last;
    j->first = (float)sp_lesser(ray->t_min * c->rate, 2 * LONGEST);
    j->last = last;
    j->skip = ray->skip;
    if (!(ray->t_min >= 0 && ray->t_max > 0 && last <= LONGEST && fastest * last <= FARTHEST &&
          fabsf(c->bend) * last * last <= FARTHEST && fastest > 0x1p-20f))
        return false;
    float inverse = 1 / fastest;
    *key = sp_direction_key(2 * z + (j->direction[z] < 0), j->direction[z == 2 ? 0 : z + 1] * inverse,
                            j->direction[z == 0 ? 2 : z - 1] * inverse);
    return true;
}

/* Returns how many are left over. */
static size_t read_rays(common_origin *c, uint32_t *left)
{
    size_t others = 0;
    c->taken = 0;
    for (size_t i = 0; i < c->count; i++) {
        uint32_t key;
        if (scale_ray(c, &c->rays[i], &c->scaled[i], &key))
            c->order[0][c->taken++] = (sp_direction_entry){key, (uint32_t)i};
        else
            left[others++] = (uint32_t)i;
    }
    sp_direction_sort(c->order, c->taken);
    return others;
}

/* What all have in common; false where packets are not for them. */
static bool begin(common_origin *c, const sp_acceleration *acceleration)
{
    const sp_bvh *bvh = c->bvh;
    double origin[3], fastest = 0;
    sp_to_array(c->rays[0].origin, origin);
    for (size_t i = 0; i < c->count; i++) {
        sp_vec3 v = c->rays[i].velocity;
        fastest = sp_greater(fastest, sp_greater(fabs(v.x), sp_greater(fabs(v.y), fabs(v.z))));
    }
    assert(acceleration->strength != 0);
    fastest *= bvh->scale;
    if (!(fastest > 1e-100 && fastest < 1e100))
        return false;
    c->rate = sp_bvh_power_above(fastest, &c->span);
    c->steep = acceleration->vector[0] != 0 ? 0 : acceleration->vector[1] != 0 ? 1 : 2;
    for (int k = 0; k < 3; k++) {
        double place = (origin[k] - bvh->centre[k]) * bvh->scale;
        if (!(fabs(place) < LIMIT) || (k != c->steep && acceleration->vector[k] != 0))
            return false;
        c->origin[k] = (float)place;
    }
    c->bend = (float)(0.5 * acceleration->vector[c->steep] * bvh->scale * c->span * c->span);
    return fabsf(c->bend) > 1e-30f && fabsf(c->bend) < 1e3f;
}

/* Puts the next parabolas into a packet; returns how many. */
static size_t fill(const common_origin *c, size_t from, sp_parabola_packet *v)
{
    int count = 0;
    for (int k = 0; k < 3; k++) {
        v->least[k] = INFINITY;
        v->most[k] = -INFINITY;
    }
    for (; count < SP_PARABOLA_PACKET && from + (size_t)count < c->taken; count++) {
        uint32_t number = c->order[0][from + (size_t)count].ray;
        const scaled_ray *j = &c->scaled[number];
        size_t ahead = from + (size_t)count + SP_PARABOLA_PACKET;
        float least[3], most[3];
        bool close = true;
        __builtin_prefetch(&c->scaled[c->order[0][ahead < c->taken ? ahead : from].ray]);
        for (int k = 0; k < 3; k++) {
            least[k] = j->direction[k] < v->least[k] ? j->direction[k] : v->least[k];
            most[k] = j->direction[k] > v->most[k] ? j->direction[k] : v->most[k];
            close &= most[k] - least[k] <= breadth;
        }
        if (!close)
            break;
        for (int k = 0; k < 3; k++) {
            v->direction[k][count] = j->direction[k];
            v->least[k] = least[k];
            v->most[k] = most[k];
        }
        __builtin_prefetch(&c->rays[number].origin); /* for the answer */
        __builtin_prefetch(&c->rays[number].t_max);
        v->first[count] = j->first;
        v->last[count] = j->last;
        v->low[count] = INFINITY;
        v->high[count] = j->last + 2 * SP_BVH_PAD;
        v->triangle[count] = SP_NONE;
        v->skip[count] = j->skip;
        v->ray[count] = number;
    }
    for (int i = count; i < (count + 7) / 8 * 8; i++) { /* idle lanes repeat the first */
        for (int k = 0; k < 3; k++)
            v->direction[k][i] = v->direction[k][0];
        v->high[i] = -1;
    }
    v->count = count;
    v->met = 0;
    return (size_t)count;
}

/* The answers: `hits`, or where that is NULL `occluded`. */
static void answer(const sp_parabola_packet *v, sp_instructions instructions, sp_hit *hits, bool *occluded)
{
    static void (*const kernels[])(const sp_parabola_pairs *, sp_hit *) = SP_KERNELS(sp_parabola_hits);
    sp_parabola_pairs pairs = {.bvh = v->bvh, .acceleration = v->acceleration, .rays = v->rays};
    for (int i = 0; i < v->count; i++) {
        uint32_t ray = v->ray[i], triangle = v->triangle[i];
        if (!hits) {
            occluded[ray] = triangle != SP_NONE;
        } else if (triangle == SP_NONE) {
            hits[ray] = (sp_hit){INFINITY, 0, 0, SP_NONE};
        } else {
            sp_bvh_prefetch_corners(v->bvh, triangle);
            pairs.ray[pairs.count] = ray;
            pairs.triangle[pairs.count++] = triangle;
        }
    }
    if (pairs.count)
        kernels[instructions](&pairs, hits);
}

static size_t leave_all(size_t count, uint32_t *left)
{
    for (size_t i = 0; i < count; i++)
        left[i] = (uint32_t)i;
    return count;
}

static void search_all(const common_origin *c, sp_instructions instructions, sp_parabola_packet *packet, sp_hit *hits,
                       bool *occluded, uint32_t *left, size_t *others)
{
    static void (*const searches[])(sp_parabola_packet *) = SP_KERNELS(sp_parabola_packet_search);
    int rests = 0, rest = REST_LEAST;
    for (size_t i = 0; i < c->taken;) {
        i += fill(c, i, packet);
        if (packet->count < LEAST || rests > 0) {
            for (int k = 0; k < packet->count; k++)
                left[(*others)++] = packet->ray[k];
            rests -= rests > 0;
            continue;
        }
        searches[instructions](packet);
        answer(packet, instructions, hits, occluded);
        if (packet->met > SPARSE * packet->count) {
            rests = rest;
            rest = rest < REST_MOST ? 2 * rest : rest;
        } else {
            rest = REST_LEAST;
        }
    }
}

size_t sp_parabola_packets_trace(const sp_bvh *bvh, sp_instructions instructions, const sp_ray *rays, size_t count,
                                 const sp_acceleration *acceleration, sp_hit *hits, bool *occluded, uint32_t *left)
{
    common_origin c = {.bvh = bvh, .rays = rays, .count = count};
    if (bvh->node_count == 0 || count == 0 || !begin(&c, acceleration))
        return leave_all(count, left);
    c.scaled = malloc(count * sizeof *c.scaled);
    c.order[0] = malloc(count * sizeof *c.order[0]);
    c.order[1] = malloc(count * sizeof *c.order[1]);
    size_t others = 0;
    if (c.scaled && c.order[0] && c.order[1]) {
        others = read_rays(&c, left);
        sp_parabola_packet packet = {
            .bvh = bvh, .rays = rays, .acceleration = acceleration, .rate = c.rate, .any = !hits};
        packet.steep = c.steep;
        packet.bend = c.bend;
        for (int k = 0; k < 3; k++)
            packet.origin[k] = c.origin[k];
        search_all(&c, instructions, &packet, hits, occluded, left, &others);
    } else {
        others = leave_all(count, left);
    }
    free(c.scaled);
    free(c.order[0]);
    free(c.order[1]);
    assert(others <= count);
    return others;
}
