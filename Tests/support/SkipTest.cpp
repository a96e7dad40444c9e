#include "support/Skip.h"

#include "support/Catch.h"

using namespace pacini;

// Hidden from ctest: run by test_skips.py.

TEST_CASE("A test that is skipped", "[.skips]")
{
    test::skip("there is nothing to test");
}

TEST_CASE("A test that fails", "[.skips]")
{
    FAIL("as it should");
}
