#include "search/lineup_memo.h"

#include "mesh/grow.h"

#include <assert.h>

struct sp_lineup_memory {
    sp_lineup_question question;
    sp_lineup_answer answer;
};

sp_lineup_question sp_lineup_ask(const uint32_t *rows, size_t count, double power, float credit, double budget)
{
    sp_lineup_question question = {.count = count, .power = power, .budget = budget, .credit = credit};
    assert(count <= SP_LINEUP_MOST);
    for (size_t i = 0; i < count; i++) {
        size_t at = i;
        for (; at > 0 && question.row[at - 1] > rows[i]; at--)
            question.row[at] = question.row[at - 1];
        question.row[at] = rows[i];
    }
    return question;
}

static bool is_same(const sp_lineup_question *a, const sp_lineup_question *b)
{
    bool same = a->count == b->count && a->power == b->power && a->budget == b->budget && a->credit == b->credit;
    for (size_t i = 0; same && i < a->count; i++)
        same = a->row[i] == b->row[i];
    return same;
}

const sp_lineup_answer *sp_lineup_memo_find(const sp_lineup_memo *memo, const sp_lineup_question *question)
{
    for (size_t i = 0; i < memo->count; i++)
        if (is_same(&memo->items[i].question, question))
            return &memo->items[i].answer;
    return NULL;
}

void sp_lineup_memo_note(sp_lineup_memo *memo, const sp_lineup_question *question, sp_lineup_answer answer)
{
    if (sp_grow(&memo->items, &memo->capacity, memo->count + 1, sizeof *memo->items))
        memo->items[memo->count++] = (struct sp_lineup_memory){*question, answer};
}

void sp_lineup_memo_free(sp_lineup_memo *memo)
{
    free(memo->items);
    *memo = (sp_lineup_memo){0};
}
