#include <sprayplan/image.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>
#include <webp/decode.h>

static char *read_all(const char *path, size_t *size)
{
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    char *bytes = malloc(1 << 20);
    *size = fread(bytes, 1, 1 << 20, file);
    fclose(file);
    return bytes;
}

static bool holds_bytes(const char *bytes, size_t size, const void *text, size_t length)
{
    for (size_t i = 0; i + length <= size; ++i)
        if (memcmp(bytes + i, text, length) == 0)
            return true;
    return false;
}

static bool holds(const char *bytes, size_t size, const char *text)
{
    return holds_bytes(bytes, size, text, strlen(text));
}

static void viridis_known_colours(void **state)
{
    (void)state;
    /* entries 0, 64, 128, 192 and 255 of the published table */
    const double where[5] = {0, 64 / 255., 128 / 255., 192 / 255., 1};
    const double expected[5][3] = {{0.267004, 0.004874, 0.329415},
                                   {0.229739, 0.322361, 0.545706},
                                   {0.127568, 0.566949, 0.550556},
                                   {0.369214, 0.788888, 0.382914},
                                   {0.993248, 0.906157, 0.143936}};
    for (int i = 0; i < 5; ++i) {
        uint8_t rgb[3];
        sp_colour_of(SP_COLOURS_VIRIDIS, where[i], rgb);
        for (int k = 0; k < 3; ++k)
            assert_true(fabs(rgb[k] - 255 * expected[i][k]) <= 2);
    }
    uint8_t low[3], high[3], clamped[3];
    sp_colour_of(SP_COLOURS_VIRIDIS, 0, low);
    sp_colour_of(SP_COLOURS_VIRIDIS, 1, high);
    sp_colour_of(SP_COLOURS_VIRIDIS, -3, clamped);
    assert_memory_equal(low, clamped, 3);
    sp_colour_of(SP_COLOURS_VIRIDIS, NAN, clamped);
    assert_memory_equal(low, clamped, 3);
    sp_colour_of(SP_COLOURS_VIRIDIS, 7, clamped);
    assert_memory_equal(high, clamped, 3);
}

static void cividis_known_colours(void **state)
{
    (void)state;
    /* entries 0, 63, 120, 191 and 255 of the published table */
    const double where[5] = {0, 63 / 255., 120 / 255., 191 / 255., 1};
    const double expected[5][3] = {{0.000000, 0.135112, 0.304751},
                                   {0.259740, 0.305120, 0.422810},
                                   {0.461616, 0.462405, 0.461969},
                                   {0.732422, 0.677364, 0.425717},
                                   {0.995737, 0.909344, 0.217772}};
    for (int i = 0; i < 5; ++i) {
        uint8_t rgb[3];
        sp_colour_of(SP_COLOURS_CIVIDIS, where[i], rgb);
        for (int k = 0; k < 3; ++k)
            assert_true(fabs(rgb[k] - 255 * expected[i][k]) <= 2);
    }
}

static void colours_grow_lighter(void **state)
{
    (void)state;
    for (int map = SP_COLOURS_VIRIDIS; map <= SP_COLOURS_CIVIDIS; ++map) {
        double before = -1;
        for (int i = 0; i <= 100; ++i) {
            uint8_t rgb[3];
            sp_colour_of((sp_colours)map, i / 100., rgb);
            double light = 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
            assert_true(light >= before);
            before = light;
        }
    }
}

static void png_in_memory_is_the_file(void **state)
{
    (void)state;
    const uint8_t pixels[2 * 3 * 3] = {255, 0, 0, 0, 255, 0, 0, 0, 255, 1, 2, 3, 4, 5, 6, 7, 8, 9};
    const char *path = BINARY_DIR "/image-test.png";
    sp_error error = {0};
    assert_true(sp_image_write_png(path, pixels, 3, 2, 3, &error));
    size_t file_size, size = 0;
    char *file = read_all(path, &file_size);
    uint8_t *bytes = sp_image_encode_png(pixels, 3, 2, 3, &size, &error);
    assert_non_null(bytes);
    assert_int_equal(size, file_size);
    assert_memory_equal(bytes, file, size);
    assert_memory_equal(bytes, "\x89PNG\r\n\x1a\n", 8);
    const uint8_t header[] = {0, 0, 0, 13, 'I', 'H', 'D', 'R', 0, 0, 0, 3, 0, 0, 0, 2, 8, 2};
    assert_memory_equal(bytes + 8, header, sizeof header);
    assert_false(holds(file, file_size, "tIME"));
    assert_false(holds(file, file_size, "tEXt"));
    free(file);
    free(bytes);
    unlink(path);
}

/* A hatch and a ramp as the page's pictures have them: hardly any channel of a pixel is off by more than a tenth. */
static void webp_keeps_a_hatch(void **state)
{
    (void)state;
    enum { EDGE = 96 };
    uint8_t pixels[EDGE * EDGE * 3];
    for (int y = 0; y < EDGE; y++)
        for (int x = 0; x < EDGE; x++) {
            const uint8_t red[3] = {196, 38, 54}, white[3] = {250, 248, 245};
            uint8_t *pixel = pixels + 3 * (y * EDGE + x);
            if (x < EDGE / 2)
                memcpy(pixel, (x + y) % 9 < 3 ? red : white, 3);
            else
                sp_colour_of(SP_COLOURS_VIRIDIS, y / (double)EDGE, pixel);
        }
    size_t size = 0, again_size = 0, off = 0;
    sp_error error = {0};
    uint8_t *bytes = sp_image_encode_webp(pixels, EDGE, EDGE, &size, &error);
    uint8_t *again = sp_image_encode_webp(pixels, EDGE, EDGE, &again_size, &error);
    assert_non_null(bytes);
    assert_int_equal(size, again_size);
    assert_memory_equal(bytes, again, size);
    int width, height;
    uint8_t *decoded = WebPDecodeRGB(bytes, size, &width, &height);
    assert_non_null(decoded);
    assert_int_equal(width, EDGE);
    assert_int_equal(height, EDGE);
    for (size_t i = 0; i < sizeof pixels; i++)
        off += abs(decoded[i] - pixels[i]) > 25;
    assert_true(off < sizeof pixels / 20);
    WebPFree(decoded);
    free(again);
    free(bytes);
    assert_null(sp_image_encode_webp(pixels, 0, 1, &size, &error));
    assert_int_equal(error.kind, SP_ERROR_ARGUMENT);
    error = (sp_error){0};
    assert_null(sp_image_encode_webp(pixels, 16384, 1, &size, &error));
    assert_int_equal(error.kind, SP_ERROR_ARGUMENT);
}

static void png_refuses_nonsense(void **state)
{
    (void)state;
    const uint8_t pixel[4] = {0};
    size_t size;
    sp_error error = {0};
    assert_null(sp_image_encode_png(pixel, 0, 1, 3, &size, &error));
    assert_int_equal(error.kind, SP_ERROR_ARGUMENT);
    error = (sp_error){0};
    assert_false(sp_image_write_png("x.png", pixel, 1, 1, 2, &error));
    assert_int_equal(error.kind, SP_ERROR_ARGUMENT);
    error = (sp_error){0};
    assert_false(sp_image_write_png(BINARY_DIR "/no/such/folder/x.png", pixel, 1, 1, 3, &error));
    assert_int_equal(error.kind, SP_ERROR_FILE);
    assert_true(error.message[0]);
}

static void exr_holds_its_parts(void **state)
{
    (void)state;
    const char *path = BINARY_DIR "/image-test.exr";
    const char *const channels[] = {"flux", "jets", "covered"};
    float first[2 * 1 * 3], second[2 * 1 * 3];
    for (int i = 0; i < 6; ++i) {
        first[i] = sinf((float)i + 1) * 12345.678f;
        second[i] = -sqrtf((float)i + 2);
    }
    const sp_exr_part parts[2] = {{"page0", 2, 1, first}, {"page0-back", 2, 1, second}};
    sp_error error = {0};
    assert_true(sp_image_write_exr(path, parts, 2, channels, 3, &error));
    size_t size, again_size;
    char *bytes = read_all(path, &size);
    const uint8_t magic[] = {0x76, 0x2f, 0x31, 0x01};
    assert_memory_equal(bytes, magic, 4);
    assert_true(bytes[5] & 0x10); /* OpenEXR file layout: bit 12 of the version field says multi-part */
    for (int i = 0; i < 3; ++i)
        assert_true(holds(bytes, size, channels[i]));
    assert_true(holds(bytes, size, "page0-back"));
    /* A block that compression would not make smaller is stored as it is: channel by channel, in the order of their
     * names. */
    const float stored_first[6] = {first[2], first[5], first[0], first[3], first[1], first[4]};
    const float stored_second[6] = {second[2], second[5], second[0], second[3], second[1], second[4]};
    assert_true(holds_bytes(bytes, size, stored_first, sizeof stored_first));
    assert_true(holds_bytes(bytes, size, stored_second, sizeof stored_second));
    sleep(1);
    assert_true(sp_image_write_exr(path, parts, 2, channels, 3, &error));
    char *again = read_all(path, &again_size);
    assert_int_equal(size, again_size);
    assert_memory_equal(bytes, again, size);
    free(bytes);
    free(again);
    unlink(path);
}

static void exr_refuses_nonsense(void **state)
{
    (void)state;
    sp_error error = {0};
    assert_false(sp_image_write_exr("x.exr", NULL, 0, NULL, 0, &error));
    assert_int_equal(error.kind, SP_ERROR_ARGUMENT);
    error = (sp_error){0};
    float pixel = 0;
    const char *const channels[] = {"a"};
    const sp_exr_part part = {"page0", 1, 1, &pixel};
    assert_false(sp_image_write_exr(BINARY_DIR "/no/such/folder/x.exr", &part, 1, channels, 1, &error));
    assert_int_equal(error.kind, SP_ERROR_FILE);
    error = (sp_error){0};
    const float row[2] = {0};
    const sp_exr_part unequal[2] = {{"page0", 1, 1, row}, {"page1", 2, 1, row}};
    assert_false(sp_image_write_exr("x.exr", unequal, 2, channels, 1, &error));
    assert_int_equal(error.kind, SP_ERROR_ARGUMENT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(viridis_known_colours), cmocka_unit_test(cividis_known_colours),
        cmocka_unit_test(colours_grow_lighter),  cmocka_unit_test(png_in_memory_is_the_file),
        cmocka_unit_test(webp_keeps_a_hatch),    cmocka_unit_test(png_refuses_nonsense),
        cmocka_unit_test(exr_holds_its_parts),   cmocka_unit_test(exr_refuses_nonsense),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
