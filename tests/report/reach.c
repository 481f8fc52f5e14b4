/* What the page says of surface that no allowed nozzle reaches. */
#define FOLDER BINARY_DIR "/report-reach-test"
#include "written.h"

/* Before anything else: how much, why, and of which parts. */
static void what_is_out_of_reach_is_said_first(void **state)
{
    const fixture *f = *state;
    sp_error error = {0};
    char *html = sp_report_html(&f->result, &error), text[200];
    sp_figures *figures = sp_result_figures(&f->result, &error);
    const char *first = strstr(html, "<p id=\"out-of-reach\" class=\"warning\">");
    assert_true(first && first < strstr(html, "class=\"headline\""));
    assert_true(strstr(html, "<section id=\"attainable\">") < strstr(html, "<section id=\"figures\">"));
    const char *warning = strstr(html, "The coverage asked for is not reached");
    /* the fixture's proposal says that allowed nozzles reach 5 m2, of which 50 were aimed at */
    assert_true(figures[2].attainable_area > 5);
    snprintf(text, sizeof text,
             "nozzles that are allowed reach no more than %.2f&nbsp;%%, so that %.1f&nbsp;%% were aimed at; with what "
             "the engineer&#39;s own reach %.2f&nbsp;%% are attainable; ",
             ceil(5e4 / figures[2].clean_area) / 100, 5000 / figures[2].clean_area,
             ceil(1e4 * figures[2].attainable_area / figures[2].clean_area) / 100);
    assert_true(warning && strstr(warning, text));
    const char *table = strstr(html, "<caption>Out of reach, ");
    assert_non_null(table);
    for (size_t i = 0; i < figures[2].missing_count; i++) {
        double sum = 0;
        for (sp_reason reason = 0; reason < SP_REASONS; reason++)
            sum += figures[2].missing[i].areas[reason];
        same_real(sum, figures[2].missing[i].area);
        snprintf(text, sizeof text, "%.4f</td></tr>", figures[2].missing[i].area);
        assert_non_null(strstr(table, text));
    }
    sp_figures_destroy(figures, f->result.design_count);
    free(html);
}

/* Where the engineer's nozzles reach no more than those that are allowed. */
static void one_share_is_attainable(void **state)
{
    const fixture *f = *state;
    sp_error error = {0};
    sp_result result = f->result;
    sp_proposal proposal = f->proposal;
    result.designs = &f->designs[1];
    result.design_count = 2;
    result.proposal = &proposal;
    sp_figures *figures = sp_result_figures(&result, &error);
    proposal.attainable_area = figures[1].attainable_area;
    char *html = sp_report_html(&result, &error), text[200];
    snprintf(text, sizeof text, "no more than %.2f&nbsp;%% are attainable, so that %.1f&nbsp;%% were aimed at",
             ceil(1e4 * figures[1].attainable_area / figures[1].clean_area) / 100, 5000 / figures[1].clean_area);
    assert_non_null(strstr(html, text));
    free(html);
    sp_figures_destroy(figures, result.design_count);
}

/* What was not found in the time may be there: no sentence says that it is not. */
static void is_reported_as_hurried(const char *html)
{
    static const char *const sentences[] = {"<p id=\"beyond\"", "<p id=\"out-of-reach\"", "<section id=\"attainable\">",
                                            "A region that is not attainable"};
    static const char looked[] = ", as far as the time allowed to look";
    for (size_t i = 0; i < sizeof sentences / sizeof *sentences; i++) {
        const char *sentence = strstr(html, sentences[i]);
        assert_non_null(sentence);
        assert_true(strstr(sentence, looked) && strstr(sentence, looked) < strstr(sentence, "</p>"));
    }
    assert_null(strstr(html, "no proposal can cover it"));
    assert_null(strstr(html, "reach no more than"));
    assert_null(strstr(html, "which no choice among them mends"));
}

/* What the engineer's nozzles cover counts as attainable; that no allowed nozzle reaches it is told. */
static void what_own_nozzles_alone_reach_is_reported(void **state)
{
    const fixture *f = *state;
    sp_error error = {0};
    sp_result result = f->result;
    sp_proposal proposal = f->proposal;
    const sp_patches *patches = sp_evaluator_patches(f->evaluator);
    double covered = 0;
    proposal.attainable = malloc(patches->count * sizeof *proposal.attainable);
    memset(proposal.attainable, true, patches->count);
    result.proposal = &proposal;
    char *html = sp_report_html(&result, &error);
    assert_null(strstr(html, "id=\"beyond\""));
    free(html);
    memset(proposal.attainable, false, patches->count);
    proposal.reasons = calloc(patches->count, sizeof *proposal.reasons);
    for (size_t k = 0; k < patches->count; k++) {
        bool any = false;
        proposal.reasons[k] = SP_REASON_NO_LINE;
        for (size_t i = 0; i < result.design_count; i++)
            any = any || result.designs[i].coverage->deposits.covered[k];
        covered += any ? patches->area[k] : 0;
    }
    sp_figures *figures = sp_result_figures(&result, &error);
    assert_true(covered > SP_BEYOND_TOLD * patches->total_area);
    same_real(figures[2].beyond_area, covered);
    same_real(figures[2].missing_area[SP_REASON_NO_LINE], patches->total_area - covered);
    html = sp_report_html(&result, &error);
    assert_non_null(strstr(html, "<p id=\"beyond\" class=\"warning\">"));
    assert_non_null(strstr(html, "no proposal can cover it"));
    free(html);
    proposal.attainable_hurried = true;
    html = sp_report_html(&result, &error);
    is_reported_as_hurried(html);
    free(html);
    sp_figures_destroy(figures, result.design_count);
    free(proposal.attainable);
    free(proposal.reasons);
}

/* What liquid gets to, and too little of, more nozzles might reach: no fault of the vessel. */
static void limits_are_told_from_faults(void **state)
{
    fixture *f = *state;
    size_t patches = sp_evaluator_patches(f->evaluator)->count;
    sp_reason *mixed = malloc(patches * sizeof *mixed), *little = malloc(patches * sizeof *little);
    sp_proposal proposal = f->proposal;
    sp_result result = f->result;
    sp_error error = {0};
    assert_true(mixed && little);
    for (size_t i = 0; i < patches; i++) {
        little[i] = f->proposal.reasons[i] == SP_REASON_ATTAINABLE ? SP_REASON_ATTAINABLE : SP_REASON_FLUX;
        mixed[i] = i % 2 ? little[i] : f->proposal.reasons[i];
    }
    result.proposal = &proposal;
    result.picture_share = -1;
    const struct {
        sp_reason *reasons;
        size_t nozzles;
        const char *says, *lacks;
    } cases[] = {
        {little, 1, "with no more than 1 nozzle (max_nozzles) and 40 L/min (max_water)", "is a fault of the"},
        {mixed, 2, "with no more than 2 nozzles (max_nozzles) and 40 L/min (max_water)", " What is out of reach"},
        {mixed, 2, " What else is out of reach", " What is out of reach"},
        {f->proposal.reasons, 1, " What is out of reach", "for the limits alone"},
    };
    proposal.max_water = 40 / 6e4;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        proposal.reasons = cases[i].reasons;
        proposal.max_nozzles = cases[i].nozzles;
        char *html = sp_report_html(&result, &error);
        assert_non_null(html);
        assert_non_null(strstr(html, cases[i].says));
        assert_null(strstr(html, cases[i].lacks));
        free(html);
    }
    free(mixed);
    free(little);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_out_of_reach_is_said_first),
        cmocka_unit_test(one_share_is_attainable),
        cmocka_unit_test(what_own_nozzles_alone_reach_is_reported),
        cmocka_unit_test(limits_are_told_from_faults),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
