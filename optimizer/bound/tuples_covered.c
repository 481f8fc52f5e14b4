#include "bound/tuples_work.h"
#include "bound/rounding.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define CHECKED_AT_A_TIME 64 /* layouts, before the clock is asked again */

/* What a layout brings to every texel: shares in all, and the part that edges leave dry. */
typedef struct {
    double *sum, *dry; /* [texels] */
    double area;       /* m² that it covers, base included */
} brought;

static double covered_of(double sum, double dry)
{
    return sum >= 1 ? 1 : 1 - dry;
}

/* Adds a nozzle to what a layout brings; to->sum NULL: only the area. */
static bool bring(const sp_tuples *o, uint32_t one, const brought *from, brought *to, sp_error *error)
{
    sp_rows row = {0};
    size_t texels = o->cover->texel_count;
    if (!o->list->row(o->list->user, o->items[one].position, &row, error)) {
        sp_rows_free(&row);
        return false;
    }
    if (to->sum) {
        memcpy(to->sum, from->sum, texels * sizeof *to->sum);
        memcpy(to->dry, from->dry, texels * sizeof *to->dry);
    }
    to->area = from->area;
    for (size_t k = 0, end; k < row.used; k = end) {
        uint32_t t = row.texel[k];
        double sum = from->sum[t], dry = from->dry[t], before = covered_of(sum, dry);
        /* where a spray ends within a texel it has two entries */
        for (end = k; end < row.used && row.texel[end] == t; end++)
            if (row.share[end] > 0)
                sum += (double)row.share[end] * SP_UPWARDS_SINGLE;
            else
                dry *= 1 + (double)row.share[end];
        assert(dry >= 0 && dry <= 1);
        to->area += (covered_of(sum, dry) - before) * (double)o->cover->area[t];
        if (to->sum) {
            to->sum[t] = sum;
            to->dry[t] = dry;
        }
    }
    sp_rows_free(&row);
    return true;
}

static int by_items(const void *a, const void *b)
{
    const sp_tuple *p = a, *q = b;
    for (size_t i = 0; i < p->count && i < q->count; i++)
        if (p->item[i] != q->item[i])
            return p->item[i] < q->item[i] ? -1 : 1;
    return (p->count > q->count) - (p->count < q->count);
}

/* What the layouts found cover, exactly, but where a texel may be covered in several ways: then no less. Those that
 * begin with the same nozzles stand together. */
static bool check(sp_tuples *o, brought *kept, double *most, sp_error *error)
{
    const sp_tuple *last = NULL;
    if (o->found_count)
        qsort(o->found, o->found_count, sizeof *o->found, by_items);
    for (size_t i = 0; i < o->found_count && (i % CHECKED_AT_A_TIME || sp_cover_goes_on(o->cover)); i++) {
        const sp_tuple *now = &o->found[i];
        size_t same = 0;
        brought whole = {NULL, NULL, 0};
        while (last && same + 1 < last->count && same + 1 < now->count && last->item[same] == now->item[same])
            same++;
        for (size_t d = same; d + 1 < now->count; d++)
            if (!bring(o, now->item[d], &kept[d], &kept[d + 1], error))
                return false;
        if (!bring(o, now->item[now->count - 1], &kept[now->count - 1], &whole, error))
            return false;
        *most = fmax(*most, whole.area * SP_UPWARDS_SINGLE);
        last = now;
    }
    return true;
}

bool sp_tuples_check_found(sp_tuples *o, double *most, sp_error *error)
{
    size_t texels = o->cover->texel_count;
    brought kept[DEEP_MOST] = {{NULL, NULL, 0}};
    bool done = true;
    for (size_t d = 0; d < DEEP_MOST; d++) {
        kept[d] = (brought){calloc(texels + 1, sizeof(double)), malloc((texels + 1) * sizeof(double)), o->cover->base};
        done &= kept[d].sum && kept[d].dry;
    }
    for (size_t t = 0; done && t < texels; t++)
        kept[0].dry[t] = 1;
    done = (done || sp_fail_memory(error)) && check(o, kept, most, error);
    for (size_t d = 0; d < DEEP_MOST; d++) {
        free(kept[d].sum);
        free(kept[d].dry);
    }
    return done;
}
