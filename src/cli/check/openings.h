/* The openings that the flood left by, and the caps that would shut them. */
#ifndef CLI_OPENINGS_H
#define CLI_OPENINGS_H

#include <sprayplan/evaluator.h>

#include <jansson.h>
#include <stdbool.h>

/* False where there is none. */
bool cli_openings_print(const sp_evaluator *evaluator);
/* A new reference; NULL when memory runs out. */
json_t *cli_openings_json(const sp_evaluator *evaluator);

#endif
