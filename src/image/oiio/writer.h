/* What the library asks of the module that writes images through OpenImageIO. Arguments are checked before they come
 * here; functions as in sprayplan/image.h. */
#ifndef IMAGE_OIIO_WRITER_H
#define IMAGE_OIIO_WRITER_H

#include <sprayplan/image.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
    bool (*write_png)(const char *path, const uint8_t *pixels, int width, int height, int channels, sp_error *error);
    uint8_t *(*encode_png)(const uint8_t *pixels, int width, int height, int channels, size_t *size, sp_error *error);
    bool (*write_exr)(const char *path, const sp_exr_part *parts, size_t count, const char *const *channel_names,
                      int channels, sp_error *error);
} sp_image_writer;

/* The one function of the module. */
const sp_image_writer *sp_image_module_open(void);

#ifdef __cplusplus
}
#endif
#endif
