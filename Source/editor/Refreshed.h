// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace pacini::editor
{

/// Something that looks now and then whether what it shows has changed, and repaints only then. Listeners of parameters
/// would be called on the audio thread under automation, and would have to wake the message thread from there.
class Refreshed
{
public:
    virtual ~Refreshed() = default;
    /// [message]
    virtual void refresh() = 0;
};

} // namespace pacini::editor
