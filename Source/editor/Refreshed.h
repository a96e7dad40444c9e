// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Interface of components that poll what they show.

namespace pacini::editor
{

/// Interface for polling: refresh() repaints only if the displayed values have changed. Listeners of
/// parameters would be called on the audio thread under automation, and would have to wake the message thread
/// from there.
class Refreshed
{
public:
    virtual ~Refreshed() = default;
    /// [message]
    virtual void refresh() = 0;
};

} // namespace pacini::editor
