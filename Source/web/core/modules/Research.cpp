// The module of research tools: other methods, measures, spectrograms.

#include "web/core/Call.h"

namespace pacini::web
{

std::span<const NamedHandler> handlers()
{
    static constexpr NamedHandler all[]{
        {"translate", translateSound}, {"compare", compareSounds}, {"spectrogram", drawSpectrogram}};
    return all;
}

} // namespace pacini::web
