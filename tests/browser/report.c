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
                                           "Spray shadows"};
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_browser_finds_headings_tables_and_pictures),
        cmocka_unit_test(the_page_is_not_blank),
    };
    return cmocka_run_group_tests(tests, place_once, close_workplace);
}
