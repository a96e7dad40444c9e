#include "support/Catch.h"
#include "support/Pinned.h"

#include <pacini/analysis/OnsetSalience.h>
#include <pacini/foundation/Random.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <vector>

using namespace pacini;

namespace
{

using Bands = std::array<double, OnsetFrame::bandCount>;

/// Frames 0..count-1 of the band powers powerAt(k).
std::vector<OnsetFrame> framesOf(std::ptrdiff_t count, const std::function<Bands(std::ptrdiff_t)>& powerAt)
{
    std::vector<OnsetFrame> frames(static_cast<std::size_t>(count));
    for (std::ptrdiff_t k = 0; k < count; ++k)
    {
        OnsetFrame& frame = frames[static_cast<std::size_t>(k)];
        const Bands powers = powerAt(k);
        double sum = 0.0;
        for (std::size_t b = 0; b < powers.size(); ++b)
        {
            frame.bands[b] = static_cast<float>(powers[b]);
            sum += powers[b];
        }
        frame.bands[OnsetFrame::bandCount] = frame.power = static_cast<float>(sum);
    }
    return frames;
}

/// The salience of all frames but the last OnsetSalience::lookAhead, given in pieces of `piece` frames.
std::vector<double> salienceOf(const std::vector<OnsetFrame>& frames, double sensitivity = 1.0,
                               std::ptrdiff_t piece = 1 << 20)
{
    OnsetSalience scores(sensitivity);
    SlidingBuffer<OnsetFrame> buffer(OnsetSalience::history);
    SlidingBuffer<float> salience(0);
    for (std::ptrdiff_t i = 0; i < std::ssize(frames); i += piece)
    {
        const auto n = std::min(piece, std::ssize(frames) - i);
        std::copy_n(frames.begin() + i, n, buffer.extend(n));
        scores.extend(buffer, salience);
    }
    return {salience.at(0), salience.at(0) + salience.end()};
}

double greatest(const std::vector<double>& values, std::ptrdiff_t begin, std::ptrdiff_t end)
{
    return *std::max_element(values.begin() + begin, values.begin() + end);
}

std::ptrdiff_t greatestAt(const std::vector<double>& values)
{
    return std::max_element(values.begin(), values.end()) - values.begin();
}

Bands allBands(double power)
{
    Bands bands;
    bands.fill(power);
    return bands;
}

} // namespace

TEST_CASE("Loudness is power to the 5/16", "[analysis][onsets]")
{
    for (double power = 1e-16; power < 1e4; power *= 1.01)
    {
        const auto p = static_cast<float>(power);
        REQUIRE(static_cast<double>(OnsetSalience::loudnessOf(p)) ==
                Approx(std::pow(static_cast<double>(p), 5.0 / 16.0)).epsilon(2.5e-4));
    }
    CHECK(OnsetSalience::loudnessOf(0.0f) >= 0.0f);
    CHECK(OnsetSalience::loudnessOf(0.0f) < 1e-11f);
}

TEST_CASE("What sets in out of silence is most salient in its first frame", "[analysis][onsets]")
{
    const auto step = [](std::ptrdiff_t k)
    {
        return allBands(k < 100 ? 0.0 : 0.01);
    };
    const auto salience = salienceOf(framesOf(300, step));
    REQUIRE(salience.size() == 300 - OnsetSalience::lookAhead);
    CHECK(greatestAt(salience) == 100);
    // All loudness is new: 1 above the threshold of 0.375.
    CHECK(salience[100] == Approx(1.0 / 0.375).epsilon(0.01));
    CHECK(greatest(salience, 0, 90) == 0.0);
    CHECK(greatest(salience, 110, 265) < 1.0);
}

TEST_CASE("Silence and steady sounds have no salience", "[analysis][onsets]")
{
    CHECK(greatest(salienceOf(framesOf(300, [](std::ptrdiff_t) { return allBands(0.0); })), 0, 265) == 0.0);
    const auto steady = salienceOf(framesOf(300, [](std::ptrdiff_t) { return allBands(0.1); }));
    CHECK(greatest(steady, 20, 265) == 0.0);
}

TEST_CASE("Salience is the same at every level", "[analysis][onsets]")
{
    Random random(8);
    const auto quiet = framesOf(900,
                                [&random](std::ptrdiff_t)
                                {
                                    Bands bands;
                                    for (double& power : bands)
                                        power = 1e-9 * std::pow(random.uniform(), -2.0);
                                    return bands;
                                });
    auto loud = quiet;
    for (OnsetFrame& frame : loud)
        for (float& power : frame.bands)
            power *= 1e6f;
    const auto a = salienceOf(quiet);
    const auto b = salienceOf(loud);
    double most = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k)
    {
        REQUIRE(a[k] == Approx(b[k]).margin(0.02));
        most = std::max(most, a[k]);
    }
    CHECK(most > 0.5);
}

TEST_CASE("Sensitivity multiplies salience", "[analysis][onsets]")
{
    const auto frames = framesOf(300, [](std::ptrdiff_t k) { return allBands(k < 100 ? 0.001 : 0.01); });
    const double usual = greatest(salienceOf(frames), 90, 110);
    const double twice = greatest(salienceOf(frames, 2.0), 90, 110);
    CHECK(usual > 1.0);
    CHECK(twice == Approx(2.0 * usual).epsilon(1e-3));
}

TEST_CASE("Something new in one band stands out though the sum hardly rises", "[analysis][onsets]")
{
    // 5 dB below the steady sound in another band: the power rises by 1.2 dB.
    const auto powerAt = [](std::ptrdiff_t k)
    {
        Bands bands{};
        bands[1] = 0.1;
        bands[6] = k < 400 ? 0.0 : 0.0316;
        return bands;
    };
    const auto salience = salienceOf(framesOf(600, powerAt));
    CHECK(greatestAt({salience.begin() + 100, salience.end()}) == 300);
    CHECK(salience[400] > 1.0);
}

TEST_CASE("A slow swell is no event, a fast one is", "[analysis][onsets]")
{
    const auto swell = [](double seconds)
    {
        return framesOf(1800,
                        [seconds](std::ptrdiff_t k)
                        {
                            const double t = static_cast<double>(k - 600) / OnsetFrame::rate;
                            return allBands(1e-6 + 0.1 * std::pow(std::clamp(t / seconds, 0.0, 1.0), 2.0));
                        });
    };
    for (const double seconds : {0.05, 0.1, 0.3, 1.0})
        CHECK(greatest(salienceOf(swell(seconds)), 300, 1700) < 1.0);
    CHECK(greatest(salienceOf(swell(0.01)), 300, 1700) > 1.5);
}

TEST_CASE("A fluctuation must surpass the earlier ones, a stroke after a pause need not", "[analysis][onsets]")
{
    const auto strokes = [](double between)
    {
        return framesOf(500,
                        [between](std::ptrdiff_t k)
                        {
                            const bool on = (k >= 300 && k < 330) || (k >= 342 && k < 372);
                            Bands bands = allBands(on ? 0.1 : k < 300 ? 0.02 : between);
                            bands[0] = 0.0; // a low tone has rules of its own
                            return bands;
                        });
    };
    const double fluctuation = greatest(salienceOf(strokes(0.05), 2.0), 332, 352); // 3 dB would be enough alone
    const double stroke = greatest(salienceOf(strokes(0.0)), 332, 352);
    CHECK(fluctuation < 0.9);
    CHECK(stroke > 2.0);
}

TEST_CASE("The ticks of a low tone under way are no events, the same ticks alone are", "[analysis][onsets]")
{
    const auto ticks = [](double hum)
    {
        return framesOf(900,
                        [hum](std::ptrdiff_t k)
                        {
                            Bands bands = allBands(k % 30 == 0 ? 0.02 : 0.0);
                            bands[0] = hum;
                            return bands;
                        });
    };
    CHECK(greatest(salienceOf(ticks(0.5)), 200, 800) < 1.0);
    CHECK(greatest(salienceOf(ticks(0.0)), 200, 800) > 1.5);
}

TEST_CASE("How frames are cut into calls does not show in the salience", "[analysis][onsets]")
{
    Random random(3);
    const auto frames =
        framesOf(1000, [&random](std::ptrdiff_t) { return allBands(1e-4 * std::pow(random.uniform(), -3.0)); });
    const auto whole = salienceOf(frames);
    for (const std::ptrdiff_t piece : {1, 7, 64, 333})
        CHECK((salienceOf(frames, 1.0, piece) == whole));
}

TEST_CASE("Salience of strokes, hums and fluctuations is what it was", "[analysis][onsets]")
{
    for (const double sensitivity : {0.25, 1.0, 4.0})
    {
        Random random(6);
        double level = 0.01;
        const auto powers = [&](std::ptrdiff_t k)
        {
            // Strokes of each band in turn, faster and faster, in a hum and in noise that fluctuates.
            if (k % 7 == 0)
                level = 0.002 * std::exp(random.uniform(-1.0, 1.0));
            Bands bands = allBands(level * random.uniform(0.5, 1.5));
            bands[0] += 0.02 * (1.0 + 0.5 * std::sin(0.3 * static_cast<double>(k)));
            for (const std::ptrdiff_t stroke : {60, 140, 200, 260, 290, 310, 322, 335, 400, 520, 700})
                if (k >= stroke)
                    bands[static_cast<std::size_t>(stroke / 20) % 7] +=
                        0.3 * std::exp(-static_cast<double>(k - stroke) / 12.0) * (k == stroke ? 0.4 : 1.0);
            if (k > 600 && k < 690)
                bands = allBands(k < 640 ? 1e-7 : 0.0);
            return bands;
        };
        const auto salience = salienceOf(framesOf(800, powers), sensitivity);
        const std::string name = "analysis/salience at sensitivity " + std::to_string(sensitivity);
        checkPinned(name, salience, 1e-4);
        std::vector<double> sections;
        for (std::size_t i = 0; i + 32 <= salience.size(); i += 32)
            sections.push_back(*std::max_element(salience.begin() + static_cast<std::ptrdiff_t>(i),
                                                 salience.begin() + static_cast<std::ptrdiff_t>(i) + 32));
        checkPinned(name + ", greatest of every 32", sections, 1e-4);
    }
}

TEST_CASE("Salience of single steps over hums of all levels is what it was", "[analysis][onsets]")
{
    std::vector<double> peaks;
    for (const double hum : {0.0, 1e-4, 3e-3, 0.02, 0.3})
        for (const double before : {0.0, 1e-3, 5e-3})
            for (const double step : {0.004, 0.02, 0.5})
            {
                const auto powers = [&](std::ptrdiff_t k)
                {
                    Bands bands = allBands(before * (k > 40 && k < 60 ? 3.0 : 1.0));
                    bands[0] += hum;
                    bands[4] += k >= 100 ? step : 0.0;
                    bands[5] += k >= 103 ? step : 0.0;
                    return bands;
                };
                const auto salience = salienceOf(framesOf(200, powers), 4.0);
                double sum = 0.0;
                for (const double s : salience)
                    sum += s;
                peaks.push_back(greatest(salience, 80, 120));
                peaks.push_back(salience[100]);
                peaks.push_back(salience[101]);
                peaks.push_back(sum);
            }
    for (std::size_t i = 0; i + 20 <= peaks.size(); i += 20)
        checkPinned("analysis/salience of steps " + std::to_string(i / 20),
                    std::span<const double>(peaks).subspan(i, 20), 1e-4);
}
