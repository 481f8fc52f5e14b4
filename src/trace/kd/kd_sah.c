/* The kd-tree by the surface area heuristic (study, 3.2.2.1, after Havran 2000): of all planes through the outermost
 * vertices of triangles, the one that makes a random ray cheapest; a leaf where that is cheaper still. Built in n log n
 * as Wald and Havran describe ("On building fast kd-trees for ray tracing, and on doing that in O(N log N)", 2006):
 * events are sorted once, and the children's events are the parent's without those of the other side. */
#include "trace/kd/kd_tree.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

/* The study's costs, 3.19 and 3.20. */
static const double cost_traverse = 3, cost_intersect = 4;

/* In the order in which the sweep takes them at one position. */
enum { END, FLAT, START };

/* Where a triangle begins or ends along an axis, or lies within a plane across it. */
typedef struct {
    double position; /* m */
    uint32_t triangle;
    uint32_t kind;
} event;

typedef struct {
    double low[3], high[3];
    event *events[3];
    size_t event_count[3];
    size_t count;       /* of triangles */
    double duplication; /* how many times more references its children's children may hold than it does */
} cell;

typedef struct {
    double cost, position;
    int axis;       /* -1: none is cheaper than a leaf */
    bool flat_left; /* triangles within the plane belong to the left child, else to the right */
    size_t left, right;
} plane;

enum { LEFT = 1, RIGHT = 2, BOTH = 3 };

typedef struct {
    uint8_t *side; /* [triangle_count] of the cell that is being divided */
    sp_kd_tree *tree;
} builder;

static int compare(const void *first, const void *second)
{
    const event *a = first, *b = second;
    if (a->position != b->position)
        return a->position < b->position ? -1 : 1;
    if (a->kind != b->kind)
        return a->kind < b->kind ? -1 : 1;
    return (a->triangle > b->triangle) - (a->triangle < b->triangle);
}

static bool collect(const sp_kd_box *boxes, size_t count, int axis, cell *root)
{
    event *events = malloc((2 * count + 1) * sizeof *events);
    root->events[axis] = events;
    if (!events)
        return false;
    size_t n = 0;
    for (size_t t = 0; t < count; t++) {
        double low = boxes[t][0][axis], high = boxes[t][1][axis];
        events[n++] = (event){low, (uint32_t)t, low == high ? FLAT : START};
        if (low != high)
            events[n++] = (event){high, (uint32_t)t, END};
    }
    qsort(events, n, sizeof *events, compare);
    root->event_count[axis] = n;
    return true;
}

/* Half the surface of the cell between two planes across `axis`. */
static double half_surface(const cell *c, int axis, double low, double high)
{
    double across = c->high[(axis + 1) % 3] - c->low[(axis + 1) % 3],
           up = c->high[(axis + 2) % 3] - c->low[(axis + 2) % 3];
    return (high - low) * (across + up) + across * up;
}

/* Study, 3.19, for both ways to assign the triangles within the plane. */
static void consider(const cell *c, int axis, double position, size_t left, size_t flat, size_t right, plane *best)
{
    double whole = half_surface(c, axis, c->low[axis], c->high[axis]);
    double left_part = half_surface(c, axis, c->low[axis], position) / whole;
    double right_part = half_surface(c, axis, position, c->high[axis]) / whole;
    bool flat_left = left_part <= right_part;
    left += flat_left ? flat : 0;
    right += flat_left ? 0 : flat;
    double cost = cost_traverse + cost_intersect * (left_part * (double)left + right_part * (double)right);
    if (cost < best->cost)
        *best = (plane){cost, position, axis, flat_left, left, right};
}

static void sweep(const cell *c, int axis, plane *best)
{
    const event *events = c->events[axis];
    size_t left = 0, right = c->count;
    for (size_t i = 0; i < c->event_count[axis];) {
        double position = events[i].position;
        size_t here[3] = {0};
        for (; i < c->event_count[axis] && events[i].position == position; i++)
            here[events[i].kind]++;
        right -= here[END] + here[FLAT];
        if (position > c->low[axis] && position < c->high[axis])
            consider(c, axis, position, left, here[FLAT], right, best);
        left += here[START] + here[FLAT];
    }
    assert(left == c->count && right == 0); /* all have come and gone */
}

static plane choose(const cell *c, int depth)
{
    plane best = {.cost = cost_intersect * (double)c->count, .axis = -1};
    if (depth == 0 || c->count <= 1)
        return best;
    for (int axis = 0; axis < 3; axis++)
        sweep(c, axis, &best);
    double duplication = c->duplication * (double)c->count / (double)(best.left + best.right + 1);
    if (best.axis >= 0 && duplication < 1)
        best.axis = -1;
    return best;
}

static void classify(const builder *b, const cell *c, const plane *p)
{
    const event *events = c->events[p->axis];
    size_t count = c->event_count[p->axis];
    for (size_t i = 0; i < count; i++)
        b->side[events[i].triangle] = BOTH;
    for (size_t i = 0; i < count; i++) {
        double position = events[i].position;
        uint8_t *side = &b->side[events[i].triangle];
        if (events[i].kind == END && position <= p->position)
            *side = LEFT;
        else if (events[i].kind == START && position >= p->position)
            *side = RIGHT;
        else if (events[i].kind == FLAT)
            *side = position < p->position || (position == p->position && p->flat_left) ? LEFT : RIGHT;
    }
}

static bool take(const builder *b, const cell *c, uint8_t side, cell *child)
{
    for (int axis = 0; axis < 3; axis++) {
        size_t n = 0;
        child->events[axis] = malloc((2 * child->count + 1) * sizeof *child->events[axis]);
        if (!child->events[axis])
            return false;
        for (size_t i = 0; i < c->event_count[axis]; i++)
            if (b->side[c->events[axis][i].triangle] & side)
                child->events[axis][n++] = c->events[axis][i];
        assert(n <= 2 * child->count); /* as the plane's cost was counted */
        child->event_count[axis] = n;
    }
    return true;
}

static void clear(cell *c)
{
    for (int axis = 0; axis < 3; axis++) {
        free(c->events[axis]);
        c->events[axis] = NULL;
    }
}

static bool divide(const builder *b, const cell *c, const plane *p, cell *left, cell *right)
{
    assert(p->left + p->right >= c->count);
    double duplication = c->duplication * (double)c->count / (double)(p->left + p->right + 1);
    *left = (cell){.count = p->left, .duplication = duplication};
    *right = (cell){.count = p->right, .duplication = duplication};
    memcpy(left->low, c->low, sizeof c->low);
    memcpy(left->high, c->high, sizeof c->high);
    memcpy(right->low, c->low, sizeof c->low);
    memcpy(right->high, c->high, sizeof c->high);
    left->high[p->axis] = right->low[p->axis] = p->position;
    classify(b, c, p);
    return take(b, c, LEFT, left) && take(b, c, RIGHT, right);
}

static bool make_leaf(const builder *b, const cell *c)
{
    uint32_t *references = sp_kd_add_leaf(b->tree, c->count);
    for (size_t i = 0; references && i < c->event_count[0]; i++)
        if (c->events[0][i].kind != END)
            *references++ = c->events[0][i].triangle;
    assert(!references || references == b->tree->references + b->tree->reference_count);
    return references != NULL;
}

/* Frees the cell's events. */
static bool build(const builder *b, cell *c, int depth)
{
    plane p = choose(c, depth);
    cell left = {0}, right = {0};
    uint32_t node = 0;
    bool good = p.axis < 0
                    ? make_leaf(b, c)
                    : divide(b, c, &p, &left, &right) && sp_kd_add_inner(b->tree, p.position, (uint32_t)p.axis, &node);
    clear(c);
    if (good && p.axis >= 0) {
        good = build(b, &left, depth - 1);
        b->tree->nodes[node].right = (uint32_t)b->tree->node_count;
        assert(depth > 0 && b->tree->nodes[node].right > node + 1);
        good = good && build(b, &right, depth - 1);
    }
    clear(&left);
    clear(&right);
    return good;
}

bool sp_kd_build_sah(const sp_mesh *mesh, sp_kd_tree *tree)
{
    size_t count = mesh->triangle_count;
    sp_kd_box *boxes = sp_kd_boxes(mesh);
    builder b = {malloc(count + 1), tree};
    cell root = {.count = count, .duplication = SP_KD_DUPLICATION};
    bool good = boxes && b.side;
    if (good) {
        sp_kd_enclose((const sp_kd_box *)boxes, count, tree);
        memcpy(root.low, tree->low, sizeof root.low);
        memcpy(root.high, tree->high, sizeof root.high);
    }
    for (int axis = 0; good && axis < 3; axis++)
        good = collect((const sp_kd_box *)boxes, count, axis, &root);
    good = good && build(&b, &root, sp_kd_depth(count));
    clear(&root);
    free(boxes);
    free(b.side);
    return good;
}
