#include "cli/ConvertJob.h"

#include "cli/Task.h"
#include "io/AnyClip.h"
#include "io/InputFile.h"
#include "io/Sha256.h"

#include <pacini/clip/PackedClip.h>

#include <algorithm>
#include <utility>

namespace pacini::cli
{

namespace
{
bool stillThere(const ManifestEntry& entry, const std::filesystem::path& folder)
{
    return !entry.outputs.empty() &&
           std::all_of(entry.outputs.begin(), entry.outputs.end(),
                       [&](const ManifestOutput& output)
                       {
                           const auto bytes = readWholeFile(folder / output.file, output.bytes);
                           return bytes && bytes->size() == output.bytes && sha256(*bytes) == output.sha256;
                       });
}
} // namespace

Result<ConvertResult> convertClip(const std::filesystem::path& input, const std::filesystem::path& output,
                                  const ConvertSettings& settings, const ManifestEntry* before)
{
    auto read = readAnyClip(input);
    if (!read)
        return read.error();
    ConvertResult result;
    result.entry.inputSha256 = sha256(read->bytes);
    result.entry.settings = settings.record;
    if (!settings.force && before != nullptr && before->error.empty() &&
        before->inputSha256 == result.entry.inputSha256 && before->settings == settings.record &&
        stillThere(*before, settings.folder))
    {
        result.entry = *before;
        result.losses = before->losses;
        result.upToDate = true;
        return result;
    }
    if (settings.dryRun)
        return result;
    if (settings.quantise > 0)
        setQuantise(read->clip, settings.quantise);
    auto exported = exportClip(read->clip, settings.target, settings.params);
    if (!exported)
        return exported.error();
    const auto written = writeExport(output, *exported);
    if (!written)
        return atOutput(output, written.error());
    for (std::size_t i = 0; i < written->size(); ++i)
    {
        const auto name = (*written)[i].path.lexically_proximate(settings.folder).generic_string();
        result.entry.outputs.push_back({name, (*written)[i].bytes, sha256(exported->files[i].bytes)});
    }
    result.entry.duration = read->clip.duration;
    result.entry.warnings = std::move(read->warnings);
    result.losses = std::move(exported->losses);
    result.entry.losses = lossesByKind(result.losses);
    return result;
}

} // namespace pacini::cli
