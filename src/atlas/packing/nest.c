/* Bottom-left placement of bitmaps, largest first. A row of the shape leaves some stretches of a row of the page free
 * for it; the stretches that all rows leave are where it fits. The longest row is asked first and rows far apart next,
 * so that few rows answer for most places. */
#include "atlas/packing/nest.h"

#include "mesh/bits.h"
#include "mesh/key_sort.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define TURNS 4
#define MANY 200 /* pieces; those after them are asked for where the last like them went, not from the first row on */
#define FIRST_GUESS 0.8 /* of the page taken */
#define GROWTH 1.06     /* of the edge, while it is too small */
#define HALVINGS 6
#define ORDERS 40       /* tried to make the page smaller still */
#define SHRINKING 0.996 /* of the edge, at each success of an order */
/* What trying further orders may take, in pieces times their rows: not more time than all else. */
#define MOST_WORK 600000

/* A shape in one of its turns: the pixels it takes, those it must find free, and the order in which to ask. */
typedef struct {
    sp_shape plain, grown;
    double middle;       /* of the pixels that it must find free, above their lowest */
    sp_shape_run *asked; /* the runs of grown, most telling first */
} pose;

typedef struct {
    pose pose[TURNS];
    int turns;
} piece;

/* A page has a free border of one pixel around it, which what is grown may reach over. */
typedef struct {
    uint64_t *bits;
    uint32_t *longest; /* [edge], the longest free stretch of each row */
    uint32_t from;     /* the first row to be asked of the many */
    size_t size;       /* pixels, of the first of those that began there */
} page;

typedef struct {
    uint32_t first, last;
} stretch;

typedef struct {
    uint32_t edge; /* with the border */
    size_t row_words, count, capacity;
    page *pages;
    stretch *here, *next; /* [edge] */
} pages;

static void find_middle(pose *p)
{
    double pixels = 0, sum = 0;
    for (uint32_t i = 0; i < p->grown.run_count; i++) {
        pixels += p->grown.runs[i].length;
        sum += (double)p->grown.runs[i].length * p->grown.runs[i].y;
    }
    p->middle = sum / pixels;
}

static bool order_runs(pose *p)
{
    uint32_t count = p->grown.run_count, longest = 0, bits = 0;
    p->asked = malloc((count + 1) * sizeof *p->asked);
    if (!p->asked)
        return false;
    for (uint32_t i = 0; i < count; i++)
        if (p->grown.runs[i].length > p->grown.runs[longest].length)
            longest = i;
    while (1u << bits < count)
        bits++;
    uint32_t at = 0;
    p->asked[at++] = p->grown.runs[longest];
    for (uint32_t i = 0; i < 1u << bits; i++) {
        uint32_t reversed = 0;
        for (uint32_t b = 0; b < bits; b++)
            reversed |= (i >> b & 1) << (bits - 1 - b);
        if (reversed < count && reversed != longest)
            p->asked[at++] = p->grown.runs[reversed];
    }
    return true;
}

static void free_pieces(piece *pieces, size_t count)
{
    for (size_t i = 0; pieces && i < count; i++)
        for (int t = 0; t < TURNS; t++) {
            if (t)
                free(pieces[i].pose[t].plain.runs);
            free(pieces[i].pose[t].grown.runs);
            free(pieces[i].pose[t].asked);
        }
    free(pieces);
}

static piece *cut_pieces(const sp_shape *shapes, size_t count)
{
    piece *pieces = calloc(count + 1, sizeof *pieces);
    bool done = pieces;
    for (size_t i = 0; done && i < count; i++) {
        bool dot = shapes[i].width == 1 && shapes[i].height == 1;
        pieces[i].turns = dot ? 1 : TURNS;
        pieces[i].pose[0].plain = shapes[i];
        for (int t = 0; done && t < pieces[i].turns; t++) {
            pose *p = &pieces[i].pose[t];
            done = (t == 0 || sp_shape_turn(&pieces[i].pose[t - 1].plain, &p->plain)) &&
                   sp_shape_grow(&p->plain, &p->grown) && order_runs(p);
            if (done)
                find_middle(p);
        }
    }
    if (done)
        return pieces;
    free_pieces(pieces, count);
    return NULL;
}

static void free_pages(pages *p)
{
    for (size_t i = 0; i < p->count; i++) {
        free(p->pages[i].bits);
        free(p->pages[i].longest);
    }
    free(p->pages);
    free(p->here);
    free(p->next);
    *p = (pages){0};
}

static bool add_page(pages *p)
{
    if (p->count == p->capacity) {
        size_t capacity = p->capacity ? 2 * p->capacity : 1;
        page *grown = realloc(p->pages, capacity * sizeof *grown);
        if (!grown)
            return false;
        p->pages = grown;
        p->capacity = capacity;
    }
    page *fresh = &p->pages[p->count++];
    fresh->from = 0;
    fresh->size = 0;
    fresh->bits = calloc(p->row_words * p->edge, sizeof *fresh->bits);
    fresh->longest = malloc(p->edge * sizeof *fresh->longest);
    for (uint32_t y = 0; fresh->longest && y < p->edge; y++)
        fresh->longest[y] = p->edge;
    return fresh->bits && fresh->longest;
}

/* Where the first run asked of a shape fits in row y, the whole shape being on the page. */
static size_t open_stretches(const pages *p, const page *on, const sp_shape_run *run, uint32_t width, uint32_t y)
{
    const uint64_t *row = on->bits + (y + run->y) * p->row_words;
    size_t count = 0;
    for (size_t x = 0, end; (x = sp_bits_find(row, x, p->edge, false)) < p->edge; x = end) {
        end = sp_bits_find(row, x, p->edge, true);
        if (end - x < run->length || end - run->length < run->x)
            continue;
        uint32_t first = (uint32_t)(x < run->x ? 0 : x - run->x), last = (uint32_t)(end - run->length - run->x);
        if (first > p->edge - width)
            break;
        p->here[count++] = (stretch){first, last < p->edge - width ? last : p->edge - width};
    }
    return count;
}

/* What another run leaves of the stretches. */
static size_t narrow_stretches(const pages *p, const page *on, const sp_shape_run *run, uint32_t y, size_t count)
{
    const uint64_t *row = on->bits + (y + run->y) * p->row_words;
    size_t kept = 0;
    for (size_t i = 0; i < count; i++) {
        size_t x = p->here[i].first + run->x, last = p->here[i].last + run->x;
        while (x <= last) {
            size_t taken = sp_bits_find(row, x, last + run->length, true);
            if (taken - x >= run->length) {
                size_t to = taken - run->length < last ? taken - run->length : last;
                p->next[kept++] = (stretch){(uint32_t)(x - run->x), (uint32_t)(to - run->x)};
            }
            x = sp_bits_find(row, taken, last + run->length, false);
        }
    }
    return kept;
}

#define ROWS_ASKED_BY_LENGTH 8

/* The leftmost place in row y; false where there is none. */
static bool fit_row(pages *p, const page *on, const pose *piece, uint32_t y, uint32_t *x)
{
    const sp_shape_run *asked = piece->asked;
    uint32_t runs = piece->grown.run_count;
    for (uint32_t i = 0; i < runs && i < ROWS_ASKED_BY_LENGTH; i++)
        if (on->longest[y + asked[i].y] < asked[i].length)
            return false;
    size_t count = open_stretches(p, on, &asked[0], piece->grown.width, y);
    for (uint32_t i = 1; count && i < runs; i++) {
        count = narrow_stretches(p, on, &asked[i], y, count);
        stretch *swap = p->here;
        p->here = p->next;
        p->next = swap;
    }
    if (!count)
        return false;
    *x = p->here[0].first;
    return true;
}

/* The pose whose middle ends up lowest, and its place. */
static bool find_place(pages *p, const page *on, const piece *of, sp_spot *spot)
{
    double lowest = INFINITY;
    for (int t = 0; t < of->turns; t++) {
        const pose *pose = &of->pose[t];
        if (pose->grown.width > p->edge)
            continue;
        for (uint32_t y = on->from, x; y + pose->grown.height <= p->edge && y + pose->middle < lowest; y++)
            if (fit_row(p, on, pose, y, &x)) {
                lowest = y + pose->middle;
                spot->x = x;
                spot->y = y;
                spot->turns = t;
            }
    }
    return lowest < INFINITY;
}

/* Rows below where a piece went are hardly free for one nearly as large; for one a fifth smaller they may be. */
static void begin_anew(page *on, size_t size)
{
    if (5 * size <= 4 * on->size || on->size == 0) {
        on->size = size;
        on->from = 0;
    }
}

static void occupy(pages *p, page *on, const sp_shape *shape, const sp_spot *spot)
{
    for (uint32_t i = 0; i < shape->run_count; i++) /* the border is one pixel, and so is the growth */
        sp_bits_fill(on->bits + (spot->y + 1 + shape->runs[i].y) * p->row_words, spot->x + 1 + shape->runs[i].x,
                     shape->runs[i].length);
    for (uint32_t y = spot->y + 1; y < spot->y + 1 + shape->height; y++) {
        const uint64_t *row = on->bits + y * p->row_words;
        size_t longest = 0;
        for (size_t x = 0, end; (x = sp_bits_find(row, x, p->edge, false)) < p->edge; x = end) {
            end = sp_bits_find(row, x, p->edge, true);
            longest = end - x > longest ? end - x : longest;
        }
        on->longest[y] = (uint32_t)longest;
    }
}

/* Places all pieces on pages of this edge; *used becomes how many it took, or more than `most` where it gave up, at the
 * last piece of the order that *reached counts. */
static bool place_all(const piece *pieces, const uint32_t *order, size_t count, uint32_t edge, size_t most,
                      sp_spot *spots, size_t *used, size_t *reached)
{
    pages p = {.edge = edge + 2, .row_words = sp_bits_words(edge + 2)};
    p.here = malloc(p.edge * sizeof *p.here);
    p.next = malloc(p.edge * sizeof *p.next);
    bool memory = p.here && p.next;
    *used = *reached = 0;
    for (size_t i = 0; memory && *used <= most && i < count; i++) {
        *reached = i + 1;
        sp_spot *spot = &spots[order[i]];
        for (spot->page = 0;; spot->page++) {
            if (spot->page == p.count && (*used = p.count + 1) > most)
                break;
            if (spot->page == p.count && !(memory = add_page(&p)))
                break;
            page *on = &p.pages[spot->page];
            if (i >= MANY)
                begin_anew(on, pieces[order[i]].pose[0].plain.area);
            if (!find_place(&p, on, &pieces[order[i]], spot))
                continue;
            if (i >= MANY)
                on->from = spot->y;
            occupy(&p, on, &pieces[order[i]].pose[spot->turns].plain, spot);
            break;
        }
    }
    free_pages(&p);
    return memory;
}

/* xorshift64*: Vigna, "An experimental exploration of Marsaglia's xorshift generators" (2016). */
static double random_share(uint64_t *seed)
{
    *seed ^= *seed >> 12;
    *seed ^= *seed << 25;
    *seed ^= *seed >> 27;
    return (double)((*seed * 0x2545F4914F6CDD1Dull) >> 11) * 0x1p-53;
}

static bool order_by_size(const sp_shape *shapes, size_t count, uint64_t *keys, uint32_t *order)
{
    for (size_t i = 0; i < count; i++)
        keys[i] = ~(uint64_t)shapes[i].area;
    return count == 0 || sp_order_by_key(keys, count, order);
}

typedef struct {
    const piece *pieces;
    size_t count;
    uint32_t *order; /* [count] */
    uint64_t *keys;  /* [count] */
    sp_spot *trial, *best;
    uint32_t best_edge;
    size_t best_pages, reached;
} search;

/* Tries pages of this edge, at most `most` of them, and keeps the outcome if it succeeds. */
static bool try_edge(search *s, uint32_t edge, size_t most, bool *fits)
{
    size_t used;
    if (!place_all(s->pieces, s->order, s->count, edge, most, s->trial, &used, &s->reached))
        return false;
    *fits = used <= most;
    if (*fits) {
        sp_spot *swap = s->best;
        s->best = s->trial;
        s->trial = swap;
        s->best_edge = edge;
        s->best_pages = used;
    }
    return true;
}

/* The least edge that any piece allows, and what all of them take, pixels. */
static uint32_t least_edge(const sp_shape *shapes, size_t count, double *area)
{
    uint32_t widest = 1;
    *area = 0;
    for (size_t i = 0; i < count; i++) {
        uint32_t side = shapes[i].width > shapes[i].height ? shapes[i].width : shapes[i].height;
        widest = side > widest ? side : widest;
        *area += (double)shapes[i].area;
    }
    return widest;
}

/* Halves the gap between an edge that is too small and one that is large enough. */
static bool search_edge(search *s, const sp_shape *shapes, uint32_t limit)
{
    double area;
    uint32_t least = least_edge(shapes, s->count, &area);
    size_t pages = (size_t)fmax(1, ceil(area / ((double)limit * limit)));
    double bound = fmax(least, ceil(sqrt(area / (double)pages)));
    double guess = fmin(fmax(bound, sqrt(area / FIRST_GUESS / (double)pages)), limit);
    double low = bound - 1, high;
    for (bool fits = false; !fits;) {
        if (!try_edge(s, (uint32_t)guess, pages, &fits))
            return false;
        if (fits)
            break;
        low = guess;
        pages += guess == limit;
        guess = fmin(limit, ceil(guess * GROWTH));
    }
    high = s->best_edge;
    for (int i = 0; i < HALVINGS && high - low > 1 + high / 256; i++) {
        double middle = floor(i == 0 && low < high * 0.98 ? high * 0.98 : 0.5 * (low + high));
        bool fits;
        if (!try_edge(s, (uint32_t)middle, pages, &fits))
            return false;
        if (fits)
            high = middle;
        else
            low = middle;
    }
    return true;
}

/* What would not fit goes earlier into the order, somewhere. */
static void put_forward(search *s, uint64_t *seed)
{
    size_t from = s->reached - 1, to = (size_t)(random_share(seed) * (double)from);
    uint32_t piece = s->order[from];
    memmove(s->order + to + 1, s->order + to, (from - to) * sizeof *s->order);
    s->order[to] = piece;
}

/* Tries other orders on ever smaller pages. */
static bool search_order(search *s, const sp_shape *shapes)
{
    uint64_t seed = 0x9E3779B97F4A7C15ull;
    double work = 0, area;
    uint32_t least = least_edge(shapes, s->count, &area);
    for (size_t i = 0; i < s->count; i++)
        work += shapes[i].height;
    int orders = (int)fmin(ORDERS, MOST_WORK / fmax(1, work));
    for (int n = 0; s->count > 1 && n < orders; n++) {
        uint32_t edge = (uint32_t)(s->best_edge * SHRINKING);
        bool fits;
        if (edge < least)
            break;
        if (!try_edge(s, edge, s->best_pages, &fits))
            return false;
        if (!fits)
            put_forward(s, &seed);
    }
    return true;
}

bool sp_nest(const sp_shape *shapes, size_t count, uint32_t limit, sp_spot *spots, uint32_t *page_edge,
             size_t *page_count, sp_error *error)
{
    piece *pieces = cut_pieces(shapes, count);
    search s = {.pieces = pieces, .count = count};
    s.order = malloc((count + 1) * sizeof *s.order);
    s.keys = malloc((count + 1) * sizeof *s.keys);
    s.trial = malloc((count + 1) * sizeof *s.trial);
    s.best = malloc((count + 1) * sizeof *s.best);
    bool done = pieces && s.order && s.keys && s.trial && s.best && order_by_size(shapes, count, s.keys, s.order) &&
                search_edge(&s, shapes, limit) && search_order(&s, shapes);
    if (done) {
        memcpy(spots, s.best, count * sizeof *spots);
        *page_edge = s.best_edge;
        *page_count = s.best_pages ? s.best_pages : 1;
    } else {
        sp_fail_memory(error);
    }
    free_pieces(pieces, count);
    free(s.order);
    free(s.keys);
    free(s.trial);
    free(s.best);
    return done;
}
