/* What the figures rest on. */
#include "page.h"

#include "film/laminar.h"

static void add_item(sp_text *text, const char *term)
{
    sp_text_add(text, "<dt>%s</dt><dd>", term);
}

/* What a closed form is not enough for; film and goods that move are not in one scene. */
static const char *judged_besides(const sp_setup *setup)
{
    if (setup->criterion.film > 0)
        return "; of film, which has none, it is what cells half as long change";
    return setup->sweep.speed > 0 ? ", again and again over the whole pass" : "";
}

/* How far the coverage of each layout of an evaluator is off, where that was measured. */
static void add_errors(const sp_page *page, sp_text *text, const sp_evaluator *evaluator)
{
    double accuracy = sp_evaluator_fidelity(evaluator)->accuracy;
    size_t listed = 0;
    for (size_t i = 0; i < page->result->design_count; ++i) {
        const sp_figures *figures = &page->figures[i];
        if (page->result->designs[i].evaluator != evaluator || !isfinite(figures->error_estimate))
            continue;
        if (!listed++)
            add_item(text, "Measured error");
        else
            sp_text_add(text, "; ");
        sp_page_name(page, text, i);
        sp_text_add(text, " \xc2\xb1%.2f&nbsp;points of coverage (%.2f&nbsp;%% of the area misjudged, either way)",
                    sp_percent_at_most(figures->error_estimate, 1), 100 * figures->misjudged);
        if (isfinite(figures->error_bound))
            sp_text_add(text, ", lines in place of parabolas are proved to change it by no more than %.1f&nbsp;points",
                        ceil(1e3 * figures->error_bound) / 10);
        if (figures->error_estimate > accuracy)
            sp_text_add(text, ", which is <strong>more than the accuracy of %.3g&nbsp;%%</strong> that was asked for",
                        100 * accuracy);
    }
    if (listed)
        sp_text_add(text, "; found at random points of the surface, each judged for itself in closed form%s</dd>\n",
                    judged_besides(sp_evaluator_setup(evaluator)));
}

static const char *way_of(sp_trajectory trajectory)
{
    return trajectory == SP_TRAJECTORY_LINE   ? "straight lines"
           : trajectory == SP_TRAJECTORY_DRAG ? "drops"
                                              : "parabolas";
}

/* The scene's way, or a type's own. */
static void add_way(sp_text *text, const sp_setup *setup, sp_trajectory trajectory)
{
    if (trajectory == SP_TRAJECTORY_LINE)
        sp_text_add(text, "straight lines: gravity and air are neglected");
    else if (trajectory == SP_TRAJECTORY_DRAG)
        sp_text_add(
            text,
            "single drops of the catalogue&#39;s diameters under gravity of %.4g&nbsp;m/s\xc2\xb2, held back by "
            "air at rest (%.4g&nbsp;kg/m\xc2\xb3, %.4g&nbsp;&micro;Pa&thinsp;s; drag of spheres by Haider and "
            "Levenspiel); solid streams fly free until they break up, 5&thinsp;We<sup>0.378</sup> diameters "
            "away. This is the <strong>far end of a bracket</strong>: a spray carries air along and its drops "
            "fly farther and faster than single ones, up to what parabolas without drag say",
            setup->gravity, setup->air.density, 1e6 * setup->air.viscosity);
    else
        sp_text_add(text, "parabolas under gravity of %.4g&nbsp;m/s\xc2\xb2; the drag of air is neglected",
                    setup->gravity);
}

/* Of the designs' types, each once, in their order. */
static void add_own_ways(const sp_page *page, sp_text *text, const sp_evaluator *evaluator)
{
    bool any = false;
    for (size_t i = 0; i < page->result->design_count; i++) {
        const sp_layout *layout = page->result->designs[i].layout;
        for (size_t k = 0; layout && page->result->designs[i].evaluator == evaluator && k < layout->count; k++) {
            const sp_nozzle_type *type = layout->nozzles[k].type;
            if (type->trajectory == SP_TRAJECTORY_AUTO || sp_page_type_repeats(page->result, evaluator, i, k))
                continue;
            sp_text_add(text, any ? ", " : ". Types with a way of their own: ");
            sp_markup_escape(text, type->name);
            sp_text_add(text, " (%s)", way_of(type->trajectory));
            any = true;
        }
    }
}

static void add_flight(const sp_page *page, sp_text *text, const sp_evaluator *evaluator)
{
    const sp_setup *setup = sp_evaluator_setup(evaluator);
    const sp_fidelity *fidelity = sp_evaluator_fidelity(evaluator);
    add_item(text, "Flight");
    add_way(text, setup, fidelity->trajectory);
    add_own_ways(page, text, evaluator);
    sp_text_add(text, "</dd>\n");
    add_item(text, "Evaluator");
    if (fidelity->method == SP_METHOD_INVERSE)
        sp_text_add(text,
                    "inverse: for every patch of surface the flights that reach it %s; first impact only, no liquid "
                    "flies on from a wall",
                    fidelity->trajectory == SP_TRAJECTORY_DRAG ? "from a table of all that leave, made exact"
                                                               : "in closed form");
    else
        sp_text_add(text, "forward: %llu jets a nozzle, up to %d reflection%s", (unsigned long long)fidelity->jets,
                    fidelity->reflections, fidelity->reflections == 1 ? "" : "s");
    if (sp_evaluator_jets_wanted(evaluator) > 0)
        sp_text_add(text,
                    "; texels so short want %.3g&nbsp;million: one that is just covered is met by about %.2g, and its "
                    "flux is off by some %.0f&nbsp;%%",
                    1e-6 * sp_evaluator_jets_wanted(evaluator), sp_evaluator_jets_met(evaluator),
                    100 / sqrt(fmax(1, sp_evaluator_jets_met(evaluator))));
    sp_text_add(text, "%s</dd>\n",
                sp_evaluator_setup(evaluator)->criterion.film > 0 ? "" : "; run-off along walls is not counted");
    add_item(text, "Resolution");
    sp_text_add(text,
                "texels of %.3g&nbsp;mm, %zu patches; each is judged at one point, and at a spray's edge "
                "by the share of it that lies inside</dd>\n",
                1e3 * fidelity->texel, sp_evaluator_patches(evaluator)->count);
}

/* Why settings that were left to auto are as they are. */
static void add_choice(sp_text *text, const sp_evaluator *evaluator)
{
    const sp_choice *choice = sp_evaluator_choice(evaluator);
    const char *const names[] = {"texels", "jets", "trajectory", "evaluator", "reflections"};
    const char *const why[] = {choice->texel, choice->jets, choice->trajectory, choice->method, choice->reflections};
    size_t listed = 0;
    for (int k = 0; k < 5; k++) {
        if (!why[k][0])
            continue;
        if (!listed++)
            add_item(text, "Left to auto");
        else
            sp_text_add(text, "; ");
        sp_text_add(text, "<em>%s</em> ", names[k]);
        sp_markup_escape(text, why[k]);
    }
    if (listed)
        sp_text_add(text, "</dd>\n");
}

/* A wall that film rinses, for readers who know how thick films are. */
static void add_film(sp_text *text, const sp_setup *setup)
{
    double per_width = setup->criterion.film, thickness = sp_film_thickness(&setup->liquid, per_width, setup->gravity);
    sp_text_add(
        text,
        "; or at least %.4g&nbsp;L/min runs down per metre of width (on an upright wall %.2g&nbsp;mm thick and "
        "%.2g&nbsp;m/s fast): rinsed by film, whatever hits it. All that hits a wall runs down from there at "
        "once, also what it would throw back; solid streams spread on it first; rivulets of less are not counted",
        6e4 * per_width, 1e3 * thickness, per_width / thickness);
}

static void add_criterion(sp_text *text, const sp_setup *setup)
{
    const sp_criterion *criterion = &setup->criterion;
    const char *separator = "";
    add_item(text, "Covered means");
    double pass = sp_sweep_duration(&setup->sweep);
    if (criterion->flux > 0) {
        if (pass > 0)
            sp_text_add(text, "a dose of at least %.4g&nbsp;L per m\xc2\xb2", 1e3 * pass * criterion->flux);
        else
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
                          : pass > 0                              ? "; what all nozzles bring adds up"
                                                                  : "; the flux of all nozzles adds up");
    if (criterion->film > 0)
        add_film(text, setup);
    sp_text_add(text, "</dd>\n");
}

/* The same of results read from files, of which nothing else is known here, where it is one. */
static void add_read_criterion(const sp_page *page, sp_text *text)
{
    size_t count = page->result->design_count;
    bool counted = false;
    for (size_t i = 0; i < count; ++i)
        counted = counted || page->result->designs[i].evaluator;
    if (counted || !page->figures[0].criterion_known || !sp_figures_share_criterion(page->figures, count))
        return;
    char clause[SP_CRITERION_TEXT];
    sp_criterion_clause(&page->figures[0], clause);
    sp_text_add(text, "<dl>\n");
    add_item(text, "Covered means");
    sp_markup_escape(text, clause);
    sp_text_add(text, "</dd>\n</dl>\n");
}

/* Goods that pass by. */
static void add_sweep(sp_text *text, const sp_evaluator *evaluator)
{
    const sp_sweep *sweep = &sp_evaluator_setup(evaluator)->sweep;
    if (!(sweep->speed > 0))
        return;
    add_item(text, "Goods");
    sp_text_add(
        text,
        "move %.4g&nbsp;m past the nozzles at %.4g&nbsp;m/s, in %.4g&nbsp;s, and are looked at in %zu positions; "
        "every flux is the mean over the pass, the dose that times its duration, of liquid that arrives fast "
        "and steeply enough when it arrives. The pictures show them where the scene puts them, which also "
        "decides which of their sides are wet. No error is measured of them: single points tell it only of "
        "what stands</dd>\n",
        sp_distance(sweep->from, sweep->to), sweep->speed, sp_sweep_duration(sweep), sp_evaluator_positions(evaluator));
}

/* What was made of it. */
static void add_geometry(sp_text *text, const sp_evaluator *evaluator)
{
    sp_geometry_clause clauses[SP_GEOMETRY_CLAUSES];
    size_t count = sp_geometry_clauses(evaluator, clauses);
    if (!count)
        return;
    add_item(text, "Geometry");
    for (size_t k = 0; k < count; k++) {
        sp_text_add(text, "%s%s", k ? "; " : "", clauses[k].doubtful ? "<strong>" : "");
        sp_markup_escape(text, clauses[k].text);
        sp_text_add(text, "%s", clauses[k].doubtful ? "</strong>" : "");
    }
    sp_text_add(text, "</dd>\n");
}

static void add_scene(const sp_page *page, sp_text *text, const sp_evaluator *evaluator)
{
    const sp_setup *setup = sp_evaluator_setup(evaluator);
    static const char *const cavities[] = {
        "not named: every surface counts once and takes liquid from either side",
        "the space seen from a point inside: only sides that face it are cleaned and counted",
        "the outside: only sides that face it are cleaned and counted"};
    add_item(text, "Liquid");
    sp_text_add(text, "%.4g&nbsp;kg/m\xc2\xb3, %.4g&nbsp;mPa&thinsp;s</dd>\n", setup->liquid.density,
                1e3 * setup->liquid.viscosity);
    add_item(text, "Nozzles");
    sp_text_add(text,
                "flow by the catalogue&#39;s point and exponent, exit speed from the pressure drop (Bernoulli), ");
    sp_page_spread(text, page->result, evaluator);
    sp_text_add(text, "</dd>\n");
    add_item(text, "Cavity");
    sp_text_add(text, "%s</dd>\n", cavities[setup->cavity]);
}

/* The other way of counting. */
static void add_check(sp_text *text, const sp_forward_check *check)
{
    add_item(text, "Checked");
    sp_text_add(
        text,
        "counted again by %.3g million jets, on %zu texels, the proposal hits as much as the criterion asks for on ",
        1e-6 * (double)check->jets, check->texels);
    sp_markup_decimals(text, 100 * check->coverage, 1);
    sp_text_add(text, "&nbsp;%%, where the inverse evaluation finds ");
    sp_markup_decimals(text, 100 * (check->coverage - check->difference), 1);
    sp_text_add(text, "&nbsp;%%</dd>\n");
}

/* `name` of the alternative that it was for; NULL for none. */
static void add_search(sp_text *text, const sp_evaluator *evaluator, const sp_proposal *proposal, const char *name)
{
    if (name)
        sp_text_add(text, "<dt>Search, ");
    if (name)
        sp_markup_escape(text, name);
    if (name)
        sp_text_add(text, "</dt><dd>");
    else
        add_item(text, "Search");
    sp_text_add(
        text,
        "%zu pose%s at %zu mounting point%s; greedy choice by gain per %s, then refinement, accepted only where "
        "the re-traced result improved%s</dd>\n",
        proposal->candidates, proposal->candidates == 1 ? "" : "s", proposal->positions,
        proposal->positions == 1 ? "" : "s", proposal->costly ? "price" : "water",
        sp_evaluator_fidelity(evaluator)->trajectory == SP_TRAJECTORY_DRAG
            ? "; solid streams keep their type&#39;s flow, which tells where they break up"
            : "");
    if (proposal->forward_check.computed)
        add_check(text, &proposal->forward_check);
    add_item(text, "Not proved");
    sp_text_add(text, proposal->certificate.computed
                          ? "what poses between the candidates could do</dd>\n"
                          : "this report holds no bound on what the best possible layout could do</dd>\n");
}

/* The first design that is counted on it. */
static size_t first_on(const sp_page *page, const sp_evaluator *evaluator)
{
    size_t first = 0;
    while (page->result->designs[first].evaluator != evaluator)
        first++;
    return first;
}

static bool share_evaluator(const sp_page *page)
{
    bool shared = true;
    for (size_t i = 1; i < page->result->design_count; ++i)
        shared = shared && page->result->designs[i].evaluator == page->result->designs[0].evaluator;
    return shared;
}

void sp_page_assumptions(const sp_page *page, sp_text *text)
{
    sp_text_add(text, "<section id=\"assumptions\"><h2>Assumptions</h2>\n");
    add_read_criterion(page, text);
    for (size_t i = 0; i < page->result->design_count; ++i) {
        const sp_evaluator *evaluator = page->result->designs[i].evaluator;
        if (!evaluator || first_on(page, evaluator) < i)
            continue;
        if (page->main == SP_UNKNOWN || (page->alternatives && !share_evaluator(page))) {
            sp_text_add(text, "<h3>");
            sp_page_name(page, text, i);
            sp_text_add(text, "</h3>\n");
        }
        sp_text_add(text, "<dl>\n");
        add_criterion(text, sp_evaluator_setup(evaluator));
        add_sweep(text, evaluator);
        add_flight(page, text, evaluator);
        add_choice(text, evaluator);
        add_errors(page, text, evaluator);
        add_scene(page, text, evaluator);
        add_geometry(text, evaluator);
        if (page->result->proposal && !page->alternatives)
            add_search(text, evaluator, page->result->proposal, NULL);
        for (size_t k = i; k < page->result->design_count; ++k)
            if (page->result->designs[k].alternative && page->result->designs[k].evaluator == evaluator)
                add_search(text, evaluator, page->result->designs[k].alternative, page->figures[k].name);
        sp_text_add(text, "</dl>\n");
    }
    sp_text_add(
        text,
        "<p class=\"note\">All figures are from simulation. They compare layouts; whether a surface comes out clean "
        "also depends on soil, chemistry, temperature and time, and is for a test on the %s to show.</p>"
        "</section>\n",
        sp_page_cleaned(page));
}
