// Losses, and what readers of files say, are told by code that knows no language: the windows have a form of each in
// every language.

#include "document/ActuatorTrace.h"
#include "document/ClipExport.h"
#include "editor/Bench.h"
#include "editor/Text.h"
#include "editor/Translation.h"
#include "editor/Unmarked.h"
#include "io/formats/ClipFormat.h"
#include "support/RandomClip.h"

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

using namespace pacini;
using namespace pacini::test;

namespace
{
/// One message of each kind, by what it says without its numbers.
class Messages
{
public:
    void add(const std::string& message)
    {
        std::string kind;
        for (const char c : message)
            if ((c < '0' || c > '9') && c != '.')
                kind += c;
        if (!kind.empty())
            kinds.emplace(std::move(kind), message);
    }

    void addAll(const std::vector<std::string>& some)
    {
        for (const std::string& message : some)
            add(message);
    }

    [[nodiscard]] bool has(const std::string& part) const
    {
        return std::any_of(kinds.begin(), kinds.end(),
                           [&](const auto& kind) { return kind.second.find(part) != std::string::npos; });
    }

    [[nodiscard]] auto begin() const { return kinds.begin(); }
    [[nodiscard]] auto end() const { return kinds.end(); }

private:
    std::map<std::string, std::string> kinds;
};

/// A fast train of events of all strengths and sharpnesses over a band that is weak, full and weak again.
Clip trainClip()
{
    Clip clip;
    clip.duration = 2.0;
    clip.name = std::string(300, 'n');
    clip.bands = {{150.0, 160.0, 170.0, 0, {{0.0, 0.002}, {0.9, 0.002}, {1.0, 1.0}, {1.3, 0.3}, {2.0, 0.0}}, {}},
                  {150.0, 160.0, 170.0, 0, {{0.0, 0.5}, {2.0, 0.5}}, {{0.0, 30.0}, {2.0, 900.0}}}};
    clip.bands[1].phase = 0.25;
    for (int i = 0; i < 120; ++i)
        clip.transients.push_back({0.5 + 0.009 * i, 0.1 + 0.9 * (i % 7) / 6.0, (i % 5) / 4.0});
    clip.markers = {{0.1, "start"}};
    return clip;
}

/// Shorter than any format plays.
Clip shortClip()
{
    Clip clip;
    clip.duration = 0.004;
    clip.bands = {{200.0, 200.0, 200.0, 0, {{0.0, 1.0}, {0.004, 0.0}}, {}}};
    return clip;
}

/// Nothing that is felt, of a band and of noise.
Clip faintClip()
{
    Clip clip;
    clip.duration = 1.5;
    clip.bands = {{200.0, 200.0, 200.0, 0, {{0.0, 0.001}, {1.5, 0.001}}, {}}};
    clip.noise = {{300.0, 500.0, {{0.0, 0.001}, {1.5, 0.001}}}};
    return clip;
}

/// `count` bands in equal steps from 40 Hz up, at full drive all the time.
Clip wideClip(std::size_t count)
{
    Clip clip;
    clip.duration = 0.5;
    for (std::size_t k = 0; k < count; ++k)
    {
        const double centre = 40.0 + 900.0 * static_cast<double>(k) / static_cast<double>(count);
        clip.bands.push_back({centre, centre, centre, 0, {{0.0, 1.0}, {0.5, 1.0}}, {}});
    }
    return clip;
}

std::vector<Clip> allClips()
{
    std::vector<Clip> clips{trainClip(), shortClip(), faintClip(), wideClip(2), wideClip(40), Clip{}};
    for (std::uint64_t seed = 1; seed <= 12; ++seed)
    {
        clips.push_back(randomFullClip(seed, 60));
        clips.back().duration = std::max(clips.back().duration, 0.1);
    }
    return clips;
}

/// What is lost by `clip` in all formats, by each choice that makes a difference; and why it cannot be exported.
void addLosses(const Clip& clip, Messages& messages, std::set<LossKind>& kinds)
{
    for (const ClipFormat& format : exportFormats())
    {
        std::vector<ExportParams> ways(1);
        ways.front().quick = true;
        const auto also = [&](auto change)
        {
            ways.push_back(ways.front());
            change(ways.back());
        };
        if (format.events)
            for (const EventExport events : {EventExport::transients, EventExport::merged})
                also([&](ExportParams& way) { way.events = events; });
        if (format.choices.amplitudePoints)
            also([](ExportParams& way) { way.amplitudePoints = way.frequencyPoints = 3.0; });
        if (format.choices.envelope)
        {
            also([](ExportParams& way) { way.envelope = {8, 20, 2000}; });
            also([](ExportParams& way) { way.envelope = {2, 1, 2}; });
            also([](ExportParams& way) { way.envelope = {8, 20, 25}; });
        }
        if (format.choices.split)
            also([](ExportParams& way) { way.split = true; });
        if (format.choices.profile)
            for (const char* name : {"lra-175", "erm-coin"})
                also([&](ExportParams& way) { way.profile = shippedProfile(name); });
        for (const ExportParams& way : ways)
        {
            ExportChoice choice;
            choice.format = format.name;
            choice.params = way;
            const auto lost = exportLosses(clip, choice);
            if (!lost)
                messages.add(lost.error().message);
            else
                for (const FormatLoss& loss : *lost)
                {
                    messages.add(loss.message);
                    kinds.insert(loss.kind);
                }
        }
    }
}

std::vector<Profile> allProfiles()
{
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(sourceFolder() / "profiles"))
        if (entry.path().extension() == ".json")
            files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    std::vector<Profile> profiles;
    for (const auto& file : files)
        profiles.push_back(shippedProfile(file.stem().string()));
    return profiles;
}

/// What actuators change of a clip and cannot play, step by step.
void addTrace(const Clip& clip, const Profile& profile, Messages& messages)
{
    const std::atomic<bool> cancelled{false};
    const auto trace = traceActuator(clip, profile, 0.5, cancelled);
    if (!trace)
    {
        messages.add(trace.error().message);
        return;
    }
    messages.addAll((*trace)->changes);
    for (std::size_t step = 0; step < (*trace)->losses.size(); ++step)
    {
        messages.add((*trace)->textOf(step));
        for (const auto& source : (*trace)->sources)
            messages.add((*trace)->textOf(source, step));
    }
}

/// Words of three Latin letters and more that are neither a unit nor a name in Japanese, too.
juce::StringArray latinWords(const juce::String& text)
{
    const juce::StringArray names{"kHz", "Android", "ERM", "bit", "MB", "hjif"};
    juce::StringArray words;
    juce::String word;
    for (const juce::juce_wchar c : text + " ")
        if ((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'))
            word += c;
        else
        {
            if (word.length() > 2 && !names.contains(word))
                words.add(word);
            word = {};
        }
    return words;
}

/// Whether each message has a form of its own in each language. `names` of actuators are the same in all.
void checkForms(const Messages& messages, const juce::StringArray& names)
{
    juce::StringArray missing;
    {
        const MarkedLanguage marked;
        for (const auto& [kind, message] : messages)
            for (const auto& word : unmarkedWords(editor::translateMessage(editor::toText(message)), names))
                missing.addIfNotAlreadyThere("no mark: " + word + ": " + editor::toText(message));
    }
    for (const auto& language : editor::languages())
    {
        // The table itself: the language needs a font, which a machine for tests may lack.
        std::ifstream file(sourceFolder() / "Resources/translations" / (language + ".txt").toStdString(),
                           std::ios::binary);
        editor::useTranslations(editor::toText(std::string(std::istreambuf_iterator<char>(file), {})));
        for (const auto& [kind, message] : messages)
        {
            auto said = editor::translateMessage(editor::toText(message));
            for (const auto& name : names)
                said = said.replace(name, {});
            if (said == editor::toText(message))
                missing.addIfNotAlreadyThere(language + ": " + editor::toText(message));
            if (language == "ja")
                for (const auto& word : latinWords(said))
                    missing.addIfNotAlreadyThere(language + ", " + word + ": " + said);
        }
    }
    editor::useLanguage("en");
    INFO(missing.joinIntoString("\n"));
    CHECK(missing.isEmpty());
}

/// What a reader of clips warns of, or why it refuses: of bytes as they are, and with single bytes changed or the end
/// cut off.
void addReading(const ClipFormat& format, const std::string& bytes, Messages& messages)
{
    const auto take = [&](const std::string& text)
    {
        const auto read = format.read(text);
        if (read)
            messages.addAll(read->warnings);
        else
            messages.add(read.error().message);
    };
    take(bytes);
    constexpr std::size_t most = 20000; // longer ones say the same, slowly
    if (bytes.empty() || bytes.size() > most)
        return;
    constexpr std::size_t changes = 60;
    const std::string others = "\"-9n ,[x";
    for (std::size_t i = 0; i < changes; ++i)
    {
        const std::size_t at = i * bytes.size() / changes;
        std::string changed = bytes;
        changed[at] = others[i % others.size()];
        take(changed);
        take(bytes.substr(0, at));
    }
}

/// The message without the place in front of it, such as "plays[2].gain: ", which may have a broken key in it.
juce::String withoutPlace(const juce::String& said)
{
    const auto mark = juce::String::fromUTF8("\xe2\x9f\xa6");
    const auto place = said.upToFirstOccurrenceOf(": " + mark, false, false);
    const bool isPlace = place.length() < said.length() && !place.contains(mark) &&
                         juce::StringArray::fromTokens(place, " ", {}).size() <= 2;
    return isPlace ? said.substring(place.length()) : said;
}
} // namespace

TEST_CASE("What readers of clips warn of, and why they refuse a file, has a form in every language")
{
    const juce::ScopedJuceInitialiser_GUI gui;
    Messages messages;
    for (const char* folder : {"Tests/fuzz/corpus", "Tests/fuzz/regressions"})
        for (const auto& entry : std::filesystem::recursive_directory_iterator(sourceFolder() / folder))
        {
            const ClipFormat* format = clipFormatNamed(entry.path().parent_path().filename().string());
            if (!entry.is_regular_file() || format == nullptr || format->reader == nullptr)
                continue;
            std::ifstream file(entry.path(), std::ios::binary);
            addReading(*format, std::string(std::istreambuf_iterator<char>(file), {}), messages);
        }
    for (const char* part : {"is limited to this range", "is cut off: ", "is missing", " is needed", "is unknown"})
    {
        CAPTURE(part);
        CHECK(messages.has(part));
    }
    juce::StringArray missing;
    const MarkedLanguage marked;
    for (const auto& [kind, message] : messages)
    {
        const auto said = withoutPlace(editor::translateMessage(editor::toText(message)));
        if (!unmarkedWords(said, {}).isEmpty())
            missing.add(said);
    }
    INFO(missing.joinIntoString("\n"));
    CHECK(missing.isEmpty());
}

TEST_CASE("Every loss that an export tells has a German and a Japanese form")
{
    const juce::ScopedJuceInitialiser_GUI gui;
    Messages messages;
    std::set<LossKind> kinds;
    for (const Clip& clip : allClips())
        addLosses(clip, messages, kinds);
    for (int kind = 0; kind <= static_cast<int>(LossKind::transient); ++kind)
    {
        CAPTURE(kind);
        CHECK(kinds.contains(static_cast<LossKind>(kind)));
    }
    checkForms(messages, {});
}

TEST_CASE("What an actuator changes, cannot play, and what cannot feel alike has a German and a Japanese form")
{
    const juce::ScopedJuceInitialiser_GUI gui;
    Messages messages;
    juce::StringArray names;
    const auto profiles = allProfiles();
    const std::vector<Clip> clips{trainClip(), faintClip(), wideClip(2), wideClip(9)};
    for (const Profile& profile : profiles)
    {
        names.add(editor::toText(profile.name));
        for (const Clip& clip : clips)
            addTrace(clip, profile, messages);
        for (const Profile& from : profiles)
            for (const Clip& clip : clips)
                if (const auto made = feltAlike(clip, from, profile, 0.5); made)
                    messages.addAll(made->lost);
                else
                    messages.add(made.error().message);
    }
    for (const char* part :
         {" dB weaker than where it was designed", " bands lie outside of ", " bands share ", "towards the resonance",
          "into the range", "levels are compressed into ", "is flattened down to ", " events become bursts",
          "protection reduces by ", "out of range: ", "not felt: "})
    {
        CAPTURE(part);
        CHECK(messages.has(part));
    }
    checkForms(messages, names);
}
