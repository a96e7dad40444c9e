#pragma once

// Data model of an HJIF file: the entries that make a signal.

#include <pacini/foundation/Result.h>

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <vector>

namespace pacini
{

struct HjifKeyframe
{
    double position = 0.0; ///< ticks from the effect
    std::optional<double> amplitude;
    std::optional<double> frequency; ///< Hz
};

struct HjifEffect
{
    std::string type;
    double position = 0.0; ///< ticks
    std::optional<double> id, phase;
    std::string baseSignal = "Sine";
    std::optional<std::string> stream; ///< of a block of wavelet coefficients
    std::vector<HjifKeyframe> keyframes;
};

struct HjifBand
{
    std::string type;
    std::string curve;                 ///< how a waveform goes through its keyframes
    double low = 0.0, high = 0.0;      ///< Hz; of a WaveletWave band `high` is the sample rate
    std::optional<double> blockLength; ///< ticks
    std::vector<HjifEffect> effects;
};

struct HjifChannel
{
    double gain = 1.0;
    std::optional<double> rate, samples;
    std::vector<HjifBand> bands;
};

struct HjifPerception
{
    std::string modality;
    double unitExponent = 0.0;
    std::vector<HjifEffect> library;
    std::vector<HjifChannel> channels;
};

struct HjifFile
{
    std::string description;
    double ticks = 1000.0; ///< per second
    std::vector<HjifPerception> perceptions;
};

/// The entries of a file's tree, of which only the types, the timescale and the version are checked. Warnings: a
/// version newer than known, missing entries that other players need. Errors: invalidData with the entry's place.
[[nodiscard]] Result<HjifFile> readHjifFile(const nlohmann::json& tree, std::vector<std::string>& warnings);

/// Warning for a version newer than known. Errors: invalidData unless it is a year with or without an amendment, such
/// as `2023` or `2023-1`.
[[nodiscard]] std::optional<Error> checkHjifVersion(const std::string& version, std::vector<std::string>& warnings);

} // namespace pacini
