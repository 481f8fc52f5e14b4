/* What became of each part's surface, for whoever looks after the geometry. */
#include "spray/wet/wet.h"

#include "mesh/diagnosis/flaw.h"

static void add_side(const sp_wet *wet, size_t side, sp_part_sides *part)
{
    double area = wet->faces.area[side / 2];
    if (wet->flooded.liquid[side])
        part->wet += area;
    else if (wet->faces.state[side] == SP_FACE_FREE)
        part->dry += area;
    else if (wet->faces.state[side] == SP_FACE_INSIDE)
        part->inside += area;
    else if (wet->faces.state[side] == SP_FACE_TOUCHING)
        part->touching += area;
}

static void add_face(const sp_wet *wet, size_t face, sp_part_sides *part)
{
    uint32_t shell = wet->shells.of[sp_face_triangle(&wet->faces, (uint32_t)face)];
    bool closed = wet->shells.closed[shell], back = closed && wet->shells.turn[shell] < 0;
    const bool *liquid = &wet->flooded.liquid[2 * face];
    for (size_t side = 0; side < 2; side++)
        if (!closed || side == back || liquid[side])
            add_side(wet, 2 * face + side, part);
    part->both += closed && liquid[0] && liquid[1] ? wet->faces.area[face] : 0;
}

void sp_evaluator_part_sides(const sp_evaluator *evaluator, sp_part_sides *parts)
{
    const sp_mesh *mesh = evaluator->setup.mesh;
    const sp_wet *wet = evaluator->wet;
    for (size_t i = 0; i < mesh->part_count; i++)
        parts[i] = (sp_part_sides){0};
    if (evaluator->setup.cavity == SP_CAVITY_NONE) {
        for (uint32_t t = 0; t < mesh->triangle_count; t++)
            parts[mesh->part[t]].wet += sp_triangle_area(mesh, t);
        return;
    }
    for (size_t face = 0; face < wet->faces.count; face++)
        add_face(wet, face, &parts[mesh->part[sp_face_triangle(&wet->faces, (uint32_t)face)]]);
}

sp_geometry_account sp_evaluator_account(const sp_evaluator *evaluator)
{
    const sp_mesh *mesh = evaluator->setup.mesh;
    const sp_shells *shells = &evaluator->wet->shells;
    sp_geometry_account account = {.left_out = mesh->source_triangle_count - mesh->triangle_count,
                                   .sides_known = evaluator->setup.cavity != SP_CAVITY_NONE};
    if (!account.sides_known)
        return account;
    for (size_t s = 0; s < shells->count; s++) {
        account.open += !shells->closed[s];
        account.closed += shells->closed[s];
        if (shells->turn[s] < 0)
            sp_flaw_add(&account.turned, sp_judged_point_of(mesh, mesh->triangles[shells->widest[s]]));
    }
    for (uint32_t t = 0; t < mesh->triangle_count; t++)
        account.open_area += shells->closed[shells->of[t]] ? 0 : sp_triangle_area(mesh, t);
    for (size_t face = 0; face < evaluator->wet->faces.count; face++)
        add_face(evaluator->wet, face, &account.sides);
    account.outdoors = sp_evaluator_outdoors(evaluator);
    return account;
}

const sp_opening *sp_evaluator_openings(const sp_evaluator *evaluator, size_t *count)
{
    *count = evaluator->wet->flooded.opening_count;
    return evaluator->wet->flooded.openings;
}

size_t sp_evaluator_more_openings(const sp_evaluator *evaluator)
{
    return evaluator->wet->flooded.more_openings;
}

double sp_evaluator_outdoors(const sp_evaluator *evaluator)
{
    return evaluator->wet->flooded.outdoors;
}
