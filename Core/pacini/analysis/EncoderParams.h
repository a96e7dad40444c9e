#pragma once

// Parameters of the encoder, without its algorithms.

#include <pacini/analysis/OnsetParams.h>
#include <pacini/clip/Clip.h>
#include <pacini/foundation/BandSpacing.h>
#include <pacini/foundation/Result.h>

#include <string>
#include <utility>
#include <vector>

namespace pacini
{

/// Parameters of the encoder.
struct EncoderParams
{
    int bands = 12;                ///< 1 to 32
    double lowFrequency = 30.0;    ///< Hz
    double highFrequency = 1000.0; ///< Hz
    BandSpacing spacing = BandSpacing::logarithmic;
    double breakpoints = 20.0; ///< at most this many per second of sound and band, all curves together
    int quantise = 6;          ///< bits of the grids, 4 to 16; see PackParams
    bool normalise = true;     ///< scale to full drive; otherwise full scale is full drive, and sounds more than 54 dB
                               ///< above it are scaled down to that
    double audible = 1.0; ///< 0 to 1: how far loudness drives what lives above the range of touch; see AudibleBlend
    OnsetParams onsets;   ///< what counts as an event; see Onset
    bool operator==(const EncoderParams&) const = default;
};

/// Checks the ranges of EncoderParams.
[[nodiscard]] inline Result<void> validate(const EncoderParams& params)
{
    const auto wrong = [](std::string where, std::string message) -> Result<void>
    {
        return Error{ErrorCode::invalidArgument, std::move(where), std::move(message)};
    };
    if (params.bands < 1 || params.bands > 32)
        return wrong("bands", "must be 1 to 32");
    if (!(params.lowFrequency >= 1.0 && params.highFrequency <= 1800.0 && params.lowFrequency < params.highFrequency))
        return wrong("frequency range", "must lie within 1 to 1800 Hz, the low end below the high end");
    if (!(params.breakpoints >= 0.5 && params.breakpoints <= 1000.0))
        return wrong("breakpoints", "must be 0.5 to 1000 per second and band");
    if (params.quantise < 4 || params.quantise > 16)
        return wrong("quantise", "must be 4 to 16 bits");
    if (!(params.audible >= 0.0 && params.audible <= 1.0))
        return wrong("audible", "must be 0 to 1");
    if (!(params.onsets.sensitivity >= 0.25 && params.onsets.sensitivity <= 4.0))
        return wrong("sensitivity", "must be 0.25 to 4");
    return {};
}

/// The parameters as a clip keeps them; the gain, which depends on the sound, comes on top.
[[nodiscard]] inline std::vector<EncoderParameter> encoderRecord(const EncoderParams& params)
{
    std::vector<EncoderParameter> record = {{"method", std::string("a2vt")},
                                            {"bands", static_cast<double>(params.bands)},
                                            {"breakpoints", params.breakpoints},
                                            {"quantise", static_cast<double>(params.quantise)}};
    const EncoderParams usual;
    if (params.lowFrequency != usual.lowFrequency)
        record.push_back({"low", params.lowFrequency});
    if (params.highFrequency != usual.highFrequency)
        record.push_back({"high", params.highFrequency});
    if (params.spacing != usual.spacing)
        record.push_back({"spacing", std::string("linear")});
    if (params.onsets.sensitivity != usual.onsets.sensitivity)
        record.push_back({"sensitivity", params.onsets.sensitivity});
    record.push_back({"audible", params.audible}); // always: clips without it are from before there was such a thing
    if (params.normalise != usual.normalise)
        record.push_back({"normalise", params.normalise});
    return record;
}

} // namespace pacini
