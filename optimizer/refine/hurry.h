/* What is refined first where time is short: a proposal, before there is a front. */
#ifndef OPTIMIZER_HURRY_H
#define OPTIMIZER_HURRY_H

#include "refine/trials.h"

/* Other layouts for ever less water, as long as that gains; the closest to the target are refined sharply. */
bool sp_refine_hurried(sp_refining *refining);

#endif
