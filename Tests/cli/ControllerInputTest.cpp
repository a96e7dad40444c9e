#include "cli/ControllerInput.h"

#include "support/Catch.h"

#include <string>
#include <vector>

using namespace pacini;
using namespace pacini::cli;

namespace
{
std::vector<devices::Controller> threeControllers()
{
    using enum devices::ControllerHaptics;
    return {{"Pro Controller", hdRumble, devices::Transport::usb, "/dev/hidraw0"},
            {"Wireless Controller", dualSense, devices::Transport::bluetooth, "/dev/hidraw1"},
            {"Joy-Con (L)", hdRumble, devices::Transport::bluetooth, "/dev/hidraw2"}};
}

/// The path of the controller that is chosen, "none" or "error".
std::string chosenPath(const std::vector<devices::Controller>& connected, const std::string& named)
{
    const auto chosen = chosenController(connected, named);
    if (!chosen)
        return "error";
    return *chosen ? (*chosen)->path : "none";
}
} // namespace

TEST_CASE("A controller is named by its number, its path or a part of its name", "[cli]")
{
    const auto connected = threeControllers();
    CHECK(chosenPath(connected, "1") == "/dev/hidraw0");
    CHECK(chosenPath(connected, "3") == "/dev/hidraw2");
    CHECK(chosenPath(connected, "/dev/hidraw1") == "/dev/hidraw1");
    CHECK(chosenPath(connected, "joy") == "/dev/hidraw2");
    CHECK(chosenPath(connected, "PRO CON") == "/dev/hidraw0");
    for (const char* absent : {"0", "4", "-1", "99999999999999999999999", "xbox", "/dev/hidraw7"})
    {
        CAPTURE(absent);
        CHECK(chosenPath(connected, absent) == "none");
    }
    CHECK(chosenPath(connected, "controller") == "error"); // two of them
}

TEST_CASE("Without a name the only controller is meant", "[cli]")
{
    CHECK(chosenPath({}, "") == "none");
    CHECK(chosenPath({threeControllers()[1]}, "") == "/dev/hidraw1");
    CHECK(chosenPath(threeControllers(), "") == "error");
}

TEST_CASE("A haptic touchpad is meant when it is named, or when there is no game controller", "[cli]")
{
    const devices::Controller touchpad{"Touchpad", devices::ControllerHaptics::waveforms, devices::Transport::usb,
                                       "/dev/hidraw8"};
    const std::vector<devices::Controller> both{threeControllers()[1], touchpad};
    CHECK(chosenPath(both, "") == "/dev/hidraw1");
    CHECK(chosenPath(both, "touch") == "/dev/hidraw8");
    CHECK(chosenPath(both, "2") == "/dev/hidraw8");
    CHECK(chosenPath({touchpad}, "") == "/dev/hidraw8");
    CHECK(chosenPath({touchpad, touchpad}, "") == "error");
}
