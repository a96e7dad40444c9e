#include "support/BlockContract.h"
#include "support/Catch.h"
#include "support/Measure.h"

#include <pacini/analysis/HarmonicPercussive.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <span>
#include <string>
#include <vector>

using namespace pacini;
using namespace pacini::test;

namespace
{

struct Parts
{
    std::vector<float> harmonic, percussive, residual;
};

Parts partsOf(std::span<const float> sound, double fs, const SeparationParams& params = {})
{
    Parts parts;
    separateHarmonicPercussive(sound, fs, params,
                               [&](std::span<const float> h, std::span<const float> p)
                               {
                                   REQUIRE(h.size() == p.size());
                                   REQUIRE(!h.empty());
                                   parts.harmonic.insert(parts.harmonic.end(), h.begin(), h.end());
                                   parts.percussive.insert(parts.percussive.end(), p.begin(), p.end());
                               });
    REQUIRE(parts.harmonic.size() == sound.size());
    for (std::size_t i = 0; i < sound.size(); ++i)
        parts.residual.push_back(sound[i] - parts.harmonic[i] - parts.percussive[i]);
    return parts;
}

double energyOf(std::span<const float> x)
{
    double sum = 0.0;
    for (const float v : x)
        sum += static_cast<double>(v) * static_cast<double>(v);
    return sum;
}

/// Uniform within +-1, as the script below makes it.
class Hiss
{
public:
    explicit Hiss(std::uint32_t seed) : state(seed) {}
    double next()
    {
        state = state * 1664525u + 1013904223u;
        return static_cast<double>(state >> 8) / 8388608.0 - 1.0;
    }

private:
    std::uint32_t state;
};

std::vector<float> soundNamed(const std::string& name, double fs, std::size_t frames)
{
    std::vector<double> clicks(frames, 0.0);
    for (auto start = static_cast<std::size_t>(0.1 * fs); start < frames; start += static_cast<std::size_t>(0.25 * fs))
        for (std::size_t m = 0; start + m < frames && m < static_cast<std::size_t>(0.02 * fs); ++m)
            clicks[start + m] += 0.8 * std::exp(-static_cast<double>(m) / (0.002 * fs)) * (m % 2 == 0 ? 1.0 : -1.0) *
                                 (m % 3 == 0 ? 0.5 : 1.0);
    Hiss hiss(name == "sweep" ? 3u : 7u);
    std::vector<float> x(frames);
    for (std::size_t n = 0; n < frames; ++n)
    {
        const double t = static_cast<double>(n) / fs;
        const double w = 2.0 * std::numbers::pi * t;
        if (name == "mixture")
            x[n] = static_cast<float>(0.4 * std::sin(220.0 * w) + 0.2 * std::sin(660.0 * w) + clicks[n] +
                                      0.1 * hiss.next());
        else if (name == "sweep")
            x[n] = static_cast<float>(0.5 * std::sin((100.0 + 400.0 * t) * w) + 0.02 * hiss.next());
        else
            x[n] = static_cast<float>(clicks[n]);
    }
    return x;
}

/// Energies of the quarters of each part.
struct Reference
{
    std::string sound;
    double fs;
    std::size_t frames;
    FrameParams grid;
    double harmonicSpan, percussiveSpan, margin;
    std::array<std::array<double, 4>, 3> energies;
};

FrameParams gridOf(double window, double hop, double fs)
{
    return {Seconds(window / fs), Seconds(hop / fs)};
}

} // namespace

TEST_CASE("Harmonic, percussive and residual part have the energies that librosa's masks give", "[analysis]")
{
    // librosa 0.11.0: decompose.hpss(S, kernel_size=(frames, bins), margin=margin) of the transforms of the same frames
    // (the sound between zeros; hann, center=False), put together by overlap-add of least
    // squares in NumPy.
    const std::vector<Reference> references{
        {"mixture",
         8000.0,
         8000,
         gridOf(512, 128, 8000),
         0.2,
         500.0,
         2.0,
         {{{196.778363, 201.024455, 197.77127, 197.932401},
           {3.33312273, 2.94694248, 2.89309559, 3.16355831},
           {2.44378994, 2.22580094, 2.34079668, 2.45947902}}}},
        {"mixture",
         8000.0,
         8000,
         gridOf(512, 128, 8000),
         0.2,
         500.0,
         1.0,
         {{{199.848085, 203.275422, 200.215899, 201.115307},
           {5.67073579, 4.94924248, 5.09154375, 5.73869334},
           {0.0, 0.0, 0.0, 0.0}}}},
        {"mixture",
         8000.0,
         8000,
         gridOf(240, 100, 8000),
         0.35,
         900.0,
         3.0,
         {{{190.624329, 194.431739, 189.866731, 191.597612},
           {2.37818377, 2.47438693, 2.41662693, 2.6575174},
           {4.6782859, 4.12073721, 4.37671031, 4.68299197}}}},
        {"sweep",
         8000.0,
         6000,
         gridOf(512, 128, 8000),
         0.2,
         500.0,
         2.0,
         {{{171.279018, 184.638712, 184.195911, 178.209305},
           {1.00780844, 0.00890658041, 0.00835041191, 0.387434367},
           {1.88040982, 0.0723850005, 0.0728706857, 0.682573264}}}},
        {"clicks",
         4000.0,
         700,
         gridOf(256, 64, 4000),
         0.5,
         300.0,
         1.5,
         {{{0.0, 0.0, 0.0, 0.0}, {0.0, 0.0, 1.98359701, 0.0}, {0.0, 0.0, 0.0, 0.0}}}},
        // A median over more frames than there are sees them several times.
        {"mixture",
         8000.0,
         777,
         gridOf(512, 128, 8000),
         0.65,
         500.0,
         2.0,
         {{{16.4414028, 19.5959865, 20.1752657, 16.6476483},
           {0.134820852, 0.0478791513, 0.054301205, 0.133503675},
           {0.449329593, 0.199091234, 0.202490256, 0.434396}}}}};
    for (const Reference& reference : references)
    {
        const SeparationParams params{reference.grid, Seconds(reference.harmonicSpan), Hertz(reference.percussiveSpan),
                                      reference.margin};
        const Parts parts = partsOf(soundNamed(reference.sound, reference.fs, reference.frames), reference.fs, params);
        CAPTURE(reference.sound, reference.frames, reference.margin);
        const std::array<const std::vector<float>*, 3> found{&parts.harmonic, &parts.percussive, &parts.residual};
        for (std::size_t part = 0; part < 3; ++part)
            for (std::size_t quarter = 0; quarter < 4; ++quarter)
            {
                const std::size_t begin = quarter * reference.frames / 4;
                const std::size_t end = (quarter + 1) * reference.frames / 4;
                CAPTURE(part, quarter);
                CHECK(energyOf(std::span(*found[part]).subspan(begin, end - begin)) ==
                      Approx(reference.energies[part][quarter]).epsilon(1e-5).margin(1e-9));
            }
    }
}

TEST_CASE("A tone is harmonic, a click percussive, and noise mostly neither", "[analysis]")
{
    for (const double fs : {8000.0, 44100.0, 192000.0})
    {
        const auto frames = static_cast<std::size_t>(fs);
        CAPTURE(fs);
        const auto tone = sine(frames, 300.0, fs, 0.5);
        const auto middle = [&](const std::vector<float>& x)
        {
            return energyOf(std::span(x).subspan(frames / 4, frames / 2));
        };
        CHECK(middle(partsOf(tone, fs).harmonic) > 0.999 * middle(tone));
        CHECK(energyOf(partsOf(impulse(frames, frames / 2), fs).percussive) > 0.999);
        const auto hiss = noise(frames, 5);
        // Where both medians are alike, a margin of 2 gives each part 1/5 of the amplitude: 3/5 are left.
        const Parts ofHiss = partsOf(hiss, fs);
        CHECK(energyOf(ofHiss.residual) == Approx(0.36 * energyOf(hiss)).epsilon(0.2));
        CHECK(energyOf(ofHiss.residual) > 2.5 * std::max(energyOf(ofHiss.harmonic), energyOf(ofHiss.percussive)));
    }
}

TEST_CASE("A larger margin leaves more residual, a margin of 1 none", "[analysis]")
{
    const auto x = soundNamed("mixture", 8000.0, 8000);
    double before = -1.0;
    for (const double margin : {1.0, 1.5, 2.0, 4.0})
    {
        SeparationParams params;
        params.margin = margin;
        const double residual = energyOf(partsOf(x, 8000.0, params).residual);
        CHECK(residual > before);
        if (margin == 1.0)
            CHECK(residual < 1e-8);
        before = residual;
    }
    SeparationParams below, one, above, most;
    below.margin = 0.0;
    one.margin = 1.0;
    above.margin = 1e9;
    most.margin = 1000.0;
    CHECK(partsOf(x, 8000.0, below).harmonic == partsOf(x, 8000.0, one).harmonic);
    CHECK(partsOf(x, 8000.0, above).harmonic == partsOf(x, 8000.0, most).harmonic);
}

TEST_CASE("Separation takes sounds of every length and rate, frames of every size, and no numbers", "[analysis]")
{
    for (const std::size_t frames : {0u, 1u, 2u, 31u, 371u, 372u, 373u, 743u, 744u, 3000u})
        for (const double fs : {8000.0, 384000.0})
        {
            const Parts parts = partsOf(noise(frames, 4), fs);
            CAPTURE(frames, fs);
            CHECK(allFinite(parts.harmonic));
            CHECK(allFinite(parts.percussive));
        }
    const auto x = noise(2000, 6);
    for (const auto& [window, hop] : {std::pair{0.0, 0.0}, {2.0, 5.0}, {64.0, 64.0}, {64.0, 1.0}, {4000.0, 1000.0}})
    {
        SeparationParams params;
        params.frames = gridOf(window, hop, 8000.0);
        params.margin = 1.0;
        CAPTURE(window, hop);
        CHECK(energyOf(partsOf(x, 8000.0, params).residual) < 1e-8);
    }
    SeparationParams extreme;
    for (const double span : {-1.0, 0.0, 1e9})
    {
        extreme.harmonicSpan = Seconds(span);
        extreme.percussiveSpan = Hertz(span);
        CHECK(allFinite(partsOf(x, 8000.0, extreme).harmonic));
    }
    auto bad = x;
    auto good = x;
    bad[70] = std::numeric_limits<float>::quiet_NaN();
    bad[71] = std::numeric_limits<float>::infinity();
    good[70] = good[71] = 0.0f;
    Parts clean = partsOf(good, 8000.0);
    SeparationParams usual;
    std::vector<float> harmonic;
    separateHarmonicPercussive(bad, 8000.0, usual,
                               [&](std::span<const float> h, std::span<const float>)
                               { harmonic.insert(harmonic.end(), h.begin(), h.end()); });
    CHECK(harmonic == clean.harmonic);
}
