#include "support/Catch.h"

#include <pacini/analysis/OnsetMeasure.h>

#include <functional>
#include <vector>

using namespace pacini;

namespace
{

constexpr std::ptrdiff_t before = 26; ///< frames of memory that measuring may read
constexpr std::ptrdiff_t after = 25;

/// What is measured at frame `index` of the powers powerAt(k); lowPower is half of it, all of it lies in one band.
Onset measured(std::ptrdiff_t index, std::ptrdiff_t nextEvent, const std::function<double(std::ptrdiff_t)>& powerAt,
               std::size_t band = 3)
{
    std::vector<OnsetFrame> frames;
    for (std::ptrdiff_t k = index - before; k < index + after; ++k)
    {
        OnsetFrame frame;
        frame.power = static_cast<float>(powerAt(k));
        frame.lowPower = 0.5f * frame.power;
        frame.bands[band] = frame.bands[OnsetFrame::bandCount] = frame.power;
        frames.push_back(frame);
    }
    return measureOnset(frames.data() + before, index, nextEvent);
}

double seconds(double frames)
{
    return frames / OnsetFrame::rate;
}

} // namespace

TEST_CASE("The start of a sudden onset is exact to a fraction of a frame", "[analysis][onsets]")
{
    for (const double start : {50.0, 50.25, 50.5, 50.9})
        for (const double background : {0.0, 1e-5})
        {
            // A frame that the event fills in part has that part of its power.
            const auto powerAt = [&](std::ptrdiff_t k)
            {
                return background + 0.02 * std::clamp(static_cast<double>(k + 1) - start, 0.0, 1.0);
            };
            for (std::ptrdiff_t index = 47; index <= 55; ++index)
            {
                CAPTURE(start, background, index);
                CHECK(measured(index, 1000, powerAt).time == Approx(seconds(start)).margin(seconds(0.01)));
            }
        }
}

TEST_CASE("The start of a gradual attack lies where it leaves the background", "[analysis][onsets]")
{
    // A linear rise of amplitude over 10 frames.
    for (const double background : {0.0, 1e-4})
    {
        const auto powerAt = [background](std::ptrdiff_t k)
        {
            return background + 0.02 * std::pow(std::clamp(static_cast<double>(k - 50) / 10.0, 0.0, 1.0), 2.0);
        };
        const double time = measured(55, 1000, powerAt).time;
        CHECK(time >= seconds(50.0));
        CHECK(time <= seconds(53.0));
    }
}

TEST_CASE("A start is never before that of the sound", "[analysis][onsets]")
{
    for (std::ptrdiff_t index = 0; index < 6; ++index)
        CHECK(measured(index, 1000, [](std::ptrdiff_t k) { return k < 0 ? 0.0 : 0.02; }).time == 0.0);
}

TEST_CASE("Amplitudes are those of a sinusoid of the greatest power before the next event", "[analysis][onsets]")
{
    const auto two = [](std::ptrdiff_t k)
    {
        return k < 50 ? 0.0 : k < 65 ? 0.02 : 0.5;
    };
    const Onset onset = measured(50, 65, two);
    CHECK(onset.amplitude == Approx(0.2).epsilon(1e-6));
    CHECK(onset.lowAmplitude == Approx(0.2 * std::sqrt(0.5)).epsilon(1e-6));
    CHECK(measured(50, 1000, two).amplitude == Approx(1.0).epsilon(1e-6));
    // What comes 24 ms later belongs to it no more.
    const auto late = [](std::ptrdiff_t k)
    {
        return k < 50 ? 0.0 : k < 73 ? 0.02 : 0.5;
    };
    CHECK(measured(50, 1000, late).amplitude == Approx(0.2).epsilon(1e-6));
    // A peak of one frame is one fifth of a mean over five.
    const auto peak = [](std::ptrdiff_t k)
    {
        return k == 50 ? 0.1 : 0.0;
    };
    CHECK(measured(50, 1000, peak).amplitude == Approx(0.2).epsilon(1e-6));
}

TEST_CASE("Sharpness is the place of what is new between 150 and 2500 Hz", "[analysis][onsets]")
{
    const auto step = [](std::ptrdiff_t k)
    {
        return k < 50 ? 0.0 : 0.02;
    };
    double last = -1.0;
    for (std::size_t band = 1; band < OnsetFrame::bandCount; ++band)
    {
        const double here = measured(50, 1000, step, band).sharpness;
        const double place = std::log(OnsetFrame::bandCentres[band] / 150.0) / std::log(2500.0 / 150.0);
        CHECK(here == Approx(std::clamp(place, 0.0, 1.0)).margin(1e-6));
        CHECK(here >= last);
        last = here;
    }
    CHECK(measured(50, 1000, step, 0).sharpness == 0.0);
    CHECK(last == 1.0);

    // A steady sound in another band does not count.
    std::vector<OnsetFrame> frames(static_cast<std::size_t>(before + after));
    for (std::size_t k = 0; k < frames.size(); ++k)
    {
        frames[k].bands[0] = 0.5f;
        frames[k].bands[3] = k < static_cast<std::size_t>(before) ? 0.0f : 0.02f;
        frames[k].power = frames[k].bands[3] + 0.0001f;
    }
    const double place = std::log(OnsetFrame::bandCentres[3] / 150.0) / std::log(2500.0 / 150.0);
    CHECK(measureOnset(frames.data() + before, 50, 1000).sharpness == Approx(place).margin(1e-6));
}
