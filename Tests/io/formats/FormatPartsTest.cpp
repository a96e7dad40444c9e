// The parts that writers and readers of other formats are made of, each by itself.

#include "io/formats/ClipFormat.h"
#include "io/formats/EmphasisFit.h"
#include "io/formats/ForeignText.h"
#include "io/formats/ImportReport.h"
#include "io/formats/LossList.h"
#include "io/formats/NormalisedFrequency.h"
#include "io/formats/NumbersOf.h"
#include "io/formats/RootCurve.h"
#include "io/formats/VoiceReduction.h"
#include "io/formats/ahap/SumLimit.h"
#include "io/formats/android/AndroidEffects.h"
#include "io/formats/android/AndroidWaveform.h"
#include "io/formats/hjif/BakedClip.h"
#include "io/formats/hjif/HjifEvents.h"
#include "io/formats/hjif/HjifFit.h"
#include "io/formats/hjif/HjifFormat.h"
#include "io/formats/hjif/HjifLikeness.h"
#include "io/formats/hjif/HjifStream.h"
#include "io/formats/hjif/HjifVoices.h"
#include "io/formats/hjif/HjifWavelet.h"
#include "io/formats/hjif/HjifWaves.h"
#include "support/Catch.h"
#include "support/Pinned.h"

#include <pacini/foundation/NumberText.h>
#include <pacini/synthesis/DecoderChoice.h>
#include <pacini/synthesis/SingleVoice.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

using namespace pacini;

namespace
{
/// 0 to 1, the same everywhere.
class PartsNoise
{
public:
    double next()
    {
        state = state * 6364136223846793005u + 1442695040888963407u;
        return static_cast<double>(state >> 11) * 0x1p-53;
    }

private:
    std::uint64_t state = 99;
};

/// Bands of moving pitch and level, without an envelope.
Clip partsBands(std::size_t count, double duration, std::size_t points)
{
    PartsNoise noise;
    Clip clip;
    clip.duration = duration;
    for (std::size_t k = 0; k < count; ++k)
    {
        Band band;
        band.centreFrequency = 52.0 * std::pow(1.61, static_cast<double>(k));
        band.lowFrequency = 0.83 * band.centreFrequency;
        band.highFrequency = 1.2 * band.centreFrequency;
        for (std::size_t i = 0; i < points; ++i)
        {
            const double time = duration * static_cast<double>(i) / static_cast<double>(points - 1);
            const double level = noise.next();
            band.amplitude.push_back({time, i % 11 == 3 ? 0.0 : 0.5 * level * level});
            band.pitch.push_back({time, band.centreFrequency * (0.9 + 0.2 * noise.next())});
        }
        clip.bands.push_back(band);
    }
    return clip;
}

std::vector<double> partsNumbers(const Curve& curve)
{
    std::vector<double> numbers;
    test::addCurve(numbers, curve, 1.0);
    return numbers;
}

std::vector<double> partsNumbers(const std::vector<Transient>& events)
{
    std::vector<double> numbers;
    for (const Transient& event : events)
        numbers.insert(numbers.end(), {event.time, event.amplitude, event.sharpness});
    return numbers;
}

SingleVoice partsVoice()
{
    SingleVoice voice;
    voice.duration = 0.4137;
    voice.amplitude = {{0.0, 0.2}, {0.1, 0.9}, {0.1, 0.0}, {0.22, 0.0}, {0.3, 1.4}, {0.4137, 0.3}};
    voice.frequency = {{0.0, 80.0}, {0.25, 150.0}};
    voice.events = {{0.0, 0.5, 0.1}, {0.15, 0.25, 0.6}, {0.1612, 0.75, 0.2}, {0.26, 1.2, 0.9}, {0.4137, 0.6, 0.4}};
    return voice;
}
} // namespace

TEST_CASE("Decimals are rounded, without needless zeros and without a negative zero", "[formats]")
{
    CHECK(shortDecimalText(0.0, 3) == "0");
    CHECK(shortDecimalText(-0.0001, 3) == "0");
    CHECK(shortDecimalText(-0.25, 2) == "-0.25");
    CHECK(shortDecimalText(1.5, 0) == "2");
    CHECK(shortDecimalText(100.0, 0) == "100");
    CHECK(shortDecimalText(100.0, 2) == "100");
    CHECK(shortDecimalText(1.250, 3) == "1.25");
    CHECK(shortDecimalText(0.1234567, 4) == "0.1235");
}

TEST_CASE("Names in code are in snake case and never empty", "[formats]")
{
    CHECK(identifierOf("aZ09_xA") == "az09_xa");
    CHECK(identifierOf("  Door -- 2 ") == "door_2");
    CHECK(identifierOf("9 lives") == "clip_9_lives");
    CHECK(identifierOf("0") == "clip_0");
    CHECK(identifierOf("a/:@[`{b") == "a_b");
    CHECK(identifierOf("zA9") == "za9");
    CHECK(identifierOf("") == "clip");
    CHECK(identifierOf("---") == "clip");
    Clip clip;
    CHECK(nameOfClip(clip, "") == "clip");
    clip.source.file = "s.wav";
    CHECK(nameOfClip(clip, "") == "s.wav");
    clip.name = "own";
    CHECK(nameOfClip(clip, "") == "own");
    CHECK(nameOfClip(clip, "wanted") == "wanted");
    const auto digit = [](int x)
    {
        return std::to_string(x);
    };
    CHECK(numbersInLines(std::vector<int>{}, 2, digit) == "");
    CHECK(numbersInLines(std::vector<int>{1, 2, 3, 4, 5}, 2, digit, " ") == "\n 1, 2,\n 3, 4,\n 5");
}

TEST_CASE("A long name of another program's clip ends with a whole character", "[formats]")
{
    const std::string most(125000, 'x');
    CHECK(importedName("") == "");
    CHECK(importedName("Tür") == "Tür");
    CHECK(importedName(most) == most);
    CHECK(importedName(most + "y") == most);
    for (const std::string character : {"é", "€", "\xF0\x9F\x9A\xAA"})
        for (std::size_t fits = 0; fits <= character.size(); ++fits)
        {
            CAPTURE(character, fits);
            const std::string before = most.substr(fits);
            CHECK((importedName(before + character + "z") == before + (fits < character.size() ? "" : character)));
        }
}

TEST_CASE("UTF-16 is told from text with one character or none", "[formats]")
{
    std::vector<std::string> warnings;
    using namespace std::string_literals;
    for (const std::string& text : {""s, "a"s, "ab"s, "\0"s, "\0\0"s})
        CHECK(foreignText(text, warnings).ok());
    CHECK(warnings.empty());
    for (const std::string& text : {"\xFF\xFE"s, "\xFE\xFF"s, "a\0"s, "\0a"s})
    {
        const auto read = foreignText(text, warnings);
        REQUIRE_FALSE(read.ok());
        CHECK(read.error().where == "line 1, column 1");
        CHECK(read.error().message == "is UTF-16 text; save it as UTF-8");
    }
    CHECK(*foreignText("\xEF\xBB\xBFx", warnings) == "x");
    CHECK(warnings == std::vector<std::string>{"line 1, column 1: the byte order mark is ignored"});
    CHECK(largestForeignText == 67108864);
    std::string longest(largestForeignText, ' ');
    CHECK(foreignText(longest, warnings).ok());
    longest += ' ';
    CHECK(foreignText(longest, warnings).error().code == ErrorCode::tooLarge);
    CHECK(foreignText(longest, warnings).error().message == "is longer than 64 MiB");
}

TEST_CASE("A report keeps 50 warnings and the first error", "[formats]")
{
    std::vector<std::string> warnings;
    ImportReport report(warnings);
    for (int i = 0; i < 52; ++i)
        report.warn("a", std::to_string(i));
    CHECK(warnings.size() == 50);
    CHECK(warnings.back() == "a: 49");
    report.fail("x", "first", ErrorCode::tooLarge);
    report.fail("y", "second");
    REQUIRE(report.error);
    CHECK(report.error->where == "x");
    CHECK(report.error->message == "first");
    CHECK(report.error->code == ErrorCode::tooLarge);
}

TEST_CASE("Lanes are taken again from their end on, up to as many as there may be", "[formats]")
{
    ImportLanes lanes;
    const auto laneOf = [&](double start, double end)
    {
        const Band* band = lanes.take(start, end, 2);
        return band == nullptr ? -1 : static_cast<int>(band - lanes.bands.data());
    };
    CHECK(laneOf(0.0, 1.0) == 0);
    CHECK(laneOf(0.5, 2.0) == 1);
    CHECK(laneOf(0.75, 2.0) == -1);
    CHECK(laneOf(1.0, 3.0) == 0);
    CHECK(laneOf(2.0, 3.0) == 1);
    CHECK(laneOf(2.5, 3.0) == -1);
    CHECK(lanes.bands.size() == 2);
    CHECK(ImportLanes().take(0.0, 1.0, 0) == nullptr);
}

TEST_CASE("What sounds until the end of a clip stops there when the clip is made longer", "[formats]")
{
    Clip clip;
    clip.duration = 1.0;
    clip.envelope = {{0.0, 0.5}, {0.75, 0.25}};
    clip.bands.resize(3);
    clip.bands[0].amplitude = {{0.0, 0.5}, {1.0, 0.25}};
    clip.bands[1].amplitude = {{0.0, 0.5}, {0.5, 0.0}};
    clip.noise.push_back({50.0, 100.0, {{0.0, 0.125}}});
    const Clip before = clip;
    lengthen(clip, 1.0);
    CHECK(clip == before);
    lengthen(clip, 0.5);
    CHECK(clip == before);
    lengthen(clip, 2.0);
    CHECK(clip.duration == 2.0);
    CHECK(clip.envelope == Curve{{0.0, 0.5}, {0.75, 0.25}, {1.0, 0.25}, {1.0, 0.0}});
    CHECK(clip.bands[0].amplitude == Curve{{0.0, 0.5}, {1.0, 0.25}, {1.0, 0.0}});
    CHECK(clip.bands[1].amplitude == before.bands[1].amplitude);
    CHECK(clip.bands[2].amplitude.empty());
    CHECK(clip.noise[0].amplitude == Curve{{0.0, 0.125}, {1.0, 0.125}, {1.0, 0.0}});

    Clip latest;
    latest.duration = limits::duration;
    latest.transients = {{limits::duration, 1.0, 0.5}};
    lastUntilSounded(latest);
    CHECK(latest.duration == limits::duration);
    Clip taps;
    taps.duration = 1.0;
    taps.transients = {{1.0, 1.0, 0.0}, {0.5, 1.0, 1.0}};
    finishImported(taps);
    CHECK(taps.transients[0].time == 0.5);
    CHECK(taps.duration == Approx(1.02).margin(1e-4)); // two periods of 100 Hz
    taps.duration = 1.0199;
    lastUntilSounded(taps);
    CHECK(taps.duration == 1.0199); // half a millisecond is rounding
    taps.duration = 1.0;
    finishImported(taps, true);
    CHECK(taps.duration == 1.0);
    Clip bands = partsBands(3, 1.0, 4);
    bands.bands[0].amplitude = {{0.0, 0.1}};
    bands.bands[1].amplitude = {{0.0, 0.9}};
    bands.bands[2].amplitude = {{0.0, 0.5}};
    finishImported(bands);
    CHECK(bands.bands[0].priority == 2);
    CHECK(bands.bands[1].priority == 0);
    CHECK(bands.bands[2].priority == 1);
}

TEST_CASE("Frequencies of 0 to 1 are a line between the ends of their range", "[formats]")
{
    CHECK(questRange.low == 55.0);
    CHECK(questRange.high == 200.0);
    CHECK(sharpnessRange.low == 65.0);
    CHECK(sharpnessRange.high == 300.0);
    CHECK(sharpnessRange.hertzOf(0.5) == 182.5);
    CHECK(sharpnessRange.normalisedOf(182.5) == 0.5);
    CHECK(sharpnessRange.normalisedOf(64.0) == 0.0);
    CHECK(sharpnessRange.normalisedOf(301.0) == 1.0);
    CHECK(NormalisedRange{100.0, 100.0}.normalisedOf(100.0) == 0.5);
    CHECK(questPlayer.range.low == 55.0);
    CHECK(questPlayer.range.high == 165.0);
    CHECK(questPlayer.ducking == 0.5);
    CHECK(questPlayer.lengthOf(0.0) == 0.0364);
    CHECK(questPlayer.lengthOf(1.0) == Approx(0.0121));
    CHECK(questPlayer.sharpnessOfLength(0.5 * (0.0364 + 0.0121)) == Approx(0.5));
    CHECK(questPlayer.sharpnessOfLength(0.01) == 1.0);
    CHECK(questPlayer.sharpnessOfLength(0.05) == 0.0);
    const VoiceFormat usual;
    CHECK(usual.amplitudePoints == 40.0);
    CHECK(usual.frequencyPoints == 30.0);
    CHECK(usual.events.ducking == 1.0);
    CHECK(usual.scale == LevelScale::amplitude);
    for (const double sharpness : {0.0, 0.5, 1.0})
        CHECK(usual.events.lengthOf(sharpness) == 0.0); // nothing of the voice is under an event
}

TEST_CASE("Roots and squares of a curve are within a step of 8 bits between its points", "[formats]")
{
    const Curve curve{{0.0, 0.0}, {0.5, 1.0}, {0.5, 0.25}, {1.0, 0.25}, {1.5, 0.04}, {1.6, 4.0}};
    const Curve root = rootOf(curve), square = squareOf(curve);
    for (double t = 0.0; t < 1.5; t += 0.0007)
    {
        CAPTURE(t);
        CHECK(std::abs(std::pow(valueAt(root, t), 2.0) - valueAt(curve, t)) <= 1.0 / 255.0);
        CHECK(std::abs(valueAt(square, t) - std::pow(valueAt(curve, t), 2.0)) <= 1.0 / 255.0);
    }
    // With the fewest pieces: a root may move by twice the root of the tolerance within one.
    CHECK(rootOf({{0.0, 0.0}, {1.0, 1.0}}).size() == 9);
    CHECK(squareOf({{0.0, 0.0}, {1.0, 1.0}}).size() == 9);
    CHECK(rootOf({{0.0, 0.25}, {1.0, 0.25}}) == Curve{{0.0, 0.5}, {1.0, 0.5}});
    CHECK(squareOf({{0.0, 0.5}, {0.0, 0.25}}) == Curve{{0.0, 0.25}, {0.0, 0.0625}});
    CHECK(rootOf({{0.0, -1.0}}) == Curve{{0.0, 0.0}});
    CHECK(rootOf({}).empty());
    checkPinned("formats/root of a curve", partsNumbers(root), 1e-9);
    checkPinned("formats/square of a curve", partsNumbers(square), 1e-9);
}

TEST_CASE("Losses of a place begin anew after a tenth of a second that is well", "[formats]")
{
    const auto found = [](const std::vector<std::pair<double, double>>& places)
    {
        LossTrack track(LossKind::points, "m");
        for (const auto& [time, error] : places)
            track.add(time, error);
        std::vector<FormatLoss> all;
        track.appendTo(all);
        return all;
    };
    CHECK(found({{0.0, 0.0}}).empty());
    CHECK(found({{0.0, -1.0}, {1.0, std::nan("")}}).empty());
    CHECK(found({{0.5, 0.25}}) == std::vector<FormatLoss>{{LossKind::points, 0.5, 0.0, 0.25, "m"}});
    CHECK(found({{0.5, 0.25}, {2.0, 0.5}, {3.0, 0.125}}) ==
          std::vector<FormatLoss>{{LossKind::points, 0.5, 2.5, 0.5, "m"}});
    CHECK(found({{0.5, 0.25}, {0.5625, 0.0}, {0.59375, 0.5}}) ==
          std::vector<FormatLoss>{{LossKind::points, 0.5, 0.09375, 0.5, "m"}});
    CHECK(found({{0.5, 0.25}, {0.5625, 0.0}, {0.625, 0.5}}) ==
          std::vector<FormatLoss>{{LossKind::points, 0.5, 0.0, 0.25, "m"}, {LossKind::points, 0.625, 0.0, 0.5, "m"}});
    LossTrack twice(LossKind::noise, "n");
    twice.add(0.0, 1.0);
    std::vector<FormatLoss> all;
    twice.appendTo(all);
    twice.add(0.01, 1.0);
    twice.appendTo(all);
    CHECK(all.size() == 2);
}

TEST_CASE("Losses that touch are one, those of texts and events wherever they are", "[formats]")
{
    LossList list;
    list.add(LossKind::points, 1.0, 1.0, 0.25, "a");
    list.add(LossKind::points, 2.0 + 0.9e-6, 1.0, 0.125, "a");
    list.add(LossKind::points, 3.1, 1.0, 0.5, "a");
    list.add(LossKind::points, 0.0, 0.5, 0.5, "b");
    list.add(LossKind::frequency, 0.25, 4.0, 0.5, "a");
    list.add(LossKind::event, 5.0, 0.25, 0.125, "e");
    list.add(LossKind::event, 9.0, 0.5, 0.0, "e");
    list.add(LossKind::text, 7.0, 0.0, 0.0, "t");
    list.add(LossKind::text, 0.0, 0.0, 0.0, "t");
    const auto sorted = std::move(list).sorted();
    CHECK(sorted == std::vector<FormatLoss>{{LossKind::points, 0.0, 0.5, 0.5, "b"},
                                            {LossKind::text, 0.0, 7.0, 0.0, "t"},
                                            {LossKind::frequency, 0.25, 4.0, 0.5, "a"},
                                            {LossKind::points, 1.0, 2.0 + 0.9e-6 + 1.0 - 1.0, 0.25, "a"},
                                            {LossKind::points, 3.1, 1.0, 0.5, "a"},
                                            {LossKind::event, 5.0, 4.5, 0.125, "e"}});

    const auto textsOf = [](const Clip& clip, bool keepsName)
    {
        LossList losses;
        losses.addText(clip, keepsName);
        return std::move(losses).sorted();
    };
    Clip clip;
    CHECK(textsOf(clip, false).empty());
    clip.name = "n";
    CHECK(textsOf(clip, true).empty());
    CHECK(textsOf(clip, false).at(0).message == "the name, the source and the encoder's parameters are left out");
    clip.source.file = "s";
    CHECK(textsOf(clip, true).at(0).message == "the source and the encoder's parameters are left out");
    Clip encoded;
    encoded.encoder = {{"gain", 1.0}};
    CHECK(textsOf(encoded, true).size() == 1);
    encoded.encoder.clear();
    encoded.markers = {{0.5, "a"}, {1.5, "b"}};
    CHECK(textsOf(encoded, true) == std::vector<FormatLoss>{{LossKind::text, 0.5, 1.0, 0.0, "markers are left out"}});
}

TEST_CASE("A burst ends before the next event", "[formats]")
{
    const std::vector<Transient> events{{0.0, 1.0, 0.0}, {0.02, 1.0, 0.0}, {0.03, 1.0, 0.0}};
    CHECK(burstLength(events, 0, 0.02) == 0.02);
    CHECK(burstLength(events, 0, 0.025) == Approx(0.012));
    CHECK(burstLength(events, 1, 0.02) == Approx(0.006));
    CHECK(burstLength(events, 2, 0.02) == 0.02);
}

TEST_CASE("Strength is the amplitude in the middle of each step, topped by bursts", "[formats]")
{
    SingleVoice voice;
    voice.duration = 0.1;
    voice.amplitude = {{0.0, 0.0}, {0.1, 1.0}};
    voice.events = {{0.046, 0.3, 0.5}};
    const auto strength = strengthOf(voice, 0.02, 0.02);
    REQUIRE(strength.size() == 5);
    CHECK(strength[0] == Approx(0.1));
    CHECK(strength[1] == Approx(0.3));
    CHECK(strength[2] == Approx(std::hypot(0.5, 0.3)));
    CHECK(strength[3] == Approx(0.7));
    CHECK(strength[4] == Approx(0.9));
    voice.duration = 0.1001;
    CHECK(strengthOf(voice, 0.02, 0.02).size() == 6);
    voice.duration = 0.0;
    CHECK(strengthOf(voice, 0.02, 0.02).empty());
    checkPinned("formats/strength, 20 ms", strengthOf(partsVoice(), 0.02, 0.02), 1e-9);
    checkPinned("formats/strength, 7 ms", strengthOf(partsVoice(), 0.007, 0.03), 1e-9);
}

TEST_CASE("A voice is a clip of one band, a silent one of none", "[formats]")
{
    const Clip clip = clipOfVoice(partsVoice());
    CHECK(clip.duration == 0.4137);
    CHECK(clip.transients.size() == 5);
    REQUIRE(clip.bands.size() == 1);
    CHECK(clip.bands[0].lowFrequency == 80.0);
    CHECK(clip.bands[0].highFrequency == 150.0);
    CHECK(clip.bands[0].centreFrequency == Approx(std::sqrt(12000.0)));
    CHECK(clip.bands[0].pitch.size() == 2);
    SingleVoice steady = partsVoice();
    steady.frequency = {{0.0, 90.0}, {0.2, 90.0}};
    CHECK(clipOfVoice(steady).bands.at(0).pitch.empty());
    CHECK(clipOfVoice(steady).bands.at(0).centreFrequency == 90.0);
    steady.amplitude = {{0.0, 0.0}, {0.2, 0.0}};
    CHECK(clipOfVoice(steady).bands.empty());

    const SingleVoice nothing = oneVoice({});
    CHECK(nothing.frequency == Curve{{0.0, 150.0}});
    for (const Breakpoint& point : nothing.amplitude)
        CHECK(point == Breakpoint{0.0, 0.0});
    Clip weak;
    weak.duration = 1.0;
    weak.transients = {{0.5, 0.0, 0.5}, {0.75, 0.01, 0.5}};
    CHECK(oneVoice(weak).events.size() == 1);
}

TEST_CASE("Thinned curves have at most so many points per second and one", "[formats]")
{
    Curve curve;
    PartsNoise noise;
    for (int i = 0; i <= 200; ++i)
        curve.push_back({0.01 * i, noise.next()});
    CHECK(thinned(curve, 10.0, 2.0).size() == 21);
    CHECK(thinned(curve, 10.0, 2.04).size() == 22);
    CHECK(thinned(curve, 100.0, 2.0) == curve);
    CHECK(thinned(curve, 40.0, 0.01).size() == 5); // as if of a tenth of a second
    CHECK(thinned({}, 10.0, 2.0).empty());
    checkPinned("formats/thinned curve", partsNumbers(thinned(curve, 7.0, 2.0)), 1e-8);
}

TEST_CASE("Parts of a quarter of a second that nobody feels are said to be empty", "[formats]")
{
    const auto found = [](const Curve& amplitude, const std::vector<Transient>& events = {})
    {
        SingleVoice voice;
        voice.duration = 2.0;
        voice.amplitude = amplitude;
        voice.events = events;
        LossList losses;
        addEmptyParts(losses, voice);
        return std::move(losses).sorted();
    };
    const std::string message = "too weak to be felt";
    CHECK(found({{0.0, 0.003}, {2.0, 0.003}}) == std::vector<FormatLoss>{{LossKind::empty, 0.0, 2.0, 0.003, message}});
    CHECK(found({{0.0, 0.0}, {2.0, 0.0}}, {{1.0, 0.002, 0.5}}) ==
          std::vector<FormatLoss>{{LossKind::empty, 0.0, 2.0, 0.002, message}});
    CHECK(found({{0.0, leastAmplitude}, {2.0, leastAmplitude}}).empty());
    CHECK(found({{0.0, 0.5}, {0.25, 0.003}, {0.5, 0.003}, {0.75, 0.5}}) ==
          std::vector<FormatLoss>{{LossKind::empty, 0.25, 0.25, 0.003, message}});
    CHECK(found({{0.0, 0.5}, {0.25, 0.003}, {0.4375, 0.003}, {0.75, 0.5}}).empty());
    CHECK(found({{0.0, 0.5}, {0.25, 0.0}, {0.5, 0.0}, {0.75, 0.5}}).empty());
    CHECK(found({{0.0, 0.5}, {0.25, 0.003}, {0.5, 0.003}, {0.75, 0.5}}, {{0.25, 0.5, 0.5}}).empty());
    CHECK(found({{0.0, 0.5}, {0.25, 0.003}, {0.5, 0.003}, {0.75, 0.5}}, {{0.5, 0.5, 0.5}}).empty());
    CHECK(
        found({{0.0, 0.5}, {0.25, 0.003}, {0.5, 0.003}, {0.75, 0.5}}, {{0.1875, 0.5, 0.5}, {0.625, 0.5, 0.5}}).size() ==
        1);
    CHECK(found({{0.0, 0.5}, {1.0, 0.003}}) == std::vector<FormatLoss>{{LossKind::empty, 1.0, 1.0, 0.003, message}});
}

TEST_CASE("Emphases of voices and players have the numbers that they had", "[formats]")
{
    PartsNoise noise;
    std::vector<Transient> events;
    Curve amplitude{{0.0, 0.0}};
    double time = 0.0;
    for (int i = 0; i < 40; ++i)
    {
        time += i % 5 == 0 ? 0.2 : 0.009 + 0.04 * noise.next();
        events.push_back({time, i % 4 == 1 ? 0.0 : 0.8 * noise.next(), noise.next()});
        amplitude.push_back({time + 0.004, i % 7 == 2 ? 0.0 : 1.1 * noise.next()});
    }
    for (const double ducking : {0.0, 0.5, 0.9, 1.0})
        for (const bool isQuest : {true, false})
        {
            const EmphasisPlayer player = isQuest ? EmphasisPlayer{{55.0, 165.0}, 0.0364, 0.0121, ducking}
                                                  : EmphasisPlayer{{90.0, 270.0}, 0.02, 0.005, ducking};
            const std::vector<double> numbers = partsNumbers(emphasesOf(events, amplitude, player));
            checkPinned("formats/emphases, ducking " + shortDecimalText(ducking, 1) + (isQuest ? ", quest" : ", short"),
                        numbers, 1e-8);
        }
}

TEST_CASE("Steps of waveforms have the numbers that they had", "[formats]")
{
    for (const bool keeps : {false, true})
        for (const double rate : {0.0, 30.0, 250.0})
        {
            const auto steps =
                androidWaveformOf(partsVoice(), rate > 0.0 ? std::optional<double>(rate) : std::nullopt, keeps);
            std::vector<double> numbers;
            std::int64_t sum = 0;
            for (const AndroidStep& step : steps)
            {
                numbers.insert(numbers.end(),
                               {static_cast<double>(step.duration), static_cast<double>(step.amplitude)});
                sum += step.duration;
            }
            CHECK(sum == 414);
            LossList losses;
            addStepLosses(losses, partsVoice(), steps);
            const auto lost = test::numbersOf(std::move(losses).sorted());
            const std::string name =
                "formats/waveform at " + shortDecimalText(rate, 0) + (keeps ? ", points kept" : "");
            checkPinned(name, numbers, 1e-9);
            checkPinned(name + ", losses", lost, 1e-8);
        }
    // Silence of less than 50 ms is bridged, of 50 ms not; silence at both ends stays.
    const auto bridged = [](double silence)
    {
        SingleVoice voice;
        voice.duration = 0.3 + silence;
        voice.amplitude = {{0.0, 0.0},
                           {0.1, 0.0},
                           {0.1, 1.0},
                           {0.2, 1.0},
                           {0.2, 0.0},
                           {0.2 + silence, 0.0},
                           {0.2 + silence, 1.0},
                           {0.25 + silence, 1.0},
                           {0.25 + silence, 0.0},
                           {0.3 + silence, 0.0}};
        return androidWaveformOf(voice, {}, true);
    };
    CHECK(bridged(0.049) == std::vector<AndroidStep>{{100, 0}, {100, 255}, {49, 1}, {50, 255}, {50, 0}});
    CHECK(bridged(0.05) == std::vector<AndroidStep>{{100, 0}, {100, 255}, {50, 0}, {50, 255}, {50, 0}});
}

TEST_CASE("Envelopes of Android say what some devices do not play", "[formats]")
{
    const auto exportOf = [](const Curve& amplitude, double hertz)
    {
        Clip clip;
        clip.duration = amplitude.back().time;
        clip.bands.push_back({hertz, hertz, hertz, 0, amplitude, {}});
        return androidEffectsOf(clip, {}).value();
    };
    const auto pointsOf = [&](const Curve& amplitude)
    {
        std::vector<std::pair<std::int64_t, double>> points;
        for (const AndroidPoint& point : exportOf(amplitude, 150.0).effects.envelope.points)
            points.emplace_back(point.duration, point.amplitude);
        return points;
    };
    const auto lossesOf = [&](const Curve& amplitude, LossKind kind, const std::string& start, double hertz = 150.0)
    {
        std::vector<FormatLoss> found;
        AndroidExport made = exportOf(amplitude, hertz);
        for (const FormatLoss& loss : std::move(made.losses).sorted())
            if (loss.kind == kind && loss.message.starts_with(start))
                found.push_back(loss);
        return found;
    };
    using Points = std::vector<std::pair<std::int64_t, double>>;
    // A segment lasts at most a second, a longer one becomes as few as can be.
    CHECK(pointsOf({{0.0, 0.0}, {1.0, 0.75}, {1.5, 0.0}}) == Points{{1000, 0.75}, {500, 0.0}});
    CHECK(pointsOf({{0.0, 0.0}, {1.001, 0.75}, {1.5, 0.0}}) == Points{{500, 0.375}, {501, 0.75}, {499, 0.0}});
    const Points three = pointsOf({{0.0, 0.0}, {0.5, 0.75}, {3.0, 0.0}});
    REQUIRE(three.size() == 4);
    CHECK(three[1].first == 833);
    CHECK(three[2].first == 833);
    CHECK(three[3].first == 834);
    CHECK(three[1].second == Approx(0.5));
    CHECK(three[2].second == Approx(0.25));
    CHECK(three[3].second == Approx(0.0).margin(1e-12));
    // What does not end at 0 falls there in a millisecond, and a step takes one.
    CHECK(pointsOf({{0.0, 0.5}, {0.5, 0.5}}) == Points{{1, 0.5}, {499, 0.5}, {1, 0.0}});
    CHECK(pointsOf({{0.0, 0.0}, {0.25, 0.0}, {0.25, 0.5}, {0.5, 0.0}}) == Points{{250, 0.0}, {1, 0.5}, {249, 0.0}});
    CHECK(pointsOf({{0.0, 0.0}, {0.5, 0.0}}) == Points{{500, 0.0}});

    const std::string crowded = "envelopes: segments of less than 20 ms";
    CHECK(lossesOf({{0.0, 0.0}, {0.02, 1.0}, {0.5, 0.0}}, LossKind::crowding, crowded).empty());
    const auto steep = lossesOf({{0.0, 0.0}, {0.1, 0.0}, {0.119, 1.0}, {0.5, 0.0}}, LossKind::crowding, crowded);
    REQUIRE(steep.size() == 1);
    CHECK(steep[0].time == Approx(0.1));
    CHECK(steep[0].duration == Approx(0.019));
    CHECK(lossesOf({{0.0, 0.0}, {0.02, 1.0}, {0.5, 0.0}}, LossKind::timeStep, "").empty());
    const auto moved = lossesOf({{0.0, 0.0}, {0.0204, 1.0}, {0.5, 0.0}}, LossKind::timeStep, "");
    REQUIRE(moved.size() == 1);
    CHECK(moved[0].error == Approx(0.0004));
    CHECK(moved[0].duration == 0.5);

    const auto zigzag = [](int points)
    {
        Curve curve{{0.0, 0.0}};
        for (int i = 1; i <= points; ++i)
            curve.push_back({0.05 * i, i < points && i % 2 != 0 ? 0.9 : 0.0});
        return curve;
    };
    CHECK(lossesOf(zigzag(16), LossKind::points, "envelopes: ").empty());
    const auto many = lossesOf(zigzag(17), LossKind::points, "envelopes: ");
    REQUIRE(many.size() == 1);
    CHECK(many[0].message == "envelopes: 17 control points; devices may support only 16 at once, Android "
                             "splits the effect");

    const Curve hill{{0.0, 0.0}, {0.25, 1.0}, {0.5, 0.0}};
    for (const double hertz : {65.0, 182.5, 300.0})
        CHECK(lossesOf(hill, LossKind::frequency, "basic envelope", hertz).empty());
    for (const auto& [hertz, end] : {std::pair{60.0, 65.0}, {330.0, 300.0}})
    {
        const auto bent = lossesOf(hill, LossKind::frequency, "basic envelope", hertz);
        REQUIRE(bent.size() == 1);
        CHECK(bent[0].error == Approx(std::abs(std::log2(hertz / end))));
        CHECK(bent[0].message == "basic envelope: frequencies are limited to 65 to 300 Hz");
    }
}

TEST_CASE("Sums of bands are limited to the same numbers as ever", "[formats]")
{
    for (const double most : {0.3, 0.6})
    {
        auto bands = partsBands(4, 2.0, 23).bands;
        bands[1].amplitude = {{0.1, 0.0}, {0.1, 0.7}, {0.9, 0.2}, {0.9, 0.0}, {1.1, 0.0}, {1.5, 0.55}};
        bands[2].amplitude.clear();
        const auto limited = limitSum(bands, most, 100000);
        REQUIRE(limited.ok());
        CHECK(*limited);
        std::vector<double> numbers;
        for (const Band& band : bands)
            test::addCurve(numbers, band.amplitude, 1.0);
        checkPinned("formats/sum limited to " + shortDecimalText(most, 1), numbers, 1e-9);
        for (double t = 0.0; t < 2.0; t += 0.003)
        {
            double sum = 0.0;
            for (const Band& band : bands)
                sum += valueAt(band.amplitude, t);
            CHECK(sum <= most * (1.0 + 1e-9));
        }
    }
    std::vector<Band> two(2);
    two[0].amplitude = two[1].amplitude = {{0.0, 0.5}, {1.0, 0.5}};
    CHECK_FALSE(*limitSum(two, 1.0, 8));
    CHECK(*limitSum(two, 0.5, 8));
    CHECK(two[0].amplitude == Curve{{0.0, 0.25}, {1.0, 0.25}});
    two[0].amplitude = two[1].amplitude = {{0.0, 0.5}, {1.0, 0.5}};
    const auto tooMany = limitSum(two, 0.5, 7);
    REQUIRE_FALSE(tooMany.ok());
    CHECK(tooMany.error().code == ErrorCode::tooLarge);
    CHECK(tooMany.error().message == "too many points needed to stay within full drive");
}

TEST_CASE("Events of HJIF have the numbers that they had", "[formats]")
{
    PartsNoise noise;
    Clip clip = partsBands(3, 4.0, 40);
    double time = 0.05;
    for (int i = 0; i < 40; ++i)
    {
        clip.transients.push_back({time, noise.next(), noise.next()});
        time += i % 3 == 0 ? 0.02 + 0.05 * noise.next() : 0.1;
    }
    std::vector<double> numbers;
    for (const HjifEvent& event : hjifEventsOf(clip))
        numbers.insert(numbers.end(), {event.tap, event.wave, event.frequency / 100.0, 10.0 * event.length,
                                       event.inTrain ? 1.0 : 0.0});
    checkPinned("formats/hjif events", numbers, 1e-9);
    std::vector<double> together;
    for (const double sharpness : {0.0, 0.3, 0.7, 1.0})
        for (const double wave : {0.0, 0.2, 1.0})
            together.push_back(hjifTogether({0.0, 0.6, sharpness}, wave));
    checkPinned("formats/hjif tap and wave", together, 1e-9);
    CHECK(hjifTogether({0.0, 0.5, 0.5}, 0.0) == 0.5);
    CHECK(hjifLevelAt(clip, 1.0) == Approx(std::sqrt(std::pow(valueAt(clip.bands[0].amplitude, 1.0), 2.0) +
                                                     std::pow(valueAt(clip.bands[1].amplitude, 1.0), 2.0) +
                                                     std::pow(valueAt(clip.bands[2].amplitude, 1.0), 2.0))));
    CHECK(hjifHighestLevel({}) == 0.0);
    CHECK(hjifTransientLevel(0.0) == Approx(std::sqrt(0.375 * 0.02 / 0.022)));
    CHECK(hjifTransientLevel(1.0) == Approx(std::sqrt(0.375 * 2.0 / 280.0 / 0.022)));
    CHECK(hannAt(0.0) == 0.0);
    CHECK(hannAt(0.25) == Approx(0.5));
    CHECK(hannAt(0.5) == Approx(1.0));
}

TEST_CASE("Fits of keyframes have the numbers that they had", "[formats]")
{
    const Clip clip = partsBands(3, 1.2, 30);
    for (const bool joint : {false, true})
        for (const double floor : {0.003, 0.05})
        {
            const HjifFit fit(clip, floor, joint);
            CHECK(fit.steps() == 241);
            std::vector<double> need(fit.steps(), 1.0);
            for (std::size_t i = 60; i < 90; ++i)
                need[i] = 3.0;
            for (const double price : {4.0, 60.0})
            {
                std::vector<double> numbers;
                for (const Curve& curve : fit.curves(price, need))
                    test::addCurve(numbers, curve, 1.0);
                checkPinned("formats/hjif fit, floor " + shortDecimalText(floor, 3) + ", price " +
                                shortDecimalText(price, 0) + (joint ? ", together" : ""),
                            numbers, joint ? 1e-5 : 1e-7);
            }
        }
    Clip loud = partsBands(1, 0.02, 2);
    loud.bands[0].amplitude = {{0.0, 3000.0}};
    const HjifFit fit(loud, 0.01, false);
    CHECK(fit.steps() == 5);
    const auto limited = fit.curves(1.0, std::vector<double>(5, 1.0));
    for (const Breakpoint& point : limited.at(0))
        CHECK(point.value == limits::amplitude);
}

TEST_CASE("Baked clips have the numbers that they had", "[formats]")
{
    Clip clip = partsBands(3, 0.9, 14);
    clip.bands[1].pitch.clear();
    for (int i = 0; i <= 10; ++i)
        clip.envelope.push_back({0.09 * i, 0.5 + 0.4 * std::sin(0.8 * i)});
    clip.transients = {{0.1, 0.8, 0.3}, {0.45, 0.2, 0.9}, {0.47, 0.9, 0.1}};
    const Clip baked = bakedClip(clip, 1.0, 0.001);
    CHECK(baked.envelope.empty());
    CHECK(baked.centroid.empty());
    CHECK(baked.bands[0].amplitude.size() == 901);
    checkPinned("formats/baked clip, rounded", test::numbersOf(baked), 1e-6);
    checkPinned("formats/baked clip", test::numbersOf(bakedClip(clip)), 1e-6);
    clip.envelope.clear();
    const Clip plain = bakedClip(clip, 5.0, 0.05);
    CHECK(plain.bands[0].amplitude == clip.bands[0].amplitude);
    CHECK(plain.transients == clip.transients);
    checkPinned("formats/baked clip, not levelled", test::numbersOf(plain), 1e-8);
}

TEST_CASE("Distances of files from their clip have the numbers that they had", "[formats]")
{
    Clip clip = partsBands(2, 0.8, 9);
    clip.transients = {{0.2, 1.0, 0.3}, {0.5, 0.9, 0.8}};
    HjifLikeness likeness(clip, decoderParamsFor(clip, {}, {}, 67.0));
    std::vector<double> numbers;
    const auto add = [&](const Clip& file)
    {
        const HjifDistance distance = likeness.distanceTo(file, hjifEventsOf(file));
        numbers.push_back(distance.value);
        numbers.insert(numbers.end(), distance.events.begin(), distance.events.end());
    };
    add(clip);
    Clip other = clip;
    other.bands.pop_back();
    add(other);
    other.transients[1].time = 0.507;
    other.transients[1].amplitude = 0.4;
    add(other);
    other.transients.clear();
    add(other);
    other.bands[0].amplitude = {{0.0, 0.05}, {0.8, 0.4}};
    add(other);
    add({});
    checkPinned("formats/hjif distances", numbers, 1e-4);
}

TEST_CASE("Voices of HJIF without a search have the numbers that they had", "[formats]")
{
    Clip clip = partsBands(7, 0.7, 15);
    for (int i = 0; i <= 12; ++i)
        clip.envelope.push_back({0.7 * i / 12.0, 0.45 + 0.4 * std::sin(1.1 * i)});
    clip.transients = {{0.1, 0.8, 0.3}, {0.3, 0.0, 0.9}, {0.45, 0.9, 0.1}};
    LossList losses;
    const Clip voices = hjifVoicesOf(clip, losses, HjifEffort::usual).clip;
    CHECK(voices.bands.size() == 5);
    checkPinned("formats/hjif voices", test::numbersOf(voices), 1e-5);
    checkPinned("formats/hjif voices, losses", test::numbersOf(std::move(losses).sorted()), 1e-4);
    LossList none;
    const Clip searched = hjifVoicesOf(clip, none, HjifEffort::search).clip;
    CHECK(searched.bands.size() >= 4);
    CHECK(searched.bands.size() <= 6);
    checkPinned("formats/hjif voices, searched", test::numbersOf(searched), 1e-4);
}

TEST_CASE("Streams of wavelet coefficients have the numbers that they had", "[formats]")
{
    const std::string alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    PartsNoise noise;
    for (const std::size_t size : {std::size_t(16), std::size_t(64), std::size_t(256)})
    {
        std::string text = size == 64 ? "8" : "z";
        for (std::size_t i = 0; i < size; ++i)
            text += alphabet[static_cast<std::size_t>(64.0 * noise.next())];
        const auto block = decodeHjifStream(text, size);
        REQUIRE(block);
        std::vector<double> numbers(block->coefficients.begin(), block->coefficients.end());
        numbers.push_back(1000.0 * block->step);
        checkPinned("formats/hjif stream of " + std::to_string(size), numbers, 1e-9);
        const auto samples = hjifBlockSamples(text, size);
        REQUIRE(samples);
        checkPinned("formats/hjif samples of " + std::to_string(size), *samples, 1e-8);
    }
    for (const char* text : {"A", "Z", "a", "z", "0", "9", "+", "/", "="})
        CHECK(decodeHjifStream(text, 16).has_value());
    for (const char* text : {"@", "[", "`", "{", "*", ",", ".", ":", "=A", " "})
        CHECK_FALSE(decodeHjifStream(text, 16).has_value());
    CHECK(hjifSmallestBlock == 16);
    CHECK(hjifLargestBlock == 65536);
    CHECK(hjifBlockSize(16.0, 8000.0, 8000.0) == 16);
    CHECK(hjifBlockSize(65536.0, 8000.0, 8000.0) == 65536);
    CHECK_FALSE(hjifBlockSize(8.0, 8000.0, 8000.0));
    CHECK_FALSE(hjifBlockSize(131072.0, 8000.0, 8000.0));
    CHECK(hjifBlockSize(2.0, 1000.0, 8000.0) == 16);
    CHECK_FALSE(hjifBlockSize(3.0, 1000.0, 8000.0));
    CHECK(hjifBlockSize(2.0, 1000.0, 6000.0) == 16); // 2.67 ticks, the fraction left away
    CHECK_FALSE(hjifBlockSize(1.0, 1000.0, 8000.0));
}

TEST_CASE("Waves of HJIF become bands and events as they stand", "[formats]")
{
    std::vector<std::string> warnings;
    ImportReport report(warnings);
    const HjifScale scale{500.0, 2.0};
    const auto effectOf = [](const std::vector<HjifKeyframe>& keyframes, const std::string& signal = "Sine")
    {
        HjifEffect effect;
        effect.type = "Basis";
        effect.baseSignal = signal;
        effect.keyframes = keyframes;
        return effect;
    };
    HjifBand limits;
    limits.low = 60.0;
    limits.high = 240.0;
    Band lane;
    appendHjifWave(lane, effectOf({{0.0, {}, 50.0}, {50.0, 0.25, {}}, {100.0, -0.5, 250.0}, {150.0, {}, 100.0}}), 100.0,
                   limits, scale, report, "w");
    CHECK(lane.amplitude == Curve{{0.2, 0.0}, {0.2, 0.5}, {0.3, 0.5}, {0.4, 1.0}, {0.5, 1.0}});
    CHECK(lane.pitch == Curve{{0.2, 60.0}, {0.4, 240.0}, {0.5, 100.0}});
    CHECK(warnings == std::vector<std::string>{"w: negative amplitudes are read without sign",
                                               "w: frequencies outside of the band are moved to its limits"});
    warnings.clear();
    // A gap is silent, and an amplitude of no keyframe is none.
    appendHjifWave(lane, effectOf({{0.0, 0.0, {}}, {50.0, 600.0, {}}}), 300.0, limits, scale, report, "w");
    appendHjifWave(lane, effectOf({{0.0, {}, 70.0}}), 400.0, limits, scale, report, "w");
    CHECK(lane.amplitude ==
          Curve{{0.2, 0.0}, {0.2, 0.5}, {0.3, 0.5}, {0.4, 1.0}, {0.5, 1.0}, {0.5, 0.0}, {0.6, 0.0}, {0.7, 1000.0}});
    CHECK(warnings.empty());
    // Of other waves the first harmonic is felt.
    const std::vector<std::pair<std::string, double>> signals{{"Square", 4.0 / 3.14159265358979},
                                                              {"Triangle", 8.0 / 9.86960440108936},
                                                              {"SawToothUp", 2.0 / 3.14159265358979},
                                                              {"SawToothDown", 2.0 / 3.14159265358979},
                                                              {"Other", 1.0}};
    for (const auto& [signal, factor] : signals)
    {
        Band other;
        warnings.clear();
        appendHjifWave(other, effectOf({{0.0, 0.25, {}}}, signal), 0.0, limits, scale, report, "w");
        CHECK(other.amplitude.at(0).value == Approx(0.5 * factor));
        CHECK(warnings == std::vector<std::string>{"w: the base signal '" + signal + "' becomes a sine"});
    }
    // Between extrema lies half a period.
    Band drawn;
    appendHjifCurve(drawn,
                    effectOf({{0.0, 0.0, {}},
                              {1.0, 0.25, {}},
                              {2.0, 0.5, {}},
                              {2.0, 0.4, {}},
                              {6.0, -0.5, {}},
                              {7.0, -0.5, {}},
                              {10.0, {}, {}}}),
                    0.0, scale);
    CHECK(drawn.amplitude == Curve{{0.002, 0.0}, {0.002, 0.5}, {0.008, 1.0}, {0.016, 0.5}});
    REQUIRE(drawn.pitch.size() == 3);
    CHECK(drawn.pitch[0].value == Approx(125.0));
    CHECK(drawn.pitch[1].value == Approx(62.5));
    CHECK(drawn.pitch[2].value == Approx(62.5));

    Band set;
    set.pitch = {{0.0, 50.0}, {1.0, 400.0}};
    setHjifFrequencies(set, limits);
    CHECK(set.lowFrequency == 50.0);
    CHECK(set.highFrequency == 400.0);
    CHECK(set.centreFrequency == Approx(std::sqrt(20000.0)));
    CHECK(set.pitch.size() == 2);
    set.pitch = {{0.0, 100.0}, {1.0, 100.00005}};
    setHjifFrequencies(set, limits);
    CHECK(set.centreFrequency == 100.0);
    CHECK(set.pitch.empty());
    CHECK(set.lowFrequency == 60.0);
    CHECK(set.highFrequency == 240.0);
    setHjifFrequencies(set, limits);
    CHECK(set.centreFrequency == Approx(120.0));
    HjifBand none;
    setHjifFrequencies(set, none);
    CHECK(set.centreFrequency == 0.0);
    // Octaves begin at 1 Hz, and the middle stays within the band.
    const auto middleOf = [](double low, double high)
    {
        HjifBand band;
        band.low = low;
        band.high = high;
        Band result;
        setHjifFrequencies(result, band);
        return result.centreFrequency;
    };
    CHECK(middleOf(0.0, 100.0) == Approx(10.0));
    CHECK(middleOf(0.25, 100.0) == Approx(10.0));
    CHECK(middleOf(0.25, 0.5) == 0.5);
    CHECK(middleOf(4.0, 100.0) == Approx(20.0));
}

TEST_CASE("A wave of 30 ms or less that rises and falls once is an event of HJIF", "[formats]")
{
    const HjifScale scale{1000.0, 2.0};
    const auto pulseOf = [&](const std::vector<HjifKeyframe>& keyframes, const std::string& signal = "Sine")
    {
        HjifEffect effect;
        effect.baseSignal = signal;
        effect.keyframes = keyframes;
        return hjifPulse(effect, 100.0, scale);
    };
    const auto event = pulseOf({{0.0, 0.0, 100.0}, {5.0, 0.25, {}}, {10.0, 0.4, {}}, {20.0, 0.0, {}}});
    REQUIRE(event);
    CHECK(event->time == 0.1);
    CHECK(event->amplitude == 0.8);
    CHECK(event->sharpness == 0.0);
    CHECK(pulseOf({{2.0, 0.0, 280.0}, {5.0, 0.25, {}}, {9.0, 0.0, {}}})->sharpness == Approx(1.0));
    CHECK(pulseOf({{2.0, 0.0, 280.0}, {5.0, 0.25, {}}, {9.0, 0.0, {}}})->time == 0.102);
    CHECK(pulseOf({{0.0, 0.0, 167.332}, {5.0, 0.25, {}}, {12.0, 0.0, {}}})->sharpness == Approx(0.5).margin(1e-4));
    // With 2.5 periods and more it is one of a train, from 150 to 2500 Hz.
    CHECK(pulseOf({{0.0, 0.0, 200.0}, {5.0, 0.25, {}}, {12.5, 0.0, {}}})->sharpness ==
          Approx(std::log(200.0 / 150.0) / std::log(2500.0 / 150.0)));
    CHECK(pulseOf({{0.0, 0.0, 200.0}, {5.0, 0.25, {}}, {12.4, 0.0, {}}})->sharpness ==
          Approx(std::log(2.0) / std::log(2.8)));
    CHECK(pulseOf({{0.0, 0.0, 2500.0}, {5.0, 0.25, {}}, {12.0, 0.0, {}}})->sharpness == Approx(1.0));
    // On every tick: the peak of three of them lies between the second and the third.
    CHECK(pulseOf({{0.0, 0.0, 200.0}, {1.0, 0.3, {}}, {2.0, 0.3, {}}, {3.0, 0.0, {}}})->amplitude == Approx(0.8));
    CHECK(pulseOf({{0.0, 0.0, 200.0}, {2.0, 0.3, {}}, {4.0, 0.3, {}}, {6.0, 0.0, {}}})->amplitude == Approx(0.6));
    CHECK(pulseOf({{0.0, 0.0, 1.0}, {1.0, 0.3, {}}, {30.0, 0.0, {}}}));
    CHECK_FALSE(pulseOf({{0.0, 0.0, 0.9}, {1.0, 0.3, {}}, {30.0, 0.0, {}}}));
    CHECK_FALSE(pulseOf({{0.0, 0.0, 100.0}, {1.0, 0.3, {}}, {31.0, 0.0, {}}}));
    CHECK_FALSE(pulseOf({{0.0, 0.0, 100.0}, {0.0, 0.3, {}}, {0.0, 0.0, {}}}));
    CHECK_FALSE(pulseOf({{0.0, 0.0, 100.0}, {5.0, 0.0, {}}}));
    CHECK_FALSE(pulseOf({{0.0, 0.0, 100.0}, {1.0, 0.3, {}}, {9.0, 0.0, {}}}, "Square"));
    CHECK_FALSE(pulseOf({{0.0, 0.0, {}}, {1.0, 0.3, {}}, {9.0, 0.0, {}}}));
    CHECK_FALSE(pulseOf({{0.0, 0.0, 100.0}, {1.0, 0.3, 100.0}, {9.0, 0.0, {}}}));
    CHECK_FALSE(pulseOf({{0.0, 0.0, 100.0}, {1.0, {}, {}}, {9.0, 0.0, {}}}));
    CHECK_FALSE(pulseOf({{0.0, 0.1, 100.0}, {1.0, 0.3, {}}, {9.0, 0.0, {}}}));
    CHECK_FALSE(pulseOf({{0.0, 0.0, 100.0}, {1.0, 0.3, {}}, {9.0, 0.1, {}}}));
    CHECK_FALSE(pulseOf({{0.0, 0.0, 100.0}, {1.0, 0.3, {}}, {2.0, 0.0, {}}, {9.0, 0.0, {}}}));
    CHECK_FALSE(pulseOf({{0.0, 0.0, 100.0}, {1.0, 0.3, {}}, {2.0, 0.2, {}}, {3.0, 0.3, {}}, {9.0, 0.0, {}}}));
    CHECK(pulseOf({{0.0, 0.0, 100.0}, {1.0, 0.3, {}}, {2.0, 0.3, {}}, {9.0, 0.0, {}}}));
    CHECK(pulseOf({{0.0, 0.0, 100.0}, {1.0, 900.0, {}}, {9.0, 0.0, {}}})->amplitude == 1000.0);
}
