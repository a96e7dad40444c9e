#pragma once

// Actuators as they are shipped.

#include "io/ProfileFile.h"
#include "support/Catch.h"
#include "support/Paths.h"

#include <string>
#include <utility>

namespace pacini::test
{

/// The profile `name` of the folder `profiles`.
inline Profile shippedProfile(const std::string& name)
{
    auto profile = readProfile(sourceFolder() / "profiles" / (name + ".json"));
    REQUIRE(profile.ok());
    return std::move(profile).value();
}

} // namespace pacini::test
