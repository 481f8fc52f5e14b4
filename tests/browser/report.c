/* The report as a reader sees it: opened by a browser. */
#include "browser.h"

#include <sprayplan/sprayplan.h>

static size_t occurrences(const char *text, const char *part)
{
    size_t count = 0;
    for (; (text = strstr(text, part)); text += strlen(part))
        count++;
    return count;
}

static void the_browser_finds_headings_tables_and_pictures(void **state)
{
    (void)state;
    skip_without_browser();
    char *page = browse("placed/report.html", "--dump-dom");
    assert_non_null(page);
    static const char *const headings[] = {"Figures", "Coverage against water", "Coverage in pictures", "Nozzles",
                                           "Sheet",   "Spray shadows"};
    for (size_t i = 0; i < sizeof headings / sizeof *headings; i++)
        if (!strstr(page, headings[i]))
            fail_msg("no heading %s", headings[i]);
    assert_true(occurrences(page, "<table") >= 5);
    assert_int_equal(occurrences(page, "<table"), occurrences(page, "</table>"));
    assert_int_equal(occurrences(page, "<image "), 9);
    free(page);
}

static size_t picture_size(const char *page)
{
    size_t size;
    free(browse(page, "--window-size=1200,3000 --screenshot=page.png"));
    char *picture = read_file("page.png", &size);
    assert_non_null(picture);
    assert_memory_equal(picture, "\x89PNG", 4);
    free(picture);
    return size;
}

/* An empty page packs to next to nothing. */
static void the_page_is_not_blank(void **state)
{
    (void)state;
    skip_without_browser();
    write_file("blank.html", "<!doctype html><title>blank</title>");
    assert_true(picture_size("placed/report.html") > 10 * picture_size("blank.html"));
}

/* What a reader of a phone's width finds: letters that can be read, and nothing that makes the page scroll sideways. */
static void it_is_legible_on_a_phone(void **state)
{
    (void)state;
    skip_without_browser();
    write_page_with_reader("placed/report.html", "", "narrow.js");
    write_file("phone.html",
               "<!doctype html><title>phone</title><iframe src=\"read.html\" width=\"390\" height=\"844\" "
               "style=\"border:0\"></iframe><script>addEventListener('message', ({data}) => {"
               "const told = document.createElement('pre'); told.id = 'told'; told.textContent = data; "
               "document.body.append(told)})</script>");
    char *page = browse("phone.html", "--window-size=1200,900 --virtual-time-budget=60000 --dump-dom");
    json_t *told = what_was_told(page);
    assert_string_equal(json_string_value(json_object_get(told, "ready")), "true");
    assert_int_equal(json_integer_value(json_object_get(told, "width")), 390);
    assert_int_equal(json_integer_value(json_object_get(told, "scrolled")), 390);
    for (size_t i = 0; i < 2; i++)
        assert_true(json_number_value(json_array_get(json_object_get(told, "letters"), i)) >= 11);
    json_decref(told);
    free(page);
}

/* In place of pictures that cannot be drawn. */
static void without_webgl_it_says_so(void **state)
{
    (void)state;
    skip_without_browser();
    static const char sentence[] = "This browser draws no pictures that turn";
    char *page = browse("placed/report.html", "--disable-3d-apis --virtual-time-budget=20000 --dump-dom");
    assert_int_equal(occurrences(page, sentence) - occurrences(page, "\""
                                                                     "This browser draws"),
                     1);
    assert_null(strstr(page, "<section id=\"viewer\" hidden"));
    free(page);
}

/* The PDF that the browser prints. */
static char *print_page(const char *page, size_t *size)
{
    free(browse(page, "--virtual-time-budget=20000 --no-pdf-header-footer --print-to-pdf=page.pdf"));
    char *pdf = read_file("page.pdf", size);
    assert_non_null(pdf);
    assert_memory_equal(pdf, "%PDF-", 5);
    return pdf;
}

/* How often `part` stands in what may hold zeros. */
static size_t found(const char *bytes, size_t size, const char *part)
{
    size_t count = 0, length = strlen(part);
    for (size_t i = 0; i + length <= size; i++)
        count += memcmp(bytes + i, part, length) == 0;
    return count;
}

static void blank_section(char *page, const char *head)
{
    char *section = strstr(page, head), *after = section ? strstr(section, "</section>") : NULL;
    assert_non_null(after);
    memset(section, ' ', (size_t)(after - section) + strlen("</section>"));
}

/* Pages of A4 with pictures, of which equal ones are stored once; the viewer, which needs a screen, leaves no trace,
 * nor does the sheet of what nobody is to build. */
static void it_prints_without_the_viewer(void **state)
{
    (void)state;
    skip_without_browser();
    size_t size, plain_size;
    char *page = read_file("placed/report.html", &size);
    blank_section(page, "<section id=\"viewer\"");
    blank_section(page, "<section id=\"sheet-2\" class=\"sheet early\"");
    write_file("placed/plain.html", page);
    char *pdf = print_page("placed/report.html", &size), *plain = print_page("placed/plain.html", &plain_size);
    size_t pages = found(pdf, size, "/Type /Page\n");
    assert_true(pages >= 4);
    assert_int_equal(found(pdf, size, "/MediaBox [0 0 594.95996 841.91998]"), pages);
    assert_int_equal(found(plain, plain_size, "/Type /Page\n"), pages);
    assert_true(found(pdf, size, "/Subtype /Image") >= 3);
    assert_int_equal(found(pdf, size, "/Subtype /Image"), found(plain, plain_size, "/Subtype /Image"));
    free(plain);
    free(pdf);
    free(page);
}

/* One page, without pictures, where the rest takes several; of the proposal, of the manual layout, or of what was
 * before refinement. */
static void each_sheet_prints_alone(void **state)
{
    (void)state;
    skip_without_browser();
    static const char *const sheets[] = {"placed/report.html#sheet", "placed/report.html#sheet-1",
                                         "placed/report.html#sheet-2"};
    for (size_t i = 0; i < 3; i++) {
        size_t size;
        char *pdf = print_page(sheets[i], &size);
        assert_int_equal(found(pdf, size, "/Type /Page\n"), 1);
        assert_int_equal(found(pdf, size, "/Subtype /Image"), 0);
        free(pdf);
    }
    char *rows = read_file("placed/nozzles-all.csv", NULL);
    assert_non_null(strstr(rows, "\nmanual,"));
    assert_non_null(strstr(rows, "\ngreedy,"));
    assert_non_null(strstr(rows, "\nproposed,"));
    free(rows);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_browser_finds_headings_tables_and_pictures),
        cmocka_unit_test(the_page_is_not_blank),
        cmocka_unit_test(it_is_legible_on_a_phone),
        cmocka_unit_test(without_webgl_it_says_so),
        cmocka_unit_test(it_prints_without_the_viewer),
        cmocka_unit_test(each_sheet_prints_alone),
    };
    return cmocka_run_group_tests(tests, place_once, close_workplace);
}
