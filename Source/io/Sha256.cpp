#include "io/Sha256.h"

#include "io/InputFile.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>

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

Sha256::Sha256() : hash(constants().start) {}

void Sha256::add(std::string_view bytes)
{
    constexpr std::size_t block = 64;
    const Constants& c = constants();
    size += bytes.size();
    if (!rest.empty())
    {
        const std::size_t missing = std::min(block - rest.size(), bytes.size());
        rest += bytes.substr(0, missing);
        bytes.remove_prefix(missing);
        if (rest.size() < block)
            return;
        compress(hash, rest.data(), c.round);
        rest.clear();
    }
    for (; bytes.size() >= block; bytes.remove_prefix(block))
        compress(hash, bytes.data(), c.round);
    rest = bytes;
}

std::string Sha256::text()
{
    // One bit, zeros until eight bytes of a block are left, and the length in bits as those.
    const std::uint64_t bits = size * 8;
    std::string end(1, static_cast<char>(0x80));
    end.resize(1 + (119 - rest.size()) % 64, '\0');
    for (int shift = 56; shift >= 0; shift -= 8)
        end += static_cast<char>(bits >> shift & 0xFFu);
    add(end);
    std::string digits;
    for (const std::uint32_t word : hash)
        digits += fmt::format("{:08x}", word);
    return digits;
}

std::string sha256(std::string_view bytes)
{
    Sha256 whole;
    whole.add(bytes);
    return whole.text();
}

Result<FileHash> hashOfFile(const std::filesystem::path& path)
{
    const auto file = openForReading(path);
    if (!file)
        return file.error();
    Sha256 whole;
    FileHash found;
    std::string part(std::size_t(1) << 16, '\0');
    while (const std::size_t got = std::fread(part.data(), 1, part.size(), file->get()))
    {
        whole.add(std::string_view(part).substr(0, got));
        found.bytes += got;
    }
    if (std::ferror(file->get()) != 0)
        return fileError(errno);
    found.sha256 = whole.text();
    return found;
}

} // namespace pacini
