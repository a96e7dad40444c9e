// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/session/ProjectSounds.h"

#include "document/Amendments.h"
#include "document/ProjectEdits.h"
#include "editor/Text.h"
#include "editor/Translation.h"
#include "io/FinishedClip.h"
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

/// Gives an analysis the name that its clip has, whatever its sound is called.
void keepName(Clip& analysis, const ClipItem& item)
{
    ClipNames names{item.analysis->name, analysis.source.file};
    analysis = finishClip(std::move(analysis), std::move(names));
}
} // namespace

ProjectSounds::ProjectSounds(EditorModel& project) : model(project), importer(project, *this, jobs)
{
    subscriptions.on({&model.opened}, [this] { forget(); });
    subscriptions.on({&model.contentChanged}, [this] { load(); });
}

ProjectSounds::~ProjectSounds()
{
    subscriptions = {};
    stopAnalysis();
    importer.stop();
}

/// For another project.
void ProjectSounds::forget()
{
    stopWork();
    ++generation;
    sounds.clear();
    missing.clear();
    loading.clear();
    lookForAll();
}

void ProjectSounds::stopAnalysis()
{
    if (again)
        again->stopped = true;
    again.reset();
}

// Files on their way in.

void ProjectSounds::openFiles(const std::vector<std::filesystem::path>& files)
{
    std::vector<std::filesystem::path> others;
    for (const auto& file : files)
        if (file.extension() == ".pacini")
        {
            if (auto opened = model.openProject(file); !opened)
                model.report(tr("{0} not opened", {pathText(file.filename())}).toStdString(), opened.error());
        }
        else
            others.push_back(file);
    importer.add(others);
}

Result<int> ProjectSounds::insert(Imported imported)
{
    return model.insert(
        [&](Document& document)
        {
            if (!imported.sound)
                return addClip(document, imported.clip);
            auto id = addSound(document, imported.reference, imported.encoder, imported.clip);
            if (id)
                sounds[document.clip(*id)->source] = imported.sound;
            return id;
        });
}

void ProjectSounds::add(Imported imported)
{
    const auto id = insert(std::move(imported));
    if (!id)
        return model.report("Not added", id.error());
    model.show(*id);
}

// What is under way.

std::optional<WorkState> ProjectSounds::workNow() const
{
    if (auto now = importer.state())
        return now;
    if (again)
        return WorkState{againText, again->progress};
    return std::nullopt;
}

void ProjectSounds::stopWork()
{
    stopAnalysis();
    importer.stop();
    workChanged.emit();
}

// Sounds of the project.

std::shared_ptr<const Sound> ProjectSounds::soundOfClip() const
{
    if (model.isShowingUnanalysed())
        return model.unanalysedSound();
    const auto shown = model.item();
    const auto found = shown ? sounds.find(shown->source) : sounds.end();
    return found != sounds.end() ? found->second : nullptr;
}

void ProjectSounds::load()
{
    const auto shown = model.item();
    const AudioReference* reference = shown ? model.document().project().findSource(shown->source) : nullptr;
    if (reference == nullptr || sounds.contains(shown->source) || missing.contains(shown->source) ||
        !loading.insert(shown->source).second)
        return;
    const auto temporary = pathOf(juce::File::getSpecialLocation(juce::File::tempDirectory));
    jobs.run(
        [reference = *reference, folders = foldersOf(model.document()),
         temporary]() -> Result<std::shared_ptr<const Sound>>
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
            loading.erase(id);
            // That it is missing was told when all were looked for.
            if (!read && missing.contains(id))
                return;
            if (!read)
            {
                missing.insert(id);
                changed.emit();
                return model.report("Cannot read the sound; the clip can be edited without it", read.error());
            }
            sounds[id] = *read;
            changed.emit();
        });
}

void ProjectSounds::lookForAll()
{
    if (model.document().project().sources.empty())
        return;
    jobs.run(
        [sources = model.document().project().sources, folders = foldersOf(model.document())]
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
            changed.emit();
            if (onSoundsMissing)
                onSoundsMissing(lost);
        });
}

void ProjectSounds::findSounds(const std::filesystem::path& chosen)
{
    std::vector<AudioReference> lost;
    for (const AudioReference& source : model.document().project().sources)
        if (missing.contains(source.id))
            lost.push_back(source);
    jobs.run([lost, chosen] { return foundBy(chosen, lost); },
             [this, chosen, of = generation, wanted = lost.size()](const std::vector<AudioReference>& found)
             {
                 if (of != generation)
                     return;
                 if (found.empty())
                     return model.report(
                         tr("{0} is a different sound", {pathText(chosen.filename())}).toStdString(),
                         {ErrorCode::invalidData, "",
                          "Its content differs from the missing sound, and the missing sound is not in its folder. To "
                          "use it anyway, choose \"Replace sound...\" on the Analysis page."});
                 for (const AudioReference& source : found)
                     missing.erase(source.id);
                 model.commit(found.size() > 1 ? "Find sounds" : "Find sound",
                              withSounds(model.document().project(), found));
                 load();
                 changed.emit();
                 if (found.size() < wanted && model.onError)
                     model.onError("Some sounds are still missing",
                                   tr("{0} of {1} were found there.", {juce::String(static_cast<int>(found.size())),
                                                                       juce::String(static_cast<int>(wanted))}));
             });
}

void ProjectSounds::keepSound(int sourceId, bool wanted)
{
    const AudioReference* reference = model.document().project().findSource(sourceId);
    if (reference == nullptr || (reference->embedded != nullptr) == wanted)
        return;
    // Also before the copy is given up: it may be the only one.
    jobs.run(
        [reference = *reference, folders = foldersOf(model.document()), wanted]() -> Result<AudioReference>
        {
            AudioReference now = reference;
            now.embedded.reset();
            const auto found = locateAudio(now, folders);
            if (!found || found->changed)
                return Error{ErrorCode::io, "",
                             wanted ? "The sound file has moved or changed and cannot be embedded."
                                    : "The file " + reference.path.filename().string() +
                                          " is gone; the embedded sound is the only copy left."};
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
                model.report(wanted ? "Sound not embedded" : "Embedded sound kept", read.error());
            else
                model.commit(wanted ? "Embed sound" : "Remove embedded sound",
                             withSounds(model.document().project(), {*read}));
            changed.emit();
        });
}

// Analyses of clips that exist.

void ProjectSounds::reanalyse(const EncoderParams& wanted)
{
    const auto now = model.item();
    const auto heard = soundOfClip();
    const AudioReference* reference = now ? model.document().project().findSource(now->source) : nullptr;
    if (!heard || reference == nullptr)
        return;
    if (auto valid = validate(wanted); !valid)
        return model.report("Not possible", valid.error());
    Again next{model.activeId(), wanted, "Analysis", std::make_shared<Task>()};
    againText = tr("Re-analysing {0}", {toText(now->clip->name)});
    analyseAgain(std::move(next),
                 [heard, reference = *reference]() -> Result<Imported> {
                     return Imported{reference, heard, {}, {}, {}};
                 });
}

void ProjectSounds::reanalyse(const std::vector<int>& clips, const EncoderParams& wanted)
{
    if (auto valid = validate(wanted); !valid)
        return model.report("Not possible", valid.error());
    struct Source
    {
        int clip;
        AudioReference reference;
        std::shared_ptr<const Sound> sound; ///< null: not read yet
    };
    std::vector<Source> sources;
    for (const int id : clips)
        if (const auto item = model.document().clip(id))
            if (const auto* reference = model.document().project().findSource(item->source))
            {
                const auto known = sounds.find(item->source);
                sources.push_back({id, *reference, known != sounds.end() ? known->second : nullptr});
            }
    if (sources.empty())
        return;
    stopAnalysis();
    again = std::make_shared<Task>();
    againText = tr("Re-analysing {0} clips", {juce::String(static_cast<int>(sources.size()))});
    const auto temporary = pathOf(juce::File::getSpecialLocation(juce::File::tempDirectory));
    jobs.run(
        [sources, wanted, temporary, folders = foldersOf(model.document()),
         task = again]() -> Result<std::vector<Reanalysis>>
        {
            std::vector<Reanalysis> done;
            for (const Source& source : sources)
            {
                std::optional<StoredAudio> read;
                if (!source.sound)
                {
                    auto audio = loadAudio(source.reference, folders, temporary);
                    if (!audio)
                        return audio.error();
                    read = std::move(*audio);
                }
                const double before = static_cast<double>(done.size()), all = static_cast<double>(sources.size());
                auto clip = analyse(source.sound ? source.sound->audio : *read, wanted, source.reference,
                                    [&](double part) { return task->goOn((before + part) / all); });
                if (!clip)
                    return clip.error();
                done.push_back({source.clip, std::move(*clip)});
            }
            return done;
        },
        [this, wanted, task = again, of = generation](Result<std::vector<Reanalysis>> done)
        {
            if (of != generation || task->stopped)
                return;
            again.reset();
            workChanged.emit();
            if (!done)
                return model.report("Not analysed", done.error());
            // Clips keep their names; those that were removed meanwhile are gone.
            std::erase_if(*done, [this](const auto& one) { return !model.document().clip(one.id); });
            for (auto& one : *done)
                keepName(one.analysis, *model.document().clip(one.id));
            const Document& document = model.document();
            model.commit("Analysis of clips",
                         withAnalyses(document.project(), wanted, std::move(*done), document.steps().newIds().source));
        });
    workChanged.emit();
}

void ProjectSounds::replaceSound(const std::filesystem::path& file)
{
    const auto now = model.item();
    if (!now)
        return;
    Again next{model.activeId(), now->encoder, "Replace sound", std::make_shared<Task>()};
    againText = tr("Analysing {0}", {pathText(file.filename())});
    analyseAgain(std::move(next),
                 [file]() -> Result<Imported>
                 {
                     auto read = readFile(file);
                     if (read && !read->sound)
                         return Error{ErrorCode::invalidData, file.filename().string(), "is a clip, not a sound"};
                     return read;
                 });
}

void ProjectSounds::analyseAgain(Again wanted, const std::function<Result<Imported>()>& read)
{
    if (again)
        again->stopped = true;
    again = wanted.task;
    const bool otherSound = wanted.name == "Replace sound";
    jobs.run(
        [wanted, read]() -> Result<Imported>
        {
            if (wanted.task->stopped)
                return wasCancelled();
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
    workChanged.emit();
}

void ProjectSounds::putAgain(const Again& done, Result<Imported> analysed, bool otherSound)
{
    again.reset();
    workChanged.emit();
    const auto now = model.document().clip(done.clip);
    if (!now)
        return;
    if (!analysed)
        return model.report(otherSound ? "Sound not replaced" : "Not analysed", analysed.error());
    keepName(analysed->clip, *now);
    std::optional<AudioReference> other;
    if (otherSound)
        other = analysed->reference;
    const bool put = model.change(
        [&](Document& document)
        {
            auto reanalysed =
                document.commit(done.name, withAnalysis(document.project(), done.params,
                                                        {done.clip, std::move(analysed->clip), std::move(other)},
                                                        document.steps().newIds().source));
            if (reanalysed && otherSound)
            {
                const int source = document.clip(done.clip)->source;
                sounds[source] = analysed->sound;
                missing.erase(source);
            }
            return reanalysed;
        });
    if (!put || !otherSound)
        return;
    changed.emit();
    replaced.emit();
}

} // namespace pacini::editor
