/* What the library asks of the module that encodes and reads images through OpenImageIO. Arguments are checked before
 * they come here; functions as in sprayplan/image.h. */
#ifndef IMAGE_OIIO_FILES_H
#define IMAGE_OIIO_FILES_H

#include <sprayplan/image.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
    uint8_t *(*encode_png)(const uint8_t *pixels, int width, int height, int channels, size_t *size, sp_error *error);
    /* As sp_image_write_exr, in memory: malloc'd bytes, the caller frees. */
    uint8_t *(*encode_exr)(const sp_exr_part *parts, size_t count, const char *const *channel_names, int channels,
                           size_t *size, sp_error *error);
    sp_image (*read)(const char *path, int most_width, int most_height, const char *const names[2], sp_error *error);
} sp_image_files;

/* The one function of the module. */
const sp_image_files *sp_image_module_open(void);

/* reader.cc */
sp_image sp_image_module_read(const char *path, int most_width, int most_height, const char *const names[2],
                              sp_error *error);

#ifdef __cplusplus
}
#endif
#endif
