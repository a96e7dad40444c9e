#include "io/Sha256.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace pacini
{

namespace
{
using Words = std::array<std::uint32_t, 8>;

constexpr std::array<std::uint32_t, 64> firstPrimes()
{
    std::array<std::uint32_t, 64> primes{};
    std::uint32_t candidate = 2;
    for (std::size_t found = 0; found < primes.size(); ++candidate)
    {
        bool prime = true;
        for (std::size_t i = 0; i < found; ++i)
            prime = prime && candidate % primes[i] != 0;
        if (prime)
            primes[found++] = candidate;
    }
    return primes;
}

/// The first 32 bits of the fraction of a root; long double is exact enough by far.
std::uint32_t fraction(long double root)
{
    return static_cast<std::uint32_t>((root - std::floor(root)) * 4294967296.0L);
}

struct Constants
{
    Words start{};                         ///< of the square roots of the first 8 primes
    std::array<std::uint32_t, 64> round{}; ///< of the cube roots of the first 64

    Constants()
    {
        constexpr auto primes = firstPrimes();
        for (std::size_t i = 0; i < start.size(); ++i)
            start[i] = fraction(std::sqrt(static_cast<long double>(primes[i])));
        for (std::size_t i = 0; i < round.size(); ++i)
            round[i] = fraction(std::cbrt(static_cast<long double>(primes[i])));
    }
};

const Constants& constants()
{
    static const Constants values;
    return values;
}

/// Takes in 64 bytes.
void compress(Words& hash, const char* block, const std::array<std::uint32_t, 64>& round)
{
    std::array<std::uint32_t, 64> w{};
    for (std::size_t t = 0; t < 16; ++t)
        for (std::size_t b = 0; b < 4; ++b)
            w[t] = (w[t] << 8) | static_cast<unsigned char>(block[4 * t + b]);
    for (std::size_t t = 16; t < 64; ++t)
    {
        const std::uint32_t s0 = std::rotr(w[t - 15], 7) ^ std::rotr(w[t - 15], 18) ^ (w[t - 15] >> 3);
        const std::uint32_t s1 = std::rotr(w[t - 2], 17) ^ std::rotr(w[t - 2], 19) ^ (w[t - 2] >> 10);
        w[t] = s1 + w[t - 7] + s0 + w[t - 16];
    }
    auto [a, b, c, d, e, f, g, h] = hash;
    for (std::size_t t = 0; t < 64; ++t)
    {
        const std::uint32_t choice = (e & f) ^ (~e & g);
        const std::uint32_t majority = (a & b) ^ (a & c) ^ (b & c);
        const std::uint32_t t1 = h + (std::rotr(e, 6) ^ std::rotr(e, 11) ^ std::rotr(e, 25)) + choice + round[t] + w[t];
        const std::uint32_t t2 = (std::rotr(a, 2) ^ std::rotr(a, 13) ^ std::rotr(a, 22)) + majority;
        h = g;
        g = f;
        f = e;
        e = d + t1;
        d = c;
        c = b;
        b = a;
        a = t1 + t2;
    }
    const Words more{a, b, c, d, e, f, g, h};
    for (std::size_t i = 0; i < hash.size(); ++i)
        hash[i] += more[i];
}
} // namespace

std::string sha256(std::string_view bytes)
{
    constexpr std::size_t block = 64;
    const Constants& c = constants();
    Words hash = c.start;
    std::size_t done = 0;
    for (; done + block <= bytes.size(); done += block)
        compress(hash, bytes.data() + done, c.round);
    // One bit, zeros, and the length in bits as the last eight bytes.
    std::string rest(bytes.substr(done));
    rest += static_cast<char>(0x80);
    rest.resize(rest.size() + 8 <= block ? block : 2 * block, '\0');
    for (std::size_t b = 0; b < 8; ++b)
        rest[rest.size() - 1 - b] = static_cast<char>((std::uint64_t{bytes.size()} * 8) >> (8 * b) & 0xFFu);
    for (done = 0; done < rest.size(); done += block)
        compress(hash, rest.data() + done, c.round);
    std::string text;
    for (const std::uint32_t word : hash)
        text += fmt::format("{:08x}", word);
    return text;
}

} // namespace pacini
