/* Every patch as a point for ParaView. */
#include "channels.h"
#include "vtp.h"

#include "result/design.h"

#include <sprayplan/report.h>

static double in_turn(sp_vec3 v, int component)
{
    return component == 0 ? v.x : component == 1 ? v.y : v.z;
}

static double place_of(const void *of, int which, size_t patch, int component)
{
    const sp_evaluator *evaluator = ((const sp_design *)of)->evaluator;
    (void)which;
    return in_turn(sp_setup_outside(sp_evaluator_setup(evaluator), sp_evaluator_patches(evaluator)->point[patch]),
                   component);
}

static double normal_of(const void *of, int which, size_t patch, int component)
{
    (void)which;
    return in_turn(sp_evaluator_patches(((const sp_design *)of)->evaluator)->normal[patch], component);
}

static double part_of(const void *of, int which, size_t patch, int component)
{
    const sp_evaluator *evaluator = ((const sp_design *)of)->evaluator;
    (void)which;
    (void)component;
    return sp_evaluator_setup(evaluator)->mesh->part[sp_evaluator_patches(evaluator)->triangle[patch]];
}

static double side_of(const void *of, int which, size_t patch, int component)
{
    (void)which;
    (void)component;
    return sp_evaluator_patches(((const sp_design *)of)->evaluator)->side[patch];
}

static double channel_of(const void *of, int which, size_t patch, int component)
{
    (void)component;
    return sp_channel_of(of, (uint32_t)patch, which);
}

bool sp_report_texels_vtp(const sp_design *design, const char *path, sp_error *error)
{
    if (!sp_design_is_evaluated(design) || !path)
        return false;
    enum { OWN = 3 };
    sp_vtp_array arrays[OWN + SP_CHANNELS] = {{"normal", SP_VTP_FLOAT32, 3, normal_of, 0},
                                              {"part", SP_VTP_INT32, 1, part_of, 0},
                                              {"side", SP_VTP_UINT8, 1, side_of, 0}};
    for (int k = 0; k < SP_CHANNELS; ++k)
        arrays[OWN + k] = (sp_vtp_array){sp_channel_names[k], k == SP_CHANNEL_CHART ? SP_VTP_INT32 : SP_VTP_FLOAT32, 1,
                                         channel_of, k};
    sp_vtp vtp = {.point_count = sp_evaluator_patches(design->evaluator)->count,
                  .point = place_of,
                  .array_count = OWN + SP_CHANNELS,
                  .arrays = arrays,
                  .mesh = sp_evaluator_setup(design->evaluator)->mesh,
                  .of = design};
    return sp_vtp_write(&vtp, path, error);
}
