/* Factors that raise what proofs add up, so that rounding cannot make a bound false: each is more than its sums can lie
 * off. A sum of n numbers of one sign lies off by less than 1.01 n 2^-53 of itself in double precision (Higham 2002,
 * Accuracy and Stability of Numerical Algorithms, chapter 4). */
#ifndef OPTIMIZER_ROUNDING_H
#define OPTIMIZER_ROUNDING_H

#define SP_UPWARDS_TABLE (1 + 1e-12)  /* an entry of a knapsack: up to 8,900 nozzles */
#define SP_UPWARDS_TEXELS (1 + 1e-11) /* prices of a nozzle's texels: up to 89,000 of them, which candidates have not */
#define SP_UPWARDS_SETS (1 + 1e-9)    /* areas of sets of texels: up to 8.9 million */
#define SP_UPWARDS_SINGLE (1 + 1e-6)  /* of numbers in single precision, a dozen roundings each */
#define SP_UPWARDS_SUM (1 + 1e-4)   /* of a kernel, see pattern_kernels.h */

#endif
