#include "refine/settable.h"

#include "ranking/ranking.h"
#include "refine/pose_parameters.h"
#include "scoring/bodies.h"
#include "scoring/field.h"

#define ROUNDS 3        /* of looking at the settings beside those of the best layout */
#define SPARE 5e-3      /* of the target: about as much is lost where a layout is set */
#define SET_WITHIN 1e-6 /* of a step, for what is at a setting: places are rounded where they are written */

typedef enum { SETTING_DEPTH, SETTING_TILT, SETTING_ANGLE, SETTING_FLOW, SETTINGS } sp_setting;

/* What one setting of a nozzle is, and what it may be. */
typedef struct {
    sp_step step; /* count 0: there are no steps */
    double from, value, low, high;
} sp_dial;

static const sp_mount *mount_of(const sp_search *search, const sp_placed *placed)
{
    return &search->options->mounts[placed->site.mount];
}

/* m³/s of water at the type's own pressure, per m³/s as sprayed. */
static double rating(const sp_search *search, const sp_placed *placed)
{
    const sp_nozzle_type *type = placed->nozzle.type;
    return type->flow /
           sp_type_flow(type, type->flow, placed->nozzle.pressure, &sp_evaluator_setup(search->coarse)->liquid);
}

static double lean(sp_vec3 axis, sp_vec3 from)
{
    return atan2(sp_length(sp_cross(axis, from)), sp_dot(axis, from));
}

static sp_dial dial_of(const sp_search *search, const sp_placed *placed, sp_setting setting)
{
    const sp_mount *mount = mount_of(search, placed);
    const sp_nozzle_type *type = placed->nozzle.type;
    double low, high;
    switch (setting) {
    case SETTING_DEPTH:
        return (sp_dial){mount->depth_step, mount->depth_from,
                         sp_dot(sp_sub(placed->nozzle.position, mount->position), mount->axis), mount->depth_from,
                         mount->depth_to};
    case SETTING_TILT:
        return (sp_dial){mount->tilt_step, 0, lean(placed->nozzle.axis, mount->axis), 0, mount->tilt};
    case SETTING_ANGLE:
        sp_angle_range(search->options, type, &low, &high);
        return (sp_dial){type->angle_step, type->angle, sp_nozzle_angle(&placed->nozzle), low, high};
    case SETTING_FLOW:
        sp_flow_range(search->options, sp_evaluator_setup(search->coarse), type, placed->nozzle.pressure, &low, &high);
        double rated = rating(search, placed);
        return (sp_dial){type->flow_step, type->flow, placed->flow * rated, low * rated, high * rated};
    case SETTINGS:
        break;
    }
    return (sp_dial){0};
}

/* Leaned from the mount's axis by `tilt`, the way that it leans. False where it leans nowhere. */
static bool set_tilt(const sp_search *search, sp_placed *placed, double tilt)
{
    sp_vec3 up = sp_evaluator_setup(search->coarse)->up, mid = mount_of(search, placed)->axis, axis = mid;
    sp_vec3 aside = sp_sub(placed->nozzle.axis, sp_scale(mid, sp_dot(placed->nozzle.axis, mid)));
    if (tilt > 0 && !(sp_length(aside) > 1e-9))
        return false;
    if (tilt > 0)
        axis = sp_unit(sp_add(sp_scale(mid, cos(tilt)), sp_scale(sp_unit(aside), sin(tilt))));
    if (sp_type_roll_period(placed->nozzle.type) > 0)
        placed->nozzle.roll = sp_carried_roll(&placed->nozzle, axis, up);
    placed->nozzle.axis = axis;
    return true;
}

static bool set(const sp_search *search, sp_placed *placed, sp_setting setting, double value)
{
    const sp_setup *setup = sp_evaluator_setup(search->coarse);
    sp_site site = placed->site;
    switch (setting) {
    case SETTING_DEPTH:
        site.position = sp_setup_told(setup, sp_port_place(setup, mount_of(search, placed), value));
        if (!sp_site_allowed(search->coarse, search->options, &site))
            return false;
        placed->site = site;
        placed->nozzle.position = site.position;
        return true;
    case SETTING_TILT:
        return set_tilt(search, placed, value);
    case SETTING_ANGLE:
        placed->nozzle.angle = value;
        return true;
    case SETTING_FLOW:
        placed->nozzle.flow = placed->flow =
            sp_type_flow(placed->nozzle.type, value, placed->nozzle.pressure, &setup->liquid);
        return true;
    case SETTINGS:
        break;
    }
    return false;
}

/* The dial at the setting `steps` from the one nearest to where it is. False where that is not to be had. */
static bool turn(const sp_search *search, sp_placed *placed, sp_setting setting, double steps)
{
    sp_dial dial = dial_of(search, placed, setting);
    double size = sp_step_size(dial.step);
    if (!(size > 0) || !(dial.high > dial.low))
        return steps == 0;
    double nearest = sp_step_nearest(dial.step, dial.from, dial.value, dial.low, dial.high);
    double value = sp_step_nearest(dial.step, dial.from, nearest + steps * size, dial.low, dial.high);
    return (steps == 0 || fabs(value - nearest) > 0.5 * size) && set(search, placed, setting, value);
}

/* The depth by so many steps from the nearest, if the nozzle keeps clear of the others there. */
static bool turn_depth_to(const sp_search *search, sp_partial *partial, size_t i, double steps)
{
    sp_placed *placed = &partial->items[i], before = *placed;
    if (turn(search, placed, SETTING_DEPTH, steps) &&
        sp_body_clear_of_others(search, partial, i, sp_nozzle_body(&placed->nozzle)))
        return true;
    *placed = before;
    return false;
}

/* The depth that may be set nearest to where the lance ends: at least one may, that of the candidate. */
static void turn_depth(const sp_search *search, sp_partial *partial, size_t i)
{
    sp_dial dial = dial_of(search, &partial->items[i], SETTING_DEPTH);
    double size = sp_step_size(dial.step), most = size > 0 ? (dial.high - dial.low) / size + 1 : 0;
    for (double away = 0; away <= most; away++)
        if (turn_depth_to(search, partial, i, away) || turn_depth_to(search, partial, i, -away))
            return;
}

/* Down or up for `way` -1 or 1, else to the nearest. */
static void turn_flow(const sp_search *search, sp_placed *placed, int way)
{
    sp_dial dial = dial_of(search, placed, SETTING_FLOW);
    double size = sp_step_size(dial.step);
    if (!(size > 0) || !(dial.high > dial.low))
        return;
    double nearest = sp_step_nearest(dial.step, dial.from, dial.value, dial.low, dial.high);
    bool passed = way * (nearest - dial.value) < -1e-9 * size;
    turn(search, placed, SETTING_FLOW, passed ? way : 0);
}

/* Nozzle i at settings. What no pattern kernel sums stands at those of a candidate. */
static void turn_all(const sp_search *search, sp_partial *partial, size_t i, int way)
{
    sp_placed *placed = &partial->items[i];
    if (!sp_type_is_uniform(placed->nozzle.type))
        return;
    turn_depth(search, partial, i);
    turn(search, placed, SETTING_TILT, 0);
    turn(search, placed, SETTING_ANGLE, 0);
    turn_flow(search, placed, way);
}

static bool look(const sp_search *search, sp_placed *placed, sp_error *error)
{
    return !sp_type_is_uniform(placed->nozzle.type) ||
           sp_field_nozzle(search, &placed->nozzle, NULL, placed->field, error);
}

/* A layout whose nozzles were set, into the front where it is within the water. */
static bool measure(const sp_search *search, sp_front *front, sp_partial *partial, sp_error *error)
{
    sp_partial_refresh(search, partial);
    return partial->flow > search->options->max_water * (1 + SP_ROUNDING) ||
           sp_front_measure(front, search, partial, NULL, error);
}

static bool set_partial(const sp_search *search, const sp_partial *from, int way, sp_front *front, sp_error *error)
{
    sp_partial partial;
    if (!sp_partial_copy(search, from, &partial, error))
        return false;
    bool done = true;
    for (size_t i = 0; done && i < partial.count; i++) {
        turn_all(search, &partial, i, way);
        done = look(search, &partial.items[i], error);
    }
    done = done && measure(search, front, &partial, error);
    sp_partial_free(&partial);
    return done;
}

/* True where turn_all would leave the nozzle as it is. */
static bool is_set(const sp_search *search, const sp_placed *placed)
{
    for (sp_setting setting = 0; setting < SETTINGS && sp_type_is_uniform(placed->nozzle.type); setting++) {
        sp_dial dial = dial_of(search, placed, setting);
        double size = sp_step_size(dial.step);
        double away = dial.value - sp_step_nearest(dial.step, dial.from, dial.value, dial.low, dial.high);
        if (size > 0 && dial.high > dial.low && fabs(away) > SET_WITHIN * size)
            return false;
    }
    return true;
}

static bool all_set(const sp_search *search, const sp_partial *partial)
{
    for (size_t i = 0; i < partial->count; i++)
        if (!is_set(search, &partial->items[i]))
            return false;
    return true;
}

/* What needs no turning is known, however short the time is. */
static bool keep_set(const sp_search *search, const sp_front_list *list, sp_front *front, sp_error *error)
{
    bool done = true;
    for (size_t i = 0; done && i < list->count; i++) {
        sp_front_point point = list->entries[i].point;
        if (all_set(search, &list->entries[i].partial))
            done = sp_front_note(front, search, &list->entries[i].partial, &point, error);
    }
    return done;
}

/* What is on the front in the end is to be set, too. */
static void forget_unset(const sp_search *search, sp_front_list *counted)
{
    size_t kept = 0;
    for (size_t i = 0; i < counted->count; i++) {
        sp_front_entry *entry = &counted->entries[i];
        if (all_set(search, &entry->partial))
            counted->entries[kept++] = *entry;
        else
            sp_partial_free(&entry->partial);
    }
    counted->count = kept;
}

static bool has_flow_steps(const sp_partial *partial)
{
    for (size_t i = 0; i < partial->count; i++)
        if (partial->items[i].nozzle.type->flow_step.count > 0)
            return true;
    return false;
}

/* With flows nearest to what they were, all down, and all up. */
static bool set_partials(const sp_search *search, const sp_partial *partial, sp_front *front, sp_error *error)
{
    return set_partial(search, partial, 0, front, error) &&
           (!has_flow_steps(partial) ||
            (set_partial(search, partial, -1, front, error) && set_partial(search, partial, 1, front, error)));
}

/* One dial of the best layout one step on; whether that is better the front decides. */
static bool try_beside(const sp_search *search, sp_front *front, size_t i, sp_setting setting, double steps,
                       sp_error *error)
{
    sp_partial partial;
    if (!(dial_of(search, &front->best.items[i], setting).step.count > 0))
        return true;
    if (!sp_partial_copy(search, &front->best, &partial, error))
        return false;
    bool done = true;
    if (turn(search, &partial.items[i], setting, steps))
        done = look(search, &partial.items[i], error) && measure(search, front, &partial, error);
    sp_partial_free(&partial);
    return done;
}

static bool look_beside(const sp_search *search, sp_deadline *deadline, sp_front *front, sp_error *error)
{
    for (int round = 0; round < ROUNDS; round++) {
        sp_front_point before = front->measured;
        for (size_t i = 0; i < front->best.count; i++)
            for (sp_setting setting = 0; setting < SETTINGS; setting++)
                for (int way = -1; way <= 1 && sp_type_is_uniform(front->best.items[i].nozzle.type); way += 2)
                    if (sp_deadline_goes_on(deadline, "refine", 1) &&
                        !try_beside(search, front, i, setting, way, error))
                        return false;
        if (!sp_front_better(front, &front->measured, &before))
            return true;
    }
    return true;
}

static bool has_steps(const sp_place_options *options)
{
    bool any = false;
    for (size_t m = 0; m < options->mount_count; m++)
        any |= options->mounts[m].depth_step.count > 0 || options->mounts[m].tilt_step.count > 0;
    for (size_t t = 0; t < options->type_count; t++)
        any |= options->types[t]->angle_step.count > 0 || options->types[t]->flow_step.count > 0;
    return any;
}

static const sp_front_entry *entry_at(const sp_front *front, size_t at)
{
    size_t first = front->by_water.count;
    return at < first ? &front->by_water.entries[at] : &front->by_number.entries[at - first];
}

/* How late a layout is to be set: where time is short what is proposed will be one of the first. The best, which just
 * reaches the target, may no longer do so once it is set; what reaches it with something to spare will. */
static double lateness(const sp_front *front, const sp_front_point *point)
{
    if (!sp_front_saves(front))
        return front->measured.area - point->area;
    if (point->area >= front->target)
        return fabs(point->area - (1 + SPARE) * front->target);
    return sp_evaluator_patches(front->fine)->total_area + front->target - point->area;
}

/* Layouts of both fronts that are not set, besides the best; malloc'd, NULL when memory runs out. */
static sp_ranked *rank_unset(const sp_search *search, const sp_front *front, size_t *count)
{
    size_t all = front->by_water.count + front->by_number.count;
    sp_ranked *ranked = malloc((all + 1) * sizeof *ranked);
    *count = 0;
    for (size_t at = 0; ranked && at < all; at++) {
        const sp_front_entry *entry = entry_at(front, at);
        bool best = entry->point.outlay == front->measured.outlay && entry->point.area == front->measured.area;
        if (!best && !all_set(search, &entry->partial))
            ranked[(*count)++] = (sp_ranked){lateness(front, &entry->point), at};
    }
    if (ranked)
        sp_rank_rising(ranked, *count);
    return ranked;
}

/* As far as time goes, the best in any case. */
static bool set_unset(const sp_search *search, const sp_front *before, sp_deadline *deadline, sp_front *front,
                      sp_error *error)
{
    size_t count;
    sp_ranked *ranked = rank_unset(search, before, &count);
    bool done = ranked ? set_partials(search, &before->best, front, error) : sp_fail_memory(error) != NULL;
    for (size_t i = 0; done && i < count && sp_deadline_goes_on(deadline, "refine", 1); i++)
        done = set_partials(search, &entry_at(before, ranked[i].at)->partial, front, error);
    free(ranked);
    return done;
}

bool sp_set_front(const sp_search *search, sp_deadline *deadline, sp_front *front, sp_error *error)
{
    if (!has_steps(search->options))
        return true;
    sp_front before = *front;
    *front = sp_front_anew(&before);
    forget_unset(search, &front->counted);
    bool done = keep_set(search, &before.by_water, front, error) && keep_set(search, &before.by_number, front, error) &&
                set_unset(search, &before, deadline, front, error);
    sp_front_free(&before);
    return done && look_beside(search, deadline, front, error);
}
