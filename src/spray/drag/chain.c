#include "chain.h"

#include <assert.h>

#define JOINED 0.1     /* of a piece: a last one shorter than that belongs to the one before */
#define MARCH 1e-6     /* the error of a leg */
#define STRAIGHT 2e-5  /* of how far a drop has come, that a piece may miss its parabola by */
#define PIECES_MOST 16 /* of a leg */
#define LEGS_MOST 100000
#define OVERLAP 1e-9 /* of a piece, that it goes on beyond its end: nothing slips between two */

sp_chain sp_chain_of(const sp_wavefronts *fronts, sp_vec3 from, const sp_flight *flight)
{
    double sine = sp_dot(flight->direction, fronts->up);
    sp_vec3 level = sp_along(flight->direction, -sine, fronts->up);
    double cosine = sp_length(level);
    sp_chain chain = {.fronts = fronts,
                      .from = from,
                      .level = sp_unit(level),
                      .sine = sine,
                      .cosine = cosine,
                      .time = flight->time,
                      .at = from};
    sp_wavefront_polynomials(fronts, atan2(sine, cosine), chain.polynomials);
    return chain;
}

static sp_vec3 place_of(const sp_chain *chain, sp_wavefront_place at)
{
    return sp_along(sp_along(chain->from, at.q * chain->cosine, chain->level), at.q * chain->sine + at.d,
                    chain->fronts->up);
}

static sp_vec3 place_at(const sp_chain *chain, double time)
{
    return place_of(chain, sp_wavefront_place_between(chain->fronts, time, chain->polynomials));
}

bool sp_chain_next(sp_chain *chain, sp_arc_piece *piece)
{
    const sp_wavefronts *fronts = chain->fronts;
    const double *joints = fronts->joints;
    size_t i = chain->next;
    if (i == fronts->joint_count || joints[i] >= chain->time)
        return false;
    double start = joints[i], end = i + 1 < fronts->joint_count ? joints[i + 1] : INFINITY;
    piece->last = !(end < chain->time - JOINED * (end - start));
    end = piece->last ? chain->time : end;
    assert(start < end);
    sp_vec3 place[3] = {chain->at, place_at(chain, 0.5 * (start + end)), place_at(chain, end)};
    piece->ray = sp_parabola_through(place, end - start, &piece->acceleration);
    if (!piece->last)
        piece->ray.t_max *= 1 + OVERLAP;
    piece->start = start;
    chain->at = place[2];
    chain->next = piece->last ? fronts->joint_count : i + 1;
    return true;
}

/* How many pieces a leg is cut into of a flight from `start`. */
static int count_pieces(const sp_leg *leg, sp_vec3 start)
{
    if (isinf(leg->time))
        return 1;
    sp_vec3 place[3] = {leg->from.point, sp_leg_at(leg, 0.5 * leg->time).point, leg->to.point};
    double misses = sp_parabola_misses(place, sp_leg_at(leg, 0.25 * leg->time).point);
    double come = fmax(sp_distance(place[2], start), sp_distance(place[2], place[0]));
    double share = misses / (STRAIGHT * come);
    return share > 1 ? (int)fmin(ceil(cbrt(share)), PIECES_MOST) : 1;
}

static sp_arc_piece piece_of(const sp_leg *leg, int i, int count)
{
    if (isinf(leg->time))
        return (sp_arc_piece){.ray = {leg->from.point, leg->from.velocity, 0, INFINITY, SP_NONE}};
    double time = leg->time / count;
    sp_arc_piece piece = {.start = i * time};
    sp_vec3 place[3] = {sp_leg_at(leg, i * time).point, sp_leg_at(leg, (i + 0.5) * time).point,
                        i + 1 < count ? sp_leg_at(leg, (i + 1) * time).point : leg->to.point};
    piece.ray = sp_parabola_through(place, time, &piece.acceleration);
    piece.ray.t_max *= 1 + OVERLAP;
    return piece;
}

/* Whether a drop that has come to a moment can meet nothing in the box any more: on either side it moves away from it,
 * and nothing pulls it back. */
static bool has_left(const sp_drag_state *now, sp_vec3 gravity, const sp_vec3 box[2])
{
    const double at[3] = {now->point.x, now->point.y, now->point.z};
    const double speed[3] = {now->velocity.x, now->velocity.y, now->velocity.z};
    const double acceleration[3] = {gravity.x, gravity.y, gravity.z};
    const double low[3] = {box[0].x, box[0].y, box[0].z}, high[3] = {box[1].x, box[1].y, box[1].z};
    for (int i = 0; i < 3; i++)
        if ((at[i] < low[i] && speed[i] <= 0 && acceleration[i] <= 0) ||
            (at[i] > high[i] && speed[i] >= 0 && acceleration[i] >= 0))
            return true;
    return false;
}

static bool has_left_all(const sp_obstacle *obstacles, int count, const sp_drag_state *now, sp_vec3 gravity)
{
    for (int i = 0; i < count; i++) {
        sp_drag_state seen = *now;
        seen.point = sp_sub(seen.point, obstacles[i].offset);
        if (!has_left(&seen, gravity, obstacles[i].box))
            return false;
    }
    return true;
}

/* What a piece meets first. */
static sp_hit meet(const sp_obstacle *obstacles, int count, const sp_arc_piece *piece, int *obstacle)
{
    sp_hit first = {.t = INFINITY, .triangle = SP_NONE};
    for (int i = 0; i < count; i++) {
        sp_ray ray = piece->ray;
        ray.origin = sp_sub(ray.origin, obstacles[i].offset);
        ray.skip = obstacles[i].skip;
        sp_hit hit = sp_trace_nearest(obstacles[i].tracer, &ray, piece->acceleration);
        if (hit.triangle == SP_NONE || hit.t >= first.t)
            continue;
        first = hit;
        *obstacle = i;
    }
    return first;
}

sp_landing sp_drag_trace(const sp_obstacle *obstacles, int obstacle_count, const sp_drag *drag, const sp_ray *ray,
                         sp_vec3 gravity)
{
    sp_landing landing = {.hit = {.t = INFINITY, .triangle = SP_NONE}};
    sp_march march = sp_march_from(drag, gravity, ray->origin, ray->velocity);
    for (int legs = 0; legs < LEGS_MOST && !has_left_all(obstacles, obstacle_count, &march.now, gravity); legs++) {
        double start = march.flown;
        sp_leg leg = sp_march_on(&march, MARCH);
        int count = count_pieces(&leg, ray->origin);
        bool falls = isinf(leg.time) && sp_length(gravity) > 0;
        for (int i = 0; i < count && (falls || isfinite(leg.time)); i++) {
            sp_arc_piece piece = piece_of(&leg, i, count);
            piece.ray.t_min = fmax(0, ray->t_min - (start + piece.start));
            landing.hit = meet(obstacles, obstacle_count, &piece, &landing.obstacle);
            if (landing.hit.triangle == SP_NONE)
                continue;
            double t = piece.start + landing.hit.t;
            landing.piece = piece;
            landing.velocity = sp_leg_at(&leg, t).velocity;
            landing.time = start + t;
            return landing;
        }
        if (isinf(leg.time)) /* fallen out, or at rest */
            break;
    }
    return landing;
}

void sp_drag_trace_many(const sp_tracer *tracer, const sp_drag *drag, const sp_ray *rays, size_t count, sp_vec3 gravity,
                        int threads, sp_landing *landings)
{
    sp_vec3 box[2];
    sp_mesh_box(sp_tracer_mesh(tracer), &box[0], &box[1]);
#pragma omp parallel for schedule(dynamic, 256) num_threads(threads)
    for (size_t i = 0; i < count; i++) {
        sp_obstacle obstacle = {.tracer = tracer, .box = box, .skip = rays[i].skip};
        landings[i] = sp_drag_trace(&obstacle, 1, drag, &rays[i], gravity);
    }
}
