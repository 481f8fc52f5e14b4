#include "mesh/file.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

bool sp_write_file(const char *path, const void *bytes, size_t size, sp_error *error)
{
    FILE *file = fopen(path, "wb");
    if (!file)
        return sp_fail(error, SP_ERROR_FILE, path, 0, 0, "cannot be written: %s", strerror(errno));
    bool written = fwrite(bytes, 1, size, file) == size;
    int cause = errno;
    if (fclose(file) != 0 && written) {
        written = false;
        cause = errno;
    }
    return written || sp_fail(error, SP_ERROR_FILE, path, 0, 0, "cannot be written: %s", strerror(cause));
}
