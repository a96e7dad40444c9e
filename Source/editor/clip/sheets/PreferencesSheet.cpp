// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/sheets/PreferencesSheet.h"

#include "editor/Controls.h"
#include "editor/LanguageProblem.h"
#include "editor/Text.h"
#include "editor/Theme.h"
#include "editor/Translation.h"
#include "editor/clip/EditorView.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pacini::editor
{

namespace
{
constexpr int preferenceRowHeight = 4 * grid;
constexpr int nameWidth = 24 * grid;
constexpr std::array scales{0.75, 1.0, 1.25, 1.5, 1.75, 2.0};
constexpr std::array laneHeights{32, 48, 64, 96};

template <typename Values>
int nearest(const Values& values, double wanted)
{
    std::size_t best = 0;
    for (std::size_t i = 1; i < values.size(); ++i)
        if (std::abs(values[i] - wanted) < std::abs(values[best] - wanted))
            best = i;
    return static_cast<int>(best);
}
} // namespace

PreferencesSheet::PreferencesSheet(EditorView& shown) : Sheet("Preferences", 520, 640), view(shown)
{
    ViewState& viewState = view.session().viewState;
    if (view.hostServices().chooseLanguage)
        addLanguages();
    addChoice("Theme", "Dark or light theme", {"Dark", "Light"}, view.isDark() ? 0 : 1,
              [this](int i) { view.setDark(i == 0); });
    juce::StringArray sizes;
    for (const double scale : scales)
        sizes.add(juce::String(juce::roundToInt(100.0 * scale)) + " %");
    addChoice("Interface scale", "Size of text and controls", sizes, nearest(scales, view.scale()),
              [this](int i) { view.setScale(scales[static_cast<std::size_t>(i)]); });
    addChoice("Levels", "Scale of the level lanes", {"dB", "Linear"}, viewState.amplitudesInDecibels() ? 0 : 1,
              [&viewState](int i) { viewState.setAmplitudesInDecibels(i == 0); });
    addChoice("Lanes", "Height of the lanes", {"Small", "Normal", "Tall", "Very tall"},
              nearest(laneHeights, viewState.laneHeight()),
              [&viewState](int i) { viewState.setLaneHeight(laneHeights[static_cast<std::size_t>(i)]); });
    const auto option = [&viewState](auto member, auto value)
    {
        ViewOptions options = viewState.viewOptions();
        options.*member = value;
        viewState.setViewOptions(options);
    };
    const ViewOptions options = viewState.viewOptions();
    addChoice("Sound", "How the sound is displayed", {"Waveform", "Spectrogram", "Both"},
              static_cast<int>(options.sound),
              [option](int i) { option(&ViewOptions::sound, static_cast<SoundView>(i)); });
    addChoice("During playback", "Whether the view follows the playhead",
              {"Don't follow", "Follow by page", "Keep centred"}, static_cast<int>(options.follow),
              [option](int i) { option(&ViewOptions::follow, static_cast<Follow>(i)); });
    addSwitch("Actuator output", "Shows the actuator's drive and losses below the lanes", options.actuator,
              [option](bool on) { option(&ViewOptions::actuator, on); });
    addSwitch("Technical terms", "Names lanes as in research: Transients, Envelope, Centroid", options.technicalTerms,
              [option](bool on) { option(&ViewOptions::technicalTerms, on); });
    addSwitch("Reduced motion", "The view turns pages instead of sliding, and progress bars stand still",
              options.reducedMotion, [option](bool on) { option(&ViewOptions::reducedMotion, on); });
#if JUCE_LINUX
    addSwitch("Spoken status", "Speech-dispatcher says what notices, questions and the status bar say", options.spoken,
              [option](bool on) { option(&ViewOptions::spoken, on); });
#endif
    const auto target = [&viewState](bool SnapTargets::*member, bool on)
    {
        SnapTargets targets = viewState.snapTargets();
        targets.*member = on;
        viewState.setSnapTargets(targets);
    };
    const SnapTargets targets = viewState.snapTargets();
    for (const auto& [member, name] :
         {std::pair(&SnapTargets::on, "Snap"), std::pair(&SnapTargets::transients, "Snap to events"),
          std::pair(&SnapTargets::grid, "Snap to ruler lines")})
        addSwitch(name, "Dragging snaps to nearby targets; hold Alt to bypass", targets.*member,
                  [target, member = member](bool on) { target(member, on); });
    if (view.hostServices().showDevices)
        addButton("Audio", toText("Audio devices…"), "Chooses the audio device and its outputs", soundDevices);
    if (view.hostServices().outputNames)
        addButton("Haptics", toText("Haptic outputs…"),
                  "Outputs that clips play on: actuator, gain, delay and position of each", hapticOutputs);
    setAnswers({{"Close", {}}});
}

void PreferencesSheet::addButton(const juce::String& name, const juce::String& text, const juce::String& help,
                                 Command command)
{
    auto button = std::make_unique<juce::TextButton>(tr(text));
    prepareButton(*button, help,
                  [shown = juce::Component::SafePointer(&view), command]
                  {
                      // Another sheet takes the place of this one, and of the button.
                      juce::MessageManager::callAsync(
                          [shown, command]
                          {
                              if (shown)
                                  shown->doCommand(command);
                          });
                  });
    add(name, std::move(button));
}

void PreferencesSheet::addLanguages()
{
    juce::StringArray codes{"en"}, names{"English"};
    for (const auto& code : languages())
    {
        codes.add(code);
        names.add(languageChoice(code));
    }
    codes.add({});
    names.add("System default");
    addChoice("Language", "Interface language; takes effect at the next start", names,
              std::max(0, codes.indexOf(view.hostServices().language)),
              [this, codes](int i)
              {
                  view.hostServices().chooseLanguage(codes[i]);
                  lack.setText(missingFont(codes[i].isEmpty() ? systemLanguage() : codes[i]),
                               juce::dontSendNotification);
                  resized();
              });
    lack.setFont(smallFont());
    lack.setTitle("Language");
    addAndMakeVisible(lack);
    lack.setText(missingFont(languageAskedFor().isEmpty() ? systemLanguage() : languageAskedFor()),
                 juce::dontSendNotification);
}

void PreferencesSheet::add(const juce::String& name, std::unique_ptr<juce::Component> control)
{
    auto row = std::make_unique<Row>();
    prepareLabel(row->name, name, usualFont());
    control->setTitle(name);
    row->control = std::move(control);
    addAndMakeVisible(row->name);
    addAndMakeVisible(*row->control);
    rows.push_back(std::move(row));
}

void PreferencesSheet::addChoice(const juce::String& name, const juce::String& help, const juce::StringArray& offered,
                                 int chosen, std::function<void(int)> choose)
{
    auto box = std::make_unique<juce::ComboBox>();
    box->addItemList(offered, 1);
    box->setSelectedItemIndex(chosen, juce::dontSendNotification);
    box->setTooltip(help);
    box->onChange = [choose = std::move(choose), now = box.get()]
    {
        choose(now->getSelectedItemIndex());
    };
    add(name, std::move(box));
}

void PreferencesSheet::addSwitch(const juce::String& name, const juce::String& help, bool on,
                                 std::function<void(bool)> turn)
{
    auto button = std::make_unique<juce::ToggleButton>(on ? "On" : "Off");
    button->setToggleState(on, juce::dontSendNotification);
    prepareButton(*button, help,
                  [turn = std::move(turn), now = button.get()]
                  {
                      now->setButtonText(tr(now->getToggleState() ? "On" : "Off"));
                      turn(now->getToggleState());
                  });
    add(name, std::move(button));
}

void PreferencesSheet::layOut(juce::Rectangle<int> area)
{
    if (lack.getText().isNotEmpty())
        lack.setBounds(area.removeFromBottom(4 * grid));
    else
        lack.setBounds({});
    const int step = std::min(preferenceRowHeight + grid / 2, area.getHeight() / static_cast<int>(rows.size()));
    for (const auto& row : rows)
    {
        auto line = area.removeFromTop(step).withSizeKeepingCentre(area.getWidth(),
                                                                   std::min(step - 2, preferenceRowHeight - 4));
        row->name.setBounds(line.removeFromLeft(nameWidth));
        row->control->setBounds(dynamic_cast<juce::ToggleButton*>(row->control.get())
                                    ? line.withWidth(9 * grid)
                                    : line.withWidth(std::min(line.getWidth(), space::widestBox)));
    }
}

} // namespace pacini::editor
