#include "support/Catch.h"

#include <pacini/foundation/SizeInMemory.h>

#include <cmath>
#include <cstdint>
#include <limits>

using namespace pacini;

TEST_CASE("Counts become sizes where they fit, and never a part of themselves", "[foundation]")
{
    constexpr std::size_t most = std::numeric_limits<std::size_t>::max();
    CHECK(sizeInMemory(0) == 0);
    CHECK(sizeInMemory(-1) == 0);
    CHECK(sizeInMemory(std::numeric_limits<std::int64_t>::min()) == 0);
    CHECK(sizeInMemory(std::int64_t{123456}) == 123456);
    CHECK(sizeInMemory(most) == most);
    CHECK(sizeInMemory(std::numeric_limits<std::uint64_t>::max()) == most);
    CHECK(sizeInMemory(std::int64_t{1} << 32) == (sizeof(std::size_t) > 4 ? (std::uint64_t{1} << 32) : most));

    CHECK(sizeInMemory(0.0) == 0);
    CHECK(sizeInMemory(-1e300) == 0);
    CHECK(sizeInMemory(std::nan("")) == 0);
    CHECK(sizeInMemory(7.9) == 7);
    CHECK(sizeInMemory(4294967295.0) == 4294967295u);
    CHECK(sizeInMemory(4294967297.0) == (sizeof(std::size_t) > 4 ? std::uint64_t{4294967297u} : most));
    CHECK(sizeInMemory(1e300) == most);
    CHECK(sizeInMemory(std::numeric_limits<double>::infinity()) == most);
}
