#include "support/Catch.h"

#include <pacini/foundation/Result.h>

#include <memory>
#include <string>
#include <utility>

using namespace pacini;

TEST_CASE("A result is a value or an error", "[foundation]")
{
    Result<int> good(7);
    CHECK(good.ok());
    CHECK(static_cast<bool>(good));
    CHECK(good.value() == 7);
    CHECK(*good == 7);
    good.value() = 8;
    CHECK(std::as_const(good).value() == 8);
    *good = 9;
    CHECK(*std::as_const(good) == 9);

    const Result<int> bad(Error{ErrorCode::tooLarge, "bands[2]", "has too many points"});
    CHECK_FALSE(bad.ok());
    CHECK_FALSE(static_cast<bool>(bad));
    CHECK(bad.error().code == ErrorCode::tooLarge);
    CHECK(bad.error().where == "bands[2]");
    CHECK(bad.error().message == "has too many points");

    Result<std::string> text(std::string("abc"));
    CHECK(text->size() == 3);
    CHECK(std::as_const(text)->size() == 3);
    text->push_back('d');
    CHECK(std::move(text).value() == "abcd");

    Result<std::unique_ptr<int>> moved(std::make_unique<int>(4));
    const std::unique_ptr<int> taken = std::move(moved).value();
    CHECK(*taken == 4);
}

TEST_CASE("A result without a value is success or an error", "[foundation]")
{
    const Result<void> good;
    CHECK(good.ok());
    CHECK(static_cast<bool>(good));
    const Result<void> bad(Error{ErrorCode::io, "", "is not there"});
    CHECK_FALSE(bad.ok());
    CHECK_FALSE(static_cast<bool>(bad));
    CHECK(bad.error().code == ErrorCode::io);
    CHECK(bad.error().message == "is not there");
}

TEST_CASE("An error's text names the place if there is one", "[foundation]")
{
    CHECK(Error{ErrorCode::invalidData, "bands[2].time", "is not a number"}.text() == "bands[2].time: is not a number");
    CHECK(Error{ErrorCode::invalidData, "", "is not a number"}.text() == "is not a number");
    CHECK(Error{}.code == ErrorCode::invalidData);
}
