/* How much memory is held, by our own code and the libraries it calls. */
#ifndef TESTS_FUZZ_METER_H
#define TESTS_FUZZ_METER_H

#include <stddef.h>

void meter_start(void);
/* The most since the start, beyond what was held then, in bytes; 0 under the address sanitizer, which has its own
 * allocator. */
size_t meter_peak(void);

#endif
