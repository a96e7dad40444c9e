#include "io/ClipExport.h"

#include "io/AnyClip.h"
#include "io/ClipJson.h"

#include <pacini/clip/PackedClip.h>

#include <algorithm>
#include <system_error>

namespace pacini
{

const std::vector<ClipTarget>& clipTargets()
{
    static const std::vector<ClipTarget> targets = []
    {
        std::vector<ClipTarget> list{{"json", ".json", nullptr}, {"packed", ".pacb", nullptr}};
        for (const ForeignFormat& format : foreignFormats())
            if (format.write != nullptr)
                list.push_back({format.name, format.extension, &format});
        return list;
    }();
    return targets;
}

const ClipTarget* clipTargetNamed(std::string_view name)
{
    const auto& targets = clipTargets();
    const auto found =
        std::find_if(targets.begin(), targets.end(), [&](const ClipTarget& target) { return target.name == name; });
    return found == targets.end() ? nullptr : &*found;
}

const ClipTarget* clipTargetOf(std::string_view extension)
{
    const auto& targets = clipTargets();
    const auto found = std::find_if(targets.begin(), targets.end(),
                                    [&](const ClipTarget& target) { return target.extension == extension; });
    return found == targets.end() ? nullptr : &*found;
}

Result<ExportedClip> exportClip(const Clip& clip, const ClipTarget& target, const ExportParams& params)
{
    if (target.foreign != nullptr)
        return target.foreign->write(clip, params);
    if (auto valid = validate(clip); !valid)
        return valid.error();
    ExportedClip result;
    if (target.name == "json")
        result.files.push_back({"", writeClipJson(clip)});
    else
    {
        const auto packed = packClip(clip, packParamsFor(clip));
        result.files.push_back({"", std::string(reinterpret_cast<const char*>(packed.data()), packed.size())});
    }
    return result;
}

std::filesystem::path strayCompanion(const std::filesystem::path& main, const ClipTarget& target,
                                     const ExportedClip& exported)
{
    const std::string_view suffix = target.foreign == nullptr ? "" : target.foreign->companion;
    const bool written = std::any_of(exported.files.begin(), exported.files.end(),
                                     [&](const ExportedFile& file) { return file.suffix == suffix; });
    if (suffix.empty() || written)
        return {};
    auto stray = exportPath(main, suffix);
    std::error_code ignored;
    return std::filesystem::is_regular_file(stray, ignored) ? stray : std::filesystem::path();
}

std::string strayWarning(const std::filesystem::path& stray)
{
    return stray.filename().string() + ": was there before and is no part of this clip, but is read with it; remove it";
}

Result<std::vector<WrittenFile>> writeExport(const std::filesystem::path& main, const ExportedClip& exported,
                                             Existing existing)
{
    std::vector<WrittenFile> files;
    for (const ExportedFile& file : exported.files)
    {
        const auto path = file.suffix.empty() ? main : exportPath(main, file.suffix);
        const auto written = writeFileAtomically(path, file.bytes, file.suffix.empty() ? existing : Existing::replace);
        if (!written)
        {
            Error error = written.error();
            if (!file.suffix.empty())
                error.where = path.filename().string() + (error.where.empty() ? "" : ": " + error.where);
            return error;
        }
        files.push_back({path, *written});
    }
    return files;
}

} // namespace pacini
