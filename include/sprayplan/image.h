/* Images: colour maps, and files through OpenImageIO. */
#ifndef SPRAYPLAN_IMAGE_H
#define SPRAYPLAN_IMAGE_H

#include <sprayplan/error.h>

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Colour (sRGB) for a value from 0 to 1 (clamped), viridis: perceptually uniform, readable without colour vision. */
void sp_viridis(double value, uint8_t rgb[3]);

/* 8 bits a channel, row by row from the top, no padding; 3 or 4 channels. */
bool sp_image_write_png(const char *path, const uint8_t *pixels, int width, int height, int channels, sp_error *error);
/* The same in memory: malloc'd bytes, the caller frees. */
uint8_t *sp_image_encode_png(const uint8_t *pixels, int width, int height, int channels, size_t *size, sp_error *error);
/* As WebP of quality 90, RGB, for pages: a third of the bytes. malloc'd, the caller frees. */
uint8_t *sp_image_encode_webp(const uint8_t *pixels, int width, int height, size_t *size, sp_error *error);

/* One part of a multi-part OpenEXR file. */
typedef struct {
    const char *name; /* "page0", "page0-back", ... */
    int width, height;
    const float *pixels; /* [height][width][channels], rows from the top */
} sp_exr_part;
/* 32-bit floats, lossless compression; every part has the same size and channels. */
bool sp_image_write_exr(const char *path, const sp_exr_part *parts, size_t count, const char *const *channel_names,
                        int channels, sp_error *error);

/* A PNG, TIFF, OpenEXR or PFM file of one channel, or a TIFF or OpenEXR file of two. */
typedef struct {
    int width, height, channels;
    float *values; /* [height][width][channels], as stored (whole numbers over the largest of their kind), rows from the
                    * top; malloc'd, the caller frees */
} sp_image;
/* Channels are in the file's order; an OpenEXR file, which has none, names two of them as `names` does. NULL values on
 * error: the message says of the file, which it does not name, "cannot be read: ..." or "has 3 channels, expected 1";
 * larger images are refused before their pixels are read. */
sp_image sp_image_read(const char *path, int most_width, int most_height, const char *const names[2], sp_error *error);

#ifdef __cplusplus
}
#endif
#endif
