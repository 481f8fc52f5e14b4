/* What layouts were asked for, where several stand side by side. */
#include <sprayplan/result.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

#define ROUND_OFF 1e-9 /* relative: a file has other units */

static bool same(double a, double b)
{
    return fabs(a - b) <= ROUND_OFF * fmax(fabs(a), fabs(b));
}

/* Of goods that move the dose, m³/m²; else the flux. */
static double amount(const sp_figures *figures)
{
    return figures->criterion.flux * (isfinite(figures->pass) ? figures->pass : 1);
}

bool sp_same_criterion(const sp_figures *a, const sp_figures *b)
{
    const sp_criterion *x = &a->criterion, *y = &b->criterion;
    if (!a->criterion_known || !b->criterion_known)
        return a->criterion_known == b->criterion_known;
    return isfinite(a->pass) == isfinite(b->pass) && same(amount(a), amount(b)) &&
           same(x->impact_speed, y->impact_speed) && same(x->incidence, y->incidence) && x->combine == y->combine &&
           same(x->film, y->film);
}

bool sp_figures_ask_no_amount(const sp_figures *figures)
{
    return figures->criterion_known && !(figures->criterion.flux > 0);
}

bool sp_figures_share_criterion(const sp_figures *figures, size_t count)
{
    bool share = true;
    for (size_t i = 1; share && i < count; ++i)
        share = sp_same_criterion(&figures[0], &figures[i]);
    return share;
}

static void add(char text[SP_CRITERION_TEXT], const char *before, double value, const char *unit)
{
    size_t used = strlen(text);
    snprintf(text + used, SP_CRITERION_TEXT - used, "%s%s %.4g %s", used ? ", " : "", before, value, unit);
}

void sp_criterion_clause(const sp_figures *figures, char text[SP_CRITERION_TEXT])
{
    const sp_criterion *criterion = &figures->criterion;
    text[0] = '\0';
    if (!figures->criterion_known) {
        strcpy(text, "not told");
        return;
    }
    if (criterion->flux > 0 && isfinite(figures->pass))
        add(text, "at least", 1e3 * amount(figures), "L/m2");
    else if (criterion->flux > 0)
        add(text, "at least", 6e4 * criterion->flux, "L/min/m2");
    if (criterion->impact_speed > 0)
        add(text, "at least", criterion->impact_speed, "m/s");
    if (criterion->incidence < M_PI / 2 * (1 - ROUND_OFF))
        add(text, "at most", criterion->incidence * 180 / M_PI, "deg from the normal");
    if (!text[0])
        strcpy(text, "any liquid");
    else if (criterion->combine == SP_COMBINE_SINGLE)
        strcat(text, " by one nozzle alone");
    if (criterion->film > 0)
        add(text, "or film of at least", 6e4 * criterion->film, "L/min/m");
}
