// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Put before a function with plain loops: the compiler makes two of it, one for processors with
// AVX2, and the program picks the right one when it starts. Both give the same bits (AVX2 alone
// does not fuse products and sums). The sanitizers cannot start such programs, so they get one.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define SEMSLAM_SIMD_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define SEMSLAM_SIMD_CLONES
#endif

// Before small functions that such clones call: inlined, they are compiled for the clone's
// processor.
#define SEMSLAM_SIMD_INLINE __attribute__((always_inline)) inline
