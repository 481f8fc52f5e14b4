/* What sprayplan-cad writes, read by the strict reader: whole, cut, changed and lying. */
#include "mesh/cad/stream.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

typedef struct {
    unsigned char bytes[4096];
    size_t size;
} text;

static void put(text *t, uint32_t kind, const void *bytes, size_t size)
{
    sp_cad_record record = {kind, (uint32_t)size};
    assert_true(t->size + sizeof record + size <= sizeof t->bytes);
    memcpy(t->bytes + t->size, &record, sizeof record);
    memcpy(t->bytes + t->size + sizeof record, bytes, size);
    t->size += sizeof record + size;
}

static void put_greeting(text *t)
{
    const uint32_t format = SP_CAD_FORMAT;
    put(t, SP_CAD_GREETING, &format, sizeof format);
}

static void put_fineness(text *t)
{
    const sp_cad_fineness fineness = {.chord = 1e-3, .angle = 0.1, .sewing = 1e-5, .sewn = 4};
    put(t, SP_CAD_FINENESS, &fineness, sizeof fineness);
}

static void put_part(text *t, double volume, const char *names, size_t size)
{
    unsigned char bytes[200];
    memcpy(bytes, &volume, sizeof volume);
    memcpy(bytes + sizeof volume, names, size);
    put(t, SP_CAD_PART, bytes, sizeof volume + size);
}

static const double corners[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
static const uint32_t faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};

/* Every kind of record; three bodies of one name, one part without triangles. */
static text whole(void)
{
    static const char path[] = "vessel\0vessel\0=>[0:1:1:3]\0agitator\0 blade\t1 \0blade";
    const double done = 0.5;
    text t = {.size = 0};
    put_greeting(&t);
    put(&t, SP_CAD_PROGRESS, &done, sizeof done);
    put_fineness(&t);
    put(&t, SP_CAD_FAULTS, "\2\0\0\0\0\0\0\0no\nsurface", 18);
    for (int i = 0; i < 3; i++) {
        put_part(&t, 1.0 / 6, path, sizeof path);
        put(&t, SP_CAD_VERTICES, corners, sizeof corners);
        put(&t, SP_CAD_TRIANGLES, faces, 2 * sizeof *faces);
        put(&t, SP_CAD_TRIANGLES, faces + 2, 2 * sizeof *faces);
        if (i == 1)
            put_part(&t, 0, "", 0);
    }
    const sp_cad_totals totals = {4, 12, 12};
    put(&t, SP_CAD_END, &totals, sizeof totals);
    return t;
}

/* Reads in pieces of that many bytes; whether all was taken. */
static bool read_text(const text *t, size_t piece, sp_cad_stream *stream, sp_soup *soup, sp_error *error)
{
    *soup = (sp_soup){0};
    *stream = sp_cad_stream_open("some.step", soup);
    for (size_t at = 0; at < t->size; at += piece) {
        size_t size = t->size - at < piece ? t->size - at : piece;
        unsigned char *own = malloc(size); /* so that a sanitizer sees what lies beyond */
        assert_non_null(own);
        memcpy(own, t->bytes + at, size);
        bool good = sp_cad_stream_take(stream, own, size, error);
        free(own);
        if (!good)
            return false;
    }
    return true;
}

static void release(sp_cad_stream *stream, sp_soup *soup)
{
    sp_cad_stream_clear(stream);
    sp_soup_clear(soup);
}

static void what_was_sent_arrives(void **state)
{
    (void)state;
    const text t = whole();
    for (size_t piece = 1; piece <= t.size; piece = 3 * piece + 1) {
        sp_cad_stream stream;
        sp_soup soup;
        sp_error error = {0};
        assert_true(read_text(&t, piece, &stream, &soup, &error));
        assert_true(stream.ended);
        assert_int_equal(soup.part_count, 3);
        assert_string_equal(soup.part_names[0], "vessel/agitator/blade 1");
        assert_string_equal(soup.part_names[1], "vessel/agitator/blade 1#2");
        assert_string_equal(soup.part_names[2], "vessel/agitator/blade 1#3");
        assert_int_equal(soup.vertex_count, 12);
        assert_int_equal(soup.triangle_count, 12);
        assert_int_equal(soup.triangles[11][2], 11);
        assert_true(stream.volumes[2] > 0.16 && stream.fineness.sewn == 4 && stream.faults == 2);
        assert_string_equal(stream.fault, "no surface");
        release(&stream, &soup);
    }
}

static void names_are_sensible(void **state)
{
    (void)state;
    static const struct {
        const char *texts;
        size_t size;
        const char *name;
    } cases[] = {
        {"", 0, "body"},
        {"\0", 2, "body"},
        {"\0lid", 5, "lid"},
        {"=>[0:1:1:3]\0lid", 16, "lid"},
        {"NAUO12\0lid", 11, "lid"},
        {"7\0lid", 6, "lid"},
        {"NAUO\0\0", 6, "NAUO"},
        {"7\0", 3, "7"},
        {"lid 2\0lid", 10, "lid 2"},
        {"  \0 lid\x01 x ", 11, "lid  x"},
        {"a\0a\0\0\0b\0b", 10, "a/b"},
        {"K\xFChler\0", 8, "K\xC3\xBChler"},
        {"no zero", 7, "no zero"},
        {"=>[0:1:1:3]\0=>[0:1]", 20, "body"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        sp_error error = {0};
        char *texts = malloc(cases[i].size + 1);
        assert_non_null(texts);
        memcpy(texts, cases[i].texts, cases[i].size);
        char *name = sp_cad_part_name(texts, cases[i].size, &error);
        assert_non_null(name);
        assert_string_equal(name, cases[i].name);
        free(name);
        free(texts);
    }
}

/* A name that looks as if it were made unique is taken too. */
static void names_stay_unique(void **state)
{
    (void)state;
    static const char *const names[] = {"a", "a#2", "a", "a", "a#2"}, *const expected[] = {"a", "a#2", "a#3", "a#4",
                                                                                           "a#2#2"};
    text t = {.size = 0};
    sp_cad_stream stream;
    sp_soup soup;
    sp_error error = {0};
    put_greeting(&t);
    put_fineness(&t);
    for (int i = 0; i < 5; i++) {
        put_part(&t, 0, names[i], strlen(names[i]));
        put(&t, SP_CAD_VERTICES, corners, sizeof corners);
        put(&t, SP_CAD_TRIANGLES, faces, sizeof *faces);
    }
    assert_true(read_text(&t, t.size, &stream, &soup, &error));
    assert_int_equal(soup.part_count, 5);
    for (int i = 0; i < 5; i++)
        assert_string_equal(soup.part_names[i], expected[i]);
    release(&stream, &soup);
}

/* Cut at each length it has not ended; with each bit of each byte changed it is taken or refused. */
static void damage_is_no_crash(void **state)
{
    (void)state;
    const text t = whole();
    for (size_t size = 0; size < t.size; size++) {
        text cut = t;
        sp_cad_stream stream;
        sp_soup soup;
        sp_error error = {0};
        cut.size = size;
        assert_true(read_text(&cut, 64, &stream, &soup, &error));
        assert_false(stream.ended);
        release(&stream, &soup);
    }
    for (size_t at = 0; at < 8 * t.size; at++) {
        text changed = t;
        sp_cad_stream stream;
        sp_soup soup;
        sp_error error = {0};
        changed.bytes[at / 8] ^= (unsigned char)(1 << at % 8);
        bool taken = read_text(&changed, t.size, &stream, &soup, &error);
        assert_true(taken == (error.kind == SP_OK));
        if (!taken)
            assert_string_equal(error.file, "some.step");
        release(&stream, &soup);
    }
}

static void refuse(const text *t, const char *what)
{
    sp_cad_stream stream;
    sp_soup soup;
    sp_error error = {0};
    if (read_text(t, t->size, &stream, &soup, &error))
        fail_msg("taken, expected \"%s\"", what);
    if (!strstr(error.message, what))
        fail_msg("%s, expected \"%s\"", error.message, what);
    assert_int_equal(error.kind, SP_ERROR_INPUT);
    release(&stream, &soup);
}

/* What follows a greeting, a fineness and a part with four vertices. */
static void refuse_after_part(uint32_t kind, const void *bytes, size_t size, const char *what)
{
    text t = {.size = 0};
    put_greeting(&t);
    put_fineness(&t);
    put_part(&t, 0, "lid", 4);
    put(&t, SP_CAD_VERTICES, corners, sizeof corners);
    put(&t, kind, bytes, size);
    refuse(&t, what);
}

static void lies_are_refused(void **state)
{
    (void)state;
    const uint32_t beyond[3] = {0, 1, 4}, format = SP_CAD_FORMAT + 1;
    const double wrong[3] = {0, NAN, 0}, far[3] = {0, 0, 1e31}, done = 2;
    const sp_cad_totals totals = {1, 4, 1};
    const sp_cad_fineness none = {.chord = NAN, .angle = 1};
    refuse_after_part(SP_CAD_TRIANGLES, beyond, sizeof beyond, "a corner that no vertex has");
    refuse_after_part(SP_CAD_TRIANGLES, beyond, 8, "another size");
    refuse_after_part(SP_CAD_TRIANGLES, beyond, 0, "another size");
    refuse_after_part(SP_CAD_VERTICES, wrong, sizeof wrong, "not finite");
    refuse_after_part(SP_CAD_VERTICES, far, sizeof far, "beyond 1e30 m");
    refuse_after_part(SP_CAD_PART, &wrong[1], sizeof wrong[1], "volume that is no number");
    refuse_after_part(SP_CAD_PROGRESS, &done, sizeof done, "progress beyond 0 to 1");
    refuse_after_part(SP_CAD_FINENESS, &none, sizeof none, "fineness twice");
    refuse_after_part(SP_CAD_END, &totals, sizeof totals, "other totals");
    refuse_after_part(SP_CAD_GREETING, &format, sizeof format, "no kind that is expected there");
    refuse_after_part(0, "", 0, "no kind that is expected there");
    refuse_after_part(77, "", 0, "no kind that is expected there");
    refuse_after_part(SP_CAD_FAILURE, "out of\x07luck", 11, "OpenCASCADE cannot read it: out of luck");
    text t = {.size = 0};
    put(&t, SP_CAD_GREETING, &format, sizeof format);
    refuse(&t, "another version");
    t.size = 0;
    put_fineness(&t);
    refuse(&t, "no kind that is expected there");
    t.size = 0;
    put_greeting(&t);
    put(&t, SP_CAD_FINENESS, &none, sizeof none);
    refuse(&t, "a chord, angle or tolerance that is none");
    t.size = 0;
    put_greeting(&t);
    put_part(&t, 0, "lid", 4);
    refuse(&t, "a part before its fineness");
    t.size = 0;
    put_greeting(&t);
    put(&t, SP_CAD_VERTICES, corners, sizeof corners);
    refuse(&t, "vertices of no part");
    t = whole();
    t.bytes[t.size++] = 0;
    refuse(&t, "more behind the last record");
}

/* A record's size is not believed before its bytes are there. */
static void what_has_not_come_takes_no_memory(void **state)
{
    (void)state;
    text t = {.size = 0};
    sp_cad_stream stream;
    sp_soup soup;
    sp_error error = {0};
    const sp_cad_record large = {SP_CAD_PART, SP_CAD_MOST_BYTES}, larger = {SP_CAD_PART, SP_CAD_MOST_BYTES + 1};
    put_greeting(&t);
    size_t before = t.size;
    memcpy(t.bytes + t.size, &large, sizeof large);
    t.size += sizeof large + 40;
    assert_true(read_text(&t, t.size, &stream, &soup, &error));
    assert_true(stream.room <= 4 * t.size);
    release(&stream, &soup);
    memcpy(t.bytes + before, &larger, sizeof larger);
    refuse(&t, "another size");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_was_sent_arrives), cmocka_unit_test(names_are_sensible),
        cmocka_unit_test(names_stay_unique),     cmocka_unit_test(damage_is_no_crash),
        cmocka_unit_test(lies_are_refused),      cmocka_unit_test(what_has_not_come_takes_no_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
