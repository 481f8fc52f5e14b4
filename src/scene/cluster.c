/* The members of a cluster in the catalogue. */
#include "nozzle/layers.h"
#include "scene/state.h"

#include <stdlib.h>
#include <string.h>

/* Equal patterns around the body's axis, as spray balls are drilled: their axes from the ball's middle outwards. */
typedef struct {
    uint64_t count;
    double polar, phase; /* rad: from the body's axis; of the first one's longitude */
    double radius;       /* m, of the ball */
} ring;

static bool read_ring(const sp_reader *reader, const sp_yaml *node, ring *ring)
{
    const sp_yaml *map = sp_yaml_get(node, "ring"), *axis = sp_yaml_get(node, "axis");
    const sp_fields in = {reader, &sp_block_ring, map};
    if (!map)
        return true;
    if (axis)
        return sp_read_message(reader, axis, "axis", "found beside a ring, expected one of them");
    return sp_read_block(&in, "ring") && sp_read_count(&in, "count", &ring->count) &&
           sp_read_quantity(&in, "polar", &ring->polar) && sp_read_quantity(&in, "radius", &ring->radius) &&
           sp_read_quantity(&in, "phase", &ring->phase);
}

/* The image of a member, which has the body's exit speed. */
static bool read_image(sp_scene *scene, const sp_reader *reader, const sp_yaml *node, sp_nozzle_type *type)
{
    if (!sp_scene_read_image(scene, reader, node, type))
        return false;
    if (!sp_type_has_layers(type))
        return true;
    free(type->members);
    return sp_read_fail(reader, sp_yaml_get(node, "image"), "image", "an image without speeds in a cluster");
}

static bool read_member(sp_scene *scene, const sp_reader *reader, const sp_yaml *node, sp_member *member, ring *ring)
{
    const sp_fields in = {reader, &sp_block_member, node};
    if (!sp_read_block(&in, "members"))
        return false;
    const sp_yaml *pattern = sp_yaml_get(node, "pattern");
    if (sp_text_is(pattern, "cluster") || sp_text_is(pattern, "rotating"))
        return sp_read_fail(reader, pattern, "pattern",
                            "full_cone, hollow_cone, flat_fan, solid_stream or measured in a cluster");
    return sp_scene_read_pattern(&in, &member->type) && sp_scene_read_shape(&in, &member->type) &&
           read_image(scene, reader, node, &member->type) && sp_read_axis(&in, "axis", &member->axis) &&
           sp_read_vector(&in, "offset", &member->offset) && sp_read_quantity(&in, "roll", &member->roll) &&
           sp_read_quantity(&in, "share", &member->share) && read_ring(reader, node, ring);
}

/* Member `i` of a ring, in the place of one that stands in its middle. */
static void drill(const ring *ring, uint64_t i, sp_member *member)
{
    double longitude = ring->phase + 2 * acos(-1) * (double)i / (double)ring->count;
    member->axis = sp_v(sin(ring->polar) * cos(longitude), sin(ring->polar) * sin(longitude), cos(ring->polar));
    member->offset = sp_along(member->offset, ring->radius, member->axis);
}

static bool add_members(sp_scene *scene, const sp_reader *reader, const sp_yaml *node, sp_nozzle_type *type)
{
    sp_member member = {.axis = {0, 0, 1}, .share = 1};
    ring ring = {.count = 0};
    if (!read_member(scene, reader, node, &member, &ring))
        return false;
    size_t count = ring.count ? (size_t)ring.count : 1;
    if (type->member_count + count > SP_MEMBERS)
        return sp_read_message(reader, node, "members", "found more than %d patterns, expected at most as many",
                               SP_MEMBERS);
    sp_member *members = realloc(type->members, (type->member_count + count) * sizeof *members);
    if (!members)
        return sp_fail_memory(reader->error);
    type->members = members;
    memcpy(member.type.name, type->name, sizeof member.type.name);
    member.type.drop = type->drop;
    member.type.trajectory = type->trajectory;
    for (size_t i = 0; i < count; i++) {
        members[type->member_count] = member;
        if (ring.count)
            drill(&ring, i, &members[type->member_count]);
        type->member_count++;
    }
    return true;
}

bool sp_scene_read_members(sp_scene *scene, const sp_reader *reader, const sp_yaml *node, sp_nozzle_type *type)
{
    const sp_yaml *list = sp_yaml_get(node, "members");
    if (type->pattern != SP_PATTERN_CLUSTER)
        return true;
    if (list->kind != SP_YAML_LIST || list->count == 0)
        return sp_read_fail(reader, list, "members",
                            "a list of patterns such as [{pattern: solid_stream, axis: [0, 0, 1]}, ...]");
    for (const sp_yaml *child = list->first; child; child = child->next)
        if (!add_members(scene, reader, child, type))
            return false;
    return true;
}
