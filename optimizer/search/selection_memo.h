/* The best rows to add to selections, remembered: one that is improved from several sides comes to the same few again
 * and again, and to find a best row takes far longer than anything else about it. */
#ifndef OPTIMIZER_SELECTION_MEMO_H
#define OPTIMIZER_SELECTION_MEMO_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define SP_SELECTION_MOST 64 /* nozzles besides the kept ones; larger layouts are not looked for so */

/* What sp_selection_best is asked. */
typedef struct {
    size_t count;
    uint32_t row[SP_SELECTION_MOST]; /* rising: the order in which they came in makes no difference */
    double power, budget;
    float credit;
} sp_selection_question;

typedef struct {
    uint32_t row;
    double gain; /* m²; 0: none */
} sp_selection_answer;

/* Of one coverage matrix. Zeroed: nothing is remembered yet. */
typedef struct {
    size_t count, capacity;
    struct sp_selection_memory *items;
} sp_selection_memo;

sp_selection_question sp_selection_ask(const uint32_t *rows, size_t count, double power, float credit, double budget);
/* NULL where it was not asked yet. Until the next call of sp_selection_memo_note. */
const sp_selection_answer *sp_selection_memo_find(const sp_selection_memo *memo, const sp_selection_question *question);
/* Remembers, unless memory runs out. */
void sp_selection_memo_note(sp_selection_memo *memo, const sp_selection_question *question, sp_selection_answer answer);
void sp_selection_memo_free(sp_selection_memo *memo);

#endif
