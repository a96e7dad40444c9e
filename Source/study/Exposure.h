#pragma once

// Exposure of a person to vibration: of hand and arm (ISO 5349-1:2001), of the whole body on a seat (ISO 2631-1:1997).

#include <pacini/actuator/Profile.h>

#include <optional>
#include <span>
#include <string_view>

namespace pacini::study
{

/// What of a person vibrates.
enum class ExposedPart
{
    hand,     ///< hand and arm, by Wh
    wholeBody ///< a sitting person, along the spine, by Wk
};

/// The daily exposure A(8), m/s2, from which an employer must act, and that which nobody may pass (directive
/// 2002/44/EC, article 3).
[[nodiscard]] constexpr double actionValue(ExposedPart part) noexcept
{
    return part == ExposedPart::hand ? 2.5 : 0.5;
}

[[nodiscard]] constexpr double limitValue(ExposedPart part) noexcept
{
    return part == ExposedPart::hand ? 5.0 : 1.15;
}

/// The standard that says how exposure is weighted.
[[nodiscard]] constexpr std::string_view standardOf(ExposedPart part) noexcept
{
    return part == ExposedPart::hand ? "ISO 5349-1" : "ISO 2631-1";
}

/// The part that an actuator shakes, by the mass of the skin in its body model; none without one. Assumed: a hand with
/// its forearm weighs some 2 kg and moves only in part, and of a sitting person several kg move with the seat.
[[nodiscard]] constexpr std::optional<ExposedPart> exposedPartOf(const Profile& profile) noexcept
{
    constexpr double mostOfHand = 2.0; // kg
    if (!profile.body)
        return std::nullopt;
    return profile.body->skinMass > mostOfHand ? ExposedPart::wholeBody : ExposedPart::hand;
}

/// A(8), m/s2: the constant acceleration that would bring about in eight hours what `dose` (m2/s4 s: weighted
/// acceleration, squared, over time) did.
[[nodiscard]] double dailyExposure(double dose) noexcept;

/// The dose of an acceleration in m/s2 at a sample rate in Hz; m2/s4 s. One axis: an actuator has one. The factor of
/// the vertical axis of a seat is 1.
[[nodiscard]] double doseOf(std::span<const float> acceleration, double sampleRate, ExposedPart part);

} // namespace pacini::study
