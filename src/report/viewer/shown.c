#include "shown.h"

#include "live.h"

#include <string.h>

static bool same_mesh(const sp_setup *a, const sp_setup *b)
{
    const sp_mesh *p = a->mesh, *q = b->mesh;
    bool same = p->vertex_count == q->vertex_count && p->triangle_count == q->triangle_count &&
                p->part_count == q->part_count && sp_distance(a->origin, b->origin) == 0 &&
                memcmp(p->vertices, q->vertices, p->vertex_count * sizeof *p->vertices) == 0 &&
                memcmp(p->triangles, q->triangles, p->triangle_count * sizeof *p->triangles) == 0 &&
                memcmp(p->part, q->part, p->triangle_count * sizeof *p->part) == 0;
    for (size_t i = 0; same && i < p->part_count; i++)
        same = strcmp(p->parts[i].name, q->parts[i].name) == 0 && a->surfaces[i].clean == b->surfaces[i].clean;
    return same;
}

static bool same_atlas(const sp_atlas *a, const sp_atlas *b)
{
    return a->page_edge == b->page_edge && a->page_count == b->page_count && a->chart_count == b->chart_count &&
           a->pixel_count == b->pixel_count && a->texel_count == b->texel_count && a->run_count == b->run_count &&
           memcmp(a->chart, b->chart, a->triangle_count * sizeof *a->chart) == 0 &&
           memcmp(a->chart_page, b->chart_page, a->chart_count * sizeof *a->chart_page) == 0 &&
           memcmp(a->uv, b->uv, a->triangle_count * sizeof *a->uv) == 0;
}

static bool same_patches(const sp_patches *a, const sp_patches *b)
{
    return a->count == b->count && memcmp(a->texel, b->texel, a->count * sizeof *a->texel) == 0 &&
           memcmp(a->side, b->side, a->count * sizeof *a->side) == 0;
}

static bool same_surface(const sp_evaluator *a, const sp_evaluator *b)
{
    if (a == b)
        return true;
    const sp_setup *one = sp_evaluator_setup(a), *other = sp_evaluator_setup(b);
    bool same = one->cavity == other->cavity && same_mesh(one, other) &&
                same_atlas(sp_evaluator_atlas(a), sp_evaluator_atlas(b)) &&
                same_patches(sp_evaluator_patches(a), sp_evaluator_patches(b));
    for (uint32_t t = 0; same && t < one->mesh->triangle_count; t++)
        same = sp_evaluator_wet(a, t) == sp_evaluator_wet(b, t);
    return same;
}

const sp_evaluator *sp_viewer_evaluator(const sp_page *page, size_t design)
{
    const sp_evaluator *own = page->result->designs[design].evaluator;
    const sp_evaluator *live = page->live ? sp_page_live_evaluator(page) : NULL;
    if (!own || (live && same_surface(live, own)))
        return own ? live : NULL;
    for (size_t i = 0; i < design; i++) {
        const sp_evaluator *other = page->result->designs[i].evaluator;
        if (other && same_surface(other, own))
            return other;
    }
    return own;
}
