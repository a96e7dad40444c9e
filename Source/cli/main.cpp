#include "cli/Command.h"
#include "cli/Process.h"

int main(int argc, char** argv)
{
    pacini::cli::prepareProcess();
    return pacini::cli::runCommandLine(argc, argv);
}
