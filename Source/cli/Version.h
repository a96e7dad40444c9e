#pragma once

// Version of the command and the commit of its sources.

#include <string>

namespace pacini::cli
{

/// Returns "0.1.0 (commit 0123456789ab)", with ", changed" behind the commit where files differed from it when the
/// command was built. Without the commit where neither Git nor the archive of the sources tells it.
[[nodiscard]] std::string versionAndCommit();

} // namespace pacini::cli
