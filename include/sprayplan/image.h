/* Images: colour maps, and files through OpenImageIO. */
#ifndef SPRAYPLAN_IMAGE_H
#define SPRAYPLAN_IMAGE_H

#include <sprayplan/error.h>
#include <sprayplan/export.h>

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Perceptually uniform maps, readable without colour vision; cividis looks nearly the same without red or green. */
typedef enum { SP_COLOURS_VIRIDIS, SP_COLOURS_CIVIDIS } sp_colours;
/* Colour (sRGB) for a value from 0 to 1 (clamped; not a number: 0). */
SP_API void sp_colour_of(sp_colours colours, double value, uint8_t rgb[3]);

/* What pictures and model show. All zeros: liquid flux, on a logarithmic scale, in viridis. */
typedef enum {
    SP_QUANTITY_FLUX,
    SP_QUANTITY_SPEED,
    SP_QUANTITY_SPEED_MAX,
    SP_QUANTITY_INCIDENCE,
    SP_QUANTITY_INCIDENCE_MIN,
    SP_QUANTITY_IMPACT,
    SP_QUANTITY_IMPACT_MAX,
    SP_QUANTITY_JETS,
    SP_QUANTITY_COVERED, /* share of a patch that is */
    SP_QUANTITY_CHARTS,  /* of the atlas, each in a colour unlike its neighbours' */
    SP_QUANTITIES,
} sp_quantity;
typedef enum {
    SP_SHADES_AUTO, /* logarithmic of flux, impact and jets, else linear */
    SP_SHADES_LINEAR,
    SP_SHADES_LOG,
    SP_SHADES_STEPPED, /* two colours, parted where the criterion is met; as AUTO where it does not ask */
} sp_shades;
typedef struct {
    sp_quantity quantity;
    sp_shades shades;
    sp_colours colours;
    bool wireframe; /* pictures show the edges of all triangles */
} sp_picture_style;

/* 8 bits a channel, row by row from the top, no padding; 3 or 4 channels. */
SP_API bool sp_image_write_png(const char *path, const uint8_t *pixels, int width, int height, int channels,
                               sp_error *error);
/* The same in memory: malloc'd bytes, the caller frees. */
SP_API uint8_t *sp_image_encode_png(const uint8_t *pixels, int width, int height, int channels, size_t *size,
                                    sp_error *error);
/* As WebP of quality 90, RGB, for pages: a third of the bytes. malloc'd, the caller frees. */
SP_API uint8_t *sp_image_encode_webp(const uint8_t *pixels, int width, int height, size_t *size, sp_error *error);

/* One part of a multi-part OpenEXR file. */
typedef struct {
    const char *name; /* "page0", "page0-back", ... */
    int width, height;
    const float *pixels; /* [height][width][channels], rows from the top */
} sp_exr_part;
/* 32-bit floats, lossless compression; every part has the same size and channels. */
SP_API bool sp_image_write_exr(const char *path, const sp_exr_part *parts, size_t count,
                               const char *const *channel_names, int channels, sp_error *error);

/* A PNG, TIFF, OpenEXR or PFM file of one channel, or a TIFF or OpenEXR file of two. */
typedef struct {
    int width, height, channels;
    float *values; /* [height][width][channels], as stored (whole numbers over the largest of their kind), rows from the
                    * top; malloc'd, the caller frees */
} sp_image;
/* Channels are in the file's order; an OpenEXR file, which has none, names two of them as `names` does. NULL values on
 * error: the message says of the file, which it does not name, "cannot be read: ..." or "has 3 channels, expected 1";
 * larger images are refused before their pixels are read. */
SP_API sp_image sp_image_read(const char *path, int most_width, int most_height, const char *const names[2],
                              sp_error *error);

#ifdef __cplusplus
}
#endif
#endif
