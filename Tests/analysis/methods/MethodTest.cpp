#include "MethodSignals.h"
#include "support/BlockContract.h"
#include "support/Catch.h"
#include "support/Measure.h"
#include "support/Numbers.h"
#include "support/Pinned.h"

#include <pacini/analysis/methods/Method.h>
#include <pacini/analysis/methods/MethodCurves.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

using namespace pacini;
using namespace pacini::test;

namespace
{

std::vector<Method> methodsThatMake(MethodOutput output)
{
    std::vector<Method> found;
    for (const MethodInfo& info : methodTable)
        if (info.output == output && info.method != Method::a2vt)
            found.push_back(info.method);
    return found;
}

/// Sounds that have broken encoders before: next to nothing, extremes, and no numbers at all.
std::vector<std::pair<std::string, std::vector<float>>> awkwardSounds(double fs)
{
    const auto second = static_cast<std::size_t>(fs / 4.0);
    std::vector<std::pair<std::string, std::vector<float>>> sounds{
        {"nothing", {}},
        {"one sample", {1.0f}},
        {"two samples", {-0.5f, 0.25f}},
        {"thirteen samples", noise(13, 3)},
        {"silence", std::vector<float>(second, 0.0f)},
        {"a constant", std::vector<float>(second, 0.7f)},
        {"a click", impulse(second, second / 3)},
        {"noise", noise(second, 5)},
        {"a tiny sound", sine(second, 200.0, fs, 1e-38)},
        {"a huge sound", sine(second, 200.0, fs, 3e38)},
        {"a tone at half the rate", sine(second, fs / 2.0, fs, 1.0, 1.0)},
    };
    auto bad = noise(second, 9);
    bad[7] = std::numeric_limits<float>::quiet_NaN();
    bad[70] = std::numeric_limits<float>::infinity();
    sounds.emplace_back("noise with NaN", bad);
    return sounds;
}

/// Checks all methods with such an output on all of these sounds, at low and high rates.
void onAwkwardSounds(MethodOutput output, const auto& check)
{
    for (const double fs : {8000.0, 44100.0, 384000.0})
        for (const auto& [name, sound] : awkwardSounds(fs))
            for (const Method method : methodsThatMake(output))
            {
                CAPTURE(fs, name, std::string(methodInfo(method).name));
                check(method, sound, fs);
            }
}

template <typename Params, typename Change>
Params paramsWith(Change change)
{
    Params params;
    change(params);
    return params;
}

} // namespace

TEST_CASE("Every method is in the table once, under its own name", "[methods]")
{
    std::set<std::string_view> names;
    for (std::size_t i = 0; i < methodTable.size(); ++i)
    {
        const MethodInfo& info = methodTable[i];
        CHECK(static_cast<std::size_t>(info.method) == i);
        CHECK(methodInfo(info.method).name == info.name);
        CHECK(methodNamed(info.name) == info.method);
        CHECK(names.insert(info.name).second);
        CHECK(!info.description.empty());
        CHECK(info.description.find('\n') == std::string_view::npos);
    }
    for (const char* unknown : {"", "A2VT", "thesis ", "vocoder", "lowpass\n"})
        CHECK(!methodNamed(unknown));
}

TEST_CASE("Every clip is valid, as long as its sound and named after its method", "[methods]")
{
    onAwkwardSounds(MethodOutput::clip,
                    [](Method method, const auto& sound, double fs)
                    {
                        const Clip clip = translateToClip(method, sound, fs);
                        const auto valid = validate(clip);
                        CHECK((valid ? "valid" : valid.error().text()) == "valid");
                        CHECK(clip.duration == Approx(static_cast<double>(sound.size()) / fs).margin(0.0));
                        CHECK(clip.name.empty());
                        CHECK(encoderText(clip, "method", "") == methodInfo(method).name);
                        CHECK(!clip.bands.empty());
                    });
}

TEST_CASE("Priorities rank the bands of every clip by energy", "[methods]")
{
    const double fs = 16000.0;
    const auto sound = noise(16000, 2);
    for (const Method method : methodsThatMake(MethodOutput::clip))
    {
        const Clip clip = translateToClip(method, sound, fs);
        CAPTURE(std::string(methodInfo(method).name));
        std::set<int> priorities;
        for (const Band& band : clip.bands)
            priorities.insert(band.priority);
        CHECK(priorities.size() == clip.bands.size());
        for (const Band& a : clip.bands)
            for (const Band& b : clip.bands)
                if (a.priority < b.priority)
                    CHECK(curveEnergy(a.amplitude, clip.duration) >= curveEnergy(b.amplitude, clip.duration));
    }
}

TEST_CASE("The gain on record is what raised the sound to full drive", "[methods]")
{
    for (const double amplitude : {0.01, 0.25, 4.0})
        for (const Method method : methodsThatMake(MethodOutput::clip))
        {
            const Clip clip = translateToClip(method, sine(8000, 300.0, 16000.0, amplitude), 16000.0);
            const auto gain = std::find_if(clip.encoder.begin(), clip.encoder.end(),
                                           [](const EncoderParameter& p) { return p.name == "gain"; });
            CAPTURE(amplitude, std::string(methodInfo(method).name));
            REQUIRE(gain != clip.encoder.end());
            CHECK(std::get<double>(gain->value) == Approx(1.0 / amplitude).epsilon(0.1)); // the high-pass rings
        }
}

TEST_CASE("Silence costs no breakpoint and plays as silence", "[methods]")
{
    const std::vector<float> silence(12000, 0.0f);
    for (const Method method : methodsThatMake(MethodOutput::clip))
    {
        const Clip clip = translateToClip(method, silence, 8000.0);
        CAPTURE(std::string(methodInfo(method).name));
        CHECK(breakpointCount(clip) == 0);
        CHECK(clip.transients.empty());
        CHECK(played(clip, 8000.0) == silence);
    }
    for (const Method method : methodsThatMake(MethodOutput::signal))
        CHECK(translateToSignal(method, silence, 8000.0) == silence);
}

TEST_CASE("Signals are as long as the sound and finite", "[methods]")
{
    onAwkwardSounds(MethodOutput::signal,
                    [](Method method, const auto& sound, double fs)
                    {
                        const auto out = translateToSignal(method, sound, fs);
                        CHECK(out.size() == sound.size());
                        CHECK(allFinite(out));
                    });
}

TEST_CASE("Curves have as many points as the active time allows", "[methods]")
{
    // 2 s of sound between silences.
    const double fs = 8000.0;
    std::vector<float> sound(static_cast<std::size_t>(6.0 * fs), 0.0f);
    const auto middle = noise(static_cast<std::size_t>(2.0 * fs), 4);
    std::copy(middle.begin(), middle.end(), sound.begin() + static_cast<std::ptrdiff_t>(2.0 * fs));
    for (const double breakpoints : {5.0, 20.0, 60.0})
        for (const Method method : methodsThatMake(MethodOutput::clip))
        {
            MethodChoices choices;
            choices.breakpoints = breakpoints;
            const Clip clip = translateToClip(method, sound, fs, choices);
            CAPTURE(breakpoints, std::string(methodInfo(method).name));
            if (method == Method::decomposition) // as few as are worth their price
            {
                const auto curves = static_cast<double>(clip.bands.size() + clip.noise.size());
                CHECK(breakpointCount(clip) > 0);
                CHECK(static_cast<double>(breakpointCount(clip)) <= 2.6 * breakpoints * curves + 2.0 * (curves + 2.0));
                continue;
            }
            for (const Band& band : clip.bands)
            {
                // The high-pass at 5 Hz rings for some 0.2 s at -75 dB.
                CHECK(static_cast<double>(band.amplitude.size()) >= 2.0 * breakpoints);
                CHECK(static_cast<double>(band.amplitude.size()) <= 2.6 * breakpoints);
            }
        }
}

TEST_CASE("Choices that a method does not have leave it as it is", "[methods]")
{
    const auto sound = noise(8000, 8);
    MethodChoices choices;
    choices.bands = 3;
    choices.quantise = 5;
    choices.lowFrequency = 50.0;
    choices.highFrequency = 500.0;
    for (const Method method : methodsThatMake(MethodOutput::clip))
        if (method != Method::thesis)
            CHECK(translateToClip(method, sound, 8000.0, choices) == translateToClip(method, sound, 8000.0));
    const Clip clip = translateToClip(Method::thesis, sound, 8000.0, choices);
    REQUIRE(clip.bands.size() == 3);
    CHECK(clip.bands.front().centreFrequency == Approx(50.0));
    CHECK(clip.bands.back().centreFrequency == Approx(500.0));
    for (const Band& band : clip.bands)
        for (const Breakpoint& point : band.amplitude)
            CHECK(point.value * 31.0 == Approx(std::round(point.value * 31.0)).margin(1e-9));
}

TEST_CASE("What every method makes of a mixed sound is what it was", "[methods]")
{
    for (const double fs : {8000.0, 22050.0})
    {
        std::vector<float> x(static_cast<std::size_t>(0.9 * fs));
        const auto hiss = noise(x.size(), 12);
        for (std::size_t n = 0; n < x.size(); ++n)
        {
            const double t = static_cast<double>(n) / fs;
            const double w = 2.0 * std::numbers::pi * t;
            const double knock = 0.2 + std::exp(-std::fmod(t + 0.1, 0.3) / 0.03);
            x[n] = static_cast<float>(0.5 * knock *
                                          (std::sin(70.0 * w) + 0.6 * std::sin(900.0 * w + 2.0 * std::sin(3.0 * w))) +
                                      0.1 * static_cast<double>(hiss[n]) * (t > 0.6 ? 5.0 : 1.0));
        }
        const std::string at = " at " + std::to_string(static_cast<int>(fs));
        for (const Method method : methodsThatMake(MethodOutput::clip))
            for (const double points : {6.0, 200.0})
            {
                MethodChoices choices;
                choices.breakpoints = points;
                const Clip clip = translateToClip(method, x, fs, choices);
                const std::string name = "analysis/" + std::string(methodInfo(method).name) + at + " with " +
                                         std::to_string(static_cast<int>(points)) + " points";
                const auto pin = [&name](const std::string& of, const Curve& curve)
                {
                    checkPinnedCurve(name, of, curve, 1e-4);
                };
                pin("envelope", clip.envelope);
                pin("centroid", clip.centroid);
                std::vector<double> rest{clip.duration};
                for (std::size_t k = 0; k < clip.bands.size(); ++k)
                {
                    const Band& band = clip.bands[k];
                    rest.insert(rest.end(), {band.lowFrequency, band.centreFrequency, band.highFrequency,
                                             static_cast<double>(band.priority)});
                    if (k < 4 || k > 12)
                    {
                        pin("amplitude " + std::to_string(k), band.amplitude);
                        pin("pitch " + std::to_string(k), band.pitch);
                    }
                }
                for (std::size_t k = 0; k < clip.noise.size(); ++k)
                {
                    rest.insert(rest.end(), {clip.noise[k].lowFrequency, clip.noise[k].highFrequency});
                    pin("noise " + std::to_string(k), clip.noise[k].amplitude);
                }
                for (const Transient& transient : clip.transients)
                    rest.insert(rest.end(), {transient.time, transient.amplitude, transient.sharpness});
                std::string names;
                for (const auto& parameter : clip.encoder)
                {
                    names += parameter.name + " ";
                    if (const auto* number = std::get_if<double>(&parameter.value))
                        rest.push_back(*number);
                }
                CHECK(names.starts_with(method == Method::decomposition
                                            ? "method breakpoints bands noise margin quantise gain "
                                            : "method breakpoints attack hold release gain "));
                checkPinned(name + ", the rest", rest, 1e-5);
                checkPinned(name + ", the record", std::span<const double>(rest).last(5), 1e-5);
            }
        for (const Method method : methodsThatMake(MethodOutput::signal))
        {
            const auto y = translateToSignal(method, x, fs);
            const std::vector<double> all(y.begin(), y.end());
            const std::string name = "analysis/" + std::string(methodInfo(method).name) + at;
            checkPinned(name, all, 1e-5);
            checkPinned(name + ", start", std::span<const double>(all).first(20), 1e-3);
            checkPinned(name + ", end", std::span<const double>(all).last(20), 1e-3);
        }
        for (const double semitones : {-70.0, -60.0, -7.0, 0.0, 12.0, 24.0, 30.0})
        {
            const auto y = pitchShift(x, fs, {semitones});
            checkPinned("analysis/pitch shift by " + std::to_string(static_cast<int>(semitones)) + at,
                        std::vector<double>(y.begin(), y.end()), 1e-5);
        }
    }
}

TEST_CASE("Parameters of methods have the defaults of their sources", "[methods]")
{
    CHECK(PitchShiftParams{}.semitones == -24.0);
    CHECK(ZeroPhaseLowpassParams{}.frequency.value == 1000.0);
    CHECK(ZeroPhaseLowpassParams{}.order == 4);
    CHECK(EnvelopeSineParams{}.frequency.value == 80.0);
    CHECK(EnvelopeCentroidParams{}.lowest.value == 20.0);
    CHECK(EnvelopeCentroidParams{}.highest.value == 1000.0);
    CHECK(ThesisMethodParams{}.quantise == 12);
    CHECK(ThirdOctaveVocoderParams{}.lowestCentre.value == 200.0);
    CHECK(ThirdOctaveVocoderParams{}.channels == 16);
    CHECK(ThirdOctaveVocoderParams{}.carrier.value == 100.0);
    CHECK(ThirdOctaveVocoderParams{}.range.low.value == 5.0);
    CHECK(ModulationParams{}.lowest.value == 100.0);
    CHECK(ModulationParams{}.highest.value == 8000.0);
    CHECK(ModulationParams{}.channels == 4);
    CHECK(ModulationParams{}.lowestCarrier.value == 60.0);
    CHECK(ModulationParams{}.highestCarrier.value == 400.0);
    CHECK(std::isinf(ThirdOctaveVocoderParams{}.range.high.value));
    const CentroidFlatnessParams flat;
    CHECK(test::asNumbers(flat.range.low.value, flat.lowCentroid.value, flat.highCentroid.value, flat.lowPitch.value,
                          flat.highPitch.value,
                          flat.highestPartial.value) == test::Numbers{5.0, 100.0, 10e3, 40.0, 400.0, 1e3});
    const MethodCurveParams curves;
    CHECK(test::asNumbers(curves.follower.attack.value, curves.follower.hold.value, curves.follower.release.value,
                          curves.trackRate.value,
                          curves.breakpoints) == test::Numbers{0.002, 0.010, 0.030, 1000.0, 20.0});
    CHECK(BandLimitParams{}.low.value == 5.0);
    CHECK(BandLimitParams{}.high.value == 1800.0);
    CHECK(MethodSound{}.fs == 48000.0);
    CHECK(MethodSound{}.gain == 1.0);
}

TEST_CASE("Parameters of methods beyond their ranges count as the ends of these", "[methods]")
{
    const double fs = 8000.0;
    const auto x = noise(4000, 3);
    const auto same = [](const Clip& a, const Clip& b)
    {
        return a.bands == b.bands && a.encoder == b.encoder && a.envelope == b.envelope;
    };
    const auto sineAt = [&](double f)
    {
        return envelopeSineClip(x, fs,
                                paramsWith<EnvelopeSineParams>([&](EnvelopeSineParams& p) { p.frequency = Hertz(f); }))
            .bands.front()
            .centreFrequency;
    };
    CHECK(sineAt(0.5) == 1.0);
    CHECK(sineAt(2.0) == 2.0);
    CHECK(sineAt(1e9) == 0.45 * fs);
    const auto centroid = [&](double low, double high)
    {
        return envelopeCentroidClip(x, fs,
                                    paramsWith<EnvelopeCentroidParams>(
                                        [&](EnvelopeCentroidParams& p)
                                        {
                                            p.lowest = Hertz(low);
                                            p.highest = Hertz(high);
                                        }));
    };
    CHECK(centroid(0.0, 500.0).bands[0].lowFrequency == 1.0);
    CHECK(centroid(1e9, 500.0).bands[0].lowFrequency == 0.45 * fs);
    CHECK(centroid(600.0, 500.0).bands[0].highFrequency == 600.0);
    CHECK(centroid(20.0, 1e9).bands[0].highFrequency == 0.45 * fs);
    CHECK(centroid(20.0, 500.0).bands[0].centreFrequency == Approx(100.0));
    const auto vocoder = [&](ThirdOctaveVocoderParams params)
    {
        return thirdOctaveVocoderClip(x, fs, params);
    };
    CHECK(vocoder(paramsWith<ThirdOctaveVocoderParams>([&](ThirdOctaveVocoderParams& p) { p.channels = 0; }))
              .bands.size() == 1);
    CHECK(vocoder(paramsWith<ThirdOctaveVocoderParams>(
                      [&](ThirdOctaveVocoderParams& p)
                      {
                          p.lowestCentre = Hertz(1.0);
                          p.channels = 40;
                      }))
              .bands.size() == 32);
    CHECK(same(vocoder(paramsWith<ThirdOctaveVocoderParams>(
                   [&](ThirdOctaveVocoderParams& p)
                   {
                       p.lowestCentre = Hertz(-5.0);
                       p.channels = 2;
                   })),
               vocoder(paramsWith<ThirdOctaveVocoderParams>(
                   [&](ThirdOctaveVocoderParams& p)
                   {
                       p.lowestCentre = Hertz(1.0);
                       p.channels = 2;
                   }))));
    CHECK(vocoder(paramsWith<ThirdOctaveVocoderParams>(
                      [&](ThirdOctaveVocoderParams& p)
                      {
                          p.channels = 1;
                          p.carrier = Hertz(0.1);
                      }))
              .bands[0]
              .pitch[0]
              .value == 1.0);
    CHECK(vocoder(paramsWith<ThirdOctaveVocoderParams>(
                      [&](ThirdOctaveVocoderParams& p)
                      {
                          p.channels = 1;
                          p.carrier = Hertz(1e9);
                      }))
              .bands[0]
              .pitch[0]
              .value == 0.45 * fs);
    const double edge = 0.45 * fs / std::exp2(1.0 / 6.0);
    CHECK(vocoder(paramsWith<ThirdOctaveVocoderParams>(
                      [&](ThirdOctaveVocoderParams& p)
                      {
                          p.lowestCentre = Hertz(0.999 * edge);
                          p.channels = 3;
                      }))
              .bands.size() == 1);
    CHECK(vocoder(paramsWith<ThirdOctaveVocoderParams>(
                      [&](ThirdOctaveVocoderParams& p)
                      {
                          p.lowestCentre = Hertz(1.001 * edge);
                          p.channels = 3;
                      }))
              .bands.empty());
    const auto thesis = [&](int bits)
    {
        return thesisClip(x, fs, paramsWith<ThesisMethodParams>([&](ThesisMethodParams& p) { p.quantise = bits; }));
    };
    CHECK(same(thesis(0), thesis(1)));
    CHECK(same(thesis(40), thesis(31)));
    CHECK_FALSE(same(thesis(1), thesis(2)));
    CHECK_FALSE(same(thesis(31), thesis(30)));
    CHECK(zeroPhaseLowpass(x, fs, {Hertz(500.0), 0}) == zeroPhaseLowpass(x, fs, {Hertz(500.0), 1}));
    CHECK(zeroPhaseLowpass(x, fs, {Hertz(500.0), 20}) == zeroPhaseLowpass(x, fs, {Hertz(500.0), 16}));
    CHECK(zeroPhaseLowpass(x, fs, {Hertz(0.0), 2}) == zeroPhaseLowpass(x, fs, {Hertz(1.0), 2}));
    CHECK(zeroPhaseLowpass(x, fs, {Hertz(1e9), 2}) == zeroPhaseLowpass(x, fs, {Hertz(0.4999 * fs), 2}));
    CHECK(zeroPhaseLowpass(x, fs, {Hertz(500.0), 15}) != zeroPhaseLowpass(x, fs, {Hertz(500.0), 16}));
    CHECK(zeroPhaseLowpass({}, fs).empty());
    const auto flatness = [&](CentroidFlatnessParams params)
    {
        return centroidFlatnessClip(x, fs, params);
    };
    CentroidFlatnessParams a, b;
    const auto check = [&](auto member, double given, double counts)
    {
        a = b = {};
        a.*member = Hertz(given);
        b.*member = Hertz(counts);
        CHECK(same(flatness(a), flatness(b)));
    };
    check(&CentroidFlatnessParams::lowCentroid, 0.2, 1.0);
    check(&CentroidFlatnessParams::lowPitch, 0.2, 1.0);
    check(&CentroidFlatnessParams::highPitch, 10.0, 80.0);
    check(&CentroidFlatnessParams::highPitch, 1e6, 0.45 * fs);
    check(&CentroidFlatnessParams::highCentroid, 20.0, 200.0);
    check(&CentroidFlatnessParams::highestPartial, 100.0, 400.0);
    check(&CentroidFlatnessParams::highestPartial, 1e6, 0.45 * fs);
    check(&CentroidFlatnessParams::lowPitch, 1e6, 0.2 * fs);
    MethodCurveParams many;
    many.breakpoints = 1e9;
    CHECK(clampedBreakpoints(many) == 1000.0);
    many.breakpoints = -1.0;
    CHECK(clampedBreakpoints(many) == 0.0);
}

TEST_CASE("Flatness of the spectrum within every range is what it was", "[methods]")
{
    const auto x = noise(3000, 8);
    for (const auto& [low, high] :
         {std::pair{0.0, 1e9}, {100.0, 3000.0}, {500.0, 501.0}, {1000.0, 900.0}, {3990.0, 1e9}})
    {
        std::vector<double> values;
        for (const Breakpoint& point : spectralFlatness(x, 8000.0, {{}, Hertz(low), Hertz(high)}))
            values.insert(values.end(), {point.time, point.value});
        checkPinned("analysis/flatness from " + std::to_string(static_cast<int>(low)) + " to " +
                        std::to_string(static_cast<int>(std::min(high, 1e6))),
                    values);
    }
    std::vector<double> partials;
    for (const double tonality : {0.0, 0.3, 0.7, 1.0})
        for (const auto& weights : {std::array{1.0, 1.0, 1.0, 1.0}, std::array{1.0, 0.5, 0.0, 0.0}})
        {
            double power = 0.0;
            for (const double a : detail::sineToSquare(tonality, weights))
            {
                partials.push_back(a);
                power += a * a;
            }
            CHECK(power == Approx(1.0));
        }
    checkPinned("analysis/partials from sine to square", partials);
    checkPinned("analysis/partials from sine to square, first", std::span<const double>(partials).first(24));
}

TEST_CASE("A curve with a point at the very end of the sound has one point there", "[methods]")
{
    MethodSound sound;
    sound.duration = Seconds(1.0);
    sound.active = Seconds(1.0);
    const Curve dense{{0.0, 0.0}, {0.5, 1.0}, {1.0, 0.25}, {1.5, 1.0}};
    MethodCurveParams params;
    params.breakpoints = 10.0;
    CHECK(methodCurve(dense, sound, params) == Curve{{0.0, 0.0}, {0.5, 1.0}, {1.0, 0.25}});
    sound.duration = Seconds(0.75);
    CHECK(methodCurve(dense, sound, params) == Curve{{0.0, 0.0}, {0.5, 1.0}, {0.75, 0.625}});
}
