/* What the runs say, in sentences. */
#include "page.h"
#include "report/markup.h"

#include <math.h>

/* The run of the grid with these settings; NULL where it was not run. */
static const sp_study_run *find(const sp_study *study, sp_fidelity wanted)
{
    for (size_t i = 0; i < study->run_count; i++) {
        const sp_fidelity *is = &study->runs[i].fidelity;
        if (!study->runs[i].chosen && is->trajectory == wanted.trajectory && is->method == wanted.method &&
            is->texel == wanted.texel && is->reflections == wanted.reflections &&
            (wanted.method == SP_METHOD_INVERSE || is->jets == wanted.jets))
            return &study->runs[i];
    }
    return NULL;
}

/* Of one evaluator's runs the one of the finest texel, among these of most jets, fewest reflections and the
 * trajectory of most physics. */
static const sp_study_run *finest(const sp_study *study, sp_method method)
{
    const sp_study_run *best = NULL;
    for (size_t i = 0; i < study->run_count; i++) {
        const sp_study_run *run = &study->runs[i];
        const sp_fidelity *is = &run->fidelity, *least = best ? &best->fidelity : NULL;
        if (run->chosen || is->method != method || is->reflections > 0)
            continue;
        if (!best || is->texel < least->texel || (is->texel == least->texel && is->jets > least->jets) ||
            (is->texel == least->texel && is->jets == least->jets && is->trajectory > least->trajectory))
            best = run;
    }
    return best;
}

static void add_error(sp_text *text, const sp_study_run *run)
{
    sp_markup_decimals(text, 100 * run->misjudged, 2);
    sp_text_add(text, "\xc2\xa0%% misjudged, ");
    sp_markup_signed(text, 100 * run->error, 2);
    sp_text_add(text, "\xc2\xa0points");
}

/* A run beside the one that it differs from in one setting. */
static void compare(sp_text *text, const sp_study_run *run, const sp_study_run *with)
{
    sp_text_add(text, "<li>");
    sp_words_run(text, &run->fidelity, true, true);
    sp_text_add(text, ": ");
    add_error(text, run);
    sp_text_add(text, "; ");
    sp_words_run(text, &with->fidelity, false, true);
    sp_text_add(text, ": ");
    add_error(text, with);
    sp_text_add(text, ". The first takes ");
    sp_markup_significant(text, run->speed.evaluate / with->speed.evaluate, 2);
    sp_text_add(text, " times the seconds of the second.</li>\n");
}

static void tell_of_trajectories(sp_text *text, const sp_study *study)
{
    const sp_study_run *best = finest(study, SP_METHOD_INVERSE);
    if (!best)
        return;
    sp_fidelity wanted = best->fidelity;
    for (wanted.trajectory = SP_TRAJECTORY_LINE; wanted.trajectory < best->fidelity.trajectory; wanted.trajectory++) {
        const sp_study_run *simpler = find(study, wanted);
        if (simpler)
            compare(text, simpler, best);
    }
}

static void tell_of_jets(sp_text *text, const sp_study *study)
{
    const sp_study_run *forward = finest(study, SP_METHOD_FORWARD);
    if (!forward)
        return;
    sp_fidelity wanted = forward->fidelity;
    wanted.method = SP_METHOD_INVERSE;
    const sp_study_run *inverse = find(study, wanted);
    if (inverse)
        compare(text, forward, inverse);
}

static void tell_of_texels(sp_text *text, const sp_study *study)
{
    const sp_study_run *last = finest(study, SP_METHOD_INVERSE);
    for (size_t i = 0; last && i < study->order_count; i++) {
        const sp_study_order *order = &study->orders[i];
        if (order->fidelity.method != SP_METHOD_INVERSE || order->fidelity.trajectory != last->fidelity.trajectory ||
            order->fidelity.texel > 0 || !isfinite(order->misjudged))
            continue;
        sp_text_add(text, "<li>Half the texel leaves ");
        sp_markup_decimals(text, pow(0.5, order->misjudged), 2);
        sp_text_add(text, " of the misjudged area (inverse, %s).</li>\n", sp_word_trajectory(&order->fidelity));
    }
}

/* Reflections, one number after the other, on the finest texel with the most jets. */
static void tell_of_reflections(sp_text *text, const sp_study *study)
{
    const sp_study_run *none = finest(study, SP_METHOD_FORWARD), *before = none;
    for (size_t i = 0; none && i < study->run_count; i++) {
        sp_fidelity wanted = none->fidelity;
        wanted.reflections = study->runs[i].fidelity.reflections;
        if (wanted.reflections == 0 || find(study, wanted) != &study->runs[i])
            continue;
        sp_text_add(text, before == none ? "<li>Reflections, of coverage: none " : ", ");
        if (before == none) {
            sp_markup_decimals(text, 100 * none->coverage, 2);
            sp_text_add(text, "\xc2\xa0%%, ");
        }
        before = &study->runs[i];
        sp_text_add(text, "%d ", wanted.reflections);
        sp_markup_decimals(text, 100 * before->coverage, 2);
        sp_text_add(text, "\xc2\xa0%%");
    }
    if (before == none)
        return;
    sp_text_add(text, ". The last takes ");
    sp_markup_significant(text, before->speed.evaluate / none->speed.evaluate, 2);
    sp_text_add(text, " times the seconds of none.</li>\n");
}

void sp_study_findings(sp_text *text, const sp_study *study)
{
    sp_text_add(text, "<ul>\n");
    tell_of_trajectories(text, study);
    tell_of_texels(text, study);
    tell_of_jets(text, study);
    tell_of_reflections(text, study);
    sp_text_add(text, "</ul>\n");
}
