#pragma once

// Descriptions of the numbers of a TranslatorSetup.

#include <pacini/foundation/Description.h>
#include <pacini/realtime/TranslatorSetup.h>
#include <pacini/synthesis/RenderParams.h>

#include <array>

namespace pacini
{

/// Descriptions of bands, boost and strength; the last two are those of rendering.
inline constexpr std::array translatorSetupParameters{
    described<&TranslatorSetup::bands, &BandLayoutParams::bands>(
        {.name = "bands", .text = "Number of bands", .range = {1, maxTranslatorBands}}),
    describedAs<&TranslatorSetup::maxBoost>(parameterNamed(renderParameters, "maxBoost")),
    describedAs<&TranslatorSetup::strength>(parameterNamed(renderParameters, "strength")),
};

} // namespace pacini
