// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The brightness of the source sound, computed in the background.

#include "document/view/SoundBrightness.h"
#include "editor/clip/session/Jobs.h"
#include "editor/clip/session/Sound.h"

#include <atomic>
#include <functional>
#include <memory>
#include <utility>

namespace pacini::editor
{

/// Of the sound under the clip that is shown. [message]
class BrightnessLine
{
public:
    std::function<void()> onChanged; ///< there is another curve, or none any more

    ~BrightnessLine()
    {
        if (cancelled)
            *cancelled = true;
    }

    /// Null: none. `low` and `high`: the range of the clip's bands, Hz.
    void show(const std::shared_ptr<const Sound>& wanted, double low, double high)
    {
        if (wanted == sound && low == lowNow && high == highNow)
            return;
        sound = wanted;
        lowNow = low;
        highNow = high;
        if (cancelled)
            *cancelled = true;
        const bool had = !shown.empty();
        shown.clear();
        if (had && onChanged)
            onChanged();
        if (!sound)
            return;
        cancelled = std::make_shared<std::atomic<bool>>(false);
        jobs.run([of = sound, low, high, stop = cancelled]
                 { return brightnessOf(of->mono, of->audio.rate(), Hertz(low), Hertz(high), *stop); },
                 [this, stop = cancelled](Curve made)
                 {
                     if (*stop)
                         return;
                     shown = std::move(made);
                     if (onChanged)
                         onChanged();
                 });
    }

    /// See brightnessOf(); empty until it is known.
    [[nodiscard]] const Curve& curve() const noexcept { return shown; }

private:
    std::shared_ptr<const Sound> sound;
    double lowNow = 0.0, highNow = 0.0;
    Curve shown;
    std::shared_ptr<std::atomic<bool>> cancelled;
    Jobs jobs; ///< ends before the rest
};

} // namespace pacini::editor
