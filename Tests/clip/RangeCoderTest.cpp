#include "support/Catch.h"

#include <pacini/clip/AdaptiveNumber.h>
#include <pacini/foundation/Random.h>

#include <cmath>

using namespace pacini;

TEST_CASE("Bits come back as they went in, whatever their odds", "[clip]")
{
    for (double odds : {0.0001, 0.03, 0.5, 0.9, 0.9999})
    {
        CAPTURE(odds);
        Random random(11);
        std::vector<bool> bits(20000);
        for (auto&& b : bits)
            b = random.uniform() < odds;
        RangeWriter writer;
        AdaptiveBit model;
        for (bool b : bits)
        {
            writer.bit(b, model);
            writer.bit(!b);
        }
        const auto bytes = writer.finish();
        RangeReader reader(bytes);
        AdaptiveBit readModel;
        for (bool b : bits)
        {
            REQUIRE(reader.bit(false, readModel) == b);
            REQUIRE(reader.bit(false) == !b);
        }
    }
}

TEST_CASE("Skewed bits cost what their entropy says", "[clip]")
{
    const double odds = 0.05;
    const std::size_t count = 100000;
    Random random(5);
    RangeWriter writer;
    AdaptiveBit model;
    for (std::size_t i = 0; i < count; ++i)
        writer.bit(random.uniform() < odds, model);
    const double entropy = -odds * std::log2(odds) - (1.0 - odds) * std::log2(1.0 - odds);
    const double ideal = entropy * static_cast<double>(count) / 8.0;
    const auto size = static_cast<double>(writer.finish().size());
    CHECK(size > 0.98 * ideal);
    CHECK(size < 1.05 * ideal);
}

TEST_CASE("A run of carries is propagated", "[clip]")
{
    // Long stretches of near-certain bits drive the interval's low end against its top.
    for (std::uint64_t seed = 0; seed < 200; ++seed)
    {
        Random random(seed);
        std::vector<bool> bits;
        RangeWriter writer;
        AdaptiveBit model(0.999, 60);
        for (int i = 0; i < 300; ++i)
        {
            bits.push_back(random.uniform() < 0.002 * static_cast<double>(seed % 5));
            writer.bit(bits.back(), model);
        }
        const auto bytes = writer.finish();
        RangeReader reader(bytes);
        AdaptiveBit readModel(0.999, 60);
        for (bool b : bits)
            REQUIRE(reader.bit(false, readModel) == b);
    }
}

TEST_CASE("Numbers of every size come back", "[clip]")
{
    std::vector<std::uint64_t> numbers = {0, 1, 2, 3, 4, 7, 8, 255, 256, 65535, 1000000, (std::uint64_t{1} << 40) - 2};
    Random random(2);
    for (int i = 0; i < 2000; ++i)
        numbers.push_back(random.next() >> (24 + random.next() % 40));
    RangeWriter writer;
    AdaptiveNumber model(5.0);
    AdaptiveSignedNumber signedModel(5.0);
    for (auto n : numbers)
    {
        model.code(writer, n);
        signedModel.code(writer, static_cast<std::int64_t>(n));
        signedModel.code(writer, -static_cast<std::int64_t>(n));
    }
    const auto bytes = writer.finish();
    RangeReader reader(bytes);
    AdaptiveNumber readModel(5.0);
    AdaptiveSignedNumber readSigned(5.0);
    for (auto n : numbers)
    {
        REQUIRE(readModel.code(reader, 0) == n);
        REQUIRE(readSigned.code(reader, 0) == static_cast<std::int64_t>(n));
        REQUIRE(readSigned.code(reader, 0) == -static_cast<std::int64_t>(n));
    }
}

TEST_CASE("Reading random bytes gives numbers within bounds", "[clip]")
{
    Random random(9);
    std::vector<std::byte> noise(5000);
    for (auto& b : noise)
        b = static_cast<std::byte>(random.next() & 0xFF);
    RangeReader reader(noise);
    AdaptiveNumber model;
    AdaptiveSignedNumber signedModel;
    for (int i = 0; i < 5000; ++i)
    {
        REQUIRE(model.code(reader, 0) <= (std::uint64_t{1} << 41));
        REQUIRE(std::abs(signedModel.code(reader, 0)) <= (std::int64_t{1} << 41));
    }
}
