#include "io/ProfileJson.h"

#include "io/FieldsDocument.h"
#include "io/FieldsWriter.h"
#include "io/ProfileFields.h"

#include <utility>

namespace pacini
{

Result<Profile> readProfileJson(std::string_view text, ReadWarnings* warnings)
{
    return validated(readDocument<Profile>(
        text, {"a profile", profileFormatName, profileFormatVersion, largestProfileText}, warnings,
        [](auto& profile, auto& reader) { profileFields::visitFields(profile, reader); }));
}

std::string profileJson(const Profile& profile)
{
    FieldsWriter writer(FieldsWriter::Layout::spaced);
    writer.format({profileFormatName, profileFormatVersion});
    profileFields::visitFields(profile, writer);
    return std::move(writer).document();
}

} // namespace pacini
