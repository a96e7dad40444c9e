#pragma once

// Roles: the parts of a clip, and their levels in the mix of a play.

#include <pacini/clip/Clip.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace pacini
{

/// The parts of a clip that sound. A decoded clip is the sum of its roles, and their levels are the faders of that sum.
/// Levelling to the envelope comes before, so the level of one role does not affect another.
enum class Role
{
    tones,  ///< the bands
    events, ///< the pulses of the transients
    noise   ///< the bands of noise
};
inline constexpr std::size_t roleCount = 3;

/// One value for each role.
template <typename Value>
class PerRole
{
public:
    PerRole() = default;
    explicit PerRole(const Value& value) : values{value, value, value} {}

    [[nodiscard]] Value& operator[](Role role) noexcept { return values[static_cast<std::size_t>(role)]; }
    [[nodiscard]] const Value& operator[](Role role) const noexcept { return values[static_cast<std::size_t>(role)]; }
    [[nodiscard]] auto begin() noexcept { return values.begin(); }
    [[nodiscard]] auto end() noexcept { return values.end(); }
    [[nodiscard]] auto begin() const noexcept { return values.begin(); }
    [[nodiscard]] auto end() const noexcept { return values.end(); }
    bool operator==(const PerRole&) const = default;

private:
    std::array<Value, roleCount> values{};
};

inline constexpr std::array<Role, roleCount> allRoles{Role::tones, Role::events, Role::noise};

/// The linear level of a role in the next frames: as many values as frames, or one for all of them.
class RoleGain
{
public:
    RoleGain() = default;
    explicit RoleGain(std::span<const double> gains) noexcept : values(gains) {}

    [[nodiscard]] double at(std::size_t frame) const noexcept
    {
        return values.empty() ? 1.0 : values[values.size() > 1 ? frame : 0];
    }
    [[nodiscard]] bool steady() const noexcept { return values.size() < 2; }

    /// From frame `from` on.
    [[nodiscard]] RoleGain after(std::size_t from) const noexcept
    {
        return values.size() > 1 ? RoleGain(values.subspan(from)) : *this;
    }

private:
    std::span<const double> values; // none: 1
};
using RoleGains = PerRole<RoleGain>;

/// Returns the user-visible name of a role.
[[nodiscard]] constexpr const char* nameOf(Role role) noexcept
{
    return role == Role::tones ? "tones" : role == Role::events ? "events" : "noise";
}

/// Whether a clip has anything of a role.
[[nodiscard]] inline bool hasRole(const Clip& clip, Role role) noexcept
{
    return role == Role::tones    ? !clip.bands.empty()
           : role == Role::events ? !clip.transients.empty()
                                  : !clip.noise.empty();
}

} // namespace pacini
