/* What an earlier run left beside the files that replace it: figures of one run and pictures of another are not to lie
 * in one folder. A layout that was edited since stays. */
#include "result/output.h"

#include "result/digest.h"

#include <errno.h>
#include <fcntl.h>
#include <jansson.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* The figures last: they tell that the others are ours. */
static const char *const result_files[] = {
    "coverage.png",        "coverage-manual.png", "coverage-greedy.png", "deposits.exr",
    "deposits-manual.exr", "deposits-greedy.exr", "model.glb",           "model-manual.glb",
    "model-greedy.glb",    "nozzles.csv",         "nozzles.stl",         "swabs.csv",
    "surface.vtp",         "texels.vtp",          "nozzles-all.csv",     "wet.png",
    "report.html",         "result.json",
};
static const char *const study_files[] = {"study.csv", "place.csv", "wet.png", "report.html", "study.json"};

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

typedef struct {
    const sp_output *output;
    const sp_staging *staging;
    sp_error *error;
} leaving;

/* A layout as it was written. */
static bool move_layout(void *user, const char *name)
{
    const leaving *l = user;
    if (!sp_digest_is_for(name) || is_there(l->staging->fresh, name))
        return true;
    sp_digest seal = sp_digest_check(l->output->folder, name, l->error);
    return seal == SP_SEAL_WHOLE ? move_one(l->output, l->staging, name, l->error) : seal != SP_SEAL_UNKNOWN;
}

/* The layouts before the figures, which tell that the set is ours. */
static bool move_set(const leaving *l, size_t set)
{
    if (!is_ours(l->output->folder, sets[set].names[sets[set].count - 1]))
        return true;
    if (sets[set].names == result_files && !sp_each_name(l->output->folder, move_layout, (void *)l))
        return sp_fail(l->error, SP_ERROR_FILE, l->output->directory, 0, 0, "cannot be read: %s", strerror(errno));
    for (size_t i = 0; i < sets[set].count; i++)
        if (!move_one(l->output, l->staging, sets[set].names[i], l->error))
            return false;
    return true;
}

bool sp_move_superseded(const sp_output *output, const sp_staging *staging, sp_error *error)
{
    const leaving l = {output, staging, error};
    if (!is_there(staging->folder, "supersedes"))
        return true;
    for (size_t s = 0; s < sizeof sets / sizeof *sets; s++)
        if (!move_set(&l, s))
            return false;
    unlinkat(staging->folder, "supersedes", 0);
    return true;
}

static bool put_one_back(void *user, const char *name)
{
    const sp_output *output = user;
    return is_there(output->folder, name) || renameat(output->staging.old, name, output->folder, name) == 0;
}

bool sp_put_superseded_back(const sp_output *output)
{
    return sp_each_name(output->staging.old, put_one_back, (void *)output);
}
