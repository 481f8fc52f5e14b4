/* What an earlier run left beside the files that replace it: figures of one run and pictures of another are not to lie
 * in one folder. layout.yaml, which may have been edited since, stays. */
#include "result/output.h"

#include <errno.h>
#include <fcntl.h>
#include <jansson.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* The figures last: they tell that the others are ours. */
static const char *const result_files[] = {
    "coverage.png",        "coverage-manual.png", "coverage-greedy.png", "deposits.exr",     "deposits-manual.exr",
    "deposits-greedy.exr", "model.glb",           "model-manual.glb",    "model-greedy.glb", "nozzles.csv",
    "nozzles.stl",         "swabs.csv",           "surface.vtp",         "texels.vtp",       "nozzles-all.csv",
    "report.html",         "result.json",
};
static const char *const study_files[] = {"study.csv", "place.csv", "report.html", "study.json"};

static const struct {
    const char *const *names;
    size_t count;
} sets[] = {{result_files, sizeof result_files / sizeof *result_files},
            {study_files, sizeof study_files / sizeof *study_files}};

static bool is_ours(int folder, const char *figures)
{
    int file = openat(folder, figures, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (file < 0)
        return false;
    json_t *object = json_loadfd(file, 0, NULL);
    bool ours =
        json_is_string(json_object_get(object, "sprayplan")) && json_is_string(json_object_get(object, "command"));
    json_decref(object);
    close(file);
    return ours;
}

static bool is_there(int folder, const char *name)
{
    struct stat status;
    return fstatat(folder, name, &status, AT_SYMLINK_NOFOLLOW) == 0;
}

static bool move_one(const sp_output *output, const sp_staging *staging, const char *name, sp_error *error)
{
    char target[1024];
    snprintf(target, sizeof target, "%s/%s", output->directory, name);
    if (is_there(staging->fresh, name) || !is_there(output->folder, name) ||
        !sp_output_allows(output, name, target, NULL))
        return true;
    return renameat(output->folder, name, staging->old, name) == 0 ||
           sp_fail(error, SP_ERROR_FILE, target, 0, 0, "cannot be removed: %s", strerror(errno));
}

bool sp_move_superseded(const sp_output *output, const sp_staging *staging, sp_error *error)
{
    if (!is_there(staging->folder, "supersedes"))
        return true;
    for (size_t s = 0; s < sizeof sets / sizeof *sets; s++) {
        if (!is_ours(output->folder, sets[s].names[sets[s].count - 1]))
            continue;
        for (size_t i = 0; i < sets[s].count; i++)
            if (!move_one(output, staging, sets[s].names[i], error))
                return false;
    }
    unlinkat(staging->folder, "supersedes", 0);
    return true;
}

bool sp_put_superseded_back(const sp_output *output)
{
    bool done = true;
    for (size_t s = 0; s < sizeof sets / sizeof *sets; s++)
        for (size_t i = 0; i < sets[s].count; i++) {
            const char *name = sets[s].names[i];
            if (is_there(output->staging.old, name) && !is_there(output->folder, name))
                done = renameat(output->staging.old, name, output->folder, name) == 0 && done;
        }
    return done;
}
