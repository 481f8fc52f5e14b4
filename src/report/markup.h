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
/* Water in L/min, without the unit, with as many decimals as tell it; all water on the page is told by these. */
void sp_markup_water(sp_text *text, double l_min);
/* The same of what is a part of more water, or held against it: as exactly as that is told. */
void sp_markup_water_of(sp_text *text, double l_min, double whole);
/* The same of one of several in a column: as exactly as the most of them, and with two significant digits at least. */
void sp_markup_water_beside(sp_text *text, double l_min, double most);
/* "+3.2" or "−3.2" */
void sp_markup_signed(sp_text *text, double value, int decimals);

#endif
