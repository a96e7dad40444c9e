#pragma once

// The actuators that a preview plays on.

#include "document/RowPlaces.h"

#include <pacini/actuator/Profile.h>
#include <pacini/actuator/Strength.h>
#include <pacini/synthesis/Scene.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

namespace pacini
{

struct PreviewRow
{
    static constexpr std::size_t most = 8;

    /// One for each output, 1 to 8; null: the plain drive signal.
    std::vector<std::shared_ptr<const Profile>> profiles{nullptr};
    std::vector<double> places;         ///< 0 to 1, of each; empty: spread evenly in their order
    std::optional<PanLaw> pan;          ///< how the position counts; none: all play everything
    double strength = standardStrength; ///< see fitActuator()
    bool operator==(const PreviewRow&) const = default;

    [[nodiscard]] RowPlaces rowPlaces() const noexcept
    {
        return places.size() == profiles.size() ? RowPlaces(places) : RowPlaces::even(profiles.size());
    }
};

/// Meter readings of an output.
struct PreviewMeters
{
    double peak = 0.0;          ///< of the drive signal, 1 = full drive
    double gainReduction = 0.0; ///< dB that the protection of any output takes at most
};

} // namespace pacini
