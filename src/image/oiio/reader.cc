// An image of one channel or two, read through OpenImageIO 2.4.
#include "image/oiio/files.h"

#include <OpenImageIO/imageio.h>

#include <cstdlib>
#include <cstring>
#include <exception>
#include <memory>
#include <string>

namespace
{

// With the first line of what OpenImageIO says, less the file's name, which stands in the error by itself.
bool fail_as(const char *path, const std::string &reason, sp_error *error)
{
    std::string line = reason.substr(0, reason.find('\n'));
    const std::string quoted = '"' + std::string(path) + '"', leading = std::string(path) + ": ";
    size_t at = line.find(quoted);
    if (at != std::string::npos)
        line.replace(at, quoted.size(), "it");
    at = line.find(leading);
    if (at != std::string::npos)
        line.erase(at, leading.size());
    return sp_fail(error, SP_ERROR_INPUT, path, 0, 0, "cannot be read: %s", line.c_str());
}

bool is_taken(const char *format)
{
    return !std::strcmp(format, "png") || !std::strcmp(format, "tiff") || !std::strcmp(format, "openexr") ||
           !std::strcmp(format, "pnm");
}

// One channel, or two where a second is no transparency; where channels have no order, by these names.
bool has_channels(const char *path, OIIO::ImageInput *input, const char *const names[2], sp_error *error)
{
    const OIIO::ImageSpec &spec = input->spec();
    bool exr = !std::strcmp(input->format_name(), "openexr"), two = exr || !std::strcmp(input->format_name(), "tiff");
    if (spec.nchannels < 1 || spec.nchannels > (two ? 2 : 1))
        return sp_fail(error, SP_ERROR_INPUT, path, 0, 0, "has %d channels, expected %s", spec.nchannels,
                       two ? "1 or 2" : "1");
    if (exr && spec.nchannels == 2 && (spec.channelnames[0] != names[0] || spec.channelnames[1] != names[1]))
        return sp_fail(error, SP_ERROR_INPUT, path, 0, 0, "has channels %.40s and %.40s, expected %s and %s",
                       spec.channelnames[0].c_str(), spec.channelnames[1].c_str(), names[0], names[1]);
    return true;
}

// One flat image, all of it there and no more, and not too large.
bool is_plain(const char *path, OIIO::ImageInput *input, int most_width, int most_height, sp_error *error)
{
    const OIIO::ImageSpec &spec = input->spec();
    if (!is_taken(input->format_name()))
        return sp_fail(error, SP_ERROR_INPUT, path, 0, 0, "is a %s file, expected PNG, TIFF, OpenEXR or PFM",
                       input->format_name());
    if (spec.width < 1 || spec.height < 1 || spec.width > most_width || spec.height > most_height)
        return sp_fail(error, SP_ERROR_INPUT, path, 0, 0, "has %d x %d pixels, expected 1 x 1 to %d x %d", spec.width,
                       spec.height, most_width, most_height);
    if (spec.deep || spec.depth != 1 || spec.x != spec.full_x || spec.y != spec.full_y ||
        spec.width != spec.full_width || spec.height != spec.full_height)
        return sp_fail(error, SP_ERROR_INPUT, path, 0, 0,
                       "has pixels of several depths or a window of its own, expected a plain image");
    return true;
}

sp_image read_pixels(const char *path, OIIO::ImageInput *input, sp_error *error)
{
    const OIIO::ImageSpec &spec = input->spec();
    sp_image image = {spec.width, spec.height, spec.nchannels, nullptr};
    size_t count = (size_t)image.width * (size_t)image.height * (size_t)image.channels;
    image.values = static_cast<float *>(std::malloc(sizeof(float) * count));
    if (!image.values) {
        sp_fail_memory(error);
        return image;
    }
    if (input->read_image(0, 0, 0, image.channels, OIIO::TypeDesc::FLOAT, image.values) && !input->seek_subimage(1, 0))
        return image;
    std::free(image.values);
    image.values = nullptr;
    if (input->has_error())
        fail_as(path, input->geterror(), error);
    else
        sp_fail(error, SP_ERROR_INPUT, path, 0, 0, "has several images, expected one");
    return image;
}

} // namespace

extern "C" sp_image sp_image_module_read(const char *path, int most_width, int most_height, const char *const names[2],
                                         sp_error *error)
try {
    OIIO::ImageSpec as_stored; // a second channel that looks like a transparency does not scale the first
    as_stored.attribute("oiio:UnassociatedAlpha", 1);
    std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(path, &as_stored);
    if (!input) {
        fail_as(path, OIIO::geterror(), error);
        return {};
    }
    return is_plain(path, input.get(), most_width, most_height, error) && has_channels(path, input.get(), names, error)
               ? read_pixels(path, input.get(), error)
               : sp_image{};
} catch (const std::exception &exception) {
    sp_fail(error, SP_ERROR_MEMORY, path, 0, 0, "cannot be read: %s", exception.what());
    return {};
}
