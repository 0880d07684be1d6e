// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Put before a function with plain loops: the compiler makes three of it, for processors with
// AVX-512 (as x86-64-v4 has it), with AVX2 and with neither, and the program picks the right one
// when it starts. All give the same bits, if the file is compiled with -ffp-contract=off: products
// and sums must not be fused where the processor could. The sanitizers cannot start such programs,
// so they get one.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define SEMSLAM_SIMD_CLONES __attribute__((target_clones("arch=x86-64-v4", "avx2", "default")))
#else
#define SEMSLAM_SIMD_CLONES
#endif

// Before small functions that such clones call: inlined, they are compiled for the clone's
// processor.
#define SEMSLAM_SIMD_INLINE __attribute__((always_inline)) inline
