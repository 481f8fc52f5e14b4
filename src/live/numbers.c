#include "live/numbers.h"

#include "nozzle/rotation.h"

#include <math.h>
#include <string.h>

void sp_live_write_type(const sp_nozzle_type *type, size_t first_member, double numbers[SP_LIVE_TYPE_NUMBERS])
{
    const sp_rotation *turns = &type->rotation;
    const double all[SP_LIVE_TYPE_NUMBERS] = {type->pattern,
                                              type->angle,
                                              type->hollow,
                                              type->thickness,
                                              type->flow,
                                              type->at,
                                              type->exponent,
                                              type->cv,
                                              type->drop,
                                              type->angle_min,
                                              type->angle_max,
                                              type->flow_min,
                                              type->flow_max,
                                              turns->jet,
                                              turns->tilt,
                                              turns->roll,
                                              turns->jets,
                                              turns->gears[0],
                                              turns->gears[1],
                                              (double)first_member,
                                              (double)type->member_count,
                                              type->trajectory};
    memcpy(numbers, all, sizeof all);
}

void sp_live_write_member(const sp_member *member, size_t type, double numbers[SP_LIVE_MEMBER_NUMBERS])
{
    const double all[SP_LIVE_MEMBER_NUMBERS] = {(double)type,   member->offset.x, member->offset.y, member->offset.z,
                                                member->axis.x, member->axis.y,   member->axis.z,   member->roll,
                                                member->share,  member->speed};
    memcpy(numbers, all, sizeof all);
}

void sp_live_write_nozzle(const sp_nozzle *nozzle, size_t type, double numbers[SP_LIVE_NOZZLE_NUMBERS])
{
    const double all[SP_LIVE_NOZZLE_NUMBERS] = {(double)type,
                                                nozzle->position.x,
                                                nozzle->position.y,
                                                nozzle->position.z,
                                                nozzle->axis.x,
                                                nozzle->axis.y,
                                                nozzle->axis.z,
                                                nozzle->roll,
                                                nozzle->pressure,
                                                nozzle->angle,
                                                nozzle->flow,
                                                nozzle->speed,
                                                1};
    memcpy(numbers, all, sizeof all);
}

static bool whole(double number, double most)
{
    return number >= 0 && number <= most && number == floor(number);
}

/* Of a pattern that numbers tell; of a jet one that may turn. */
static bool is_pattern(double number)
{
    return whole(number, (double)sp_form_count - 1) && !sp_forms[(size_t)number]->image;
}
static bool is_jet(double number)
{
    return whole(number, (double)sp_form_count - 1) && sp_pattern_turns((sp_pattern)number);
}

bool sp_live_read_type(const double n[SP_LIVE_TYPE_NUMBERS], sp_nozzle_type *type, size_t *first_member)
{
    if (!is_pattern(n[0]) || !is_jet(n[13]) || !whole(n[16], 1e6) || !whole(n[17], 1e6) || !whole(n[18], 1e6) ||
        !whole(n[19], 1e9) || !whole(n[20], SP_MEMBERS) || !whole(n[21], SP_TRAJECTORY_PARABOLA))
        return false;
    *type = (sp_nozzle_type){.pattern = (sp_pattern)n[0],
                             .angle = n[1],
                             .hollow = n[2],
                             .thickness = n[3],
                             .flow = n[4],
                             .at = n[5],
                             .exponent = n[6],
                             .cv = n[7],
                             .drop = n[8],
                             .angle_min = n[9],
                             .angle_max = n[10],
                             .flow_min = n[11],
                             .flow_max = n[12],
                             .rotation = {.jet = (sp_pattern)n[13],
                                          .tilt = n[14],
                                          .roll = n[15],
                                          .jets = (unsigned)n[16],
                                          .gears = {(unsigned)n[17], (unsigned)n[18]}},
                             .member_count = (size_t)n[20],
                             .trajectory = (sp_trajectory)n[21]};
    *first_member = (size_t)n[19];
    return true;
}

sp_member sp_live_read_member(const double n[SP_LIVE_MEMBER_NUMBERS])
{
    return (sp_member){
        .offset = {n[1], n[2], n[3]}, .axis = {n[4], n[5], n[6]}, .roll = n[7], .share = n[8], .speed = n[9]};
}

sp_nozzle sp_live_read_nozzle(const double n[SP_LIVE_NOZZLE_NUMBERS])
{
    return (sp_nozzle){.position = {n[1], n[2], n[3]},
                       .axis = {n[4], n[5], n[6]},
                       .roll = n[7],
                       .pressure = n[8],
                       .angle = n[9],
                       .flow = n[10],
                       .speed = n[11]};
}
