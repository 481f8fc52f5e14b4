#include "mesh/weld.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

static bool equal(sp_vec3 a, sp_vec3 b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

uint32_t *sp_weld_slot(const sp_weld_table *table, const sp_vec3 *vertices, sp_vec3 point)
{
    assert(table->size && (table->size & (table->size - 1)) == 0);
    size_t mask = table->size - 1, slot = sp_siphash(table->key, &point, sizeof point) & mask;
    while (table->slots[slot] != SP_NONE && !equal(vertices[table->slots[slot]], point))
        slot = (slot + 1) & mask;
    return &table->slots[slot];
}

bool sp_weld_reserve(sp_weld_table *table, size_t capacity, const sp_vec3 *vertices, size_t count)
{
    size_t size = 16;
    if (2 * capacity <= table->size)
        return true;
    while (size < 2 * capacity)
        size *= 2;
    if (!table->size)
        table->key = sp_hash_key_draw();
    free(table->slots);
    table->slots = malloc(size * sizeof *table->slots);
    table->size = table->slots ? size : 0;
    if (!table->slots)
        return false;
    memset(table->slots, 0xFF, size * sizeof *table->slots);
    assert(count <= capacity); /* a search ends at a free slot */
    for (size_t i = 0; i < count; i++)
        *sp_weld_slot(table, vertices, vertices[i]) = (uint32_t)i;
    return true;
}
