#include "support/Catch.h"
#include "support/Numbers.h"
#include "support/Pinned.h"

#include <pacini/analysis/ClipFitter.h>
#include <pacini/analysis/Encoder.h>
#include <pacini/foundation/Random.h>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

using namespace pacini;

namespace
{
/// Frames of a sound of `seconds` in three bands: levels and pitches that wander, and a pause.
BandAnalysisResult fittedFrames(double seconds, double level, std::uint64_t seed)
{
    Random random(seed);
    BandAnalysisResult found;
    found.tracks.resize(3);
    double wander = 0.0;
    for (std::size_t i = 0; i <= static_cast<std::size_t>(std::floor(seconds / 0.005 + 0.5)); ++i)
    {
        wander = 0.95 * wander + random.uniform(-0.3, 0.3);
        const double t = 0.005 * static_cast<double>(i);
        const bool pause = t > 0.6 && t < 0.8;
        found.envelope.push_back(static_cast<float>(pause ? 0.0 : level * std::exp(wander - 1.0)));
    }
    for (std::size_t i = 0; i <= static_cast<std::size_t>(std::floor(seconds / 0.02 + 0.5)); ++i)
        for (std::size_t k = 0; k < 3; ++k)
        {
            const double t = 0.02 * static_cast<double>(i);
            const bool pause = t > 0.6 && t < 0.8;
            const double swell = 0.5 + 0.45 * std::sin(7.0 * t + static_cast<double>(k));
            found.tracks[k].amplitude.push_back(
                static_cast<float>(pause ? 0.0 : level * swell * std::exp(random.uniform(-0.4, 0.4))));
            found.tracks[k].frequency.push_back(static_cast<float>(
                pause ? 0.0 : 60.0 * std::pow(3.0, static_cast<double>(k)) * std::exp(random.uniform(-0.2, 0.2))));
        }
    return found;
}

Clip clipOfThreeBands()
{
    Clip clip;
    for (const BandEdges& edge : tiledBands(3, 30.0, 1000.0, BandSpacing::logarithmic))
        clip.bands.push_back({edge.low, edge.centre, edge.high, 0, {}, {}});
    return clip;
}

void pinCurve(const std::string& name, const Curve& curve)
{
    std::vector<double> times, values;
    for (const Breakpoint& point : curve)
    {
        times.push_back(point.time);
        values.push_back(point.value);
    }
    checkPinned("analysis/" + name + ", times", times, 1e-5);
    checkPinned("analysis/" + name + ", values", values, 1e-5);
}

void pinFitted(const std::string& name, const Clip& clip)
{
    pinCurve(name + ", envelope", clip.envelope);
    pinCurve(name + ", centroid", clip.centroid);
    for (std::size_t k = 0; k < clip.bands.size(); ++k)
    {
        pinCurve(name + ", amplitude " + std::to_string(k), clip.bands[k].amplitude);
        pinCurve(name + ", pitch " + std::to_string(k), clip.bands[k].pitch);
    }
}

template <typename Change>
EncoderParams encoderWith(Change change)
{
    EncoderParams params;
    change(params);
    return params;
}

/// A chord under a tremolo with clicks, in hiss.
std::vector<float> encodedSound(double fs, double seconds)
{
    Random random(20);
    std::vector<float> x(static_cast<std::size_t>(fs * seconds));
    for (std::size_t n = 0; n < x.size(); ++n)
    {
        const double t = static_cast<double>(n) / fs;
        const double w = 2.0 * std::numbers::pi * t;
        x[n] = static_cast<float>(
            0.3 * (1.2 + std::sin(3.1 * w)) * std::sin(55.0 * w) + 0.2 * std::sin(130.0 * w + 3.0 * std::sin(1.7 * w)) +
            0.6 * std::exp(-std::fmod(t, 0.29) / 0.01) * std::sin(400.0 * w) + random.uniform(-0.05, 0.05));
    }
    return x;
}
} // namespace

TEST_CASE("Curves fitted to loud, quiet and unfelt sounds are what they were", "[analysis]")
{
    for (const auto& [name, level, gain, points] : {std::tuple{"ordinary", 0.5, 1.0, 20.0},
                                                    {"few points", 0.5, 1.0, 2.0},
                                                    {"many points", 0.5, 1.0, 100.0},
                                                    {"raised", 1e-4, 3000.0, 20.0},
                                                    {"quiet", 0.02, 1.0, 20.0},
                                                    {"unfelt", 0.001, 1.0, 20.0}})
    {
        Clip clip = clipOfThreeBands();
        ClipFitter fitter(points);
        fitter.add(clip, fittedFrames(1.5, level, 3), gain, 0.0);
        pinFitted(std::string("fitted clip, ") + name, clip);
        const auto cap = points * 3.0 * 1.5 + 2.0 * 5.0;
        CHECK(static_cast<double>(breakpointCount(clip)) <= cap);
    }
    Clip shortest = clipOfThreeBands();
    ClipFitter fitter(20.0);
    fitter.add(shortest, fittedFrames(0.0, 0.5, 3), 1.0, 0.0);
    pinFitted("fitted clip of one frame", shortest);
}

TEST_CASE("Sections join where one ends and the next begins, sounding or silent", "[analysis]")
{
    for (const auto& [name, first, second] : {std::tuple{"both sound", 0.5, 0.5},
                                              {"silence follows", 0.5, 0.0},
                                              {"sound follows", 0.0, 0.5},
                                              {"both silent", 0.0, 0.0}})
    {
        Clip clip = clipOfThreeBands();
        ClipFitter fitter(20.0);
        fitter.add(clip, fittedFrames(1.2, first, 5), 1.0, 0.0);
        fitter.add(clip, fittedFrames(0.9, second, 6), 1.0, 1.2);
        pinFitted(std::string("joined clip, ") + name, clip);
        const auto rises = [](const Curve& curve)
        {
            for (std::size_t i = 1; i < curve.size(); ++i)
                if (curve[i].time < curve[i - 1].time)
                    return false;
            return true;
        };
        CHECK(rises(clip.envelope));
        CHECK(rises(clip.centroid));
        for (const Band& band : clip.bands)
        {
            CHECK(rises(band.amplitude));
            CHECK(rises(band.pitch));
        }
    }
    // A steady pitch is one point for its whole section, and so until a step before the next.
    auto steady = fittedFrames(1.2, 0.5, 5);
    for (auto& track : steady.tracks)
        for (float& f : track.frequency)
            f = 100.0f;
    Clip clip = clipOfThreeBands();
    ClipFitter fitter(20.0);
    fitter.add(clip, steady, 1.0, 0.0);
    REQUIRE(clip.bands[1].pitch.size() == 1);
    fitter.add(clip, fittedFrames(0.9, 0.5, 6), 1.0, 1.2);
    REQUIRE(clip.bands[1].pitch.size() > 2);
    CHECK(clip.bands[1].pitch[1].time == Approx(1.14));
    CHECK(clip.bands[1].pitch[1].value == clip.bands[1].pitch[0].value);
    CHECK(clip.bands[1].pitch[2].time == Approx(1.2));
    pinFitted("joined clip, steady pitch", clip);
}

TEST_CASE("Levels of noise bands are fitted, counted and joined as those of bands", "[analysis]")
{
    const auto withNoise = [](BandAnalysisResult found)
    {
        found.noise = {found.tracks[2].amplitude, std::vector<float>(found.tracks[0].amplitude.size(), 0.0f)};
        return found;
    };
    const auto begun = []
    {
        Clip clip = clipOfThreeBands();
        clip.noise = {{300.0, 1000.0, {}}, {30.0, 300.0, {}}};
        clip.duration = 6.0;
        return clip;
    };
    Clip clip = begun();
    ClipFitter fitter(100.0);
    fitter.add(clip, withNoise(fittedFrames(1.5, 0.5, 3)), 1.0, 0.0);
    CHECK(clip.noise[0].amplitude == clip.bands[2].amplitude);
    CHECK(clip.noise[1].amplitude.empty());
    CHECK(validate(clip).ok());
    CHECK(clip.noise[0].lowFrequency == 300.0);
    // Noise takes its share of importance from the pitches, and draws the centroid up.
    Clip plain = clipOfThreeBands();
    fitter.add(plain, fittedFrames(1.5, 0.5, 3), 1.0, 0.0);
    CHECK(clip.bands[0].amplitude == plain.bands[0].amplitude);
    CHECK(clip.envelope == plain.envelope);
    CHECK(valueAt(clip.centroid, 0.3) > valueAt(plain.centroid, 0.3));
    CHECK(clip.bands[0].pitch.size() <= plain.bands[0].pitch.size());
    // The cap counts noise bands as bands.
    for (const double points : {2.0, 5.0})
    {
        Clip capped = begun();
        ClipFitter few(points);
        few.add(capped, withNoise(fittedFrames(6.0, 0.5, 3)), 1.0, 0.0);
        CHECK(static_cast<double>(breakpointCount(capped)) <= points * 5.0 * 6.0 + 2.0 * 7.0);
    }
    // Cut in two and joined, it is nearly what it was.
    auto all = withNoise(fittedFrames(6.0, 0.5, 3));
    Clip whole = begun();
    fitter.add(whole, all, 1.0, 0.0);
    Clip joined = begun();
    const auto first = all.takeFirst(3.0);
    REQUIRE(first.noise.size() == 2);
    CHECK(first.noise[0].size() == 151);
    CHECK(all.noise[0].size() == 151);
    CHECK(first.noise[0].back() == all.noise[0].front());
    fitter.add(joined, first, 1.0, 0.0);
    fitter.add(joined, all, 1.0, 3.0);
    for (double t = 0.1; t < 6.0; t += 0.05)
        CHECK(valueAt(joined.noise[0].amplitude, t) == Approx(valueAt(whole.noise[0].amplitude, t)).margin(0.15));
    CHECK(validate(joined).ok());
}

TEST_CASE("Clips of a mixed sound are what they were, whatever the encoder is told", "[analysis][encoder]")
{
    const auto pin = [](const std::string& name, const EncoderParams& params, int channels = 1)
    {
        const auto x = encodedSound(8000.0 * channels, 1.1);
        Encoder encoder(params);
        encoder.start(8000, channels);
        encoder.push(
            std::span(x).first(x.size() / static_cast<std::size_t>(channels) * static_cast<std::size_t>(channels)));
        const Clip clip = encoder.finish();
        std::vector<double> rest{clip.duration, clip.source.sampleRate, static_cast<double>(clip.source.channels)};
        for (const Band& band : clip.bands)
            rest.push_back(band.priority);
        for (const Transient& transient : clip.transients)
            rest.insert(rest.end(), {transient.time, transient.amplitude, transient.sharpness});
        for (const auto& parameter : clip.encoder)
            if (const auto* number = std::get_if<double>(&parameter.value))
                rest.push_back(*number);
        checkPinned("analysis/encoded, " + name, rest, 1e-4);
        pinFitted("encoded, " + name, clip);
    };
    pin("by default", {});
    pin("of the bands alone", encoderWith([](EncoderParams& p) { p.audible = 0.0; }));
    pin("as loud as it was", encoderWith([](EncoderParams& p) { p.normalise = false; }));
    pin("three linear bands", encoderWith(
                                  [](EncoderParams& p)
                                  {
                                      p.bands = 3;
                                      p.lowFrequency = 20.0;
                                      p.highFrequency = 400.0;
                                      p.spacing = BandSpacing::linear;
                                  }));
    EncoderParams sensitive = encoderWith([](EncoderParams& p) { p.breakpoints = 60.0; });
    sensitive.onsets.sensitivity = 2.0;
    pin("sensitive", sensitive, 2);
}

TEST_CASE("The record of an encoder has what is not the default, and what older clips have not", "[analysis][encoder]")
{
    const auto names = [](const EncoderParams& params)
    {
        std::string all;
        for (const auto& parameter : encoderRecord(params))
            all += parameter.name + " ";
        return all;
    };
    CHECK(names({}) == "method bands breakpoints quantise audible heard ");
    CHECK(names(encoderWith([](EncoderParams& p) { p.lowFrequency = 31.0; })) ==
          "method bands breakpoints quantise low audible heard ");
    CHECK(names(encoderWith([](EncoderParams& p) { p.highFrequency = 999.0; })) ==
          "method bands breakpoints quantise high audible heard ");
    CHECK(names(encoderWith([](EncoderParams& p) { p.spacing = BandSpacing::linear; })) ==
          "method bands breakpoints quantise spacing audible heard ");
    CHECK(names(encoderWith([](EncoderParams& p) { p.normalise = false; })) ==
          "method bands breakpoints quantise audible heard normalise ");
    EncoderParams params;
    params.onsets.sensitivity = 2.0;
    CHECK(names(params) == "method bands breakpoints quantise sensitivity audible heard ");
    CHECK(test::asNumbers(params.bands, params.lowFrequency, params.highFrequency, params.breakpoints, params.quantise,
                          params.normalise) == test::Numbers{12, 30.0, 1000.0, 20.0, 6, true});
}

TEST_CASE("Wrong parameters of the encoder are explained", "[analysis][encoder]")
{
    const auto message = [](const EncoderParams& params)
    {
        const auto error = validate(params).error();
        CHECK(error.code == ErrorCode::invalidArgument);
        return error.where + ": " + error.message;
    };
    CHECK(message(encoderWith([](EncoderParams& p) { p.bands = 0; })) == "bands: must be 1 to 32");
    CHECK(message(encoderWith([](EncoderParams& p) { p.lowFrequency = 0.0; })) == "low: must be 1 to 1700 Hz");
    CHECK(message(encoderWith([](EncoderParams& p) { p.breakpoints = 0.0; })) ==
          "breakpoints: must be 0.5 to 1000 per second and band");
    CHECK(message(encoderWith([](EncoderParams& p) { p.quantise = 17; })) == "quantise: must be 4 to 16 bits");
    EncoderParams params;
    params.onsets.sensitivity = 5.0;
    CHECK(message(params) == "sensitivity: must be 0.25 to 4");
}
