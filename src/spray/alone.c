#include "spray/alone.h"

#include "spray/criterion.h"
#include "spray/state/state.h"

#include <stdlib.h>
#include <string.h>

static bool asks_for_film(const sp_evaluator *evaluator)
{
    return evaluator->setup.criterion.film > 0;
}

size_t sp_alone_size(const sp_evaluator *evaluator)
{
    return (asks_for_film(evaluator) ? 3 : 2) * evaluator->patches.count * sizeof(double);
}

static bool allocate(const sp_evaluator *evaluator, sp_alone *alone, sp_error *error)
{
    size_t room = evaluator->patches.count + 1;
    bool film = asks_for_film(evaluator);
    *alone = (sp_alone){.even = calloc(room, sizeof *alone->even),
                        .dry = malloc(room * sizeof *alone->dry),
                        .film = film ? calloc(room, sizeof *alone->film) : NULL};
    if (alone->even && alone->dry && (alone->film || !film))
        return true;
    sp_alone_free(alone);
    return sp_fail_memory(error);
}

bool sp_alone_create(const sp_evaluator *evaluator, const sp_coverage *coverage, sp_alone *alone, sp_error *error)
{
    size_t patches = evaluator->patches.count;
    if (!allocate(evaluator, alone, error))
        return false;
    for (size_t p = 0; !coverage && p < patches; p++)
        alone->dry[p] = 1;
    if (!coverage)
        return true;
    const sp_deposits *deposits = &coverage->deposits;
    memcpy(alone->even, deposits->even, patches * sizeof *alone->even);
    memcpy(alone->dry, deposits->dry, patches * sizeof *alone->dry);
    if (alone->film)
        memcpy(alone->film, deposits->film, patches * sizeof *alone->film);
    return true;
}

void sp_alone_free(sp_alone *alone)
{
    free(alone->even);
    free(alone->dry);
    free(alone->film);
    *alone = (sp_alone){0};
}

void sp_alone_join(const sp_evaluator *evaluator, sp_alone *all, const sp_alone *one, bool edges)
{
    const sp_criterion *criterion = &evaluator->setup.criterion;
    for (size_t p = 0; p < evaluator->patches.count; p++) {
        all->even[p] = sp_combined(criterion, all->even[p], one->even[p]);
        all->dry[p] *= edges ? one->dry[p] : 1;
        if (all->film)
            all->film[p] += one->film[p];
    }
}

double sp_alone_covered(const sp_evaluator *evaluator, const sp_alone *alone)
{
    const sp_criterion *criterion = &evaluator->setup.criterion;
    double area = 0;
    for (uint32_t p = 0; p < evaluator->patches.count; p++) {
        double film = alone->film ? alone->film[p] : 0;
        area += sp_share_covered(criterion, alone->even[p], alone->dry[p], film) * sp_evaluator_counted(evaluator, p);
    }
    return area;
}
