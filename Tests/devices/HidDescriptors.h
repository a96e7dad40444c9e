#pragma once

// Report descriptors of haptic devices that do not exist, written after HID 1.11 and the HID Usage Tables.

#include <cstddef>
#include <string_view>
#include <vector>

namespace pacini::devices
{

/// Bytes of hexadecimal digits in pairs; all else is left out.
inline std::vector<std::byte> bytesOfHex(std::string_view text)
{
    std::vector<std::byte> bytes;
    int digits = 0;
    unsigned value = 0;
    for (const char c : text)
    {
        const std::size_t digit = std::string_view("0123456789ABCDEF").find(c);
        if (digit == std::string_view::npos)
            continue;
        value = value << 4 | static_cast<unsigned>(digit);
        if (++digits % 2 == 0)
            bytes.push_back(static_cast<std::byte>(value & 0xFFu));
    }
    return bytes;
}

/// A touchpad: fingers in report 1, waveforms 3..5 and their durations in feature report 5, the trigger in report 6.
inline constexpr std::string_view touchpadDescriptor = "05 0D 09 05 A1 01"
                                                       " 85 01 09 22 A1 02"
                                                       " 15 00 25 01 75 01 95 02 09 47 09 42 81 02 95 06 81 03"
                                                       " 05 01 26 FF 0F 75 10 95 02 09 30 09 31 81 02 C0"
                                                       " 05 0E 09 01 A1 02 85 05"
                                                       " 09 10 A1 02 05 0A 19 03 29 05 16 01 10 26 FF 2F"
                                                       " 75 10 95 03 B1 02 C0"
                                                       " 05 0E 09 11 A1 02 05 0A 19 03 29 05 15 00 26 FF 00"
                                                       " 75 08 95 03 B1 02 C0 C0"
                                                       " 05 0E 09 01 A1 02 85 06"
                                                       " 09 21 15 01 25 05 75 08 95 01 91 02"
                                                       " 09 23 15 00 25 04 91 02"
                                                       " 09 24 25 05 91 02"
                                                       " 09 25 26 E8 03 75 10 91 02"
                                                       " 09 28 16 E8 03 26 88 13 91 02 C0 C0";

/// A mouse without report numbers whose values do not end with bytes: buttons as an array, a trigger of 4 bits and an
/// intensity of 7. Push, pop, a long item, usages with their page.
inline constexpr std::string_view mouseDescriptor =
    "05 01 09 02 A1 01 05 09 19 01 29 05 15 00 25 05 75 03 95 02 81 00 75 02 95 01 81 03"
    " FE 03 F0 AA BB CC"
    " A4 0B 30 00 01 00 0B 31 00 01 00 15 81 25 7F 75 08 95 02 81 06 B4 C0"
    " 05 0E 09 01 A1 01 09 01 A1 02"
    " A4 09 21 15 01 25 0F 75 04 95 01 91 02 09 23 15 00 25 64 75 07 91 02 75 05 91 03 B4 C0"
    " 09 01 A1 02 0B 10 00 0E 00 A1 02 05 0A 15 00 27 FF FF 00 00 75 10 95 02 09 03 09 04 B1 02 C0"
    " 05 0E 09 11 A1 02 05 0A 09 03 09 04 B1 02 C0 C0 C0";

/// A dial: its waveforms 3..5 are constants, click, buzz, click; no intensity.
inline constexpr std::string_view dialDescriptor = "05 01 09 0E A1 01 85 01 05 0E 09 01 A1 02"
                                                   " 15 00 26 FF 00 75 08 95 01 09 24 91 02"
                                                   " 15 01 25 07 09 21 91 02"
                                                   " 05 0E 09 10 A1 02 85 02 05 0A"
                                                   " 15 03 25 03 36 03 10 46 03 10 09 03 B1 03"
                                                   " 15 04 25 04 36 04 10 46 04 10 09 04 B1 03"
                                                   " 15 05 25 05 36 03 10 46 03 10 09 05 B1 03 C0 C0 C0";

/// A gamepad without anything haptic.
inline constexpr std::string_view gamepadDescriptor = "05 01 09 05 A1 01 15 00 25 FF 75 08 95 04 09 30 81 02 C0";

} // namespace pacini::devices
