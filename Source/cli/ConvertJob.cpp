#include "cli/ConvertJob.h"

#include "cli/Task.h"
#include "io/ClipFile.h"
#include "io/InputFile.h"
#include "io/Sha256.h"

#include <pacini/clip/PackedClip.h>

#include <algorithm>
#include <iterator>
#include <system_error>
#include <utility>

namespace pacini::cli
{

namespace
{
bool stillThere(const ManifestOutput& output, const std::filesystem::path& folder)
{
    const auto bytes = readWholeFile(folder / output.file, output.bytes);
    return bytes && bytes->size() == output.bytes && sha256(*bytes) == output.sha256;
}

bool stillThere(const ManifestEntry& entry, const std::filesystem::path& folder)
{
    return !entry.outputs.empty() &&
           std::all_of(entry.outputs.begin(), entry.outputs.end(),
                       [&](const ManifestOutput& output) { return stillThere(output, folder); });
}

/// The name of an output in the manifest.
std::string nameIn(const std::filesystem::path& folder, const std::filesystem::path& output)
{
    std::error_code unknown;
    const auto path = std::filesystem::proximate(output, folder.empty() ? "." : folder, unknown);
    return (unknown ? output : path).generic_string();
}

/// As mayReplace(), but what the manifest says was written is replaced too.
Result<Existing> mayConvertTo(const std::filesystem::path& main, const ExportedClip& exported, Replaceable replaceable,
                              const std::filesystem::path& folder, const ManifestEntry* before)
{
    const auto isOwn = [&](const ExportedFile& file)
    {
        const auto name = nameIn(folder, file.suffix.empty() ? main : exportPath(main, file.suffix));
        return before != nullptr && std::any_of(before->outputs.begin(), before->outputs.end(),
                                                [&](const ManifestOutput& output)
                                                { return output.file == name && stillThere(output, folder); });
    };
    ExportedClip others;
    std::copy_if(exported.files.begin(), exported.files.end(), std::back_inserter(others.files),
                 [&](const ExportedFile& file) { return !isOwn(file); });
    return mayReplace(main, others, replaceable);
}
} // namespace

Result<ConvertResult> convertClip(const std::filesystem::path& input, const std::filesystem::path& output,
                                  Replaceable replaceable, const ConvertSettings& settings, const ManifestEntry* before)
{
    auto read = readClip(input, settings.strict);
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
    if (settings.quantise > 0)
        setQuantise(read->clip, settings.quantise);
    auto exported = settings.format->write(read->clip, settings.params);
    if (!exported)
        return exported.error();
    if (const auto fits = checkStream(output, *exported); !fits)
        return fits.error();
    const auto existing = mayConvertTo(output, *exported, replaceable, settings.folder, before);
    if (!existing)
        return existing.error();
    if (settings.dryRun)
        return result;
    const auto written = writeExport(output, *exported, *existing);
    if (!written)
        return atOutput(output, written.error());
    for (std::size_t i = 0; i < written->size(); ++i)
    {
        const std::string& bytes = exported->files[i].bytes;
        result.entry.outputs.push_back({nameIn(settings.folder, (*written)[i]), bytes.size(), sha256(bytes)});
    }
    result.entry.duration = read->clip.duration;
    result.entry.warnings = std::move(read->warnings);
    if (const auto stray = strayCompanion(output, *settings.format, *exported); !stray.empty())
        result.entry.warnings.push_back(strayWarning(stray));
    result.losses = std::move(exported->losses);
    result.entry.losses = lossesByKind(result.losses);
    return result;
}

} // namespace pacini::cli
