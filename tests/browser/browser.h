/* Pages of the workplace in headless Chromium, with WebGL by software. */
#ifndef BROWSER_BROWSER_H
#define BROWSER_BROWSER_H

#include "../cli/workplace.h"

static inline bool has_browser(void)
{
    return system("command -v chromium >/dev/null 2>&1") == 0;
}

static inline void skip_without_browser(void)
{
    if (!has_browser()) {
        print_message("chromium is not installed: the report is not opened\n");
        skip();
    }
}

/* Opens a page with the browser; what it prints is the caller's. Messages of the page's console are in .err. */
static inline char *browse(const char *page, const char *arguments)
{
    char line[4096];
    snprintf(line, sizeof line,
             "cd '%s' && timeout 120 chromium --headless --no-sandbox --use-gl=angle --use-angle=swiftshader "
             "--enable-unsafe-swiftshader --disable-dev-shm-usage --user-data-dir='%s/profile' --hide-scrollbars "
             "--enable-logging=stderr %s \"file://$PWD/%s\" >.out 2>.err </dev/null",
             workplace, workplace, arguments, page);
    assert_int_equal(system(line), 0);
    return read_file(".out", NULL);
}

/* The workplace with the room's proposal in placed/, where there is a browser to open it. */
static inline int place_once(void **state)
{
    if (open_workplace(state) != 0)
        return -1;
    if (!has_browser())
        return 0;
    outcome result = run_program("place room.yaml -o placed --quiet");
    int status = result.status;
    forget(&result);
    return status == 0 ? 0 : -1;
}

#endif
