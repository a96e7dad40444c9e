// Rest in silence.

#include "io/ShippedProfiles.h"
#include "plugin/engine/Rig.h"
#include "plugin/engine/SilenceWatch.h"

#include <algorithm>
#include <cmath>
#include <limits>

using namespace pacini;
using namespace pacini::test;
using plugin::ParameterId;

namespace
{
Channels joined(const std::vector<Channels>& parts)
{
    Channels all(parts[0].size());
    for (const Channels& part : parts)
        for (std::size_t c = 0; c < all.size(); ++c)
            all[c].insert(all[c].end(), part[c].begin(), part[c].end());
    return all;
}

double largestDifference(const Channels& a, const Channels& b)
{
    double largest = 0.0;
    for (std::size_t c = 0; c < a.size(); ++c)
        for (std::size_t i = 0; i < a[c].size(); ++i)
            largest = std::max(largest, std::abs(static_cast<double>(a[c][i]) - static_cast<double>(b[c][i])));
    return largest;
}

Channels silence(std::size_t channels, std::size_t frames)
{
    return Channels(channels, std::vector<float>(frames));
}
} // namespace

TEST_CASE("After silence the samples are within 1e-7 those of a plugin that never rests")
{
    // The coil of the wristband is guarded, so that it rests late; a motor; a flat drive; several channels.
    struct Case
    {
        double rate;
        int haptic, profile;
        double seconds; ///< of silence
    };
    const auto [rate, haptic, profile, seconds] =
        GENERATE(Case{48000.0, 1, 0, 3.0}, Case{44100.0, 1, 0, 3.1}, Case{96000.0, 1, 3, 0.0}, Case{48000.0, 1, 1, 0.0},
                 Case{48000.0, 1, 4, 0.0}, Case{48000.0, 3, 0, 3.0}, Case{192000.0, 1, 0, 2.6});
    TranslatorSetup setup;
    setup.profile = builtInProfile(static_cast<std::size_t>(profile));
    const double needed = seconds > 0.0 ? seconds : plugin::restSeconds(setup) + 1.5;
    CAPTURE(rate, haptic, profile, needed);
    RigLayout layout;
    layout.rate = rate;
    layout.haptic = haptic;
    Rig resting(layout), working(layout);
    working.plugin.setRests(false);
    for (Rig* rig : {&resting, &working})
    {
        rig->set(ParameterId::profile, profile);
        rig->set(ParameterId::audible, 0.7); // with the voice for what lies above the frames
        rig->set(ParameterId::inputGain, 12.0);
        if (haptic > 1)
        {
            rig->set(ParameterId::pan, 2.0);
            rig->set(ParameterId::panLaw, 2.0);
            rig->set(plugin::channelParameter(1, plugin::ChannelSetting::delay), 40.0);
        }
        rig->plugin.prepareToPlay(rate, 512);
    }
    const auto frames = static_cast<std::size_t>(rate);
    for (const std::size_t odd : {0u, 1u, 61u, 1000u})
    {
        const auto in = joined({liveSounds(2, frames, 3), silence(2, static_cast<std::size_t>(needed * rate) + odd),
                                liveSounds(2, frames / 2, 5)});
        bool rested = false;
        const std::vector<int> blocks{256, 61, 512};
        const auto a = resting.run(in, {}, blocks, [&](std::size_t) { rested = rested || resting.plugin.resting(); });
        const auto b = working.run(in, {}, blocks);
        CHECK(rested);
        CHECK_FALSE(resting.plugin.resting());
        CHECK(energy(b.haptic[0]) > 0.1);
        CHECK(largestDifference(a.haptic, b.haptic) <= 1e-7);
        CHECK(largestDifference(a.main, b.main) == 0.0);
    }
}

TEST_CASE("A plugin at rest follows what is turned, and passes on what is no number")
{
    Rig resting, working;
    working.plugin.setRests(false);
    const auto quiet = silence(2, 3 * 48000 + 17);
    for (Rig* rig : {&resting, &working})
        (void)rig->run(joined({liveSounds(2, 24000, 3), quiet}));
    CHECK(resting.plugin.resting());
    for (Rig* rig : {&resting, &working})
        rig->set(ParameterId::intensity, 6.0);
    const auto sound = joined({silence(2, 4800), liveSounds(2, 24000, 5)}); // what fades is there before
    CHECK(largestDifference(resting.run(sound).haptic, working.run(sound).haptic) <= 1e-7);
    for (Rig* rig : {&resting, &working})
        (void)rig->run(quiet);
    CHECK(resting.plugin.resting());
    for (Rig* rig : {&resting, &working}) // another actuator
    {
        rig->set(ParameterId::profile, 3.0);
        juce::MemoryBlock ignored;
        rig->plugin.getStateInformation(ignored); // which catches up
    }
    CHECK(largestDifference(resting.run(sound).haptic, working.run(sound).haptic) <= 1e-7);

    Rig other;
    (void)other.run(quiet);
    CHECK(other.plugin.resting());
    auto bad = silence(2, 480);
    bad[0][100] = std::numeric_limits<float>::quiet_NaN();
    const auto out = other.run(bad).main[0];
    CHECK(std::any_of(out.begin(), out.end(), [](float x) { return std::isnan(x); }));
}

TEST_CASE("A capture at rest holds the silence")
{
    Rig rig;
    (void)rig.run(joined({liveSounds(2, 48000, 3), silence(2, 4 * 48000)}));
    CHECK(rig.plugin.resting());
    const auto capture = rig.plugin.capture(4.5);
    REQUIRE(capture.samples.size() == 216000);
    CHECK(energy({capture.samples.begin(), capture.samples.begin() + 24000}) > 1.0);
    CHECK(energy({capture.samples.begin() + 24000, capture.samples.end()}) == 0.0);
}
