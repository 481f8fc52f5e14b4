/* Hashes against another implementation's. */
#include "mesh/siphash.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

/* Of the bytes 1, 2, 3, ..: CPython 3.11.7's hash() of them with PYTHONHASHSEED=0, which is a key of zeros. */
static void other_implementations_hash_the_same(void **state)
{
    (void)state;
    static const struct {
        size_t size;
        uint64_t hash;
    } known[] = {
        {1, 0x44bc103b1f8540ed},  {2, 0x1d6b299344bab347},  {7, 0xb1cd85cc334196fa},
        {8, 0x884ccc87cb0e5fb0},  {9, 0x027ed508fe95acb3},  {15, 0x75e46d4257851550},
        {16, 0xe05d12a0a4b2d063}, {17, 0x85e152444239b234}, {19, 0xb5961cd00d9119ec},
    };
    unsigned char bytes[19];
    for (size_t i = 0; i < sizeof bytes; i++)
        bytes[i] = (unsigned char)(i + 1);
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        assert_true(sp_siphash((sp_hash_key){{0, 0}}, bytes, known[i].size) == known[i].hash);
}

static void each_table_has_its_own_key(void **state)
{
    (void)state;
    sp_hash_key first = sp_hash_key_draw(), second = sp_hash_key_draw();
    assert_memory_not_equal(&first, &second, sizeof first);
    assert_true(sp_siphash(first, "lid", 3) != sp_siphash(second, "lid", 3));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(other_implementations_hash_the_same),
        cmocka_unit_test(each_table_has_its_own_key),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
