#include <sprayplan/setup.h>

sp_setup sp_setup_default(void)
{
    return (sp_setup){
        .file = {.scale = 1, .rotate = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
        .cavity = SP_CAVITY_NONE,
        .datum = {.axis = {0, 0, 1}, .zero = {1, 0, 0}},
        .liquid = {.density = 1000, .viscosity = 1e-3, .surface_tension = 72e-3},
        .air = {.density = 1.2, .viscosity = 18e-6},
        .up = {0, 0, 1},
        .gravity = 9.81,
        .criterion = {.flux = 0, .impact_speed = 0, .incidence = M_PI / 2, .combine = SP_COMBINE_SUM},
        .fidelity = {.trajectory = SP_TRAJECTORY_AUTO,
                     .method = SP_METHOD_AUTO,
                     .reflections = -1,
                     .jets = 0,
                     .texel = 0,
                     .splat = SP_SPLAT_NEAREST,
                     .accuracy = 0.01,
                     .seed = 1},
    };
}

double sp_sweep_duration(const sp_sweep *sweep)
{
    return sweep->speed > 0 ? sp_distance(sweep->from, sweep->to) / sweep->speed : 0;
}

double sp_sweep_reach(const sp_sweep *sweep)
{
    return fmax(sp_length(sweep->from), sp_length(sweep->to));
}

bool sp_setup_throws_back(const sp_setup *setup)
{
    for (size_t i = 0; i < setup->mesh->part_count; i++)
        if (setup->surfaces[i].restitution > 0 && setup->surfaces[i].rebound > 0)
            return true;
    return false;
}

sp_vec3 sp_setup_outside(const sp_setup *setup, sp_vec3 point)
{
    return sp_add(point, setup->origin);
}

sp_vec3 sp_setup_told(const sp_setup *setup, sp_vec3 point)
{
    return sp_sub(sp_setup_outside(setup, point), setup->origin);
}
