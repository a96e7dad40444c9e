// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What of a clip is shown, and how.

#include "document/view/Follow.h"

namespace pacini::editor
{

enum class SoundView
{
    waveform,
    spectrum,
    both
};

struct ViewOptions
{
    SoundView sound = SoundView::waveform;
    bool wholeSpectrum = false; ///< up to half the sample rate, not 2 kHz
    bool actuator = true;       ///< the rows of what it plays
    Follow follow = Follow::page;
    bool operator==(const ViewOptions&) const = default;
};

} // namespace pacini::editor
