// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// View state: the visible part of the clip, and how lanes look and behave.

#include "document/view/Follow.h"
#include "document/view/Snap.h"
#include "document/view/TimeAxis.h"
#include "editor/clip/session/EditorModel.h"

#include <optional>

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
    bool reducedMotion = false;  ///< nothing slides: the view follows by page, and bars stand still
    bool spoken = false;         ///< speech-dispatcher says what the status bar, notices and questions say
    bool technicalTerms = false; ///< names of lanes as in research, not in the words of designers
    bool operator==(const ViewOptions&) const = default;

    [[nodiscard]] Follow followNow() const noexcept
    {
        return reducedMotion && follow == Follow::smooth ? Follow::page : follow;
    }
};

/// Zoom and options. All of another clip is shown at first, and of one whose whole length is shown also when that
/// changes. [message]
class ViewState
{
public:
    explicit ViewState(const EditorModel& project);

    Signal axisChanged;
    Signal lookChanged; ///< everything else

    [[nodiscard]] const TimeAxis& axis() const noexcept { return axisNow; }
    [[nodiscard]] double viewWidth() const noexcept { return width; } ///< pixels
    void setViewWidth(double pixels);
    void setAxis(TimeAxis wanted);
    void zoom(double factor, double x);
    void fit();
    void showRange(TimeRange wanted);
    /// The part that is seen; nothing when that is all of the clip.
    [[nodiscard]] std::optional<TimeRange> part() const;

    [[nodiscard]] bool amplitudesInDecibels() const noexcept { return decibels; }
    void setAmplitudesInDecibels(bool wanted);
    [[nodiscard]] int laneHeight() const noexcept { return laneSize; } ///< pixels of a band
    void setLaneHeight(int wanted);

    /// Whether a drag in a lane draws a curve.
    [[nodiscard]] bool isDrawing() const noexcept { return drawing; }
    void setDrawing(bool wanted);
    [[nodiscard]] const SnapTargets& snapTargets() const noexcept { return snapNow; }
    void setSnapTargets(const SnapTargets& wanted);
    [[nodiscard]] const ViewOptions& viewOptions() const noexcept { return options; }
    void setViewOptions(const ViewOptions& wanted);

private:
    void showAnother();
    void follow();
    [[nodiscard]] bool shows(double duration) const;

    const EditorModel& model;
    TimeAxis axisNow;
    double width = 800.0;
    double length = 0.0;       ///< s: of what is shown
    bool ofUnanalysed = false; ///< a sound without a clip
    std::optional<TimeAxis> beforePreview;
    bool decibels = true;
    int laneSize = 48;
    bool drawing = false;
    SnapTargets snapNow;
    ViewOptions options;
    Subscriptions subscriptions;
};

} // namespace pacini::editor
