/* Which instructions the hierarchy's kernels are made of: each kernel is one source, compiled once for each set. */
#ifndef SPRAYPLAN_TRACE_INSTRUCTIONS_H
#define SPRAYPLAN_TRACE_INSTRUCTIONS_H

#include <sprayplan/trace.h>

typedef enum {
    SP_INSTRUCTIONS_PORTABLE,
    SP_INSTRUCTIONS_AVX2,   /* with FMA, BMI2 */
    SP_INSTRUCTIONS_AVX512, /* F, VL, DQ, BW */
    SP_INSTRUCTIONS_COUNT
} sp_instructions;

/* What a kernel is called for each of them, for a table by sp_instructions. Built for another processor it is the
 * portable one whatever is asked for. */
#if defined(__x86_64__) || defined(__i386__)
#define SP_KERNELS(name) {name##_portable, name##_avx2, name##_avx512}
#else
#define SP_KERNELS(name) {name##_portable, name##_portable, name##_portable}
#endif

/* Whether this build has them and this processor knows them. */
bool sp_instructions_available(sp_instructions instructions);
/* The last one available. */
sp_instructions sp_instructions_best(void);

/* Makes a tracer use these, which must be available, instead of the best ones: for tests and measurements. No answer
 * depends on it. */
void sp_tracer_use(sp_tracer *tracer, sp_instructions instructions);

#endif
