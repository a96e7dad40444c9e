#pragma once

// An actuator profile of the module: an immutable value.

#include <pacini/actuator/Profile.h>

#include <memory>
#include <utility>

namespace pacini::python
{

class ProfileHandle
{
public:
    explicit ProfileHandle(Profile profile) : content(std::make_shared<const Profile>(std::move(profile))) {}

    [[nodiscard]] const Profile& profile() const noexcept { return *content; }

private:
    std::shared_ptr<const Profile> content;
};

} // namespace pacini::python
