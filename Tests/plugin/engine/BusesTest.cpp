// What goes in and what comes out.

#include "plugin/engine/Rig.h"

#include <pacini/realtime/Translator.h>

using namespace pacini;
using namespace pacini::test;
using plugin::OutputMode;
using plugin::ParameterId;
using plugin::SourceChoice;

namespace
{
double index(OutputMode mode)
{
    return static_cast<double>(mode);
}

double index(SourceChoice choice)
{
    return static_cast<double>(choice);
}

/// What the core makes of a sound, without any plugin.
std::vector<float> translated(const std::vector<float>& sound, double rate = 48000.0)
{
    Translator translator;
    translator.prepare({rate, 512});
    translator.setParams({});
    std::vector<float> drive(sound.size());
    translator.process(sound, drive);
    return drive;
}
} // namespace

TEST_CASE("The main output is the input bit by bit, as late as the plugin reports")
{
    for (const double rate : {8000.0, 44100.0, 48000.0, 96000.0, 192000.0, 768000.0})
        for (const int channels : {1, 2, 6, 16})
        {
            CAPTURE(rate, channels);
            Rig rig({rate, channels, 1, 1});
            const auto in = liveSounds(static_cast<std::size_t>(channels), 7001, 3);
            const auto out = rig.run(in, {}, {64, 1, 333, 512});
            const auto latency = static_cast<std::size_t>(rig.plugin.getLatencySamples());
            REQUIRE((latency > 0 || rate < 12000.0)); // low rates are translated as they are
            REQUIRE(1000.0 * static_cast<double>(latency) / rate < 5.0);
            for (std::size_t c = 0; c < in.size(); ++c)
                REQUIRE(out.main[c] == delayed(in[c], latency));
        }
}

TEST_CASE("The haptic output is what the translator makes of the mean of the main channels")
{
    Rig rig;
    const auto in = liveSounds(2, 48000, 5);
    const auto out = rig.run(in, {}, {256});
    CHECK(out.haptic[0] == translated(meanOf(in[0], in[1])));
    CHECK(energy(out.haptic[0]) > 1.0);
}

TEST_CASE("The sidechain is read before the haptic output is written into the same channel")
{
    Rig rig;
    rig.set(ParameterId::source, index(SourceChoice::sidechain));
    const auto main = liveSounds(2, 24000, 5);
    const auto side = liveSound(24000, 9);
    const auto out = rig.run(main, {side}, {512});
    CHECK(out.haptic[0] == translated(side));
    CHECK(out.main[0] == delayed(main[0], static_cast<std::size_t>(rig.plugin.getLatencySamples())));
}

TEST_CASE("A silent sidechain adds nothing to the mix")
{
    const auto main = liveSounds(2, 24000, 5);
    Rig alone, mixed;
    mixed.set(ParameterId::source, index(SourceChoice::mix));
    CHECK(alone.run(main).haptic == mixed.run(main, {std::vector<float>(24000, 0.0f)}).haptic);
}

TEST_CASE("The mix holds both sounds in full in the middle and one of them at its ends")
{
    const auto main = liveSounds(1, 24000, 5);
    const auto side = liveSound(24000, 9);
    std::vector<float> sum(side);
    for (std::size_t i = 0; i < sum.size(); ++i)
        sum[i] += main[0][i];
    const auto with = [&](double mix)
    {
        Rig rig({48000.0, 1, 1, 1});
        rig.set(ParameterId::source, index(SourceChoice::mix));
        rig.set(ParameterId::sourceMix, mix);
        return rig.run(main, {side}).haptic[0];
    };
    CHECK(with(0.0) == translated(main[0]));
    CHECK(with(0.5) == translated(sum));
    CHECK(with(1.0) == translated(side));
}

TEST_CASE("All haptic channels carry the drive")
{
    const auto in = liveSounds(2, 12000, 5);
    const auto one = Rig().run(in).haptic[0];
    for (const int channels : {2, 8})
    {
        Rig rig({48000.0, 2, 1, channels});
        const auto out = rig.run(in);
        REQUIRE(out.haptic.size() == static_cast<std::size_t>(channels));
        for (const auto& channel : out.haptic)
            CHECK(channel == one);
    }
}

TEST_CASE("Sidechain and haptic output may be missing, each for itself")
{
    const auto in = liveSounds(2, 12000, 5);
    const auto usual = Rig().run(in);
    for (const int sidechain : {0, 1, 2})
        for (const int haptic : {0, 1, 2})
        {
            CAPTURE(sidechain, haptic);
            Rig rig({48000.0, 2, sidechain, haptic});
            const auto out = rig.run(in);
            CHECK(out.main == usual.main);
            if (haptic > 0)
                CHECK(out.haptic[0] == usual.haptic[0]);
        }
    Rig rig({48000.0, 2, 0, 1});
    rig.set(ParameterId::source, index(SourceChoice::sidechain));
    CHECK(energy(rig.run(in).haptic[0]) == 0.0);
}

TEST_CASE("The output mode says what the main output carries")
{
    const auto in = liveSounds(6, 12000, 5);
    const RigLayout wide{48000.0, 6, 1, 1};
    Rig plain(wide);
    const auto usual = plain.run(in);
    const auto& drive = usual.haptic[0];
    const auto mode = [&](OutputMode wanted, double channel = 4.0)
    {
        Rig rig(wide);
        rig.set(ParameterId::outputMode, index(wanted));
        rig.set(ParameterId::outputChannel, channel);
        auto out = rig.run(in, {}, {100});
        REQUIRE(out.haptic == usual.haptic);
        return out.main;
    };
    for (const auto& channel : mode(OutputMode::replaceMain))
        CHECK(channel == drive);

    auto expected = usual.main;
    expected[1] = drive;
    CHECK(mode(OutputMode::rightHaptic) == expected);

    for (std::size_t i = 0; i < expected[0].size(); ++i)
    {
        double sum = 0.0;
        for (const auto& channel : usual.main)
            sum += static_cast<double>(channel[i]);
        expected[0][i] = static_cast<float>(sum / 6.0);
    }
    const auto mono = mode(OutputMode::monoAndHaptic);
    for (std::size_t i = 0; i < expected[0].size(); ++i)
        REQUIRE(mono[0][i] == Approx(expected[0][i]).margin(1e-6));
    CHECK(mono[1] == drive);

    expected = usual.main;
    for (std::size_t i = 0; i < expected[3].size(); ++i)
        expected[3][i] += drive[i];
    CHECK(mode(OutputMode::addToChannel) == expected);
    CHECK(mode(OutputMode::addToChannel, 12.0) == usual.main); // there is no such channel
}

TEST_CASE("Bypassed, by parameter or by host, the sound passes and the haptic output falls silent without a click")
{
    const auto in = liveSounds(2, 24000, 5);
    Rig usual;
    const auto wet = usual.run(in);
    for (const auto mode : {OutputMode::separate, OutputMode::replaceMain, OutputMode::monoAndHaptic})
    {
        Rig rig;
        rig.set(ParameterId::outputMode, index(mode));
        const auto out = rig.run(in, {}, {480}, [&](std::size_t block) { rig.set(ParameterId::bypass, block >= 25); });
        const auto latency = static_cast<std::size_t>(rig.plugin.getLatencySamples());
        const auto late = delayed(in[0], latency);
        const std::size_t switched = 25 * 480;
        CHECK(std::equal(out.haptic[0].begin(), out.haptic[0].begin() + switched, wet.haptic[0].begin()));
        for (std::size_t i = switched; i < switched + 480; ++i)
            REQUIRE(std::abs(out.haptic[0][i]) <= std::abs(wet.haptic[0][i]));
        for (std::size_t i = switched + 480; i < late.size(); ++i)
        {
            REQUIRE(out.haptic[0][i] == 0.0f);
            REQUIRE(out.main[0][i] == late[i]);
        }
    }
    Rig rig;
    juce::AudioBuffer<float> buffer(3, 4800);
    for (int c = 0; c < 2; ++c)
        buffer.copyFrom(c, 0, in[static_cast<std::size_t>(c)].data(), 4800);
    juce::MidiBuffer midi;
    rig.plugin.processBlockBypassed(buffer, midi);
    const auto latency = rig.plugin.getLatencySamples();
    for (int i = latency; i < 4800; ++i)
        REQUIRE(buffer.getSample(0, i) == in[0][static_cast<std::size_t>(i - latency)]);
    CHECK(buffer.getMagnitude(2, 0, 4800) == 0.0f);
}

TEST_CASE("Layouts: one to sixteen main channels, in as out; sidechain and haptic up to eight")
{
    plugin::PluginProcessor plugin;
    const auto allowed = [&](int in, int out, int sidechain, int haptic)
    {
        auto layout = busesLayout({48000.0, in, sidechain, haptic});
        layout.outputBuses.getReference(0) = channelSet(out);
        return plugin.checkBusesLayoutSupported(layout);
    };
    CHECK(allowed(1, 1, 1, 1));
    CHECK(allowed(2, 2, 0, 0));
    CHECK(allowed(2, 2, 2, 8));
    CHECK(allowed(8, 8, 8, 2));
    CHECK(allowed(16, 16, 1, 1));
    CHECK_FALSE(allowed(0, 0, 1, 1));
    CHECK_FALSE(allowed(1, 2, 1, 1));
    CHECK_FALSE(allowed(2, 1, 1, 1));
    CHECK_FALSE(allowed(2, 2, 1, 9));
    CHECK_FALSE(allowed(2, 2, 9, 1));
    CHECK_FALSE(allowed(24, 24, 1, 1));
}
