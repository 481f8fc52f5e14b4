#include "trace/bvh/bvh_split.h"

#include <float.h>
#include <math.h>
#include <omp.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

/* References that one thread bins or moves at a time. Ranges of at most this many are divided by one thread. */
enum { CHUNK = 1 << 15 };

typedef struct {
    sp_bvh_box box[3][SP_BIN_COUNT];
    uint32_t count[3][SP_BIN_COUNT];
} bin_set;

/* Where to divide: bins of that axis below `bin` go left. */
typedef struct {
    int axis; /* -1: nowhere */
    int bin;
    size_t left; /* how many go left */
    sp_bvh_box boxes[2];
} cut;

sp_bvh_box sp_bvh_box_empty(void)
{
    return (sp_bvh_box){{FLT_MAX, FLT_MAX, FLT_MAX, FLT_MAX}, {-FLT_MAX, -FLT_MAX, -FLT_MAX, -FLT_MAX}};
}

/* Four numbers at once, in words of the compiler's that any processor has. */
typedef float four __attribute__((vector_size(16)));
typedef int32_t four_whole __attribute__((vector_size(16)));

/* How centres are told apart along each axis: bin = (twice the centre - low) scale, up to `last`. */
typedef struct {
    four low, scale, last;
    int bins;
} binning;

static inline four load(const float from[4])
{
    four a;
    memcpy(&a, from, sizeof a);
    return a;
}

static inline void store(float to[4], four a)
{
    memcpy(to, &a, sizeof a);
}

#ifdef __SSE2__
/* gcc does not see that these are one instruction each. */
static inline four lesser(four a, four b)
{
    return _mm_min_ps(a, b);
}
static inline four greater(four a, four b)
{
    return _mm_max_ps(a, b);
}
#else
static inline four where(four_whole mask, four one, four other)
{
    return (four)((mask & (four_whole)one) | (~mask & (four_whole)other));
}

static inline four lesser(four a, four b)
{
    return where(a < b, a, b);
}
static inline four greater(four a, four b)
{
    return where(a > b, a, b);
}
#endif

static inline void unite(sp_bvh_box *box, four low, four high)
{
    store(box->low, lesser(load(box->low), low));
    store(box->high, greater(load(box->high), high));
}

void sp_bvh_box_unite(sp_bvh_box *box, const sp_bvh_box *other)
{
    unite(box, load(other->low), load(other->high));
}

float sp_bvh_box_area(const sp_bvh_box *box)
{
    float x = box->high[0] - box->low[0], y = box->high[1] - box->low[1], z = box->high[2] - box->low[2];
    return x * (y + z) + y * z;
}

/* A reference's box with the idle lanes zero. */
static inline void unpack(const sp_bvh_reference *reference, four *low, four *high)
{
    const four_whole used = {-1, -1, -1, 0};
    memcpy(low, (const char *)reference + offsetof(sp_bvh_reference, low), sizeof *low);
    memcpy(high, (const char *)reference + offsetof(sp_bvh_reference, high), sizeof *high);
    *low = (four)((four_whole)*low & used);
    *high = (four)((four_whole)*high & used);
}

void sp_bvh_measure(const sp_bvh_reference *references, sp_bvh_range *range)
{
    range->box = range->centres = sp_bvh_box_empty();
    for (size_t i = range->first; i < range->first + range->count; i++) {
        four low, high;
        unpack(&references[i], &low, &high);
        unite(&range->box, low, high);
        unite(&range->centres, low + high, low + high);
    }
}

static binning choose_binning(const sp_bvh_range *range)
{
    int bins = range->count < 32 ? SP_BIN_COUNT / 2 : SP_BIN_COUNT;
    float last = (float)(bins - 1);
    binning b = {.low = load(range->centres.low), .last = {last, last, last, last}, .bins = bins};
    for (int k = 0; k < 3; k++) {
        float extent = range->centres.high[k] - range->centres.low[k], scale = (float)bins * 0.99999f / extent;
        b.scale[k] = extent > 0 && scale <= FLT_MAX ? scale : 0;
    }
    return b;
}

static inline four_whole bins_of(binning b, four centre)
{
    return __builtin_convertvector(lesser((centre - b.low) * b.scale, b.last), four_whole);
}

static void clear_bins(bin_set *set, int bins)
{
    memset(set->count, 0, sizeof set->count);
    for (int axis = 0; axis < 3; axis++)
        for (int i = 0; i < bins; i++)
            set->box[axis][i] = sp_bvh_box_empty();
}

static void fill_bins(const sp_bvh_reference *references, size_t count, const binning *chosen, bin_set *set)
{
    const binning b = *chosen; /* the set is not in its way */
    clear_bins(set, b.bins);
    for (size_t i = 0; i < count; i++) {
        four low, high;
        unpack(&references[i], &low, &high);
        four_whole bins = bins_of(b, low + high);
        for (int axis = 0; axis < 3; axis++) {
            uint32_t bin = (uint32_t)bins[axis];
            set->count[axis][bin]++;
            unite(&set->box[axis][bin], low, high);
        }
    }
}

static void add_bins(bin_set *sum, const bin_set *set, int bins)
{
    for (int axis = 0; axis < 3; axis++)
        for (int i = 0; i < bins; i++) {
            sum->count[axis][i] += set->count[axis][i];
            sp_bvh_box_unite(&sum->box[axis][i], &set->box[axis][i]);
        }
}

/* Leaves are tested as a whole, so that what counts is how many of them there will be. */
static inline float cost(const sp_bvh_box *box, size_t count)
{
    return sp_bvh_box_area(box) * (float)((count + 7) / 8);
}

static void sweep(const bin_set *set, int axis, int bins, size_t count, float *best, cut *where)
{
    float right_cost[SP_BIN_COUNT];
    sp_bvh_box right_box[SP_BIN_COUNT], box = sp_bvh_box_empty();
    size_t right = 0, left = 0;
    for (int i = bins - 1; i > 0; i--) {
        right += set->count[axis][i];
        sp_bvh_box_unite(&box, &set->box[axis][i]);
        right_box[i] = box;
        right_cost[i] = right ? cost(&box, right) : 0;
    }
    box = sp_bvh_box_empty();
    for (int i = 1; i < bins; i++) {
        left += set->count[axis][i - 1];
        sp_bvh_box_unite(&box, &set->box[axis][i - 1]);
        if (left == 0 || left == count)
            continue;
        float here = cost(&box, left) + right_cost[i];
        if (here < *best) {
            *best = here;
            *where = (cut){axis, i, left, {box, right_box[i]}};
        }
    }
}

static cut choose_cut(const bin_set *set, const binning *b, size_t count)
{
    cut where = {.axis = -1};
    float best = INFINITY;
    for (int axis = 0; axis < 3; axis++)
        if (b->scale[axis] > 0)
            sweep(set, axis, b->bins, count, &best, &where);
    return where;
}

/* Copies references to the left or right place, keeping their order; returns the boxes around their centres. Both boxes
 * stay in registers: the one of the other side is shown what is no number. */
static void move(const sp_bvh_reference *from, size_t count, const binning *b, const cut *chosen,
                 sp_bvh_reference *const to[2], sp_bvh_box centres[2])
{
    sp_bvh_reference *left = to[0], *right = to[1];
    int axis = chosen->axis, bin = chosen->bin;
    float from_low = b->low[axis], scale = b->scale[axis];
    four least[2], most[2];
    for (int side = 0; side < 2; side++) {
        least[side] = (four){FLT_MAX, FLT_MAX, FLT_MAX, FLT_MAX};
        most[side] = -least[side];
    }
    for (size_t i = 0; i < count; i++) {
        four low, high;
        unpack(&from[i], &low, &high);
        four_whole centre = (four_whole)(low + high);
        int32_t is_right = -((int)((from[i].low[axis] + from[i].high[axis] - from_low) * scale) >= bin);
        four_whole mask = {is_right, is_right, is_right, is_right};
        *(is_right ? right : left) = from[i];
        right -= is_right;
        left += 1 + is_right;
        least[0] = lesser((four)(centre | mask), least[0]);
        most[0] = greater((four)(centre | mask), most[0]);
        least[1] = lesser((four)(centre | ~mask), least[1]);
        most[1] = greater((four)(centre | ~mask), most[1]);
    }
    for (int side = 0; side < 2; side++) {
        store(centres[side].low, least[side]);
        store(centres[side].high, most[side]);
    }
}

/* The range cut where no bins tell its references apart, or into halves for balance. */
static void halve(sp_bvh_reference *const buffers[2], const sp_bvh_range *range, sp_bvh_range parts[2])
{
    size_t left = range->count > 16 ? (range->count / 2 + 7) / 8 * 8 : range->count / 2;
    int to = !range->buffer;
    memcpy(buffers[to] + range->first, buffers[range->buffer] + range->first, range->count * sizeof **buffers);
    parts[0] = (sp_bvh_range){.first = range->first, .count = left, .buffer = to};
    parts[1] = (sp_bvh_range){.first = range->first + left, .count = range->count - left, .buffer = to};
    for (int side = 0; side < 2; side++)
        sp_bvh_measure(buffers[to], &parts[side]);
}

static void name_parts(const sp_bvh_range *range, const cut *where, sp_bvh_range parts[2])
{
    parts[0] =
        (sp_bvh_range){.first = range->first, .count = where->left, .buffer = !range->buffer, .box = where->boxes[0]};
    parts[1] = (sp_bvh_range){.first = range->first + where->left,
                              .count = range->count - where->left,
                              .buffer = !range->buffer,
                              .box = where->boxes[1]};
}

static void divide_serially(sp_bvh_reference *const buffers[2], const sp_bvh_range *range, sp_bvh_range parts[2])
{
    const sp_bvh_reference *from = buffers[range->buffer] + range->first;
    binning b = choose_binning(range);
    bin_set set;
    fill_bins(from, range->count, &b, &set);
    cut where = choose_cut(&set, &b, range->count);
    if (where.axis < 0) {
        halve(buffers, range, parts);
        return;
    }
    name_parts(range, &where, parts);
    sp_bvh_reference *to[2] = {buffers[!range->buffer] + parts[0].first, buffers[!range->buffer] + parts[1].first};
    sp_bvh_box centres[2];
    move(from, range->count, &b, &where, to, centres);
    parts[0].centres = centres[0];
    parts[1].centres = centres[1];
}

/* One chunk's share of the work. */
typedef struct {
    bin_set set;
    size_t left; /* of its references */
    sp_bvh_box centres[2];
} chunk_work;

static void move_together(sp_bvh_reference *const buffers[2], const sp_bvh_range *range, const binning *b,
                          const cut *where, int threads, chunk_work *work, sp_bvh_range parts[2])
{
    const sp_bvh_reference *from = buffers[range->buffer] + range->first;
    sp_bvh_reference *to = buffers[!range->buffer];
    size_t chunks = (range->count + CHUNK - 1) / CHUNK, before = 0;
    for (size_t c = 0; c < chunks; c++) {
        size_t left = 0;
        for (int bin = 0; bin < where->bin; bin++)
            left += work[c].set.count[where->axis][bin];
        work[c].left = before;
        before += left;
    }
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
    for (size_t c = 0; c < chunks; c++) {
        size_t first = c * CHUNK, count = range->count - first < CHUNK ? range->count - first : CHUNK;
        sp_bvh_reference *places[2] = {to + parts[0].first + work[c].left,
                                       to + parts[1].first + (first - work[c].left)};
        move(from + first, count, b, where, places, work[c].centres);
    }
    for (int side = 0; side < 2; side++) {
        parts[side].centres = sp_bvh_box_empty();
        for (size_t c = 0; c < chunks; c++)
            sp_bvh_box_unite(&parts[side].centres, &work[c].centres[side]);
    }
}

static bool divide_together(sp_bvh_reference *const buffers[2], const sp_bvh_range *range, int threads,
                            sp_bvh_range parts[2])
{
    const sp_bvh_reference *from = buffers[range->buffer] + range->first;
    size_t chunks = (range->count + CHUNK - 1) / CHUNK;
    chunk_work *work = calloc(chunks, sizeof *work);
    if (!work)
        return false;
    binning b = choose_binning(range);
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
    for (size_t c = 0; c < chunks; c++) {
        size_t first = c * CHUNK, count = range->count - first < CHUNK ? range->count - first : CHUNK;
        fill_bins(from + first, count, &b, &work[c].set);
    }
    bin_set sum = work[0].set;
    for (size_t c = 1; c < chunks; c++)
        add_bins(&sum, &work[c].set, b.bins);
    cut where = choose_cut(&sum, &b, range->count);
    if (where.axis < 0) {
        halve(buffers, range, parts);
    } else {
        name_parts(range, &where, parts);
        move_together(buffers, range, &b, &where, threads, work, parts);
    }
    free(work);
    return true;
}

bool sp_bvh_divide(sp_bvh_reference *const buffers[2], const sp_bvh_range *range, bool balanced, int threads,
                   sp_bvh_range parts[2])
{
    if (balanced)
        halve(buffers, range, parts);
    else if (range->count > CHUNK)
        return divide_together(buffers, range, threads, parts);
    else
        divide_serially(buffers, range, parts);
    return true;
}
