// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/sheets/ComparisonSheet.h"

#include "document/view/ColourMap.h"
#include "document/view/TimeTicks.h"
#include "document/view/ValueTicks.h"
#include "editor/Text.h"
#include "editor/Theme.h"
#include "editor/Translation.h"
#include "editor/clip/lanes/LaneText.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace pacini::editor
{

namespace
{
constexpr int summaryHeight = 3 * grid, placeHeight = 3 * grid, headingHeight = 20;
constexpr int frequencyWidth = 7 * grid, timeHeight = 2 * grid + 4; // of the axes
constexpr double leastTickGap = 18.0;                               // pixels
constexpr float fullDifference = 20.0f;                             // dB: the strongest colour

/// Softer than the sound is blue, stronger is orange, alike is the ground: told apart with any eyes.
juce::Colour differenceColour(float decibels, juce::Colour ground)
{
    const juce::Colour full = decibels < 0.0f ? juce::Colour(0xff4a90ff) : juce::Colour(0xffff9a3d);
    return ground.interpolatedWith(full, std::min(1.0f, std::abs(decibels) / fullDifference));
}

template <typename ColourOf>
juce::Image pictureOf(const SoundComparison& of, ColourOf colourOf)
{
    const auto rows = static_cast<int>(of.rows.count);
    juce::Image image(juce::Image::RGB, static_cast<int>(SoundComparison::columns), rows, false);
    for (int x = 0; x < image.getWidth(); ++x)
        for (int y = 0; y < rows; ++y)
            image.setPixelAt(x, rows - 1 - y, colourOf(static_cast<std::size_t>(x * rows + y)));
    return image;
}
} // namespace

ComparisonSheet::ComparisonSheet(Session& session) : Sheet("Clip and sound", 980, 640)
{
    place.setFont(smallFont());
    addAndMakeVisible(place);
    setAnswers({{"Close", {}}});
    summary = tr(toText("Comparing…"));
    const auto audio = session.sounds.soundOfClip();
    const auto clip = session.model.clip();
    if (!audio || !clip)
        return;
    jobs.run([clip, audio, stop = cancelled] { return compareWithSound(*clip, audio->audio, *stop); },
             [this](Result<SoundComparison> result) { showResult(std::move(result)); });
}

ComparisonSheet::~ComparisonSheet()
{
    *cancelled = true;
}

void ComparisonSheet::showResult(Result<SoundComparison> result)
{
    if (!result)
        summary = translateMessage(toText(result.error().text()));
    else
    {
        found = std::move(*result);
        const auto number = [](double value)
        {
            return numberText(value, 1);
        };
        summary = tr("Likeness {0} (sound itself {1})", {number(found->score), number(found->best)});
        if (found->match)
            summary << ", "
                    << tr("predicted match {0} (sound itself {1})", {number(*found->match), number(*found->bestMatch)});
        const auto worst = std::max_element(found->differenceOfRows.begin(), found->differenceOfRows.end());
        summary << ", "
                << tr("differs most at {0} Hz, by {1} dB",
                      {juce::String(juce::roundToInt(found->rows.frequencyAt(
                           0.5 + static_cast<double>(worst - found->differenceOfRows.begin())))),
                       number(*worst)});
        const Palette& p = paletteFor(*this);
        const auto colours = levelColours(p.background.getPerceivedBrightness() < 0.5f);
        const auto level = [&](const std::vector<std::uint8_t>& levels)
        {
            return pictureOf(*found, [&](std::size_t i) { return juce::Colour(0xff000000u | colours[levels[i]]); });
        };
        sound = level(found->sound);
        drive = level(found->drive);
        difference = pictureOf(*found, [&](std::size_t i) { return differenceColour(found->difference[i], p.well); });
    }
    setDescription(summary);
    repaint();
}

juce::Rectangle<int> ComparisonSheet::rowArea(int row) const
{
    auto area = inside().withTrimmedTop(summaryHeight).withTrimmedBottom(placeHeight + timeHeight);
    const int height = area.getHeight() / 3;
    return area.withY(area.getY() + row * height).withHeight(height);
}

juce::Rectangle<int> ComparisonSheet::pictureArea(int row) const
{
    return rowArea(row).withTrimmedTop(headingHeight).withTrimmedBottom(4).withTrimmedLeft(frequencyWidth);
}

/// Frequencies beside each picture, and times below the last.
void ComparisonSheet::paintAxes(juce::Graphics& g) const
{
    const Palette& p = paletteFor(*this);
    g.setFont(captionFont());
    for (int row = 0; row < 3; ++row)
    {
        const auto area = pictureArea(row);
        const ValueAxis axis{ValueScale::logarithmic, found->rows.low, found->rows.high,
                             static_cast<double>(area.getHeight())};
        for (const double frequency : valueTicks(axis, leastTickGap))
        {
            const int y = area.getY() + juce::roundToInt(axis.yOf(frequency));
            g.setColour(p.line);
            g.fillRect(area.getX() - 4, y, 4, 1);
            g.setColour(p.dim);
            g.drawText(frequency >= 1000.0 ? numberText(frequency / 1000.0, 0) + " kHz"
                                           : juce::String(juce::roundToInt(frequency)) + " Hz",
                       area.getX() - frequencyWidth, y - grid, frequencyWidth - 6, 2 * grid,
                       juce::Justification::centredRight, false);
        }
    }
    const auto area = pictureArea(2);
    const double step = tickStep(found->duration / std::max(1, area.getWidth()));
    for (int i = 0; i * step <= found->duration * (1.0 + 1e-9); ++i)
    {
        const int x = area.getX() + juce::roundToInt(i * step / found->duration * area.getWidth());
        g.setColour(p.line);
        g.fillRect(std::min(x, area.getRight() - 1), area.getBottom(), 1, 4);
        g.setColour(p.dim);
        constexpr int width = 80;
        // The ends stay within the picture.
        const auto label = juce::Rectangle<int>(x - width / 2, area.getBottom() + 4, width, timeHeight - 4);
        const bool ends = label.getRight() > area.getRight();
        g.drawText(timeText(i * step, step),
                   i == 0 ? label.withX(x)
                   : ends ? label.withRightX(area.getRight())
                          : label,
                   i == 0 ? juce::Justification::centredLeft
                   : ends ? juce::Justification::centredRight
                          : juce::Justification::centred,
                   false);
    }
}

void ComparisonSheet::paint(juce::Graphics& g)
{
    Sheet::paint(g);
    const Palette& p = paletteFor(*this);
    g.setColour(p.text);
    g.setFont(usualFont());
    g.drawText(summary, inside().removeFromTop(summaryHeight), juce::Justification::centredLeft, true);
    place.setBounds(inside().removeFromBottom(placeHeight));
    if (!found)
        return;
    const std::array<std::pair<const juce::Image*, juce::String>, 3> rows{
        {{&sound, tr("Sound")},
         {&drive, tr("Clip, at the level of the sound")},
         {&difference, tr("Difference: blue is too weak, orange too strong, up to 20 dB")}}};
    for (int i = 0; i < 3; ++i)
    {
        g.setColour(p.dim);
        g.setFont(smallFont());
        g.drawText(rows[static_cast<std::size_t>(i)].second, rowArea(i).removeFromTop(headingHeight),
                   juce::Justification::centredLeft, true);
        g.setImageResamplingQuality(juce::Graphics::lowResamplingQuality);
        g.drawImage(*rows[static_cast<std::size_t>(i)].first, pictureArea(i).toFloat(),
                    juce::RectanglePlacement::stretchToFit);
    }
    paintAxes(g);
}

void ComparisonSheet::mouseMove(const juce::MouseEvent& event)
{
    juce::String text;
    for (int i = 0; found && i < 3; ++i)
    {
        const auto area = pictureArea(i);
        if (!area.contains(event.getPosition()))
            continue;
        const double x = static_cast<double>(event.x - area.getX()) / area.getWidth();
        const double y = static_cast<double>(area.getBottom() - 1 - event.y) / area.getHeight();
        const auto column = std::min(SoundComparison::columns - 1,
                                     static_cast<std::size_t>(x * static_cast<double>(SoundComparison::columns)));
        const auto row =
            std::min(found->rows.count - 1, static_cast<std::size_t>(y * static_cast<double>(found->rows.count)));
        text = numberText(x * found->duration, 2) + " s, " +
               juce::String(juce::roundToInt(found->rows.frequencyAt(static_cast<double>(row) + 0.5))) + " Hz: " +
               tr("{0} dB against the sound",
                  {numberText(static_cast<double>(found->difference[column * found->rows.count + row]), 1)});
    }
    place.setText(text, juce::dontSendNotification);
}

} // namespace pacini::editor
