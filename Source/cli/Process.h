#pragma once

// Set-up of the process: signals and standard streams.

namespace pacini::cli
{

/// Prepares the process for work on files: a full disk, a closed pipe or an exceeded limit becomes an error of the
/// write instead of a sudden end, and a closed standard stream can never be taken over by a file that is opened later.
/// Call first in main.
void prepareProcess() noexcept;

} // namespace pacini::cli
