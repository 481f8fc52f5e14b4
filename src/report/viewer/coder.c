#include "coder.h"

#define HALF 32768
#define LEAST 32 /* 65536ths: no bit is more certain */
#define MOST_SEEN 126
#define DOUBLE 52      /* bits of a number that scripts read at once */
#define AT_ONCE 16     /* plain bits */
#define WIDE 0x1000000 /* a range that is shared out among all values of so many bits */

void sp_coder_start(sp_coder *coder)
{
    *coder = (sp_coder){.high = UINT32_MAX};
}

/* What low and high begin with alike is put out. */
static void settle(sp_coder *coder)
{
    while (coder->low >> 24 == coder->high >> 24) {
        char top = (char)(coder->low >> 24);
        sp_text_append(&coder->bytes, &top, 1);
        coder->low <<= 8;
        coder->high = coder->high << 8 | 0xff;
    }
}

/* The lower part of the range, its share in 65536ths, is a set bit's. */
static void narrow(sp_coder *coder, uint32_t share, bool bit)
{
    uint32_t range = coder->high - coder->low;
    uint32_t middle = coder->low + (range >> 16) * share + ((range & 0xffff) * share >> 16);
    if (bit)
        coder->high = middle;
    else
        coder->low = middle + 1;
    settle(coder);
}

void sp_coder_end(sp_coder *coder)
{
    for (int shift = 24; shift >= 0; shift -= 8) {
        char byte = (char)(coder->high >> shift);
        sp_text_append(&coder->bytes, &byte, 1);
    }
}

void sp_code_bit(sp_coder *coder, sp_bit_model *model, bool bit)
{
    int32_t share = HALF + model->lean;
    narrow(coder, (uint32_t)share, bit);
    /* what was seen more often changes less: the mean of all, then of the latest */
    share += ((bit ? 2 * HALF : 0) - share) / (model->seen + 2);
    share = share < LEAST ? LEAST : share > 2 * HALF - LEAST ? 2 * HALF - LEAST : share;
    model->lean = (int16_t)(share - HALF);
    model->seen += model->seen < MOST_SEEN;
}

void sp_code_plain(sp_coder *coder, uint64_t bits, int count)
{
    while (count > 0) {
        uint32_t range = coder->high - coder->low;
        int taken = range < WIDE ? 1 : count < AT_ONCE ? count : AT_ONCE;
        count -= taken;
        if (taken == 1) {
            narrow(coder, HALF, bits >> count & 1);
            continue;
        }
        coder->low += (range >> taken) * (uint32_t)(bits >> count & ((1u << taken) - 1));
        coder->high = coder->low + (range >> taken) - 1;
        settle(coder);
    }
}

static void code_tree(sp_coder *coder, sp_bit_model *models, uint32_t value, int bits)
{
    uint32_t node = 1;
    while (bits-- > 0) {
        bool bit = value >> bits & 1;
        sp_code_bit(coder, &models[node], bit);
        node = 2 * node + bit;
    }
}

void sp_code_byte(sp_coder *coder, sp_byte_model *model, uint8_t value)
{
    code_tree(coder, model->bits, value, 8);
}

int sp_code_number(sp_coder *coder, sp_number_model *model, int64_t value)
{
    uint64_t size = value < 0 ? 0 - (uint64_t)value : (uint64_t)value;
    int length = 0, behind;
    while (length < 63 && size >> length)
        length++;
    code_tree(coder, model->length, (uint32_t)length, 6);
    if (!length)
        return 0;
    sp_code_bit(coder, &model->sign, value < 0);
    behind = length - 1 < 2 ? length - 1 : 2;
    code_tree(coder, model->leading[length], (uint32_t)(size >> (length - 1 - behind) & ((1u << behind) - 1)), behind);
    int rest = length - 1 - behind;
    if (length > DOUBLE) { /* a script reads it in two parts */
        sp_code_plain(coder, size >> 32, rest - 32);
        rest = 32;
    }
    sp_code_plain(coder, size, rest);
    return length;
}
