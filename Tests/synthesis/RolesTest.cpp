#include "support/Catch.h"
#include "support/HeapGuard.h"

#include <pacini/foundation/Random.h>
#include <pacini/synthesis/Decoder.h>
#include <pacini/synthesis/PartEnvelopes.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

using namespace pacini;

namespace
{
constexpr double roleRate = 8000.0;

/// Tones and noise below and above 200 Hz, and events.
Clip everything(bool envelope)
{
    Clip clip;
    clip.duration = 1.0;
    clip.bands = {{60.0, 80.0, 100.0, 0, {{0.0, 0.2}, {0.5, 0.4}, {1.0, 0.1}}, {}},
                  {230.0, 260.0, 300.0, 0, {{0.0, 0.1}, {1.0, 0.3}}, {{0.0, 255.0}, {1.0, 270.0}}}};
    clip.noise = {{100.0, 180.0, {{0.0, 0.1}, {1.0, 0.2}}}, {220.0, 400.0, {{0.0, 0.05}, {0.4, 0.15}}}};
    clip.transients = {{0.05, 0.9, 0.4}, {0.41, 1.0, 0.8}, {0.45, 0.9, 0.2}, {0.8, 1.0, 0.6}};
    if (envelope)
        clip.envelope = {{0.0, 0.25}, {0.4, 0.35}, {0.7, 0.1}, {1.0, 0.3}};
    return clip;
}

Clip tonesOf(Clip clip)
{
    clip.noise.clear();
    clip.transients.clear();
    return clip;
}

DecoderParams apart()
{
    DecoderParams params;
    params.sampleRate = roleRate;
    params.apart = true;
    return params;
}

using Level = std::function<double(std::size_t)>; // by frame

Level steady(double level)
{
    return [level](std::size_t)
    {
        return level;
    };
}

struct Levels
{
    Level tones = steady(1.0), events = steady(1.0), noise = steady(1.0);
};

/// Frames [0, `frames`) at levels, in blocks; `before(decoder, frame)` in front of each.
std::vector<float> mixed(Decoder& decoder, std::size_t frames, const Levels& levels, std::size_t block,
                         const std::function<void(Decoder&, std::size_t)>& before = {})
{
    std::vector<float> out(frames);
    for (std::size_t at = 0; at < frames;)
    {
        const std::size_t n = std::min(block, frames - at);
        if (before)
            before(decoder, at);
        PerRole<std::vector<double>> values;
        RoleGains gains;
        for (const Role role : allRoles)
        {
            const Level& level = role == Role::tones    ? levels.tones
                                 : role == Role::events ? levels.events
                                                        : levels.noise;
            for (std::size_t i = 0; i < n; ++i)
                values[role].push_back(level(at + i));
            const auto& v = values[role];
            const bool rests = std::all_of(v.begin(), v.end(), [&](double x) { return x == v.front(); });
            gains[role] = RoleGain(rests ? std::span(v).first(1) : std::span(v));
        }
        decoder.process(std::span(out).subspan(at, n), gains);
        at += n;
    }
    return out;
}

std::vector<float> mixed(const Clip& clip, const Levels& levels, std::size_t block = 100)
{
    Decoder decoder(clip, apart());
    return mixed(decoder, static_cast<std::size_t>(decoder.totalFrames()), levels, block);
}

std::vector<float> plain(const Clip& clip)
{
    Decoder decoder(clip, apart());
    std::vector<float> out(static_cast<std::size_t>(decoder.totalFrames()));
    decoder.process(out);
    return out;
}

std::vector<double> difference(const std::vector<float>& a, const std::vector<float>& b, double factor)
{
    std::vector<double> d(a.size());
    for (std::size_t i = 0; i < d.size(); ++i)
        d[i] = factor * (static_cast<double>(a[i]) - static_cast<double>(b[i]));
    return d;
}

double rms(std::span<const double> x)
{
    double sum = 0.0;
    for (const double v : x)
        sum += v * v;
    return std::sqrt(sum / static_cast<double>(x.size()));
}

double rms(std::span<const float> x)
{
    return rms(std::vector<double>(x.begin(), x.end()));
}

/// Straight from one level to another.
Level glide(double from, double to, std::size_t start, std::size_t end)
{
    return [=](std::size_t frame)
    {
        if (frame <= start)
            return from;
        if (frame >= end)
            return to;
        return from + (to - from) * static_cast<double>(frame - start) / static_cast<double>(end - start);
    };
}

double largestStep(std::span<const float> x)
{
    double most = 0.0;
    for (std::size_t i = 1; i < x.size(); ++i)
        most = std::max(most, std::abs(static_cast<double>(x[i]) - static_cast<double>(x[i - 1])));
    return most;
}
} // namespace

TEST_CASE("With all roles at 1 a clip is bit for bit what it is without levels", "[roles]")
{
    for (const bool envelope : {false, true})
    {
        const Clip clip = everything(envelope);
        const std::vector<float> wanted = plain(clip);
        DecoderParams together = apart();
        together.apart = false;
        Decoder decoder(clip, together);
        std::vector<float> unlevelled(wanted.size());
        decoder.process(unlevelled);
        CHECK(unlevelled == wanted);
        for (const std::size_t block : {std::size_t(1), std::size_t(77), std::size_t(8000)})
            CHECK(mixed(clip, {}, block) == wanted);
        CHECK(mixed(tonesOf(clip), {}) == plain(tonesOf(clip)));
    }
}

TEST_CASE("Levels are the faders of a sum: a role never moves another", "[roles]")
{
    for (const bool envelope : {false, true})
    {
        CAPTURE(envelope);
        const Clip clip = everything(envelope);
        const auto whole = mixed(clip, {});
        const auto tones = difference(whole, mixed(clip, {steady(0.5)}), 2.0);
        const auto events = difference(whole, mixed(clip, {steady(1.0), steady(0.5)}), 2.0);
        const auto noise = difference(whole, mixed(clip, {steady(1.0), steady(1.0), steady(0.5)}), 2.0);
        for (const auto* role : {&tones, &events, &noise})
            CHECK(rms(*role) > 0.01);
        const Levels moving{glide(0.2, 1.5, 1000, 3000), glide(2.0, 0.1, 0, 8000), glide(1.0, 0.3, 4000, 4100)};
        const auto y = mixed(clip, moving, 61);
        for (std::size_t i = 0; i < y.size(); ++i)
            REQUIRE(static_cast<double>(y[i]) ==
                    Approx(moving.tones(i) * tones[i] + moving.events(i) * events[i] + moving.noise(i) * noise[i])
                        .margin(2e-6));
    }
}

TEST_CASE("Levels at 0 and back do not depend on blocks", "[roles]")
{
    // Down and up again where hops are neither made nor wanted, and too fast for the leveller to follow.
    const Level up = [](std::size_t frame)
    {
        return frame % 1700 < 600 ? 0.0 : std::min(1.0, static_cast<double>(frame % 1700 - 600) / 40.0);
    };
    const Level flutter = [](std::size_t frame)
    {
        return frame % 170 < 100 ? 0.0 : 0.8;
    };
    for (const bool envelope : {false, true})
        for (const Levels& levels :
             {Levels{up, up, up}, Levels{up, flutter, steady(1.0)}, Levels{flutter, up, up},
              Levels{steady(0.0), flutter, flutter}, Levels{glide(0.0, 1.0, 2000, 4000), up, up}})
            for (const Clip& clip : {everything(envelope), tonesOf(everything(envelope))})
            {
                const auto wanted = mixed(clip, levels, 8000);
                for (const std::size_t block : {std::size_t(1), std::size_t(64), std::size_t(333)})
                {
                    CAPTURE(envelope, block);
                    CHECK(mixed(clip, levels, block) == wanted);
                }
            }
}

TEST_CASE("Tones that were at 0 are back at once, as if they had always been computed", "[roles]")
{
    for (const bool envelope : {false, true})
    {
        const Clip clip = tonesOf(everything(envelope));
        const auto whole = plain(clip);
        const Levels levels{[](std::size_t frame)
                            {
                                return frame >= 1000 && frame < 4003 ? 0.0 : 0.7;
                            }};
        const auto y = mixed(clip, levels, 50);
        for (std::size_t i = 0; i < y.size(); ++i)
            REQUIRE(static_cast<double>(y[i]) == Approx(levels.tones(i) * static_cast<double>(whole[i])).margin(1e-6));
    }
}

TEST_CASE("Pulses are heard from within, when their level rises while they sound", "[roles]")
{
    Clip clip;
    clip.duration = 0.2;
    clip.transients = {{0.05, 0.9, 0.0}};
    const auto whole = plain(clip);
    const Levels levels{steady(1.0), [](std::size_t frame)
                        {
                            return frame < 440 ? 0.0 : 1.0;
                        }};
    for (const std::size_t block : {std::size_t(1), std::size_t(40), std::size_t(1600)})
    {
        const auto y = mixed(clip, levels, block);
        double heard = 0.0;
        for (std::size_t i = 0; i < y.size(); ++i)
        {
            REQUIRE(static_cast<double>(y[i]) == Approx(i < 440 ? 0.0 : static_cast<double>(whole[i])).margin(1e-9));
            heard = std::max(heard, std::abs(static_cast<double>(y[i])));
        }
        CHECK(heard > 0.1);
    }
}

TEST_CASE("A role that is left out is a role at 0, and another keeps its share of the envelope", "[roles]")
{
    for (const bool envelope : {false, true})
        for (const Role role : allRoles)
        {
            CAPTURE(envelope, nameOf(role));
            const Clip clip = everything(envelope);
            Levels levels;
            (role == Role::tones ? levels.tones : role == Role::events ? levels.events : levels.noise) = steady(0.0);
            const auto wanted = mixed(clip, levels);
            DecoderParams params = apart();
            params.leftOut[role] = true;
            Decoder decoder(clip, params);
            CHECK((decoder.report().carriers == 0) == (role == Role::tones));
            CHECK((decoder.report().noiseBands == 0) == (role == Role::noise));
            CHECK((decoder.report().pulses == 0) == (role == Role::events));
            std::vector<float> y(wanted.size());
            decoder.process(y);
            for (std::size_t i = 0; i < y.size(); ++i)
                REQUIRE(static_cast<double>(y[i]) == Approx(static_cast<double>(wanted[i])).margin(1e-6));
        }
    // What of noise is in the sum, and what it is alone, are alike strong: where they beat, the mean that is levelled
    // is up to 1 dB below the RMS value in each of two passes.
    Clip clip = everything(true);
    clip.transients.clear();
    const auto whole = mixed(clip, {});
    for (const bool noise : {true, false})
    {
        Levels half, none;
        (noise ? half.noise : half.tones) = steady(0.5);
        (noise ? none.tones : none.noise) = steady(0.0);
        const double inSum = rms(difference(whole, mixed(clip, half), 2.0)), alone = rms(mixed(clip, none));
        CAPTURE(noise, inSum, alone);
        CHECK(std::abs(20.0 * std::log10(alone / inSum)) < 2.5);
    }
    // With all of them left out there is silence.
    DecoderParams params = apart();
    params.leftOut = PerRole<bool>(true);
    Decoder decoder(clip, params);
    std::vector<float> y(8000, 1.0f);
    decoder.process(y);
    CHECK(rms(y) == 0.0);
}

TEST_CASE("A role that comes back where another is levelled with it neither clicks nor comes later than 40 ms",
          "[roles]")
{
    Clip clip = everything(true);
    clip.transients.clear();
    const auto whole = mixed(clip, {});
    const double usual = largestStep(whole);
    for (const bool tones : {true, false})
    {
        Levels levels;
        (tones ? levels.tones : levels.noise) = [](std::size_t frame)
        {
            return frame < 3000 || frame > 5000 ? 1.0 : 0.0;
        };
        Levels ramps;
        (tones ? ramps.tones : ramps.noise) = [](std::size_t frame)
        {
            return std::clamp(std::abs(static_cast<double>(frame) - 4000.0) / 40.0 - 25.0, 0.0, 1.0);
        };
        const auto y = mixed(clip, ramps);
        CHECK(largestStep(y) < 1.3 * usual);
        const auto z = mixed(clip, levels);
        const std::size_t late = 5000 + static_cast<std::size_t>(0.040 * roleRate) + 160;
        double error = 0.0;
        for (std::size_t i = late; i < z.size(); ++i)
            error = std::max(error, std::abs(static_cast<double>(z[i]) - static_cast<double>(whole[i])));
        if (tones) // noise is other noise then
            CHECK(error < 1e-5);
        const double before = rms(std::span(z).subspan(3100, 1500));
        CHECK(before < rms(std::span(whole).subspan(3100, 1500)));
    }
}

TEST_CASE("Changes of pitch and speed and skipping reach what is not computed", "[roles]")
{
    const Clip clip = tonesOf(everything(true));
    const auto change = [](Decoder& decoder, std::size_t at)
    {
        if (at == 1000 || at == 2000 || at == 2050)
            decoder.change(at == 2000 ? 5.0 : -3.0, at == 2000 ? 0.8 : 1.1);
    };
    Decoder first(clip, apart()), second(clip, apart());
    const auto whole = mixed(first, 8000, {}, 50, change);
    const Level gap = [](std::size_t frame)
    {
        return frame >= 700 && frame < 3000 ? 0.0 : 1.0;
    };
    const auto y = mixed(second, 8000, {gap, gap, gap}, 50, change);
    for (std::size_t i = 0; i < y.size(); ++i)
        REQUIRE(static_cast<double>(y[i]) == Approx(gap(i) * static_cast<double>(whole[i])).margin(1e-6));

    Decoder skipping(clip, apart()), played(clip, apart());
    mixed(skipping, 1000, {steady(0.0)}, 100);
    skipping.skip(2222);
    const auto after = mixed(skipping, 1000, {}, 100);
    const auto all = mixed(played, 5000, {}, 100);
    for (std::size_t i = 0; i < after.size(); ++i)
        REQUIRE(static_cast<double>(after[i]) == Approx(static_cast<double>(all[3222 + i])).margin(1e-6));
}

TEST_CASE("Levels touch no heap and do no harm whatever they do", "[roles]")
{
    for (std::uint64_t seed = 1; seed <= 20; ++seed)
    {
        CAPTURE(seed);
        Random random(seed);
        const Clip clip = seed % 3 == 0 ? tonesOf(everything(seed % 2 == 0)) : everything(seed % 2 == 0);
        Decoder decoder(clip, apart());
        std::vector<float> out(8000);
        PerRole<std::vector<double>> values;
        for (auto& v : values)
            v.resize(500);
        double most = 0.0;
        const test::HeapGuard guard;
        for (int pass = 0; pass < 2; ++pass)
        {
            for (std::size_t at = 0; at < out.size();)
            {
                const std::size_t n =
                    std::min(out.size() - at, 1 + static_cast<std::size_t>(random.uniform(0.0, 499.0)));
                RoleGains gains;
                for (const Role role : allRoles)
                {
                    const bool rests = random.uniform() < 0.5;
                    double level = random.uniform() < 0.4 ? 0.0 : random.uniform();
                    for (std::size_t i = 0; i < n; ++i)
                    {
                        if (!rests && random.uniform() < 0.01)
                            level = random.uniform() < 0.4 ? 0.0 : random.uniform();
                        values[role][i] = level;
                    }
                    gains[role] = RoleGain(std::span(values[role]).first(rests ? 1 : n));
                }
                if (random.uniform() < 0.05)
                    decoder.change(random.uniform(-12.0, 12.0), random.uniform(0.7, 1.5));
                if (random.uniform() < 0.02)
                    decoder.skip(static_cast<std::int64_t>(random.uniform(0.0, 300.0)));
                decoder.process(std::span(out).subspan(at, n), gains);
                for (std::size_t i = at; i < at + n; ++i)
                    most = std::max(most, std::isfinite(out[i]) ? std::abs(static_cast<double>(out[i])) : 1e9);
                at += n;
            }
            decoder.reset();
        }
        CHECK(guard.traffic() == 0);
        CHECK(most < 4.0);
    }
}
