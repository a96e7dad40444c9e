// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/panels/AnalysisPanel.h"

#include "editor/Controls.h"
#include "editor/Text.h"
#include "editor/Theme.h"
#include "editor/Translation.h"
#include "editor/clip/EditorView.h"
#include "io/EncoderPresets.h"

#include <algorithm>
#include <string_view>
#include <utility>

namespace pacini::editor
{

namespace
{
constexpr int rowHeight = 3 * grid;
constexpr int numberWidth = 7 * grid + 4;
constexpr int preferredHeight = 94 * grid;
constexpr int labelWidth = 9 * grid;
constexpr int pause = 350; // ms without a change
constexpr int logarithmic = 1, linear = 2;
constexpr double leastWidth = 5.0; // Hz between the ends of the bands
} // namespace

AnalysisPanel::AnalysisPanel(EditorView& shown)
    : view(shown),
      model(shown.session().model),
      sounds(shown.session().sounds),
      replaceButton(toText("Replace sound…")),
      findButton(toText("Locate…")),
      resetButton("Reset"),
      ownPresets(shown, shown.hostServices().presetFolder),
      normalise("Scale to full drive"),
      edits(shown.session().model, shown.session().viewState, shown.session().transport)
{
    setTitle("Analysis");
    const auto label = [this](juce::Label& one, const juce::String& text)
    {
        prepareLabel(one, text, smallFont());
        one.setBorderSize({});
        addAndMakeVisible(one);
    };
    label(state, {});
    state.setAccessible(true);
    state.setTitle("Source sound");
    state.setJustificationType(juce::Justification::topLeft);
    label(presetLabel, "Preset");
    label(spacingLabel, "Spacing");

    preset.setTitle("Preset");
    preset.setTooltip("Named analysis settings");
    fillPresets();
    preset.onChange = [this]
    {
        choosePreset();
    };
    spacing.setTitle("Spacing of the bands");
    spacing.setTooltip("Bands of equal width in octaves, as ear and skin resolve them, or in Hz");
    spacing.addItem("Octaves", logarithmic);
    spacing.addItem("Equal Hz", linear);
    const auto edit = [this]
    {
        edited();
    };
    spacing.onChange = edit;
    normalise.setTitle("Scale to full drive");
    prepareButton(normalise, "Scales the loudest moment to full drive; off: digital full scale is full drive", edit);
    prepareButton(resetButton, "Resets to the Effects preset",
                  [this]
                  {
                      set({});
                      edited();
                  });
    connectPresets();
    prepareSoundButtons();
    addAll(*this, {&replaceButton, &findButton, &preset, &resetButton, &spacing, &normalise, &edits});
    prepareKnobs();
    setSize(200, preferredHeight);
    subscriptions.on({&sounds.workChanged},
                     [this]
                     {
                         // The wish was carried out, or was stopped.
                         if (!sounds.workNow() && !isTimerRunning())
                             waiting.reset();
                     });
    subscriptions.on({&model.projectChanged, &model.versionChanged, &sounds.changed, &sounds.workChanged},
                     [this] { show(); });
    lookAndFeelChanged();
    show();
}

void AnalysisPanel::connectPresets()
{
    ownPresets.settings = [this]
    {
        return analysisSettings(params());
    };
    ownPresets.load = [this](const std::filesystem::path& file, const juce::String& name)
    {
        return take(file, name);
    };
    ownPresets.onSaved = [this](const juce::String& name)
    {
        fillPresets();
        if (name.isNotEmpty())
            lastOwn = OwnPreset{name, params()};
        showPreset(params());
    };
    ownPresets.onRenamed = [this](const juce::String& old, const juce::String& name)
    {
        fillPresets();
        if (lastOwn && lastOwn->name == old)
            lastOwn->name = name;
        if (lastOwn && lastOwn->name.isEmpty())
            lastOwn.reset();
        showPreset(params());
    };
}

void AnalysisPanel::prepareSoundButtons()
{
    prepareButton(
        replaceButton, "Replaces the source sound of this clip and keeps its edits",
        [this]
        {
            const auto item = model.item();
            const AudioReference* sound = item ? model.document().project().findSource(item->source) : nullptr;
            view.files().askForSound("Replace sound", sound != nullptr ? sound->path : std::filesystem::path(),
                                     [this](const std::filesystem::path& file) { sounds.replaceSound(file); });
        });
    prepareButton(
        findButton, "Locates the missing sound file, and others in the same folder",
        [this]
        {
            const auto item = model.item();
            if (const AudioReference* sound = item ? model.document().project().findSource(item->source) : nullptr)
                view.files().askForSound(tr("Locate {0}", {pathText(sound->path.filename())}), sound->path,
                                         [this](const std::filesystem::path& file) { sounds.findSounds(file); });
        });
}

void AnalysisPanel::prepareKnobs()
{
    const auto range = [this](Which which, std::string_view parameter, double step, double scale = 1.0)
    {
        const DescribedRange& described = parameterNamed(encoderParameters, parameter).range;
        knob(which).setRange(scale * described.lowest, scale * described.highest, step);
    };
    prepare(bands, "Bands", "", "Number of frequency bands");
    range(bands, "bands", 1.0);
    prepare(low, "Lowest", " Hz", "Lower end of the lowest band, in Hz");
    range(low, "low", 1.0);
    knob(low).setSkewFactorFromMidPoint(60.0);
    prepare(high, "Highest", " Hz", "Upper end of the highest band, in Hz");
    range(high, "high", 1.0);
    knob(high).setSkewFactorFromMidPoint(400.0);
    prepare(detail, "Detail", " /s", "Max. points per second and band; simple sounds need fewer");
    range(detail, "breakpoints", 0.5);
    knob(detail).setSkewFactorFromMidPoint(20.0);
    prepare(sensitivity, "Events", " x",
            "Event sensitivity: above 1 also finds weaker and closer hits, below 1 only clear ones");
    range(sensitivity, "sensitivity", 0.05);
    knob(sensitivity).setSkewFactorFromMidPoint(1.0);
    prepare(audible, "Audible", " %",
            "Amount of sound above the range of touch that is felt (hi-hats, rain, ticks); 0: none");
    range(audible, "audible", 1.0, 100.0);
    prepare(speech, "Speech", " %",
            "Amount of speech that is felt; below 100 %, what sounds like speech is turned down above 75 Hz");
    range(speech, "speech", 1.0, 100.0);
    prepare(bits, "Precision", " bit", "Bits per value; fewer make smaller files and coarser levels");
    range(bits, "quantise", 1.0);
    // The ends of the bands push each other along.
    knob(low).onValueChange = [this]
    {
        knob(high).setValue(std::max(knob(high).getValue(), knob(low).getValue() + leastWidth),
                            juce::dontSendNotification);
        edited();
    };
    knob(high).onValueChange = [this]
    {
        knob(low).setValue(std::min(knob(low).getValue(), knob(high).getValue() - leastWidth),
                           juce::dontSendNotification);
        edited();
    };
}

void AnalysisPanel::prepare(Which which, const juce::String& name, const juce::String& unit, const juce::String& help)
{
    Knob& one = knobs[which];
    prepareLabel(one.name, name, smallFont());
    one.name.setBorderSize({});
    one.slider.setSliderStyle(juce::Slider::LinearHorizontal);
    one.slider.setTextBoxStyle(juce::Slider::TextBoxRight, false, numberWidth, rowHeight);
    one.slider.setTextValueSuffix(unit);
    one.slider.setTitle(name);
    one.slider.setTooltip(help);
    one.slider.setWantsKeyboardFocus(true);
    one.slider.onValueChange = [this]
    {
        edited();
    };
    addAndMakeVisible(one.name);
    addAndMakeVisible(one.slider);
}

EncoderParams AnalysisPanel::params() const
{
    // What has no control stays as it is.
    const auto item = model.item();
    EncoderParams wanted = item ? item->encoder : EncoderParams{};
    wanted.bands = juce::roundToInt(knob(bands).getValue());
    wanted.lowFrequency = knob(low).getValue();
    wanted.highFrequency = knob(high).getValue();
    wanted.breakpoints = knob(detail).getValue();
    wanted.onsets.sensitivity = knob(sensitivity).getValue();
    wanted.audible = 0.01 * knob(audible).getValue();
    wanted.speech = 0.01 * knob(speech).getValue();
    wanted.quantise = juce::roundToInt(knob(bits).getValue());
    wanted.spacing = spacing.getSelectedId() == linear ? BandSpacing::linear : BandSpacing::logarithmic;
    wanted.normalise = normalise.getToggleState();
    return wanted;
}

void AnalysisPanel::set(const EncoderParams& wanted)
{
    const auto put = [this](Which which, double value)
    {
        knob(which).setValue(value, juce::dontSendNotification);
    };
    put(bands, wanted.bands);
    put(low, wanted.lowFrequency);
    put(high, wanted.highFrequency);
    put(detail, wanted.breakpoints);
    put(sensitivity, wanted.onsets.sensitivity);
    put(audible, 100.0 * wanted.audible);
    put(speech, 100.0 * wanted.speech);
    put(bits, wanted.quantise);
    spacing.setSelectedId(wanted.spacing == BandSpacing::linear ? linear : logarithmic, juce::dontSendNotification);
    normalise.setToggleState(wanted.normalise, juce::dontSendNotification);
    showPreset(wanted);
}

void AnalysisPanel::fillPresets()
{
    preset.clear(juce::dontSendNotification);
    for (std::size_t i = 0; i < encoderPresets().size(); ++i)
        preset.addItem(tr(toText(encoderPresets()[i].name)), 1 + static_cast<int>(i));
    ownPresets.addTo(preset);
}

void AnalysisPanel::choosePreset()
{
    const int chosen = preset.getSelectedId();
    if (chosen < 1)
        return;
    if (chosen >= OwnPresets::firstId)
        showPreset(params()); // until it is chosen; what saves and loads is no preset
    if (ownPresets.choose(chosen))
        return;
    const EncoderParams& wanted = encoderPresets()[static_cast<std::size_t>(chosen - 1)].params;
    set(wanted);
    edited();
    // Also what has no control.
    waiting = wanted;
    showPreset(wanted);
}

Result<void> AnalysisPanel::take(const std::filesystem::path& settings, const juce::String& name)
{
    const auto read = readAnalysisSettings(settings);
    if (!read)
        return read.error();
    if (name.isNotEmpty())
        lastOwn = OwnPreset{name, *read};
    set(*read);
    edited();
    // Also what has no control.
    waiting = *read;
    showPreset(*read);
    return {};
}

void AnalysisPanel::showPreset(const EncoderParams& wanted)
{
    const EncoderPreset* known = presetOf(wanted);
    const bool own = known == nullptr && lastOwn && lastOwn->params == wanted;
    preset.setText(own ? lastOwn->name : tr(known != nullptr ? toText(known->name) : juce::String("Custom")),
                   juce::dontSendNotification);
}

void AnalysisPanel::edited()
{
    waiting = params();
    showPreset(*waiting);
    startTimer(pause);
}

void AnalysisPanel::carryOut()
{
    stopTimer();
    const auto item = model.item();
    if (!waiting || !item)
        return;
    if (*waiting == item->encoder)
        waiting.reset();
    else
        sounds.reanalyse(*waiting);
}

void AnalysisPanel::show()
{
    const auto item = model.item();
    if (shownClip != model.activeId())
    {
        stopTimer();
        waiting.reset();
        shownClip = model.activeId();
    }
    const AudioReference* source = item ? model.document().project().findSource(item->source) : nullptr;
    const auto sound = item ? sounds.soundOfClip() : nullptr;
    const auto shown = model.shownItem(); // version A has settings of its own, which are only looked at
    const bool missing = source != nullptr && sounds.isMissing(source->id);
    juce::String text;
    if (model.isShowingUnanalysed())
        text = tr("Analysing the sound.");
    else if (!item)
        text = tr("No clip.");
    else if (source == nullptr)
        text = tr("This clip has no source sound to analyse. Add one below.");
    else
    {
        text << pathText(source->path.filename()) << "\n";
        if (missing)
            text << tr("The sound file is missing. Locate it to analyse again; everything else works without it.");
        else
            text << tr(source->channels == 1 ? "{0} s, {1} kHz, {2} channel" : "{0} s, {1} kHz, {2} channels",
                       {numberText(source->duration, 2), numberText(source->sampleRate / 1000.0, 1),
                        juce::String(source->channels)})
                 << (source->embedded ? "\n" + tr("Embedded in the project") : juce::String())
                 << (!sound ? "\n" + tr(toText("Loading…")) : juce::String());
    }
    state.setText(text, juce::dontSendNotification);
    replaceButton.setEnabled(item != nullptr);
    findButton.setVisible(missing);
    const bool can = sound != nullptr && !model.isComparing();
    for (Knob& one : knobs)
    {
        one.name.setEnabled(can);
        one.slider.setEnabled(can);
    }
    for (juce::Component* one : std::initializer_list<juce::Component*>{&preset, &presetLabel, &spacing, &spacingLabel,
                                                                        &normalise, &resetButton})
        one->setEnabled(can);
    if (item && waiting && *waiting == item->encoder && !isTimerRunning())
        waiting.reset();
    if (shown && (!waiting || model.isComparing()))
        set(shown->encoder);
    edits.refresh();
    resized();
    repaint();
}

void AnalysisPanel::lookAndFeelChanged()
{
    const Palette& p = paletteFor(*this);
    state.setColour(juce::Label::textColourId, p.text);
    for (juce::Label* one : {&presetLabel, &spacingLabel})
        one->setColour(juce::Label::textColourId, p.dim);
    for (Knob& one : knobs)
        one.name.setColour(juce::Label::textColourId, p.dim);
}

void AnalysisPanel::paint(juce::Graphics& g)
{
    const Palette& p = paletteFor(*this);
    g.fillAll(p.background);
    drawCard(g, soundCard, "Sound", p);
    drawCard(g, settingsCard, "Settings", p);
    drawCard(g, editsCard, edits.heading(), p);
}

void AnalysisPanel::resized()
{
    auto area = getLocalBounds().reduced(grid);
    const auto card = [&](juce::Rectangle<int>& place, int height)
    {
        place = area.removeFromTop(height);
        area.removeFromTop(grid);
        return insideOfCard(place);
    };
    auto inside = card(soundCard, 18 * grid);
    auto line = inside.removeFromBottom(rowHeight + 4);
    if (findButton.isVisible())
    {
        findButton.setBounds(line.removeFromLeft(9 * grid));
        line.removeFromLeft(grid);
    }
    replaceButton.setBounds(line);
    state.setBounds(inside.withTrimmedBottom(grid));

    // In words that are too long for one line the two buttons stand above each other.
    const int resetWidth = buttonWidth(resetButton, 7 * grid);
    const bool stacked =
        usualFont().getStringWidth(normalise.getButtonText()) + 2 * grid + resetWidth > insideOfCard(area).getWidth();
    const int labels = labelsWidth({&presetLabel, &spacingLabel}, labelWidth, 12 * grid);
    inside = card(settingsCard, (stacked ? 53 : 49) * grid);
    const auto row = [&]
    {
        auto next = inside.removeFromTop(rowHeight + 4);
        inside.removeFromTop(grid / 2);
        return next;
    };
    line = row();
    placeNamed(presetLabel, labels, preset, line);
    const auto named = [this](Which which)
    {
        return NamedSlider{knobs[which].name, knob(which), numberWidth};
    };
    // All look alike.
    const bool above = !hasTracks({named(bands)}, labels - grid, inside.getWidth());
    for (const Which which : {bands, low, high})
        placeSlider(named(which), labels - grid, row(), above);
    line = row();
    placeNamed(spacingLabel, labels, spacing, line);
    for (const Which which : {detail, sensitivity, audible, speech, bits})
        placeSlider(named(which), labels - grid, row(), above);
    line = row();
    if (stacked)
    {
        normalise.setBounds(line);
        line = row();
    }
    resetButton.setBounds(stacked ? line : line.removeFromRight(resetWidth));
    line.removeFromRight(grid / 2);
    if (!stacked)
        normalise.setBounds(line);
    edits.setBounds(card(editsCard, area.getHeight()));
}

} // namespace pacini::editor
