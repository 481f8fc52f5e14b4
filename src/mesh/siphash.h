/* Hashes of what strangers' files hold, with a key drawn for each table: no file can be made for which all fall
 * together. */
#ifndef MESH_SIPHASH_H
#define MESH_SIPHASH_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

typedef struct {
    uint64_t word[2];
} sp_hash_key;

/* Where the system has no randomness to give, a key that anyone could guess. */
sp_hash_key sp_hash_key_draw(void);

static inline uint64_t sp_rotate(uint64_t word, int bits)
{
    return word << bits | word >> (64 - bits);
}

static inline void sp_sip_round(uint64_t v[4])
{
    v[0] += v[1];
    v[2] += v[3];
    v[1] = sp_rotate(v[1], 13) ^ v[0];
    v[3] = sp_rotate(v[3], 16) ^ v[2];
    v[0] = sp_rotate(v[0], 32) + v[3];
    v[2] += v[1];
    v[1] = sp_rotate(v[1], 17) ^ v[2];
    v[3] = sp_rotate(v[3], 21) ^ v[0];
    v[2] = sp_rotate(v[2], 32);
}

static inline void sp_sip_word(uint64_t v[4], uint64_t word)
{
    v[3] ^= word;
    sp_sip_round(v);
    v[0] ^= word;
}

/* Aumasson and Bernstein, "SipHash: a fast short-input PRF", INDOCRYPT 2012, with one round a word and three at the
 * end, as hash tables commonly have it; for little-endian machines. */
static inline uint64_t sp_siphash(sp_hash_key key, const void *bytes, size_t size)
{
    uint64_t v[4] = {key.word[0] ^ 0x736f6d6570736575u, key.word[1] ^ 0x646f72616e646f6du,
                     key.word[0] ^ 0x6c7967656e657261u, key.word[1] ^ 0x7465646279746573u};
    uint64_t word, last = 0;
    size_t whole = size - size % sizeof word;
    for (size_t i = 0; i < whole; i += sizeof word) {
        memcpy(&word, (const char *)bytes + i, sizeof word);
        sp_sip_word(v, word);
    }
    if (size > whole)
        memcpy(&last, (const char *)bytes + whole, size - whole);
    sp_sip_word(v, last | (uint64_t)size << 56);
    v[2] ^= 0xff;
    for (int i = 0; i < 3; i++)
        sp_sip_round(v);
    return v[0] ^ v[1] ^ v[2] ^ v[3];
}

#endif
