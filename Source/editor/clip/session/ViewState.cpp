// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/session/ViewState.h"

#include <algorithm>
#include <utility>

namespace pacini::editor
{

ViewState::ViewState(const EditorModel& project) : model(project)
{
    subscriptions.on({&model.shownChanged}, [this] { showAnother(); });
    subscriptions.on({&model.contentChanged}, [this] { follow(); });
}

void ViewState::showAnother()
{
    beforePreview.reset();
    const double before = std::exchange(length, model.duration());
    // A sound that becomes a clip stays as it is seen.
    const bool stays = std::exchange(ofUnanalysed, model.isShowingUnanalysed()) && !ofUnanalysed && length == before;
    if (!stays)
        fit();
}

void ViewState::follow()
{
    const double before = std::exchange(length, model.duration());
    if (model.isPreviewing() && !beforePreview)
        beforePreview = axisNow;
    if (!model.isPreviewing() && beforePreview)
        setAxis(*std::exchange(beforePreview, std::nullopt));
    else if (length != before)
        shows(before) ? fit() : setAxis(axisNow);
}

bool ViewState::shows(double duration) const
{
    return duration > 0.0 && axisNow.secondsPerPixel * width >= duration;
}

void ViewState::setViewWidth(double pixels)
{
    if (pixels == width || pixels <= 0.0)
        return;
    const bool fitted = shows(model.duration());
    width = pixels;
    fitted ? fit() : setAxis(axisNow);
}

void ViewState::setAxis(TimeAxis wanted)
{
    if (const double duration = model.duration(); duration > 0.0)
    {
        wanted.secondsPerPixel = std::min(wanted.secondsPerPixel, std::max(duration, 1e-3) / width * 1.02);
        wanted = wanted.keptInside(duration * 1.02, width);
    }
    if (wanted == axisNow)
        return;
    axisNow = wanted;
    axisChanged.emit();
}

void ViewState::zoom(double factor, double x)
{
    setAxis(axisNow.zoomed(factor, x));
}

void ViewState::fit()
{
    if (const double duration = model.duration(); duration > 0.0)
        setAxis(TimeAxis::showing({0.0, duration * 1.02}, width));
}

void ViewState::showRange(TimeRange wanted)
{
    if (wanted.to > wanted.from)
        setAxis(TimeAxis::showing(wanted, width));
}

std::optional<TimeRange> ViewState::part() const
{
    if (length <= 0.0 || shows(length))
        return std::nullopt;
    return axisNow.visible(width);
}

void ViewState::setDrawing(bool wanted)
{
    drawing = wanted;
    lookChanged.emit();
}

void ViewState::setSnapTargets(const SnapTargets& wanted)
{
    snapNow = wanted;
    lookChanged.emit();
}

void ViewState::setAmplitudesInDecibels(bool wanted)
{
    decibels = wanted;
    lookChanged.emit();
}

void ViewState::setLaneHeight(int wanted)
{
    laneSize = std::clamp(wanted, 32, 160);
    lookChanged.emit();
}

void ViewState::setViewOptions(const ViewOptions& wanted)
{
    if (wanted == options)
        return;
    options = wanted;
    lookChanged.emit();
}

} // namespace pacini::editor
