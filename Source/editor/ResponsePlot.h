// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Frequency response plot: curves over a logarithmic frequency axis.

#include <pacini/linearize/FrequencyResponse.h>

#include <juce_gui_basics/juce_gui_basics.h>

#include <optional>
#include <utility>
#include <vector>

namespace pacini::editor
{

/// Levels in dB, or percentages on a logarithmic scale. The first curves lie below the later ones; the mouse shows the
/// value of the last.
class ResponsePlot final : public juce::Component
{
public:
    enum class Role
    {
        single,  ///< one of several, thin
        leftOut, ///< one that does not count
        noise,   ///< dotted
        before,  ///< what was, beside what is
        result
    };
    struct Curve
    {
        juce::String name; ///< curves of one name stand in the legend once
        FrequencyResponse response;
        Role role = Role::result;
    };
    enum class Unit
    {
        decibels,
        percent
    };
    struct Content
    {
        std::vector<Curve> curves;
        Unit unit = Unit::decibels;
        juce::String axisName;                          ///< such as "dB re 1 m/s²"
        std::optional<std::pair<double, double>> range; ///< Hz, shaded outside
        std::optional<double> marker;                   ///< Hz, a vertical line
        std::optional<std::pair<double, double>> band;  ///< dB, between two horizontal lines within the range
        juce::String empty;                             ///< what is said without curves
    };

    ResponsePlot(const juce::String& name, const juce::String& help);

    void show(Content wanted);
    [[nodiscard]] const Content& shown() const noexcept { return content; }
    /// Where a point of a curve lies, of this component.
    [[nodiscard]] juce::Point<float> placeOf(double frequency, double value) const;

    void paint(juce::Graphics& g) override;
    void resized() override { rescale(); }
    void mouseMove(const juce::MouseEvent& event) override;
    void mouseExit(const juce::MouseEvent& event) override;

private:
    void rescale();
    [[nodiscard]] juce::Rectangle<int> plotArea() const;
    [[nodiscard]] double scaled(double value) const noexcept;
    [[nodiscard]] float yOf(double scaledValue) const;
    [[nodiscard]] float xOf(double frequency) const;
    [[nodiscard]] juce::Colour colourOf(Role role) const;
    void paintGrid(juce::Graphics& g) const;
    void paintCurve(juce::Graphics& g, const Curve& curve) const;
    void paintLegend(juce::Graphics& g) const;
    void paintReading(juce::Graphics& g) const;
    [[nodiscard]] juce::String valueText(double value) const;

    Content content;
    double low = 10.0, high = 1000.0;  ///< Hz
    double bottom = -40.0, top = 20.0; ///< dB, or 20 log10 of a percentage
    double step = 10.0;                ///< dB between lines
    std::optional<double> pointed;     ///< Hz under the mouse
};

} // namespace pacini::editor
