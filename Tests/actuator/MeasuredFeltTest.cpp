#include "support/Catch.h"

#include <pacini/actuator/MeasuredFelt.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

using namespace pacini;

namespace
{
/// Level of a resonator of one degree of freedom, whose acceleration follows the force: a second-order high-pass.
double resonatorLevel(double f, double f0, double q)
{
    const std::complex<double> s(0.0, f / f0);
    return 20.0 * std::log10(std::abs(s * s / (s * s + s / q + 1.0)));
}

std::vector<MeasuredPoint> resonator(double f0, double q)
{
    std::vector<MeasuredPoint> points;
    for (double f = 20.0; f <= 1000.0; f *= std::pow(2.0, 1.0 / 96.0))
        points.push_back({f, resonatorLevel(f, f0, q), std::nullopt});
    return points;
}

/// The drive through the filter, from where it answers to the first frame.
std::vector<float> felt(std::vector<float> drive, const std::vector<MeasuredPoint>& points, double fs,
                        std::size_t block)
{
    MeasuredFelt model(points, fs);
    drive.resize(drive.size() + model.latencyFrames(), 0.0f);
    for (std::size_t n = 0; n < drive.size(); n += block)
    {
        const std::span<float> part = std::span(drive).subspan(n, std::min(block, drive.size() - n));
        model.process(part, part);
    }
    drive.erase(drive.begin(), drive.begin() + static_cast<std::ptrdiff_t>(model.latencyFrames()));
    return drive;
}
} // namespace

TEST_CASE("A tone is felt at its measured level, at any rate and in any blocks", "[actuator]")
{
    for (const double fs : {8000.0, 48000.0})
        for (const double f : {25.0, 67.0, 175.0, 180.0, 600.0})
        {
            const auto points = resonator(175.0, 10.0);
            std::vector<float> tone(static_cast<std::size_t>(2.0 * fs));
            for (std::size_t n = 0; n < tone.size(); ++n)
                tone[n] = static_cast<float>(std::sin(2.0 * std::numbers::pi * f * static_cast<double>(n) / fs));
            const auto once = felt(tone, points, fs, tone.size());
            CHECK(felt(tone, points, fs, 127) == once);
            std::complex<double> sum;
            const auto second = static_cast<std::size_t>(fs);
            for (std::size_t n = second; n < 2 * second; ++n)
                sum += static_cast<double>(once[n]) *
                       std::polar(2.0 / fs, -2.0 * std::numbers::pi * f * static_cast<double>(n) / fs);
            INFO(fs << " Hz, " << f << " Hz");
            CHECK(20.0 * std::log10(std::abs(sum)) == Approx(measuredLevelAt(points, f)).margin(0.15));
        }
}

TEST_CASE("A burst rings as the resonator that was measured", "[actuator]")
{
    constexpr double fs = 8000.0, f0 = 175.0, q = 10.0;
    std::vector<float> click(8000, 0.0f);
    click[100] = 1.0f;
    const auto response = felt(click, resonator(f0, q), fs, 512);
    const auto largest = [&](double from, double to)
    {
        float most = 0.0f;
        for (auto n = static_cast<std::size_t>(from * fs); n < static_cast<std::size_t>(to * fs); ++n)
            most = std::max(most, std::abs(response[n]));
        return static_cast<double>(most);
    };
    CHECK(largest(0.0, 99.0 / fs) < 0.01); // nothing before the click
    const auto energy = [&](double from)
    {
        double sum = 0.0; // over seven periods
        for (auto n = static_cast<std::size_t>(from * fs); n < static_cast<std::size_t>((from + 7.0 / f0) * fs); ++n)
            sum += static_cast<double>(response[n]) * static_cast<double>(response[n]);
        return sum;
    };
    const double decay = 10.0 * std::log10(energy(0.03) / energy(0.08));
    CHECK(decay == Approx(20.0 * std::log10(std::exp(std::numbers::pi * f0 / q * 0.05))).margin(1.0));
}

TEST_CASE("Only a calibrated measurement says what is felt", "[actuator]")
{
    Profile profile;
    CHECK_FALSE(hasMeasuredAcceleration(profile));
    CHECK_FALSE(hasRelativeLevels(profile));
    profile.measurement.emplace().points = resonator(100.0, 3.0);
    CHECK_FALSE(hasMeasuredAcceleration(profile)); // nobody says how
    profile.sources = {{"measurement", "measured with a calibrated sensor"}};
    CHECK(hasMeasuredAcceleration(profile));
    profile.sources = {{"measurement", "assumed levels"}};
    CHECK_FALSE(hasMeasuredAcceleration(profile));
    CHECK(hasRelativeLevels(profile));
}
