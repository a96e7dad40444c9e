// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/sheets/OverwriteQuestion.h"

#include "editor/Text.h"
#include "editor/Translation.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace pacini::editor
{

namespace
{
juce::String kindText(const StandingFile& file)
{
    const char* what = "{0} is a file that Pacini cannot tell the kind of.";
    switch (file.kind)
    {
    case FileKind::sound:
        what = "{0} is a sound that Pacini did not make. Overwriting it would destroy a recording.";
        break;
    case FileKind::madeSound:
        what = "{0} is a sound that Pacini made.";
        break;
    case FileKind::clip:
        what = "{0} is a clip.";
        break;
    case FileKind::scene:
        what = "{0} is a scene.";
        break;
    case FileKind::texture:
        what = "{0} is a texture.";
        break;
    case FileKind::profile:
        what = "{0} is the profile of an actuator.";
        break;
    case FileKind::project:
        what = "{0} is a project of the editor.";
        break;
    case FileKind::folder:
    case FileKind::other:
        break;
    }
    return tr(what, {pathText(file.path.filename())});
}
} // namespace

std::unique_ptr<Sheet> overwriteQuestion(const std::vector<StandingFile>& standing, std::function<void()> replace)
{
    constexpr std::size_t most = 5;
    juce::StringArray lines;
    for (std::size_t i = 0; i < std::min(standing.size(), most); ++i)
        lines.add(kindText(standing[i]));
    if (standing.size() > most)
        lines.add(tr("and {0} more", {juce::String(static_cast<int>(standing.size() - most))}));
    lines.add(tr("In {0}", {pathText(standing.front().path.parent_path())}));
    return std::make_unique<MessageSheet>(
        standing.size() == 1 ? tr("Replace {0}?", {pathText(standing.front().path.filename())})
                             : tr("Replace {0} files?", {juce::String(static_cast<int>(standing.size()))}),
        lines.joinIntoString("\n"), std::vector<Sheet::Answer>{{"Cancel", {}}, {"Replace", std::move(replace)}});
}

void writeAfterAsking(const std::vector<std::filesystem::path>& files, const ProjectFileSet& needed,
                      std::function<void()> write, const std::function<void(std::unique_ptr<Sheet>)>& show,
                      const std::function<void(const Error&)>& refused)
{
    const auto standing = filesInTheWay(files, needed);
    if (!standing)
        refused(standing.error());
    else if (standing->empty())
        write();
    else
        show(overwriteQuestion(*standing, std::move(write)));
}

} // namespace pacini::editor
