#pragma once

// Analysis of a recording of a stroke as a texture.

#include <pacini/clip/Curve.h>
#include <pacini/filters/RationalDecimator.h>
#include <pacini/foundation/DspBlock.h>
#include <pacini/foundation/Fft.h>
#include <pacini/foundation/NumberText.h>
#include <pacini/foundation/Result.h>
#include <pacini/foundation/Windows.h>
#include <pacini/texture/AutoRegression.h>
#include <pacini/texture/Texture.h>
#include <pacini/texture/TextureParams.h>
#include <pacini/texture/TextureTones.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pacini
{

/// Speed and force over the time of a recording, in s and any units from 0. Without points of a speed it is constant;
/// without points of a force that is 1.
struct TextureMotion
{
    Curve speed;
    Curve force;
};

/// A texture and what is to be said of its analysis.
struct TextureFit
{
    Texture texture;
    std::size_t frames = 0;    ///< short spectra that were used
    bool pitchAssumed = false; ///< neither given nor measured; likewise the exponents of the level
    bool speedLawAssumed = false;
    bool forceLawAssumed = false;
    std::vector<std::string> warnings; ///< of the motion, such as a table that does not cover the recording
};

namespace detail
{

inline constexpr int textureAnalysisRate = 4800; ///< Hz

/// One short spectrum of a recording.
struct TextureFrame
{
    double speed = 0.0, force = 1.0; ///< 0 to 1, in its middle
    double power = 0.0;              ///< between 20 and 1000 Hz
    PowerSpectrum spectrum;          ///< up to 1200 Hz
};

/// Spectra of overlapping frames of `window` samples at the rate of the analysis; visit(middle, spectrum), in s.
template <typename Visit>
void forEachTextureSpectrum(std::span<const float> samples, std::size_t window, Visit&& visit)
{
    const auto weights = hannPeriodic(window);
    double energy = 0.0;
    for (const double weight : weights)
        energy += weight * weight;
    RealFft<double> fft(window);
    std::vector<double> frame(window);
    std::vector<std::complex<double>> transform(fft.bins());
    constexpr double rate = textureAnalysisRate;
    for (std::size_t start = 0; start + window <= samples.size(); start += window / 2)
    {
        for (std::size_t i = 0; i < window; ++i)
            frame[i] = weights[i] * static_cast<double>(samples[start + i]);
        fft.forward(frame, transform);
        PowerSpectrum spectrum{rate / static_cast<double>(window), {}};
        for (std::size_t bin = 0; spectrum.frequency(bin) <= 0.5 * textureRate; ++bin)
            spectrum.power.push_back(2.0 * std::norm(transform[bin]) / (energy * rate));
        visit((static_cast<double>(start) + 0.5 * static_cast<double>(window)) / rate, std::move(spectrum));
    }
}

/// Least squares of y over x and z, which may have no spread: the slopes of those that do.
struct TextureSlopes
{
    std::optional<double> x, z;
};
inline TextureSlopes textureSlopes(std::span<const double> x, std::span<const double> z, std::span<const double> y)
{
    const auto mean = [](std::span<const double> values)
    {
        double sum = 0.0;
        for (const double value : values)
            sum += value;
        return sum / static_cast<double>(values.size());
    };
    const double mx = mean(x), mz = mean(z), my = mean(y);
    double xx = 0.0, xz = 0.0, zz = 0.0, xy = 0.0, zy = 0.0;
    for (std::size_t i = 0; i < y.size(); ++i)
    {
        xx += (x[i] - mx) * (x[i] - mx);
        xz += (x[i] - mx) * (z[i] - mz);
        zz += (z[i] - mz) * (z[i] - mz);
        xy += (x[i] - mx) * (y[i] - my);
        zy += (z[i] - mz) * (y[i] - my);
    }
    // A law needs a spread of a fifth, and one that the other quantity does not have alike.
    const double least = 0.04 * static_cast<double>(y.size());
    const bool byX = xx > least, byZ = zz > least;
    TextureSlopes slopes;
    if (byX && byZ && xz * xz < 0.9 * xx * zz)
    {
        const double determinant = xx * zz - xz * xz;
        slopes.x = (xy * zz - zy * xz) / determinant;
        slopes.z = (zy * xx - xy * xz) / determinant;
    }
    else if (byX)
        slopes.x = xy / xx;
    else if (byZ)
        slopes.z = zy / zz;
    return slopes;
}

/// RMS difference of two spectra in dB, in sixths of octaves from 25 to 950 Hz, where one is within 40 dB of its most.
inline double textureDistance(const PowerSpectrum& one, const PowerSpectrum& other)
{
    constexpr int bands = 32;
    constexpr double low = 25.0, high = 950.0;
    std::vector<double> a, b;
    for (int k = 0; k < bands; ++k)
    {
        const double from = low * std::pow(high / low, static_cast<double>(k) / bands);
        const double to = low * std::pow(high / low, static_cast<double>(k + 1) / bands);
        double sumA = 0.0, sumB = 0.0;
        constexpr int points = 8;
        for (int i = 0; i < points; ++i)
        {
            const double f = from + (to - from) * (static_cast<double>(i) + 0.5) / points;
            sumA += one.at(f) * (to - from);
            sumB += other.at(f) * (to - from);
        }
        a.push_back(sumA);
        b.push_back(sumB);
    }
    const double mostA = *std::max_element(a.begin(), a.end()), mostB = *std::max_element(b.begin(), b.end());
    double sum = 0.0;
    int counted = 0;
    for (std::size_t k = 0; k < a.size(); ++k)
        if (a[k] > 1e-4 * mostA || b[k] > 1e-4 * mostB)
        {
            const double difference = 10.0 * std::log10((a[k] + 1e-30) / (b[k] + 1e-30));
            sum += difference * difference;
            ++counted;
        }
    return counted > 0 ? std::sqrt(sum / counted) : 0.0;
}

/// The power of the speed with which the spectra of nodes move: the one for which neighbours, moved to the geometric
/// middle of their speeds, differ least. 1 for a single node.
inline double texturePitch(const Texture& texture)
{
    std::vector<PowerSpectrum> spectra;
    for (const TextureNode& node : texture.nodes)
        spectra.push_back(spectrumOf(node.reflection, 600, textureRate));
    const auto moved = [](const PowerSpectrum& spectrum, double shift)
    {
        PowerSpectrum result = spectrum;
        for (std::size_t bin = 0; bin < result.power.size(); ++bin)
            result.power[bin] = spectrum.at(spectrum.frequency(bin) / shift);
        const double whole = result.sum(textureLow, textureHigh);
        for (double& power : result.power)
            power /= whole;
        return result;
    };
    double best = 1.0, least = std::numeric_limits<double>::infinity();
    constexpr int steps = 20;
    for (int step = steps; step >= 0; --step)
    {
        const double pitch = static_cast<double>(step) / steps;
        double distance = 0.0;
        for (std::size_t i = 0; i + 1 < spectra.size(); ++i)
        {
            const double shift = std::pow(texture.nodes[i + 1].speed / texture.nodes[i].speed, 0.5 * pitch);
            distance += textureDistance(moved(spectra[i], shift), moved(spectra[i + 1], 1.0 / shift));
        }
        if (distance < least)
        {
            least = distance;
            best = pitch;
        }
    }
    return best;
}

/// The recording at the rate of the analysis; samples that are not finite are 0.
[[nodiscard]] inline std::vector<float> textureBand(std::span<const float> samples, int sampleRate)
{
    std::vector<float> finite(samples.size()), decimated;
    std::transform(samples.begin(), samples.end(), finite.begin(),
                   [](float x) { return static_cast<float>(finiteOrZero(x)); });
    RationalDecimator decimator(sampleRate, textureAnalysisRate, {Hertz(1200.0), Hertz(3600.0), Decibels(60.0)});
    decimator.push(finite, decimated);
    decimator.finish(decimated);
    return decimated;
}

/// Whether the speed mostly stays the same within 5 % over a quarter of a second.
[[nodiscard]] inline bool isSteady(const Curve& speed, double duration)
{
    constexpr double quarter = 0.25;
    int steady = 0, all = 0;
    for (double time = 0.0; time + quarter <= duration; time += quarter, ++all)
    {
        const double from = valueAt(speed, time), to = valueAt(speed, time + quarter);
        steady += std::abs(to - from) <= 0.05 * std::max(from, to) ? 1 : 0;
    }
    return 2 * steady >= all;
}

/// Samples of a frame of a recording of that length: 250 ms, or half of that where the speed changes much.
[[nodiscard]] inline std::size_t textureWindow(const TextureMotion& motion, std::size_t samples)
{
    const bool steady = isSteady(motion.speed, static_cast<double>(samples) / textureAnalysisRate);
    return static_cast<std::size_t>(textureAnalysisRate / (steady ? 4 : 8));
}

/// The short spectra of a recording, loud enough and moving, with speed and force in parts of the full ones.
[[nodiscard]] inline Result<std::vector<TextureFrame>>
textureFrames(std::span<const float> band, const TextureMotion& motion, const Texture& texture, double constantSpeed)
{
    constexpr double lowest = 0.01;
    const bool moves = !motion.speed.empty(), presses = !motion.force.empty();
    const std::size_t window = textureWindow(motion, band.size());
    if (band.size() < window)
        return Error{ErrorCode::invalidData, "", "is too short for a texture; record a second or more"};
    std::vector<TextureFrame> frames;
    double most = 0.0;
    forEachTextureSpectrum(
        band, window,
        [&](double middle, PowerSpectrum spectrum)
        {
            TextureFrame frame;
            frame.speed = moves ? std::min(valueAt(motion.speed, middle) / texture.fullSpeed, 1.0) : constantSpeed;
            frame.force = presses ? std::min(valueAt(motion.force, middle) / texture.fullForce, 1.0) : 1.0;
            frame.power = spectrum.sum(textureLow, textureHigh);
            frame.spectrum = std::move(spectrum);
            if (!(frame.speed >= lowest && frame.force >= lowest))
                return;
            most = std::max(most, frame.power);
            frames.push_back(std::move(frame));
        });
    if (frames.empty())
        return Error{ErrorCode::invalidData, "", "is at rest throughout, by its speed and force"};
    if (!(most > 1e-16)) // -160 dB
        return Error{ErrorCode::invalidData, "", "is silent between 20 and 1000 Hz"};
    std::erase_if(frames, [most](const auto& frame) { return frame.power < 1e-6 * most; });
    return frames;
}

/// Fits the exponents of the level, where speed and force vary enough.
inline void fitLevelLaws(std::span<const TextureFrame> frames, TextureFit& fit)
{
    std::vector<double> speeds, forces, levels;
    for (const TextureFrame& frame : frames)
    {
        speeds.push_back(std::log(frame.speed));
        forces.push_back(std::log(frame.force));
        levels.push_back(0.5 * std::log(frame.power));
    }
    const auto slopes = textureSlopes(speeds, forces, levels);
    const auto exponent = [](double slope)
    {
        return std::clamp(slope, limits::textureLowestExponent, limits::textureHighestExponent);
    };
    fit.speedLawAssumed = !slopes.x.has_value();
    fit.forceLawAssumed = !slopes.z.has_value();
    fit.texture.levelBySpeed = exponent(slopes.x.value_or(fit.texture.levelBySpeed));
    fit.texture.levelByForce = exponent(slopes.z.value_or(fit.texture.levelByForce));
}

/// Mean of spectra, as they are at force 1.
class TextureMean
{
public:
    void add(const TextureFrame& frame, double levelByForce)
    {
        sum.step = frame.spectrum.step;
        sum.power.resize(frame.spectrum.power.size(), 0.0);
        const double perForce = std::pow(frame.force, -2.0 * levelByForce);
        for (std::size_t k = 0; k < sum.power.size(); ++k)
            sum.power[k] += perForce * frame.spectrum.power[k];
        logSpeed += std::log(frame.speed);
        ++count;
    }

    [[nodiscard]] std::size_t frames() const noexcept { return count; }

    /// Of at least one frame.
    [[nodiscard]] TextureNode node(std::size_t order) const
    {
        const double share = 1.0 / static_cast<double>(count);
        TextureNode node;
        node.speed = std::min(std::exp(share * logSpeed), 1.0);
        node.level = std::min(std::sqrt(share * sum.sum(textureLow, textureHigh)), limits::textureHighestLevel);
        node.reflection = reflectionsOf(autocorrelationOf(sum, order, textureRate));
        return node;
    }

private:
    PowerSpectrum sum;
    double logSpeed = 0.0;
    std::size_t count = 0;
};

inline constexpr std::size_t textureHalfOctaves = 14; // down to speed 0.01

/// The half octave of a speed, from the lowest on.
[[nodiscard]] inline std::size_t halfOctaveOf(double speed)
{
    const auto below = static_cast<std::size_t>(std::max(0.0, -2.0 * std::log2(speed)));
    return textureHalfOctaves - 1 - std::min(below, textureHalfOctaves - 1);
}

/// A node for each half octave of speed with enough frames, which are told in `halves`; one for all of them where none
/// has.
[[nodiscard]] inline std::vector<TextureNode> textureNodes(std::span<const TextureFrame> frames, double levelByForce,
                                                           std::size_t order, std::vector<std::size_t>& halves)
{
    constexpr std::size_t enough = 4;
    std::array<TextureMean, textureHalfOctaves> means;
    TextureMean whole;
    for (const TextureFrame& frame : frames)
    {
        means[halfOctaveOf(frame.speed)].add(frame, levelByForce);
        whole.add(frame, levelByForce);
    }
    std::vector<TextureNode> nodes;
    for (std::size_t i = 0; i < means.size(); ++i)
        if (means[i].frames() >= enough)
        {
            nodes.push_back(means[i].node(order));
            halves.push_back(i);
        }
    if (nodes.empty())
        nodes.push_back(whole.node(order));
    return nodes;
}

/// Adds the tones that were found, with their levels at the nodes; `halves` as above.
inline void addTones(const FoundTones& found, std::span<const double> speed, std::span<const double> force,
                     std::span<const std::size_t> halves, Texture& texture)
{
    if (found.frequencies.empty())
        return;
    // All phases are of one moment, so that harmonics keep theirs to each other.
    std::size_t loudest = 0;
    double most = -1.0;
    for (std::size_t i = 0; i < found.frames.size(); ++i)
    {
        double power = 0.0;
        for (const ToneFrame& tone : found.frames[i])
            power += std::norm(tone.amplitude);
        if (power > most)
        {
            most = power;
            loudest = i;
        }
    }
    for (std::size_t k = 0; k < found.frequencies.size(); ++k)
    {
        TextureTone tone;
        tone.frequency = found.frequencies[k];
        if (!(tone.frequency <= limits::textureToneFrequency))
            continue;
        // Of a cosine to that of a sine.
        const double cycles = std::arg(found.frames[loudest][k].amplitude) / (2.0 * std::numbers::pi) + 0.25;
        tone.phase = cycles - std::floor(cycles);
        std::vector<double> power(texture.nodes.size(), 0.0), count(texture.nodes.size(), 0.0);
        for (std::size_t i = 0; i < found.frames.size(); ++i)
        {
            const std::size_t middle = i * found.step + found.window / 2;
            if (!found.frames[i][k].there || speed[middle] < 0.01 || force[middle] < 0.01)
                continue;
            std::size_t node = 0;
            if (!halves.empty())
            {
                const auto half = std::find(halves.begin(), halves.end(), halfOctaveOf(speed[middle]));
                if (half == halves.end())
                    continue;
                node = static_cast<std::size_t>(half - halves.begin());
            }
            power[node] +=
                0.5 * std::norm(found.frames[i][k].amplitude) * std::pow(force[middle], -2.0 * texture.levelByForce);
            count[node] += 1.0;
        }
        // Where it is out of the band its level does not matter much: that of the nearest node.
        for (std::size_t n = 0; n < texture.nodes.size(); ++n)
        {
            std::size_t nearest = n;
            for (std::size_t away = 1; count[nearest] == 0.0 && away < 2 * texture.nodes.size(); ++away)
            {
                const std::size_t step = (away + 1) / 2;
                if (away % 2 == 1 && n >= step)
                    nearest = n - step;
                else if (away % 2 == 0 && n + step < texture.nodes.size())
                    nearest = n + step;
            }
            const double mean = count[nearest] > 0.0 ? power[nearest] / count[nearest] : 0.0;
            tone.levels.push_back(std::min(std::sqrt(mean), limits::textureHighestLevel));
        }
        texture.tones.push_back(std::move(tone));
    }
}

} // namespace detail

/// Makes a texture of a recording of one channel at 8000 to 768000 Hz. Samples that are not finite count as 0.
///
/// The recording is cut into overlapping frames of 250 ms (of 125 ms where the speed changes much), which are put
/// together by half octaves of speed. Each half octave with at least four frames (or all together, where none has so
/// many) becomes a node with the autoregressive model of its mean spectrum. Exponents of the level over speed and force
/// are those of least squares over all frames, where there is enough spread, 1 and 0.5 (assumed) elsewhere. Tones that
/// follow the speed are taken out before (findTones()). Errors:
/// those of checkParameters(textureParameters); invalidData at `speed` or `force` for motions with numbers that are not
/// finite, below 0 or above 1e9, for samples that are not finite, and for a recording that is too short, silent or
/// never moves.
[[nodiscard]] inline Result<TextureFit> analyseTexture(std::span<const float> samples, int sampleRate,
                                                       const TextureMotion& motion, const TextureParams& params)
{
    if (auto allowed = checkParameters(textureParameters, params); !allowed)
        return allowed.error();
    if (!std::all_of(samples.begin(), samples.end(), [](float sample) { return std::isfinite(sample); }))
        return Error{ErrorCode::notFinite, "", "has samples that are not finite"};
    constexpr double mostOfUnit = 1e9; // of full speed and full force, which are the highest of all
    const auto highest = [](const Curve& curve) -> std::optional<double>
    {
        double most = 0.0;
        for (const Breakpoint& point : curve)
        {
            if (!std::isfinite(point.time) || !(point.value >= 0.0 && point.value <= mostOfUnit))
                return std::nullopt;
            most = std::max(most, point.value);
        }
        return most > 0.0 ? most : 1.0;
    };
    const auto fullSpeed = highest(motion.speed), fullForce = highest(motion.force);
    if (!fullSpeed || !fullForce)
        return Error{ErrorCode::invalidData, fullSpeed ? "force" : "speed", "must have numbers from 0 to 1e9"};
    TextureFit fit;
    const double duration = static_cast<double>(samples.size()) / sampleRate;
    for (const auto& [curve, name] : {std::pair(&motion.speed, "speed"), std::pair(&motion.force, "force")})
        if (curve->size() > 1 && !(curve->front().time <= 0.1 * duration && curve->back().time >= 0.9 * duration))
            fit.warnings.push_back(std::string(name) + ": is stated from " + decimalText(curve->front().time, 2) +
                                   " to " + decimalText(curve->back().time, 2) + " s, but the recording lasts " +
                                   decimalText(duration, 2) + " s; the rest counts as the nearest value");
    Texture& texture = fit.texture;
    texture.fullSpeed = params.fullSpeed.value_or(*fullSpeed);
    texture.fullForce = params.fullForce.value_or(*fullForce);
    const auto band = detail::textureBand(samples, sampleRate);
    const auto frames = detail::textureFrames(band, motion, texture, params.speed);
    if (!frames)
        return frames.error();
    fit.frames = frames->size();
    detail::fitLevelLaws(*frames, fit);
    // Tones first, then the noise without them.
    std::vector<double> speed(band.size(), params.speed), force(band.size(), 1.0);
    CurveReader speeds(motion.speed), forces(motion.force);
    for (std::size_t n = 0; n < band.size(); ++n)
    {
        const double time = static_cast<double>(n) / detail::textureAnalysisRate;
        if (!motion.speed.empty())
            speed[n] = std::min(speeds.at(time) / texture.fullSpeed, 1.0);
        if (!motion.force.empty())
            force[n] = std::min(forces.at(time) / texture.fullForce, 1.0);
    }
    const FoundTones tones =
        findTones(band, speed, detail::textureAnalysisRate, detail::textureWindow(motion, band.size()),
                  static_cast<std::size_t>(params.tones));
    std::vector<std::size_t> halves;
    auto noise = tones.frequencies.empty() ? frames : detail::textureFrames(tones.rest, motion, texture, params.speed);
    const bool hasNoise = noise.ok();
    if (!hasNoise)
        noise = frames;
    texture.nodes = detail::textureNodes(*noise, texture.levelByForce, static_cast<std::size_t>(params.order), halves);
    if (!hasNoise) // nothing but tones: a node has some noise, at -80 dB
        for (TextureNode& node : texture.nodes)
            node.level *= 1e-4;
    detail::addTones(tones, speed, force, halves, texture);
    fit.pitchAssumed = !params.pitch && texture.nodes.size() == 1;
    texture.pitch = params.pitch.value_or(detail::texturePitch(texture));
    if (auto valid = validate(texture); !valid)
        return valid.error();
    return fit;
}

} // namespace pacini
