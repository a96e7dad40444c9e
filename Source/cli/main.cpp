#include "cli/Command.h"
#include "cli/Process.h"

int main(int argc, char** argv)
{
    pacini::cli::prepareProcess();
    const auto words = pacini::cli::commandWords(argc, argv);
    return pacini::cli::runCommandLine(static_cast<int>(words.size()), words.data());
}
