#include "io/FileLock.h"

#include "support/Catch.h"
#include "support/TempFolder.h"

using namespace pacini;
using Outcome = FileLock::Outcome;
using IfMissing = FileLock::IfMissing;

TEST_CASE("A file is locked once, until its lock ends")
{
    const test::TempFolder folder;
    const auto file = folder / "lock";
    FileLock first;
    FileLock second;
    CHECK(second.take(file, IfMissing::leave) == Outcome::missing);
    CHECK(folder.entries() == 0);
    REQUIRE(first.take(file, IfMissing::create) == Outcome::taken);
    CHECK(first.isHeld());
    CHECK(second.take(file, IfMissing::leave) == Outcome::heldElsewhere);
    CHECK(second.take(file, IfMissing::create) == Outcome::heldElsewhere);
    CHECK_FALSE(second.isHeld());
    first.release();
    CHECK(second.take(file, IfMissing::leave) == Outcome::taken);
    {
        FileLock third;
        CHECK(third.take(file, IfMissing::leave) == Outcome::heldElsewhere);
    }
    CHECK(first.take(file, IfMissing::leave) == Outcome::heldElsewhere);
    CHECK(FileLock().take(folder / "nowhere/lock", IfMissing::create) == Outcome::missing);
}

TEST_CASE("A lock whose file was removed meanwhile does not keep others out of a new one")
{
    const test::TempFolder folder;
    const auto file = folder / "lock";
    FileLock first;
    FileLock second;
    REQUIRE(first.take(file, IfMissing::create) == Outcome::taken);
    std::filesystem::remove(file);
    CHECK(second.take(file, IfMissing::leave) == Outcome::missing);
    CHECK(second.take(file, IfMissing::create) == Outcome::taken);
}
