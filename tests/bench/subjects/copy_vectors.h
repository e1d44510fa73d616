// Copies in steps of the width in which Embree loads what is copied, whatever this program is compiled for. A load waits for a store just
// before it that was narrower, or wider and across a cache line, instead of taking its value. That costs a quarter of the speed of
// coherent rays, and it is the caller's doing, not Embree's.
#pragma once

#include <cstddef>

namespace raywise::bench {

// Single rays and hits: vectors of four.
template <class T>
[[gnu::always_inline]] inline void copy_by_four(T& to, const T& from) {
    typedef float Four __attribute__((vector_size(16), may_alias));
    static_assert(sizeof(T) % sizeof(Four) == 0 && alignof(T) % alignof(Four) == 0);
    const auto* const source = reinterpret_cast<const Four*>(&from);
    auto* const target = reinterpret_cast<Four*>(&to);
    for (std::size_t i = 0; i < sizeof(T) / sizeof(Four); ++i) target[i] = source[i];
}

// Packets of eight: vectors of eight where there are any.
#ifdef __x86_64__
template <class T>
[[gnu::target("avx"), gnu::noinline]] void copy_by_eight_avx(T& to, const T& from) {
    typedef float Eight __attribute__((vector_size(32), may_alias));
    static_assert(sizeof(T) % sizeof(Eight) == 0 && alignof(T) % alignof(Eight) == 0);
    const auto* const source = reinterpret_cast<const Eight*>(&from);
    auto* const target = reinterpret_cast<Eight*>(&to);
    for (std::size_t i = 0; i < sizeof(T) / sizeof(Eight); ++i) target[i] = source[i];
}
template <class T>
void copy_by_eight(T& to, const T& from) {
    if (__builtin_cpu_supports("avx") != 0)
        copy_by_eight_avx(to, from);
    else
        copy_by_four(to, from);
}
#else
template <class T>
void copy_by_eight(T& to, const T& from) {
    copy_by_four(to, from);
}
#endif

} // namespace raywise::bench
