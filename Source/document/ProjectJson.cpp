#include "document/ProjectJson.h"

#include "document/Base64.h"
#include "document/ProjectFields.h"
#include "document/ProjectScene.h"
#include "io/FieldsHandler.h"
#include "io/FieldsReader.h"
#include "io/FieldsWriter.h"
#include "io/InputFile.h"
#include "io/JsonTree.h"
#include "io/formats/json/ClipFields.h"
#include "io/formats/json/ClipJson.h"

#include <fmt/format.h>

#include <optional>
#include <set>
#include <utility>

namespace pacini
{

namespace fs = std::filesystem;

namespace
{
using namespace projectFields;

using ClipPointer = std::shared_ptr<const Clip>;

class Writer : public FieldsWriter
{
public:
    Writer() : FieldsWriter(Layout::spaced) { format({projectFormatName, projectFormatVersion}); }

    void clip(const char* name, const ClipPointer& value)
    {
        if (value)
            json(name, writeClipJson(*value));
    }
};

/// The tree of a project, in which a number refers to each clip.
class ProjectTree final : public JsonTreeBuilder
{
public:
    std::vector<ClipPointer> clips;

    bool openObject() override
    {
        if (!std::exchange(clipComes, false))
            return JsonTreeBuilder::openObject();
        clip = std::make_shared<Clip>();
        return passOn(reader.emplace(*clip, clipFields::embedded));
    }
    bool passedOn() override
    {
        clips.push_back(std::move(clip));
        return number(static_cast<double>(clips.size() - 1));
    }
    bool openList() override
    {
        clipComes = false;
        return JsonTreeBuilder::openList();
    }
    bool key(std::string_view name) override
    {
        clipComes = name == "clip" || name == "analysis";
        return JsonTreeBuilder::key(name);
    }

private:
    std::shared_ptr<Clip> clip; ///< that is being read
    std::optional<FieldsHandler> reader;
    bool clipComes = false;
};

class Reader : public FieldsReader
{
public:
    explicit Reader(const ProjectTree& projectTree) : FieldsReader(projectTree.root), tree(projectTree) {}

    void clip(const char* name, ClipPointer& value)
    {
        double index = -1.0;
        number(name, index, Need::optional);
        if (index >= 0.0 && index < static_cast<double>(tree.clips.size()))
            value = tree.clips[static_cast<std::size_t>(index)];
    }

private:
    const ProjectTree& tree;
};

std::string utf8(const fs::path& path)
{
    const auto text = path.generic_u8string();
    return {text.begin(), text.end()};
}

fs::path pathOf(const std::string& text)
{
    return fs::path(std::u8string(text.begin(), text.end()));
}

/// A path as it is written: relative where there is a way that does not leave the disk.
std::string writtenPath(const fs::path& path, const fs::path& folder)
{
    if (folder.empty() || !path.is_absolute())
        return utf8(path);
    const fs::path relative = path.lexically_relative(folder);
    return utf8(relative.empty() ? path : relative);
}

template <typename Source, typename Visitor>
void visitSource(Source& source, std::string& path, std::string& embedded, std::string& embeddedFile, Visitor& visitor)
{
    visitor.integer("id", source.id, "must be a whole number");
    visitor.text("path", path);
    visitWhole(source.bytes, "bytes", visitor);
    visitor.number("duration", source.duration, Need::usual);
    visitor.number("sampleRate", source.sampleRate, Need::usual);
    visitor.integer("channels", source.channels, "must be a whole number");
    visitor.text("hash", source.hash);
    visitor.optionalText("embedded", embedded);
    visitor.optionalText("embeddedFile", embeddedFile);
}

template <typename Item, typename Visitor>
void visitItem(Item& item, Visitor& visitor)
{
    visitor.integer("id", item.id, "must be a whole number");
    visitor.optionalText("group", item.group);
    visitor.optionalText("notes", item.notes);
    visitor.list("tags", item.tags, most, "tags", [&](auto& tag) { visitor.text("name", tag); });
    visitor.integer("source", item.source, "must be a whole number");
    visitor.object("encoder", item.encoder, Need::usual, [&](auto& params) { visitEncoder(params, visitor); });
    visitor.clip("clip", item.clip);
    visitor.list("unfitting", item.unfitting, most, "edits",
                 [&](auto& unfitting)
                 {
                     int edit = static_cast<int>(unfitting.edit);
                     visitor.integer("edit", edit, "must be a whole number");
                     if constexpr (isReader<Visitor>)
                         unfitting.edit = static_cast<std::size_t>(std::max(edit, 0));
                     visitor.text("reason", unfitting.reason);
                 });
}

/// A clip with its edits as one list, which files have.
struct OpenItem
{
    ClipItem item;
    std::vector<Edit> edits;
};

std::optional<Error> checkReferences(const Project& project)
{
    const auto wrong = [](std::string where, std::string message)
    {
        return Error{ErrorCode::invalidData, std::move(where), std::move(message)};
    };
    std::set<int> sources;
    for (std::size_t i = 0; i < project.sources.size(); ++i)
        if (!sources.insert(project.sources[i].id).second || project.sources[i].id < 1)
            return wrong(fmt::format("sources[{}].id", i), "must be 1 or more and its own");
    std::set<int> clips;
    for (std::size_t i = 0; i < project.clips.size(); ++i)
    {
        const ClipItem& item = *project.clips[i];
        const std::string where = fmt::format("clips[{}]", i);
        if (!clips.insert(item.id).second || item.id < 1)
            return wrong(where + ".id", "must be 1 or more and its own");
        if (item.source != 0 && !sources.contains(item.source))
            return wrong(where + ".source", "is not the id of one of the sources");
        if (auto valid = validate(item.encoder); !valid)
            return wrong(where + ".encoder." + valid.error().where, valid.error().message);
        for (std::size_t k = 0; k < item.unfitting.size(); ++k)
            if (item.unfitting[k].edit >= item.edits.size())
                return wrong(fmt::format("{}.unfitting[{}].edit", where, k), "is not the index of an edit");
    }
    if (project.profile.embedded)
        if (auto valid = validate(*project.profile.embedded); !valid)
            return wrong("profile.content." + valid.error().where, valid.error().message);
    if (!isStrength(project.profile.strength))
        return wrong("profile.strength", "must be 0 to 1");
    if (auto valid = validate(project.scene); !valid)
        return wrong("scene." + valid.error().where, valid.error().message);
    return {};
}
} // namespace

std::string projectJson(const Project& project, const ProjectTextOptions& options)
{
    Writer writer;
    if (options.recovery != nullptr)
        writer.object("recovery", *options.recovery, Need::usual,
                      [&](const RecoveryNote& note)
                      {
                          writer.text("path", note.path);
                          writer.number("time", note.time, Need::required);
                          writer.number("process", note.process, Need::required);
                          writer.object("place", note.place, Need::optional,
                                        [&](const WorkPlace& place) { visitPlace(place, writer); });
                      });
    writer.optionalText("notes", project.notes);
    writer.list("sources", project.sources, most, "sounds",
                [&](const AudioReference& source)
                {
                    std::string path = writtenPath(source.path, options.folder);
                    std::string embedded = source.embedded && options.embed ? toBase64(*source.embedded) : "";
                    std::string file = source.embedded && !options.embed ? source.hash + ".sound" : "";
                    visitSource(source, path, embedded, file, writer);
                });
    writer.list("groups", project.groups, most, "groups",
                [&](const std::string& group) { writer.text("name", group); });
    writer.object("profile", project.profile, Need::optional,
                  [&](const ProjectProfile& profile) { visitProfile(profile, writer); });
    if (!(project.scene == ProjectScene{}))
        writer.object("scene", project.scene, Need::optional,
                      [&](const ProjectScene& scene) { visitScene(scene, writer); });
    writer.list("clips", project.clips, most, "clips",
                [&](const std::shared_ptr<const ClipItem>& item)
                {
                    visitItem(*item, writer);
                    if (item->analysis != item->clip && !(*item->analysis == *item->clip))
                        writer.clip("analysis", item->analysis);
                    writer.list("edits", item->edits.whole(), most, "edits",
                                [&](const std::shared_ptr<const Edit>& edit) { visitEdit(*edit, writer); });
                });
    return std::move(writer).document();
}

Result<ReadProject> readProjectJson(std::string_view text, const fs::path& folder)
{
    ProjectTree tree;
    if (auto parsed = parseJson(text, tree, largestProjectText); !parsed)
        return parsed.error();
    if (!tree.root.is_object())
        return Error{ErrorCode::invalidData, "", "is not a project, which is a JSON object"};
    Reader reader(tree);
    reader.format(projectFormatName, projectFormatVersion);
    ReadProject read;
    Project& project = read.project;
    reader.optionalObject("recovery", read.recovery,
                          [&](RecoveryNote& note)
                          {
                              reader.text("path", note.path);
                              reader.number("time", note.time, Need::usual);
                              reader.number("process", note.process, Need::usual);
                              reader.object("place", note.place, Need::optional,
                                            [&](WorkPlace& place) { visitPlace(place, reader); });
                          });
    reader.optionalText("notes", project.notes);
    reader.list("sources", project.sources, most, "sounds",
                [&](AudioReference& source)
                {
                    std::string path, embedded, file;
                    visitSource(source, path, embedded, file, reader);
                    source.path = pathOf(path);
                    if (source.path.is_relative() && !folder.empty())
                        source.path = (folder / source.path).lexically_normal();
                    if (!embedded.empty())
                    {
                        auto bytes = fromBase64(embedded);
                        if (!bytes)
                            return reader.fail("embedded", "is not Base64 text");
                        source.embedded = std::make_shared<const std::string>(std::move(*bytes));
                    }
                    // Only a plain name: a file must not make us read elsewhere.
                    else if (!file.empty() && pathOf(file).filename() == pathOf(file))
                        if (auto bytes = readWholeFile(folder / pathOf(file), largestProjectText))
                            source.embedded = std::make_shared<const std::string>(std::move(*bytes));
                });
    reader.list("groups", project.groups, most, "groups", [&](std::string& group) { reader.text("name", group); });
    reader.object("profile", project.profile, Need::optional,
                  [&](ProjectProfile& profile) { visitProfile(profile, reader); });
    reader.object("scene", project.scene, Need::optional, [&](ProjectScene& scene) { visitScene(scene, reader); });
    reader.list("clips", project.clips, most, "clips",
                [&](std::shared_ptr<const ClipItem>& place)
                {
                    auto item = std::make_shared<ClipItem>();
                    visitItem(*item, reader);
                    reader.clip("analysis", item->analysis);
                    std::vector<Edit> edits;
                    reader.list("edits", edits, most, "edits", [&](Edit& edit) { visitEdit(edit, reader); });
                    if (!item->clip)
                        reader.fail("clip", "is missing");
                    if (!item->analysis)
                        item->analysis = item->clip;
                    std::vector<std::shared_ptr<const Edit>> shared;
                    for (Edit& edit : edits)
                        shared.push_back(std::make_shared<const Edit>(std::move(edit)));
                    item->edits = EditList::of(shared);
                    place = std::move(item);
                });
    if (reader.error)
        return *reader.error;
    if (auto wrong = checkReferences(project))
        return *wrong;
    return read;
}

} // namespace pacini
