#include "search/selection_memo.h"

#include "mesh/grow.h"

#include <assert.h>

struct sp_selection_memory {
    sp_selection_question question;
    sp_selection_answer answer;
};

sp_selection_question sp_selection_ask(const uint32_t *rows, size_t count, double power, float credit, double budget)
{
    sp_selection_question question = {.count = count, .power = power, .budget = budget, .credit = credit};
    assert(count <= SP_SELECTION_MOST);
    for (size_t i = 0; i < count; i++) {
        size_t at = i;
        for (; at > 0 && question.row[at - 1] > rows[i]; at--)
            question.row[at] = question.row[at - 1];
        question.row[at] = rows[i];
    }
    return question;
}

static bool is_same(const sp_selection_question *a, const sp_selection_question *b)
{
    bool same = a->count == b->count && a->power == b->power && a->budget == b->budget && a->credit == b->credit;
    for (size_t i = 0; same && i < a->count; i++)
        same = a->row[i] == b->row[i];
    return same;
}

const sp_selection_answer *sp_selection_memo_find(const sp_selection_memo *memo, const sp_selection_question *question)
{
    for (size_t i = 0; i < memo->count; i++)
        if (is_same(&memo->items[i].question, question))
            return &memo->items[i].answer;
    return NULL;
}

void sp_selection_memo_note(sp_selection_memo *memo, const sp_selection_question *question, sp_selection_answer answer)
{
    if (sp_grow(&memo->items, &memo->capacity, memo->count + 1, sizeof *memo->items))
        memo->items[memo->count++] = (struct sp_selection_memory){*question, answer};
}

void sp_selection_memo_free(sp_selection_memo *memo)
{
    free(memo->items);
    *memo = (sp_selection_memo){0};
}
