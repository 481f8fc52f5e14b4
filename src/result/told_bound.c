/* What is told that no layout covers more than. */
#include <sprayplan/result.h>

#include <math.h>

double sp_told_bound(const sp_proposal *proposal, double area, double found, bool *attainable)
{
    double bound = fmin(1, area / proposal->certificate.whole),
           reach = fmax(found, proposal->attainable_area / proposal->coverage->area);
    *attainable = !proposal->attainable_hurried && reach < bound;
    return *attainable ? reach : bound;
}
