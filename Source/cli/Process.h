#pragma once

// Set-up of the process: signals, standard streams and the words of its command line.

#include <vector>

namespace pacini::cli
{

/// Prepares the process for work on files: a full disk, a closed pipe or an exceeded limit becomes an error of the
/// write instead of a sudden end, and a closed standard stream can never be taken over by a file that is opened later.
/// On Windows a console shows UTF-8 until the process ends, and lines end with a line feed alone. Call first in main.
void prepareProcess() noexcept;

/// The words of the command line in UTF-8, which live as long as the process. main() of Windows gets them in a code
/// page that lacks most letters.
[[nodiscard]] std::vector<const char*> commandWords(int argc, const char* const* argv);

} // namespace pacini::cli
