/* Clusters: several patterns on one body, such as a spray ball with its holes. */
#include "pattern.h"
#include "rotation.h"

static double member_angle(const sp_member *member)
{
    sp_spray spray = sp_spray_create(&member->type, member->type.angle);
    return atan2(hypot(member->axis.x, member->axis.y), member->axis.z) + sp_spray_reach(&spray);
}

static double reach_of(const sp_nozzle_type *cluster)
{
    double widest = 0;
    for (size_t i = 0; i < cluster->member_count; i++)
        widest = fmax(widest, member_angle(&cluster->members[i]));
    return fmin(widest, M_PI);
}

double sp_type_reach(const sp_nozzle_type *type, double angle)
{
    sp_spray spray = sp_spray_create(type, angle);
    return type->pattern == SP_PATTERN_CLUSTER ? reach_of(type) : sp_spray_reach(&spray);
}

double sp_nozzle_angle(const sp_nozzle *nozzle)
{
    const sp_nozzle_type *type = nozzle->type;
    if (nozzle->angle > 0 || type->pattern != SP_PATTERN_CLUSTER)
        return nozzle->angle > 0 ? nozzle->angle : type->angle;
    return 2 * reach_of(type);
}

double sp_nozzle_cone(const sp_nozzle *nozzle)
{
    double angle = sp_nozzle_angle(nozzle);
    return sp_type_rotates(nozzle->type) ? 2 * sp_type_reach(nozzle->type, angle) : angle;
}

size_t sp_nozzle_pattern_count(const sp_nozzle *nozzle)
{
    return nozzle->type->pattern == SP_PATTERN_CLUSTER ? nozzle->type->member_count : 1;
}

/* A direction of the body's frame in world coordinates. */
static sp_vec3 outwards(const sp_frame *body, sp_vec3 d)
{
    return sp_along(sp_along(sp_scale(body->x, d.x), d.y, body->y), d.z, body->z);
}

/* By how much a nozzle along `axis` is rolled whose x is this. */
static double roll_of(sp_vec3 axis, sp_vec3 x, sp_vec3 up)
{
    sp_frame level = sp_nozzle_frame(axis, 0, up);
    return atan2(sp_dot(x, level.y), sp_dot(x, level.x));
}

/* Turns a pattern that stands as its member does in the body's frame to where it points in the world. */
static void aim(sp_nozzle *pattern, const sp_member *member, const sp_nozzle *nozzle, const sp_frame *body, sp_vec3 up)
{
    if (member->axis.x == 0 && member->axis.y == 0 && member->axis.z > 0) { /* as the body itself, without round-off */
        pattern->axis = nozzle->axis;
        pattern->roll = nozzle->roll + member->roll;
        return;
    }
    sp_frame own = sp_nozzle_frame(member->axis, member->roll, sp_v(0, 0, 1));
    pattern->axis = sp_unit(outwards(body, own.z));
    pattern->roll = roll_of(pattern->axis, outwards(body, own.x), up);
}

/* So many of `all` that shares from `before` to `after` have: as whole numbers they add up to all. */
static uint64_t jets_between(uint64_t all, double before, double after)
{
    double jets = round((double)all * after) - round((double)all * before);
    return jets < 1 ? 1 : (uint64_t)jets;
}

void sp_nozzle_patterns(const sp_nozzle *nozzle, const sp_fluid *liquid, sp_vec3 up, sp_nozzle *patterns)
{
    const sp_nozzle_type *type = nozzle->type;
    patterns[0] = *nozzle;
    if (type->pattern != SP_PATTERN_CLUSTER)
        return;
    sp_frame body = sp_nozzle_frame(nozzle->axis, nozzle->roll, up);
    double flow = sp_nozzle_flow(nozzle, liquid), speed = sp_nozzle_speed(nozzle, liquid), all = 0, before = 0;
    for (size_t i = 0; i < type->member_count; i++)
        all += type->members[i].share;
    for (size_t i = 0; i < type->member_count; i++) {
        const sp_member *member = &type->members[i];
        sp_nozzle *pattern = &patterns[i];
        double after = before + member->share;
        *pattern = *nozzle;
        pattern->type = &member->type;
        pattern->position = sp_add(nozzle->position, outwards(&body, member->offset));
        pattern->angle = 0;
        pattern->flow = flow * (member->share / all);
        pattern->speed = member->speed > 0 ? speed * member->speed : speed;
        pattern->jets = nozzle->jets ? jets_between(nozzle->jets, before / all, after / all) : 0;
        aim(pattern, member, nozzle, &body, up);
        before = after;
    }
}
