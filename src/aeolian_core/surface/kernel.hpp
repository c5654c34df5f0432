#pragma once

/// Marks a loop over plain arrays that is compiled twice and chosen at run time: with AVX2, and for the
/// baseline. Without fused multiply-add, so that the bits are the same everywhere.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define AEOLIAN_KERNEL __attribute__((target_clones("avx2", "default")))
#else
#define AEOLIAN_KERNEL
#endif

/// The same, and with AVX-512 besides. AVX-512 brings fused multiply-add: files that use it are compiled with
/// -ffp-contract=off, and with -mprefer-vector-width=512, or GCC keeps to half the width.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && __GNUC__ >= 12
#define AEOLIAN_WIDE_KERNEL __attribute__((target_clones("arch=x86-64-v4", "avx2", "default")))
#else
#define AEOLIAN_WIDE_KERNEL AEOLIAN_KERNEL
#endif

/// Marks what kernels call: it is compiled as part of each of their copies.
#define AEOLIAN_INLINE [[gnu::always_inline]] inline
