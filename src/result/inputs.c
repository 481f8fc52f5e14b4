/* Digests of the files that were read. */
#include <sprayplan/result.h>

#include <assert.h>
#include <errno.h>
#include <sha2.h>
#include <string.h>

bool sp_file_sha256(const char *path, char sha256[SP_SHA256], sp_error *error)
{
    static_assert(SP_SHA256 == SHA256_DIGEST_STRING_LENGTH, "digits of a digest");
    if (!path)
        return false;
    return SHA256File(path, sha256) ||
           sp_fail(error, SP_ERROR_FILE, path, 0, 0, "cannot be read again for its digest: %s", strerror(errno));
}
