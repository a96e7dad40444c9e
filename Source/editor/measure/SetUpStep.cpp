// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/measure/SetUpStep.h"

#include "editor/Controls.h"
#include "editor/Text.h"
#include "editor/Translation.h"

#include <algorithm>
#include <cmath>

namespace pacini::editor
{

namespace
{
constexpr int first = 1; // menus know no item 0
constexpr int noteHeight = 8 * grid;
const juce::String recordings = "*.wav;*.flac;*.aif;*.aiff;*.w64;*.caf";

void fill(juce::ComboBox& box, const std::vector<std::string>& names, const char* noneText = nullptr)
{
    juce::StringArray wanted;
    if (noneText != nullptr)
        wanted.add(tr(noneText));
    for (const std::string& name : names)
        wanted.add(tr(toText(name))); // of a simulation; what devices call theirs stays
    bool same = box.getNumItems() == wanted.size();
    for (int i = 0; same && i < wanted.size(); ++i)
        same = box.getItemText(i) == wanted[i];
    if (same)
        return;
    box.clear(juce::dontSendNotification);
    for (int i = 0; i < wanted.size(); ++i)
        box.addItem(wanted[i], first + i);
}
} // namespace

SetUpStep::SetUpStep(MeasurementController& wanted, StepServices& around)
    : controller(wanted),
      services(around),
      rig("Rig", "Audio device with actuator and sensor, or a simulation to try things out"),
      output("Output", "Output connected to the actuator's amplifier"),
      base("Limits from", "Profile for values that are not measured: impedance, voltage, power and travel"),
      input{Named<juce::ComboBox>{"Sensor", "Input of the microphone or of the accelerometer's first axis"},
            Named<juce::ComboBox>{"2nd axis", "Input of the accelerometer's second axis"},
            Named<juce::ComboBox>{"3rd axis", "Input of the accelerometer's third axis"}},
      devices(toText("Audio devices…")),
      level("Level", "Sweep peak level, dB re full scale"),
      low("From", "Start frequency of the sweep, Hz"),
      high("To", "End frequency of the sweep, Hz"),
      duration("Length", "Length of one sweep, s; doubling it improves the noise by 3 dB"),
      repeats("Sweeps", "Number of sweeps to average, 1 to 10"),
      saveSweep(toText("Save sweep…")),
      openRecording(toText("Open recording…"))
{
    prepareSlider(level.control, -40.0, 0.0, 0.5, "dB", 1);
    prepareSlider(low.control, 5.0, 200.0, 1.0, "Hz", 0);
    prepareSlider(high.control, 400.0, 2000.0, 10.0, "Hz", 0);
    prepareSlider(duration.control, 1.0, 60.0, 1.0, "s", 0);
    prepareSlider(repeats.control, 1.0, 10.0, 1.0, "", 0);
    prepareSlider(fullScale, 0.01, 2000.0, 0.01, toText("m/s²"), 2);
    low.control.setSkewFactorFromMidPoint(30.0);
    duration.control.setSkewFactorFromMidPoint(12.0);
    fullScale.setTextBoxStyle(juce::Slider::TextBoxRight, false, 12 * grid, 3 * grid);
    fullScale.setSkewFactorFromMidPoint(50.0);
    fullScale.setTitle("Calibration");
    fullScale.setTooltip(toText("Acceleration at full scale, m/s². A 5 g accelerometer on a matched input: 49.03"));
    calibrated.setButtonText("Calibrated");
    calibrated.setTitle("Calibrated");
    calibrated.setTooltip(toText(
        "On: levels in m/s², using the number beside. Off: relative levels; shape and equaliser are still correct"));
    tone.setButtonText("100 Hz test tone");
    tone.setTitle("Test tone");

    rig.control.onChange = [this]
    {
        controller.chooseRig(static_cast<std::size_t>(std::max(0, rig.control.getSelectedId() - first)));
    };
    base.control.onChange = [this]
    {
        const int chosen = base.control.getSelectedId() - first - 1;
        controller.setBase(chosen < 0 ? std::nullopt : std::optional(static_cast<std::size_t>(chosen)));
    };
    const auto wire = [this]
    {
        takeWiring();
    };
    output.control.onChange = wire;
    for (auto& one : input)
        one.control.onChange = wire;
    const auto take = [this]
    {
        takeSettings();
    };
    for (auto* one : {&level, &low, &high, &duration, &repeats})
        one->control.onValueChange = take;
    fullScale.onValueChange = take;
    calibrated.onClick = take;
    prepareButton(tone, "Plays a steady 100 Hz tone at the sweep level to check the sensor",
                  [this] { controller.setTone(tone.getToggleState()); });
    prepareButton(devices, "Chooses the audio device, its inputs and sample rate", [this] { services.showDevices(); });
    prepareButton(saveSweep, "Saves the sweep as a sound file for another player, with a description",
                  [this] { services.saveSweep(false); });
    prepareButton(openRecording, "Opens a sweep recorded elsewhere, one to three channels",
                  [this]
                  {
                      services.askForFile("Open a sweep recording", recordings, false, {},
                                          [this](const juce::File& file)
                                          { controller.readRecording(pathOf(file), false); });
                  });
    addAll(*this, {&rig,       &output,    &input[0], &input[1],  &input[2],      &calibrated, &fullScale, &meters[0],
                   &meters[1], &meters[2], &tone,     &devices,   &level,         &low,        &high,      &duration,
                   &repeats,   &base,      &facts,    &saveSweep, &openRecording, &notes});
    std::vector<std::string> profiles;
    profiles.emplace_back(tr("Unknown").toStdString());
    for (const auto& name : controller.profileNames())
        profiles.push_back(name);
    fill(base.control, profiles);
    refresh();
}

void SetUpStep::takeWiring()
{
    RigWiring wiring;
    wiring.output = static_cast<std::size_t>(std::max(0, output.control.getSelectedId() - first));
    wiring.inputs.clear();
    for (std::size_t i = 0; i < inputs; ++i)
    {
        const int chosen = input[i].control.getSelectedId() - first - (i == 0 ? 0 : 1);
        if (chosen >= 0)
            wiring.inputs.push_back(static_cast<std::size_t>(chosen));
    }
    controller.setWiring(wiring);
    refresh();
}

void SetUpStep::takeSettings()
{
    MeasureSettings settings = controller.measurement().settings();
    settings.level = level.control.getValue();
    settings.lowFrequency = low.control.getValue();
    settings.highFrequency = high.control.getValue();
    settings.duration = duration.control.getValue();
    settings.repeats = static_cast<int>(std::lround(repeats.control.getValue()));
    settings.calibrated = calibrated.getToggleState();
    settings.fullScale = fullScale.getValue();
    controller.setSettings(settings);
    refresh();
}

void SetUpStep::refresh()
{
    const MeasureSettings& settings = controller.measurement().settings();
    const RigPorts& ports = controller.ports();
    const RigWiring& wiring = controller.wiring();
    const bool locked = controller.measurement().rangeLocked();
    const bool busy = controller.isPlaying();
    const auto quietly = juce::dontSendNotification;

    fill(rig.control, controller.rigNames());
    rig.control.setSelectedId(first + static_cast<int>(controller.rigIndex()), quietly);
    fill(output.control, ports.outputs);
    output.control.setSelectedId(first + static_cast<int>(wiring.output), quietly);
    output.control.setTextWhenNoChoicesAvailable(tr("No output"));
    for (std::size_t i = 0; i < inputs; ++i)
    {
        auto& box = input[i].control;
        fill(box, ports.inputs, i == 0 ? nullptr : "None");
        box.setTextWhenNothingSelected(tr(ports.inputs.empty() ? "No input" : "None"));
        const bool used = i < wiring.inputs.size();
        box.setSelectedId(used ? first + static_cast<int>(wiring.inputs[i]) + (i == 0 ? 0 : 1) : (i == 0 ? 0 : first),
                          quietly);
        input[i].setEnabled(!busy && !ports.inputs.empty());
    }
    nameMeters(meters, controller);
    rig.setEnabled(!busy);
    output.setEnabled(!busy && !ports.outputs.empty());
    base.control.setSelectedId(first + (controller.base() ? 1 + static_cast<int>(*controller.base()) : 0), quietly);

    level.control.setValue(settings.level, quietly);
    low.control.setValue(settings.lowFrequency, quietly);
    high.control.setValue(settings.highFrequency, quietly);
    duration.control.setValue(settings.duration, quietly);
    repeats.control.setValue(settings.repeats, quietly);
    calibrated.setToggleState(settings.calibrated, quietly);
    fullScale.setValue(settings.fullScale, quietly);
    low.setEnabled(!locked && !busy);
    high.setEnabled(!locked && !busy);
    for (auto* one : {&level, &duration, &repeats})
        one->setEnabled(!busy);
    calibrated.setEnabled(!locked && !busy);
    fullScale.setEnabled(!locked && !busy && settings.calibrated);
    tone.setToggleState(controller.isToneOn(), quietly);
    tone.setEnabled(!busy && ports.problem.empty());
    devices.setVisible(services.showDevices != nullptr);
    openRecording.setEnabled(controller.activity() == MeasurementController::Activity::none);

    facts.show({{tr("Total length"), numberText(controller.sweepSeconds(), 1) + " s"},
                {tr("Sample rate"), numberText(ports.sampleRate, 0) + " Hz"}});

    std::vector<Note> lines;
    if (const auto obstacle = controller.obstacle(); !obstacle.empty())
        lines.push_back({obstacle, Note::Kind::warning});
    if (locked)
        lines.push_back(
            {"Range and calibration are locked while there are placements. Remove these in step 2 to change them."});
    if (lines.empty())
        lines.push_back({"Turn on the test tone and set the input gain so that the meter stays below -6 dB. Wear or "
                         "mount the actuator as it will be used."});
    notes.show(std::move(lines));
    resized();
}

void SetUpStep::tick()
{
    feedMeters(meters, controller);
}

juce::Rectangle<int> SetUpStep::rigCard() const
{
    auto area = getLocalBounds().withTrimmedBottom(noteHeight + grid);
    return area.removeFromLeft((area.getWidth() - grid) / 2);
}

juce::Rectangle<int> SetUpStep::sweepCard() const
{
    auto area = getLocalBounds().withTrimmedBottom(noteHeight + grid);
    return area.removeFromRight((area.getWidth() - grid) / 2);
}

void SetUpStep::paint(juce::Graphics& g)
{
    const Palette& p = paletteFor(*this);
    drawCard(g, rigCard(), "Rig", p);
    drawCard(g, sweepCard(), "Sweep", p);
    g.setColour(p.card);
    g.fillRoundedRectangle(getLocalBounds().removeFromBottom(noteHeight).toFloat(), 6.0f);
}

void SetUpStep::resized()
{
    const auto row = [](juce::Rectangle<int>& area)
    {
        const auto line = area.removeFromTop(stepRow);
        area.removeFromTop(stepGap);
        return line;
    };
    auto left = insideOfCard(rigCard());
    rig.setBounds(row(left));
    output.setBounds(row(left));
    for (auto& one : input)
        one.setBounds(row(left));
    auto line = row(left);
    calibrated.setBounds(line.removeFromLeft(13 * grid));
    fullScale.setBounds(line.reduced(0, grid / 2));
    left.removeFromTop(grid / 2);
    for (auto& meter : meters)
        meter.setBounds(left.removeFromTop(20));
    left.removeFromTop(grid / 2);
    line = row(left);
    tone.setBounds(line.removeFromLeft(line.getWidth() / 2 + grid));
    line.removeFromLeft(grid);
    devices.setBounds(line);

    auto right = insideOfCard(sweepCard());
    for (juce::Component* one :
         std::initializer_list<juce::Component*>{&level, &low, &high, &duration, &repeats, &base})
        one->setBounds(row(right));
    right.removeFromTop(grid / 2);
    facts.setBounds(right.removeFromTop(facts.wantedHeight()));
    right.removeFromTop(grid);
    line = row(right);
    saveSweep.setBounds(line.removeFromLeft((line.getWidth() - grid) / 2));
    line.removeFromLeft(grid);
    openRecording.setBounds(line);
    notes.setBounds(getLocalBounds().removeFromBottom(noteHeight).reduced(grid / 2, 2));
}

} // namespace pacini::editor
