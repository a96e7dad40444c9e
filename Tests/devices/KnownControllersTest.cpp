#include "devices/KnownControllers.h"

#include "devices/HidList.h"
#include "support/Catch.h"

#include <cstddef>

using namespace pacini;
using namespace pacini::devices;

TEST_CASE("Controllers are known by their maker's and their product's number together", "[devices]")
{
    CHECK(controllerHaptics(0x057E, 0x2009) == ControllerHaptics::hdRumble);
    CHECK(controllerHaptics(0x054C, 0x09CC) == ControllerHaptics::dualShock4);
    CHECK(controllerHaptics(0x054C, 0x0CE6) == ControllerHaptics::dualSense);
    CHECK(controllerHaptics(0x045E, 0x0B13) == ControllerHaptics::xbox);
    CHECK(controllerHaptics(0x28DE, 0x1304) == ControllerHaptics::steamController);
    CHECK(controllerHaptics(0x28DE, 0x1205) == ControllerHaptics::steamDeck);
    CHECK_FALSE(controllerHaptics(0x28DE, 0x1102).has_value()); // that of 2015
    CHECK(transportByProduct(ControllerHaptics::steamController, 0x1302) == Transport::usb);
    CHECK(transportByProduct(ControllerHaptics::steamController, 0x1303) == Transport::bluetooth);
    CHECK(transportByProduct(ControllerHaptics::steamController, 0x1305) == Transport::receiver);
    CHECK_FALSE(transportByProduct(ControllerHaptics::dualSense, 0x0CE6).has_value());
    CHECK_FALSE(controllerHaptics(0x054C, 0x2009).has_value());
    CHECK_FALSE(controllerHaptics(0x057E, 0x2069).has_value()); // the successor speaks another language
    CHECK_FALSE(controllerHaptics(0, 0).has_value());
}

TEST_CASE("Connected controllers are listed once each, or it is said why not", "[devices]")
{
    const auto controllers = connectedControllers();
    if (!controllers)
    {
        CHECK(controllers.error().code == ErrorCode::io);
        CHECK_FALSE(controllers.error().message.empty());
        return;
    }
    for (std::size_t i = 1; i < controllers->size(); ++i)
        CHECK((*controllers)[i - 1].path < (*controllers)[i].path);
}
