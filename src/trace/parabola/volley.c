/* Parabolas of one origin: put in the order of their directions, then traced in volleys of neighbours. */
#include "trace/parabola/volley.h"
#include "trace/bvh/direction_order.h"

#include <stdlib.h>

/* Coordinates up to which flights are followed, some more than the boxes with their padding; the most that speed times
 * way, and bend times way², may be; and the most that a way may be, for its own rounding. */
#define LIMIT 1.015625f
#define FARTHEST 4.0f
#define LONGEST 64.0f

enum {
    LEAST = 4, /* fewer are left over */
    /* Where a volley meets more triangles to a jet than this, its jets are faster by themselves: so many of the volleys
     * that follow are left over, too, before one is tried again, and twice as many each time, but for a limit. */
    SPARSE = 4,
    REST_LEAST = 15,
    REST_MOST = 240,
};
static const float breadth = 0.25f; /* the most that the directions of a volley differ along an axis */

typedef struct {
    float direction[3];
    float first, last;
    uint32_t skip;
} jet;

typedef struct {
    const sp_bvh *bvh;
    const sp_ray *rays;
    size_t count;
    jet *jets;                    /* [count], as the rays */
    sp_direction_entry *order[2]; /* [count] */
    size_t taken;                 /* in order[0]: those that volleys take */
    int steep;
    float origin[3], bend;
    double rate, span; /* power of two, and its inverse */
} sheaf;

void sp_volley_settle(sp_volley *v, int lane, uint32_t triangle)
{
    sp_hit hit = sp_parabola_ask(v->bvh, v->pull, &v->rays[v->ray[lane]], triangle, v->triangle[lane]);
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

/* False where the flight is none that a volley takes. */
static inline bool see_jet(const sheaf *s, const sp_ray *ray, jet *j, uint32_t *key)
{
    double velocity[3];
    float last = INFINITY, amount[3];
    sp_to_array(ray->velocity, velocity);
    for (int k = 0; k < 3; k++) {
        float speed = (float)(velocity[k] * s->bvh->scale * s->span);
        float leave = k == s->steep ? leave_steep(s->origin[k], speed, s->bend) : leave_straight(s->origin[k], speed);
        j->direction[k] = speed;
        last = leave < last ? leave : last;
        amount[k] = fabsf(speed);
    }
    /* without branches, which no processor could foresee */
    float more = amount[1] > amount[0] ? amount[1] : amount[0], fastest = amount[2] > more ? amount[2] : more;
    uint32_t is_z = amount[2] > more, z = 2 * is_z + ((amount[1] > amount[0]) & ~is_z);
    double end = ray->t_max * s->rate;
    last = end < last ? (float)end : last;
    j->first = (float)sp_lesser(ray->t_min * s->rate, 2 * LONGEST);
    j->last = last;
    j->skip = ray->skip;
    if (!(ray->t_min >= 0 && ray->t_max > 0 && last <= LONGEST && fastest * last <= FARTHEST &&
          fabsf(s->bend) * last * last <= FARTHEST && fastest > 0x1p-20f))
        return false;
    float inverse = 1 / fastest;
    *key = sp_direction_key(2 * z + (j->direction[z] < 0), j->direction[z == 2 ? 0 : z + 1] * inverse,
                            j->direction[z == 0 ? 2 : z - 1] * inverse);
    return true;
}

/* Returns how many are left over. */
static size_t read_rays(sheaf *s, uint32_t *left)
{
    size_t others = 0;
    s->taken = 0;
    for (size_t i = 0; i < s->count; i++) {
        uint32_t key;
        if (see_jet(s, &s->rays[i], &s->jets[i], &key))
            s->order[0][s->taken++] = (sp_direction_entry){key, (uint32_t)i};
        else
            left[others++] = (uint32_t)i;
    }
    sp_direction_sort(s->order, s->taken);
    return others;
}

/* What all have in common; false where volleys are not for them. */
static bool begin(sheaf *s, const sp_pull *pull)
{
    const sp_bvh *bvh = s->bvh;
    double origin[3], fastest = 0;
    sp_to_array(s->rays[0].origin, origin);
    for (size_t i = 0; i < s->count; i++) {
        sp_vec3 v = s->rays[i].velocity;
        fastest = sp_greater(fastest, sp_greater(fabs(v.x), sp_greater(fabs(v.y), fabs(v.z))));
    }
    fastest *= bvh->scale;
    if (!(fastest > 1e-100 && fastest < 1e100))
        return false;
    s->rate = sp_bvh_power_above(fastest, &s->span);
    s->steep = pull->vector[0] != 0 ? 0 : pull->vector[1] != 0 ? 1 : 2;
    for (int k = 0; k < 3; k++) {
        double place = (origin[k] - bvh->centre[k]) * bvh->scale;
        if (!(fabs(place) < LIMIT) || (k != s->steep && pull->vector[k] != 0))
            return false;
        s->origin[k] = (float)place;
    }
    s->bend = (float)(0.5 * pull->vector[s->steep] * bvh->scale * s->span * s->span);
    return fabsf(s->bend) > 1e-30f && fabsf(s->bend) < 1e3f;
}

/* Puts the next jets into a volley; returns how many. */
static size_t fill(const sheaf *s, size_t from, sp_volley *v)
{
    int count = 0;
    for (int k = 0; k < 3; k++) {
        v->least[k] = INFINITY;
        v->most[k] = -INFINITY;
    }
    for (; count < SP_VOLLEY && from + (size_t)count < s->taken; count++) {
        uint32_t number = s->order[0][from + (size_t)count].ray;
        const jet *j = &s->jets[number];
        size_t ahead = from + (size_t)count + SP_VOLLEY;
        float least[3], most[3];
        bool close = true;
        __builtin_prefetch(&s->jets[s->order[0][ahead < s->taken ? ahead : from].ray]);
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
        __builtin_prefetch(&s->rays[number].origin); /* for the answer */
        __builtin_prefetch(&s->rays[number].t_max);
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
static void answer(const sp_volley *v, sp_instructions instructions, sp_hit *hits, bool *occluded)
{
    static void (*const kernels[])(const sp_parabola_pairs *, sp_hit *) = SP_KERNELS(sp_parabola_hits);
    sp_parabola_pairs pairs = {.bvh = v->bvh, .pull = v->pull, .rays = v->rays};
    for (int i = 0; i < v->count; i++) {
        uint32_t ray = v->ray[i], triangle = v->triangle[i];
        if (!hits) {
            occluded[ray] = triangle != SP_NONE;
        } else if (triangle == SP_NONE) {
            hits[ray] = (sp_hit){INFINITY, 0, 0, SP_NONE};
        } else {
            sp_bvh_fetch_corners(v->bvh, triangle);
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

static void search_all(const sheaf *s, sp_instructions instructions, sp_volley *volley, sp_hit *hits, bool *occluded,
                       uint32_t *left, size_t *others)
{
    static void (*const searches[])(sp_volley *) = SP_KERNELS(sp_volley_search);
    int rests = 0, rest = REST_LEAST;
    for (size_t i = 0; i < s->taken;) {
        i += fill(s, i, volley);
        if (volley->count < LEAST || rests > 0) {
            for (int k = 0; k < volley->count; k++)
                left[(*others)++] = volley->ray[k];
            rests -= rests > 0;
            continue;
        }
        searches[instructions](volley);
        answer(volley, instructions, hits, occluded);
        if (volley->met > SPARSE * volley->count) {
            rests = rest;
            rest = rest < REST_MOST ? 2 * rest : rest;
        } else {
            rest = REST_LEAST;
        }
    }
}

size_t sp_volleys_trace(const sp_bvh *bvh, sp_instructions instructions, const sp_ray *rays, size_t count,
                        const sp_pull *pull, sp_hit *hits, bool *occluded, uint32_t *left)
{
    sheaf s = {.bvh = bvh, .rays = rays, .count = count};
    if (bvh->node_count == 0 || count == 0 || !begin(&s, pull))
        return leave_all(count, left);
    s.jets = malloc(count * sizeof *s.jets);
    s.order[0] = malloc(count * sizeof *s.order[0]);
    s.order[1] = malloc(count * sizeof *s.order[1]);
    size_t others = 0;
    if (s.jets && s.order[0] && s.order[1]) {
        others = read_rays(&s, left);
        sp_volley volley = {.bvh = bvh, .rays = rays, .pull = pull, .rate = s.rate, .any = !hits};
        volley.steep = s.steep;
        volley.bend = s.bend;
        for (int k = 0; k < 3; k++)
            volley.origin[k] = s.origin[k];
        search_all(&s, instructions, &volley, hits, occluded, left, &others);
    } else {
        others = leave_all(count, left);
    }
    free(s.jets);
    free(s.order[0]);
    free(s.order[1]);
    return others;
}
