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

/* Whether a report can be opened here and brings the evaluator along, which it does where clang for WebAssembly was
 * there at build time. */
static inline bool can_evaluate(const char *report)
{
    char *page = has_browser() ? read_file(report, NULL) : NULL;
    bool carried = page && strstr(page, "id=\"live-module\"");
    free(page);
    return carried;
}

static inline void skip_unless_evaluating(bool evaluates)
{
    skip_without_browser();
    if (!evaluates) {
        print_message("clang for WebAssembly is not installed: pages evaluate nothing\n");
        skip();
    }
}

/* The room under one nozzle, as far as what its `place:` says. */
#define ROOM_WITH_A_NOZZLE                                                                                             \
    "geometry:\n"                                                                                                      \
    "  - file: room.obj\n"                                                                                             \
    "cavity: [0.5 m, 0.5 m, 0.5 m]\n"                                                                                  \
    "criterion: {flux: 1 L/min/m2}\n"                                                                                  \
    "catalogue: catalogue.yaml\n"                                                                                      \
    "nozzles:\n"                                                                                                       \
    "  - {name: N1, type: cone, position: [0.3 m, 0.3 m, 0.8 m], axis: [0, 0, -1], pressure: 2 bar}\n"                 \
    "simulate: {texel: " ROOM_TEXEL "}\n"                                                                              \
    "place:\n"

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

/* read.html: a report with a script of this folder, and reading.js before it, behind its own, and `first` before all
 * of them. */
static inline void write_page_with_reader(const char *report, const char *first, const char *script)
{
    char *page = read_file(report, NULL), *head = page ? strstr(page, "</head>") : NULL;
    char *end = page ? strstr(page, "</body>") : NULL;
    assert_non_null(head);
    assert_non_null(end);
    *head = *end = 0;
    char line[2048], path[1024];
    snprintf(path, sizeof path, "%s/read.html", workplace);
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    fprintf(file, "%s%s</head>%s<script>\n", page, first, head + strlen("</head>"));
    fclose(file);
    snprintf(line, sizeof line,
             "cat '" SOURCE_DIR "/tests/browser/reading.js' '" SOURCE_DIR "/tests/browser/%s' >>'%s'", script, path);
    assert_int_equal(system(line), 0);
    snprintf(line, sizeof line, "echo '</script></body></html>' >>'%s'", path);
    assert_int_equal(system(line), 0);
    free(page);
}

/* The text of <pre id="told">, as JSON. */
static inline json_t *what_was_told(char *page)
{
    char *from = strstr(page, "<pre id=\"told\">"), *to = from ? strstr(from, "</pre>") : NULL;
    assert_non_null(to);
    *to = 0;
    char *text = from + strlen("<pre id=\"told\">"), *write = text;
    for (const char *read = text; *read; ++write) { /* the browser escapes these three */
        static const char *const entities[][2] = {{"&amp;", "&"}, {"&lt;", "<"}, {"&gt;", ">"}};
        *write = *read++;
        for (int k = 0; k < 3; k++)
            if (!strncmp(read - 1, entities[k][0], strlen(entities[k][0]))) {
                *write = entities[k][1][0];
                read += strlen(entities[k][0]) - 1;
            }
    }
    *write = 0;
    return json_loads(text, 0, NULL);
}

/* What a script of this folder tells of a report, and has the browser's `arguments` for. */
static inline json_t *read_with(const char *script, const char *report, const char *arguments)
{
    write_page_with_reader(report, "", script);
    char *page = browse("read.html", arguments);
    json_t *told = what_was_told(page);
    free(page);
    return told;
}

/* What NAME.js tells of the page of a simulation of NAME.yaml; NULL where it does not evaluate layouts. */
static inline json_t *ask_page(const char *name)
{
    char line[200], report[100], script[100];
    snprintf(line, sizeof line, "simulate %s.yaml -o %s --quiet", name, name);
    snprintf(report, sizeof report, "%s/report.html", name);
    snprintf(script, sizeof script, "%s.js", name);
    outcome result = run_program(line);
    forget(&result);
    return can_evaluate(report)
               ? read_with(script, report, "--window-size=1200,900 --virtual-time-budget=600000 --dump-dom")
               : NULL;
}

/* What a script found in a page that it opened: nothing went wrong, and nothing was asked for outside of it. */
static inline void assert_opened(const json_t *found)
{
    assert_string_equal(json_string_value(json_object_get(found, "ready")), "true");
    assert_int_equal(json_array_size(json_object_get(found, "errors")), 0);
    assert_int_equal(json_array_size(json_object_get(found, "requests")), 0);
    char *messages = read_file(".err", NULL);
    assert_null(strstr(messages, ":CONSOLE"));
    free(messages);
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
