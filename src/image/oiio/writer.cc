// Images are encoded through OpenImageIO 2.4; this folder alone includes it.
#include "image/oiio/files.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <memory>
#include <string>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>
#include <vector>

namespace
{

typedef std::vector<unsigned char> encoded;

bool encode(encoded &bytes, const uint8_t *pixels, int width, int height, int channels, sp_error *error)
{
    OIIO::Filesystem::IOVecOutput proxy(bytes);
    std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create("png");
    if (!output)
        return sp_fail(error, SP_ERROR_FILE, nullptr, 0, 0, "OpenImageIO cannot write PNG: %s",
                       OIIO::geterror().c_str());
    OIIO::ImageSpec spec(width, height, channels, OIIO::TypeDesc::UINT8);
    if (!output->set_ioproxy(&proxy) || !output->open("memory.png", spec) ||
        !output->write_image(OIIO::TypeDesc::UINT8, pixels) || !output->close())
        return sp_fail(error, SP_ERROR_FILE, nullptr, 0, 0, "PNG in memory: %s", output->geterror().c_str());
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

// OpenImageIO 2.4 writes files of several parts to names alone: this one is a name of memory.
struct memory_file {
    int descriptor = memfd_create("sprayplan", MFD_CLOEXEC);
    std::string name = "/proc/self/fd/" + std::to_string(descriptor);
    ~memory_file()
    {
        if (descriptor >= 0)
            close(descriptor);
    }
};

bool read_back(const memory_file &file, encoded &bytes, sp_error *error)
{
    struct stat status;
    if (fstat(file.descriptor, &status) != 0)
        return sp_fail(error, SP_ERROR_FILE, nullptr, 0, 0, "EXR in memory: %s", std::strerror(errno));
    bytes.resize((size_t)status.st_size);
    for (size_t done = 0; done < bytes.size();) {
        ssize_t more = pread(file.descriptor, bytes.data() + done, bytes.size() - done, (off_t)done);
        if (more <= 0)
            return sp_fail(error, SP_ERROR_FILE, nullptr, 0, 0, "EXR in memory: %s", std::strerror(errno));
        done += (size_t)more;
    }
    return true;
}

bool encode_parts(encoded &bytes, const sp_exr_part *parts, size_t count, const char *const *channel_names,
                  int channels, sp_error *error)
{
    memory_file file;
    std::vector<OIIO::ImageSpec> specs = exr_specs(parts, count, channel_names, channels);
    std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create("openexr");
    if (!output || file.descriptor < 0)
        return sp_fail(error, SP_ERROR_FILE, nullptr, 0, 0, "OpenImageIO cannot write EXR: %s",
                       output ? std::strerror(errno) : OIIO::geterror().c_str());
    bool written = output->open(file.name, (int)count, specs.data());
    for (size_t i = 0; written && i < count; ++i)
        written = (i == 0 || output->open(file.name, specs[i], OIIO::ImageOutput::AppendSubimage)) &&
                  output->write_image(OIIO::TypeDesc::FLOAT, parts[i].pixels);
    if (!written || !output->close())
        return sp_fail(error, SP_ERROR_FILE, nullptr, 0, 0, "EXR in memory: %s", output->geterror().c_str());
    return read_back(file, bytes, error);
}

// Malloc'd.
uint8_t *copy_of(const encoded &bytes, size_t *size, sp_error *error)
{
    uint8_t *copy = static_cast<uint8_t *>(std::malloc(bytes.size() + 1));
    if (!copy)
        return static_cast<uint8_t *>(sp_fail_memory(error));
    std::memcpy(copy, bytes.data(), bytes.size());
    *size = bytes.size();
    return copy;
}

uint8_t *encode_png(const uint8_t *pixels, int width, int height, int channels, size_t *size, sp_error *error)
try {
    encoded bytes;
    return encode(bytes, pixels, width, height, channels, error) ? copy_of(bytes, size, error) : nullptr;
} catch (const std::exception &exception) {
    sp_fail(error, SP_ERROR_MEMORY, nullptr, 0, 0, "%s", exception.what());
    return nullptr;
}

uint8_t *encode_exr(const sp_exr_part *parts, size_t count, const char *const *channel_names, int channels,
                    size_t *size, sp_error *error)
try {
    encoded bytes;
    return encode_parts(bytes, parts, count, channel_names, channels, error) ? copy_of(bytes, size, error) : nullptr;
} catch (const std::exception &exception) {
    sp_fail(error, SP_ERROR_MEMORY, nullptr, 0, 0, "%s", exception.what());
    return nullptr;
}

} // namespace

extern "C" __attribute__((visibility("default"))) const sp_image_files *sp_image_module_open(void)
{
    static const sp_image_files files = {encode_png, encode_exr, sp_image_module_read};
    return &files;
}
