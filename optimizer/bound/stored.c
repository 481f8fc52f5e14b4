/* Candidates that lie in memory, priced one after the other. */

#include "ranking.h"
#include "bound/bound.h"

#include <stdlib.h>

/* Appends the best of the entries. */
static bool hand_out(const sp_stored *stored, sp_ranked *entries, size_t count, sp_rows *rows, sp_error *error)
{
    const sp_rows *all = stored->rows;
    bool done = true;
    sp_rank_falling(entries, count);
    for (size_t i = 0; done && i < count && i < stored->most; i++) {
        size_t row = entries[i].at, first = all->start[row], size = all->start[row + 1] - first;
        done = sp_rows_add(rows, all->key[row], all->port[row], all->tier[row], all->texel + first, all->share + first,
                           size, error);
    }
    return done;
}

static bool price_stored(void *user, const sp_prices *u, const double *needed, bool all_wanted, sp_offers *offers,
                         sp_rows *rows, sp_error *error)
{
    (void)all_wanted; /* to price them all takes no time worth saving */
    const sp_stored *stored = user;
    const sp_rows *all = stored->rows;
    double *price = malloc((all->count + 1) * sizeof *price);
    sp_ranked *entries = malloc((all->count + 1) * sizeof *entries);
    uint64_t *keys = sp_rows_keys(rows);
    bool done = price && entries && keys;
    if (!done)
        sp_fail_memory(error);
    size_t count = 0, had = rows->count;
#pragma omp parallel for num_threads(stored->cover->threads) schedule(dynamic, 16)
    for (size_t c = 0; c < (done ? all->count : 0); c++)
        price[c] = sp_rows_price(all, c, u);
    for (size_t c = 0; done && c < all->count; c++) {
        double need = needed[all->tier[c]];
        if (sp_keys_hold(keys, had, all->key[c]))
            continue;
        sp_offers_add(offers, all->port[c], all->tier[c], price[c]);
        if (price[c] > need)
            entries[count++] = (sp_ranked){need > 0 ? price[c] / need : price[c] * 1e30, c};
    }
    done = done && hand_out(stored, entries, count, rows, error);
    free(price);
    free(entries);
    free(keys);
    return done;
}

sp_pricer sp_stored_pricer(sp_stored *stored)
{
    return (sp_pricer){stored, price_stored};
}
