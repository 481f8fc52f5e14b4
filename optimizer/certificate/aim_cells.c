#include "certificate/aim_cells.h"

#include "scoring/view.h"

#include <stdlib.h>
#include <string.h>

#define FLOW_STEPS 12     /* into which a range of flows falls */
#define LEVEL_FIRST 3     /* of the squares into which all axes fall first */
#define RATIO 1.1         /* from one radius to the next: few, so that what they cull can be kept */
#define EXTENT_LEAST 1e-3 /* rad, that makes a difference */
#define SMALLER 0.7       /* than the tilt are the squares into which all axes fall first */
#define MARGIN 1e-5       /* rad, beyond what single precision puts on the wrong side of a pattern's edge */

static bool kind_create(const sp_search *search, const sp_variant *variant, sp_aim_kind *kind)
{
    double low, high;
    *kind = (sp_aim_kind){.type = variant->type, .pressure = variant->pressure, .launch = variant->launch};
    sp_angle_range(search->options, variant->type, &kind->angle_low, &kind->angle_high);
    sp_flow_range(search->options, sp_evaluator_setup(search->coarse), variant->type, variant->pressure, &low, &high);
    kind->step_count = high > low * (1 + 1e-9) ? FLOW_STEPS : 1;
    kind->edge = malloc((kind->step_count + 1) * sizeof *kind->edge);
    for (size_t i = 0; kind->edge && i <= kind->step_count; i++)
        kind->edge[i] = i < kind->step_count ? low + (high - low) * (double)i / (double)kind->step_count : high;
    return kind->edge;
}

/* Variants of one kind follow one another. */
bool sp_aim_kinds_create(const sp_search *search, sp_aim_kinds *kinds, sp_error *error)
{
    const sp_candidates *candidates = search->candidates;
    *kinds = (sp_aim_kinds){.items = calloc(candidates->variant_count, sizeof *kinds->items)};
    bool done = kinds->items;
    for (size_t k = 0; done && k < candidates->variant_count; k++) {
        const sp_variant *variant = &candidates->variants[k];
        const sp_aim_kind *last = kinds->count ? &kinds->items[kinds->count - 1] : NULL;
        if (last && last->type == variant->type && last->pressure == variant->pressure)
            continue;
        done = kind_create(search, variant, &kinds->items[kinds->count]);
        kinds->items[kinds->count++].variant = k;
    }
    return done || sp_fail_memory(error);
}

void sp_aim_kinds_free(sp_aim_kinds *kinds)
{
    for (size_t i = 0; kinds->items && i < kinds->count; i++)
        free(kinds->items[i].edge);
    free(kinds->items);
    *kinds = (sp_aim_kinds){0};
}

sp_aim_cell sp_aim_cell_whole(const sp_aim_kind *kind, uint32_t site, uint32_t number, uint32_t step)
{
    double half = 0.5 * sp_type_roll_period(kind->type);
    return (sp_aim_cell){.site = site,
                         .kind = number,
                         .step = step,
                         .level = -1,
                         .roll = half,
                         .roll_half = half,
                         .angle_low = kind->angle_low,
                         .angle_high = kind->angle_high,
                         .upper = INFINITY};
}

static double angle_between(sp_vec3 a, sp_vec3 b)
{
    return atan2(sp_length(sp_cross(a, b)), sp_dot(a, b));
}

/* The sides of a square's image are arcs of great circles, also of the two halves where the map is folded along its
 * diagonal: its corners lie farthest out. */
sp_aim_disc sp_aim_cell_disc(const sp_aim_cell *cell, const sp_site *site, double tilt)
{
    if (cell->level < 0)
        return (sp_aim_disc){site->axis, fmin(M_PI, tilt)};
    double edge = ldexp(2, -cell->level), radius = 0;
    sp_aim_disc disc = {.axis = sp_octahedron_decode(cell->u + 0.5 * edge, cell->v + 0.5 * edge)};
    for (int corner = 0; corner < 4; corner++)
        radius = fmax(radius, angle_between(disc.axis, sp_octahedron_decode(cell->u + edge * (corner & 1),
                                                                            cell->v + edge * (corner >> 1))));
    disc.radius = pow(RATIO, ceil(log(radius) / log(RATIO)));
    return disc;
}

/* Turning by `radius` moves no direction farther than that, so that a pattern's directions stay within it as widened by
 * the radius. */
sp_spray sp_aim_cell_spray(const sp_aim_cell *cell, const sp_aim_kind *kind, double radius)
{
    sp_spray low = sp_spray_create(kind->type, cell->angle_low), wide = sp_spray_create(kind->type, cell->angle_high);
    return sp_spray_widened(&low, &wide, radius, cell->roll_half, MARGIN);
}

sp_frame sp_aim_cell_frame(const sp_aim_cell *cell, const sp_aim_disc *disc, sp_vec3 up)
{
    return sp_nozzle_frame(disc->axis, cell->roll, up);
}

/* A cone's solid angle rises with its angle, and may fall again where it is hollow and opens beyond a half-space: it is
 * least at an end. */
static double thickest(const sp_aim_cell *cell, const sp_aim_kind *kind, double *solid_angle)
{
    double low = sp_spray_create(kind->type, cell->angle_low).solid_angle;
    double high = sp_spray_create(kind->type, cell->angle_high).solid_angle;
    *solid_angle = fmin(low, high);
    return low <= high ? cell->angle_low : cell->angle_high;
}

double sp_aim_cell_intensity(const sp_aim_cell *cell, const sp_aim_kind *kind)
{
    double solid_angle;
    thickest(cell, kind, &solid_angle);
    return kind->edge[cell->step + 1] / solid_angle;
}

double sp_aim_cell_intensity_least(const sp_aim_cell *cell, const sp_aim_kind *kind)
{
    return kind->edge[cell->step] / sp_type_solid_angle_most(kind->type, cell->angle_low, cell->angle_high);
}

sp_aim_cell sp_aim_cell_middle(const sp_aim_cell *cell, const sp_aim_kind *kind)
{
    double solid_angle;
    sp_aim_cell middle = *cell;
    middle.roll_half = 0;
    middle.angle_low = middle.angle_high = thickest(cell, kind, &solid_angle);
    return middle;
}

/* Whether some axis of the cell is within the tilt. */
static bool is_allowed(const sp_aim_cell *cell, const sp_site *site, double tilt)
{
    sp_aim_disc disc = sp_aim_cell_disc(cell, site, tilt);
    return angle_between(disc.axis, site->axis) <= tilt + disc.radius + MARGIN;
}

/* The cell's square, or the sphere, in squares of the next level. */
static size_t quarter(const sp_aim_cell *cell, const sp_site *site, double tilt, sp_aim_cell *children)
{
    int level = cell->level < 0 ? LEVEL_FIRST : cell->level + 1;
    size_t across = cell->level < 0 ? 1u << LEVEL_FIRST : 2, count = 0;
    double edge = ldexp(2, -level);
    for (size_t i = 0; i < across * across; i++) {
        sp_aim_cell child = *cell;
        child.level = level;
        child.u = (cell->level < 0 ? -1 : cell->u) + edge * (double)(i % across);
        child.v = (cell->level < 0 ? -1 : cell->v) + edge * (double)(i / across);
        if (is_allowed(&child, site, tilt))
            children[count++] = child;
    }
    return count;
}

/* All axes within a small tilt fall at once into squares smaller than that. */
static size_t split_axes(const sp_aim_cell *cell, const sp_site *site, double tilt,
                         sp_aim_cell children[SP_AIM_CHILDREN])
{
    size_t count = quarter(cell, site, tilt, children);
    while (cell->level < 0 && 4 * count <= SP_AIM_CHILDREN &&
           sp_aim_cell_disc(&children[0], site, tilt).radius > SMALLER * tilt) {
        sp_aim_cell before[SP_AIM_CHILDREN];
        size_t had = count;
        memcpy(before, children, had * sizeof *before);
        count = 0;
        for (size_t i = 0; i < had; i++)
            count += quarter(&before[i], site, tilt, &children[count]);
    }
    return count;
}

/* How far the aims of a cell lie from its middle, rad. */
typedef struct {
    double axes, rolls, angles, most;
} extent;

static extent extent_of(const sp_aim_cell *cell, const sp_aim_kind *kind, const sp_site *site, double tilt)
{
    sp_spray narrow = sp_spray_create(kind->type, cell->angle_low),
             spray = sp_spray_create(kind->type, cell->angle_high);
    extent extent = {.axes = sp_spray_is_isotropic(&narrow) ? 0 : sp_aim_cell_disc(cell, site, tilt).radius,
                     .rolls = cell->roll_half * sin(fmin(sp_spray_reach(&spray), M_PI / 2)),
                     .angles = 0.5 * (cell->angle_high - cell->angle_low)};
    extent.most = fmax(extent.axes, fmax(extent.rolls, extent.angles));
    return extent;
}

bool sp_aim_cell_splits(const sp_aim_cell *cell, const sp_aim_kind *kind, const sp_site *site, double tilt)
{
    return extent_of(cell, kind, site, tilt).most >= EXTENT_LEAST;
}

size_t sp_aim_cell_split(const sp_aim_cell *cell, const sp_aim_kind *kind, const sp_site *site, double tilt,
                         sp_aim_cell children[SP_AIM_CHILDREN])
{
    extent extent = extent_of(cell, kind, site, tilt);
    if (extent.axes == extent.most)
        return split_axes(cell, site, tilt, children);
    children[0] = children[1] = *cell;
    if (extent.rolls == extent.most) {
        children[0].roll_half = children[1].roll_half = 0.5 * cell->roll_half;
        children[0].roll -= 0.5 * cell->roll_half;
        children[1].roll += 0.5 * cell->roll_half;
    } else
        children[0].angle_high = children[1].angle_low = 0.5 * (cell->angle_low + cell->angle_high);
    return 2;
}
