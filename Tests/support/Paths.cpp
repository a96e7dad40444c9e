#include "support/Paths.h"

namespace pacini
{

std::filesystem::path sourceFolder()
{
    return PACINI_SOURCE_DIR;
}

std::filesystem::path testFolder()
{
    return sourceFolder() / "Tests";
}

std::filesystem::path paciniCommand()
{
    return PACINI_COMMAND;
}

} // namespace pacini
