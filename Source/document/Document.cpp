#include "document/Document.h"

#include "document/ItemEdits.h"
#include "document/ProjectJson.h"
#include "io/AtomicFile.h"
#include "io/InputFile.h"

#include <algorithm>
#include <system_error>
#include <utility>

namespace pacini
{

namespace fs = std::filesystem;

Document::Document(Project project, fs::path path, bool saved)
    : content(std::move(project)), file(std::move(path)), history(content), savedState(saved ? history.id() : 0)
{
}

Result<Document> Document::open(const fs::path& path)
{
    std::error_code error;
    const fs::path absolute = fs::absolute(path, error).lexically_normal();
    const auto text = readWholeFile(absolute, largestProjectText);
    if (!text)
        return text.error();
    auto read = readProjectJson(*text, absolute.parent_path());
    if (!read)
        return read.error();
    return Document(std::move(read->project), absolute, true);
}

Result<Document> Document::recover(const fs::path& recoveryFile)
{
    const auto text = readWholeFile(recoveryFile, largestProjectText);
    if (!text)
        return text.error();
    auto read = readProjectJson(*text, recoveryFile.parent_path());
    if (!read)
        return read.error();
    const std::string path = read->recovery ? read->recovery->path : "";
    return Document(std::move(read->project), fs::path(std::u8string(path.begin(), path.end())), false);
}

Result<void> Document::save()
{
    if (file.empty())
        return Error{ErrorCode::invalidArgument, "", "the project has no file yet; choose one"};
    return saveAs(file);
}

Result<void> Document::saveAs(const fs::path& path)
{
    std::error_code error;
    const fs::path absolute = fs::absolute(path, error).lexically_normal();
    ProjectTextOptions options;
    options.folder = absolute.parent_path();
    if (auto written = writeFileAtomically(absolute, std::string_view(projectJson(content, options))); !written)
        return written.error();
    file = absolute;
    savedState = history.id();
    return {};
}

void Document::commit(std::string name, Project project, Gesture gesture)
{
    const bool continues = gesture != 0 && gesture == openGesture && history.canUndo() && !history.canRedo();
    if (!continues)
        beforeGesture = gesture != 0 ? content : Project{};
    content = std::move(project);
    if (continues)
        history.replaceNewest(content);
    else
        history.push(std::move(name), content);
    openGesture = gesture;
}

void Document::setProjectNotes(std::string notes, std::string name)
{
    Project next = content;
    next.notes = std::move(notes);
    commit(std::move(name), std::move(next));
}

void Document::setGroups(std::vector<std::string> groups, std::string name)
{
    Project next = content;
    next.groups = std::move(groups);
    commit(std::move(name), std::move(next));
}

void Document::renameGroup(const std::string& from, const std::string& to, std::string name)
{
    Project next = content;
    const bool known = to.empty() || std::find(next.groups.begin(), next.groups.end(), to) != next.groups.end();
    if (known)
        std::erase(next.groups, from);
    else
        std::replace(next.groups.begin(), next.groups.end(), from, to);
    for (auto& place : next.clips)
        if (place->group == from)
        {
            auto item = std::make_shared<ClipItem>(*place);
            item->group = to;
            place = std::move(item);
        }
    commit(std::move(name), std::move(next));
}

Result<void> Document::setProfile(ProjectProfile profile, std::string name)
{
    if (profile.embedded)
        if (auto valid = validate(*profile.embedded); !valid)
            return valid.error();
    Project next = content;
    next.profile = std::move(profile);
    commit(std::move(name), std::move(next));
    return {};
}

Result<void> Document::setSound(AudioReference sound, std::string name)
{
    std::vector<AudioReference> one;
    one.push_back(std::move(sound));
    return setSounds(std::move(one), std::move(name));
}

Result<void> Document::setSounds(std::vector<AudioReference> sounds, std::string name)
{
    Project next = content;
    for (AudioReference& sound : sounds)
    {
        const auto known = std::find_if(next.sources.begin(), next.sources.end(),
                                        [&](const AudioReference& one) { return one.id == sound.id; });
        if (known == next.sources.end())
            return Error{ErrorCode::invalidArgument, "sound", "is not one of the project's sounds"};
        *known = std::move(sound);
    }
    commit(std::move(name), std::move(next));
    return {};
}

void Document::goTo(std::size_t state)
{
    openGesture = 0;
    content = history.goTo(std::min(state, history.size() - 1));
}

bool Document::undo()
{
    if (!canUndo())
        return false;
    goTo(history.current() - 1);
    return true;
}

bool Document::redo()
{
    if (!canRedo())
        return false;
    goTo(history.current() + 1);
    return true;
}

Result<std::size_t> Document::exportClip(int id, const fs::path& path, const ClipFormat& format) const
{
    const auto item = clip(id);
    return item ? writeClip(path, *item->clip, format) : Result<std::size_t>(noSuchClip(id));
}

} // namespace pacini
