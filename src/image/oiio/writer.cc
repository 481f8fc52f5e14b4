// Image files are written through OpenImageIO 2.4; this folder alone includes it.
#include "image/oiio/files.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <cstdlib>
#include <cstring>
#include <exception>
#include <memory>
#include <string>
#include <vector>

namespace
{

// Without a name, to memory.
bool encode(const char *path, OIIO::Filesystem::IOProxy *proxy, const uint8_t *pixels, int width, int height,
            int channels, sp_error *error)
{
    std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create("png");
    if (!output)
        return sp_fail(error, SP_ERROR_FILE, path, 0, 0, "OpenImageIO cannot write PNG: %s", OIIO::geterror().c_str());
    OIIO::ImageSpec spec(width, height, channels, OIIO::TypeDesc::UINT8);
    if (proxy && !output->set_ioproxy(proxy))
        return sp_fail(error, SP_ERROR_FILE, path, 0, 0, "OpenImageIO cannot write PNG to memory");
    if (!output->open(path ? path : "memory.png", spec) || !output->write_image(OIIO::TypeDesc::UINT8, pixels) ||
        !output->close())
        return sp_fail(error, SP_ERROR_FILE, path, 0, 0, "%s", output->geterror().c_str());
    return true;
}

std::vector<OIIO::ImageSpec> exr_specs(const sp_exr_part *parts, size_t count, const char *const *channel_names,
                                       int channels)
{
    std::vector<OIIO::ImageSpec> specs;
    for (size_t i = 0; i < count; ++i) {
        OIIO::ImageSpec spec(parts[i].width, parts[i].height, channels, OIIO::TypeDesc::FLOAT);
        spec.channelnames.assign(channel_names, channel_names + channels);
        spec.attribute("oiio:subimagename", parts[i].name);
        spec.attribute("compression", "zip");
        // OpenImageIO would put today's date, and the same results would not be the same bytes.
        spec.attribute("DateTime", "1970:01:01 00:00:00");
        specs.push_back(spec);
    }
    return specs;
}

bool write_parts(const char *path, const sp_exr_part *parts, size_t count, const char *const *channel_names,
                 int channels, sp_error *error)
{
    std::vector<OIIO::ImageSpec> specs = exr_specs(parts, count, channel_names, channels);
    std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create("openexr");
    if (!output)
        return sp_fail(error, SP_ERROR_FILE, path, 0, 0, "OpenImageIO cannot write EXR: %s", OIIO::geterror().c_str());
    bool written = output->open(path, (int)count, specs.data());
    for (size_t i = 0; written && i < count; ++i)
        written = (i == 0 || output->open(path, specs[i], OIIO::ImageOutput::AppendSubimage)) &&
                  output->write_image(OIIO::TypeDesc::FLOAT, parts[i].pixels);
    if (!written || !output->close())
        return sp_fail(error, SP_ERROR_FILE, path, 0, 0, "%s", output->geterror().c_str());
    return true;
}

bool write_png(const char *path, const uint8_t *pixels, int width, int height, int channels, sp_error *error)
try {
    return encode(path, nullptr, pixels, width, height, channels, error);
} catch (const std::exception &exception) {
    return sp_fail(error, SP_ERROR_MEMORY, path, 0, 0, "%s", exception.what());
}

uint8_t *encode_png(const uint8_t *pixels, int width, int height, int channels, size_t *size, sp_error *error)
try {
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput proxy(bytes);
    if (!encode(nullptr, &proxy, pixels, width, height, channels, error))
        return nullptr;
    uint8_t *copy = static_cast<uint8_t *>(std::malloc(bytes.size() + 1));
    if (!copy)
        return static_cast<uint8_t *>(sp_fail_memory(error));
    std::memcpy(copy, bytes.data(), bytes.size());
    *size = bytes.size();
    return copy;
} catch (const std::exception &exception) {
    sp_fail(error, SP_ERROR_MEMORY, nullptr, 0, 0, "%s", exception.what());
    return nullptr;
}

bool write_exr(const char *path, const sp_exr_part *parts, size_t count, const char *const *channel_names, int channels,
               sp_error *error)
try {
    return write_parts(path, parts, count, channel_names, channels, error);
} catch (const std::exception &exception) {
    return sp_fail(error, SP_ERROR_MEMORY, path, 0, 0, "%s", exception.what());
}

} // namespace

extern "C" __attribute__((visibility("default"))) const sp_image_files *sp_image_module_open(void)
{
    static const sp_image_files files = {write_png, encode_png, write_exr, sp_image_module_read};
    return &files;
}
