#include "cli/ProgramFolder.h"
#include "cli/bench/Bench.h"
#include "io/ProfileFile.h"
#include "io/ShippedProfiles.h"

#include <pacini/actuator/FeltModel.h>
#include <pacini/evaluate/Hts.h>
#include <pacini/evaluate/HtsAnalyzer.h>
#include <pacini/evaluate/match/MatchParts.h>
#include <pacini/filters/Resampler.h>
#include <pacini/realtime/Translator.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace pacini::cli
{

namespace
{
constexpr double longest = 10.0; // s of each sound

struct LiveVariant
{
    std::size_t bands = 6;
    bool carriers = false; ///< everything by sinusoids, else what cannot be played as it is
    std::string profile;   ///< of a shipped one, or empty
    int rate = 48000;      ///< Hz
    std::size_t block = 64;
    double audible = 1.0;
};

std::vector<LiveVariant> liveVariants()
{
    std::vector<LiveVariant> all;
    for (const bool carriers : {false, true})
        for (const std::size_t bands : {1u, 2u, 3u, 4u, 6u, 8u, 12u})
            all.push_back({bands, carriers, {}, 48000, 64});
    for (const char* profile : {"l5-wristband", "dualsense-voice-coil", "joycon-hd-rumble", "lra-175", "erm-coin"})
        all.push_back({6, false, profile, 48000, 64});
    for (const int rate : {48000, 96000, 192000})
        for (const std::size_t block : {64u, 256u})
            if (rate != 48000 || block != 64)
                all.push_back({6, false, {}, rate, block});
    all.push_back({6, false, "l5-wristband", 192000, 64});
    for (const double audible : {0.0, 0.25, 0.5, 0.75})
        all.push_back({6, false, {}, 48000, 64, audible});
    return all;
}

struct LiveRun
{
    std::vector<float> drive;
    double seconds = 0.0;   ///< of all blocks
    double slowBlock = 0.0; ///< s that 99 of 100 blocks do not exceed
};

/// The drive in blocks, its latency taken out. The least times of several runs count.
LiveRun run(Translator& translator, const std::vector<float>& sound, std::size_t block, int repeats)
{
    using Clock = std::chrono::steady_clock;
    LiveRun best;
    const std::size_t latency = translator.latencyFrames();
    std::vector<float> in(sound);
    in.resize((sound.size() + latency + block - 1) / block * block, 0.0f);
    std::vector<float> out(in.size());
    std::vector<double> times(in.size() / block);
    for (int i = 0; i < std::max(repeats, 1); ++i)
    {
        translator.reset();
        double sum = 0.0;
        for (std::size_t b = 0; b < times.size(); ++b)
        {
            const auto start = Clock::now();
            translator.process(std::span(in).subspan(b * block, block), std::span(out).subspan(b * block, block));
            times[b] = std::chrono::duration<double>(Clock::now() - start).count();
            sum += times[b];
        }
        const auto slow = times.begin() + static_cast<std::ptrdiff_t>(times.size() * 99 / 100);
        std::nth_element(times.begin(), slow, times.end());
        best.seconds = i == 0 ? sum : std::min(best.seconds, sum);
        best.slowBlock = i == 0 ? *slow : std::min(best.slowBlock, *slow);
    }
    best.drive.assign(out.begin() + static_cast<std::ptrdiff_t>(latency),
                      out.begin() + static_cast<std::ptrdiff_t>(latency + sound.size()));
    return best;
}

/// What the skin gets; the drive itself where the profile has no body.
void feel(std::vector<float>& signal, const std::optional<Profile>& profile, double rate)
{
    const auto params = profile ? feltModelParams(*profile) : std::nullopt;
    if (!params)
        return;
    FeltModel model;
    model.prepare({rate, 4096});
    model.setParams(*params);
    model.reset();
    for (std::size_t i = 0; i < signal.size(); i += 4096)
    {
        const auto part = std::span(signal).subspan(i, std::min<std::size_t>(4096, signal.size() - i));
        model.process(part, part);
    }
}

void measureLive(const BenchSound& sound, const BenchSettings& settings, BenchTable& rows)
{
    HtsAnalyzer analyzer;
    const auto mono = sound.beginning(longest);
    const auto source = htsSourceFeatures(analyzer, mono, sound.sampleRate);
    const auto heard = heardTrack(mono, sound.sampleRate);
    if (!source || !heard)
        return;
    TouchAnalyzer touch;
    std::vector<float> atRate;
    int rate = 0;
    for (const LiveVariant& variant : liveVariants())
    {
        TranslatorSetup setup;
        setup.bands.bands = variant.bands;
        if (!variant.profile.empty())
        {
            const auto path = findProfile(variant.profile, programFolder());
            const auto profile = path ? readProfile(*path) : Result<Profile>(path.error());
            if (!profile)
                continue;
            setup.profile = *profile;
        }
        if (rate != variant.rate)
        {
            auto converted = resample(mono, sound.sampleRate, variant.rate);
            if (!converted)
                continue;
            atRate = std::move(*converted);
            rate = variant.rate;
        }
        TranslatorParams params;
        params.direct = variant.carriers ? 0.0 : 1.0;
        params.audible = variant.audible;
        Translator translator;
        translator.setSetup(setup);
        translator.prepare({static_cast<double>(rate), variant.block});
        translator.setParams(params);
        LiveRun live = run(translator, atRate, variant.block, settings.repeats);
        feel(live.drive, setup.profile, rate);
        const auto features = htsCandidateFeatures(analyzer, std::span<const float>(live.drive), rate);
        const auto felt = touchTrack(touch, live.drive, rate);
        if (!features || !felt)
            continue;
        const HtsScore score = compare(*source, *features, HtsMode::translation);
        const double duration = static_cast<double>(atRate.size()) / rate;
        const double deadline = static_cast<double>(variant.block) / rate;
        rows.add({sound.name, variant.carriers ? "carriers" : "direct",
                  variant.profile.empty() ? "none" : variant.profile, std::to_string(variant.bands),
                  std::to_string(variant.rate), std::to_string(variant.block), fmt::format("{}", variant.audible),
                  duration, live.seconds, 100.0 * live.slowBlock / deadline,
                  1000.0 * static_cast<double>(translator.latencyFrames()) / rate,
                  predictedMatch(matchParts(*heard, *felt)), score.score});
    }
}
} // namespace

Bench liveBench()
{
    return {"live",
            "Live translation: load of one core against likeness",
            "The first 10 s of each sound go through the translator in blocks, as in a host: with the source's own "
            "signal where the actuator can show it (direct) or with sinusoids only (carriers). Load is the time of all "
            "blocks over the duration of the sound; p99 is the time that 99 of 100 blocks do not exceed, over the "
            "duration of a block. Both are the least of several runs. HTS compares the sound with the acceleration at "
            "the skin that the profile's body model predicts (with the drive where there is none); match, a prediction "
            "of how "
            "well people would say that they go together, likewise.",
            columnsOf({"played", "profile", "bands"},
                      {{"rate", "Hz", Reduction::key},
                       {"block", "frames", Reduction::key},
                       {"audible", "", Reduction::key},
                       summed("duration", "s"),
                       summed("seconds", "s"),
                       {"p99", "% of deadline"},
                       {"latency", "ms"},
                       {"match", ""},
                       {"HTS", ""},
                       {"load", "% of a core", Reduction::ratio, "seconds", "duration", 100.0}}),
            {{"", "Likeness against load", "played", "load", "HTS", "bands", "profile", "none", false}},
            {},
            measureLive};
}

} // namespace pacini::cli
