/* The study as one self-contained page: no scripts, nothing fetched. */
#include "page.h"

#include "report/page.h"

#include <sprayplan/sprayplan.h>

#include <math.h>
#include <stdlib.h>

static void add_title(sp_text *text, const sp_study *study, const char *scene)
{
    sp_page_head(text, "Speed against accuracy", scene, false);
    sp_text_add(text, "<header><h1>Speed against accuracy</h1>\n<p class=\"about\">");
    sp_markup_escape(text, scene);
    sp_text_add(text, " \xc2\xb7 ");
    sp_markup_significant(text, study->area, 4);
    sp_text_add(text, "&nbsp;m\xc2\xb2 to be cleaned</p></header>\n");
    if (study->interrupted)
        sp_text_add(text, "<p class=\"warning\">The study was ended before it was done: what follows is what there was."
                          "</p>\n");
}

static const sp_study_run *chosen_run(const sp_study *study)
{
    for (size_t i = 0; i < study->run_count; i++)
        if (study->runs[i].chosen)
            return &study->runs[i];
    return NULL;
}

static void add_error(sp_text *text, const sp_study_run *run)
{
    sp_markup_signed(text, 100 * run->error, 2);
    sp_text_add(text, "\xc2\xa0points (\xc2\xb1\xc2\xa0");
    sp_markup_decimals(text, 100 * run->spread, 2);
    sp_text_add(text, "), ");
    sp_markup_decimals(text, 100 * run->misjudged, 2);
    sp_text_add(text, "\xc2\xa0%% misjudged, ");
    sp_markup_significant(text, run->speed.evaluate, 2);
    sp_text_add(text, "\xc2\xa0s");
}

/* Of the runs that are no further off than asked, the quickest. */
static const sp_study_run *cheapest(const sp_study *study, double accuracy)
{
    const sp_study_run *best = NULL;
    for (size_t i = 0; i < study->run_count; i++) {
        const sp_study_run *run = &study->runs[i];
        if (fabs(run->error) + run->spread <= accuracy && (!best || run->speed.evaluate < best->speed.evaluate))
            best = run;
    }
    return best;
}

static void add_headline(sp_text *text, const sp_study *study)
{
    const sp_study_run *own = chosen_run(study);
    if (!own)
        return;
    double accuracy = own->fidelity.accuracy;
    const sp_study_run *cheap = cheapest(study, accuracy);
    sp_text_add(text, "<p class=\"headline\">The scene's own settings, which are ");
    sp_words_run(text, &own->fidelity, true, true);
    sp_text_add(text, ", are off by ");
    add_error(text, own);
    sp_text_add(text, ". ");
    if (cheap) {
        sp_text_add(text, "The quickest run within its accuracy of ");
        sp_markup_significant(text, 100 * accuracy, 1);
        sp_text_add(text, "\xc2\xa0%% is %s", cheap == own ? "that one" : "");
        if (cheap != own) {
            sp_words_run(text, &cheap->fidelity, true, true);
            sp_text_add(text, ": ");
            add_error(text, cheap);
        }
        sp_text_add(text, ".");
    }
    sp_text_add(text, "</p>\n");
}

static void add_reference(sp_text *text, const sp_study *study)
{
    const sp_fidelity *reference = &study->reference;
    sp_text_add(text, "<dt>Compared with</dt><dd>");
    sp_words_count(text, study->points);
    if (reference->texel > 0) {
        sp_text_add(text,
                    " points of the surface, on which what is true was told by a run of its own, since walls throw "
                    "liquid back: ");
        sp_words_run(text, reference, true, true);
        sp_text_add(text, ". Its own error, where reflections are left out and points can tell: ");
        sp_markup_signed(text, 100 * study->reference_check, 2);
        sp_text_add(text, " points.");
    } else
        sp_text_add(
            text, " points of the surface, each judged for itself in closed form (%s), with no texel between%s.",
            sp_word_trajectory(reference),
            study->passing ? ": its dose by steps of a quarter texel, and finer where spray or shadow begins" : "");
    if (study->reference_film_cell > 0) {
        sp_text_add(text, " Film is routed for them on cells of ");
        sp_words_texel(text, study->reference_film_cell);
        sp_text_add(text, ", half as long as the runs' finest.");
    }
    sp_text_add(text, " They find ");
    sp_markup_decimals(text, 100 * study->reference_coverage, 2);
    sp_text_add(text, "\xc2\xa0%% covered (\xc2\xb1\xc2\xa0");
    sp_markup_decimals(text, 100 * study->reference_spread, 2);
    sp_text_add(text, " from being a sample; differences are known better).</dd>\n");
}

static void add_notes(sp_text *text, const sp_study *study)
{
    sp_text_add(text, "<section id=\"measured\"><h2>How it was measured</h2>\n<dl>");
    if (study->run_count)
        add_reference(text, study);
    sp_text_add(text,
                "<dt>Seconds</dt><dd>Of wall time; beside them the processor time of all threads together. Of one "
                "run the median of as many repetitions as fit into a third of a second, five at most. Preparing "
                "is tree, wet sides and atlas, evaluating is one layout.</dd>\n"
                "<dt>Memory</dt><dd>The most that the program and its library held at a time, beyond the "
                "geometry; what libraries beneath it take for themselves is not counted.</dd>\n"
                "<dt>What varies</dt><dd>What the scene sets is not varied: a texel that it sets is the only "
                "one.</dd>\n");
    const char *notes[SP_STUDY_NOTES];
    size_t count = study->run_count ? sp_words_notes(study, notes) : 0;
    if (count)
        sp_text_add(text, "<dt>What does not</dt><dd>");
    for (size_t i = 0; i < count; i++)
        sp_text_add(text, "%s%s", i ? " " : "", notes[i]);
    sp_text_add(text, "%s</dl></section>\n", count ? "</dd>" : "");
}

char *sp_study_html(const sp_study *study, const char *scene, sp_error *error)
{
    if (!study || !scene)
        return NULL;
    char *name = sp_text_utf8(scene);
    if (!name)
        return sp_fail_memory(error);
    sp_text text = {0};
    add_title(&text, study, name);
    free(name);
    if (study->run_count) {
        add_headline(&text, study);
        sp_study_findings(&text, study);
        sp_study_run_plots(&text, study);
    }
    sp_study_place_page(&text, study);
    if (study->run_count)
        sp_study_run_tables(&text, study);
    add_notes(&text, study);
    sp_text_add(&text, "<footer>Made by sprayplan " SP_VERSION ".</footer>\n</main>\n</body>\n</html>\n");
    return sp_text_finish(&text, error);
}
