// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/sheets/ExportSheet.h"

#include "editor/Controls.h"
#include "editor/FileQuestion.h"
#include "editor/Text.h"
#include "editor/Theme.h"
#include "editor/Translation.h"
#include "editor/clip/sheets/OverwriteQuestion.h"

#include <algorithm>
#include <optional>

namespace pacini::editor
{

namespace
{
constexpr int rowHeight = 4 * grid;
constexpr int labelWidth = 12 * grid;
constexpr int fullHeight = 520;
constexpr int mostKept = 9 * grid; // of what is kept, above a table of what is not
constexpr int sourceRate = 1;      // of the menu; the others are Hz

int itemOf(EventExport events)
{
    return 1 + static_cast<int>(events);
}

/// The extension first: a box may cut the rest.
juce::String nameOf(const ClipFormat& format)
{
    return toText(format.extension) + "  " + tr(toText(format.title));
}

/// With the format in front where there are several.
Error ofFormat(Error error, const ExportChoice& choice, bool several)
{
    if (several)
        error.where = choice.format + (error.where.empty() ? "" : ": " + error.where);
    return error;
}
} // namespace

ExportSheet::ExportSheet(const EditorModel& project, const Actuators& profiles, ExportMemory& last)
    : Sheet("Export", 760, fullHeight),
      model(project),
      actuators(profiles),
      memory(last),
      browseButton(toText("Browse…")),
      also(last.also)
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
    prepareFormat();
    prepareTarget();
    losses.setMultiLine(true);
    losses.setReadOnly(true);
    losses.setCaretVisible(false);
    losses.setTitle("What is kept and what is lost");
    losses.setFont(usualFont());
    losses.setScrollbarsShown(true);
    losses.setIndents(grid, 6); // as the texts of the fields above
    losses.setColour(juce::TextEditor::backgroundColourId, juce::Colours::transparentBlack);
    losses.setColour(juce::TextEditor::outlineColourId, juce::Colours::transparentBlack);
    table.onPlace = [this](int clip, double time, double duration)
    {
        remember();
        const auto place = onPlace;
        close();
        if (place)
            place(clip, time, duration);
    };
    addAll(*this, {&format, &alsoButton, &rate, &all, &events, &target, &browseButton, &losses, &table});
    int order = 1;
    for (juce::Component* child : std::initializer_list<juce::Component*>{&target, &format, &alsoButton, &rate, &all,
                                                                          &events, &browseButton, &losses, &table})
        child->setExplicitFocusOrder(order++);
    setAnswers({{"Export", {}}, {"Cancel", {}}});
    setUsualAnswer([this] { run(); });
    question.onClosed = [this]
    {
        takeFocus();
    };
    chooseUsualEvents();
    formatChanged();
    showAlso();
}

void ExportSheet::prepareFormat()
{
    format.setTitle("Format");
    format.setTooltip("Format of the exported files");
    for (const ClipFormat& one : exportFormats())
        format.addItem(nameOf(one), format.getNumItems() + 1);
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
    alsoButton.setTitle("Further formats");
    prepareButton(alsoButton, "Writes the clips in further formats beside this one", [this] { chooseAlso(); });
    rate.setTitle("Sample rate");
    rate.setTooltip("Sample rate of formats that contain samples, in Hz");
    rate.addItem("Same as sound", sourceRate);
    for (const int hertz : {48000, 8000, 2000})
        rate.addItem(juce::String(hertz) + " Hz", hertz);
    rate.setSelectedId(sourceRate, juce::dontSendNotification);
    if (rate.indexOfItemId(memory.sampleRate) >= 0)
        rate.setSelectedId(memory.sampleRate, juce::dontSendNotification);
    events.setTitle("Events");
    events.setTooltip("Each event on its own, or merged into the voice where that is as strong");
    events.addItem("Transients", itemOf(EventExport::transients));
    events.addItem("Merged into voice", itemOf(EventExport::merged));
    events.setTextWhenNothingSelected(tr("Set by the format"));
    rate.onChange = events.onChange = [this]
    {
        showLosses();
    };
}

void ExportSheet::prepareTarget()
{
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
    const auto& path = model.document().path();
    std::error_code gone;
    const juce::File folder = !memory.folder.empty() && std::filesystem::is_directory(memory.folder, gone)
                                  ? juce::File(pathText(memory.folder))
                              : path.empty() ? documentsFolder()
                                             : juce::File(pathText(path.parent_path()));
    target.setText(folder.getFullPathName(), false);
}

const ClipFormat& ExportSheet::chosenFormat() const
{
    return exportFormats()[static_cast<std::size_t>(std::max(0, format.getSelectedId() - 1))];
}

ExportChoice ExportSheet::choice() const
{
    ExportChoice result;
    result.format = chosenFormat().name;
    if (anySamples() && rate.getSelectedId() != sourceRate)
        result.params.sampleRate = rate.getSelectedId();
    if (events.getSelectedId() > 0)
        result.params.events = static_cast<EventExport>(events.getSelectedId() - 1);
    if (const auto profile = actuators.profile())
        result.params.profile = *profile;
    result.params.strength = actuators.strength();
    return result;
}

std::vector<ExportChoice> ExportSheet::choices() const
{
    return choicesFor(choice(), also);
}

/// Whether a rate matters.
bool ExportSheet::anySamples() const
{
    const auto& formats = exportFormats();
    return chosenFormat().isSamples ||
           std::any_of(formats.begin(), formats.end(),
                       [this](const ClipFormat& one)
                       { return one.isSamples && std::find(also.begin(), also.end(), one.name) != also.end(); });
}

void ExportSheet::setAlso(const std::string& name, bool wanted)
{
    std::vector<std::string> now;
    for (const ClipFormat& one : exportFormats())
        if (one.name == name ? wanted : std::find(also.begin(), also.end(), one.name) != also.end())
            now.emplace_back(one.name);
    also = std::move(now);
    showAlso();
    showLosses();
}

/// A menu in which formats are ticked; it comes back until a click beside it.
void ExportSheet::chooseAlso()
{
    juce::PopupMenu menu;
    menu.setLookAndFeel(&getLookAndFeel());
    for (const ClipFormat& one : exportFormats())
    {
        const bool ticked = std::find(also.begin(), also.end(), one.name) != also.end();
        const bool chosen = one.name == chosenFormat().name;
        menu.addItem(nameOf(one), !chosen, chosen || ticked,
                     [this, name = std::string(one.name), ticked]
                     {
                         setAlso(name, !ticked);
                         chooseAlso();
                     });
    }
    menu.showMenuAsync(
        juce::PopupMenu::Options().withTargetComponent(alsoButton).withDeletionCheck(*this).withParentComponent(this));
}

void ExportSheet::showAlso()
{
    const std::size_t count = choicesFor(choice(), also).size() - 1;
    alsoButton.setButtonText(count == 0 ? tr(toText("More formats…"))
                                        : counted(count, toText("+ {0} format…"), toText("+ {0} formats…")));
    rate.setEnabled(anySamples());
    rateLabel.setEnabled(anySamples());
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
    showAlso();
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
    showAlso();
    showLosses();
}

std::vector<std::pair<int, std::shared_ptr<const Clip>>> ExportSheet::chosenClips() const
{
    if (!all.getToggleState())
        return {{model.activeId(), model.clip()}};
    std::vector<std::pair<int, std::shared_ptr<const Clip>>> clips;
    const auto selected = model.selectedClips();
    for (const auto& item : model.document().project().clips)
        if (selected.size() < 2 || std::find(selected.begin(), selected.end(), item->id) != selected.end())
            clips.emplace_back(item->id, item->clip);
    return clips;
}

juce::String ExportSheet::keptText() const
{
    const auto wanted = choices();
    if (wanted.size() == 1)
        return tr(toText(chosenFormat().keeps));
    juce::StringArray lines;
    for (const ExportChoice& one : wanted)
        for (const ClipFormat& known : exportFormats())
            if (known.name == one.format)
                lines.add(tr(toText(known.title)) + ": " + tr(toText(known.keeps)));
    return lines.joinIntoString("\n");
}

void ExportSheet::showLosses()
{
    const juce::String kept = keptText();
    losses.setText(kept + "\n", false);
    table.show({});
    const int number = ++asked;
    using Found = std::vector<LossTable::Part>; // a format's name as the title
    jobs.run(
        [clips = chosenClips(), wanted = choices()]() -> Result<Found>
        {
            Found found;
            for (const auto& [id, clip] : clips)
                for (const ExportChoice& one : wanted)
                {
                    auto lost = exportLosses(*clip, one);
                    if (!lost)
                        return ofFormat(lost.error(), one, wanted.size() > 1);
                    found.push_back({toText(one.format), std::move(*lost), id});
                }
            return found;
        },
        [this, kept, number, formats = choices().size(), clips = chosenClips().size()](const Result<Found>& found)
        {
            if (number != asked)
                return;
            juce::String text = kept + "\n\n";
            std::vector<LossTable::Part> parts;
            if (!found)
                text << tr("Cannot be exported: {0}", {translateMessage(toText(found.error().text()))});
            else
                for (LossTable::Part part : *found)
                {
                    juce::StringArray titles;
                    if (const auto item = model.document().clip(part.clip); clips > 1 && item)
                        titles.add(toText(item->clip->name));
                    for (const ClipFormat& one : exportFormats())
                        if (formats > 1 && toText(one.name) == part.title)
                            titles.add(tr(toText(one.title)));
                    part.title = titles.joinIntoString(", ");
                    parts.push_back(std::move(part));
                }
            table.show(parts);
            if (found && table.isEmpty())
                text << tr("No losses.");
            losses.setText(text.trimEnd(), false);
            losses.applyColourToAllText(paletteFor(*this).text);
            setAnswerEnabled(found.ok());
            fit();
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
    askForFiles(*chooser,
                folder ? Browser::openMode | Browser::canSelectDirectories
                       : Browser::saveMode | Browser::canSelectFiles, // run() asks
                [this](const juce::FileChooser& done)
                {
                    if (done.getResult() != juce::File())
                        target.setText(done.getResult().getFullPathName(), false);
                });
}

void ExportSheet::run()
{
    ExportChoice first = choice();
    first.needed = filesOf(model.document());
    Clips clips;
    for (const auto& [id, clip] : chosenClips())
        clips.push_back(clip);
    const juce::File place = juce::File::getCurrentWorkingDirectory().getChildFile(target.getText());
    if (all.getToggleState())
    {
        first.folder = pathOf(place);
    }
    else
    {
        first.folder = pathOf(place.getParentDirectory());
        first.file = place.getFileName().toStdString();
        if (!place.hasFileExtension(toText(chosenFormat().extension)))
            first.file += chosenFormat().extension;
    }
    sayBusy();
    using Standing = std::vector<StandingFile>;
    jobs.run(
        [clips, wanted = choicesFor(first, also)]() -> Result<Standing>
        {
            Standing standing;
            for (const ExportChoice& one : wanted)
            {
                auto found = filesInTheWay(clips, one);
                if (!found)
                    return ofFormat(found.error(), one, wanted.size() > 1);
                standing.insert(standing.end(), found->begin(), found->end());
            }
            return standing;
        },
        [this, clips, wanted = choicesFor(first, also)](const Result<Standing>& standing)
        {
            setAnswerEnabled(true);
            if (!standing)
                return fail(standing.error());
            if (standing->empty())
                return write(clips, wanted);
            showLosses();
            auto allowed = wanted;
            for (ExportChoice& one : allowed)
                one.replaceable = Replaceable::named;
            question.show(overwriteQuestion(*standing, [this, clips, allowed] { write(clips, allowed); }));
        });
}

void ExportSheet::sayBusy()
{
    setAnswerEnabled(false);
    ++asked;
    table.show({});
    resized();
    losses.setText(tr(toText("Exporting…")), false);
}

void ExportSheet::fail(const Error& error, std::size_t written)
{
    juce::String text = tr("Not exported: {0}", {translateMessage(toText(error.text()))});
    if (written > 0)
        text << "\n" << counted(written, "{0} file was written before.", "{0} files were written before.");
    losses.setText(text, false);
    fit();
    losses.applyColourToAllText(paletteFor(*this).danger, false);
}

/// A table has the full height; what is said without one has the height of its words.
void ExportSheet::fit()
{
    constexpr int rows = 4;
    setContentHeight(table.isEmpty() ? rows * (rowHeight + grid) + wordsHeight() : fullHeight);
    resized();
}

int ExportSheet::wordsHeight() const
{
    return std::max(rowHeight, losses.getTextHeight() + 2 * grid);
}

/// For the next export.
void ExportSheet::remember()
{
    const juce::File place = juce::File::getCurrentWorkingDirectory().getChildFile(target.getText());
    memory = {std::string(chosenFormat().name), rate.getSelectedId() == sourceRate ? 0 : rate.getSelectedId(),
              pathOf(all.getToggleState() ? place : place.getParentDirectory()), also, memory.written};
}

void ExportSheet::write(const Clips& clips, const std::vector<ExportChoice>& wanted)
{
    remember();
    sayBusy();
    struct Done
    {
        std::vector<std::filesystem::path> files;
        std::optional<Error> failed; ///< what came after `files`
    };
    jobs.run(
        [clips, wanted]() -> Done
        {
            Done result;
            for (const ExportChoice& one : wanted)
            {
                const auto reports = pacini::exportClips(clips, one);
                if (!reports)
                {
                    result.failed = ofFormat(reports.error(), one, wanted.size() > 1);
                    break;
                }
                for (const ExportReport& report : *reports)
                    result.files.insert(result.files.end(), report.files.begin(), report.files.end());
            }
            return result;
        },
        [this](const Done& done)
        {
            setAnswerEnabled(true);
            if (!done.files.empty())
            {
                memory.written = true;
                if (model.onWritten)
                    model.onWritten(done.files);
            }
            if (done.failed)
                return fail(*done.failed, done.files.size());
            close();
        });
}

void ExportSheet::layOut(juce::Rectangle<int> area)
{
    const int labels =
        labelsWidth({&formatLabel, &rateLabel, &eventsLabel, &targetLabel, &lossLabel}, labelWidth, 18 * grid);
    const auto row = [&](juce::Label& label)
    {
        auto line = area.removeFromTop(rowHeight);
        label.setBounds(line.removeFromLeft(labels));
        area.removeFromTop(grid);
        return line;
    };
    auto line = row(formatLabel);
    // What a format is called says what it is, so all of it is shown.
    const int alsoWidth = buttonWidth(alsoButton, 18 * grid);
    alsoButton.setBounds(line.removeFromRight(alsoWidth));
    line.removeFromRight(grid);
    format.setBounds(line);
    line = row(rateLabel);
    rate.setBounds(line.removeFromLeft(20 * grid));
    line.removeFromLeft(2 * grid);
    all.setBounds(line.removeFromRight(28 * grid));
    events.setBounds(row(eventsLabel).removeFromLeft(28 * grid));
    line = row(targetLabel);
    browseButton.setBounds(line.removeFromRight(buttonWidth(browseButton, 11 * grid)));
    line.removeFromRight(grid);
    target.setBounds(line);
    lossLabel.setBounds(area.removeFromLeft(labels).removeFromTop(rowHeight));
    table.setVisible(!table.isEmpty());
    losses.setBounds(area);
    if (table.isVisible())
    {
        losses.setBounds(area.removeFromTop(std::min(mostKept, wordsHeight())));
        table.setBounds(area.withTrimmedTop(grid));
    }
    target.applyColourToAllText(paletteFor(*this).text);
    losses.applyColourToAllText(paletteFor(*this).text);
}

} // namespace pacini::editor
