#pragma once

// The demo sounds as clips, and how well a signal renders them.

#include "io/AudioReader.h"
#include "support/Catch.h"
#include "support/Paths.h"

#include <pacini/analysis/Encoder.h>
#include <pacini/evaluate/Hts.h>
#include <pacini/synthesis/Decoder.h>
#include <pacini/synthesis/DecoderChoice.h>

#include <algorithm>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace pacini::test
{

struct DemoSound
{
    std::string name;
    Clip clip;
    HtsFeatures source;
};

/// Every sound of a folder, translated with the usual parameters.
inline std::vector<DemoSound> soundsIn(const std::filesystem::path& folder)
{
    std::vector<std::filesystem::path> paths;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        if (entry.path().extension() == ".flac" || entry.path().extension() == ".wav")
            paths.push_back(entry.path());
    std::sort(paths.begin(), paths.end());
    std::vector<DemoSound> all;
    EncoderParams bands; // HTS hears nothing of what lies above the range of touch
    bands.audible = 0.0;
    Encoder encoder(bands);
    HtsAnalyzer analyzer;
    for (const auto& path : paths)
    {
        const auto audio = readAudio(path);
        REQUIRE(audio);
        encoder.start(audio->sampleRate, audio->channels);
        encoder.push(audio->samples);
        std::vector<float> mono(audio->samples.size() / static_cast<std::size_t>(audio->channels));
        for (std::size_t i = 0; i < audio->samples.size(); ++i)
            mono[i / static_cast<std::size_t>(audio->channels)] +=
                audio->samples[i] / static_cast<float>(audio->channels);
        auto source = htsSourceFeatures(analyzer, std::span<const float>(mono), audio->sampleRate);
        REQUIRE(source);
        all.push_back({path.stem().string(), encoder.finish(), std::move(source).value()});
    }
    return all;
}

/// Every demo sound.
inline const std::vector<DemoSound>& demoSounds()
{
    static const std::vector<DemoSound> sounds = soundsIn(sourceFolder() / "Resources/demo");
    REQUIRE(sounds.size() >= 8);
    return sounds;
}

/// The clip as Pacini's own decoder plays it.
inline std::vector<float> decoded(const Clip& clip, int sampleRate)
{
    DecoderParams params;
    params.sampleRate = sampleRate;
    Decoder decoder(clip, decoderParamsFor(clip, params, {}, 67.0));
    std::vector<float> samples(static_cast<std::size_t>(decoder.totalFrames()));
    decoder.process(samples);
    return samples;
}

/// HTS of a signal against the demo sound.
inline double hts(const DemoSound& sound, const std::vector<float>& signal, int sampleRate)
{
    static HtsAnalyzer analyzer;
    const auto features = htsCandidateFeatures(analyzer, std::span<const float>(signal), sampleRate);
    REQUIRE(features);
    return compare(sound.source, *features, HtsMode::translation).score;
}

} // namespace pacini::test
