/* Layouts of few nozzles, looked at one by one: where water allows no more, fractions of many candidates cover far more
 * than any few whole ones, and no prices of texels say so.
 *
 * Within a budget W shares of a layout come to 1 only where one of them is weight / W at least. So no layout covers
 * more than the union of the texels to which its nozzles bring that much, and what their edges cover besides; what a
 * nozzle adds to a union only falls as that grows. Candidates are chosen one after the other, in every way that could
 * still come above a target, by what is left to gain and by what texels' prices say; what does is covered exactly. */
#ifndef OPTIMIZER_TUPLES_H
#define OPTIMIZER_TUPLES_H

#include "bound/line.h"

/* What is asked. */
typedef struct {
    size_t water;         /* units */
    double target;        /* m² */
    const uint8_t *alive; /* [line->count], no other candidate is part of a layout above the target */
    const float *price;   /* [line->count], what the candidates are worth at some prices, rounded upwards */
    double rest;          /* m² that these prices leave, base included */
    size_t rows_most;     /* of candidates, that memory is taken for */
    double work_most;     /* in words of 64 texels */
} sp_tuple_task;

typedef struct {
    bool complete; /* else nothing is proved */
    double bound;  /* m² that no layout of so much water covers more than: the target, or what the best one covers */
    double work;
    size_t candidates, checked;
} sp_tuple_answer;

bool sp_tuples_bound(const sp_cover *cover, const sp_line *line, const sp_tuple_task *task, sp_tuple_answer *answer,
                     sp_error *error);

#endif
