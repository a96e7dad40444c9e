#include "document/Document.h"

#include "document/ProjectJson.h"
#include "io/AtomicFile.h"
#include "io/InputFile.h"

#include <algorithm>
#include <system_error>
#include <utility>

namespace pacini
{

namespace fs = std::filesystem;

namespace
{
Result<ReadProject> readProject(const fs::path& file)
{
    const auto text = readWholeFile(file, largestProjectText);
    return text ? readProjectJson(*text, file.parent_path()) : text.error();
}
} // namespace

Document::Document(Project project, fs::path path, bool saved)
    : content(std::move(project)), file(std::move(path)), history(content), savedState(saved ? history.id() : 0)
{
}

Result<Document> Document::open(const fs::path& path)
{
    std::error_code error;
    const fs::path absolute = fs::absolute(path, error).lexically_normal();
    auto read = readProject(absolute);
    if (!read)
        return read.error();
    return Document(std::move(read->project), absolute, true);
}

Result<Document> Document::recover(const fs::path& recoveryFile)
{
    auto read = readProject(recoveryFile);
    if (!read)
        return read.error();
    const std::string path = read->recovery ? read->recovery->path : "";
    return Document(std::move(read->project), fs::path(std::u8string(path.begin(), path.end())), false);
}

Result<void> Document::save()
{
    if (file.empty())
        return Error{ErrorCode::invalidArgument, "", "the project has not been saved yet; choose a file"};
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

Result<void> Document::commit(std::string name, Result<Project> next, Gesture gesture)
{
    if (!next)
        return next.error();
    const bool continues = gesture != 0 && gesture == openGesture && history.canUndo() && !history.canRedo();
    if (!continues && next->clips == content.clips && *next == content)
        return {};
    if (!continues)
        beforeGesture = gesture != 0 ? content : Project{};
    content = std::move(next).value();
    if (continues)
        history.replaceNewest(content);
    else
        history.push(std::move(name), content);
    openGesture = gesture;
    return {};
}

void Document::amend(const std::vector<std::shared_ptr<const ClipItem>>& added,
                     const std::function<void(Project&)>& change)
{
    const auto both = [&](Project& project)
    {
        change(project);
        project.clips.insert(project.clips.end(), added.begin(), added.end());
    };
    both(content);
    if (openGesture != 0)
        both(beforeGesture);
    history.amend(content, added.size(), change);
}

void Document::goTo(std::size_t state)
{
    openGesture = 0;
    content = history.goTo(std::min(state, history.size() - 1));
}

bool Document::undo()
{
    if (!history.canUndo())
        return false;
    goTo(history.current() - 1);
    return true;
}

bool Document::redo()
{
    if (!history.canRedo())
        return false;
    goTo(history.current() + 1);
    return true;
}

} // namespace pacini
