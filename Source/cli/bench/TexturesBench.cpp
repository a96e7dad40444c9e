#include "cli/bench/Bench.h"
#include "cli/bench/Timed.h"

#include <pacini/filters/PolyphaseInterpolator.h>
#include <pacini/foundation/Gaussian.h>
#include <pacini/synthesis/NoiseBank.h>
#include <pacini/texture/TextureAnalysis.h>
#include <pacini/texture/TexturePlayer.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pacini::cli
{

namespace
{
constexpr int strokeRate = 8000;      // Hz of recordings
constexpr int driveRate = 48000;      // Hz of what is played
constexpr double strokeSeconds = 6.0; // of each
constexpr std::array trainedSpeeds = {0.125, 0.25, 0.5, 1.0};
constexpr std::array heldOutSpeeds = {0.18, 0.35, 0.7};

/// A surface that is made, and so known: a profile over the way, which is passed at any speed.
class MadeSurface
{
public:
    enum class Kind
    {
        ridges, ///< 150 of them a unit with uneven distances, three harmonics and a rough ground
        rough,  ///< noise that falls with spatial frequency
        tool,   ///< the same through the resonance of a tool at 220 Hz, which stays where it is
        engine, ///< orders 1, 2, 3 and 6 of 80 Hz at full speed, beside that tool
    };

    MadeSurface(Kind kindToMake, std::uint64_t seed) : kind(kindToMake), random(seed) {}

    /// The sound of a stroke at a constant speed; its level is proportional to the speed to the power of 0.8.
    [[nodiscard]] std::vector<float> stroke(double speed)
    {
        std::vector<float> samples(static_cast<std::size_t>(strokeSeconds * strokeRate));
        for (float& sample : samples)
            sample = static_cast<float>(0.1 * std::pow(speed, 0.8) * next(speed));
        return samples;
    }

private:
    static constexpr double wayStep = 1.0 / 4000.0;

    double next(double speed)
    {
        way += speed / (wayStep * strokeRate);
        while (way >= 1.0)
        {
            way -= 1.0;
            before = ground;
            ground += 0.1 * (random.next() - ground); // a low-pass over the way
        }
        const double rough = 3.0 * (before + (ground - before) * way);
        if (kind == Kind::rough)
            return rough;
        if (kind == Kind::tool)
            return resonate(rough);
        if (kind == Kind::engine)
        {
            phase += 80.0 * speed / strokeRate;
            double sum = 0.3 * resonate(rough);
            for (const auto& [order, level] :
                 {std::pair(1, 0.5), std::pair(2, 1.0), std::pair(3, 0.3), std::pair(6, 0.25)})
                sum += level * std::sin(2.0 * std::numbers::pi * order * phase + 0.7 * order);
            return sum;
        }
        const double passed = 150.0 * speed / strokeRate;
        phase += passed + 0.02 * std::sqrt(passed) * random.next();
        const double angle = 2.0 * std::numbers::pi * phase;
        return std::sin(angle) + 0.5 * std::sin(2.0 * angle + 1.0) + 0.25 * std::sin(3.0 * angle + 2.0) + 0.2 * rough;
    }

    double resonate(double x)
    {
        const double w = 2.0 * std::numbers::pi * 220.0 / strokeRate, q = 3.0;
        const double alpha = std::sin(w) / (2.0 * q);
        const double y = (x + 2.0 * std::cos(w) * one - (1.0 - alpha) * two) / (1.0 + alpha);
        two = std::exchange(one, y);
        return 0.3 * y;
    }

    Kind kind;
    Gaussian random;
    double way = 0.0, before = 0.0, ground = 0.0, phase = 0.0, one = 0.0, two = 0.0;
};

/// What the error is computed from: of one sound.
struct Portrait
{
    std::vector<PowerSpectrum> spectra; ///< mean ones of frames of 20 ms, 125 ms and 1 s
    std::vector<double> modulation;     ///< dB of the envelope's octaves from 1 to 32 Hz, re its mean
};

Portrait portraitOf(std::span<const float> samples, int rate)
{
    Portrait portrait;
    const auto band = pacini::detail::textureBand(samples, rate);
    for (const std::size_t window : {96u, 600u, 4800u})
    {
        PowerSpectrum mean;
        double frames = 0.0;
        pacini::detail::forEachTextureSpectrum(band, window,
                                               [&](double, const PowerSpectrum& spectrum)
                                               {
                                                   mean.step = spectrum.step;
                                                   mean.power.resize(spectrum.power.size(), 0.0);
                                                   for (std::size_t k = 0; k < mean.power.size(); ++k)
                                                       mean.power[k] += spectrum.power[k];
                                                   frames += 1.0;
                                               });
        for (double& power : mean.power)
            power /= frames;
        portrait.spectra.push_back(std::move(mean));
    }
    // The level in steps of 10 ms.
    constexpr std::size_t step = 48;
    std::vector<double> level;
    double whole = 0.0;
    for (std::size_t n = 0; n + step <= band.size(); n += step)
    {
        double sum = 0.0;
        for (const float x : std::span(band).subspan(n, step))
            sum += static_cast<double>(x) * static_cast<double>(x);
        level.push_back(std::sqrt(sum));
        whole += level.back();
    }
    const double mean = whole / static_cast<double>(level.size());
    for (double f = 1.0; f < 32.0; f *= 2.0)
    {
        double power = 0.0;
        constexpr int lines = 8;
        for (int i = 0; i < lines; ++i)
        {
            const double turn = 2.0 * std::numbers::pi * f * std::exp2((i + 0.5) / lines) / 100.0;
            std::complex<double> sum = 0.0;
            for (std::size_t n = 0; n < level.size(); ++n)
                sum += (level[n] / mean - 1.0) * std::polar(1.0, turn * static_cast<double>(n));
            power += f * std::norm(sum);
        }
        portrait.modulation.push_back(10.0 * std::log10(power + 1e-12));
    }
    return portrait;
}

double spectralError(const Portrait& one, const Portrait& other)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < one.spectra.size(); ++i)
        sum += pacini::detail::textureDistance(one.spectra[i], other.spectra[i]);
    return sum / static_cast<double>(one.spectra.size());
}

double modulationError(const Portrait& one, const Portrait& other)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < one.modulation.size(); ++i)
        sum += std::pow(one.modulation[i] - other.modulation[i], 2.0);
    return std::sqrt(sum / static_cast<double>(one.modulation.size()));
}

/// The largest autocorrelation at 50 ms to 2 s, re that at 0.
double repetition(std::span<const float> samples)
{
    const auto band = pacini::detail::textureBand(samples, driveRate);
    const std::size_t first = 240, last = std::min<std::size_t>(9600, band.size());
    ComplexFft<double> fft(nextFastFftSize(band.size() + last));
    std::vector<std::complex<double>> padded(fft.size()), spectrum(fft.size());
    for (std::size_t n = 0; n < band.size(); ++n)
        padded[n] = static_cast<double>(band[n]);
    fft.forward(padded, spectrum);
    for (auto& bin : spectrum)
        bin = std::norm(bin);
    fft.inverse(spectrum, padded);
    double most = 0.0;
    for (std::size_t lag = first; lag < last; ++lag)
        most = std::max(most, std::abs(padded[lag].real()) / padded[0].real());
    return most;
}

/// The recordings of all trained speeds, one after the other.
struct Training
{
    std::vector<float> samples;
    TextureMotion motion;
};

/// A form of texture, made of recordings: plays at a speed.
using Played = Timed<std::vector<float>>;
using Play = std::function<Played(double speed, int repeats)>;

Result<Texture> textureOf(const Training& training, int order, int tones = 0)
{
    TextureParams params;
    params.order = order;
    params.tones = tones;
    auto fit = analyseTexture(training.samples, strokeRate, training.motion, params);
    if (!fit)
        return fit.error();
    return std::move(fit->texture);
}

constexpr auto playedFrames = static_cast<std::size_t>(strokeSeconds * driveRate);

Play texturePlay(const Training& training, int order, int tones)
{
    const auto texture = textureOf(training, order, tones);
    if (!texture)
        return {};
    return [table = std::make_shared<const TextureTable>(*texture, driveRate)](double speed, int repeats)
    {
        return timed(repeats,
                     [&]
                     {
                         TexturePlayer player(table);
                         player.setSpeed(speed);
                         std::vector<float> out(playedFrames);
                         player.process(out);
                         return out;
                     });
    };
}

Play autoregressive(const Training& training, int order)
{
    return texturePlay(training, order, 0);
}

/// With tones that follow the speed, as textures are made.
Play withTones(const Training& training, int order)
{
    return texturePlay(training, order, TextureParams().tones);
}

/// With at most so many tones beside the usual noise.
Play numberOfTones(const Training& training, int count)
{
    return texturePlay(training, TextureParams().order, count);
}

/// Bands of noise from 20 to 1000 Hz, equally wide in octaves; levels as a texture of order 64 has them, by the same
/// interpolation.
Play noiseBands(const Training& training, int count)
{
    const auto texture = textureOf(training, 64);
    if (!texture)
        return {};
    return [texture = *texture, count](double speed, int repeats)
    {
        constexpr double innerRate = 2400.0;
        const TextureLaw law(texture);
        const PowerSpectrum spectrum = law.spectrum(speed);
        const double whole = spectrum.sum(textureLow, textureHigh);
        std::vector<NoiseCarrier> carriers;
        for (int k = 0; k < count; ++k)
        {
            const auto edge = [&](int i)
            {
                return textureLow * std::pow(textureHigh / textureLow, static_cast<double>(i) / count);
            };
            const double low = edge(k), high = edge(k + 1);
            double density = 0.0;
            constexpr int points = 32;
            for (int i = 0; i < points; ++i)
                density += spectrum.at(low + (high - low) * (i + 0.5) / points) / points;
            const double rms = law.level(speed) * std::sqrt(density * (high - low) / whole);
            carriers.push_back({{{0.0, rms}}, 0.5 * (low + high) / innerRate, 0.5 * (high - low) / innerRate});
        }
        return timed(repeats,
                     [&]
                     {
                         constexpr std::size_t hop = 64, ratio = 20;
                         NoiseBank bank(carriers, 1);
                         PolyphaseInterpolator interpolator(ratio, textureHigh / innerRate);
                         std::vector<float> out(playedFrames);
                         std::array<double, hop> re{}, im{};
                         std::array<float, hop> inner{};
                         for (std::size_t n = 0; n + hop * ratio <= out.size(); n += hop * ratio)
                         {
                             re.fill(0.0);
                             im.fill(0.0);
                             bank.process(re, im);
                             std::transform(im.begin(), im.end(), inner.begin(),
                                            [](double x) { return static_cast<float>(x); });
                             interpolator.process(inner, std::span(out).subspan(n, hop * ratio));
                         }
                         return out;
                     });
    };
}

/// A second of the recording nearest in speed, played over and over at the ratio of the speeds.
Play loop(const Training& training, int)
{
    return [&training](double speed, int repeats)
    {
        std::size_t nearest = 0;
        const auto distance = [speed](double other)
        {
            return std::abs(std::log(speed / other));
        };
        for (std::size_t i = 1; i < trainedSpeeds.size(); ++i)
            if (distance(trainedSpeeds[i]) < distance(trainedSpeeds[nearest]))
                nearest = i;
        const double ratio = speed / trainedSpeeds[nearest];
        const auto piece =
            std::span(training.samples)
                .subspan(nearest * static_cast<std::size_t>(strokeSeconds * strokeRate) + strokeRate, strokeRate + 1);
        return timed(repeats,
                     [&]
                     {
                         std::vector<float> out(playedFrames);
                         const auto gain = static_cast<float>(std::pow(ratio, 0.8));
                         double place = 0.0;
                         for (float& sample : out)
                         {
                             const auto i = static_cast<std::size_t>(place);
                             const auto share = static_cast<float>(place - static_cast<double>(i));
                             sample = gain * (piece[i] + (piece[i + 1] - piece[i]) * share);
                             place += ratio * strokeRate / driveRate;
                             if (place >= strokeRate)
                                 place -= strokeRate;
                         }
                         return out;
                     });
    };
}

struct TextureForm
{
    const char* name;
    Play (*make)(const Training& training, int size);
    std::vector<int> sizes;
};

void measureTextures(const BenchSound&, const BenchSettings& settings, BenchTable& rows)
{
    const std::array forms = {TextureForm{"autoregressive", autoregressive, {2, 4, 8, 12, 16, 24, 32, 48, 64}},
                              TextureForm{"with tones", withTones, {2, 8, 16, 32}},
                              TextureForm{"number of tones", numberOfTones, {1, 2, 3, 4, 8}},
                              TextureForm{"noise bands", noiseBands, {1, 4, 8, 12, 16, 24}},
                              TextureForm{"loop", loop, {1}}};
    using Kind = MadeSurface::Kind;
    for (const auto& [name, kind] : {std::pair("ridges", Kind::ridges), std::pair("rough", Kind::rough),
                                     std::pair("tool", Kind::tool), std::pair("engine", Kind::engine)})
    {
        Training training;
        MadeSurface here(kind, 1), elsewhere(kind, 2);
        double time = 0.0;
        for (const double speed : trainedSpeeds)
        {
            const auto stroke = here.stroke(speed);
            training.samples.insert(training.samples.end(), stroke.begin(), stroke.end());
            training.motion.speed.push_back({time, speed});
            training.motion.speed.push_back({time += strokeSeconds, speed});
        }
        for (const bool heldOut : {false, true})
        {
            const std::span<const double> speeds =
                heldOut ? std::span<const double>(heldOutSpeeds) : std::span<const double>(trainedSpeeds);
            std::vector<Portrait> wanted;
            for (const double speed : speeds)
                wanted.push_back(portraitOf(elsewhere.stroke(speed), strokeRate));
            for (const TextureForm& form : forms)
                for (const int size : form.sizes)
                {
                    const Play play = form.make(training, size);
                    if (!play)
                        continue;
                    double error = 0.0, modulation = 0.0, repeats = 0.0, seconds = 0.0;
                    for (std::size_t i = 0; i < speeds.size(); ++i)
                    {
                        const Played played = play(speeds[i], settings.repeats);
                        const Portrait found = portraitOf(played.result, driveRate);
                        const double share = 1.0 / static_cast<double>(speeds.size());
                        error += share * spectralError(found, wanted[i]);
                        modulation += share * modulationError(found, wanted[i]);
                        repeats = std::max(repeats, repetition(played.result));
                        seconds += played.seconds;
                    }
                    const double frames = static_cast<double>(playedFrames * speeds.size());
                    rows.add({"made", name, heldOut ? "held out" : "trained", form.name, fmt::format("{}", size),
                              frames, seconds, frames / driveRate, error, modulation, repeats});
                }
        }
    }
}
} // namespace

Bench texturesBench()
{
    return {
        "textures",
        "Textures by movement",
        "Strokes over three made surfaces (no recordings with a known speed may be shipped): ridges with harmonics, "
        "a rough ground, and that through the resonance of a tool; beside them an engine of four orders. Each form is "
        "made of strokes at four speeds and "
        "plays 6 s at 48 kHz at these or at three others, against strokes over another place of the same surface. "
        "The error is the RMS difference in sixths of octaves from 25 to 950 Hz, mean of spectra of 20 ms, 125 ms "
        "and 1 s; modulation is that of the envelope's octaves from 1 to 32 Hz; repetition is the largest "
        "autocorrelation at 50 ms to 2 s. A size is an order or a number of bands from 20 to 1000 Hz (1: noise that "
        "is only band-limited), or the most tones beside noise of order 32; the loop is a second of the recording "
        "nearest in speed.",
        columnsOf({"surface", "speeds", "form", "size"},
                  {summed("frames"),
                   summed("seconds", "s"),
                   summed("duration", "s"),
                   {"error", "dB"},
                   {"modulation", "dB"},
                   {"repetition", ""},
                   {"time", "ns/frame", Reduction::ratio, "seconds", "frames", 1e9},
                   {"realTime", "x", Reduction::ratio, "duration", "seconds", 1.0}}),
        {{"ridges", "Textures: ridges", "form", "time", "error", "size", "surface", "ridges"},
         {"rough", "Textures: rough ground", "form", "time", "error", "size", "surface", "rough"},
         {"engine", "Textures: engine", "form", "time", "error", "size", "surface", "engine"}},
        {},
        measureTextures,
        false};
}

} // namespace pacini::cli
