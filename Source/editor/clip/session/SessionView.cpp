// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/session/Session.h"

#include <algorithm>

namespace pacini::editor
{

void Session::select(Selection wanted)
{
    if (wanted == selectionNow)
        return;
    selectionNow = std::move(wanted);
    changed(selection);
}

void Session::setViewWidth(double pixels)
{
    if (pixels == width || pixels <= 0.0)
        return;
    const bool fitted = duration() > 0.0 && axisNow.secondsPerPixel * width >= duration();
    width = pixels;
    fitted ? fit() : setAxis(axisNow);
}

void Session::setAxis(TimeAxis wanted)
{
    if (const double length = duration(); length > 0.0)
    {
        wanted.secondsPerPixel = std::min(wanted.secondsPerPixel, std::max(length, 1e-3) / width * 1.02);
        wanted = wanted.keptInside(length * 1.02, width);
    }
    if (wanted == axisNow)
        return;
    axisNow = wanted;
    changed(view);
}

void Session::zoom(double factor, double x)
{
    setAxis(axisNow.zoomed(factor, x));
}

void Session::fit()
{
    if (const double length = duration(); length > 0.0)
        setAxis(TimeAxis::showing({0.0, length * 1.02}, width));
}

void Session::showRange(TimeRange wanted)
{
    if (wanted.to > wanted.from)
        setAxis(TimeAxis::showing(wanted, width));
}

bool Session::showsAll() const
{
    const auto now = clip();
    return now && axisNow.secondsPerPixel * width >= now->duration;
}

/// After the clip may have become longer or shorter.
void Session::keepView(bool showedAll)
{
    showedAll ? fit() : setAxis(axisNow);
}

void Session::setDrawing(bool wanted)
{
    drawing = wanted;
    changed(look);
}

void Session::setSnapTargets(const SnapTargets& wanted)
{
    snapNow = wanted;
    changed(look);
}

void Session::setAmplitudesInDecibels(bool wanted)
{
    decibels = wanted;
    changed(look);
}

void Session::setLaneHeight(int wanted)
{
    laneSize = std::clamp(wanted, 32, 160);
    changed(look);
}

void Session::setViewOptions(const ViewOptions& wanted)
{
    if (wanted == options)
        return;
    options = wanted;
    changed(look);
}

} // namespace pacini::editor
