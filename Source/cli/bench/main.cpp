// The program pacini-bench, which runs the measurements of `pacini bench`.

#include "cli/Command.h"
#include "cli/Process.h"
#include "cli/bench/BenchRun.h"

#include <vector>

int main(int argc, char** argv)
{
    pacini::cli::prepareProcess();
    const auto given = pacini::cli::commandWords(argc, argv);
    std::vector<const char*> words{"pacini", "bench"};
    words.insert(words.end(), given.begin() + 1, given.end());
    return pacini::cli::runCommandLine(static_cast<int>(words.size()), words.data(), pacini::cli::runBenches);
}
