#include "cli/ProfileInput.h"

#include "cli/ProgramFolder.h"
#include "io/AcfFile.h"
#include "io/ProfileFile.h"
#include "io/ShippedProfiles.h"

#include <filesystem>
#include <system_error>
#include <utility>

namespace pacini::cli
{

std::optional<Result<Profile>> profileIn(const std::string& name, ReadWarnings* warnings)
{
    std::error_code error;
    if (!std::filesystem::exists(name, error))
    {
        const auto shipped = findProfile(name, programFolder());
        return shipped ? std::optional(readProfile(*shipped, warnings)) : std::nullopt;
    }
    if (hasAcfExtension(name))
    {
        auto acf = readAcfFile(name);
        return acf ? Result<Profile>(std::move(acf->profile)) : Result<Profile>(acf.error());
    }
    return isProfile(name) ? std::optional(readProfile(name, warnings)) : std::nullopt;
}

std::optional<Profile> openProfile(Console& console, const std::string& name)
{
    const auto path = findProfile(name, programFolder());
    if (!path)
    {
        console.error(name, path.error());
        return std::nullopt;
    }
    ReadWarnings warnings(console.isStrict());
    auto profile = readProfile(*path, &warnings);
    if (!profile)
    {
        console.error(path->string(), profile.error());
        return std::nullopt;
    }
    console.warnings(path->string(), warnings.texts());
    return std::move(*profile);
}

Error ofProfileOption(Error error)
{
    error.where = (error.where.starts_with("from.") ? "--designed-for: " : "--profile: ") +
                  error.where.substr(error.where.find('.') + 1);
    return error;
}

} // namespace pacini::cli
