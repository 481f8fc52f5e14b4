/* The page of a result, and all files beside it. */
#define FOLDER BINARY_DIR "/report-test"
#include "written.h"

static const char *const files[] = {
    "result.json",         "report.html",         "nozzles.csv",         "coverage.png",     "deposits.exr",
    "model.glb",           "coverage-manual.png", "deposits-manual.exr", "model-manual.glb", "coverage-greedy.png",
    "deposits-greedy.exr", "model-greedy.glb",    "surface.vtp",         "texels.vtp",       "nozzles.stl",
    "swabs.csv",           "nozzles-all.csv"};
#define FILES (sizeof files / sizeof *files)

static void the_same_bytes_every_time(void **state)
{
    char *first[FILES];
    size_t first_size[FILES], size;
    write_report(*state);
    for (size_t i = 0; i < FILES; i++) {
        first[i] = read_whole(files[i], &first_size[i]);
        assert_non_null(first[i]);
        assert_true(first_size[i] > 100);
    }
    write_report(*state);
    for (size_t i = 0; i < FILES; i++) {
        char *again = read_whole(files[i], &size);
        assert_int_equal(size, first_size[i]);
        assert_memory_equal(again, first[i], size);
        free(again);
        free(first[i]);
    }
}

static void the_page_stands_alone(void **state)
{
    (void)state;
    size_t size;
    char *page = read_whole("report.html", &size);
    assert_int_equal(strlen(page), size);
    /* the viewer's data and its script; whatever names hold ends neither, and the page may ask for nothing */
    assert_int_equal(occurrences(page, "<script"), 2);
    assert_int_equal(occurrences(page, "</script"), 2);
    assert_non_null(strstr(page, "N3 \\u003cb>"));
    assert_non_null(strstr(page, "content=\"default-src 'none'; "));
    assert_int_equal(occurrences(page, "src=\"http"), 0);
    assert_int_equal(occurrences(page, "<link"), 0);
    /* three views of three designs, each with words for who cannot see it */
    assert_int_equal(occurrences(page, "href=\"data:image/webp;base64,"), 9);
    assert_int_equal(occurrences(page, "<image "), 9);
    assert_true(occurrences(page, "<svg ") >= 9);
    assert_int_equal(occurrences(page, "<svg "), occurrences(page, " role=\"img\" aria-label=\""));
    free(page);
}

/* One, two and three. */
static void coverage_is_reported_by_number_of_nozzles(void **state)
{
    const fixture *f = *state;
    sp_error error = {0};
    sp_figures *figures = sp_result_figures(&f->result, &error);
    size_t size;
    char *page = read_whole("report.html", &size), row[200];
    const char *table = strstr(page, "<section id=\"counts\">");
    assert_non_null(table);
    for (size_t i = 0; i < 3; i++) {
        snprintf(row, sizeof row, ">%zu</th><td>%.1f&nbsp;%%</td><td>%.1f&nbsp;L/min</td>", i + 1,
                 100 * f->front[i].area / figures[2].clean_area, 6e4 * f->front[i].flow);
        table = strstr(table, row);
        if (!table)
            fail_msg("no row %s", row);
    }
    sp_figures_destroy(figures, f->result.design_count);
    free(page);
}

/* The main figures beside their errors, parts from the least covered on, shadows by number, samples, and what all was
 * made of. */
static void the_page_says_what_paper_needs(void **state)
{
    const fixture *f = *state;
    sp_error error = {0};
    sp_figures *figures = sp_result_figures(&f->result, &error);
    size_t size, numbered;
    char *page = read_whole("report.html", &size), text[200];
    snprintf(text, sizeof text, "covers <strong>%.1f&nbsp;%%&nbsp;\xc2\xb1&nbsp;%.1f</strong>",
             100 * figures[2].coverage, ceil(1e3 * figures[2].error_estimate) / 10);
    assert_non_null(strstr(page, text));
    const sp_part_figures *parts = figures[2].parts;
    bool shell_first = parts[0].covered / parts[0].area < parts[1].covered / parts[1].area;
    const char *table = strstr(page, "<section id=\"parts\">");
    assert_non_null(table);
    assert_true((strstr(table, ">shell</th>") < strstr(table, ">dip &lt;tube&gt;</th>")) == shell_first);
    assert_non_null(strstr(page, "<section id=\"contributions\">"));
    numbered = occurrences(page, "<text class=\"number\"");
    assert_true(numbered >= 3 && numbered == occurrences(page, "<circle class=\"shadow\""));
    assert_non_null(strstr(page, "<section id=\"swabs\">"));
    assert_non_null(strstr(page, "&lt;i&gt;.yaml</th><td class=\"text digest\">ba7816bf8f01cfea"));
    assert_non_null(strstr(page, ", 2026-11-24 12:00 UTC, by <code>sprayplan place &#39;&lt;b&gt;.yaml&#39;</code>."));
    sp_figures_destroy(figures, 3);
    free(page);
}

/* Tables that paper needs, number by number: what each nozzle does, and why shadows are dry and who is nearest. */
static void the_page_says_what_nozzles_do_and_shadows_lack(void **state)
{
    const fixture *f = *state;
    sp_error error = {0};
    sp_figures *figures = sp_result_figures(&f->result, &error);
    size_t size, lines = 0;
    char *page = read_whole("report.html", &size), text[300];
    const char *table = strstr(page, "<section id=\"contributions\">"), *end = strstr(table, "</section>");
    for (size_t d = 0; d < 3; d++)
        for (size_t i = 0; i < figures[d].nozzle_count; i++) {
            const sp_nozzle_figures *nozzle = &figures[d].nozzles[i];
            snprintf(text, sizeof text, "<td>%.1f</td><td>%.3f</td><td>%.1f</td><td>%.3f</td><td>%.2f</td></tr>",
                     6e4 * nozzle->flow, nozzle->alone, 100 * nozzle->alone / figures[d].clean_area, nozzle->lost,
                     100 * nozzle->lost / figures[d].clean_area);
            table = strstr(table, text);
            if (!table || table > end)
                fail_msg("no row %s", text);
        }
    table = strstr(page, "<section id=\"shadows\">");
    for (size_t i = 0; i < figures[0].shadow_count && i < 10; i++) {
        snprintf(text, sizeof text, "<td class=\"text\">%s</td><td class=\"text\">%s</td>",
                 sp_lack_text(figures[0].shadows[i].lack),
                 *figures[0].shadows[i].nozzle ? figures[0].shadows[i].nozzle : "\xe2\x80\x93");
        table = strstr(table, text);
        if (!table)
            fail_msg("no row %s", text);
        table += strlen(text);
    }
    char *csv = read_whole("swabs.csv", &size);
    lines = occurrences(csv, "\n");
    table = strstr(page, "<section id=\"swabs\">");
    assert_int_equal(occurrences(table, "<td class=\"text lack\">"), lines - 1);
    free(csv);
    free(page);
    sp_figures_destroy(figures, 3);
}

/* Notes tell of columns that are there, and why one has no answers. */
static void notes_on_shadows_fit_their_columns(void **state)
{
    const fixture *f = *state;
    sp_error error = {0};
    sp_remedy remedy = {.nozzle = f->layouts[2]->nozzles[0], .area = 0.01, .flow = 2e-4};
    sp_design design = f->designs[0];
    sp_result result = {.command = "simulate", .scene = "v.yaml", .design_count = 1, .designs = &design};
    result.picture_share = -1;
    char *html = sp_report_html(&result, &error);
    assert_non_null(strstr(html, "<section id=\"shadows\">"));
    assert_null(strstr(html, "One more nozzle"));
    assert_null(strstr(html, "what each nozzle brings was not worked out"));
    free(html);
    design.remedies = &remedy;
    design.remedy_count = 1;
    design.contributions = NULL;
    html = sp_report_html(&result, &error);
    assert_non_null(strstr(html, "One more nozzle: of the candidates"));
    assert_non_null(strstr(html, "; a dash: none does, or what each nozzle brings was not worked out."));
    free(html);
}

static void names_from_strangers_stay_text(void **state)
{
    (void)state;
    size_t size;
    char *page = read_whole("report.html", &size);
    assert_non_null(strstr(page, "vessel &lt;script&gt;alert(1)&lt;/script&gt; &amp; "));
    assert_non_null(strstr(page, "N3 &lt;b&gt;"));
    assert_non_null(strstr(page, "<a href=\"https://example.com/f?a=1&amp;b=2\" rel=\"noopener noreferrer\">"
                                 "flat-fan-90 &amp; co</a></td><td class=\"text\">F&lt;90&gt;</td>"));
    assert_non_null(strstr(page, "<td class=\"text\">full-cone-120</td><td class=\"text\"></td>"));
    assert_non_null(strstr(page, "dip &lt;tube&gt;"));
    assert_non_null(strstr(page, "<dt>Measured error</dt><dd>Manual \xc2\xb1"));
    assert_null(strstr(page, "N3 <b>"));
    assert_null(strstr(page, "dip <tube>"));
    free(page);
}

/* "80 %" and the like, which must not part at a line's end. */
static void a_number_keeps_its_per_cent_sign(void **state)
{
    const fixture *f = *state;
    sp_error error = {0};
    bool fittings[4] = {true};
    sp_proposal proposal = f->proposal;
    sp_design design = f->designs[2];
    sp_result result = f->result;
    proposal.fittings = fittings;
    proposal.asked_area = 0.8 * f->coverages[2]->area;
    design.name = "of one";
    design.alternative = &proposal;
    result.proposal = &proposal;
    result.designs = &design;
    result.design_count = 1;
    result.picture_share = -1;
    char *html = sp_report_html(&result, &error);
    const char *head = strstr(html, "</strong> is proposed: ");
    assert_non_null(head);
    assert_non_null(strstr(head, " the 80&nbsp;% asked for, "));
    assert_null(strstr(head, "80 % asked"));
    free(html);
}

/* Wherever it stands among others: of alternatives, what is proposed need not be the last. */
static void the_proposals_column_is_bold(void **state)
{
    const fixture *f = *state;
    sp_error error = {0};
    bool fittings[4] = {false};
    sp_proposal proposals[] = {f->proposal, f->proposal};
    sp_design designs[] = {f->designs[0], f->designs[2], f->designs[1]};
    sp_result result = f->result;
    for (int i = 0; i < 2; i++) {
        proposals[i].fittings = fittings;
        designs[1 + i].alternative = &proposals[i];
        designs[1 + i].name = i ? "of two" : "of one";
    }
    result.proposal = &proposals[0];
    result.designs = designs;
    result.picture_share = -1;
    char *html = sp_report_html(&result, &error);
    assert_non_null(strstr(html, "td.decided{font-weight:600}"));
    assert_null(strstr(html, "td:last-child"));
    const char *row = strstr(html, "Lands on surface to be cleaned</th><td>");
    assert_non_null(row);
    const char *second = strstr(row, "</td><td class=\"decided\">");
    assert_true(second && second < strstr(row, "</td><td>"));
    free(html);
}

/* By name, with the pictures, for which there was no time either. */
static void what_was_left_out_is_named(void **state)
{
    const fixture *f = *state;
    static const char *const left_out[] = {"the page's pictures"};
    sp_error error = {0};
    sp_proposal proposal = f->proposal;
    sp_result result = f->result;
    double seconds = -1;
    proposal.interrupted = true;
    proposal.cut_count = 2;
    strcpy(proposal.cut[0], "exchange");
    strcpy(proposal.cut[1], "front");
    result.proposal = &proposal;
    result.left_out = left_out;
    result.left_out_count = 1;
    result.picture_share = -1;
    char *html = sp_report_html(&result, &error), *text = sp_result_json(&result, &error);
    assert_non_null(strstr(html, "The search was stopped before its end (exchange, front); this is"));
    assert_non_null(strstr(html, "Cut short or left out: exchange, front, the page&#39;s pictures."));
    assert_null(strstr(html, "id=\"pictures\""));
    json_t *json = json_loads(text, 0, NULL), *cut = json_object_get(json, "cut_short");
    assert_int_equal(json_array_size(cut), 3);
    assert_string_equal(json_string_value(json_array_get(cut, 2)), left_out[0]);
    assert_true(sp_report_picture_time(&result, &seconds, &error));
    assert_true(seconds > 0);
    json_decref(json);
    free(html);
    free(text);
}

/* What is written over a picture keeps its place and size on the page, however few pixels the picture has. */
static void smaller_pictures_have_the_same_labels(void **state)
{
    const fixture *f = *state;
    sp_error error = {0};
    sp_result result = f->result;
    char *full = sp_report_html(&result, &error);
    result.picture_share = 0.3;
    char *small = sp_report_html(&result, &error);
    assert_true(full && small && strlen(small) < strlen(full));
    const char *a = full, *b = small;
    static const char *const over[] = {"<svg class=\"view\" viewBox=", "<circle class=\"nozzle\"",
                                       "<text class=\"name\""};
    size_t compared = 0;
    for (size_t k = 0; k < sizeof over / sizeof *over; k++, a = full, b = small)
        while ((a = strstr(a, over[k])) && (b = strstr(b, over[k]))) {
            assert_memory_equal(a, b, strcspn(a, ">"));
            a++, b++, compared++;
        }
    assert_true(compared > 20);
    assert_null(strstr(full, "class=\"shadow\" cx=\"0.0\""));
    assert_null(strstr(small, "class=\"shadow\" cx=\"0.0\""));
    free(full);
    free(small);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_same_bytes_every_time),
        cmocka_unit_test(the_page_stands_alone),
        cmocka_unit_test(coverage_is_reported_by_number_of_nozzles),
        cmocka_unit_test(the_page_says_what_paper_needs),
        cmocka_unit_test(the_page_says_what_nozzles_do_and_shadows_lack),
        cmocka_unit_test(notes_on_shadows_fit_their_columns),
        cmocka_unit_test(names_from_strangers_stay_text),
        cmocka_unit_test(a_number_keeps_its_per_cent_sign),
        cmocka_unit_test(the_proposals_column_is_bold),
        cmocka_unit_test(what_was_left_out_is_named),
        cmocka_unit_test(smaller_pictures_have_the_same_labels),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
