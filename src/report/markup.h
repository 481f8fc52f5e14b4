/* HTML and SVG as growing text. What comes from files goes through sp_markup_escape. */
#ifndef REPORT_MARKUP_H
#define REPORT_MARKUP_H

#include "result/growing_text.h"

#include <stdint.h>

/* Safe between tags and in quoted attributes. */
void sp_markup_escape(sp_text *text, const char *value);
/* JSON between <script> and </script>: it may hold what ends a script, as names come from strangers. */
void sp_markup_json(sp_text *text, const char *json);
/* RFC 4648, with padding. */
void sp_markup_base64(sp_text *text, const uint8_t *bytes, size_t size);
/* A dash where the value is not known. Never an exponent. */
void sp_markup_decimals(sp_text *text, double value, int decimals);
void sp_markup_significant(sp_text *text, double value, int digits);
/* "+3.2" or "−3.2" */
void sp_markup_signed(sp_text *text, double value, int decimals);

#endif
