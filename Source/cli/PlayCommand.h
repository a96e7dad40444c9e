#pragma once

// Subcommand that plays clips on haptic devices.

#include "cli/Command.h"
#include "cli/Interruption.h"
#include "devices/ClipRumble.h"
#include "devices/HidList.h"
#include "devices/OpenController.h"
#include "devices/RumblePlayer.h"

#include <memory>
#include <optional>
#include <string>

namespace pacini::cli
{

/// `pacini play`: a clip on a game controller or another haptic device.
class PlayCommand : public Command
{
public:
    CLI::App* declare(CLI::App& app) override;
    Exit run(Console& console) override;

private:
    struct Opened
    {
        devices::Controller controller;
        std::unique_ptr<devices::OpenController> device;
        devices::ControllerModel model;
    };

    /// Errors: those of OpenController::open() and modelOf(), with the device's name. [worker]
    [[nodiscard]] static Result<Opened> openOne(const devices::Controller& controller);

    /// What --dry-run is for.
    [[nodiscard]] Result<devices::ControllerModel> listedModel() const;

    /// What is wrong with the options.
    [[nodiscard]] std::optional<Error> usageError() const;

    /// The part of the clip that is played.
    [[nodiscard]] Result<devices::PlayRange> rangeIn(const Clip& clip) const;

    /// The controller that is meant, waited for if wanted; nothing when the user ended that.
    [[nodiscard]] Result<std::optional<Opened>> openDevice(Console& console, Interruption& interruption) const;

    Exit list(Console& console, const Clip& clip, const devices::PlayRange& range) const;
    Exit play(Console& console, const Clip& clip, const devices::PlayRange& range) const;

    std::string input;
    std::string device;
    std::string like;
    double intensity = 0.0; ///< dB
    double from = 0.0;      ///< s
    double to = -1.0;       ///< s; negative: the end
    bool loop = false;
    bool wait = false;
    bool dryRun = false;
};

} // namespace pacini::cli
