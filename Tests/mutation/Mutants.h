#pragma once

// What a changed program is made of: every change that mutate.py draws stands in the source beside what was there
// before, and the environment variable PACINI_MUTANT says which one is on. One build serves all of them (mutant
// schemata: Untch, Offutt and Harrold 1993). Included before all else, in the changed copy of the sources alone.

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <initializer_list>
#include <type_traits>

namespace mutants
{

inline constexpr int most = 4096;
inline std::atomic<bool> reached[most] = {}; // by what ran since it was last cleared

inline int number()
{
    static const int chosen = []
    {
        const char* text = std::getenv("PACINI_MUTANT");
        return text == nullptr ? -1 : std::atoi(text);
    }();
    return chosen;
}

/// Whether change N is on, and a note that it was asked. While compiling, never: a constant expression stays as it was.
/// N + most is the same change in what must not be known while compiling: the value of a constant.
template <int N>
constexpr bool on()
{
    if constexpr (N < most)
        if (std::is_constant_evaluated())
            return false;
    reached[N % most].store(true, std::memory_order_relaxed);
    return number() == N % most;
}

/// A literal, or another one.
template <int N, class A, class B>
constexpr std::common_type_t<A, B> either(A was, B changed)
{
    return on<N>() ? changed : was;
}

/// A condition, or what it is taken for.
template <int N, bool Forced, class T>
constexpr bool forced(T&& was)
{
    return on<N>() ? Forced : static_cast<bool>(was);
}

template <int N, bool MinIsMeant>
struct Extreme
{
    template <class T, class... Compare>
    constexpr T operator()(const T& a, const T& b, Compare... compare) const
    {
        return on<N>() != MinIsMeant ? std::min(a, b, compare...) : std::max(a, b, compare...);
    }
    template <class T>
    constexpr T operator()(std::initializer_list<T> all) const
    {
        return on<N>() != MinIsMeant ? std::min(all) : std::max(all);
    }
};

/// std::clamp, or nothing of it.
template <int N>
struct Clamp
{
    template <class T>
    constexpr T operator()(const T& x, const T& low, const T& high) const
    {
        return on<N>() ? x : std::clamp(x, low, high);
    }
};

template <int N, bool MinIsMeant>
inline constexpr Extreme<N, MinIsMeant> extreme{};
template <int N>
inline constexpr Clamp<N> clamp{};

// `a + b` becomes `a + plus<N> + b`, which groups as before: the operator and a stand-in on its left make a pair, the
// pair and the operator the result, of this operator or of the other one.
#define PACINI_MUTATED_OPERATOR(name, was, changed)                                                                    \
    template <int N>                                                                                                   \
    struct name##_t                                                                                                    \
    {                                                                                                                  \
    };                                                                                                                 \
    template <int N>                                                                                                   \
    inline constexpr name##_t<N> name{};                                                                               \
    template <int N, class A>                                                                                          \
    struct name##_pair                                                                                                 \
    {                                                                                                                  \
        const A& a;                                                                                                    \
    };                                                                                                                 \
    template <int N, class A>                                                                                          \
    constexpr name##_pair<N, A> operator was(const A& a, const name##_t<N>&)                                           \
    {                                                                                                                  \
        return {a};                                                                                                    \
    }                                                                                                                  \
    template <int N, class A, class B>                                                                                 \
    constexpr auto operator was(const name##_pair<N, A>& left, const B& b)                                             \
    {                                                                                                                  \
        return on<N>() ? left.a changed b : left.a was b;                                                              \
    }

PACINI_MUTATED_OPERATOR(plus, +, -)
PACINI_MUTATED_OPERATOR(minus, -, +)
PACINI_MUTATED_OPERATOR(times, *, /)
PACINI_MUTATED_OPERATOR(over, /, *)
PACINI_MUTATED_OPERATOR(less, <, <=)
PACINI_MUTATED_OPERATOR(lessOrEqual, <=, <)
PACINI_MUTATED_OPERATOR(greater, >, >=)
PACINI_MUTATED_OPERATOR(greaterOrEqual, >=, >)
PACINI_MUTATED_OPERATOR(equal, ==, !=)
PACINI_MUTATED_OPERATOR(unequal, !=, ==)
#undef PACINI_MUTATED_OPERATOR

} // namespace mutants
