// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Scrolling display of the last seconds of the sound's bands.

#include <pacini/realtime/TranslatorMeters.h>

#include <juce_gui_basics/juce_gui_basics.h>

#include <array>
#include <cstddef>

namespace pacini::editor
{

/// One lane for each band, high ones above, the newest at the right; events are ticks at the top. Does not repaint
/// during silence.
class BandView final : public juce::Component
{
public:
    BandView();

    /// A new column.
    void add(const TranslatorMeterReading& reading);
    void paint(juce::Graphics& g) override;

private:
    static constexpr std::size_t columns = 240;
    static constexpr float floorLevel = -60.0f; ///< dB
    struct Column
    {
        std::array<float, maxTranslatorBands> levels{}; ///< 0 to 1
        float event = 0.0f;
    };

    void paintLane(juce::Graphics& g, juce::Rectangle<float> lane, std::size_t band) const;
    [[nodiscard]] const Column& columnAt(std::size_t age) const noexcept;

    std::array<Column, columns> ring{};
    std::size_t newest = 0;
    std::size_t bands = 0;
    std::size_t silent = columns; // newest columns without anything
    unsigned events = 0;
    bool begun = false;
};

} // namespace pacini::editor
