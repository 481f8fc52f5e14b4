/* Lines through the hierarchy. Included once by each file that is compiled for a set of instructions, with
 * SP_KERNEL(name) naming its functions. */
#include "trace/line/answer.h"
#include "trace/line/line_prepare.h"
#include "trace/line/line_step.h"

/* What comes next for a line, as the two highest bits of what is on its stack say. */
enum {
    TO_NODE,
    TO_HIT, /* to decide about what a block has found; on no stack */
    TO_BLOCK,
    TO_END, /* at the bottom of each stack */
    WAITING,
    FLIGHTS = 16
};
#define END 0xC0000000u
#define KIND_SHIFT 30

/* Lines wait in sets, one for each kind of what comes next, and whatever waits in one is dealt with in a row. So there
 * is hardly a branch that depends on what a line meets, which no processor could foresee, and one line's arithmetic
 * goes on while another's waits for memory. */
typedef struct {
    uint32_t nodes, hits, blocks, ends; /* bit i: flight i */
} waiting;

typedef struct {
    sp_line_queue *queue;
    const sp_bvh *bvh;
    /* Where what comes next is, and its bytes: looked up, as a branch would be guesswork. */
    const char *base[WAITING];
    size_t size[WAITING];
    size_t more[WAITING]; /* from its second line of the cache to each further one, where there are more */
    sp_bvh_line ready[SP_LINES];
    int ready_count, ready_next; /* those from the latter on have not begun */
    answers answers;
    sp_line_flight flights[FLIGHTS];
} work;

/* Prefetches what is on top of the stack, which comes next. */
static inline void go_on(work *w, waiting *waiting, uint32_t number)
{
    sp_line_flight *flight = &w->flights[number];
    uint32_t child = flight->child[--flight->height], kind = child >> KIND_SHIFT, place = child & ~END;
    const char *line = w->base[kind] + (size_t)place * w->size[kind];
    flight->current = place;
    size_t more = w->more[kind];
    __builtin_prefetch(line);
    for (size_t i = 0; i < 4; i++)
        __builtin_prefetch(line + 64 + i * more);
    waiting->nodes |= (uint32_t)(kind == TO_NODE) << number;
    waiting->blocks |= (uint32_t)(kind == TO_BLOCK) << number;
    waiting->ends |= (uint32_t)(kind == TO_END) << number;
}

static inline void visit_node(work *w, waiting *waiting, uint32_t number)
{
    sp_line_flight *flight = &w->flights[number];
    const sp_bvh_node *node = &w->bvh->nodes[flight->current];
    int height = flight->height;
    wide enters, leaves;
    enter_children(node, &flight->ray, &enters, &leaves);
    flight->height = height + wide_pack(node->child, enters, leaves, children_order(node, &flight->ray),
                                        flight->child + height, flight->way + height);
    go_on(w, waiting, number);
}

static inline void visit_block(work *w, waiting *waiting, uint32_t number)
{
    sp_line_flight *flight = &w->flights[number];
    test_block(&w->bvh->blocks[flight->current], &flight->ray, &flight->found);
    if (flight->found.maybe)
        waiting->hits |= 1u << number;
    else
        go_on(w, waiting, number);
}

/* Takes from the stack what the line enters too late. */
static inline void cull(sp_line_flight *flight)
{
    int kept = 0;
    wide last = wide_set(flight->ray.last);
    wide_store(flight->way + flight->height, wide_set(INFINITY));
    for (int i = 0; i < flight->height; i += SP_BVH_WIDTH)
        kept += wide_pack(flight->child + i, wide_load(flight->way + i), last, 0x0706050403020100u,
                          flight->child + kept, flight->way + kept);
    flight->height = kept;
}

static inline void decide(work *w, waiting *waiting, uint32_t number)
{
    sp_line_flight *flight = &w->flights[number];
    float last = flight->ray.last;
    take_found(w->queue, flight, &w->bvh->blocks[flight->current]);
    if (!w->queue->hits && flight->triangle != SP_NONE)
        flight->height = 1;
    else if (flight->ray.last != last)
        cull(flight);
    go_on(w, waiting, number);
}

/* Lets the next line begin, if there is one. */
static inline void begin(work *w, waiting *waiting, uint32_t number)
{
    sp_line_flight *flight = &w->flights[number];
    while (w->ready_next == w->ready_count) {
        if (w->queue->next == w->queue->count)
            return;
        w->ready_count = make_ready(w->queue, SP_LINES, w->ready);
        w->ready_next = 0;
    }
    flight->ray = w->ready[w->ready_next++];
    flight->triangle = SP_NONE;
    flight->low = INFINITY;
    flight->in_doubt = false;
    flight->child[0] = END;
    flight->way[0] = -INFINITY;
    flight->current = 0;
    flight->height = 1;
    waiting->nodes |= 1u << number;
}

static inline void end(work *w, uint32_t number)
{
    const sp_line_flight *flight = &w->flights[number];
    sp_line_queue *queue = w->queue;
    uint32_t ray = flight->ray.number;
    if (!queue->hits)
        queue->occluded[ray] = flight->triangle != SP_NONE;
    else if (flight->triangle == SP_NONE)
        queue->hits[ray] = (sp_hit){INFINITY, 0, 0, SP_NONE};
    else
        note_answer(&w->answers, ray, flight->triangle, flight->ray.z);
    if (w->answers.count == SP_ANSWERS)
        give_answers(&w->answers);
}

void SP_KERNEL(sp_bvh_lines)(sp_line_queue *queue)
{
    work w;
    w.queue = queue;
    w.bvh = queue->bvh;
    w.base[TO_NODE] = w.base[TO_HIT] = w.base[TO_END] = (const char *)w.bvh->nodes;
    w.base[TO_BLOCK] = (const char *)w.bvh->blocks;
    w.size[TO_NODE] = w.size[TO_HIT] = w.size[TO_END] = sizeof *w.bvh->nodes;
    w.size[TO_BLOCK] = sizeof *w.bvh->blocks;
    w.more[TO_NODE] = w.more[TO_HIT] = w.more[TO_END] = 0;
    w.more[TO_BLOCK] = 64;
    w.ready_count = w.ready_next = 0;
    start_answers(&w.answers, queue->bvh, queue->rays, queue->hits);
    waiting waiting = {0, 0, 0, 0};
    for (uint32_t i = 0; i < FLIGHTS; i++)
        begin(&w, &waiting, i);
    while (waiting.nodes | waiting.blocks) {
        uint32_t blocks = waiting.blocks, rest = waiting.nodes;
        waiting.nodes = 0;
        for (; rest; rest &= rest - 1)
            visit_node(&w, &waiting, (uint32_t)__builtin_ctz(rest));
        waiting.blocks &= ~blocks;
        for (rest = blocks; rest; rest &= rest - 1)
            visit_block(&w, &waiting, (uint32_t)__builtin_ctz(rest));
        for (rest = waiting.hits; rest; rest &= rest - 1)
            decide(&w, &waiting, (uint32_t)__builtin_ctz(rest));
        for (rest = waiting.ends; rest; rest &= rest - 1) {
            end(&w, (uint32_t)__builtin_ctz(rest));
            begin(&w, &waiting, (uint32_t)__builtin_ctz(rest));
        }
        waiting.hits = waiting.ends = 0;
    }
    give_answers(&w.answers);
}
