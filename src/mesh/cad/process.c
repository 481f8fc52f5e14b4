#define _GNU_SOURCE /* pipe2: no other thread's child may inherit the ends */
#include "mesh/cad/process.h"

#include "clock.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum { TICK = 100 }; /* ms between two looks at whether to go on */

extern char **environ;

/* The program's output is the pipe, it reads nothing and what it says is for nobody; signals do what they always do,
 * whatever this program has made of them. */
static int spawn(char *const *arguments, int pipe_end, pid_t *child)
{
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    sigset_t all, none;
    sigfillset(&all);
    sigemptyset(&none);
    int problem = posix_spawn_file_actions_init(&actions);
    if (problem)
        return problem;
    problem = posix_spawnattr_init(&attributes);
    if (!problem) {
        short flags = POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK;
        bool ready = !posix_spawn_file_actions_adddup2(&actions, pipe_end, STDOUT_FILENO) &&
                     !posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0) &&
                     !posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0) &&
                     !posix_spawnattr_setsigdefault(&attributes, &all) &&
                     !posix_spawnattr_setsigmask(&attributes, &none) && !posix_spawnattr_setflags(&attributes, flags);
        problem = ready ? posix_spawn(child, arguments[0], &actions, &attributes, arguments, environ) : ENOMEM;
        posix_spawnattr_destroy(&attributes);
    }
    posix_spawn_file_actions_destroy(&actions);
    return problem;
}

static bool cancelled(const sp_cad_stream *stream, const sp_run *run, sp_error *error)
{
    if (!run->progress || run->progress(run->user, "geometry", stream->done))
        return false;
    sp_fail(error, SP_ERROR_INTERRUPTED, stream->path, 0, 0, "interrupted");
    return true;
}

/* Until the pipe ends; false with an error where that is not to be waited for. */
static bool read_all(int pipe_end, double until, sp_cad_stream *stream, const sp_run *run, sp_error *error)
{
    static const char late[] = "takes longer than a file of its size may";
    unsigned char bytes[1 << 16];
    struct pollfd wait = {.fd = pipe_end, .events = POLLIN};
    for (;;) {
        if (cancelled(stream, run, error))
            return false;
        if (sp_now() > until)
            return sp_fail(error, SP_ERROR_INPUT, stream->path, 0, 0, "cannot be read: sprayplan-cad %s", late);
        if (poll(&wait, 1, TICK) <= 0)
            continue;
        ssize_t count = read(pipe_end, bytes, sizeof bytes);
        if (count == 0)
            return true;
        if (count < 0 && errno != EINTR)
            return sp_fail(error, SP_ERROR_INPUT, stream->path, 0, 0, "cannot be read from sprayplan-cad: %s",
                           strerror(errno));
        if (count > 0 && !sp_cad_stream_take(stream, bytes, (size_t)count, error))
            return false;
    }
}

/* Who has closed the pipe is about to end, and killed if not. Returns the status; 0 where somebody else took it. */
static int reap(pid_t child, bool done)
{
    int status = 0;
    const struct timespec tick = {.tv_nsec = 1000000};
    pid_t ended = 0;
    for (int i = 0; done && i < 1000 && ended == 0; i++) {
        ended = waitpid(child, &status, WNOHANG);
        if (ended == 0)
            nanosleep(&tick, NULL);
    }
    if (ended == 0) {
        kill(child, SIGKILL);
        while ((ended = waitpid(child, &status, 0)) < 0 && errno == EINTR)
            ;
    }
    return ended == child ? status : 0;
}

static bool judge(const sp_cad_stream *stream, int status, sp_error *error)
{
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU)
        return sp_fail(error, SP_ERROR_INPUT, stream->path, 0, 0,
                       "cannot be read: OpenCASCADE takes more processor time than a file of its size may; it is "
                       "damaged, or wants a longer chord");
    if (WIFSIGNALED(status))
        return sp_fail(error, SP_ERROR_INPUT, stream->path, 0, 0,
                       "cannot be read: OpenCASCADE crashed on it (%s), expected a sound file",
                       strsignal(WTERMSIG(status)));
    if (WEXITSTATUS(status) != 0 || !stream->ended)
        return sp_fail(error, SP_ERROR_INPUT, stream->path, 0, 0,
                       "cannot be read: sprayplan-cad ended early, with status %d", WEXITSTATUS(status));
    return true;
}

bool sp_cad_process_run(char *const *arguments, double seconds, sp_cad_stream *stream, const sp_run *run,
                        sp_error *error)
{
    int ends[2];
    pid_t child;
    if (pipe2(ends, O_CLOEXEC) != 0)
        return sp_fail(error, SP_ERROR_FILE, NULL, 0, 0, "no pipe to sprayplan-cad: %s", strerror(errno));
    int problem = spawn(arguments, ends[1], &child);
    close(ends[1]);
    if (problem) {
        close(ends[0]);
        return sp_fail(error, SP_ERROR_FILE, arguments[0], 0, 0, "cannot be started: %s", strerror(problem));
    }
    bool whole = read_all(ends[0], sp_now() + seconds, stream, run, error);
    close(ends[0]);
    int status = reap(child, whole);
    return whole && !cancelled(stream, run, error) && judge(stream, status, error);
}
