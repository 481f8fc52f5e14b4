/* What patches have, a byte each, encoded by what their neighbours on the page have. */
#ifndef REPORT_VIEWER_PATCH_CODE_H
#define REPORT_VIEWER_PATCH_CODE_H

#include "coder.h"
#include "report/layers.h"

#define SP_HINTS 16

/* Patches beside each, of lower numbers, SP_NONE where there is none. */
typedef struct {
    size_t count;
    uint32_t (*of)[3]; /* [count], above, left, above left */
} sp_neighbours;

/* For sp_neighbours_free whatever the outcome; false where memory runs out. */
bool sp_neighbours_find(sp_neighbours *neighbours, const sp_layers *layers);
void sp_neighbours_free(sp_neighbours *neighbours);

/* What is known of patches before their bytes are encoded. */
typedef struct {
    uint8_t *expected; /* [count] */
    uint8_t *hint;     /* [count], below SP_HINTS: of patches that have the same the bytes are off alike */
} sp_patch_guess;

/* What the neighbours of a patch let expect, of those that `where` is not 0 of; NULL: of all. */
uint8_t sp_patch_expected(const sp_neighbours *neighbours, const uint8_t *values, const uint8_t *where, size_t patch);
/* Of what a byte is off: 0 nothing, 1 a step, 2 a few, 3 more. */
#define SP_PATCH_SIZES 4
int sp_patch_size(uint8_t off);
/* `off` [count] becomes what each is more than expected, modulo 2^8. False where memory runs out. */
bool sp_patches_encode(const sp_neighbours *neighbours, const uint8_t *values, const sp_patch_guess *guess,
                       uint8_t *off, sp_coder *coder);

#endif
