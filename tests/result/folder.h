/* What a folder holds, all of it in one text, for tests that compare folders. */
#ifndef TESTS_RESULT_FOLDER_H
#define TESTS_RESULT_FOLDER_H

#include <dirent.h>
#include <ftw.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static int is_listed(const struct dirent *entry)
{
    return strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0;
}

static void add_folder(FILE *to, const char *path, bool hidden);

static void add_entry(FILE *to, const char *path, bool hidden)
{
    struct stat status;
    if (lstat(path, &status) != 0)
        return;
    if (S_ISDIR(status.st_mode)) {
        fprintf(to, "%s/\n", path);
        add_folder(to, path, hidden);
        return;
    }
    fprintf(to, "%s, %lld bytes: ", path, (long long)status.st_size);
    FILE *file = S_ISREG(status.st_mode) ? fopen(path, "rb") : NULL;
    for (int byte; file && (byte = getc(file)) != EOF;)
        putc(byte ? byte : '0', to);
    if (file)
        fclose(file);
    putc('\n', to);
}

static void add_folder(FILE *to, const char *path, bool hidden)
{
    struct dirent **entries;
    int count = scandir(path, &entries, is_listed, alphasort);
    for (int i = 0; i < count; i++) {
        char below[1024];
        snprintf(below, sizeof below, "%s/%s", path, entries[i]->d_name);
        if (hidden || entries[i]->d_name[0] != '.')
            add_entry(to, below, hidden);
        free(entries[i]);
    }
    if (count >= 0)
        free(entries);
}

/* Names and bytes of all that is below `path`, names that begin with a dot only where `hidden`. Malloc'd; "" where
 * there is no such folder. */
static char *folder_text(const char *path, bool hidden)
{
    char *text = NULL;
    size_t size;
    FILE *to = open_memstream(&text, &size);
    if (!to)
        abort();
    add_folder(to, path, hidden);
    fclose(to);
    return text;
}

static int remove_entry(const char *path, const struct stat *status, int kind, struct FTW *at)
{
    (void)status, (void)kind, (void)at;
    return remove(path);
}

static inline void remove_folder(const char *path)
{
    nftw(path, remove_entry, 20, FTW_DEPTH | FTW_PHYS);
}

#endif
