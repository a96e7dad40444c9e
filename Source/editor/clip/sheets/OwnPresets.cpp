// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/sheets/OwnPresets.h"

#include "editor/Text.h"
#include "editor/Translation.h"
#include "editor/clip/EditorView.h"
#include "editor/clip/sheets/NameSheet.h"

#include <memory>
#include <system_error>
#include <utility>

namespace pacini::editor
{

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
    else
        view.ask(std::make_unique<NameSheet>(
            "Save preset", "Name of the preset", juce::String(),
            [this, watch](const juce::String& name)
            {
                if (!watch.expired())
                    saveAs(name);
            },
            "Save"));
    return true;
}

void OwnPresets::open(const std::filesystem::path& file, const juce::String& name)
{
    if (const auto taken = load(file, name); !taken)
        view.ask(std::make_unique<MessageSheet>(tr("{0} not opened", {pathText(file.filename())}),
                                                translateMessage(toText(taken.error().text())),
                                                std::vector<Sheet::Answer>{{"Close", {}}}));
}

void OwnPresets::saveAs(const juce::String& name)
{
    std::error_code unknown;
    if (!std::filesystem::exists(files.pathOf(name.toStdString()), unknown))
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
        view.ask(std::make_unique<MessageSheet>("Preset not saved", translateMessage(toText(saved.error().text())),
                                                std::vector<Sheet::Answer>{{"Close", {}}}));
    else if (model.onNotice)
        model.onNotice(tr("Preset saved: {0}", {name}));
}

} // namespace pacini::editor
