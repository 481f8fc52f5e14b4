#include "attainable/offers.h"

#include <assert.h>
#include <math.h>
#include <stdint.h>

bool sp_place_offers_take(const sp_place_offers *offers, size_t place, sp_offer offer)
{
    assert(place < offers->count && offer.ratio >= 0 && offer.low >= 0);
    sp_offer *strongest = &offers->strongest[place], *thriftiest = &offers->thriftiest[place];
    double most = offer.ratio * offer.high, had = strongest->ratio * strongest->high;
    /* of equals the one that can take least water, whichever came first */
    bool stronger = most > had || (most == had && offer.low < strongest->low),
         thriftier =
             offer.ratio > thriftiest->ratio || (offer.ratio == thriftiest->ratio && offer.low < thriftiest->low);
    if (stronger)
        *strongest = offer;
    if (thriftier)
        *thriftiest = offer;
    return stronger || thriftier;
}

/* Whether the offers, best first by flux or by flux per flow, bring `need` within number and water. */
static bool suffices(const sp_offer *offers, size_t count, bool by_flux, size_t nozzles, double water, double need)
{
    double flux = 0;
    double before = INFINITY; /* key of the offer taken last */
    size_t before_at = SIZE_MAX;
    while (nozzles > 0) {
        size_t best = SIZE_MAX;
        double best_key = 0;
        for (size_t i = 0; i < count; i++) {
            double key = by_flux ? offers[i].ratio * offers[i].high : offers[i].ratio;
            bool later = key < before || (key == before && (before_at == SIZE_MAX || i > before_at));
            if (key > best_key && later) {
                best = i;
                best_key = key;
            }
        }
        if (best == SIZE_MAX)
            return false;
        before = best_key;
        before_at = best;
        /* a port holds one nozzle, the other mounting points together as many as are left */
        size_t times = best == count - 1 ? nozzles : 1;
        if (isinf(water)) {
            flux += times == SIZE_MAX ? INFINITY : (double)times * offers[best].ratio * offers[best].high;
            nozzles -= times;
        }
        for (; !isinf(water) && times > 0 && nozzles > 0 && water >= offers[best].low; times--, nozzles--) {
            double flow = fmin(offers[best].high, water);
            flux += offers[best].ratio * flow;
            water -= flow;
            if (flux >= need)
                return true;
        }
        if (flux >= need)
            return true;
    }
    return false;
}

bool sp_place_offers_suffice(const sp_place_offers *offers, size_t nozzles, double water, double need)
{
    return suffices(offers->strongest, offers->count, true, nozzles, water, need) ||
           suffices(offers->thriftiest, offers->count, false, nozzles, water, need);
}
