/* The proposal, counted by jets. */
#ifndef FORWARD_CHECK_H
#define FORWARD_CHECK_H

#include "deadline/deadline.h"

#include <sprayplan/place.h>

/* Not computed where there is no nozzle, it is cancelled or too little time is left. */
bool sp_check_forward(const sp_evaluator *evaluator, const sp_layout *layout, sp_deadline *deadline,
                      sp_forward_check *check, sp_error *error);

#endif
