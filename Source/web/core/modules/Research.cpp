// The module of other methods and of measures.

#include "web/core/Call.h"

#include <array>

namespace pacini::web
{

std::span<const NamedHandler> handlers()
{
    static constexpr std::array all{
        NamedHandler{"translate", translateSound},
        NamedHandler{"compare", compareSounds},
    };
    return all;
}

} // namespace pacini::web
