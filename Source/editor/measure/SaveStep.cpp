// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/measure/SaveStep.h"

#include "editor/Controls.h"
#include "editor/Text.h"
#include "editor/Translation.h"

namespace pacini::editor
{

namespace
{
/// A file's name for the name of an actuator.
juce::String fileNameOf(const juce::String& name)
{
    juce::String plain = name.trim().toLowerCase();
    juce::String result;
    for (int i = 0; i < plain.length(); ++i)
    {
        const auto c = plain[i];
        if (juce::CharacterFunctions::isLetterOrDigit(c))
            result << juce::String::charToString(c);
        else if (!result.endsWithChar('-') && result.isNotEmpty())
            result << "-";
    }
    return result.trimCharactersAtEnd("-");
}
} // namespace

SaveStep::SaveStep(MeasurementController& wanted, StepServices& around)
    : name("Name", "Name in the list of actuators"),
      file("File", "Profile file, .json"),
      saveButton("Save profile"),
      controller(wanted),
      services(around),
      browse(toText("Browse…"))
{
    for (auto* one : {&name, &file})
    {
        one->control.setFont(usualFont());
        one->control.setIndents(grid, 7);
        one->control.onReturnKey = [this]
        {
            save();
        };
    }
    name.control.setText(tr("My actuator"), false);
    name.control.onTextChange = [this]
    {
        follow();
    };
    file.control.onTextChange = [this]
    {
        ownFile = true;
        refresh();
    };
    prepareButton(browse, "Chooses where to save",
                  [this]
                  {
                      services.askForFile("Save profile", "*.json", true, file.control.getText(),
                                          [this](const juce::File& chosen)
                                          {
                                              ownFile = true;
                                              file.control.setText(chosen.withFileExtension("json").getFullPathName(),
                                                                   false);
                                              refresh();
                                          });
                  });
    use.setButtonText("Use in this project");
    use.setTitle("Use in this project");
    use.setTooltip("Makes it the actuator of this project");
    use.setToggleState(true, juce::dontSendNotification);
    prepareButton(saveButton, "Saves the profile and adds it to the list of actuators", [this] { save(); });
    addAll(*this, {&name, &file, &browse, &use, &saveButton, &facts, &notes});
    follow();
}

void SaveStep::follow()
{
    if (!ownFile)
        file.control.setText(juce::File(pathText(controller.profileFolder()))
                                 .getChildFile(fileNameOf(name.control.getText()) + ".json")
                                 .getFullPathName(),
                             false);
    refresh();
}

void SaveStep::save()
{
    const auto target = pathOf(juce::File::getCurrentWorkingDirectory().getChildFile(file.control.getText()));
    services.save({target},
                  [this, target]
                  {
                      const auto saved =
                          controller.save(name.control.getText().trim().toStdString(), target, use.getToggleState());
                      problem = saved ? std::string() : saved.error().text();
                      refresh();
                      return saved.ok();
                  });
}

void SaveStep::refresh()
{
    const ActuatorMeasurement& work = controller.measurement();
    const bool ready = work.equalizer() != nullptr;
    saveButton.setEnabled(ready && name.control.getText().trim().isNotEmpty() &&
                          controller.activity() == MeasurementController::Activity::none);
    std::vector<Note> lines;
    if (ready)
    {
        const Profile profile = work.profile(name.control.getText().toStdString());
        const VerifiedResponse* verified = work.verified();
        facts.show({{tr("Resonance"),
                     numberText(profile.resonance.frequency, 1) + " Hz, Q " + numberText(profile.resonance.q, 2)},
                    {tr("Range"), tr("{0} to {1} Hz", {numberText(profile.range.lowFrequency, 0),
                                                       numberText(profile.range.highFrequency, 0)})},
                    {tr("Equaliser"), counted(profile.equalizer.size(), "{0} section", "{0} sections")},
                    {tr("Placements"), juce::String(profile.measurement->placements)},
                    {tr("Verification"), verified == nullptr ? tr("not verified")
                                                             : tr(verified->linearity.passed() ? "passed, worst {0} dB"
                                                                                               : "failed, worst {0} dB",
                                                                  {signedText(verified->linearity.worstDeviation, 2)})},
                    {tr("Limits from"), controller.base() ? toText(work.base().name) : tr("unknown")}});
        if (!work.saved().empty())
            lines.push_back(
                {tr("Saved to {0}. It is now in the list of actuators.", {toText(work.saved())}).toStdString()});
        else if (verified == nullptr)
            lines.push_back({"Not verified yet. Sweep through the equaliser in step 5 to confirm that it is flat, "
                             "or save it anyway.",
                             Note::Kind::warning});
    }
    else
        facts.show({});
    if (!problem.empty())
        lines.insert(lines.begin(), {tr("Profile not saved: {0}", {translateMessage(toText(problem))}).toStdString(),
                                     Note::Kind::warning});
    notes.show(std::move(lines));
    resized();
}

void SaveStep::paint(juce::Graphics& g)
{
    const Palette& p = paletteFor(*this);
    auto area = getLocalBounds();
    drawCard(g, area.removeFromTop(25 * grid), "Profile", p);
    area.removeFromTop(grid);
    drawCard(g, area, "Contents", p);
}

void SaveStep::resized()
{
    auto area = getLocalBounds();
    auto top = insideOfCard(area.removeFromTop(25 * grid));
    const auto row = [&top]
    {
        const auto line = top.removeFromTop(stepRow);
        top.removeFromTop(grid);
        return line;
    };
    name.setBounds(row().withWidth(std::min(top.getWidth(), 60 * grid)));
    auto line = row();
    browse.setBounds(line.removeFromRight(11 * grid));
    line.removeFromRight(grid);
    file.setBounds(line);
    use.setBounds(row().withTrimmedLeft(name.labelWidth).withWidth(34 * grid));
    saveButton.setBounds(row().withTrimmedLeft(name.labelWidth).withWidth(16 * grid));
    area.removeFromTop(grid);
    auto inside = insideOfCard(area);
    facts.setBounds(inside.removeFromLeft(std::min(inside.getWidth() / 2, 44 * grid)).withHeight(facts.wantedHeight()));
    inside.removeFromLeft(2 * grid);
    notes.setBounds(inside);
}

} // namespace pacini::editor
