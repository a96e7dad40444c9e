#pragma once

// Figure of measured frequency responses, with their distortion and equaliser.

#include "cli/plot/Figure.h"

#include <pacini/actuator/Equalizer.h>
#include <pacini/actuator/ProfileMeasurement.h>
#include <pacini/linearize/FrequencyResponse.h>

#include <optional>
#include <string>
#include <vector>

namespace pacini::plot
{

enum class ResponseRole
{
    placement, ///< one of many, thin
    outlier,   ///< one that was left out, thin and dashed by its colour
    noise,     ///< what is measured without a signal
    measured,  ///< the result
    flattened  ///< the result with the equaliser
};

struct NamedResponse
{
    std::string name;
    FrequencyResponse response;
    ResponseRole role = ResponseRole::measured;
};

struct ResponseFigureContent
{
    std::string title;
    std::string subtitle;
    std::vector<NamedResponse> responses;
    bool absolute = true;                    ///< levels are dB re 1 m/s^2, else re an unknown acceleration
    EqualizerSections equalizer;             ///< shown in a panel of its own unless empty
    double sampleRate = 48000.0;             ///< Hz, of the equaliser
    std::optional<NamedResponse> distortion; ///< % over frequency, in a panel of its own
    std::vector<NamedResponse> harmonics;    ///< % over frequency by order, in the panel of the distortion
    std::optional<NamedResponse> groupDelay; ///< ms over frequency, in a panel of its own
    double lowFrequency = 0.0;               ///< Hz, range that is marked; 0 for none
    double highFrequency = 0.0;              ///< Hz
    std::optional<Linearity> linearity;      ///< shows level and tolerance
};

/// A panel of the responses over the frequencies that they share, one of the distortion, one of the
/// group delay, one of the equaliser.
[[nodiscard]] Figure makeResponseFigure(const ResponseFigureContent& content, const FigureStyle& style);

} // namespace pacini::plot
