#pragma once

// Files, losses and clips as lists of numbers, to be pinned.

#include "io/formats/ClipFormat.h"

#include <cctype>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace pacini::test
{

/// 0 to 1, another one for nearly each other text (FNV-1a).
inline double checksumOf(std::string_view text)
{
    std::uint32_t sum = 2166136261u;
    for (const char c : text)
        sum = (sum ^ static_cast<unsigned char>(c)) * 16777619u;
    return static_cast<double>(sum >> 8) * 0x1p-24;
}

/// All numbers of a text, and a checksum of what is between them.
inline void addNumbers(std::vector<double>& numbers, const std::string& text)
{
    std::string words;
    const auto isDigit = [&](std::size_t i)
    {
        return i < text.size() && std::isdigit(static_cast<unsigned char>(text[i])) != 0;
    };
    for (std::size_t i = 0; i < text.size();)
    {
        const bool inWord = !words.empty() && std::isalnum(static_cast<unsigned char>(words.back())) != 0;
        if (!inWord && (isDigit(i) || (text[i] == '-' && isDigit(i + 1))))
        {
            const char* from = text.c_str() + i;
            char* to = nullptr;
            numbers.push_back(std::strtod(from, &to));
            i += static_cast<std::size_t>(to - from);
            words += '#';
        }
        else
            words += text[i++];
    }
    numbers.push_back(checksumOf(words));
}

/// Samples of bytes as numbers in a text, without the sign that only some have.
inline std::string bytesAsText(std::string_view bytes)
{
    std::string text;
    for (const char c : bytes)
        text += std::to_string(static_cast<unsigned char>(c)) + " ";
    return text;
}

inline std::vector<double> numbersOf(const std::vector<FormatLoss>& losses)
{
    std::vector<double> numbers{static_cast<double>(losses.size())};
    for (const FormatLoss& loss : losses)
    {
        numbers.insert(numbers.end(), {static_cast<double>(loss.kind), loss.time, loss.duration, loss.error});
        addNumbers(numbers, loss.message);
    }
    return numbers;
}

inline void addCurve(std::vector<double>& numbers, const Curve& curve, double unit)
{
    numbers.push_back(static_cast<double>(curve.size()));
    for (const Breakpoint& point : curve)
        numbers.insert(numbers.end(), {point.time, point.value / unit});
}

/// Frequencies in 100 Hz, so that amplitudes and times count beside them.
inline std::vector<double> numbersOf(const Clip& clip)
{
    constexpr double hundred = 100.0;
    std::vector<double> numbers{clip.duration, checksumOf(clip.name), checksumOf(clip.source.file),
                                static_cast<double>(clip.bands.size())};
    addCurve(numbers, clip.envelope, 1.0);
    addCurve(numbers, clip.centroid, hundred);
    for (const Band& band : clip.bands)
    {
        numbers.insert(numbers.end(), {band.lowFrequency / hundred, band.centreFrequency / hundred,
                                       band.highFrequency / hundred, static_cast<double>(band.priority)});
        addCurve(numbers, band.amplitude, 1.0);
        addCurve(numbers, band.pitch, hundred);
    }
    numbers.push_back(static_cast<double>(clip.transients.size()));
    for (const Transient& event : clip.transients)
        numbers.insert(numbers.end(), {event.time, event.amplitude, event.sharpness});
    for (const NoiseBand& band : clip.noise)
    {
        numbers.insert(numbers.end(), {band.lowFrequency / hundred, band.highFrequency / hundred});
        addCurve(numbers, band.amplitude, 1.0);
    }
    return numbers;
}

inline std::vector<double> numbersOf(const ImportedClip& imported)
{
    std::vector<double> numbers = numbersOf(imported.clip);
    for (const std::string& warning : imported.warnings)
        addNumbers(numbers, warning);
    return numbers;
}

} // namespace pacini::test
