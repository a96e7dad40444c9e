// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Parameter values for one block.

#include "plugin/engine/ParameterTable.h"

#include <pacini/foundation/Clamp.h>
#include <pacini/realtime/TranslatorParams.h>

#include <array>
#include <cmath>
#include <cstddef>

namespace pacini::plugin
{

/// Values in the units of parameterTable.
class ParameterValues
{
public:
    ParameterValues() noexcept
    {
        for (std::size_t i = 0; i < parameterCount; ++i)
            values[i] = parameterTable[i].standard;
    }

    [[nodiscard]] double operator[](ParameterId parameter) const noexcept
    {
        return values[static_cast<std::size_t>(parameter)];
    }
    /// Limited to the parameter's range; a value that is not finite is ignored.
    void set(ParameterId parameter, double value) noexcept
    {
        const ParameterRow& row = rowOf(parameter);
        if (std::isfinite(value))
            values[static_cast<std::size_t>(parameter)] = clampTo(value, row.low, row.high);
    }
    [[nodiscard]] bool isOn(ParameterId parameter) const noexcept { return (*this)[parameter] >= 0.5; }

    /// For choices and whole numbers.
    [[nodiscard]] std::size_t index(ParameterId parameter) const noexcept
    {
        return static_cast<std::size_t>((*this)[parameter] + 0.5);
    }

    /// The translator's part. Its own bypass stays off: a bypassed plugin plays nothing to the actuator.
    [[nodiscard]] TranslatorParams translator() const noexcept
    {
        using enum ParameterId;
        TranslatorParams params;
        params.inputGain = (*this)[inputGain];
        params.intensity = (*this)[intensity];
        params.rumble = {(*this)[rumbleLevel], isOn(rumbleMute)};
        params.texture = {(*this)[textureLevel], isOn(textureMute)};
        params.transients = {(*this)[transientLevel], isOn(transientMute)};
        params.brightness = (*this)[brightness];
        params.audible = (*this)[audible];
        params.speech = (*this)[speech];
        params.transposition = (*this)[transposition];
        params.direct = (*this)[direct];
        params.attack = (*this)[attack];
        params.release = (*this)[release];
        params.transientSensitivity = (*this)[transientSensitivity];
        params.transientSharpness = (*this)[transientSharpness];
        params.gateThreshold = (*this)[gateThreshold];
        params.gateRelease = (*this)[gateRelease];
        return params;
    }

    /// The inverse of translator(); everything else stays.
    void setTranslator(const TranslatorParams& params) noexcept
    {
        using enum ParameterId;
        set(inputGain, params.inputGain);
        set(intensity, params.intensity);
        const auto setRole = [this](ParameterId level, ParameterId mute, const RoleParams& role)
        {
            set(level, role.level);
            set(mute, role.muted ? 1.0 : 0.0);
        };
        setRole(rumbleLevel, rumbleMute, params.rumble);
        setRole(textureLevel, textureMute, params.texture);
        setRole(transientLevel, transientMute, params.transients);
        set(brightness, params.brightness);
        set(audible, params.audible);
        set(speech, params.speech);
        set(transposition, params.transposition);
        set(direct, params.direct);
        set(attack, params.attack);
        set(release, params.release);
        set(transientSensitivity, params.transientSensitivity);
        set(transientSharpness, params.transientSharpness);
        set(gateThreshold, params.gateThreshold);
        set(gateRelease, params.gateRelease);
    }

    bool operator==(const ParameterValues&) const = default;

private:
    std::array<double, parameterCount> values{};
};

} // namespace pacini::plugin
