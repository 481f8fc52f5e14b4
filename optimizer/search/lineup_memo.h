/* The best rows to add to line-ups, remembered: one that is improved from several sides comes to the same few again and
 * again, and to find a best row takes far longer than anything else about it. */
#ifndef OPTIMIZER_LINEUP_MEMO_H
#define OPTIMIZER_LINEUP_MEMO_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define SP_LINEUP_MOST 64 /* nozzles besides the kept ones; larger layouts are not looked for so */

/* What sp_lineup_best is asked. */
typedef struct {
    size_t count;
    uint32_t row[SP_LINEUP_MOST]; /* rising: the order in which they came in makes no difference */
    double power, budget;
    float credit;
} sp_lineup_question;

typedef struct {
    uint32_t row;
    double gain; /* m²; 0: none */
} sp_lineup_answer;

/* Of one coverage matrix. Zeroed: nothing is remembered yet. */
typedef struct {
    size_t count, capacity;
    struct sp_lineup_memory *items;
} sp_lineup_memo;

sp_lineup_question sp_lineup_ask(const uint32_t *rows, size_t count, double power, float credit, double budget);
/* NULL where it was not asked yet. Until the next call of sp_lineup_memo_note. */
const sp_lineup_answer *sp_lineup_memo_find(const sp_lineup_memo *memo, const sp_lineup_question *question);
/* Remembers, unless memory runs out. */
void sp_lineup_memo_note(sp_lineup_memo *memo, const sp_lineup_question *question, sp_lineup_answer answer);
void sp_lineup_memo_free(sp_lineup_memo *memo);

#endif
