#include "cli/Felt.h"

#include "io/ProfileFile.h"
#include "io/ShippedProfiles.h"

#include <pacini/synthesis/SignalPlayer.h>

#include <string>

namespace pacini::cli
{

Result<void> checkFelt(const Profile& profile, const std::filesystem::path& programFolder)
{
    if (profile.body || hasMeasuredAcceleration(profile))
        return {};
    std::string message = notFeltText(profile);
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
