#include "bound/branch_work.h"
#include "mesh/grow.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define PIECES_MOST 4
#define FEW 2             /* nozzles of a slot that is cut into more than two pieces */
#define SIDE_LEAST 0.1    /* of what the linear program takes of a slot, that lies on either side of a good cut */
#define SPREAD_LEAST 0.02 /* of a nozzle, that it takes of others than the one it takes most of */
#define OUTLINE_MOST 32   /* candidates whose rows are looked at one by one */
#define OPEN_MOST 200000  /* branches; beyond, they part no more */

typedef struct {
    size_t first, end;
} piece;

sp_branch sp_tree_take(sp_tree *tree, size_t i)
{
    sp_branch taken = tree->open[i];
    tree->open[i] = tree->open[--tree->count];
    return taken;
}

static size_t alive_in(const sp_branching *b, size_t first, size_t end)
{
    return b->alive_before[end] - b->alive_before[first];
}

/* Trims the range to what is alive in it; false where nothing is. */
static bool trim(const sp_branching *b, piece *p)
{
    if (p->first >= p->end || !alive_in(b, p->first, p->end))
        return false;
    size_t low = p->first, high = p->end;
    while (high - low > 1) {
        size_t middle = low + (high - low) / 2;
        if (alive_in(b, p->first, middle))
            high = middle;
        else
            low = middle;
    }
    size_t first = low, from = low;
    for (high = p->end; high - from > 1;) {
        size_t middle = from + (high - from) / 2;
        if (alive_in(b, middle, p->end))
            from = middle;
        else
            high = middle;
    }
    *p = (piece){first, from + 1};
    return true;
}

/* The port that the whole slot is; SP_NO_PORT where it is more. */
static size_t port_of(const sp_branching *b, const sp_slot *slot)
{
    size_t run = sp_line_run(b->line, slot->first);
    return slot->end <= b->line->run_start[run + 1] ? b->line->run_port[run] : SP_NO_PORT;
}

/* Two nozzles in one port, or a candidate chosen twice where it must not be. */
static bool clashes(const sp_branching *b, const sp_branch *branch)
{
    for (size_t i = 0; i < branch->slot_count; i++) {
        const sp_slot *slot = &branch->slots[i];
        size_t port = port_of(b, slot);
        if (slot->count > 1 &&
            (port != SP_NO_PORT || (!b->cover->repeats && slot->count > alive_in(b, slot->first, slot->end))))
            return true;
        for (size_t k = 0; port != SP_NO_PORT && k < i; k++)
            if (port_of(b, &branch->slots[k]) == port)
                return true;
    }
    return false;
}

/* The branch without slot `without` (SIZE_MAX: with all), and with room for `more` others. */
static bool copy_branch(const sp_branch *from, size_t without, size_t more, sp_branch *to, sp_error *error)
{
    *to = *from;
    to->solves = to->slot_count = 0;
    to->slots = malloc((from->slot_count + more + 1) * sizeof *to->slots);
    if (!to->slots)
        return sp_fail_memory(error);
    for (size_t i = 0; i < from->slot_count; i++)
        if (i != without)
            to->slots[to->slot_count++] = from->slots[i];
    return true;
}

/* Of the candidates alive in the piece, the least weight: they stand by falling weight. */
static uint32_t weight_of(const sp_branching *b, piece p)
{
    return b->line->weight[sp_line_kind(b->line, p.end - 1)];
}

/* The most that any candidate alive in a slot brings to a texel: on all of it, and by itself to a part of it. */
typedef struct {
    float whole, part;
} most_of;

static void note_most(const sp_rows *rows, most_of *most)
{
    for (size_t k = 0; k < rows->used; k++) {
        most_of *own = &most[rows->texel[k]];
        if (rows->share[k] < 0)
            own->part = fmaxf(own->part, -rows->share[k]);
        else
            own->whole = fmaxf(own->whole, rows->share[k]);
    }
}

/* What the slots would cover if each nozzle brought every texel the most that any candidate alive in its slot does; a
 * layout that is all there is left is covered exactly, but where a texel may be covered in several ways: then no less.
 * Shares are rounded upwards, and so is their sum. */
static bool outline(const sp_branching *b, const sp_tree *tree, const sp_branch *branch, double *area, sp_error *error)
{
    const sp_cover *cover = b->cover;
    most_of *most = calloc(cover->texel_count + 1, sizeof *most);
    double *sum = calloc(cover->texel_count + 1, sizeof *sum), *lit = calloc(cover->texel_count + 1, sizeof *lit);
    bool done = (most && sum && lit) || sp_fail_memory(error);
    for (size_t i = 0; done && i < branch->slot_count; i++) {
        const sp_slot *slot = &branch->slots[i];
        sp_rows rows = {0};
        for (size_t at = slot->first; done && at < slot->end; at++)
            done = !tree->alive[at] || b->line->row(b->line->user, at, &rows, error);
        note_most(&rows, most);
        for (size_t t = 0; done && t < cover->texel_count; t++) {
            sum[t] += (double)most[t].whole * slot->count * (1 + 1e-6);
            lit[t] = 1 - (1 - lit[t]) * pow(1 - (double)most[t].part, slot->count);
            most[t] = (most_of){0};
        }
        sp_rows_free(&rows);
    }
    *area = cover->base;
    for (size_t t = 0; done && t < cover->texel_count; t++)
        *area += (sum[t] >= 1 ? 1 : lit[t]) * (double)cover->area[t];
    *area *= 1 + 1e-6;
    free(most);
    free(sum);
    free(lit);
    return done;
}

/* Lowers the bound of a branch whose slots are narrow and all that there is. */
static bool lower_narrow(const sp_branching *b, const sp_tree *tree, sp_branch *branch, sp_error *error)
{
    size_t alive = 0;
    for (size_t i = 0; i < branch->slot_count; i++)
        alive += alive_in(b, branch->slots[i].first, branch->slots[i].end);
    if (alive > OUTLINE_MOST || sp_rest_fits(b, branch->rest, branch->nozzles, branch->water))
        return true;
    double area;
    bool done = outline(b, tree, branch, &area, error);
    branch->bound = fmin(branch->bound, area);
    return done;
}

/* Opens the branch, bounded by the last prices; takes its slots over. */
static bool open_branch(sp_branching *b, sp_tree *tree, sp_branch *child, sp_error *error)
{
    const sp_line *line = b->line;
    double value;
    while (child->rest < line->kind_count && line->weight[child->rest] > child->water)
        child->rest++;
    if (!child->nozzles)
        child->rest = line->kind_count;
    bool done = sp_branch_value(b, child, &value, error), alive = true;
    for (size_t i = 0; i < child->slot_count; i++)
        alive &= alive_in(b, child->slots[i].first, child->slots[i].end) > 0;
    child->bound = fmin(child->bound, alive ? value : tree->found);
    bool clash = clashes(b, child);
    if (done && !clash && child->bound > tree->found)
        done = lower_narrow(b, tree, child, error);
    if (done && !clash && child->bound > tree->found) {
        if (sp_grow(&tree->open, &tree->capacity, tree->count + 1, sizeof *tree->open)) {
            tree->open[tree->count++] = *child;
            return true;
        }
        done = sp_fail_memory(error);
    }
    if (done && !clash)
        tree->shut = fmax(tree->shut, child->bound);
    free(child->slots);
    return done;
}

/* How many of the nozzles in no slot are of the heaviest kinds of those: of which no more than a few fit. */
static bool part_rest(sp_branching *b, sp_tree *tree, const sp_branch *branch, sp_error *error)
{
    const sp_line *line = b->line;
    size_t fit = branch->water / line->weight[branch->rest], last = branch->rest + 1;
    while (last < line->kind_count && line->weight[last] > branch->water / (fit + 1))
        last++;
    piece p = {line->kind_start[branch->rest], line->kind_start[last]};
    uint32_t weight = trim(b, &p) ? weight_of(b, p) : 0;
    for (size_t n = 0; n <= branch->nozzles && (!n || (weight && n * weight <= branch->water)); n++) {
        sp_branch child;
        if (!copy_branch(branch, SIZE_MAX, 1, &child, error))
            return false;
        child.rest = last;
        if (n) {
            child.slots[child.slot_count++] = (sp_slot){p.first, p.end, weight, (uint32_t)n};
            child.nozzles -= n;
            child.water -= n * weight;
        }
        if (!open_branch(b, tree, &child, error))
            return false;
    }
    return true;
}

/* What the linear program takes of a range, and the most of one candidate of it. */
static double mass_of(const sp_branching *b, size_t first, size_t end, double *most)
{
    double mass = 0;
    *most = 0;
    for (size_t c = 0; c < b->rows.count; c++)
        if (b->rows.key[c] >= first && b->rows.key[c] < end) {
            mass += sp_dual_choice(&b->dual, c);
            *most = fmax(*most, sp_dual_choice(&b->dual, c));
        }
    return mass;
}

/* The slot that the linear program is least decided about; SIZE_MAX where every slot is down to one candidate. */
static size_t slot_to_part(const sp_branching *b, const sp_branch *branch)
{
    size_t best = SIZE_MAX, best_alive = 0;
    double best_spread = 0;
    for (size_t i = 0; i < branch->slot_count; i++) {
        const sp_slot *slot = &branch->slots[i];
        double most, mass = mass_of(b, slot->first, slot->end, &most), spread = fmax(0, mass - most);
        size_t alive = alive_in(b, slot->first, slot->end);
        if (spread < SPREAD_LEAST)
            spread = 0;
        if (alive > 1 && (spread > best_spread || (spread == best_spread && alive > best_alive))) {
            best = i;
            best_spread = spread;
            best_alive = alive;
        }
    }
    return best;
}

static size_t cut(const sp_line *line, size_t first, size_t end)
{
    size_t kind = sp_line_kind(line, first), last = sp_line_kind(line, end - 1);
    return kind < last ? line->kind_start[kind + (last - kind + 1) / 2] : line->cut(line->user, first, end);
}

/* Cuts the range where what the linear program takes of it falls apart. */
static size_t cut_slot(const sp_branching *b, const sp_slot *slot, piece pieces[PIECES_MOST])
{
    double most, whole = mass_of(b, slot->first, slot->end, &most);
    piece p = {slot->first, slot->end};
    size_t middle = cut(b->line, p.first, p.end);
    while (slot->count <= FEW && whole > 0) {
        double left = mass_of(b, p.first, middle, &most), right = mass_of(b, middle, p.end, &most);
        if (fmin(left, right) >= SIDE_LEAST * whole)
            break;
        piece side = left > right ? (piece){p.first, middle} : (piece){middle, p.end};
        if (!trim(b, &side) || alive_in(b, side.first, side.end) < 2)
            break;
        p = side;
        middle = cut(b->line, p.first, p.end);
    }
    const piece all[PIECES_MOST] = {{slot->first, p.first}, {p.first, middle}, {middle, p.end}, {p.end, slot->end}};
    size_t count = 0;
    for (size_t i = 0; i < PIECES_MOST; i++) {
        pieces[count] = all[i];
        count += trim(b, &pieces[count]);
    }
    return count;
}

/* Spreads the slot's nozzles over the pieces in every way: `left` of them over pieces[from ..]. */
static bool spread(sp_branching *b, sp_tree *tree, const sp_branch *branch, const piece *pieces, size_t count,
                   uint32_t left, uint32_t chosen[PIECES_MOST], size_t from, size_t slot, sp_error *error)
{
    if (from + 1 < count) {
        for (uint32_t n = 0; n <= left; n++) {
            chosen[from] = n;
            if (!spread(b, tree, branch, pieces, count, left - n, chosen, from + 1, slot, error))
                return false;
        }
        return true;
    }
    chosen[from] = left;
    sp_branch child;
    if (!copy_branch(branch, slot, count, &child, error))
        return false;
    child.water += branch->slots[slot].count * (size_t)branch->slots[slot].weight;
    for (size_t i = 0; i < count; i++) {
        uint32_t weight = weight_of(b, pieces[i]);
        if (!chosen[i])
            continue;
        if ((size_t)chosen[i] * weight > child.water) {
            free(child.slots);
            return true;
        }
        child.water -= (size_t)chosen[i] * weight;
        child.slots[child.slot_count++] = (sp_slot){pieces[i].first, pieces[i].end, weight, chosen[i]};
    }
    return open_branch(b, tree, &child, error);
}

bool sp_tree_part(sp_branching *b, sp_tree *tree, size_t i, sp_error *error)
{
    if (tree->count >= OPEN_MOST)
        return true;
    sp_branch branch = sp_tree_take(tree, i);
    bool rest = sp_rest_fits(b, branch.rest, branch.nozzles, branch.water) > 0, done;
    size_t slot = rest ? SIZE_MAX : slot_to_part(b, &branch);
    if (rest) {
        done = part_rest(b, tree, &branch, error);
    } else if (slot == SIZE_MAX) {
        done = lower_narrow(b, tree, &branch, error);
        tree->shut = fmax(tree->shut, branch.bound);
    } else {
        piece pieces[PIECES_MOST];
        uint32_t chosen[PIECES_MOST];
        size_t count = cut_slot(b, &branch.slots[slot], pieces);
        done = !count || spread(b, tree, &branch, pieces, count, branch.slots[slot].count, chosen, 0, slot, error);
    }
    free(branch.slots);
    return done;
}
