/* What a set of files is, to those who move it to its places. */
#ifndef RESULT_OUTPUT_H
#define RESULT_OUTPUT_H

#include <sprayplan/result.h>

#include "result/staging.h"

#include <sys/stat.h>

typedef struct {
    char *target, *temporary; /* paths */
    const char *name;         /* the end of both */
    bool moved;
} sp_output_entry;

struct sp_output {
    char *directory;
    int folder;  /* descriptor of it */
    size_t made; /* so many folders of its path are ours: itself, the one above, ... */
    sp_staging staging;
    bool supersedes;
    size_t count, capacity;
    sp_output_entry *entries;
    size_t protected_count;
    struct stat *protected_files; /* only their device and inode */
};

/* False, with an error that names `target`, where `name` in the folder is no file that may be replaced. */
bool sp_output_allows(const sp_output *output, const char *name, const char *target, sp_error *error);

/* commit.c: all of the set to its places, or nothing and an error. The staging folder is still there, but for what
 * could not be put back: then it is closed, and whoever comes next moves all of it. */
bool sp_output_move(sp_output *output, sp_error *error);

/* stale_outputs.c: moves to `old` what an earlier run left in `folder` that belongs with files which `fresh` replaces,
 * and is not replaced. Of a set whose own figures are not there nothing is known to be ours. */
bool sp_move_superseded(const sp_output *output, const sp_staging *staging, sp_error *error);
bool sp_put_superseded_back(const sp_output *output);

#endif
