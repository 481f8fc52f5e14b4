/* What result.json says of a proposal besides its layout. */
#include "json_put.h"

/* What was asked for; where less is attainable, what was aimed at is less. */
static bool put_target(json_t *root, const sp_proposal *proposal, double clean_area)
{
    json_t *target = json_object();
    bool done = sp_put_real(target, "coverage", proposal->asked_area / clean_area) &&
                sp_put_real(target, "coverage_aimed_at", proposal->target_area / clean_area) &&
                sp_put(target, "reached", json_boolean(proposal->reached));
    return sp_put(root, "target", target) && done;
}

/* `fittings`: with how many nozzles of each point want one. */
static bool put_front(json_t *root, const sp_proposal *proposal, double clean_area, bool fittings)
{
    double whole = proposal->certificate.whole;
    json_t *front = json_array();
    bool done = true;
    for (size_t i = 0; done && i < proposal->front_count; ++i) {
        const sp_front_point *point = &proposal->front[i];
        json_t *entry = json_object();
        done = sp_put_real(entry, "water_l_min", 6e4 * point->flow) &&
               (!proposal->costly || sp_put_real(entry, "price_l_min", 6e4 * point->outlay)) &&
               sp_put_real(entry, "coverage", point->area / clean_area) &&
               sp_put_count(entry, "nozzles", point->nozzles) &&
               (!fittings || sp_put_count(entry, "new_fittings", point->fittings)) &&
               (!proposal->certificate.computed || (sp_put_real(entry, "coverage_on_texels", point->counted / whole) &&
                                                    sp_put_real(entry, "coverage_bound", point->bound / whole))) &&
               (!proposal->certificate.every_aim.computed ||
                sp_put_real(entry, "coverage_bound_every_aim", point->every_aim_bound / whole));
        done = json_array_append_new(front, entry) == 0 && done;
    }
    return sp_put(root, "front", front) && done;
}

static bool put_front_by_nozzles(json_t *root, const sp_proposal *proposal, double clean_area, bool fittings)
{
    json_t *front = json_array();
    bool done = true;
    for (size_t i = 0; done && i < proposal->by_number_count; ++i) {
        const sp_front_point *point = &proposal->by_number[i];
        json_t *entry = json_object();
        done = sp_put_count(entry, "nozzles", point->nozzles) && sp_put_real(entry, "water_l_min", 6e4 * point->flow) &&
               (!proposal->costly || sp_put_real(entry, "price_l_min", 6e4 * point->outlay)) &&
               sp_put_real(entry, "coverage", point->area / clean_area) &&
               (!fittings || sp_put_count(entry, "new_fittings", point->fittings));
        done = json_array_append_new(front, entry) == 0 && done;
    }
    return sp_put(root, "front_by_nozzles", front) && done;
}

/* The keys of bounds: of water, or where mounts cost something of water and cost. */
static const char *const bound_keys[2][2] = {
    {"coverage_bound_same_water", "water_bound_same_coverage_l_min"},
    {"coverage_bound_same_price", "price_bound_same_coverage_l_min"},
};

static bool put_every_aim(json_t *certificate, const sp_certificate *found, bool costly)
{
    json_t *every = json_object();
    bool done = sp_put_count(every, "mounting_points", found->every_aim.places) &&
                sp_put_real(every, bound_keys[costly][0], found->every_aim.area_bound / found->whole) &&
                sp_put_real(every, bound_keys[costly][1], 6e4 * found->every_aim.water_bound) &&
                sp_put_real(every, "gap", found->every_aim.gap);
    return sp_put(certificate, "every_aim", every) && done;
}

static bool put_forward_check(json_t *root, const sp_forward_check *found)
{
    json_t *check = json_object();
    bool done =
        sp_put_real(check, "coverage", found->coverage) && sp_put_real(check, "difference", found->difference) &&
        sp_put_real(check, "tolerance", found->tolerance) && sp_put(check, "agrees", json_boolean(found->agrees)) &&
        sp_put_count(check, "jets", (size_t)found->jets) && sp_put_count(check, "texels", found->texels);
    return sp_put(root, "forward_check", check) && done;
}

/* Everything that it speaks of is counted on its own texels. */
static bool put_certificate(json_t *root, const sp_certificate *found, bool costly)
{
    json_t *certificate = json_object();
    bool done =
        sp_put_text(certificate, "method",
                    found->every_layout ? "every layout of the candidates"
                                        : "lagrangian dual, layouts of few nozzles one by one") &&
        sp_put_real(certificate, "coverage", found->counted / found->whole) &&
        sp_put_real(certificate, bound_keys[costly][0], found->area_bound / found->whole) &&
        sp_put_real(certificate, bound_keys[costly][1], 6e4 * found->water_bound) &&
        sp_put_real(certificate, "gap", found->gap) && sp_put_count(certificate, "candidates", found->candidates) &&
        sp_put_count(certificate, "own_poses", found->own) && sp_put_count(certificate, "texels", found->texels) &&
        (!found->every_aim.computed || put_every_aim(certificate, found, costly));
    return sp_put(root, "certificate", certificate) && done;
}

bool sp_put_proposal(json_t *object, const sp_proposal *proposal, double clean_area, bool fittings)
{
    return put_target(object, proposal, clean_area) && put_front(object, proposal, clean_area, fittings) &&
           put_front_by_nozzles(object, proposal, clean_area, fittings) &&
           (!proposal->forward_check.computed || put_forward_check(object, &proposal->forward_check)) &&
           (!proposal->certificate.computed || put_certificate(object, &proposal->certificate, proposal->costly));
}
