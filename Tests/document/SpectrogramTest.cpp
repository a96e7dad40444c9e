#include "document/view/Spectrogram.h"

#include "document/view/ColourMap.h"
#include "document/view/Follow.h"
#include "support/Catch.h"

#include <array>
#include <numbers>
#include <set>

using namespace pacini;

namespace
{
std::vector<float> tone(double frequency, double amplitude, double rate, double seconds, double from = 0.0)
{
    std::vector<float> samples(static_cast<std::size_t>(seconds * rate));
    for (std::size_t i = 0; i < samples.size(); ++i)
        if (const double t = static_cast<double>(i) / rate; t >= from)
            samples[i] = static_cast<float>(amplitude * std::sin(2.0 * std::numbers::pi * frequency * t));
    return samples;
}

std::size_t loudest(std::span<const std::uint8_t> levels)
{
    return static_cast<std::size_t>(std::max_element(levels.begin(), levels.end()) - levels.begin());
}

/// All tiles that a view asks for, in the order in which it does.
std::vector<Spectrogram::Tile> fill(Spectrogram& spectrogram, SpectrumAnalyzer& analyser, std::size_t rows,
                                    const TimeAxis& axis, double width)
{
    std::vector<Spectrogram::Tile> asked;
    while (const auto tile = spectrogram.nextMissing(axis, width))
    {
        asked.push_back(*tile);
        REQUIRE(asked.size() < 1000);
        spectrogram.put(*tile, Spectrogram::compute(analyser, *tile, rows));
    }
    return asked;
}

/// CIE L*a*b* of an sRGB colour (D65), independent of the space in which the colours were made.
std::array<double, 3> cieLab(std::uint32_t rgb)
{
    const auto linear = [&](int shift)
    {
        const double x = ((rgb >> shift) & 255) / 255.0;
        return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
    };
    const double r = linear(16), g = linear(8), b = linear(0);
    const auto f = [](double t)
    {
        return t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116.0;
    };
    const double x = f((0.4124 * r + 0.3576 * g + 0.1805 * b) / 0.9505);
    const double y = f(0.2126 * r + 0.7152 * g + 0.0722 * b);
    const double z = f((0.0193 * r + 0.1192 * g + 0.9505 * b) / 1.089);
    return {116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)};
}
} // namespace

TEST_CASE("A tone has its amplitude's level in the row of its frequency, and elsewhere there is next to nothing")
{
    constexpr double rate = 44100.0;
    for (const SpectrumRows rows : {SpectrumRows{20.0, 2000.0, 128}, SpectrumRows{20.0, 22050.0, 128}})
        for (const double frequency : {30.0, 71.0, 155.0, 170.0, 440.0, 960.0, 1700.0})
        {
            const auto samples = tone(frequency, 0.25, rate, 1.0);
            SpectrumAnalyzer analyser(samples, rate, rows);
            std::vector<std::uint8_t> levels(rows.count);
            analyser.column(0.5, levels);
            INFO(frequency << " Hz of " << rows.high);
            const std::size_t k = loudest(levels);
            // Within a row, or where bins are wider than rows, within half a bin of that window.
            const double bin = frequency < 160.0 ? 5.0 : frequency < 1000.0 ? 17.0 : 50.0;
            CHECK(rows.frequencyAt(static_cast<double>(k)) - 0.5 * bin <= frequency);
            CHECK(rows.frequencyAt(static_cast<double>(k) + 1.0) + 0.5 * bin >= frequency);
            // -12.04 dB; a Hann window between two bins is 1.42 dB low.
            CHECK(SpectrumLevel::decibels(levels[k]) < -11.6);
            CHECK(SpectrumLevel::decibels(levels[k]) > -13.7);
            for (std::size_t i = 0; i < rows.count; ++i)
                if (const double f = rows.frequencyAt(static_cast<double>(i) + 0.5);
                    f > 2.5 * frequency || f < frequency / 2.5)
                    CHECK(SpectrumLevel::decibels(levels[i]) < -60.0);
        }
}

TEST_CASE("Above half the sample rate and outside the sound there is silence")
{
    const auto samples = tone(300.0, 1.0, 1000.0, 1.0);
    const SpectrumRows rows{20.0, 2000.0, 64};
    SpectrumAnalyzer analyser(samples, 1000.0, rows);
    std::vector<std::uint8_t> levels(rows.count, 7);
    analyser.column(0.5, levels);
    for (std::size_t i = 0; i < rows.count; ++i)
        if (rows.frequencyAt(static_cast<double>(i)) > 520.0)
            CHECK(levels[i] == 0);
    for (const double time : {-1.0, 3.0})
    {
        analyser.column(time, levels);
        CHECK(std::all_of(levels.begin(), levels.end(), [](std::uint8_t level) { return level == 0; }));
    }
}

TEST_CASE("A spectrogram shows a tone where it sounds, at every zoom, and asks for what is visible first")
{
    constexpr double rate = 8000.0, seconds = 20.0, begin = 8.0;
    const auto samples = tone(500.0, 0.5, rate, seconds, begin);
    const SpectrumRows rows{20.0, 2000.0, 64};
    for (const double perPixel : {0.5, 0.05, 0.02, 0.004, 0.001})
    {
        Spectrogram spectrogram(seconds, rows);
        SpectrumAnalyzer analyser(samples, rate, rows);
        const double width = 100.0;
        const TimeAxis axis{std::max(0.0, begin - 50.0 * perPixel), perPixel};
        const auto asked = fill(spectrogram, analyser, rows.count, axis, width);
        REQUIRE(!asked.empty());
        CHECK(asked.front().level == 0);
        CHECK(asked.front().range().from <= axis.start);
        CHECK(asked.front().range().to > axis.start);
        std::set<Spectrogram::Tile> once(asked.begin(), asked.end());
        CHECK(once.size() == asked.size());
        std::vector<std::uint8_t> column(rows.count);
        for (int x = 0; x < 100; ++x)
        {
            const double from = axis.timeAt(x), to = axis.timeAt(x + 1.0);
            if (to > seconds)
                break;
            spectrogram.column(from, to, column);
            INFO(perPixel << " s a pixel, " << from << " s");
            // The window of that row reaches 30 ms either way, that of low rows 100 ms, a pixel its own width.
            if (from > begin + 0.05 + perPixel)
            {
                CHECK(std::abs(rows.frequencyAt(static_cast<double>(loudest(column)) + 0.5) - 500.0) < 25.0);
                CHECK(SpectrumLevel::decibels(column[loudest(column)]) == Approx(-6.0).margin(1.6));
            }
            else if (to < begin - 0.125 - perPixel)
                CHECK(column[loudest(column)] == 0);
        }
    }
}

TEST_CASE("What has not been computed is shown by what is coarser, and old fine tiles go")
{
    const SpectrumRows rows{20.0, 2000.0, 4};
    Spectrogram spectrogram(600.0, rows);
    std::vector<std::uint8_t> column(4);
    spectrogram.column(1.0, 1.001, column);
    CHECK(column == std::vector<std::uint8_t>(4, 0));
    spectrogram.put({0, 0}, std::vector<std::uint8_t>(Spectrogram::tileColumns * 4, 9));
    spectrogram.column(1.0, 1.001, column);
    CHECK(column == std::vector<std::uint8_t>(4, 9));
    spectrogram.column(0.0, 300.0, column); // coarse levels know at once
    CHECK(column == std::vector<std::uint8_t>(4, 9));
    for (int i = 0; i < 400; ++i)
        spectrogram.put({4, i}, std::vector<std::uint8_t>(Spectrogram::tileColumns * 4, 20));
    spectrogram.column(1.0, 1.001, column); // tile 6 is gone
    CHECK(column == std::vector<std::uint8_t>(4, 9));
    spectrogram.column(399.5 * 0.16, 399.5 * 0.16 + 0.001, column);
    CHECK(column == std::vector<std::uint8_t>(4, 20));
}

TEST_CASE("Level colours go evenly from the ground to its opposite")
{
    for (const bool dark : {true, false})
    {
        const auto colours = levelColours(dark);
        double least = 1e9, most = 0.0;
        // Steps of eight: single ones are rounded to whole bytes.
        for (std::size_t i = 8; i < colours.size(); i += 8)
        {
            const auto a = cieLab(colours[i - 8]), b = cieLab(colours[i]);
            INFO(dark << " " << i);
            CHECK((dark ? b[0] - a[0] : a[0] - b[0]) > 0.5);
            const double distance = std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
            least = std::min(least, distance);
            most = std::max(most, distance);
        }
        CHECK(most / least < 3.0);
        CHECK(std::abs(cieLab(colours[255])[0] - cieLab(colours[0])[0]) > 70.0);
    }
}

TEST_CASE("A view turns its page, stays with the playhead, or stays where it is")
{
    const TimeAxis axis{10.0, 0.01}; // to 18 s at 800 pixels
    for (const double time : {9.0, 10.0, 14.0, 18.0, 30.0})
        CHECK(followed(axis, time, 800.0, Follow::off) == axis);
    CHECK(followed(axis, 14.0, 800.0, Follow::page) == axis);
    CHECK(followed(axis, 18.5, 800.0, Follow::page).start == Approx(18.5));
    CHECK(followed(axis, 2.0, 800.0, Follow::page).start == Approx(2.0));
    for (const double time : {9.0, 14.0037, 30.0})
    {
        const TimeAxis smooth = followed(axis, time, 800.0, Follow::smooth);
        CHECK(smooth.xOf(time) == Approx(400.0).margin(0.51));
        const double pixels = (smooth.start - axis.start) / axis.secondsPerPixel;
        CHECK(pixels == Approx(std::round(pixels)).margin(1e-6));
    }
}
