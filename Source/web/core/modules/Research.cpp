// The module of research tools: other methods, measures, spectrograms.

#include "web/core/Call.h"

#include <array>

namespace pacini::web
{

std::span<const NamedHandler> handlers()
{
    static constexpr std::array all{
        NamedHandler{"translate", translateSound},
        NamedHandler{"compare", compareSounds},
        NamedHandler{"spectrogram", drawSpectrogram},
    };
    return all;
}

} // namespace pacini::web
