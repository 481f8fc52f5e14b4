/* Seconds that the 2008 study measured, from its tables 4.2 to 4.5: building the tree, 1000 straight and 1000 parabolic
 * jets of a full cone with their deposits written (Pentium 4, 2.6 GHz), the texture atlas (Core 2 Duo, 2.6 GHz). */
#ifndef CLI_BENCH_STUDY_2008_H
#define CLI_BENCH_STUDY_2008_H

enum { STUDY_CUBE, STUDY_HORSE, STUDY_ELEPHANT, STUDY_MESHES };
static const char *const study_meshes[STUDY_MESHES] = {"cube", "horse", "elephant"};
static const int study_triangles[STUDY_MESHES] = {1200, 39698, 22840};

/* 0: the study has no such figure. */
static const double study_build[OWN][STUDY_MESHES] = {
    [OWN_NAIVE] = {0.199197, 2.03404, 1.38167},
    [OWN_SAH] = {0.13255, 4.69655, 2.759976},
};
static const double study_jets[TRAJECTORIES][OWN][STUDY_MESHES] = {
    [TRAJECTORY_LINE] = {[OWN_NAIVE] = {0.324751, 1.06822, 0.851044},
                         [OWN_SAH] = {0.025707, 0.11669, 0.079865},
                         [OWN_NONE] = {0.031059, 0.157991, 0.095248}},
    [TRAJECTORY_PARABOLA] = {[OWN_NAIVE] = {0.251586, 1.54844, 0.952578},
                             [OWN_SAH] = {0.088699, 0.276249, 0.194478},
                             [OWN_NONE] = {1.423, 26.5943, 22.5271}},
};
static const double study_atlas[STUDY_MESHES] = {1.46, 193, 13.97};

#endif
