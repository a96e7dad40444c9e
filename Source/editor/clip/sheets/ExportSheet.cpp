// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/sheets/ExportSheet.h"

#include "editor/Controls.h"
#include "editor/Text.h"
#include "editor/Theme.h"
#include "editor/Translation.h"
#include "editor/clip/sheets/OverwriteQuestion.h"

#include <algorithm>

namespace pacini::editor
{

namespace
{
constexpr int rowHeight = 4 * grid;
constexpr int labelWidth = 12 * grid;
constexpr int sourceRate = 1; // of the menu; the others are Hz

int itemOf(EventExport events)
{
    return 1 + static_cast<int>(events);
}

juce::String lossText(const FormatLoss& loss)
{
    juce::String text =
        loss.duration > 0.0
            ? tr("{0} to {1} s", {juce::String(loss.time, 2), juce::String(loss.time + loss.duration, 2)})
            : juce::String(loss.time, 2) + " s";
    text << ": " << translateMessage(toText(loss.message));
    if (loss.error > 0.0)
    {
        if (loss.kind == LossKind::frequency)
            text << " " << tr("(up to {0} octaves)", {juce::String(loss.error, 2)});
        else if (loss.kind == LossKind::timeStep)
            text << " " << tr("(up to {0} ms)", {juce::String(1000.0 * loss.error, 1)});
        else
            text << " " << tr("(up to {0} % of full drive)", {juce::String(100.0 * loss.error, 1)});
    }
    return text;
}
} // namespace

ExportSheet::ExportSheet(const EditorModel& project, const Actuators& profiles, ExportMemory& last)
    : Sheet("Export", 680, 520), model(project), actuators(profiles), memory(last), browseButton(toText("Browse…"))
{
    const auto label = [this](juce::Label& one, const juce::String& text)
    {
        prepareLabel(one, text, usualFont());
        addAndMakeVisible(one);
    };
    label(formatLabel, "Format");
    label(rateLabel, "Sample rate");
    label(eventsLabel, "Events");
    label(targetLabel, "File");
    label(lossLabel, "What is kept");
    format.setTitle("Format");
    format.setTooltip("Format of the exported files");
    for (const ClipFormat& one : exportFormats())
        format.addItem(tr(toText(one.title)) + "  " + toText(one.extension), format.getNumItems() + 1);
    const auto& formats = exportFormats();
    const auto known = std::find_if(formats.begin(), formats.end(),
                                    [this](const ClipFormat& one) { return one.name == memory.format; });
    format.setSelectedId(known == formats.end() ? 1 : 1 + static_cast<int>(known - formats.begin()),
                         juce::dontSendNotification);
    format.onChange = [this]
    {
        chooseUsualEvents();
        formatChanged();
    };
    rate.setTitle("Sample rate");
    rate.setTooltip("Sample rate of formats that contain samples, in Hz");
    rate.addItem("Same as sound", sourceRate);
    for (const int hertz : {48000, 8000, 2000})
        rate.addItem(juce::String(hertz) + " Hz", hertz);
    rate.setSelectedId(sourceRate, juce::dontSendNotification);
    if (rate.indexOfItemId(memory.sampleRate) >= 0)
        rate.setSelectedId(memory.sampleRate, juce::dontSendNotification);
    rate.onChange = [this]
    {
        showLosses();
    };
    events.setTitle("Events");
    events.setTooltip("Each event as its own transient, or merged into the voice where that is as strong");
    events.addItem("Transients", itemOf(EventExport::transients));
    events.addItem("Merged into voice", itemOf(EventExport::merged));
    events.setTextWhenNothingSelected(tr("Set by the format"));
    events.onChange = [this]
    {
        showLosses();
    };
    const auto count = model.document().project().clips.size();
    const auto selected = model.selectedClips().size();
    all.setButtonText(selected > 1 ? tr("{0} selected clips", {juce::String(static_cast<int>(selected))})
                      : count > 1  ? tr("All {0} clips of the project", {juce::String(static_cast<int>(count))})
                                   : tr("All clips of the project"));
    all.setTitle("Export all clips");
    all.setEnabled(count > 1);
    all.setToggleState(selected > 1, juce::dontSendNotification);
    prepareButton(all, "One file per clip, in a folder", [this] { formatChanged(); });
    target.setTitle("Destination file or folder");
    target.setFont(usualFont());
    target.setIndents(grid, 7);
    target.onTextChange = [this]
    {
        followExtension();
    };
    target.onReturnKey = [this]
    {
        run();
    };
    target.onEscapeKey = [this]
    {
        close();
    };
    prepareButton(browseButton, "Chooses where to save", [this] { browse(); });
    losses.setMultiLine(true);
    losses.setReadOnly(true);
    losses.setCaretVisible(false);
    losses.setTitle("What is kept and what is lost");
    losses.setFont(smallFont());
    addAll(*this, {&format, &rate, &all, &events, &target, &browseButton, &losses});
    int order = 1;
    for (juce::Component* child :
         std::initializer_list<juce::Component*>{&target, &format, &rate, &all, &events, &browseButton, &losses})
        child->setExplicitFocusOrder(order++);
    setAnswers({{"Export", {}}, {"Cancel", {}}});
    setUsualAnswer([this] { run(); });
    question.onClosed = [this]
    {
        takeFocus();
    };
    const auto& path = model.document().path();
    std::error_code gone;
    const juce::File folder = !memory.folder.empty() && std::filesystem::is_directory(memory.folder, gone)
                                  ? juce::File(pathText(memory.folder))
                              : path.empty() ? documentsFolder()
                                             : juce::File(pathText(path.parent_path()));
    target.setText(folder.getFullPathName(), false);
    chooseUsualEvents();
    formatChanged();
}

const ClipFormat& ExportSheet::chosenFormat() const
{
    return exportFormats()[static_cast<std::size_t>(std::max(0, format.getSelectedId() - 1))];
}

ExportChoice ExportSheet::choice() const
{
    ExportChoice result;
    result.format = chosenFormat().name;
    if (chosenFormat().isSamples && rate.getSelectedId() != sourceRate)
        result.params.sampleRate = rate.getSelectedId();
    if (events.getSelectedId() > 0)
        result.params.events = static_cast<EventExport>(events.getSelectedId() - 1);
    if (const auto profile = actuators.profile())
        result.params.profile = *profile;
    result.params.strength = actuators.strength();
    return result;
}

/// As the command has them for each format.
void ExportSheet::chooseUsualEvents()
{
    const auto own = chosenFormat().events;
    events.setSelectedId(own ? itemOf(*own) : 0, juce::dontSendNotification);
    events.setEnabled(own.has_value());
    eventsLabel.setEnabled(own.has_value());
}

/// Keeps the folder; the file follows the format.
void ExportSheet::formatChanged()
{
    const auto clip = model.clip();
    juce::File now(juce::File::getCurrentWorkingDirectory().getChildFile(target.getText()));
    const juce::File folder = now.isDirectory() ? now : now.getParentDirectory();
    targetLabel.setText(tr(all.getToggleState() ? "Folder" : "File"), juce::dontSendNotification);
    target.setText(all.getToggleState()
                       ? folder.getFullPathName()
                       : folder.getChildFile(toText(exportName(*clip, chosenFormat()))).getFullPathName(),
                   false);
    rate.setEnabled(chosenFormat().isSamples);
    rateLabel.setEnabled(chosenFormat().isSamples);
    showLosses();
}

/// A file that is typed with the ending of another format is of that format.
void ExportSheet::followExtension()
{
    const juce::String name = target.getText();
    if (all.getToggleState() || name.endsWithIgnoreCase(toText(chosenFormat().extension)))
        return;
    const auto& formats = exportFormats();
    const auto found =
        std::find_if(formats.begin(), formats.end(),
                     [&](const ClipFormat& one) { return name.endsWithIgnoreCase(toText(one.extension)); });
    if (found == formats.end())
        return;
    format.setSelectedId(1 + static_cast<int>(found - formats.begin()), juce::dontSendNotification);
    chooseUsualEvents();
    rate.setEnabled(chosenFormat().isSamples);
    rateLabel.setEnabled(chosenFormat().isSamples);
    showLosses();
}

void ExportSheet::showLosses()
{
    const juce::String kept = tr(toText(chosenFormat().keeps));
    losses.setText(kept + "\n", false);
    const int number = ++asked;
    jobs.run([clip = model.clip(), wanted = choice()] { return exportLosses(*clip, wanted); },
             [this, kept, number](Result<std::vector<FormatLoss>> found)
             {
                 if (number != asked)
                     return;
                 juce::StringArray lines;
                 lines.add(kept);
                 lines.add(juce::String());
                 if (!found)
                     lines.add(tr("Cannot be exported: {0}", {translateMessage(toText(found.error().text()))}));
                 else if (found->empty())
                     lines.add(tr("No losses."));
                 else
                 {
                     lines.add(counted(found->size(), "{0} loss:", "{0} losses:"));
                     for (const FormatLoss& loss : *found)
                         lines.add(lossText(loss));
                 }
                 losses.setText(lines.joinIntoString("\n"), false);
                 losses.applyColourToAllText(paletteFor(*this).text);
                 setAnswerEnabled(found.ok());
             });
}

void ExportSheet::browse()
{
    using Browser = juce::FileBrowserComponent;
    const bool folder = all.getToggleState();
    chooser =
        std::make_unique<juce::FileChooser>(tr(folder ? "Export to a folder" : "Export to a file"),
                                            juce::File::getCurrentWorkingDirectory().getChildFile(target.getText()),
                                            folder ? juce::String() : "*" + toText(chosenFormat().extension));
    chooser->launchAsync(folder ? Browser::openMode | Browser::canSelectDirectories
                                : Browser::saveMode | Browser::canSelectFiles, // run() asks
                         [this](const juce::FileChooser& done)
                         {
                             if (done.getResult() != juce::File())
                                 target.setText(done.getResult().getFullPathName(), false);
                         });
}

void ExportSheet::run()
{
    ExportChoice wanted = choice();
    wanted.needed = filesOf(model.document());
    Clips clips;
    const juce::File place = juce::File::getCurrentWorkingDirectory().getChildFile(target.getText());
    if (all.getToggleState())
    {
        const auto selected = model.selectedClips();
        for (const auto& item : model.document().project().clips)
            if (selected.size() < 2 || std::find(selected.begin(), selected.end(), item->id) != selected.end())
                clips.push_back(item->clip);
        wanted.folder = pathOf(place);
    }
    else
    {
        clips.push_back(model.clip());
        wanted.folder = pathOf(place.getParentDirectory());
        wanted.file = place.getFileName().toStdString();
        if (!place.hasFileExtension(toText(chosenFormat().extension)))
            wanted.file += chosenFormat().extension;
    }
    sayBusy();
    jobs.run([clips, wanted] { return filesInTheWay(clips, wanted); },
             [this, clips, wanted](const Result<std::vector<StandingFile>>& standing)
             {
                 setAnswerEnabled(true);
                 if (!standing)
                     return fail(standing.error());
                 if (standing->empty())
                     return write(clips, wanted);
                 showLosses();
                 ExportChoice allowed = wanted;
                 allowed.replaceable = Replaceable::named;
                 question.show(overwriteQuestion(*standing, [this, clips, allowed] { write(clips, allowed); }));
             });
}

void ExportSheet::sayBusy()
{
    setAnswerEnabled(false);
    ++asked;
    losses.setText(tr(toText("Exporting…")), false);
}

void ExportSheet::fail(const Error& error)
{
    losses.setText(tr("Not exported: {0}", {translateMessage(toText(error.text()))}), false);
}

void ExportSheet::write(const Clips& clips, const ExportChoice& wanted)
{
    memory = {wanted.format, rate.getSelectedId() == sourceRate ? 0 : rate.getSelectedId(), wanted.folder};
    sayBusy();
    jobs.run([clips, wanted] { return pacini::exportClips(clips, wanted); },
             [this](const Result<std::vector<ExportReport>>& done)
             {
                 setAnswerEnabled(true);
                 if (!done)
                     return fail(done.error());
                 std::vector<std::filesystem::path> files;
                 for (const ExportReport& report : *done)
                     files.insert(files.end(), report.files.begin(), report.files.end());
                 if (model.onWritten)
                     model.onWritten(files);
                 close();
             });
}

void ExportSheet::layOut(juce::Rectangle<int> area)
{
    const auto row = [&](juce::Label& label)
    {
        auto line = area.removeFromTop(rowHeight);
        label.setBounds(line.removeFromLeft(labelWidth));
        area.removeFromTop(grid);
        return line;
    };
    format.setBounds(row(formatLabel));
    auto line = row(rateLabel);
    rate.setBounds(line.removeFromLeft(20 * grid));
    line.removeFromLeft(2 * grid);
    all.setBounds(line.removeFromRight(28 * grid));
    events.setBounds(row(eventsLabel).removeFromLeft(28 * grid));
    line = row(targetLabel);
    browseButton.setBounds(line.removeFromRight(11 * grid));
    line.removeFromRight(grid);
    target.setBounds(line);
    lossLabel.setBounds(area.removeFromLeft(labelWidth).removeFromTop(rowHeight));
    losses.setBounds(area);
    target.applyColourToAllText(paletteFor(*this).text);
    losses.applyColourToAllText(paletteFor(*this).text);
}

} // namespace pacini::editor
