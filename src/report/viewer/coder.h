/* Bits in as few bytes as they surprise: a binary arithmetic coder whose models learn how likely each bit is (a
 * carryless range coder, as M. Mahoney's lpaq has it). coder.js is the other way round, operation by operation:
 * whatever is changed here is changed there. */
#ifndef REPORT_VIEWER_CODER_H
#define REPORT_VIEWER_CODER_H

#include "report/markup.h"

/* How likely a bit is set, in 65536ths off one half, and how often it was asked for. All zeros knows nothing. */
typedef struct {
    int16_t lean;
    uint8_t seen;
} sp_bit_model;

/* Whole numbers: how many bits they have, their sign, the two bits behind the first. */
typedef struct {
    sp_bit_model length[64], sign, leading[64][4];
} sp_number_model;

/* Numbers of eight bits. */
typedef struct {
    sp_bit_model bits[256];
} sp_byte_model;

/* Starts with sp_coder_start; `bytes` is the caller's to free. */
typedef struct {
    sp_text bytes;
    uint32_t low, high;
} sp_coder;

void sp_coder_start(sp_coder *coder);
/* No more is coded. */
void sp_coder_end(sp_coder *coder);

void sp_code_bit(sp_coder *coder, sp_bit_model *model, bool bit);
/* The lowest `count` bits, none of which is more likely than its opposite. */
void sp_code_plain(sp_coder *coder, uint64_t bits, int count);
void sp_code_byte(sp_coder *coder, sp_byte_model *model, uint8_t value);
/* Cheap where numbers are of like size. How many bits it has, below 64. */
int sp_code_number(sp_coder *coder, sp_number_model *model, int64_t value);

#endif
