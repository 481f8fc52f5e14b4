/* What is left to auto, chosen for a layout by measuring. */
#ifndef SPRAY_AUTO_SETTINGS_H
#define SPRAY_AUTO_SETTINGS_H

#include "spray/state/state.h"

/* The coarsest and the finest texels that are tried, as how many there are of what is cleaned and counted. Longer ones
 * save little of a run and cost the search of a layout and the pictures their detail; shorter ones take gigabytes. */
#define SP_FEWEST_TEXELS 30000
#define SP_MOST_TEXELS 1600000

/* auto_method.c: the setup's fidelity with the plain safe choice for what it leaves to auto, but for sizes, which wait
 * for the wet sides. Fails with SP_ERROR_INPUT for what does not go together. */
bool sp_auto_method(const sp_setup *setup, sp_fidelity *fidelity, sp_error *error);

/* Sets the evaluator's fidelity and choice and makes its texels: sp_evaluator_create_for says how. Its tracer and wet
 * sides are there, and its texel is the setup's or the plain one. */
bool sp_auto_settings(sp_evaluator *evaluator, const sp_layout *layout, sp_error *error);

/* The shortest texel (m) that is tried: of goods that move the plain one, since they are looked at in positions a texel
 * apart, and half the texel is eight times the work. */
double sp_shortest_auto_texel(const sp_evaluator *evaluator);

/* What a choice is made by: the layout, what it does by the settings in hand, and how far that is off. */
typedef struct {
    sp_evaluator *evaluator;
    const sp_layout *layout;
    sp_coverage *coverage;
    sp_measured_error measured;
} sp_setting_trial;
/* Evaluates and measures by the evaluator's settings, on the texels that it has. */
bool sp_setting_trial_run(sp_setting_trial *trial, sp_error *error);
/* The same on texels of this length (m). */
bool sp_setting_trial_at(sp_setting_trial *trial, double texel, sp_error *error);
/* Whether so much of the time limit is over that nothing further is to be tried. */
bool sp_setting_trial_late(const sp_setting_trial *trial);
/* Half the accuracy is for what the settings do, the other half for other layouts like this one. */
bool sp_setting_trial_keeps(const sp_setting_trial *trial);

/* Lines in place of parabolas, where that is worth it. auto_trajectory.c. */
bool sp_auto_trajectory(sp_setting_trial *trial, sp_error *error);
/* auto_forward.c: jets, texels and reflections of the forward evaluator. */
bool sp_auto_forward(sp_setting_trial *trial, sp_error *error);

#endif
