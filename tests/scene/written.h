/* Scenes written as text, as layout.yaml is. */
#ifndef TESTS_SCENE_WRITTEN_H
#define TESTS_SCENE_WRITTEN_H

#include <sprayplan/scene.h>

/* The scene with its own layout and what `auto` might have decided; malloc'd, NULL on error. */
static inline char *written_text(const sp_scene *scene, const char *directory, sp_error *error)
{
    sp_fidelity fidelity = sp_scene_setup(scene)->fidelity;
    fidelity.trajectory = SP_TRAJECTORY_LINE;
    fidelity.method = SP_METHOD_INVERSE;
    fidelity.reflections = 0;
    fidelity.texel = 0.1;
    return sp_scene_text(scene, sp_scene_layout(scene), &fidelity, directory, error);
}

#endif
