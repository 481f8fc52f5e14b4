/* The wide hierarchy as a data structure: it holds every triangle once, in boxes that enclose it, and does not depend
 * on how many threads built it. */
#include "shapes.h"

#include "trace/bvh/bvh.h"

#ifdef SPRAYPLAN_SANITIZE
enum { BALL = 200 };
#else
enum { BALL = 600 };
#endif

static sp_bvh build(const sp_mesh *mesh, int threads)
{
    sp_bvh bvh;
    assert_true(sp_bvh_build(mesh, threads, &bvh));
    return bvh;
}

/* Checks what hangs below a node, all of it within low..high (m); counts each triangle's leaves. Returns the depth. */
static int check_below(const sp_bvh *bvh, uint32_t child, const double low[3], const double high[3], uint8_t *seen)
{
    int deepest = 0;
    if (child & SP_BVH_LEAF) {
        assert_true(child - SP_BVH_LEAF < bvh->block_count);
        const sp_bvh_block *block = &bvh->blocks[child - SP_BVH_LEAF];
        assert_int_not_equal(block->triangle[0], SP_NONE);
        for (int i = 0; i < SP_BVH_WIDTH; i++) {
            bool used = block->triangle[i] != SP_NONE;
            sp_corners corners;
            if (used) {
                seen[block->triangle[i]]++;
                sp_bvh_corners(bvh, block->triangle[i], corners);
            }
            for (int k = 0; k < 9; k++) {
                double p = block->corner[k / 3][k % 3][i];
                assert_true(used ? fabs(p / bvh->scale + bvh->centre[k % 3] - corners[k / 3][k % 3]) * bvh->scale <=
                                       0x1p-24
                                 : isnan(p));
                assert_true(!used || (corners[k / 3][k % 3] > low[k % 3] && corners[k / 3][k % 3] < high[k % 3]));
            }
        }
        return 0;
    }
    assert_true(child < bvh->node_count);
    const sp_bvh_node *node = &bvh->nodes[child];
    assert_true(node->count >= 1 && node->count <= SP_BVH_WIDTH);
    for (uint32_t i = 0; i < node->count; i++) {
        double child_low[3], child_high[3];
        sp_bvh_child_box(bvh, node, i, child_low, child_high);
        for (int axis = 0; axis < 3; axis++) {
            child_low[axis] = fmax(child_low[axis], low[axis]);
            child_high[axis] = fmin(child_high[axis], high[axis]);
        }
        int depth = check_below(bvh, node->child[i], child_low, child_high, seen);
        deepest = depth > deepest ? depth : deepest;
    }
    return deepest + 1;
}

static void check(const sp_mesh *mesh)
{
    sp_bvh bvh = build(mesh, 2);
    const double low[3] = {-INFINITY, -INFINITY, -INFINITY}, high[3] = {INFINITY, INFINITY, INFINITY};
    assert_true(mesh->triangle_count > 0);
    uint8_t *seen = calloc(mesh->triangle_count, 1);
    assert_non_null(seen);
    int depth = check_below(&bvh, 0, low, high, seen);
    assert_true(7 * depth + 1 <= SP_BVH_STACK);
    for (size_t t = 0; t < mesh->triangle_count; t++)
        assert_int_equal(seen[t], 1);
    free(seen);
    sp_bvh_clear(&bvh);
}

static void every_triangle_is_in_its_boxes(void **state)
{
    (void)state;
    static const double scales[] = {1e-6, 1, 1e6, 1e25, 1e-70};
    for (int i = 0; i < 5; i++) {
        sp_vec3 centre = i < 3 ? sp_v(5 * scales[i], 0, -1000 * scales[i]) : sp_v(0, 0, 0);
        sp_mesh *mesh = make_ball(60, centre, scales[i], 0.3);
        check(mesh);
        sp_mesh_destroy(mesh);
    }
}

/* Triangles that shrink towards a corner, each much smaller than the one before, and many in one place: the heuristic
 * alone would make a tree as deep as there are triangles. */
static void trees_do_not_grow_deep(void **state)
{
    (void)state;
    enum { N = 3000 };
    sp_vec3 *points = malloc(3 * N * sizeof *points);
    uint32_t(*triangles)[3] = malloc(N * sizeof *triangles);
    assert_true(points && triangles);
    for (int kind = 0; kind < 2; kind++) {
        for (uint32_t t = 0; t < N; t++) {
            double size = kind ? 1 : pow(0.8, t);
            points[3 * t] = sp_v(size, 0, 0);
            points[3 * t + 1] = sp_v(0, size, 0);
            points[3 * t + 2] = sp_v(0, 0, size);
            memcpy(triangles[t], (uint32_t[]){3 * t, 3 * t + 1, 3 * t + 2}, sizeof *triangles);
        }
        sp_mesh *mesh = make_mesh(points, 3 * N, (const uint32_t(*)[3])triangles, N);
        check(mesh);
        sp_mesh_destroy(mesh);
    }
    free(points);
    free(triangles);
}

static void threads_build_the_same_tree(void **state)
{
    (void)state;
    sp_mesh *mesh = make_ball(BALL, sp_v(1, 2, 3), 4, 0.1); /* of so many that the threads share out its upper nodes */
    sp_bvh one = build(mesh, 1);
    for (int threads = 2; threads <= 5; threads += 3) {
        sp_bvh other = build(mesh, threads);
        assert_int_equal(other.node_count, one.node_count);
        assert_int_equal(other.block_count, one.block_count);
        assert_memory_equal(other.nodes, one.nodes, one.node_count * sizeof *one.nodes);
        assert_memory_equal(other.blocks, one.blocks, one.block_count * sizeof *one.blocks);
        sp_bvh_clear(&other);
    }
    double bytes = (double)(one.node_count * sizeof *one.nodes + one.block_count * sizeof *one.blocks);
    print_message("%.1f bytes a triangle\n", bytes / (double)mesh->triangle_count);
    assert_true(bytes <= 72 * (double)mesh->triangle_count);
    sp_bvh_clear(&one);
    sp_mesh_destroy(mesh);
}

static void boxes_of_leaves_hold_their_triangles(void **state)
{
    (void)state;
    sp_mesh *mesh = make_ball(60, sp_v(1, 2, 3), 4, 0.3);
    sp_bvh bvh = build(mesh, 1);
    double(*boxes)[6] = malloc(bvh.block_count * sizeof *boxes);
    assert_non_null(boxes);
    sp_bvh_leaves(&bvh, boxes);
    for (size_t i = 0; i < bvh.block_count; i++) {
        double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
        for (int k = 0; k < SP_BVH_WIDTH && bvh.blocks[i].triangle[k] != SP_NONE; k++) {
            sp_corners corners;
            sp_bvh_corners(&bvh, bvh.blocks[i].triangle[k], corners);
            for (int n = 0; n < 9; n++) {
                low[n % 3] = fmin(low[n % 3], corners[n / 3][n % 3]);
                high[n % 3] = fmax(high[n % 3], corners[n / 3][n % 3]);
            }
        }
        for (int axis = 0; axis < 3; axis++) { /* tightly: a node's boxes are told in 255 steps of its own */
            assert_true(boxes[i][axis] <= low[axis] && boxes[i][axis] >= low[axis] - 0.1);
            assert_true(boxes[i][3 + axis] >= high[axis] && boxes[i][3 + axis] <= high[axis] + 0.1);
        }
    }
    free(boxes);
    sp_bvh_clear(&bvh);
    sp_mesh_destroy(mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_triangle_is_in_its_boxes),
        cmocka_unit_test(trees_do_not_grow_deep),
        cmocka_unit_test(threads_build_the_same_tree),
        cmocka_unit_test(boxes_of_leaves_hold_their_triangles),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
