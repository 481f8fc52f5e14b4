/* Images that are read: every format and depth, what is refused, and damage. */
#include <sprayplan/image.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#ifdef SPRAYPLAN_SANITIZE
enum { STEP = 7 };
#else
enum { STEP = 5 };
#endif

static const char path[] = BINARY_DIR "/image-read-test";
static const char *const names[2] = {"liquid", "speed"}, *const grey_name[] = {"Y"};

static void write_bytes(const void *bytes, size_t size)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

static size_t read_bytes(char *bytes, size_t room)
{
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    size_t size = fread(bytes, 1, room, file);
    fclose(file);
    return size;
}

/* A TIFF of one strip, uncompressed: its header, the pixels, then one directory. */
static void write_tiff(int width, int height, int samples, int bits, const void *pixels, size_t size)
{
    const uint32_t entries[][3] = {/* tag and type, count, value */
                                   {256 | 4 << 16, 1, (uint32_t)width},
                                   {257 | 4 << 16, 1, (uint32_t)height},
                                   {258 | 3 << 16, 1, (uint32_t)bits},
                                   {259 | 3 << 16, 1, 1},
                                   {262 | 3 << 16, 1, 1},
                                   {273 | 4 << 16, 1, 8},
                                   {277 | 3 << 16, 1, (uint32_t)samples},
                                   {278 | 4 << 16, 1, (uint32_t)height},
                                   {279 | 4 << 16, 1, (uint32_t)size}};
    const uint16_t count = sizeof entries / sizeof *entries;
    const uint32_t directory = 8 + (uint32_t)size, end = 0;
    char bytes[1000] = "II\x2a";
    memcpy(bytes + 4, &directory, 4);
    memcpy(bytes + 8, pixels, size);
    memcpy(bytes + directory, &count, 2);
    memcpy(bytes + directory + 2, entries, sizeof entries);
    memcpy(bytes + directory + 2 + sizeof entries, &end, 4);
    write_bytes(bytes, directory + 2 + sizeof entries + 4);
}

static void write_exr(const float *pixels, int width, int height, int channels, const char *const *names)
{
    const sp_exr_part part = {"pattern", width, height, pixels};
    sp_error error = {0};
    assert_true(sp_image_write_exr(path, &part, 1, names, channels, &error));
}

static void assert_reads(int width, int height, int channels, const float *expected)
{
    sp_error error = {0};
    sp_image image = sp_image_read(path, 100, 100, names, &error);
    if (!image.values)
        fail_msg("%s", error.message);
    assert_int_equal(image.width, width);
    assert_int_equal(image.height, height);
    assert_int_equal(image.channels, channels);
    for (int i = 0; i < width * height * channels; i++)
        assert_true(fabsf(image.values[i] - expected[i]) <= 1e-6f * fabsf(expected[i]));
    free(image.values);
}

static void values_are_as_stored(void **state)
{
    (void)state;
    const float pixels[6] = {0, 0.25f, 3.5f, 1e-30f, 7e20f, 1};
    write_exr(pixels, 3, 2, 1, grey_name);
    assert_reads(3, 2, 1, pixels);
    const uint8_t bytes[6] = {0, 1, 128, 254, 255, 51};
    const float shares[6] = {0, 1 / 255.f, 128 / 255.f, 254 / 255.f, 1, 0.2f};
    write_tiff(3, 2, 1, 8, bytes, sizeof bytes);
    assert_reads(3, 2, 1, shares);
    const uint16_t words[4] = {0, 1, 13107, 65535};
    const float finer[4] = {0, 1 / 65535.f, 0.2f, 1};
    write_tiff(1, 4, 1, 16, words, sizeof words);
    assert_reads(1, 4, 1, finer);
    write_exr(pixels, 3, 1, 2, names);
    assert_reads(3, 1, 2, pixels);
    write_tiff(3, 1, 2, 8, bytes, sizeof bytes);
    assert_reads(3, 1, 2, shares);
    /* a PNG of 2 x 2 pixels of 16 bits: 0, 13107, 65535, 1; its gamma of 1/2.2 is not applied */
    static const uint8_t png[] = {0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49,
                                  0x48, 0x44, 0x52, 0x00, 0x00, 0x00, 0x02, 0x00, 0x00, 0x00, 0x02, 0x10, 0x00,
                                  0x00, 0x00, 0x00, 0x07, 0x4d, 0x8e, 0xbb, 0x00, 0x00, 0x00, 0x04, 0x67, 0x41,
                                  0x4d, 0x41, 0x00, 0x00, 0xb1, 0x8f, 0x0b, 0xfc, 0x61, 0x05, 0x00, 0x00, 0x00,
                                  0x12, 0x49, 0x44, 0x41, 0x54, 0x78, 0xda, 0x63, 0x60, 0x60, 0x30, 0x36, 0x66,
                                  0xf8, 0xff, 0x9f, 0x81, 0x11, 0x00, 0x09, 0x9b, 0x02, 0x66, 0x0b, 0x77, 0x33,
                                  0x39, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};
    const float grey[4] = {0, 0.2f, 1, 1 / 65535.f};
    write_bytes(png, sizeof png);
    assert_reads(2, 2, 1, grey);
    static const char header[] = "Pf\n2 2\n-1.0\n"; /* a PFM's rows go upwards */
    const float rows[4] = {1, 2, 3, 4}, upwards[4] = {3, 4, 1, 2};
    char map[sizeof header - 1 + sizeof upwards];
    memcpy(map, header, sizeof header - 1);
    memcpy(map + sizeof header - 1, upwards, sizeof upwards);
    write_bytes(map, sizeof map);
    assert_reads(2, 2, 1, rows);
    unlink(path);
}

static void refuse(int most_width, const char *expected)
{
    sp_error error = {0};
    assert_null(sp_image_read(path, most_width, 100, names, &error).values);
    if (strncmp(error.message, expected, strlen(expected)) || strchr(error.message, '\n'))
        fail_msg("%s, expected %s", error.message, expected);
    assert_int_equal(error.kind, SP_ERROR_INPUT);
    assert_string_equal(error.file, path);
    assert_null(strstr(error.message, path)); /* which the error names beside it */
}

static void other_images_are_refused(void **state)
{
    (void)state;
    const float pixels[8] = {1, 2, 3, 4, 5, 6, 7, 8};
    const uint8_t colours[6] = {1, 2, 3, 4, 5, 6};
    sp_error error = {0};
    unlink(path);
    refuse(100, "cannot be read: No such file or directory");
    write_bytes("", 0);
    refuse(100, "cannot be read: ");
    write_bytes("what is this", 12);
    refuse(100, "cannot be read: ");
    write_exr(pixels, 2, 2, 2, (const char *const[]){"A", "Y"});
    refuse(100, "has channels Y and A, expected liquid and speed");
    write_exr(pixels, 2, 1, 3, (const char *const[]){"R", "G", "B"});
    refuse(100, "has 3 channels, expected 1 or 2");
    assert_true(sp_image_write_png(path, colours, 2, 1, 3, &error));
    refuse(100, "has 3 channels, expected 1");
    write_exr(pixels, 4, 2, 1, grey_name);
    refuse(3, "has 4 x 2 pixels, expected 1 x 1 to 3 x 100");
    const sp_exr_part parts[2] = {{"one", 2, 1, pixels}, {"two", 2, 1, pixels}};
    assert_true(sp_image_write_exr(path, parts, 2, grey_name, 1, &error));
    refuse(100, "has several images, expected one");
    unlink(path);
}

/* Bytes changed, and files cut short, at places all over: an image or an error. */
static void survive(const char *bytes, size_t size)
{
    char *damaged = malloc(size);
    assert_non_null(damaged);
    for (size_t at = 0; at < size; at += STEP) {
        for (int way = 0; way < 2; way++) {
            memcpy(damaged, bytes, size);
            damaged[at] = (char)(way ? ~damaged[at] : 0x7f);
            write_bytes(damaged, way ? size : at);
            sp_error error = {0};
            sp_image image = sp_image_read(path, 100, 100, names, &error);
            assert_true(image.values ? image.width > 0 && image.width <= 100 && image.height > 0 && image.height <= 100
                                     : error.message[0] != 0);
            free(image.values);
        }
    }
    free(damaged);
}

static void damage_is_no_crash(void **state)
{
    (void)state;
    float pixels[60];
    char bytes[4000];
    for (int i = 0; i < 60; i++)
        pixels[i] = (float)(i % 7);
    write_exr(pixels, 10, 6, 1, grey_name);
    survive(bytes, read_bytes(bytes, sizeof bytes));
    write_tiff(10, 6, 1, 32, pixels, sizeof pixels);
    survive(bytes, read_bytes(bytes, sizeof bytes));
    unlink(path);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_are_as_stored),
        cmocka_unit_test(other_images_are_refused),
        cmocka_unit_test(damage_is_no_crash),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
