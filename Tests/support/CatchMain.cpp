#include "support/Skip.h"

#include <iostream>

#if !defined(PACINI_CATCH_3)
#define CATCH_CONFIG_RUNNER
#include <catch2/catch.hpp>
#else
#include <catch2/catch_session.hpp>
#endif

namespace
{
constexpr int exitSkipped = 77; // SKIP_RETURN_CODE of all tests
int skipped = 0;
} // namespace

void pacini::test::skip(std::string_view why)
{
    std::cout << "SKIPPED: " << why << std::endl;
    ++skipped;
}

int main(int argc, char** argv)
{
    const int failures = Catch::Session().run(argc, argv);
    if (failures != 0)
        return 1; // not their number, which may be that of a skipped test
    return skipped > 0 ? exitSkipped : 0;
}
