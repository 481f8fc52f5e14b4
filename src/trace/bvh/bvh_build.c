/* Building: ranges of triangles are divided until a node has eight children, the one of the largest surface next, and
 * so on down to leaves of at most eight triangles. The upper nodes are built one after another, each by all threads;
 * subtrees of at most TASK triangles by one thread each, into arrays of their own that are then put one after
 * another in a fixed order. */
#include "trace/bvh/bvh.h"
#include "trace/bvh/bvh_pages.h"
#include "trace/bvh/bvh_split.h"

#include <assert.h>
#include <omp.h>
#include <stdlib.h>
#include <string.h>

enum {
    TASK = 1 << 16,
    CHUNK = 1 << 14, /* triangles that one thread takes at a time before there are ranges */
    DEEP = 24,       /* from this depth on ranges are halved, which takes at most 12 levels more */
    BLOCKS_ROOM = 2, /* memory set aside for the blocks, in references a triangle: enough for five triangles a leaf */
    AHEAD = 4,       /* how many leaves ahead triangles are prefetched */
    UPPER = 0x40000000, /* marks a child of an upper node that is task number so and so */
};

/* A leaf to be: where its triangles are in the first buffer. */
typedef struct {
    uint32_t first, count;
} leaf;

/* A part of the tree in the making; children are numbered within it. */
typedef struct {
    sp_bvh_node *nodes;
    leaf *leaves;
    size_t node_count, node_room, leaf_count, leaf_room;
} part;

typedef struct {
    sp_bvh_range range;
    int depth;
} task;

typedef struct {
    sp_bvh_reference *buffers[2]; /* [triangle_count], [BLOCKS_ROOM triangle_count] */
    int threads;
    part upper;
    task *tasks; /* [task_count], in the order of their places in the tree */
    part *parts; /* [task_count] */
    size_t task_count, task_room;
} builder;

static bool make_room(void **items, size_t *room, size_t used, size_t size)
{
    if (used < *room)
        return true;
    size_t more = *room ? 2 * *room : 64;
    void *larger = more < UPPER ? realloc(*items, more * size) : NULL;
    if (!larger)
        return false;
    *items = larger;
    *room = more;
    return true;
}

static bool add_node(part *p, uint32_t *number)
{
    void *items = p->nodes;
    bool good = make_room(&items, &p->node_room, p->node_count, sizeof *p->nodes);
    p->nodes = items;
    if (good)
        *number = (uint32_t)p->node_count++;
    return good;
}

/* Its references go to the first buffer if they are not there, as the second one is to hold the blocks. */
static bool add_leaf(const builder *b, part *p, const sp_bvh_range *range, uint32_t *number)
{
    void *items = p->leaves;
    bool good = make_room(&items, &p->leaf_room, p->leaf_count, sizeof *p->leaves);
    p->leaves = items;
    if (good) {
        *number = (uint32_t)p->leaf_count;
        p->leaves[p->leaf_count++] = (leaf){(uint32_t)range->first, (uint32_t)range->count};
        if (range->buffer == 1)
            memcpy(b->buffers[0] + range->first, b->buffers[1] + range->first, range->count * sizeof **b->buffers);
    }
    return good;
}

static bool add_task(builder *b, const sp_bvh_range *range, int depth, uint32_t *number)
{
    void *items = b->tasks;
    bool good = make_room(&items, &b->task_room, b->task_count, sizeof *b->tasks);
    b->tasks = items;
    if (good) {
        *number = (uint32_t)b->task_count;
        b->tasks[b->task_count++] = (task){*range, depth};
    }
    return good;
}

/* Which of the children to divide next: the one that is likeliest to be visited; -1 where all are leaves. */
static int choose_child(const sp_bvh_range *children, int count, bool balanced)
{
    int best = -1;
    float most = -1;
    for (int i = 0; i < count; i++) {
        float worth = balanced ? (float)children[i].count : sp_bvh_box_area(&children[i].box);
        if (children[i].count > SP_BVH_WIDTH && worth > most) {
            most = worth;
            best = i;
        }
    }
    return best;
}

/* Divides a range into the children of a node; returns how many, 0 when memory runs out. */
static int make_children(builder *b, const sp_bvh_range *range, int depth, int threads,
                         sp_bvh_range children[SP_BVH_WIDTH])
{
    int count = 1, next;
    bool balanced = depth >= DEEP;
    children[0] = *range;
    while (count < SP_BVH_WIDTH && (next = choose_child(children, count, balanced)) >= 0) {
        sp_bvh_range halves[2];
        if (!sp_bvh_divide(b->buffers, &children[next], balanced, threads, halves))
            return 0;
        assert(halves[0].count > 0 && halves[1].count > 0 && halves[0].count + halves[1].count == children[next].count);
        memmove(children + next + 2, children + next + 1, (size_t)(count - next - 1) * sizeof *children);
        children[next] = halves[0];
        children[next + 1] = halves[1];
        count++;
    }
    return count;
}

/* Children in the order in which a line along a diagonal of space leaves their middles behind, reversed. */
static uint32_t order_children(const sp_bvh_range *children, int count, int diagonal)
{
    float key[SP_BVH_WIDTH];
    int order[SP_BVH_WIDTH];
    uint32_t bits = 0;
    for (int i = 0; i < SP_BVH_WIDTH; i++) {
        int place = i;
        key[i] = INFINITY;
        if (i < count) {
            const sp_bvh_box *box = &children[i].box;
            float y = box->low[1] + box->high[1], z = box->low[2] + box->high[2];
            key[i] = box->low[0] + box->high[0] + (diagonal & 1 ? -y : y) + (diagonal & 2 ? -z : z);
        }
        for (; place > 0 && key[order[place - 1]] < key[i]; place--)
            order[place] = order[place - 1];
        order[place] = i;
    }
    for (int i = 0; i < SP_BVH_WIDTH; i++)
        bits |= (uint32_t)order[i] << 3 * i;
    return bits;
}

/* The children's boxes in steps from the node's corner, rounded outwards. */
static void quantise(sp_bvh_node *node, const sp_bvh_box *box, const sp_bvh_range *children, int count)
{
    memset(node, 0, sizeof *node);
    memset(node->low, 255, sizeof node->low);
    node->count = (uint32_t)count;
    for (int diagonal = 0; diagonal < 4; diagonal++)
        node->order[diagonal] = order_children(children, count, diagonal);
    for (int axis = 0; axis < 3; axis++) {
        double origin = box->low[axis];
        float step = nextafterf((float)((box->high[axis] - origin) / 255), 1);
        node->origin[axis] = box->low[axis];
        node->step[axis] = step;
        for (int i = 0; i < count; i++) {
            double low = floor((children[i].box.low[axis] - origin) / step);
            double high = ceil((children[i].box.high[axis] - origin) / step);
            assert(low >= 0 && low <= high && high <= 255); /* else the child stood out of its parent */
            node->low[axis][i] = (uint8_t)(low > 0 ? low : 0);
            node->high[axis][i] = (uint8_t)(high < 255 ? high : 255);
        }
    }
}

/* Builds the subtree of a range into a part, depth first. */
static bool build_subtree(builder *b, part *p, const sp_bvh_range *range, int depth, uint32_t *number)
{
    sp_bvh_range children[SP_BVH_WIDTH];
    assert((SP_BVH_WIDTH - 1) * (depth + 1) < SP_BVH_STACK); /* what walks have pending */
    int count = make_children(b, range, depth, 1, children);
    if (count == 0 || !add_node(p, number))
        return false;
    quantise(&p->nodes[*number], &range->box, children, count);
    for (int i = 0; i < count; i++) {
        uint32_t child;
        bool is_leaf = children[i].count <= SP_BVH_WIDTH;
        if (!(is_leaf ? add_leaf(b, p, &children[i], &child) : build_subtree(b, p, &children[i], depth + 1, &child)))
            return false;
        p->nodes[*number].child[i] = is_leaf ? child | SP_BVH_LEAF : child;
    }
    return true;
}

/* Builds the nodes over more than TASK triangles, and notes what hangs below as tasks. */
static bool build_upper(builder *b, const sp_bvh_range *range, int depth, uint32_t *number)
{
    if (range->count <= TASK) {
        bool good = add_task(b, range, depth, number);
        *number |= UPPER;
        return good;
    }
    sp_bvh_range children[SP_BVH_WIDTH];
    int count = make_children(b, range, depth, b->threads, children);
    if (count == 0 || !add_node(&b->upper, number))
        return false;
    quantise(&b->upper.nodes[*number], &range->box, children, count);
    for (int i = 0; i < count; i++) {
        uint32_t child;
        bool is_leaf = children[i].count <= SP_BVH_WIDTH;
        if (!(is_leaf ? add_leaf(b, &b->upper, &children[i], &child) : build_upper(b, &children[i], depth + 1, &child)))
            return false;
        b->upper.nodes[*number].child[i] = is_leaf ? child | SP_BVH_LEAF : child;
    }
    return true;
}

static bool build_tasks(builder *b)
{
    b->parts = calloc(b->task_count ? b->task_count : 1, sizeof *b->parts);
    if (!b->parts)
        return false;
    bool good = true;
#pragma omp parallel for schedule(dynamic, 1) num_threads(b->threads) reduction(&& : good)
    for (size_t i = 0; i < b->task_count; i++) {
        uint32_t root;
        good = good && build_subtree(b, &b->parts[i], &b->tasks[i].range, b->tasks[i].depth, &root);
    }
    return good;
}

/* Takes a part's nodes over with their children renumbered. */
static void take_nodes(const part *p, uint32_t first_node, uint32_t first_leaf, const uint32_t *task_roots,
                       sp_bvh_node *nodes)
{
    for (size_t i = 0; i < p->node_count; i++) {
        sp_bvh_node *node = &nodes[first_node + i];
        *node = p->nodes[i];
        for (uint32_t k = 0; k < node->count; k++) {
            uint32_t child = node->child[k];
            if (child & SP_BVH_LEAF)
                node->child[k] = child + first_leaf;
            else
                node->child[k] = child & UPPER ? task_roots[child - UPPER] : child + first_node;
        }
    }
}

static void fill_block(const sp_bvh *bvh, const sp_bvh_reference *references, uint32_t count, sp_bvh_block *block)
{
    assert(count > 0 && count <= SP_BVH_WIDTH);
    memset(block, 255, sizeof *block); /* SP_NONE, and what is no number */
    for (uint32_t i = 0; i < count; i++) {
        sp_corners corners;
        sp_bvh_corners(bvh, references[i].triangle, corners);
        block->triangle[i] = references[i].triangle;
        for (int corner = 0; corner < 3; corner++)
            for (int axis = 0; axis < 3; axis++)
                block->corner[corner][axis][i] = (float)((corners[corner][axis] - bvh->centre[axis]) * bvh->scale);
    }
}

/* Fills the blocks of a part. What they take from the mesh lies anywhere, and is prefetched. */
static void fill_blocks(const builder *b, const part *p, sp_bvh *bvh, size_t first)
{
    const sp_bvh_reference *references = b->buffers[0];
    for (size_t k = 0; k < p->leaf_count; k++) {
        const leaf *l = &p->leaves[k];
        if (p->leaf_count - k > 2 * AHEAD)
            for (uint32_t i = 0; i < l[2 * AHEAD].count; i++)
                __builtin_prefetch(bvh->mesh->triangles[references[l[2 * AHEAD].first + i].triangle]);
        if (p->leaf_count - k > AHEAD)
            for (uint32_t i = 0; i < l[AHEAD].count; i++)
                sp_bvh_prefetch_corners(bvh, references[l[AHEAD].first + i].triangle);
        fill_block(bvh, references + l->first, l->count, &bvh->blocks[first + k]);
    }
}

/* The second buffer, done with, becomes the blocks where it is large enough: memory that is new to the process is
 * dear. */
static bool make_arrays(builder *b, sp_bvh *bvh, size_t nodes, size_t leaves)
{
    size_t room = BLOCKS_ROOM * bvh->mesh->triangle_count * sizeof **b->buffers;
    bvh->nodes = sp_bvh_allocate(nodes, sizeof *bvh->nodes);
    if (leaves <= room / sizeof *bvh->blocks) {
        bvh->blocks = (sp_bvh_block *)(void *)b->buffers[1];
        b->buffers[1] = NULL;
    } else {
        bvh->blocks = sp_bvh_allocate(leaves, sizeof *bvh->blocks);
    }
    bvh->node_count = nodes;
    bvh->block_count = leaves;
    return bvh->nodes && bvh->blocks;
}

static bool assemble(builder *b, sp_bvh *bvh)
{
    size_t nodes = b->upper.node_count, leaves = b->upper.leaf_count;
    uint32_t *roots = malloc((b->task_count + 1) * sizeof *roots),
             *firsts = malloc((b->task_count + 1) * sizeof *roots);
    bool good = roots && firsts;
    for (size_t i = 0; good && i < b->task_count; i++) {
        roots[i] = (uint32_t)nodes;
        firsts[i] = (uint32_t)leaves;
        nodes += b->parts[i].node_count;
        leaves += b->parts[i].leaf_count;
        good = nodes < UPPER && leaves < UPPER;
    }
    good = good && make_arrays(b, bvh, nodes, leaves);
    if (good) {
        take_nodes(&b->upper, 0, 0, roots, bvh->nodes);
        fill_blocks(b, &b->upper, bvh, 0);
#pragma omp parallel for schedule(dynamic, 1) num_threads(b->threads)
        for (size_t i = 0; i < b->task_count; i++) {
            take_nodes(&b->parts[i], roots[i], firsts[i], roots, bvh->nodes);
            fill_blocks(b, &b->parts[i], bvh, firsts[i]);
        }
    }
    free(roots);
    free(firsts);
    return good;
}

/* The box around the triangles from the first on, m. */
static void enclose_chunk(const sp_mesh *mesh, size_t first, size_t end, double box[2][3])
{
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (size_t t = first; t < end; t++)
        for (int i = 0; i < 3; i++) {
            double p[3];
            sp_to_array(mesh->vertices[mesh->triangles[t][i]], p);
            for (int axis = 0; axis < 3; axis++) {
                low[axis] = sp_lesser(low[axis], p[axis]);
                high[axis] = sp_greater(high[axis], p[axis]);
            }
        }
    memcpy(box[0], low, sizeof low);
    memcpy(box[1], high, sizeof high);
}

/* Sets the space of the hierarchy; chunks are united in their order. */
static bool enclose(sp_bvh *bvh, int threads)
{
    const sp_mesh *mesh = bvh->mesh;
    size_t chunks = (mesh->triangle_count + CHUNK - 1) / CHUNK;
    double(*boxes)[2][3] = malloc(chunks * sizeof *boxes), half = 0;
    if (!boxes)
        return false;
#pragma omp parallel for num_threads(threads)
    for (size_t c = 0; c < chunks; c++) {
        size_t end = mesh->triangle_count - c * CHUNK < CHUNK ? mesh->triangle_count : (c + 1) * CHUNK;
        enclose_chunk(mesh, c * CHUNK, end, boxes[c]);
    }
    for (int axis = 0; axis < 3; axis++) {
        bvh->low[axis] = INFINITY;
        bvh->high[axis] = -INFINITY;
        for (size_t c = 0; c < chunks; c++) {
            bvh->low[axis] = sp_lesser(bvh->low[axis], boxes[c][0][axis]);
            bvh->high[axis] = sp_greater(bvh->high[axis], boxes[c][1][axis]);
        }
        bvh->centre[axis] = 0.5 * bvh->low[axis] + 0.5 * bvh->high[axis];
        half = sp_greater(half, sp_greater(bvh->high[axis] - bvh->centre[axis], bvh->centre[axis] - bvh->low[axis]));
    }
    free(boxes);
    int exponent;
    frexp(half, &exponent);
    bvh->scale = ldexp(1, exponent < -1000 ? 1000 : -exponent);
    return true;
}

static void refer(const sp_bvh *bvh, uint32_t triangle, sp_bvh_reference *reference)
{
    sp_corners corners;
    sp_bvh_corners(bvh, triangle, corners);
    *reference = (sp_bvh_reference){.triangle = triangle};
    for (int axis = 0; axis < 3; axis++) {
        double a = corners[0][axis], b = corners[1][axis], c = corners[2][axis];
        double low = sp_lesser(a, sp_lesser(b, c)), high = sp_greater(a, sp_greater(b, c));
        /* The pad is 2^6 times what rounding to float may take away. */
        reference->low[axis] = (float)((low - bvh->centre[axis]) * bvh->scale) - SP_BVH_PAD;
        reference->high[axis] = (float)((high - bvh->centre[axis]) * bvh->scale) + SP_BVH_PAD;
    }
}

static void free_part(part *p)
{
    free(p->nodes);
    free(p->leaves);
}

/* Makes all references, and their range. */
static bool refer_all(builder *b, const sp_bvh *bvh, sp_bvh_range *all)
{
    size_t count = bvh->mesh->triangle_count, chunks = (count + CHUNK - 1) / CHUNK;
    sp_bvh_range *ranges = malloc(chunks * sizeof *ranges);
    if (!ranges)
        return false;
#pragma omp parallel for num_threads(b->threads)
    for (size_t c = 0; c < chunks; c++) {
        size_t first = c * CHUNK, end = count - first < CHUNK ? count : first + CHUNK;
        ranges[c] = (sp_bvh_range){.first = first, .count = end - first, .buffer = 0};
        for (size_t t = first; t < end; t++)
            refer(bvh, (uint32_t)t, &b->buffers[0][t]);
        sp_bvh_measure(b->buffers[0], &ranges[c]);
    }
    *all = ranges[0];
    all->count = count;
    for (size_t c = 1; c < chunks; c++) {
        sp_bvh_box_unite(&all->box, &ranges[c].box);
        sp_bvh_box_unite(&all->centres, &ranges[c].centres);
    }
    free(ranges);
    return true;
}

static bool build(builder *b, sp_bvh *bvh)
{
    sp_bvh_range all;
    uint32_t root;
    for (int i = 0; i < 2; i++) {
        b->buffers[i] = sp_bvh_allocate(bvh->mesh->triangle_count, (i ? BLOCKS_ROOM : 1) * sizeof *b->buffers[i]);
        if (!b->buffers[i])
            return false;
    }
    return refer_all(b, bvh, &all) && build_upper(b, &all, 0, &root) && build_tasks(b) && assemble(b, bvh);
}

bool sp_bvh_build(const sp_mesh *mesh, int threads, sp_bvh *bvh)
{
    *bvh = (sp_bvh){.mesh = mesh, .scale = 1};
    if (mesh->triangle_count == 0)
        return true;
    builder b = {.threads = threads};
    bool good = mesh->triangle_count < SP_NONE && enclose(bvh, threads) && build(&b, bvh);
    free(b.buffers[0]);
    free(b.buffers[1]);
    free_part(&b.upper);
    for (size_t i = 0; b.parts && i < b.task_count; i++)
        free_part(&b.parts[i]);
    free(b.parts);
    free(b.tasks);
    if (!good)
        sp_bvh_clear(bvh);
    return good;
}

void sp_bvh_clear(sp_bvh *bvh)
{
    free(bvh->nodes);
    free(bvh->blocks);
    *bvh = (sp_bvh){0};
}
