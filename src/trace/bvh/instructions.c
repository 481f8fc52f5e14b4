#include "trace/bvh/instructions.h"

#if defined(__x86_64__) || defined(__i386__)

bool sp_instructions_available(sp_instructions instructions)
{
    if (instructions == SP_INSTRUCTIONS_PORTABLE)
        return true;
    if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma") || !__builtin_cpu_supports("bmi2"))
        return false;
    return instructions == SP_INSTRUCTIONS_AVX2 ||
           (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
            __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw"));
}

#else

bool sp_instructions_available(sp_instructions instructions)
{
    return instructions == SP_INSTRUCTIONS_PORTABLE;
}

#endif

sp_instructions sp_instructions_best(void)
{
    int best = SP_INSTRUCTIONS_COUNT - 1;
    while (!sp_instructions_available((sp_instructions)best))
        best--;
    return (sp_instructions)best;
}
