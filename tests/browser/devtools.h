/* A page in headless Chromium that is driven from outside: its devtools protocol over two pipes (file descriptors 3 and
 * 4 of the browser), messages of JSON that end with a zero byte. For events that scripts of a page cannot make. */
#ifndef BROWSER_DEVTOOLS_H
#define BROWSER_DEVTOOLS_H

#include "browser.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <time.h>

typedef struct {
    pid_t browser;
    int to, from;
    int asked;
    char session[128];
} devtools;

static inline void devtools_launch(const char *folder, int in, int out)
{
    char profile[1200];
    snprintf(profile, sizeof profile, "--user-data-dir=%s/profile", folder);
    /* the pipes may be 3 and 4 themselves: out of the way first */
    int apart[2] = {fcntl(in, F_DUPFD, 10), fcntl(out, F_DUPFD, 10)};
    dup2(apart[0], 3);
    dup2(apart[1], 4);
    freopen("/dev/null", "w", stdout);
    freopen("/dev/null", "w", stderr);
    execlp("chromium", "chromium", "--headless", "--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader",
           "--enable-unsafe-swiftshader", "--disable-dev-shm-usage", "--hide-scrollbars", "--window-size=1200,1000",
           "--remote-debugging-pipe", profile, "about:blank", (char *)NULL);
    _exit(127);
}

/* The next message; the caller owns it. */
static inline json_t *devtools_read(devtools *d)
{
    size_t length = 0, room = 1 << 16;
    char *text = malloc(room);
    for (;;) {
        assert_int_equal(read(d->from, text + length, 1), 1);
        if (!text[length])
            break;
        if (++length == room)
            text = realloc(text, room *= 2);
    }
    json_t *message = json_loadb(text, length, 0, NULL);
    assert_non_null(message);
    free(text);
    return message;
}

/* What a method answers; takes `parameters`. The caller owns it. */
static inline json_t *devtools_ask(devtools *d, const char *method, json_t *parameters)
{
    json_t *message = json_pack("{s:i, s:s, s:o}", "id", ++d->asked, "method", method, "params", parameters);
    if (*d->session)
        json_object_set_new(message, "sessionId", json_string(d->session));
    char *text = json_dumps(message, JSON_COMPACT);
    json_decref(message);
    size_t length = strlen(text) + 1;
    for (size_t sent = 0; sent < length;) {
        ssize_t more = write(d->to, text + sent, length - sent);
        assert_true(more > 0);
        sent += (size_t)more;
    }
    free(text);
    for (;;) {
        json_t *answer = devtools_read(d);
        if (json_integer_value(json_object_get(answer, "id")) != d->asked) {
            json_decref(answer); /* an event */
            continue;
        }
        json_t *result = json_object_get(answer, "result");
        if (!result)
            fail_msg("%s: %s", method, json_dumps(answer, JSON_COMPACT));
        json_incref(result);
        json_decref(answer);
        return result;
    }
}

/* A page of the workplace, opened. */
static inline void devtools_open(devtools *d, const char *page)
{
    int to[2], from[2];
    assert_int_equal(pipe(to), 0);
    assert_int_equal(pipe(from), 0);
    *d = (devtools){.browser = fork()};
    if (d->browser == 0)
        devtools_launch(workplace, to[0], from[1]);
    close(to[0]);
    close(from[1]);
    d->to = to[1];
    d->from = from[0];
    char address[2048];
    snprintf(address, sizeof address, "file://%s/%s", workplace, page);
    json_t *made = devtools_ask(d, "Target.createTarget", json_pack("{s:s}", "url", address));
    json_t *held = devtools_ask(
        d, "Target.attachToTarget",
        json_pack("{s:s, s:b}", "targetId", json_string_value(json_object_get(made, "targetId")), "flatten", 1));
    snprintf(d->session, sizeof d->session, "%s", json_string_value(json_object_get(held, "sessionId")));
    json_decref(made);
    json_decref(held);
}

static inline void devtools_close(devtools *d)
{
    kill(d->browser, SIGTERM);
    waitpid(d->browser, NULL, 0);
    close(d->to);
    close(d->from);
}

/* What an expression comes to, also of a promise; the caller owns it. */
static inline json_t *devtools_evaluate(devtools *d, const char *expression)
{
    json_t *answer =
        devtools_ask(d, "Runtime.evaluate",
                     json_pack("{s:s, s:b, s:b}", "expression", expression, "awaitPromise", 1, "returnByValue", 1));
    if (json_object_get(answer, "exceptionDetails"))
        fail_msg("%s", json_dumps(answer, JSON_COMPACT));
    json_t *value = json_object_get(json_object_get(answer, "result"), "value");
    json_incref(value);
    json_decref(answer);
    return value;
}

/* Until a page, which may still be on its way, has a script's global of that name. */
static inline void devtools_wait(devtools *d, const char *global)
{
    char expression[200];
    snprintf(expression, sizeof expression, "typeof %s !== 'undefined'", global);
    for (int i = 0; i < 600; i++) {
        json_t *there = devtools_evaluate(d, expression);
        bool ready = json_is_true(there);
        json_decref(there);
        if (ready)
            return;
        nanosleep(&(struct timespec){.tv_nsec = 50000000}, NULL);
    }
    fail_msg("no %s in the page", global);
}

/* By the mouse: pressed at one place, moved to the other in steps, let go; CSS pixels of the window. */
static inline void devtools_drag(devtools *d, const double from[2], const double to[2])
{
    enum { STEPS = 8 };
    for (int i = -1; i <= STEPS + 1; i++) {
        double share = i < 0 ? 0 : i > STEPS ? 1 : (double)i / STEPS;
        const char *type = i < 0 ? "mousePressed" : i > STEPS ? "mouseReleased" : "mouseMoved";
        json_decref(
            devtools_ask(d, "Input.dispatchMouseEvent",
                         json_pack("{s:s, s:f, s:f, s:s, s:i, s:i}", "type", type, "x",
                                   from[0] + share * (to[0] - from[0]), "y", from[1] + share * (to[1] - from[1]),
                                   "button", "left", "buttons", i > STEPS ? 0 : 1, "clickCount", 1)));
    }
}

#endif
