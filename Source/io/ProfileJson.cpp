#include "io/ProfileJson.h"

#include "io/FieldsReader.h"
#include "io/FieldsWriter.h"
#include "io/JsonTree.h"
#include "io/ProfileFields.h"

#include <utility>

namespace pacini
{

Result<Profile> readProfileJson(std::string_view text, ReadWarnings* warnings)
{
    const auto document = readJsonObject(text, largestProfileText, "is not a profile, as it is not a JSON object");
    if (!document)
        return document.error();
    FieldsReader reader(*document, warnings);
    reader.format(profileFormatName, profileFormatVersion);
    Profile profile;
    profileFields::visitFields(profile, reader);
    reader.finish();
    if (reader.error)
        return *reader.error;
    if (auto valid = validate(profile); !valid)
        return valid.error();
    return profile;
}

std::string profileJson(const Profile& profile)
{
    FieldsWriter writer(FieldsWriter::Layout::spaced);
    writer.format({profileFormatName, profileFormatVersion});
    profileFields::visitFields(profile, writer);
    return std::move(writer).document();
}

} // namespace pacini
