// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/measure/SaveStep.h"

#include "editor/Controls.h"
#include "editor/Text.h"

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
    : name("Name", "What the actuator is called in the list of actuators"),
      file("File", "The profile that is written, .json"),
      saveButton("Save profile"),
      controller(wanted),
      services(around),
      browse("Browse" + toText("…"))
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
    name.control.setText("My actuator", false);
    name.control.onTextChange = [this]
    {
        follow();
    };
    file.control.onTextChange = [this]
    {
        ownFile = true;
        refresh();
    };
    prepareButton(browse, "Chooses where to write",
                  [this]
                  {
                      services.askForFile("Save the profile", "*.json", true, file.control.getText(),
                                          [this](const juce::File& chosen)
                                          {
                                              ownFile = true;
                                              file.control.setText(chosen.withFileExtension("json").getFullPathName(),
                                                                   false);
                                              refresh();
                                          });
                  });
    use.setButtonText("Use it in this project at once");
    use.setTitle("Use it in this project at once");
    use.setTooltip("Makes it the actuator that the drive signal of this project is made for");
    use.setToggleState(true, juce::dontSendNotification);
    prepareButton(saveButton, "Writes the profile and adds it to the list of actuators", [this] { save(); });
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
    const auto saved = controller.save(
        name.control.getText().trim().toStdString(),
        pathOf(juce::File::getCurrentWorkingDirectory().getChildFile(file.control.getText())), use.getToggleState());
    problem = saved ? std::string() : saved.error().text();
    refresh();
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
        facts.show(
            {{"Resonance", numberText(profile.resonance.frequency, 1) + " Hz, Q " + numberText(profile.resonance.q, 2)},
             {"Range",
              numberText(profile.range.lowFrequency, 0) + " to " + numberText(profile.range.highFrequency, 0) + " Hz"},
             {"Equaliser", juce::String(static_cast<int>(profile.equalizer.size())) + " sections"},
             {"Placements", juce::String(profile.measurement->placements)},
             {"Proof", verified == nullptr ? juce::String("not verified")
                                           : juce::String(verified->linearity.passed() ? "passed, " : "not passed, ") +
                                                 "worst " + (verified->linearity.worstDeviation >= 0.0 ? "+" : "") +
                                                 numberText(verified->linearity.worstDeviation, 2) + " dB"},
             {"Limits from", controller.base() ? toText(work.base().name) : juce::String("nothing is known")}});
        if (!work.saved().empty())
            lines.push_back({"Saved to " + work.saved() + ". It is in the list of actuators now."});
        else
        {
            if (verified == nullptr)
                lines.push_back({"It has not been verified: sweep through the equaliser in step 5 to know that it is "
                                 "flat. It can be saved nevertheless.",
                                 Note::Kind::warning});
            if (juce::File::getCurrentWorkingDirectory().getChildFile(file.control.getText()).existsAsFile())
                lines.push_back({"This file exists and will be replaced.", Note::Kind::warning});
        }
    }
    else
        facts.show({});
    if (!problem.empty())
        lines.insert(lines.begin(), {"The profile was not saved: " + problem, Note::Kind::warning});
    notes.show(std::move(lines));
    resized();
}

void SaveStep::paint(juce::Graphics& g)
{
    const Palette& p = paletteFor(*this);
    auto area = getLocalBounds();
    drawCard(g, area.removeFromTop(25 * grid), "Profile", p);
    area.removeFromTop(grid);
    drawCard(g, area, "What is in it", p);
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
