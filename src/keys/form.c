/* What a value looks like in words, for errors and help. */
#include "keys/blocks.h"

#include <stdio.h>
#include <string.h>

static void append(char form[SP_KEY_FORM], const char *more)
{
    size_t used = strlen(form);
    snprintf(form + used, SP_KEY_FORM - used, "%s", more);
}

void sp_words_form(const char *const *words, char form[SP_KEY_FORM])
{
    form[0] = '\0';
    for (int i = 0; words[i]; i++) {
        append(form, !i ? "" : words[i + 1] ? ", " : " or ");
        append(form, words[i]);
    }
}

void sp_quantity_form(const sp_key *key, char form[SP_KEY_FORM])
{
    const sp_dimension *dimension = key->dimension;
    sp_range range = key->range;
    bool angle = dimension == &sp_angle_unit;
    double scale = angle ? 180 / M_PI : 1;
    const char *unit = angle ? " deg" : dimension == &sp_length_unit && isfinite(range.high) ? " m" : "";
    char limits[80] = "";
    if (isfinite(range.low) && isfinite(range.high))
        snprintf(limits, sizeof limits, " %s %g to %s%g%s", range.low_out ? "above" : "from", range.low * scale,
                 range.high_out ? "below " : "", range.high * scale, unit);
    else if (isfinite(range.low))
        snprintf(limits, sizeof limits, range.low_out ? " above %g%s" : " of at least %g%s", range.low * scale, unit);
    snprintf(form, SP_KEY_FORM, "%s%s such as %s", dimension->name, limits, dimension->example);
}

static void count_form(const sp_key *key, char form[SP_KEY_FORM])
{
    if (isfinite(key->range.high))
        snprintf(form, SP_KEY_FORM, "a whole number from %.15g to %.15g", key->range.low, key->range.high);
    else
        snprintf(form, SP_KEY_FORM, "a whole number");
}

/* Of the kinds that stand for themselves. */
static const char *plain_form(sp_key_kind kind)
{
    switch (kind) {
    case SP_KEY_DIRECTION:
        return "a direction such as [0, 0, -1]";
    case SP_KEY_FLAG:
        return "true or false";
    case SP_KEY_TEXT:
        return "a text";
    case SP_KEY_TEXTS:
        return "a list of texts";
    case SP_KEY_BLOCKS:
        return "a list of blocks";
    case SP_KEY_NAMED_BLOCKS:
        return "a list of names or blocks";
    case SP_KEY_NUMBER:
        return "a number";
    case SP_KEY_NUMBERS:
        return "a list of numbers";
    case SP_KEY_FILE:
        return "a file";
    default:
        return "a block";
    }
}

static void value_form(const sp_key *key, char form[SP_KEY_FORM])
{
    switch (key->kind) {
    case SP_KEY_QUANTITY:
    case SP_KEY_QUANTITIES:
        sp_quantity_form(key, form);
        append(form, key->kind == SP_KEY_QUANTITIES ? ", or a list of them" : "");
        break;
    case SP_KEY_LIMITS:
        snprintf(form, SP_KEY_FORM, "[least, most], each %s such as %s", key->dimension->name, key->dimension->example);
        break;
    case SP_KEY_VECTOR:
        snprintf(form, SP_KEY_FORM, "[x, y, z], each %s such as %s", key->dimension->name, key->dimension->example);
        break;
    case SP_KEY_COUNT:
        count_form(key, form);
        break;
    case SP_KEY_COUNTS:
        snprintf(form, SP_KEY_FORM, "two whole numbers from %g to %g", key->range.low, key->range.high);
        break;
    case SP_KEY_CHOICE:
        sp_words_form(key->words, form);
        break;
    default:
        snprintf(form, SP_KEY_FORM, "%s", plain_form(key->kind));
    }
}

void sp_key_form(const sp_key *key, char form[SP_KEY_FORM])
{
    char words[SP_KEY_FORM];
    value_form(key, form);
    if (!key->words || key->kind == SP_KEY_CHOICE)
        return;
    sp_words_form(key->words, words);
    append(form, ", or ");
    append(form, words);
}
