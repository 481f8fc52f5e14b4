#include "splat.h"

#include <assert.h>
#include <string.h>

/* Adds a share in proportion to the patch's area, unless that texel has no patch on the side that was hit, or
 * has its share already. */
static void add_share(const sp_evaluator *evaluator, uint32_t texel, bool back, double weight, sp_shares *shares)
{
    uint32_t patch = evaluator->texel_patch[texel][evaluator->setup.cavity != SP_CAVITY_NONE && back];
    bool known = patch == SP_NONE;
    for (int i = 0; i < shares->count; i++)
        known = known || shares->patch[i] == patch;
    if (known)
        return;
    assert(shares->count < SP_SPLAT_CORNERS * SP_SPLAT_SIDES && weight >= 0);
    shares->patch[shares->count] = patch;
    shares->share[shares->count++] = weight * evaluator->patches.area[patch];
}

/* The first texel of a pixel on the page of `home`, SP_NONE where it is not of that chart. */
static uint32_t pixel_of(const sp_atlas *atlas, const sp_texel_place *home, double x, double y)
{
    if (!(x >= 0 && y >= 0 && x < atlas->page_edge && y < atlas->page_edge))
        return SP_NONE;
    uint32_t texel = sp_atlas_pixel(atlas, home->page, (uint32_t)x, (uint32_t)y);
    return texel != SP_NONE && sp_atlas_place(atlas, texel).chart == home->chart ? texel : SP_NONE;
}

/* Shares among the texels of one chart whose centres are around a point of its page. `own`, of that chart, is meant
 * where a pixel has several. */
static void share_around(const sp_evaluator *evaluator, const double place[2], uint32_t own, bool back,
                         sp_shares *shares)
{
    const sp_atlas *atlas = evaluator->atlas;
    sp_texel_place home = sp_atlas_place(atlas, own);
    double corner[2] = {floor(place[0] - 0.5), floor(place[1] - 0.5)};
    for (int i = 0; i < SP_SPLAT_CORNERS; i++) {
        double x = corner[0] + i % 2, y = corner[1] + i / 2;
        double weight = (1 - fabs(place[0] - 0.5 - x)) * (1 - fabs(place[1] - 0.5 - y));
        uint32_t texel = x == home.x && y == home.y ? own : pixel_of(atlas, &home, x, y);
        if (texel != SP_NONE && weight > 0)
            add_share(evaluator, texel, back, weight, shares);
    }
}

/* Where a point lies on the pages: on its own and, across seams, on others. */
typedef struct {
    double place[SP_SPLAT_SIDES][2];
    uint32_t texel[SP_SPLAT_SIDES]; /* one there */
    int count;
} whereabouts;

static bool is_known(const sp_atlas *atlas, const whereabouts *found, uint32_t chart, const double place[2])
{
    for (int k = 0; k < found->count; k++)
        if (fabs(place[0] - found->place[k][0]) < 1 && fabs(place[1] - found->place[k][1]) < 1 &&
            sp_atlas_place(atlas, found->texel[k]).chart == chart)
            return true;
    return false;
}

/* Adds where what lies at found->place[from] lies across the seams of a texel beside it. Where the texels there are of
 * another length it is taken for nowhere: each side shares by itself, as at a rim, and neither takes from the other. */
static void look_across(const sp_evaluator *evaluator, uint32_t texel, int from, whereabouts *found)
{
    const sp_atlas *atlas = evaluator->atlas;
    size_t count;
    const sp_seam *seams = sp_atlas_seams(atlas, texel, &count);
    for (size_t i = 0; i < count && found->count < SP_SPLAT_SIDES; i++) {
        double there[2];
        if (sp_atlas_texel_length(atlas, seams[i].edge / 3) != sp_atlas_texel_length(atlas, seams[i].across / 3))
            continue;
        sp_atlas_across(atlas, evaluator->setup.mesh, &seams[i], found->place[from], there);
        if (is_known(atlas, found, sp_atlas_place(atlas, seams[i].other).chart, there))
            continue;
        memcpy(found->place[found->count], there, sizeof there);
        found->texel[found->count++] = seams[i].other;
    }
}

/* Looks across all seams less than a texel away, and from there on where several charts meet. */
static void look_around(const sp_evaluator *evaluator, whereabouts *found)
{
    const sp_atlas *atlas = evaluator->atlas;
    for (int from = 0; from < found->count && found->count < SP_SPLAT_SIDES; from++) {
        sp_texel_place home = sp_atlas_place(atlas, found->texel[from]);
        const double *place = found->place[from];
        look_across(evaluator, found->texel[from], from, found);
        for (int i = 0; i < 9; i++) {
            double x = floor(place[0]) + i % 3 - 1, y = floor(place[1]) + i / 3 - 1;
            uint32_t texel = pixel_of(atlas, &home, x, y);
            if (texel != SP_NONE)
                look_across(evaluator, texel, from, found);
        }
    }
}

void sp_share_linearly(const sp_evaluator *evaluator, const sp_hit *hit, bool back, uint32_t patch, sp_shares *shares)
{
    const double(*uv)[2] = (const double(*)[2])evaluator->atlas->uv[hit->triangle];
    uint32_t own = sp_atlas_texel(evaluator->atlas, hit->triangle, hit->u, hit->v);
    double w = 1 - hit->u - hit->v, sum = 0;
    whereabouts found = {.texel = {own}, .count = 1};
    for (int axis = 0; axis < 2; axis++)
        found.place[0][axis] = w * uv[0][axis] + hit->u * uv[1][axis] + hit->v * uv[2][axis];
    shares->count = 0;
    share_around(evaluator, found.place[0], own, back, shares);
    look_around(evaluator, &found);
    for (int i = 1; i < found.count; i++)
        share_around(evaluator, found.place[i], found.texel[i], back, shares);
    for (int i = 0; i < shares->count; i++)
        sum += shares->share[i];
    if (!(sum > 0)) {
        *shares = (sp_shares){.patch = {patch}, .share = {1}, .count = 1};
        return;
    }
    for (int i = 0; i < shares->count; i++)
        shares->share[i] /= sum;
}
