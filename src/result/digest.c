#include "result/digest.h"

#include <sprayplan/result.h>

#include <fcntl.h>
#include <sha2.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define LARGEST (16L << 20) /* bytes, of a scene */

static const char begin[] =
    "# Written by sprayplan, which replaces this file as long as the SHA-256 of all below is\n# ";

enum { LINES = sizeof begin - 1 + SP_SHA256 }; /* with the digest and the end of its line */

static void digest(const char *text, size_t size, char hexadecimal[SP_SHA256])
{
    SHA256Data((const uint8_t *)text, size, hexadecimal);
}

char *sp_digest_text(const char *text, sp_error *error)
{
    size_t size = strlen(text);
    char *sealed = malloc(LINES + size + 1);
    if (!sealed)
        return sp_fail_memory(error);
    memcpy(sealed, begin, sizeof begin - 1);
    digest(text, size, sealed + sizeof begin - 1);
    sealed[LINES - 1] = '\n';
    memcpy(sealed + LINES, text, size + 1);
    return sealed;
}

static bool is_whole(const char *text, size_t size)
{
    char hexadecimal[SP_SHA256];
    if (size < LINES || memcmp(text, begin, sizeof begin - 1) != 0)
        return false;
    digest(text + LINES, size - LINES, hexadecimal);
    return memcmp(text + sizeof begin - 1, hexadecimal, SP_SHA256 - 1) == 0 && text[LINES - 1] == '\n';
}

static sp_digest check(int file, sp_error *error)
{
    struct stat status;
    if (fstat(file, &status) != 0 || !S_ISREG(status.st_mode) || status.st_size > LARGEST)
        return SP_SEAL_BROKEN;
    size_t size = (size_t)status.st_size, used = 0;
    char *text = malloc(size + 1);
    if (!text) {
        sp_fail_memory(error);
        return SP_SEAL_UNKNOWN;
    }
    for (ssize_t more; used < size + 1 && (more = read(file, text + used, size + 1 - used)) > 0;)
        used += (size_t)more;
    bool whole = used == size && is_whole(text, size);
    free(text);
    return whole ? SP_SEAL_WHOLE : SP_SEAL_BROKEN;
}

sp_digest sp_digest_check(int folder, const char *name, sp_error *error)
{
    struct stat status;
    int file = openat(folder, name, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (file < 0)
        return fstatat(folder, name, &status, AT_SYMLINK_NOFOLLOW) == 0 ? SP_SEAL_BROKEN : SP_SEAL_ABSENT;
    sp_digest seal = check(file, error);
    close(file);
    return seal;
}

bool sp_digest_is_for(const char *name)
{
    static const char first[] = "layout", last[] = ".yaml";
    if (strncmp(name, first, sizeof first - 1) != 0)
        return false;
    name += sizeof first - 1;
    if (name[0] == '-' && name[1] >= '1' && name[1] <= '9')
        name += 1 + strspn(name + 1, "0123456789");
    return !strcmp(name, last);
}
