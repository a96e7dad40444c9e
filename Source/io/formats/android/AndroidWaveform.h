#pragma once

// Conversion of a voice to the steps of an Android waveform.

#include "io/formats/LossList.h"
#include "io/formats/android/AndroidEffects.h"

#include <pacini/synthesis/SingleVoice.h>

#include <optional>
#include <vector>

namespace pacini
{

/// The steps of a voice with levels of 0 to 1, see androidEffectsOf(); equal neighbours are one. `keepsPoints`: steps
/// meet where the amplitude has points, else `stepsPerSecond` (100 without) are the most.
[[nodiscard]] std::vector<AndroidStep> androidWaveformOf(const SingleVoice& voice, std::optional<double> stepsPerSecond,
                                                         bool keepsPoints);

/// The amplitude losses of the steps.
void addStepLosses(LossList& losses, const SingleVoice& voice, const std::vector<AndroidStep>& steps);

} // namespace pacini
