#include "io/FieldsWriter.h"
#include "io/ProfileFields.h"
#include "io/ProfileJson.h"

#include <utility>

namespace pacini
{

std::string profileJson(const Profile& profile)
{
    FieldsWriter writer(profileFormatName, profileFormatVersion);
    profileFields::visitFields(profile, writer);
    return std::move(writer).document();
}

} // namespace pacini
