#include "cli/bench/BenchSound.h"

#include "io/AudioReader.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <utility>

namespace pacini::cli
{

namespace
{
/// The list of a sound in a file of lists; nothing when there is no such file or no such list.
Result<std::optional<std::vector<double>>> listedTimes(const std::filesystem::path& file, const std::string& sound)
{
    std::ifstream stream(file);
    if (!stream)
        return std::optional<std::vector<double>>();
    const auto lists = nlohmann::json::parse(stream, nullptr, false);
    const auto wrong = [&file](const std::string& where)
    {
        return Error{ErrorCode::invalidData, file.filename().string() + where,
                     "must be an object with a list of times in seconds for each file name"};
    };
    if (!lists.is_object())
        return wrong("");
    const auto list = lists.find(sound);
    if (list == lists.end())
        return std::optional<std::vector<double>>();
    if (!list->is_array() || !std::all_of(list->begin(), list->end(), [](const auto& v) { return v.is_number(); }))
        return wrong("[" + sound + "]");
    return std::optional(list->get<std::vector<double>>());
}
} // namespace

std::span<const float> BenchSound::beginning(double seconds) const
{
    const auto frames = static_cast<std::size_t>(seconds * sampleRate);
    return std::span(mono).first(std::min(frames, mono.size()));
}

Result<BenchSound> readBenchSound(const std::filesystem::path& path)
{
    auto audio = readAudio(path);
    if (!audio)
        return audio.error();
    BenchSound sound;
    sound.path = path;
    sound.name = path.filename().string();
    sound.sampleRate = audio->sampleRate;
    sound.channels = audio->channels;
    sound.interleaved = std::move(audio->samples);
    const auto channels = static_cast<std::size_t>(sound.channels);
    sound.mono.resize(sound.interleaved.size() / channels);
    if (sound.mono.empty())
        return Error{ErrorCode::invalidData, "", "contains no sound"};
    for (std::size_t i = 0; i < sound.mono.size(); ++i)
    {
        double sum = 0.0;
        for (std::size_t c = 0; c < channels; ++c)
            sum += static_cast<double>(sound.interleaved[i * channels + c]);
        sound.mono[i] = static_cast<float>(sum / static_cast<double>(channels));
    }
    auto onsets = listedTimes(path.parent_path() / "onsets.json", sound.name);
    if (!onsets)
        return onsets.error();
    if (!*onsets)
        return sound;
    auto ambiguous = listedTimes(path.parent_path() / "onsets_ambiguous.json", sound.name);
    if (!ambiguous)
        return ambiguous.error();
    sound.events = {**onsets, ambiguous->value_or(std::vector<double>())};
    return sound;
}

} // namespace pacini::cli
