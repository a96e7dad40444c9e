// The call `reapply`: edits by hand, taken from one analysis of a sound to another.

#include "document/EditFields.h"
#include "document/OperationCheck.h"
#include "document/Reapply.h"
#include "io/FieldsWriter.h"
#include "io/JsonTree.h"
#include "io/formats/json/ClipJson.h"
#include "web/core/Call.h"

#include <memory>
#include <utility>
#include <vector>

namespace pacini::web
{

namespace
{
using ClipPointer = std::shared_ptr<const Clip>;

struct EditReader : FieldsReader
{
    using FieldsReader::FieldsReader;

    void clip(const char* name, ClipPointer&)
    {
        fail(name, "is a clip within an edit; such edits are not supported here");
    }
};

struct EditWriter : FieldsWriter
{
    using FieldsWriter::FieldsWriter;

    void clip(const char*, const ClipPointer&) {} // never read
};
} // namespace

/// Inputs: both clips and `{"edits": []}`. Outputs: the edited clip, and the edits as they came.
Result<void> reapplyEdits(Call& call)
{
    const auto before = clipOf(call, 0);
    if (!before)
        return before.error();
    const auto after = clipOf(call, 1);
    if (!after)
        return after.error();
    const auto document = readJsonTree(call.text(2), largestClipText);
    if (!document)
        return document.error();
    EditReader reader(*document);
    std::vector<Edit> edits;
    reader.list("edits", edits, projectFields::most, "edits",
                [&](Edit& edit)
                {
                    projectFields::visitEdit(edit, reader);
                    if (const auto wrong = checkOperation(edit.operation); wrong && !reader.error)
                        reader.fail(wrong->where, wrong->message, wrong->code);
                });
    if (reader.error)
        return *reader.error;
    const Reapplied done = reapply(*before, *after, edits);
    call.put(writeClipJson(done.clip));
    EditWriter writer(FieldsWriter::Layout::compact);
    writer.list(
        "edits", done.edits, projectFields::most, "edits",
        [&](const Edit& edit) { projectFields::visitEdit(edit, writer); }, Need::usual);
    call.put(std::move(writer).document());
    Json unfitting = Json::array();
    for (const UnfittingEdit& one : done.unfitting)
        unfitting.push_back({{"edit", one.edit}, {"reason", one.reason}});
    call.value["unfitting"] = std::move(unfitting);
    return {};
}

} // namespace pacini::web
