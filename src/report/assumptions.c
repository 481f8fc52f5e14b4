/* What the figures rest on. */
#include "page.h"

static const char *const explanations[SP_REASONS] = {
    [SP_REASON_NO_LINE] = "nothing that leaves an allowed place in an allowed direction arrives there",
    [SP_REASON_REFLECTION] = "only liquid that a wall throws back arrives",
    [SP_REASON_SLOW] = "what arrives is slower than the criterion asks",
    [SP_REASON_SLANTED] = "what arrives fast enough is more slanted than the criterion allows",
    [SP_REASON_FLUX] = "what arrives so is too little, within the limits of number and water",
};

/* Why area is not attainable, largest first. */
static void add_reasons(const sp_figures *figures, sp_text *text)
{
    bool listed[SP_REASONS] = {false}, any = false;
    for (;;) {
        sp_reason largest = SP_REASON_ATTAINABLE;
        for (sp_reason reason = 0; reason < SP_REASONS; reason++)
            if (explanations[reason] && !listed[reason] && figures->missing_area[reason] > 0 &&
                (largest == SP_REASON_ATTAINABLE || figures->missing_area[reason] > figures->missing_area[largest]))
                largest = reason;
        if (largest == SP_REASON_ATTAINABLE)
            break;
        sp_text_add(text, any ? "" : "<ul id=\"reasons\">\n");
        any = listed[largest] = true;
        sp_text_add(text, "<li>");
        sp_markup_significant(text, 1e4 * figures->missing_area[largest], 3);
        sp_text_add(text, "&nbsp;cm\xc2\xb2 %s: %s.</li>\n", sp_reason_text(largest), explanations[largest]);
    }
    sp_text_add(text, any ? "</ul>\n" : "");
}

void sp_page_attainable(const sp_page *page, sp_text *text)
{
    if (page->main == SP_UNKNOWN || !isfinite(page->figures[page->main].attainable_area))
        return;
    const sp_figures *figures = &page->figures[page->main];
    double missing = fmax(figures->clean_area - figures->attainable_area, 0);
    sp_text_add(text, "<section id=\"attainable\"><h2>What can be reached at all</h2>\n<p>Of ");
    sp_markup_significant(text, figures->clean_area, 4);
    sp_text_add(text, "&nbsp;m\xc2\xb2 to be cleaned, ");
    sp_markup_significant(text, figures->attainable_area, 4);
    sp_text_add(text, "&nbsp;m\xc2\xb2 (");
    sp_markup_decimals(text, 100 * figures->attainable_area / figures->clean_area, 1);
    sp_text_add(
        text, "&nbsp;%%) are attainable: some allowed nozzle, at some allowed place and direction, reaches them as the "
              "criterion asks, or a layout of this report covers them.");
    if (missing > 1e-6 * figures->clean_area) {
        sp_text_add(text, " The other ");
        sp_markup_significant(text, missing, 3);
        sp_text_add(
            text, "&nbsp;m\xc2\xb2 are out of reach of every allowed nozzle. That is a fault of the vessel or of the "
                  "mounts allowed, which no choice among them mends: another port, another type of nozzle or a change "
                  "of the part would.");
    }
    sp_text_add(text, "</p>\n");
    add_reasons(figures, text);
    sp_text_add(text, "</section>\n");
}

static void add_item(sp_text *text, const char *term)
{
    sp_text_add(text, "<dt>%s</dt><dd>", term);
}

static void add_flight(sp_text *text, const sp_evaluator *evaluator)
{
    const sp_setup *setup = sp_evaluator_setup(evaluator);
    const sp_fidelity *fidelity = sp_evaluator_fidelity(evaluator);
    add_item(text, "Flight");
    if (fidelity->trajectory == SP_TRAJECTORY_LINE)
        sp_text_add(text, "straight lines: gravity and air are neglected");
    else
        sp_text_add(text, "parabolas under gravity of %.4g&nbsp;m/s\xc2\xb2; the drag of air is neglected",
                    setup->gravity);
    sp_text_add(text, "</dd>\n");
    add_item(text, "Evaluator");
    if (fidelity->method == SP_METHOD_INVERSE)
        sp_text_add(
            text, "inverse: for every patch of surface the flights that reach it in closed form; first impact only, no "
                  "liquid flies on from a wall");
    else
        sp_text_add(text, "forward: %llu jets a nozzle, up to %d reflection%s", (unsigned long long)fidelity->jets,
                    fidelity->reflections, fidelity->reflections == 1 ? "" : "s");
    sp_text_add(text, "; run-off along walls is not counted</dd>\n");
    add_item(text, "Resolution");
    sp_text_add(text, "texels of %.3g&nbsp;mm, %zu patches; each is judged as a whole</dd>\n", 1e3 * fidelity->texel,
                sp_evaluator_patches(evaluator)->count);
}

static void add_criterion(sp_text *text, const sp_criterion *criterion)
{
    const char *separator = "";
    add_item(text, "Covered means");
    if (criterion->flux > 0) {
        sp_text_add(text, "liquid flux of at least %.4g&nbsp;L/min per m\xc2\xb2", 6e4 * criterion->flux);
        separator = ", ";
    }
    if (criterion->impact_speed > 0) {
        sp_text_add(text, "%simpact speed of at least %.4g&nbsp;m/s", separator, criterion->impact_speed);
        separator = ", ";
    }
    if (criterion->incidence < M_PI / 2) {
        sp_text_add(text, "%sincidence of at most %.4g&deg; from the normal", separator,
                    criterion->incidence * 180 / M_PI);
        separator = ", ";
    }
    if (!separator[0])
        sp_text_add(text, "any liquid arrives");
    else
        sp_text_add(text, criterion->combine == SP_COMBINE_SINGLE ? "; one nozzle alone must do it"
                                                                  : "; the flux of all nozzles adds up");
    sp_text_add(text, "</dd>\n");
}

static void add_scene(sp_text *text, const sp_setup *setup)
{
    static const char *const cavities[] = {
        "not named: every surface counts once and takes liquid from either side",
        "the space seen from a point inside: only sides that face it are cleaned and counted",
        "the outside: only sides that face it are cleaned and counted"};
    add_item(text, "Liquid");
    sp_text_add(text, "%.4g&nbsp;kg/m\xc2\xb3, %.4g&nbsp;mPa&thinsp;s</dd>\n", setup->liquid.density,
                1e3 * setup->liquid.viscosity);
    add_item(text, "Nozzles");
    sp_text_add(text,
                "flow by the catalogue&#39;s point and exponent, exit speed from the pressure drop (Bernoulli), liquid "
                "spread evenly over the spray angle</dd>\n");
    add_item(text, "Cavity");
    sp_text_add(text, "%s</dd>\n", cavities[setup->cavity]);
}

static void add_search(sp_text *text, const sp_proposal *proposal)
{
    add_item(text, "Search");
    sp_text_add(
        text,
        "%zu poses at %zu mounting points; greedy choice by gain per water, then refinement, accepted only where "
        "the re-traced result improved</dd>\n",
        proposal->candidates, proposal->positions);
    add_item(text, "Not proved");
    sp_text_add(text, proposal->certificate.computed
                          ? "what poses between the candidates could do</dd>\n"
                          : "this report holds no bound on what the best possible layout could do</dd>\n");
}

void sp_page_assumptions(const sp_page *page, sp_text *text)
{
    const sp_evaluator *before = NULL;
    sp_text_add(text, "<section id=\"assumptions\"><h2>Assumptions</h2>\n");
    for (size_t i = 0; i < page->result->design_count; ++i) {
        const sp_evaluator *evaluator = page->result->designs[i].evaluator;
        if (!evaluator || evaluator == before)
            continue;
        if (page->main == SP_UNKNOWN) {
            sp_text_add(text, "<h3>");
            sp_page_name(page, text, i);
            sp_text_add(text, "</h3>\n");
        }
        before = evaluator;
        sp_text_add(text, "<dl>\n");
        add_criterion(text, &sp_evaluator_setup(evaluator)->criterion);
        add_flight(text, evaluator);
        add_scene(text, sp_evaluator_setup(evaluator));
        if (page->result->proposal)
            add_search(text, page->result->proposal);
        sp_text_add(text, "</dl>\n");
    }
    sp_text_add(
        text,
        "<p class=\"note\">All figures are from simulation. They compare layouts; whether a surface comes out clean "
        "also depends on soil, chemistry, temperature and time, and is for a test on the vessel to show.</p>"
        "</section>\n");
}
