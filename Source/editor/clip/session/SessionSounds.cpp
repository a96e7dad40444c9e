// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/Text.h"
#include "editor/clip/session/Session.h"
#include "io/InputFile.h"

#include <pacini/foundation/Result.h>

#include <algorithm>
#include <utility>

namespace pacini::editor
{

namespace
{
constexpr std::size_t largestCopy = std::size_t(1) << 30; // bytes of a sound inside a project

std::vector<std::filesystem::path> foldersOf(const Document& document)
{
    const auto folder = document.path().parent_path();
    return folder.empty() ? std::vector<std::filesystem::path>{} : std::vector<std::filesystem::path>{folder};
}
} // namespace

// What is under way.

std::optional<WorkState> Session::workNow() const
{
    if (auto now = importer.state())
        return now;
    if (again)
        return WorkState{againText, again->progress};
    return std::nullopt;
}

void Session::stopWork()
{
    if (again)
        again->stopped = true;
    again.reset();
    importer.stop();
    changed(work);
}

void Session::showUnanalysed(std::shared_ptr<const Sound> read)
{
    if (!unanalysed)
        beforeUnanalysed = active;
    player.stop();
    unanalysed = std::move(read);
    active = 0;
    selectionNow = {};
    rangeNow.reset();
    auditionNow = {};
    startTime = 0.0;
    player.setSound(audioOf(unanalysed));
    follow();
    fit();
    changed(project | content | selection | range | sound | playback);
}

void Session::endUnanalysed()
{
    unanalysed.reset();
    const bool there = open->clip(beforeUnanalysed) != nullptr;
    show(there || isEmpty() ? beforeUnanalysed : open->project().clips.front()->id);
}

// Sounds of the project.

void Session::loadSound()
{
    const auto shown = item();
    const AudioReference* reference = shown ? open->project().findSource(shown->source) : nullptr;
    player.setSound(audioOf(soundOfClip()));
    if (reference == nullptr || sounds.contains(shown->source) || missing.contains(shown->source))
        return;
    const auto temporary = pathOf(juce::File::getSpecialLocation(juce::File::tempDirectory));
    jobs.run(
        [reference = *reference, folders = foldersOf(*open), temporary]() -> Result<std::shared_ptr<const Sound>>
        {
            auto audio = loadAudio(reference, folders, temporary);
            if (!audio)
                return audio.error();
            return std::make_shared<const Sound>(std::move(audio).value());
        },
        [this, id = shown->source, of = generation](Result<std::shared_ptr<const Sound>> read)
        {
            if (of != generation)
                return;
            // That it is missing was told when all were looked for.
            if (!read && missing.contains(id))
                return;
            if (!read)
            {
                missing.insert(id);
                changed(sound);
                return report("The sound cannot be read; the clip can be edited without it", read.error());
            }
            sounds[id] = *read;
            player.setSound(audioOf(soundOfClip()));
            changed(sound);
        });
}

void Session::checkSounds()
{
    if (open->project().sources.empty())
        return;
    jobs.run(
        [sources = open->project().sources, folders = foldersOf(*open)]
        {
            std::vector<AudioReference> lost;
            std::error_code ignored;
            for (const AudioReference& source : sources)
                if (!source.embedded && !std::filesystem::is_regular_file(source.path, ignored) &&
                    !locateAudio(source, folders))
                    lost.push_back(source);
            return lost;
        },
        [this, of = generation](const std::vector<AudioReference>& lost)
        {
            if (of != generation || lost.empty())
                return;
            for (const AudioReference& source : lost)
                missing.insert(source.id);
            changed(sound);
            if (onSoundsMissing)
                onSoundsMissing(lost);
        });
}

void Session::findSounds(const std::filesystem::path& chosen)
{
    std::vector<AudioReference> lost;
    for (const AudioReference& source : open->project().sources)
        if (missing.contains(source.id))
            lost.push_back(source);
    jobs.run([lost, chosen] { return foundBy(chosen, lost); },
             [this, chosen, of = generation, wanted = lost.size()](const std::vector<AudioReference>& found)
             {
                 if (of != generation)
                     return;
                 if (found.empty())
                     return report(chosen.filename().string() + " is another sound",
                                   {ErrorCode::invalidData, "",
                                    "Its content is not that of the missing sound, and the missing sound is not beside "
                                    "it. To use it all the same, choose \"Replace sound...\" on the page Analysis."});
                 for (const AudioReference& source : found)
                     missing.erase(source.id);
                 change([&](Document& document)
                        { return document.setSounds(found, found.size() > 1 ? "Find sounds" : "Find sound"); });
                 loadSound();
                 changed(sound);
                 if (found.size() < wanted && onError)
                     onError("Some sounds are still missing", juce::String(static_cast<int>(found.size())) + " of " +
                                                                  juce::String(static_cast<int>(wanted)) +
                                                                  " were found there.");
             });
}

void Session::keepSound(int sourceId, bool wanted)
{
    const AudioReference* reference = open->project().findSource(sourceId);
    if (reference == nullptr || (reference->embedded != nullptr) == wanted)
        return;
    // Also before the copy is given up: it may be the only one.
    jobs.run(
        [reference = *reference, folders = foldersOf(*open), wanted]() -> Result<AudioReference>
        {
            AudioReference now = reference;
            now.embedded.reset();
            const auto found = locateAudio(now, folders);
            if (!found || found->changed)
                return Error{ErrorCode::io, "",
                             wanted ? "The sound is not where it was, so that it cannot be copied."
                                    : "The file " + reference.path.filename().string() +
                                          " is not there any more: the copy in the project is the only one."};
            now.path = found->path;
            if (!wanted)
                return now;
            auto bytes = readWholeFile(found->path, largestCopy);
            if (!bytes)
                return bytes.error();
            now.embedded = std::make_shared<const std::string>(std::move(bytes).value());
            return now;
        },
        [this, of = generation, wanted](Result<AudioReference> read)
        {
            if (of != generation)
                return;
            if (!read)
                report(wanted ? "The sound was not copied" : "The copy is kept", read.error());
            else
                change([&](Document& document)
                       { return document.setSound(*read, wanted ? "Keep a copy of the sound" : "Keep no copy"); });
            changed(sound);
        });
}

// Analyses of clips that exist.

void Session::reanalyse(const EncoderParams& wanted)
{
    const auto now = item();
    const auto heard = soundOfClip();
    const AudioReference* reference = now ? open->project().findSource(now->source) : nullptr;
    if (!heard || reference == nullptr)
        return;
    if (auto valid = validate(wanted); !valid)
        return report("That is not possible", valid.error());
    Again next{active, wanted, "Analysis", std::make_shared<Task>()};
    againText = "Analysing " + toText(now->clip->name) + " again";
    analyseAgain(std::move(next),
                 [heard, reference = *reference]() -> Result<Imported> {
                     return Imported{reference, heard, {}, {}, {}};
                 });
}

void Session::replaceSound(const std::filesystem::path& file)
{
    const auto now = item();
    if (!now)
        return;
    Again next{active, now->encoder, "Replace sound", std::make_shared<Task>()};
    againText = "Analysing " + pathText(file.filename());
    analyseAgain(std::move(next),
                 [file]() -> Result<Imported>
                 {
                     auto read = readFile(file);
                     if (read && !read->sound)
                         return Error{ErrorCode::invalidData, file.filename().string(), "is a clip, not a sound"};
                     return read;
                 });
}

void Session::analyseAgain(Again wanted, const std::function<Result<Imported>()>& read)
{
    if (again)
        again->stopped = true;
    again = wanted.task;
    const bool otherSound = wanted.name == "Replace sound";
    jobs.run(
        [wanted, read]() -> Result<Imported>
        {
            if (wanted.task->stopped)
                return Error{ErrorCode::invalidData, "", "was stopped"};
            auto imported = read();
            if (!imported)
                return imported;
            auto clip = analyse(imported->sound->audio, wanted.params, imported->reference,
                                [&wanted](double done) { return wanted.task->goOn(done); });
            if (!clip)
                return clip.error();
            imported->clip = std::move(clip).value();
            return imported;
        },
        [this, wanted, otherSound, of = generation](Result<Imported> analysed)
        {
            if (of == generation && !wanted.task->stopped)
                putAgain(wanted, std::move(analysed), otherSound);
        });
    changed(work);
}

void Session::putAgain(const Again& done, Result<Imported> analysed, bool otherSound)
{
    again.reset();
    changed(work);
    const auto now = open->clip(done.clip);
    if (!now)
        return;
    if (!analysed)
        return report(otherSound ? "The sound was not replaced" : "Not analysed", analysed.error());
    // The clip keeps its name, whatever its sound is called.
    analysed->clip.name = now->analysis->name;
    std::optional<AudioReference> other;
    if (otherSound)
        other = analysed->reference;
    const bool put = change(
        [&](Document& document)
        { return document.reanalyse(done.clip, done.name, done.params, std::move(analysed->clip), std::move(other)); });
    if (!put || !otherSound)
        return;
    const int source = open->clip(done.clip)->source;
    sounds[source] = analysed->sound;
    missing.erase(source);
    player.setSound(audioOf(soundOfClip()));
    fit();
    changed(Session::sound);
}

} // namespace pacini::editor
