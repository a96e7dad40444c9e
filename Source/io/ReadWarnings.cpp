#include "io/ReadWarnings.h"

#include "io/NearestName.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

namespace pacini
{

namespace
{
/// Words that people and other programs use, and the key that is meant. A word may stand for several keys; the first
/// that may stand at the place counts.
constexpr std::array<std::pair<std::string_view, std::string_view>, 60> otherWords{{
    {"pitch", "transposition"},
    {"transpose", "transposition"},
    {"semitones", "transposition"},
    {"detune", "transposition"},
    {"speed", "stretch"},
    {"rate", "stretch"},
    {"tempo", "stretch"},
    {"volume", "gain"},
    {"level", "gain"},
    {"loudness", "gain"},
    {"amplitude", "gain"},
    {"volume", "amplitude"},
    {"level", "amplitude"},
    {"gain", "amplitude"},
    {"intensity", "amplitude"},
    {"strength", "amplitude"},
    {"value", "amplitude"},
    {"value", "frequency"},
    {"hertz", "frequency"},
    {"hz", "frequency"},
    {"pitch", "frequency"},
    {"sharp", "sharpness"},
    {"time", "start"},
    {"begin", "start"},
    {"at", "start"},
    {"offset", "start"},
    {"delay", "start"},
    {"start", "time"},
    {"at", "time"},
    {"position", "time"},
    {"position", "pan"},
    {"balance", "pan"},
    {"length", "duration"},
    {"end", "duration"},
    {"seconds", "duration"},
    {"repeat", "loop"},
    {"repeats", "passes"},
    {"count", "passes"},
    {"times", "passes"},
    {"loops", "passes"},
    {"channels", "actuators"},
    {"outputs", "actuators"},
    {"fade", "glide"},
    {"ramp", "glide"},
    {"id", "name"},
    {"title", "name"},
    {"label", "name"},
    {"random", "variation"},
    {"randomness", "variation"},
    {"sound", "clip"},
    {"path", "file"},
    {"filename", "file"},
    {"events", "transients"},
    {"frequencies", "pitch"},
    {"tracks", "plays"},
    {"automation", "changes"},
    {"type", "technology"},
    {"eq", "equalizer"},
    {"voices", "polyphony"},
    {"quality", "q"},
}};

std::string lowerCase(std::string_view text)
{
    std::string lower(text);
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return lower;
}
} // namespace

void ReadWarnings::add(std::string_view where, std::string_view message)
{
    if (hasRoom())
        kept.push_back(fmt::format("{}: {}", where, message));
    else
        count();
}

std::vector<std::string> ReadWarnings::texts() const
{
    std::vector<std::string> all = kept;
    if (notKept > 0)
        all.push_back(fmt::format("and {} more of this kind", notKept));
    return all;
}

std::string_view nearestKey(std::string_view given, const std::vector<std::string_view>& known)
{
    constexpr std::size_t longest = 40; // no key is nearly as long
    if (given.empty() || given.size() > longest)
        return {};
    const std::string lower = lowerCase(given);
    // Short words are near to nearly everything: of up to five letters one may be wrong, two from six letters on.
    const auto [nearest, least] = nearestOf(lower, known, lower.size() < 6 ? 2 : 3);
    // A single wrong letter is a slip; beyond that another word for a key is more likely.
    if (least > 1)
        for (const bool exact : {true, false})
            for (const auto& [word, key] : otherWords)
                if ((exact ? lower == word : word.size() >= 5 && typingDistance(lower, word) == 1) &&
                    std::find(known.begin(), known.end(), key) != known.end())
                    return key;
    if (!nearest.empty() || lower.size() < 3)
        return nearest;
    // "freq", "dur", "panning"
    for (const std::string_view key : known)
        if (const std::string lowerKey = lowerCase(key);
            lowerKey.starts_with(lower) || (lowerKey.size() > 2 && lower.starts_with(lowerKey)))
            return key;
    return {};
}

bool isRemark(std::string_view key) noexcept
{
    return key.starts_with('$') || key.starts_with('_') || key.starts_with("//");
}

std::string unknownKeyText(std::string_view given, const std::vector<std::string_view>& known)
{
    const std::string_view nearest = nearestKey(given, known);
    if (nearest.empty())
        return "is unknown";
    return fmt::format("is unknown; did you mean \"{}\"?", nearest);
}

} // namespace pacini
