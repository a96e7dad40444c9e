// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/lanes/WaveformRow.h"

#include "document/view/Columns.h"
#include "editor/Controls.h"
#include "editor/Theme.h"
#include "editor/Translation.h"
#include "editor/clip/lanes/ColumnFill.h"
#include "editor/clip/lanes/LaneText.h"
#include "editor/clip/lanes/PlotLane.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace pacini::editor
{

namespace
{
constexpr int buttonHeight = 20;

bool isDark(const juce::Component& component)
{
    const auto* look = dynamic_cast<const Look*>(&component.getLookAndFeel());
    return look == nullptr || look->isDark();
}
} // namespace

WaveformRow::WaveformRow(const EditorModel& project, const ProjectSounds& projectSounds, ViewState& sight)
    : model(project), sounds(projectSounds), viewState(sight)
{
    setOpaque(true);
    setTitle("Sound");
    prepareButton(viewButton, "Waveform, spectrogram or both (Alt+1 to 3)",
                  [this]
                  {
                      ViewOptions wanted = viewState.viewOptions();
                      wanted.sound = static_cast<SoundView>((static_cast<int>(wanted.sound) + 1) % 3);
                      viewState.setViewOptions(wanted);
                  });
    prepareButton(rangeButton, "Top of the spectrogram: 2 kHz, the limit of touch, or the full range",
                  [this]
                  {
                      ViewOptions wanted = viewState.viewOptions();
                      wanted.wholeSpectrum = !wanted.wholeSpectrum;
                      viewState.setViewOptions(wanted);
                  });
    spectrum.onChanged = [this]
    {
        repaint(plotArea());
    };
    addAndMakeVisible(viewButton);
    addChildComponent(rangeButton);
    subscriptions.on({&viewState.axisChanged}, [this] { repaint(plotArea()); });
    subscriptions.on({&viewState.lookChanged, &sounds.changed},
                     [this]
                     {
                         showOptions();
                         repaint();
                     });
    subscriptions.on({&model.contentChanged},
                     [this]
                     {
                         showOptions();
                         if (const auto sound = sounds.soundOfClip(); std::exchange(drawn, sound) != sound)
                             repaint();
                     });
    showOptions();
}

juce::Rectangle<int> WaveformRow::plotArea() const
{
    return getLocalBounds().withTrimmedLeft(laneHeadWidth).withTrimmedBottom(1);
}

void WaveformRow::showOptions()
{
    const ViewOptions& options = viewState.viewOptions();
    const bool spectral = options.sound != SoundView::waveform;
    const juce::String name = options.sound == SoundView::waveform   ? "Waveform"
                              : options.sound == SoundView::spectrum ? "Spectrum"
                                                                     : "Both";
    viewButton.setButtonText(tr(name));
    viewButton.setTitle(tr("View of the sound: {0}", {tr(name)}));
    rangeButton.setButtonText(options.wholeSpectrum ? tr("All") : juce::String("2 kHz"));
    rangeButton.setTitle(tr("Highest frequency: {0}", {options.wholeSpectrum ? tr("All") : juce::String("2 kHz")}));
    rangeButton.setVisible(spectral);
    spectrum.show(spectral ? sounds.soundOfClip() : nullptr, options.wholeSpectrum);
    setTooltip(tr(spectral ? "Spectrogram of the sound, Hz over time; stronger colour is louder"
                           : "The clip's source sound, channels averaged, -1 to 1"));
}

void WaveformRow::resized()
{
    auto head = getLocalBounds().removeFromLeft(laneHeadWidth).withTrimmedLeft(grid + 3).withTrimmedRight(6);
    auto buttons = head.withTrimmedBottom(6).removeFromBottom(buttonHeight);
    viewButton.setBounds(buttons.removeFromLeft(76));
    buttons.removeFromLeft(4);
    rangeButton.setBounds(buttons);
}

void WaveformRow::mouseMove(const juce::MouseEvent& event)
{
    const auto plot = plotArea();
    if (viewState.viewOptions().sound == SoundView::waveform || !plot.contains(event.getPosition()))
        return showOptions();
    const double time = viewState.axis().timeAt(static_cast<double>(event.position.x) - plot.getX());
    const double place = (plot.getBottom() - static_cast<double>(event.position.y)) / plot.getHeight();
    const double frequency = spectrum.rows().frequencyAt(place * static_cast<double>(spectrum.rows().count));
    const double level = spectrum.levelAt(time, frequency);
    setTooltip(numberText(time, 3) + " s, " + hertzText(frequency) + ", " +
               (level <= SpectrumLevel::floor ? tr("silent") : juce::String(juce::roundToInt(level)) + " dB"));
}

void WaveformRow::paint(juce::Graphics& g)
{
    const Palette& p = paletteFor(*this);
    g.fillAll(p.card);
    const auto plot = plotArea();
    const auto sound = sounds.soundOfClip();
    if (g.getClipBounds().getX() < plot.getX())
        paintHead(g, sound.get());
    g.setColour(p.line);
    g.fillRect(getLocalBounds().removeFromBottom(1));
    g.setColour(p.well);
    const auto visible = g.getClipBounds().getIntersection(plot);
    g.fillRect(visible);
    if (visible.isEmpty())
        return;
    if (!sound)
    {
        g.setColour(p.dim);
        g.setFont(smallFont());
        g.drawText(tr("This clip has no source sound"), plot.reduced(grid, 0), juce::Justification::centredLeft, true);
        return;
    }
    const juce::Graphics::ScopedSaveState saved(g);
    g.reduceClipRegion(visible);
    const SoundView shown = viewState.viewOptions().sound;
    if (shown != SoundView::waveform)
        paintSpectrum(g, plot);
    if (shown != SoundView::spectrum)
        paintWaveform(g, plot, *sound, shown == SoundView::both);
    if (shown == SoundView::waveform)
        return;
    // Windows reach over the end.
    if (const auto clip = model.clip())
    {
        const int end = plot.getX() + juce::roundToInt(std::min(1e6, viewState.axis().xOf(clip->duration)));
        g.setColour(p.background);
        g.fillRect(plot.withLeft(std::clamp(end, plot.getX(), plot.getRight())));
    }
    // The scale of frequencies, over both.
    g.setFont(smallFont());
    for (const double frequency : {50.0, 200.0, 1000.0, 5000.0})
    {
        const double place = spectrum.rows().placeOf(frequency) / static_cast<double>(spectrum.rows().count);
        if (place > 0.95)
            continue;
        const int y = plot.getBottom() - juce::roundToInt(place * plot.getHeight());
        g.setColour(p.text.withAlpha(0.25f));
        g.fillRect(plot.getX(), y, plot.getWidth(), 1);
        const auto text = frequency < 1000.0 ? juce::String(juce::roundToInt(frequency)) + " Hz"
                                             : juce::String(juce::roundToInt(frequency / 1000.0)) + " kHz";
        const juce::Rectangle<int> label(plot.getX() + 3, y - 14, 42, 13);
        g.setColour(p.well.withAlpha(0.7f));
        g.fillRect(label);
        g.setColour(p.text);
        g.drawText(text, label.withTrimmedLeft(3), juce::Justification::centredLeft, false);
    }
}

void WaveformRow::paintHead(juce::Graphics& g, const Sound* sound)
{
    const Palette& p = paletteFor(*this);
    g.setColour(p.dim);
    g.fillRect(0, 0, 3, getHeight() - 1);
    auto head = getLocalBounds()
                    .withWidth(laneHeadWidth)
                    .withTrimmedLeft(grid + 3)
                    .withTrimmedRight(4)
                    .withTrimmedBottom(buttonHeight + 6)
                    .withSizeKeepingCentre(laneHeadWidth - grid - 7, 36);
    g.setColour(p.text);
    g.setFont(usualFont());
    g.drawFittedText(tr("Sound"), head.removeFromTop(19), juce::Justification::centredLeft, 1);
    g.setColour(p.dim);
    g.setFont(smallFont());
    g.drawFittedText(sound != nullptr ? tr("{0} kHz, {1} ch", {numberText(sound->audio.rate() / 1000.0, 1),
                                                               juce::String(sound->audio.channels())})
                                      : tr("none"),
                     head, juce::Justification::centredLeft, 1);
}

void WaveformRow::paintSpectrum(juce::Graphics& g, juce::Rectangle<int> plot)
{
    const auto& image = spectrum.picture(viewState.axis(), plot.getWidth(), plot.getHeight(), isDark(*this));
    g.drawImageAt(image, plot.getX(), plot.getY());
}

void WaveformRow::paintWaveform(juce::Graphics& g, juce::Rectangle<int> plot, const Sound& sound, bool overSpectrum)
{
    const Palette& p = paletteFor(*this);
    const auto visible = g.getClipBounds().getIntersection(plot);
    TimeAxis axis = viewState.axis();
    axis.start = axis.timeAt(visible.getX() - plot.getX());
    std::vector<Column> columns(static_cast<std::size_t>(visible.getWidth()));
    sound.peaks.columns(axis, columns);
    const float middle = static_cast<float>(plot.getCentreY());
    const float half = 0.5f * static_cast<float>(plot.getHeight() - 4);
    g.setColour(p.line);
    if (!overSpectrum)
        g.fillRect(visible.getX(), plot.getCentreY(), visible.getWidth(), 1);
    ColumnFill wave(g, overSpectrum ? p.text.withAlpha(0.55f) : p.dim);
    for (std::size_t i = 0; i < columns.size(); ++i)
    {
        const int top = juce::roundToInt(middle - half * std::clamp(columns[i].high, -1.0f, 1.0f));
        const int bottom = juce::roundToInt(middle - half * std::clamp(columns[i].low, -1.0f, 1.0f));
        if (columns[i] == Column{})
            continue;
        wave.add(visible.getX() + static_cast<int>(i), top, std::max(1, bottom - top));
    }
}

std::vector<Command> WaveformRow::contextCommands() const
{
    return {playOrPause, addMarker, splitClipHere, trim, menuLine, showWaveform, showSpectrum, showBoth, wholeSpectrum};
}

} // namespace pacini::editor
