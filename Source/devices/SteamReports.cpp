#include "devices/SteamReports.h"

#include "devices/MuLaw.h"

#include <cmath>
#include <span>

namespace pacini::devices
{

namespace
{
void putSample(std::span<std::byte> side, const SteamStream& stream, std::size_t i, std::int16_t sample) noexcept
{
    if (stream.muLaw)
    {
        side[i] = muLawByte(sample);
        return;
    }
    const auto bits = static_cast<std::uint16_t>(sample);
    side[2 * i] = static_cast<std::byte>(bits & 0xFFu);
    side[2 * i + 1] = static_cast<std::byte>(bits >> 8u);
}
} // namespace

Report steamSamplesReport(const SteamStream& stream, const PcmBlock& block) noexcept
{
    constexpr std::size_t sideBytes = 31;
    std::array<std::byte, 2 + 2 * sideBytes> bytes{};
    bytes[0] = std::byte{0x88};
    bytes[1] = static_cast<std::byte>(stream.muLaw ? stream.samples : 2 * stream.samples);
    const std::span<std::byte> all(bytes);
    for (std::size_t i = 0; i < stream.samples; ++i)
    {
        putSample(all.subspan(2, sideBytes), stream, i, block.left[i]);
        putSample(all.subspan(2 + sideBytes, sideBytes), stream, i, block.right[i]);
    }
    return bytes;
}

Report steamSwitchReport(SteamSwitch what, SteamPair pair, std::uint8_t format) noexcept
{
    return std::array{std::byte{0x86}, static_cast<std::byte>(what), static_cast<std::byte>(pair),
                      static_cast<std::byte>(format)};
}

Report steamDeckReport(const MotorLevels& motors) noexcept
{
    std::array<std::byte, 65> bytes{}; // the first, the report's number, is 0
    bytes[1] = std::byte{0xEB};
    bytes[2] = std::byte{9}; // bytes that follow: type, intensity, two levels, two gains
    const auto put = [&](std::size_t at, double level)
    {
        const double within = level > 0.0 ? std::fmin(level, 1.0) : 0.0;
        const auto number = static_cast<unsigned>(std::lround(within * 65535.0));
        bytes[at] = static_cast<std::byte>(number & 0xFFu);
        bytes[at + 1] = static_cast<std::byte>(number >> 8u);
    };
    put(6, motors.strong);
    put(8, motors.weak);
    bytes[10] = std::byte{2}; // dB
    return Report(bytes, ReportWay::feature);
}

} // namespace pacini::devices
