/* Patches: the clean, wet part of each texel, on each side. */
#include "judged_point.h"
#include "spray/state/state.h"

#include <assert.h>
#include <stdlib.h>

/* Where one patch is judged, and how large it is. */
typedef struct {
    double area;
    sp_vec3 point;
    uint32_t triangle;
} patch_place;

/* A patch while its pieces are being visited. */
typedef struct {
    sp_judged_point middle;
    double area;       /* m², as the atlas measured it */
    uint32_t triangle; /* of the fragment in hand */
} patch_sum;

static void add_piece(void *user, const sp_vec3 *polygon, int corners, double area)
{
    patch_sum *sum = user;
    sp_judged_point_add(&sum->middle, polygon, corners);
    sum->area += area;
}

static void look_at_piece(void *user, const sp_vec3 *polygon, int corners, double area)
{
    patch_sum *sum = user;
    (void)area;
    sp_judged_point_look(&sum->middle, polygon, corners, sum->triangle);
}

#define PARTS 997 /* of a pixel: finer than triangles lie apart, far coarser than round-off */

/* A fragment, and where the middle of its triangle lies on the page. */
typedef struct {
    double along[2];
    sp_fragment fragment;
} spotted;

static int by_spot(const void *a, const void *b)
{
    const spotted *one = a, *two = b;
    for (int k = 0; k < 2; k++)
        if (one->along[k] != two->along[k])
            return one->along[k] < two->along[k] ? -1 : 1;
    return one->fragment.triangle < two->fragment.triangle ? -1 : one->fragment.triangle > two->fragment.triangle;
}

static void order_texel(const sp_atlas *atlas, sp_fragment *items, size_t count, spotted *room)
{
    for (size_t i = 0; i < count; i++) {
        const double(*uv)[2] = (const double(*)[2])atlas->uv[items[i].triangle];
        room[i] = (spotted){.fragment = items[i]};
        for (int k = 0; k < 2; k++)
            room[i].along[k] = rint((uv[0][k] + uv[1][k] + uv[2][k]) * (PARTS / 3.0));
    }
    qsort(room, count, sizeof *room, by_spot);
    for (size_t i = 0; i < count; i++)
        items[i] = room[i].fragment;
}

/* Which of a texel's fragments comes first decides where it is judged if several would do as well: no matter of how
 * triangles are numbered, which pages do in their own way. False where memory runs out. */
static bool order_fragments(const sp_atlas *atlas, sp_fragments *fragments)
{
    size_t most = 0;
    for (size_t texel = 0; texel < atlas->texel_count; texel++) {
        assert(fragments->start[texel] <= fragments->start[texel + 1]);
        size_t count = fragments->start[texel + 1] - fragments->start[texel];
        most = count > most ? count : most;
    }
    spotted *room = malloc((most + 1) * sizeof *room);
    for (size_t texel = 0; room && texel < atlas->texel_count; texel++)
        order_texel(atlas, fragments->items + fragments->start[texel],
                    fragments->start[texel + 1] - fragments->start[texel], room);
    free(room);
    return room != NULL;
}

static void visit_patch(const sp_evaluator *evaluator, uint32_t texel, unsigned side, sp_counted_visitor *visit,
                        patch_sum *sum)
{
    const sp_fragments *fragments = &evaluator->fragments;
    for (uint32_t f = fragments->start[texel]; f < fragments->start[texel + 1]; f++) {
        sum->triangle = fragments->items[f].triangle;
        sp_counted_pieces(evaluator, texel, &fragments->items[f], side, visit, sum);
    }
}

/* False where the texel has nothing to count on that side. */
static bool place_patch(const sp_evaluator *evaluator, uint32_t texel, unsigned side, patch_place *place)
{
    patch_sum sum = {0};
    visit_patch(evaluator, texel, side, add_piece, &sum);
    if (!(sum.middle.area > 0 && sum.area > 0))
        return false;
    visit_patch(evaluator, texel, side, look_at_piece, &sum);
    *place = (patch_place){sum.area, sum.middle.point, sum.middle.triangle};
    return sum.middle.found;
}

static bool allocate_patches(sp_patches *patches, size_t count)
{
    size_t room = count ? count : 1;
    patches->count = count;
    patches->texel = malloc(room * sizeof *patches->texel);
    patches->side = malloc(room * sizeof *patches->side);
    patches->area = malloc(room * sizeof *patches->area);
    patches->point = malloc(room * sizeof *patches->point);
    patches->normal = malloc(room * sizeof *patches->normal);
    patches->triangle = malloc(room * sizeof *patches->triangle);
    patches->length = malloc(room * sizeof *patches->length);
    patches->neighbour_start = malloc((count + 1) * sizeof *patches->neighbour_start);
    return patches->texel && patches->side && patches->area && patches->point && patches->normal && patches->triangle &&
           patches->length && patches->neighbour_start;
}

/* Copies the places found on front and back of every texel into patches, and numbers them. */
static void number_patches(sp_evaluator *evaluator, patch_place (*places)[2])
{
    sp_patches *patches = &evaluator->patches;
    bool sided = evaluator->setup.cavity != SP_CAVITY_NONE;
    uint32_t patch = 0;
    for (size_t texel = 0; texel < evaluator->atlas->texel_count; texel++) {
        for (unsigned side = 0; side < 2; side++) {
            const patch_place *place = &places[texel][side];
            evaluator->texel_patch[texel][side] = place->triangle == SP_NONE ? SP_NONE : patch;
            if (place->triangle == SP_NONE)
                continue;
            sp_vec3 normal = sp_triangle_normal(evaluator->setup.mesh, place->triangle);
            patches->texel[patch] = (uint32_t)texel;
            patches->side[patch] = !sided ? SP_SIDE_BOTH : side ? SP_SIDE_BACK : SP_SIDE_FRONT;
            assert(patch < patches->count && place->area > 0);
            patches->area[patch] = place->area;
            patches->point[patch] = place->point;
            patches->normal[patch] = side ? sp_scale(normal, -1) : normal;
            patches->triangle[patch] = place->triangle;
            patches->total_area += place->area;
            patch++;
        }
    }
}

static bool set_lengths(sp_evaluator *evaluator)
{
    const sp_atlas *atlas = evaluator->atlas;
    sp_patches *patches = &evaluator->patches;
    double *area = calloc(atlas->chart_count + 1, sizeof *area);
    for (size_t texel = 0; area && texel < atlas->texel_count; texel++)
        area[sp_atlas_place(atlas, (uint32_t)texel).chart] += atlas->texel_area[texel];
    for (size_t patch = 0; area && patch < patches->count; patch++)
        patches->length[patch] = fmin(sp_atlas_texel_length(atlas, patches->triangle[patch]),
                                      sqrt(area[sp_atlas_place(atlas, patches->texel[patch]).chart]));
    bool done = area != NULL;
    free(area);
    return done;
}

/* Neighbours of a patch: the patches on the same side of the texels that touch its own. */
static bool link_patches(sp_evaluator *evaluator, const sp_texel_links *touching)
{
    sp_patches *patches = &evaluator->patches;
    size_t links = 0; /* the caller has seen to it that they fit */
    for (int pass = 0; pass < 2; pass++) {
        links = 0;
        for (size_t patch = 0; patch < patches->count; patch++) {
            uint32_t texel = patches->texel[patch];
            bool back = patches->side[patch] == SP_SIDE_BACK;
            patches->neighbour_start[patch] = (uint32_t)links;
            for (uint32_t k = touching->start[texel]; k < touching->start[texel + 1]; k++) {
                uint32_t other = evaluator->texel_patch[touching->items[k]][back];
                if (other == SP_NONE)
                    continue;
                if (pass)
                    patches->neighbours[links] = other;
                links++;
            }
        }
        if (!pass)
            patches->neighbours = malloc((links ? links : 1) * sizeof *patches->neighbours);
        if (!patches->neighbours)
            return false;
    }
    patches->neighbour_start[patches->count] = (uint32_t)links;
    return true;
}

/* Patches and their neighbours have numbers of 32 bits. Every link of two texels is one of two patches on either side.
 */
static bool numbers_fit(const sp_evaluator *evaluator, size_t patches, size_t texel_links, sp_error *error)
{
    return (patches < SP_NONE && texel_links < SP_NONE / 2) ||
           sp_fail(error, SP_ERROR_INPUT, NULL, 0, 0,
                   "a texel of %g m cuts the surface into %zu patches, too many: take a coarser one",
                   evaluator->atlas->texel, patches);
}

static bool fill_patches(sp_evaluator *evaluator, patch_place (*places)[2], size_t count, sp_error *error)
{
    if (!numbers_fit(evaluator, count, 0, error))
        return false;
    if (!allocate_patches(&evaluator->patches, count))
        return sp_fail_memory(error);
    number_patches(evaluator, places);
    sp_texel_links touching = {0};
    bool done = set_lengths(evaluator) || sp_fail_memory(error);
    done = done && sp_texel_links_create(&touching, evaluator->atlas, evaluator->setup.mesh, error) &&
           numbers_fit(evaluator, count, touching.start[evaluator->atlas->texel_count], error) &&
           (link_patches(evaluator, &touching) || sp_fail_memory(error));
    sp_texel_links_destroy(&touching);
    return done;
}

bool sp_patches_create(sp_evaluator *evaluator, sp_error *error)
{
    size_t texels = evaluator->atlas->texel_count;
    patch_place(*places)[2] = malloc((texels ? texels : 1) * sizeof *places);
    evaluator->texel_patch = malloc((texels ? texels : 1) * sizeof *evaluator->texel_patch);
    if (!places || !evaluator->texel_patch || !order_fragments(evaluator->atlas, &evaluator->fragments)) {
        free(places);
        return sp_fail_memory(error);
    }
#pragma omp parallel for schedule(dynamic, 256) num_threads(sp_thread_count(evaluator->setup.run.threads))
    for (size_t texel = 0; texel < texels; texel++)
        for (unsigned side = 0; side < 2; side++)
            if (!place_patch(evaluator, (uint32_t)texel, side, &places[texel][side]))
                places[texel][side].triangle = SP_NONE;
    size_t count = 0;
    for (size_t texel = 0; texel < texels; texel++)
        count += (places[texel][0].triangle != SP_NONE) + (places[texel][1].triangle != SP_NONE);
    bool done = fill_patches(evaluator, places, count, error);
    free(places);
    return done;
}

void sp_patches_free(sp_patches *patches)
{
    free(patches->texel);
    free(patches->side);
    free(patches->area);
    free(patches->point);
    free(patches->normal);
    free(patches->triangle);
    free(patches->length);
    free(patches->neighbour_start);
    free(patches->neighbours);
    *patches = (sp_patches){0};
}
