#include "cli/Command.h"

int main(int argc, char** argv)
{
    return pacini::cli::runCommandLine(argc, argv);
}
