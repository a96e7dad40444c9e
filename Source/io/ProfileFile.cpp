#include "io/ProfileFile.h"

#include "io/AcfFile.h"
#include "io/AtomicFile.h"
#include "io/InputFile.h"
#include "io/JsonTree.h"

#include <nlohmann/json.hpp>

#include <system_error>

namespace pacini
{

Result<Profile> readProfile(const std::filesystem::path& path, ReadWarnings* warnings)
{
    const auto text = readWholeFile(path, largestProfileText);
    if (!text)
        return text.error();
    if (hasAcfExtension(path))
        return Error{ErrorCode::invalidData, "", "is an ACF file; convert it to a profile with 'pacini convert' first"};
    return readProfileJson(*text, warnings);
}

bool isProfile(const std::filesystem::path& path)
{
    std::error_code error;
    const auto size = std::filesystem::file_size(path, error);
    if (error || size > largestProfileText || !std::filesystem::is_regular_file(path, error))
        return false;
    const auto text = readWholeFile(path, largestProfileText);
    if (!text)
        return false;
    const auto document = readJsonTree(*text, largestProfileText);
    if (!document || !document->is_object())
        return false;
    const auto format = document->find("format");
    return format != document->end() && *format == profileFormatName;
}

Result<std::size_t> writeProfile(const std::filesystem::path& path, const Profile& profile)
{
    if (auto valid = validate(profile); !valid)
        return valid.error();
    return writeFileAtomically(path, profileJson(profile));
}

} // namespace pacini
