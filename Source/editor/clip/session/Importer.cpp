// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/session/Importer.h"

#include "document/FolderFiles.h"
#include "editor/Text.h"
#include "editor/Translation.h"
#include "editor/clip/session/ProjectSounds.h"

#include <utility>

namespace pacini::editor
{

namespace
{
constexpr int maxLines = 12; // of a message

juce::String shortened(const juce::StringArray& lines)
{
    juce::StringArray shown(lines);
    shown.removeRange(maxLines, shown.size());
    if (lines.size() > maxLines)
        shown.add(tr("and {0} more", {juce::String(lines.size() - maxLines)}));
    return shown.joinIntoString("\n");
}
} // namespace

void Importer::add(const std::vector<std::filesystem::path>& files)
{
    waiting.insert(waiting.end(), files.begin(), files.end());
    if (!task)
        next();
    else
        tellWork();
}

void Importer::stop()
{
    waiting.clear();
    if (!task)
        return;
    task->stopped = true;
    task.reset();
    if (model.isShowingUnanalysed())
        model.endUnanalysed();
    finish();
}

std::optional<WorkState> Importer::state() const
{
    if (!task)
        return std::nullopt;
    WorkState now{doing, task->progress};
    if (const std::size_t all = begun + waiting.size(); all > 1)
        now.text = tr("{0} ({1} of {2})",
                      {now.text, juce::String(static_cast<int>(begun)), juce::String(static_cast<int>(all))});
    return now;
}

void Importer::tellWork()
{
    sounds.workChanged.emit();
}

void Importer::next()
{
    task.reset();
    if (waiting.empty())
        return finish();
    const auto file = waiting.front();
    waiting.pop_front();
    task = std::make_shared<Task>();
    std::error_code ignored;
    if (std::filesystem::is_directory(file, ignored))
        list(file);
    else
        read(file);
    tellWork();
}

void Importer::list(const std::filesystem::path& folder)
{
    doing = tr("Scanning {0}", {pathText(folder.filename())});
    jobs.run([folder] { return openableFiles(folder); },
             [this, folder, mine = task](const std::vector<std::filesystem::path>& found)
             {
                 if (mine->stopped)
                     return;
                 waiting.insert(waiting.begin(), found.begin(), found.end());
                 if (found.empty())
                     failures.add(tr("{0} contains no sounds or clips", {pathText(folder.filename())}));
                 next();
             });
}

void Importer::read(const std::filesystem::path& file)
{
    ++begun;
    doing = tr("Reading {0}", {pathText(file.filename())});
    jobs.run([file, mine = task] { return mine->stopped ? Result<Imported>(wasCancelled()) : readFile(file); },
             [this, file, mine = task](Result<Imported> imported)
             {
                 if (mine->stopped)
                     return;
                 if (!imported)
                     return fail(file, imported.error());
                 if (imported->sound)
                     return analyseSound(std::move(imported).value());
                 if (imported->scene)
                     return putScene(file, *imported);
                 put(std::move(imported).value());
             });
}

void Importer::analyseSound(Imported imported)
{
    if (!anyShown)
        model.showUnanalysed(imported.sound);
    doing = tr("Analysing {0}", {pathText(imported.reference.path.filename())});
    task->progress = 0.0;
    jobs.run(
        [imported, mine = task]
        {
            return analyse(imported.sound->audio, imported.encoder, imported.reference,
                           [mine](double done) { return mine->goOn(done); });
        },
        [this, imported, mine = task](Result<Clip> clip)
        {
            if (mine->stopped)
                return;
            if (!clip)
                return fail(imported.reference.path, clip.error());
            Imported whole = imported;
            whole.clip = std::move(clip).value();
            put(std::move(whole));
        });
    tellWork();
}

void Importer::put(Imported imported)
{
    const juce::String name = toText(imported.clip.name);
    for (const auto& warning : imported.warnings)
        gaps.add(name + ": " + translateMessage(toText(warning)));
    // A sound was shown unless the user has turned to another clip since.
    const bool shown = !anyShown && (!imported.sound || model.isShowingUnanalysed());
    const auto id = sounds.insert(std::move(imported));
    if (!id)
        failures.add(name + ": " + translateMessage(toText(id.error().text())));
    else if (shown)
        model.show(*id);
    anyShown = true;
    next();
}

void Importer::putScene(const std::filesystem::path& file, const Imported& imported)
{
    const juce::String name = pathText(file.filename());
    for (const auto& warning : imported.warnings)
        gaps.add(name + ": " + translateMessage(toText(warning)));
    if (const auto opened = model.openScene(*imported.scene, file.stem().string()); !opened)
        failures.add(name + ": " + translateMessage(toText(opened.error().text())));
    next();
}

void Importer::fail(const std::filesystem::path& file, const Error& error)
{
    if (model.isShowingUnanalysed())
        model.endUnanalysed();
    failures.add(pathText(file.filename()) + ": " + translateMessage(toText(error.message)));
    next();
}

void Importer::finish()
{
    const auto failed = std::exchange(failures, {});
    const auto missed = std::exchange(gaps, {});
    const std::size_t all = std::exchange(begun, 0);
    anyShown = false;
    tellWork();
    if (!model.onError || (failed.isEmpty() && missed.isEmpty()))
        return;
    juce::String title = tr("Imported with losses"), text;
    if (!failed.isEmpty())
    {
        title = all > 1 ? tr("{0} of {1} files not opened",
                             {juce::String(failed.size()), juce::String(static_cast<int>(all))})
                        : tr("Not opened");
        text = shortened(failed);
    }
    if (!missed.isEmpty())
        text << (failed.isEmpty() ? juce::String() : "\n\n" + tr("Imported with losses:") + "\n") << shortened(missed);
    model.onError(title, text);
}

} // namespace pacini::editor
