// An image of one channel, read through OpenImageIO 2.4.
#include "image/oiio/files.h"

#include <OpenImageIO/imageio.h>

#include <cstdlib>
#include <cstring>
#include <exception>
#include <memory>
#include <string>

namespace
{

// With the first line of what OpenImageIO says.
bool fail_as(const char *path, const std::string &reason, sp_error *error)
{
    return sp_fail(error, SP_ERROR_FILE, path, 0, 0, "cannot be read: %s", reason.substr(0, reason.find('\n')).c_str());
}

bool is_taken(const char *format)
{
    return !std::strcmp(format, "png") || !std::strcmp(format, "tiff") || !std::strcmp(format, "openexr") ||
           !std::strcmp(format, "pnm");
}

// One flat image of one channel, all of it there and no more, and not too large.
bool is_plain(const char *path, OIIO::ImageInput *input, int most_width, int most_height, sp_error *error)
{
    const OIIO::ImageSpec &spec = input->spec();
    if (!is_taken(input->format_name()))
        return sp_fail(error, SP_ERROR_FILE, path, 0, 0, "is a %s file, expected PNG, TIFF, OpenEXR or PFM",
                       input->format_name());
    if (spec.nchannels != 1)
        return sp_fail(error, SP_ERROR_FILE, path, 0, 0, "has %d channels, expected 1", spec.nchannels);
    if (spec.width < 1 || spec.height < 1 || spec.width > most_width || spec.height > most_height)
        return sp_fail(error, SP_ERROR_FILE, path, 0, 0, "has %d x %d pixels, expected 1 x 1 to %d x %d", spec.width,
                       spec.height, most_width, most_height);
    if (spec.deep || spec.depth != 1 || spec.x != spec.full_x || spec.y != spec.full_y ||
        spec.width != spec.full_width || spec.height != spec.full_height)
        return sp_fail(error, SP_ERROR_FILE, path, 0, 0,
                       "has pixels of several depths or a window of its own, expected a plain image");
    return true;
}

float *read_pixels(const char *path, OIIO::ImageInput *input, int *width, int *height, sp_error *error)
{
    *width = input->spec().width;
    *height = input->spec().height;
    float *pixels = static_cast<float *>(std::malloc(sizeof(float) * (size_t)*width * (size_t)*height));
    if (!pixels)
        return static_cast<float *>(sp_fail_memory(error));
    if (input->read_image(0, 0, 0, 1, OIIO::TypeDesc::FLOAT, pixels) && !input->seek_subimage(1, 0))
        return pixels;
    std::free(pixels);
    if (input->has_error())
        fail_as(path, input->geterror(), error);
    else
        sp_fail(error, SP_ERROR_FILE, path, 0, 0, "has several images, expected one");
    return nullptr;
}

} // namespace

extern "C" float *sp_image_module_read(const char *path, int most_width, int most_height, int *width, int *height,
                                       sp_error *error)
try {
    std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(path);
    if (!input) {
        fail_as(path, OIIO::geterror(), error);
        return nullptr;
    }
    return is_plain(path, input.get(), most_width, most_height, error)
               ? read_pixels(path, input.get(), width, height, error)
               : nullptr;
} catch (const std::exception &exception) {
    sp_fail(error, SP_ERROR_MEMORY, path, 0, 0, "cannot be read: %s", exception.what());
    return nullptr;
}
