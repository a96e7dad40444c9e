// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/sheets/OwnPresets.h"

#include "editor/List.h"
#include "editor/Text.h"
#include "editor/Theme.h"
#include "editor/Translation.h"
#include "editor/clip/EditorView.h"
#include "editor/clip/sheets/NameSheet.h"

#include <memory>
#include <utility>

namespace pacini::editor
{

namespace
{
/// All presets, of which one is chosen.
class PresetsSheet final : public Sheet, private juce::ListBoxModel
{
public:
    struct Actions
    {
        std::function<void(const juce::String&)> rename, remove;
        std::function<void()> showFolder;
    };

    PresetsSheet(std::vector<std::string> listed, const Actions& actions)
        : Sheet("Own presets", 480, 400), names(std::move(listed))
    {
        list.setTitle("Own presets");
        list.setRowHeight(3 * grid);
        addAndMakeVisible(list);
        const auto with = [this](const std::function<void(const juce::String&)>& act)
        {
            // The sheet is closed by then.
            return [act, of = chosen]
            {
                act(*of);
            };
        };
        setAnswers({{"Close", {}},
                    {toText("Rename…"), with(actions.rename)},
                    {toText("Delete…"), with(actions.remove)},
                    {"Show in folder", actions.showFolder}});
        list.selectRow(0);
    }
    ~PresetsSheet() override { list.setModel(nullptr); }

private:
    int getNumRows() override { return static_cast<int>(names.size()); }
    juce::String getNameForRow(int row) override
    {
        return row >= 0 && row < getNumRows() ? toText(names[static_cast<std::size_t>(row)]) : juce::String();
    }
    void paintListBoxItem(int row, juce::Graphics& g, int width, int height, bool selected) override
    {
        const Palette& p = paletteFor(*this);
        const juce::Rectangle<int> area(width, height);
        if (selected)
        {
            g.setColour(p.accent.withAlpha(list.hasKeyboardFocus(true) ? 0.35f : 0.2f));
            g.fillRoundedRectangle(area.toFloat().reduced(1.0f), space::corner);
        }
        g.setColour(p.text);
        g.setFont(usualFont());
        g.drawText(getNameForRow(row), area.reduced(grid, 0), juce::Justification::centredLeft, true);
    }
    void selectedRowsChanged(int row) override
    {
        if (row < 0) // one is chosen always
            list.selectRow(0);
        else
            *chosen = getNameForRow(row);
    }
    void paint(juce::Graphics& g) override
    {
        Sheet::paint(g);
        const Palette& p = paletteFor(*this);
        g.setColour(p.well);
        g.fillRoundedRectangle(list.getBounds().toFloat(), space::corner);
    }
    void lookAndFeelChanged() override
    {
        list.setColour(juce::ListBox::backgroundColourId, juce::Colours::transparentBlack);
    }
    void layOut(juce::Rectangle<int> area) override { list.setBounds(area); }
    juce::Component* firstFocus() override { return &list; }

    std::vector<std::string> names;
    std::shared_ptr<juce::String> chosen = std::make_shared<juce::String>();
    List list{{}, this};
};
} // namespace

void OwnPresets::addTo(juce::ComboBox& menu)
{
    names = keeps ? files.names() : std::vector<std::string>();
    menu.addSeparator();
    for (std::size_t i = 0; i < names.size(); ++i)
        menu.addItem(toText(names[i]), firstOwn + static_cast<int>(i));
    if (!names.empty())
        menu.addSeparator();
    if (keeps)
        menu.addItem(tr(toText("Save preset…")), saveId);
    menu.addItem(tr(toText("Load settings…")), loadId);
    if (!names.empty())
        menu.addItem(tr(toText("Manage presets…")), manageId);
}

bool OwnPresets::choose(int id)
{
    if (id < firstId)
        return false;
    const std::weak_ptr<int> watch = alive;
    if (id >= firstOwn)
    {
        const auto& name = names[static_cast<std::size_t>(id - firstOwn)];
        open(files.pathOf(name), toText(name));
    }
    else if (id == loadId)
        view.files().askForSettings(
            [this, watch](const auto& file)
            {
                if (!watch.expired())
                    open(file);
            });
    else if (id == manageId)
        manage();
    else
        askForName();
    return true;
}

void OwnPresets::askForName()
{
    view.ask(std::make_unique<NameSheet>(
        "Save preset", "Name of the preset", juce::String(),
        [this, watch = std::weak_ptr<int>(alive)](const juce::String& name)
        {
            if (!watch.expired())
                saveAs(name);
        },
        "Save"));
}

void OwnPresets::manage()
{
    if (names = files.names(); names.empty())
        return;
    // The owner may go while the sheet is there.
    const auto whileAlive = [watch = std::weak_ptr<int>(alive)](auto act)
    {
        return [watch, act](const auto&... name)
        {
            if (!watch.expired())
                act(name...);
        };
    };
    view.ask(std::make_unique<PresetsSheet>(
        names, PresetsSheet::Actions{whileAlive([this](const juce::String& name) { askToRename(name); }),
                                     whileAlive([this](const juce::String& name) { askToRemove(name); }),
                                     [folder = files.folder()]
                                     {
                                         juce::File(pathText(folder)).revealToUser();
                                     }}));
}

void OwnPresets::askToRename(const juce::String& name)
{
    view.ask(std::make_unique<NameSheet>(
        "Rename preset", "Name of the preset", name,
        [this, name, watch = std::weak_ptr<int>(alive)](const juce::String& wanted)
        {
            if (!watch.expired())
                rename(name, wanted);
        },
        "Rename"));
}

void OwnPresets::askToRemove(const juce::String& name)
{
    view.ask(std::make_unique<MessageSheet>(
        tr("Delete {0}?", {name}), "The preset's file is deleted. What is heard and felt stays as it is.",
        std::vector<Sheet::Answer>{{"Cancel", {}},
                                   {"Delete", [this, name, watch = std::weak_ptr<int>(alive)]
                                    {
                                        if (!watch.expired())
                                            remove(name);
                                    }}}));
}

void OwnPresets::rename(const juce::String& old, const juce::String& name)
{
    if (name != old)
        renamed(files.rename(old.toStdString(), name.toStdString()), "Preset not renamed", old, name);
}

void OwnPresets::remove(const juce::String& name)
{
    renamed(files.remove(name.toStdString()), "Preset not deleted", name, {});
}

void OwnPresets::renamed(const Result<void>& done, const char* failure, const juce::String& old,
                         const juce::String& name)
{
    if (!done)
        tell(failure, done.error());
    else if (onRenamed)
        onRenamed(old, name);
}

void OwnPresets::tell(const juce::String& title, const Error& error)
{
    view.ask(std::make_unique<MessageSheet>(title, translateMessage(toText(error.text())),
                                            std::vector<Sheet::Answer>{{"Close", {}}}));
}

void OwnPresets::open(const std::filesystem::path& file, const juce::String& name)
{
    if (const auto taken = load(file, name); !taken)
        tell(tr("{0} not opened", {pathText(file.filename())}), taken.error());
}

void OwnPresets::saveAs(const juce::String& name)
{
    if (!files.exists(name.toStdString()))
        return write(name, false);
    view.ask(std::make_unique<MessageSheet>(
        tr("Replace the preset {0}?", {name}), "There is a preset of this name.",
        std::vector<Sheet::Answer>{{"Cancel", {}},
                                   {"Replace", [this, name, watch = std::weak_ptr<int>(alive)]
                                    {
                                        if (!watch.expired())
                                            write(name, true);
                                    }}}));
}

void OwnPresets::write(const juce::String& name, bool replace)
{
    const auto saved = files.save(name.toStdString(), settings(), replace);
    if (onSaved)
        onSaved(saved ? name : juce::String());
    auto& model = view.session().model;
    if (!saved)
        tell("Preset not saved", saved.error());
    else if (model.onNotice)
        model.onNotice(tr("Preset saved: {0}", {name}));
}

} // namespace pacini::editor
