/* What single precision leaves out, double precision does not hit; what it takes for sure, double precision does. */
#include "shapes.h"

#include "trace/parabola/parabola_bvh.h"

#define SP_KERNEL(name) name##_tested
void sp_bvh_parabolas_tested(sp_parabola_queue *queue, sp_parabola_flight *flights, int most);
#include "trace/parabola/parabola_kernel.h"

#ifdef SPRAYPLAN_SANITIZE
enum { RAYS = 400 };
#else
enum { RAYS = 6000 };
#endif

enum { COUNT = 300 };

static const double scales[] = {1e-6, 1e-3, 1, 1e3, 1e6};

/* Where a node or block hangs: on which child of which node; the root on none. */
typedef struct {
    uint32_t node;
    int child;
} place;

typedef struct {
    sp_mesh *mesh;
    sp_bvh bvh;
    place node_place[COUNT], block_place[COUNT];
    uint32_t block[COUNT]; /* of a triangle */
    double scale;
    sp_vec3 offset;
} world;

/* What was looked at, so that no check is empty. */
typedef struct {
    size_t pieces, far, hits, sure, starts;
} tally;

static void note_places(world *w, uint32_t node)
{
    for (uint32_t i = 0; i < w->bvh.nodes[node].count; i++) {
        uint32_t child = w->bvh.nodes[node].child[i];
        if (child & SP_BVH_LEAF) {
            w->block_place[child - SP_BVH_LEAF] = (place){node, (int)i};
            for (int slot = 0; slot < SP_BVH_WIDTH; slot++) {
                uint32_t triangle = w->bvh.blocks[child - SP_BVH_LEAF].triangle[slot];
                if (triangle != SP_NONE)
                    w->block[triangle] = child - SP_BVH_LEAF;
            }
        } else {
            w->node_place[child] = (place){node, (int)i};
            note_places(w, child);
        }
    }
}

static void make_world(world *w, random_source *source, double scale, bool off)
{
    static sp_vec3 points[3 * COUNT];
    static uint32_t triangles[COUNT][3];
    w->scale = scale;
    w->offset = off ? sp_v(100 * scale, -30 * scale, 7 * scale) : sp_v(0, 0, 0);
    for (uint32_t t = 0; t < COUNT; t++) {
        double size = pow(10, draw(source, -3.5, 0)), thin = draw(source, 0, 1) < 0.3 ? 1e-3 : 1;
        sp_vec3 p = draw_point(source, 1), a = draw_point(source, size), b = draw_point(source, size * thin);
        if (t % 5 == 0)
            a.z = b.z = 0;
        if (t % 7 == 0)
            a.x = b.x = 0;
        sp_vec3 corners[3] = {p, sp_add(p, a), sp_add(p, b)};
        for (uint32_t i = 0; i < 3; i++) {
            points[3 * t + i] = sp_along(w->offset, scale, corners[i]);
            triangles[t][i] = 3 * t + i;
        }
    }
    w->mesh = make_mesh(points, 3 * COUNT, (const uint32_t(*)[3])triangles, COUNT);
    assert_true(sp_bvh_build(w->mesh, 1, &w->bvh));
    assert_true(w->bvh.node_count <= COUNT && w->bvh.block_count <= COUNT);
    w->node_place[0] = (place){SP_NONE, 0};
    note_places(w, 0);
}

/* A flight through a point of a triangle, a corner or the inside, from near or far, at any speed and acceleration,
 * often level or upright where it meets it, or with a coordinate that does not change. */
static sp_ray draw_flight(random_source *source, const world *w, sp_vec3 *gravity)
{
    static const sp_vec3 along[] = {{0, 0, -1}, {0, 0, -1}, {0, 1, 0}, {-1, 0, 0}, {0.6, -0.48, 0.64}, {1e-9, 0, -1}};
    uint32_t triangle = (uint32_t)draw(source, 0, (double)w->mesh->triangle_count);
    double kind = draw(source, 0, 1), u = draw(source, 0, 1), time = pow(10, draw(source, -4, 3));
    sp_vec3 target = sp_triangle_point(w->mesh, triangle, kind < 0.3 ? 0 : u, kind < 0.5 ? 0 : draw(source, 0, 1 - u));
    double length = w->scale * pow(10, draw(source, -2, draw(source, 0, 1) < 0.2 ? 4 : 0.5));
    sp_vec3 velocity = sp_scale(draw_point(source, 1), length / time); /* when it is there */
    kind = draw(source, 0, 1);
    *gravity = sp_scale(along[(int)draw(source, 0, 6)], length / (time * time) * pow(10, draw(source, -6, 1)));
    if (kind < 0.2)
        velocity = sp_along(velocity, -sp_dot(velocity, *gravity) / sp_dot(*gravity, *gravity), *gravity);
    else if (kind < 0.3)
        velocity = sp_scale(*gravity, time * draw(source, -1, 1));
    else if (kind < 0.4)
        velocity.x = 0;
    else if (kind < 0.45)
        velocity = sp_along(sp_scale(*gravity, time * draw(source, -1, 1)), 1e-9, velocity);
    sp_vec3 origin = sp_along(sp_along(target, -time, velocity), 0.5 * time * time, *gravity);
    sp_ray ray = make_ray(origin, sp_along(velocity, -time, *gravity));
    kind = draw(source, 0, 1);
    if (kind < 0.2)
        ray.t_max = time * (1 + 1e-7 * draw(source, -1, 1));
    if (kind > 0.1 && kind < 0.3)
        ray.t_min = time * draw(source, -1, 1);
    return ray;
}

/* That the path to a triangle's block is taken, and the triangle there. */
static void check_path(const world *w, const sp_parabola_flight *flight, uint32_t triangle, double t, double last)
{
    float way = (float)((t - flight->arc.start) * flight->arc.rate), slack = 0x1p-18f;
    wide from, to;
    float first_way[8], last_way[8];
    place at = w->block_place[w->block[triangle]];
    for (int level = 0; at.node != SP_NONE; level++, at = w->node_place[at.node]) {
        enter_children(&w->bvh.nodes[at.node], &flight->arc, flight->arc.aligned, &from, &to);
        wide_store(first_way, from);
        wide_store(last_way, to);
        uint32_t mask = wide_at_most(from, to);
        if (!(mask >> at.child & 1) || !(first_way[at.child] <= way + slack && last_way[at.child] >= way - slack))
            fail_msg("triangle %u at %.17g (way %.9g of %.9g) is left out %d above its block: %s %.9g..%.9g", triangle,
                     t, way, last, level, mask >> at.child & 1 ? "in" : "out", first_way[at.child], last_way[at.child]);
        if (level > 0)
            continue;
        const sp_bvh_block *block = &w->bvh.blocks[w->block[triangle]];
        chord c = chord_of(&flight->arc, first_way[at.child], last_way[at.child]);
        verdict found;
        test_block(block, &c, &found);
        bool maybe = false;
        for (int slot = 0; slot < SP_BVH_WIDTH; slot++)
            maybe |= block->triangle[slot] == triangle && found.maybe >> slot & 1;
        if (!maybe)
            fail_msg("triangle %u at %.17g is left out of its block", triangle, t);
    }
}

/* That what is taken for sure within the piece is hit, and when it says. */
static void check_sure(const world *w, const sp_parabola_flight *flight, const double times[COUNT], tally *seen)
{
    const sp_bvh_arc *arc = &flight->arc;
    for (uint32_t b = 0; b < w->bvh.block_count; b++) {
        const sp_bvh_block *block = &w->bvh.blocks[b];
        place at = w->block_place[b];
        float first_way[8], last_way[8];
        wide from, to;
        enter_children(&w->bvh.nodes[at.node], &flight->arc, flight->arc.aligned, &from, &to);
        wide_store(first_way, from);
        wide_store(last_way, to);
        if (!(wide_at_most(from, to) >> at.child & 1))
            continue;
        chord c = chord_of(&flight->arc, first_way[at.child], last_way[at.child]);
        verdict found;
        test_block(block, &c, &found);
        for (int slot = 0; slot < SP_BVH_WIDTH; slot++) {
            float low = found.low[slot], high = found.high[slot];
            if (!(found.surely >> slot & 1) || low < arc->surely_first || high > arc->surely_last)
                continue;
            seen->sure++;
            double t = times[block->triangle[slot]], way = (t - arc->start) * arc->rate;
            if (!(t < INFINITY))
                fail_msg("triangle %u is not hit", block->triangle[slot]);
            /* an earlier piece may have hit it before */
            if (way > 0 && !(way >= low && way <= high))
                fail_msg("triangle %u is hit at way %.9g, not %.9g..%.9g", block->triangle[slot], way, low, high);
        }
    }
}

/* But for the signs of zeros. */
static bool same_arcs(const sp_bvh_arc *a, const sp_bvh_arc *b)
{
    bool same = a->sign == b->sign && a->aligned == b->aligned && a->sag == b->sag && a->last == b->last &&
                a->diagonal == b->diagonal && a->surely_first == b->surely_first && a->surely_last == b->surely_last &&
                a->start == b->start && a->rate == b->rate;
    for (int k = 0; k < 3; k++)
        same &= a->origin[k] == b->origin[k] && a->direction[k] == b->direction[k] && a->bend[k] == b->bend[k] &&
                a->axis[k] == b->axis[k] && a->near[k] == b->near[k] && a->far[k] == b->far[k] &&
                a->inverse[k] == b->inverse[k] && a->sooner[k] == b->sooner[k] && a->later[k] == b->later[k];
    return same;
}

/* That flights prepared many at a time begin as those that are prepared singly. */
static void check_start(const world *w, const sp_ray *ray, const sp_acceleration *acceleration, tally *seen)
{
    static void (*const prepares[])(const sp_parabola_queue *, sp_bvh_starts *) = {
        sp_bvh_prepare_starts_portable, sp_bvh_prepare_starts_avx2, sp_bvh_prepare_starts_avx512};
    static sp_parabola_flight flight;
    sp_ray_search search = sp_ray_search_start(ray, false);
    sp_parabola parabola;
    double from = search.t_min, last = search.limit;
    flight.asked = ray;
    sp_bvh_fitness fitness = sp_parabola_flight_prepare(&w->bvh, acceleration, &flight, &from, &last);
    if ((acceleration->vector[0] != 0) + (acceleration->vector[1] != 0) + (acceleration->vector[2] != 0) != 1)
        return;
    if (fitness != SP_BVH_READY || !sp_parabola_start(&parabola, ray, acceleration, w->bvh.low, w->bvh.high))
        return;
    double to = sp_parabola_turn(&parabola, from, last);
    fitness = sp_bvh_arc_prepare(acceleration, &flight, from, to);
    for (int set = 0; set < SP_INSTRUCTIONS_COUNT; set++) {
        if (!sp_instructions_available((sp_instructions)set))
            continue;
        static sp_parabola_queue queue;
        sp_bvh_arc arc;
        queue = (sp_parabola_queue){.bvh = &w->bvh, .acceleration = acceleration, .rays = ray, .aligned = true};
        queue.axis[0] = acceleration->vector[0] != 0 ? 0 : acceleration->vector[1] != 0 ? 1 : 2;
        queue.axis[1] = queue.axis[0] == 2 ? 0 : queue.axis[0] + 1;
        queue.axis[2] = queue.axis[0] == 0 ? 2 : queue.axis[0] - 1;
        queue.starts.count = 1;
        prepares[set](&queue, &queue.starts);
        assert_true(queue.starts.fits[0] == SP_BVH_FAR || queue.starts.fits[0] == fitness);
        if (queue.starts.fits[0] != SP_BVH_READY)
            continue;
        sp_bvh_start_take(&queue, 0, &arc);
        assert_true(queue.starts.to[0] == to && queue.starts.end[0] == last && queue.starts.later[0] == (to < last));
        assert_true(same_arcs(&arc, &flight.arc));
        seen->starts++;
    }
}

static void check_flight(const world *w, const sp_ray *ray, sp_vec3 gravity, tally *seen)
{
    sp_acceleration acceleration = sp_acceleration_of(gravity);
    sp_ray_search search = sp_ray_search_start(ray, false);
    static sp_parabola_flight flight;
    flight.asked = ray;
    double from = search.t_min, last = search.limit, times[COUNT];
    sp_parabola parabola;
    assert_true(sp_parabola_start(&parabola, ray, &acceleration, w->bvh.low, w->bvh.high));
    for (uint32_t t = 0; t < w->mesh->triangle_count; t++) {
        sp_ray_search single = search;
        sp_corners corners;
        sp_bvh_corners(&w->bvh, t, corners);
        sp_parabola_test(&parabola, (const double(*)[3])corners, t, &single);
        times[t] = single.best.t;
    }
    sp_bvh_fitness fitness = sp_parabola_flight_prepare(&w->bvh, &acceleration, &flight, &from, &last);
    for (uint32_t t = 0; t < w->mesh->triangle_count && fitness != SP_BVH_FAR; t++)
        assert_true(times[t] == INFINITY || (fitness == SP_BVH_READY && times[t] >= from && times[t] <= last));
    while (fitness != SP_BVH_FAR && from <= last) {
        double to = sp_parabola_turn(&parabola, from, last);
        fitness = sp_bvh_arc_prepare(&acceleration, &flight, from, to);
        seen->pieces++;
        for (uint32_t t = 0; t < w->mesh->triangle_count && fitness != SP_BVH_FAR; t++) {
            if (!(times[t] >= from && times[t] <= to))
                continue;
            seen->hits++;
            assert_int_equal(fitness, SP_BVH_READY);
            check_path(w, &flight, t, times[t], flight.arc.last);
        }
        if (fitness == SP_BVH_READY)
            check_sure(w, &flight, times, seen);
        if (!(to < last))
            break;
        from = to;
    }
    seen->far += fitness == SP_BVH_FAR;
}

static void nothing_hit_is_left_out(void **state)
{
    (void)state;
    random_source source = {31};
    static world w;
    tally seen = {0};
    for (int i = 0; i < 10; i++) {
        make_world(&w, &source, scales[i % 5], i >= 5);
        for (int k = 0; k < RAYS; k++) {
            sp_vec3 gravity;
            sp_ray ray = draw_flight(&source, &w, &gravity);
            check_flight(&w, &ray, gravity, &seen);
            sp_acceleration acceleration = sp_acceleration_of(gravity);
            check_start(&w, &ray, &acceleration, &seen);
        }
        sp_bvh_clear(&w.bvh);
        sp_mesh_destroy(w.mesh);
    }
    print_message("%zu pieces, %zu of them far, %zu hits, %zu sure, %zu starts\n", seen.pieces, seen.far, seen.hits,
                  seen.sure, seen.starts);
    assert_true(seen.starts > 5 * RAYS && seen.hits > 5 * RAYS && seen.sure > RAYS && seen.far < seen.pieces / 20);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nothing_hit_is_left_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
