#include "io/SoundHandle.h"

#include <algorithm>
#include <cctype>

namespace pacini
{

std::string soundError(SNDFILE* sound)
{
    std::string text(sf_strerror(sound));
    std::replace(text.begin(), text.end(), '\n', ' ');
    while (!text.empty() && (text.back() == '.' || text.back() == ' '))
        text.pop_back();
    // A second capital letter means an abbreviation, which stays.
    if (text.size() > 1 && std::islower(static_cast<unsigned char>(text[1])))
        text[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(text[0])));
    return text;
}

} // namespace pacini
