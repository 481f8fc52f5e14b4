/* Figures as data: room for them, copies, their end. */
#include "figures.h"
#include "growing_text.h"

#include <stdlib.h>

static void figures_clear(sp_figures *figures)
{
    for (size_t i = 0; i < figures->shadow_count; ++i) {
        free(figures->shadows[i].part);
        free(figures->shadows[i].nozzle);
        free(figures->shadows[i].remedy.type);
        free(figures->shadows[i].remedy.port);
    }
    for (size_t i = 0; i < figures->nozzle_count; ++i) {
        free(figures->nozzles[i].name);
        free(figures->nozzles[i].type);
        free(figures->nozzles[i].order_code);
        free(figures->nozzles[i].url);
        free(figures->nozzles[i].overlap);
    }
    for (size_t i = 0; i < figures->missing_count; ++i)
        free(figures->missing[i].part);
    for (size_t i = 0; i < figures->part_count; ++i)
        free(figures->parts[i].part);
    free(figures->parts);
    free(figures->shadows);
    free(figures->nozzles);
    free(figures->missing);
    free(figures->name);
}

void sp_figures_destroy(sp_figures *figures, size_t count)
{
    if (!figures)
        return;
    for (size_t i = 0; i < count; ++i)
        figures_clear(&figures[i]);
    free(figures);
}

double sp_figures_price(const sp_figures *figures)
{
    return figures->flow + figures->mount_cost;
}

double sp_figures_money(const sp_figures *figures)
{
    return figures->water_cost.money > 0 ? sp_figures_price(figures) * figures->water_cost.money : NAN;
}

static bool same_area(double a, double b)
{
    return (isnan(a) && isnan(b)) || fabs(a - b) <= 1e-9 * fmax(a, b);
}

bool sp_same_surface(const sp_figures *a, const sp_figures *b)
{
    return a->triangles == b->triangles && same_area(a->area, b->area) && same_area(a->clean_area, b->clean_area);
}

bool sp_figures_tell_surface(const sp_figures *figures)
{
    return figures->triangles != SP_UNKNOWN && isfinite(figures->clean_area);
}

bool sp_figures_share_surface(const sp_figures *figures, size_t count)
{
    const sp_figures *first = NULL;
    bool share = true;
    for (size_t i = 0; share && i < count; ++i) {
        if (!sp_figures_tell_surface(&figures[i]))
            continue;
        first = first ? first : &figures[i];
        share = sp_same_surface(first, &figures[i]);
    }
    return share;
}

bool sp_figures_share_texel(const sp_figures *figures, size_t count)
{
    double shortest = INFINITY, longest = 0;
    for (size_t i = 0; i < count; ++i) {
        shortest = fmin(shortest, figures[i].texel);
        longest = fmax(longest, figures[i].texel);
    }
    return longest <= shortest * (1 + 1e-9);
}

bool sp_figures_make_rows(sp_figures *figures, size_t shadows, size_t nozzles)
{
    figures->shadows = calloc(shadows + 1, sizeof *figures->shadows);
    figures->nozzles = calloc(nozzles + 1, sizeof *figures->nozzles);
    if (!figures->shadows || !figures->nozzles)
        return false;
    figures->shadow_count = shadows;
    figures->nozzle_count = nozzles;
    return true;
}

bool sp_figures_make_missing(sp_figures *figures, size_t count)
{
    figures->missing = calloc(count + 1, sizeof *figures->missing);
    figures->missing_count = figures->missing ? count : 0;
    return figures->missing != NULL;
}

bool sp_figures_make_parts(sp_figures *figures, size_t count)
{
    figures->parts = calloc(count + 1, sizeof *figures->parts);
    figures->part_count = figures->parts ? count : 0;
    return figures->parts != NULL;
}

/* A borrowed text becomes one's own; NULL where memory runs out. */
static bool own(char **text)
{
    *text = sp_text_utf8(*text);
    return *text != NULL;
}

static bool copy_missing(sp_figures *to, const sp_figures *from)
{
    if (!sp_figures_make_missing(to, from->missing_count))
        return false;
    bool copied = true;
    for (size_t i = 0; i < to->missing_count; ++i) {
        to->missing[i] = from->missing[i];
        copied &= own(&to->missing[i].part);
    }
    return copied;
}

static bool copy_parts(sp_figures *to, const sp_figures *from)
{
    if (!sp_figures_make_parts(to, from->part_count))
        return false;
    bool copied = true;
    for (size_t i = 0; i < to->part_count; ++i) {
        to->parts[i] = from->parts[i];
        copied &= own(&to->parts[i].part);
    }
    return copied;
}

bool sp_figures_copy(sp_figures *to, const sp_figures *from)
{
    *to = *from;
    to->name = NULL;
    to->shadows = NULL;
    to->nozzles = NULL;
    to->missing = NULL;
    to->parts = NULL;
    to->shadow_count = to->nozzle_count = to->missing_count = to->part_count = 0;
    if (!copy_missing(to, from) || !copy_parts(to, from) ||
        !sp_figures_make_rows(to, from->shadow_count, from->nozzle_count))
        return false;
    bool copied = true;
    for (size_t i = 0; i < to->shadow_count; ++i) {
        to->shadows[i] = from->shadows[i];
        copied &= own(&to->shadows[i].part);
        copied &= own(&to->shadows[i].nozzle);
        copied &= own(&to->shadows[i].remedy.type);
        copied &= own(&to->shadows[i].remedy.port);
    }
    for (size_t i = 0; i < to->nozzle_count; ++i) {
        to->nozzles[i] = from->nozzles[i];
        sp_nozzle_figures *nozzle = &to->nozzles[i];
        copied &= own(&nozzle->name);
        copied &= own(&nozzle->type);
        copied &= own(&nozzle->order_code);
        copied &= own(&nozzle->url);
        copied &= own(&nozzle->overlap);
    }
    return copied;
}
