#include "cli/Version.h"

#include "Commit.h"

namespace pacini::cli
{

std::string versionAndCommit()
{
    const std::string commit = PACINI_COMMIT;
    return commit.empty() ? PACINI_VERSION : PACINI_VERSION " (commit " + commit + ")";
}

} // namespace pacini::cli
