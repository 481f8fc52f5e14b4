/* Image files: arguments are checked here, the module of OpenImageIO encodes and reads. */
#include <sprayplan/image.h>

#include "image/oiio/files.h"
#include "mesh/file.h"
#include "module/module.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const sp_image_files *files(sp_error *error)
{
    static sp_module module = {.file = "sprayplan-images.so", .name = "sp_image_module_open"};
    __typeof__(sp_image_module_open) *open = (__typeof__(open))sp_module_open(&module, error);
    return open ? open() : NULL;
}

static bool png_possible(const char *path, int width, int height, int channels, sp_error *error)
{
    if (width > 0 && height > 0 && (channels == 3 || channels == 4))
        return true;
    return sp_fail(error, SP_ERROR_ARGUMENT, path, 0, 0,
                   "a picture of %d x %d pixels and %d channels, expected at least 1 x 1 and 3 or 4 channels", width,
                   height, channels);
}

uint8_t *sp_image_encode_png(const uint8_t *pixels, int width, int height, int channels, size_t *size, sp_error *error)
{
    if (!pixels)
        return NULL;
    const sp_image_files *images = png_possible(NULL, width, height, channels, error) ? files(error) : NULL;
    return images ? images->encode_png(pixels, width, height, channels, size, error) : NULL;
}

/* OpenImageIO does not tell of all that a file's end fails to write: files are written here. */
static bool write_encoded(const char *path, uint8_t *bytes, size_t size, sp_error *error)
{
    bool written = bytes && sp_write_file(path, bytes, size, error);
    free(bytes);
    return written;
}

bool sp_image_write_png(const char *path, const uint8_t *pixels, int width, int height, int channels, sp_error *error)
{
    if (!path || !pixels)
        return false;
    size_t size = 0;
    const sp_image_files *images = png_possible(path, width, height, channels, error) ? files(error) : NULL;
    uint8_t *bytes = images ? images->encode_png(pixels, width, height, channels, &size, error) : NULL;
    return write_encoded(path, bytes, size, error);
}

bool sp_image_write_exr(const char *path, const sp_exr_part *parts, size_t count, const char *const *channel_names,
                        int channels, sp_error *error)
{
    if (count < 1 || channels < 1)
        return sp_fail(error, SP_ERROR_ARGUMENT, path, 0, 0, "an EXR file needs at least one part and one channel");
    if (!path || !parts || !channel_names)
        return false;
    for (size_t i = 0; i < count; ++i)
        if (parts[i].width < 1 || parts[i].height < 1 || parts[i].width != parts[0].width ||
            parts[i].height != parts[0].height)
            return sp_fail(error, SP_ERROR_ARGUMENT, path, 0, 0,
                           "part %s is %d x %d pixels, expected all parts to be of one size and not empty",
                           parts[i].name, parts[i].width, parts[i].height);
    size_t size = 0;
    const sp_image_files *images = files(error);
    uint8_t *bytes = images ? images->encode_exr(parts, count, channel_names, channels, &size, error) : NULL;
    return write_encoded(path, bytes, size, error);
}

/* OpenImageIO does not say why it cannot open a file. */
static bool can_be_opened(const char *path, sp_error *error)
{
    FILE *file = fopen(path, "rb");
    if (!file)
        return sp_fail(error, SP_ERROR_INPUT, path, 0, 0, "cannot be read: %s", strerror(errno));
    fclose(file);
    return true;
}

sp_image sp_image_read(const char *path, int most_width, int most_height, const char *const names[2], sp_error *error)
{
    const sp_image_files *images = path && can_be_opened(path, error) ? files(error) : NULL;
    return images ? images->read(path, most_width, most_height, names, error) : (sp_image){0};
}
