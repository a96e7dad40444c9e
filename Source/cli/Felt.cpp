#include "cli/Felt.h"

#include "io/ProfileFile.h"
#include "io/ShippedProfiles.h"

#include <string>

namespace pacini::cli
{

Result<void> checkFelt(const Profile& profile, const std::filesystem::path& programFolder)
{
    if (profile.body)
        return {};
    std::string message = "is missing in this profile, so the acceleration of the skin cannot be predicted";
    bool first = true;
    for (const ShippedProfile& shipped : shippedProfiles(programFolder))
        if (const auto other = readProfile(shipped.path); other && other->body)
        {
            message += (first ? "; there is one in " : " ") + shipped.name;
            first = false;
        }
    return Error{ErrorCode::invalidData, "body", message};
}

} // namespace pacini::cli
