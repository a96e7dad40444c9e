// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/EditorView.h"

#include "editor/clip/CurveLane.h"
#include "editor/clip/ExportSheet.h"
#include "editor/clip/ShortcutsSheet.h"
#include "io/AnyClip.h"

#include <algorithm>
#include <cmath>

namespace pacini::editor
{

namespace
{
constexpr int menuHeight = 26;
constexpr int toolbarHeight = 42;
constexpr int inspectorWidth = 232;
constexpr int firstDemo = 10000; // items of menus
constexpr int firstRecent = 20000;
constexpr int clearRecent = 30000;

const CommandInfo* infoOf(int id)
{
    for (const CommandInfo& info : commandTable())
        if (info.id == id)
            return &info;
    return nullptr;
}

juce::String soundPattern()
{
    juce::String pattern = "*.pacini;*.wav;*.flac;*.ogg;*.opus;*.mp3;*.aif;*.aiff;*.caf;*.w64;*.au";
    for (const auto& extension : anyClipExtensions())
        pattern << ";*" << extension;
    return pattern;
}

std::filesystem::path pathOf(const juce::File& file)
{
    return std::filesystem::path(file.getFullPathName().toStdString());
}
} // namespace

EditorView::EditorView(Session& shared, std::vector<std::filesystem::path> demoSounds)
    : session(shared),
      demos(std::move(demoSounds)),
      menuBar(this),
      toolbar(shared),
      clipPart(shared),
      inspector(shared),
      empty(shared, demos)
{
    setLookAndFeel(&look);
    tooltips.setLookAndFeel(&look);
    setOpaque(true);
    setWantsKeyboardFocus(true);
    setFocusContainerType(FocusContainerType::keyboardFocusContainer);
    addAndMakeVisible(body);
    for (juce::Component* child :
         std::initializer_list<juce::Component*>{&menuBar, &toolbar, &clipPart, &inspector, &empty})
        body.addAndMakeVisible(child);
    commands.registerAllCommandsForTarget(this);
    commands.setFirstCommandTarget(this);
    setApplicationCommandManagerToWatch(&commands);
    addKeyListener(commands.getKeyMappings());
    toolbar.onCommand = inspector.onCommand = [this](Command command)
    {
        doCommand(command);
    };
    empty.onOpen = [this]
    {
        doCommand(openFile);
    };
    empty.onFile = [this](const std::filesystem::path& file)
    {
        open({file});
    };
    session.onError = [this](const juce::String& title, const juce::String& text)
    {
        showSheet(std::make_unique<MessageSheet>(title, text, std::vector<Sheet::Answer>{{"Close", {}}}));
    };
    session.listeners.add(this);
    arrange();
}

EditorView::~EditorView()
{
    session.listeners.remove(this);
    session.onError = nullptr;
    removeKeyListener(commands.getKeyMappings());
    setApplicationCommandManagerToWatch(nullptr);
    menuBar.setModel(nullptr);
    sheetNow.reset();
    tooltips.setLookAndFeel(nullptr);
    setLookAndFeel(nullptr);
}

juce::String EditorView::title() const
{
    const auto& path = session.document().path();
    return (path.empty() ? juce::String("Untitled") : juce::String::fromUTF8(path.stem().string().c_str())) +
           (session.document().isDirty() ? " *" : "") + " - Pacini Editor";
}

void EditorView::setDark(bool dark)
{
    look.setDark(dark);
    sendLookAndFeelChange();
    repaint();
    if (onLookChanged)
        onLookChanged();
}

void EditorView::setScale(double wanted)
{
    scaleNow = std::clamp(wanted, 0.75, 2.0);
    body.setTransform(juce::AffineTransform::scale(static_cast<float>(scaleNow)));
    resized();
    if (onLookChanged)
        onLookChanged();
}

void EditorView::sessionChanged(unsigned changes)
{
    if ((changes & (Session::project | Session::content | Session::work)) != 0)
        arrange();
    if ((changes & (Session::project | Session::selection | Session::range | Session::playback)) != 0)
    {
        commands.commandStatusChanged();
        if (onTitleChanged)
            onTitleChanged();
    }
}

void EditorView::arrange()
{
    const bool any = session.clip() != nullptr;
    clipPart.setVisible(any);
    inspector.setVisible(any);
    empty.setVisible(!any);
}

void EditorView::paint(juce::Graphics& g)
{
    g.fillAll(look.palette().background);
}

void EditorView::resized()
{
    body.setBounds(0, 0, static_cast<int>(std::ceil(getWidth() / scaleNow)),
                   static_cast<int>(std::ceil(getHeight() / scaleNow)));
    auto area = body.getLocalBounds();
    if (sheetNow)
        sheetNow->setBounds(area);
    menuBar.setBounds(area.removeFromTop(menuHeight));
    toolbar.setBounds(area.removeFromTop(toolbarHeight));
    empty.setBounds(area);
    inspector.setBounds(area.removeFromRight(inspectorWidth));
    clipPart.setBounds(area);
}

// Sheets.

void EditorView::takeFocus()
{
    if (sheetNow)
        sheetNow->takeFocus();
    else if (isShowing())
        grabKeyboardFocus();
}

void EditorView::showSheet(std::unique_ptr<Sheet> wanted)
{
    sheetNow = std::move(wanted);
    if (!sheetNow)
        return takeFocus();
    sheetNow->onClose = [this]
    {
        // Not from within one of its own functions.
        juce::MessageManager::callAsync(
            [self = juce::Component::SafePointer<EditorView>(this), closed = sheetNow.get()]
            {
                if (self && self->sheetNow.get() == closed)
                    self->showSheet(nullptr);
            });
    };
    body.addAndMakeVisible(*sheetNow);
    sheetNow->setBounds(body.getLocalBounds());
    sheetNow->takeFocus();
}

void EditorView::whenSaved(std::function<void()> next)
{
    if (!session.document().isDirty() || session.isEmpty())
        return next();
    const auto& path = session.document().path();
    showSheet(std::make_unique<MessageSheet>(
        "Save the changes?",
        (path.empty() ? juce::String("This project has never been saved.")
                      : juce::String::fromUTF8(path.filename().string().c_str()) + " has changes that are not saved.") +
            " Without saving they are lost.",
        std::vector<Sheet::Answer>{{"Save",
                                    [this, next]
                                    {
                                        saveThen(next);
                                    }},
                                   {"Don't save",
                                    [this, next]
                                    {
                                        session.discardAutosave();
                                        next();
                                    }},
                                   {"Cancel", {}}}));
}

void EditorView::saveThen(std::function<void()> next)
{
    if (session.document().path().empty())
        return askName(std::move(next));
    if (const auto saved = session.save(); !saved)
        session.onError("Not saved", juce::String::fromUTF8(saved.error().text().c_str()));
    else if (next)
        next();
}

void EditorView::askName(std::function<void()> next)
{
    choose("Save the project", true,
           [this, next](const juce::File& file)
           {
               if (const auto saved = session.saveAs(pathOf(file.withFileExtension("pacini"))); !saved)
                   session.onError("Not saved", juce::String::fromUTF8(saved.error().text().c_str()));
               else if (next)
                   next();
           });
}

void EditorView::choose(const juce::String& title, bool saving, std::function<void(const juce::File&)> chosen)
{
    const auto& path = session.document().path();
    const juce::File start = path.empty() ? juce::File::getSpecialLocation(juce::File::userDocumentsDirectory)
                                          : juce::File(juce::String::fromUTF8(path.string().c_str()));
    chooser = std::make_unique<juce::FileChooser>(
        title, saving && path.empty() ? start.getChildFile("Untitled.pacini") : start,
        saving ? juce::String("*.pacini") : soundPattern());
    using Browser = juce::FileBrowserComponent;
    chooser->launchAsync(saving ? Browser::saveMode | Browser::canSelectFiles | Browser::warnAboutOverwriting
                                : Browser::openMode | Browser::canSelectFiles | Browser::canSelectMultipleItems,
                         [chosen](const juce::FileChooser& done)
                         {
                             for (const auto& file : done.getResults())
                                 chosen(file);
                         });
}

void EditorView::offerRecovery()
{
    const auto found = session.recoverable();
    const auto usable =
        std::find_if(found.begin(), found.end(), [](const Recoverable& entry) { return !entry.problem; });
    if (usable == found.end())
        return;
    juce::StringArray names;
    for (const auto& name : usable->clips)
        names.add(juce::String::fromUTF8(name.c_str()));
    const juce::Time when(static_cast<juce::int64>(usable->time * 1000.0));
    showSheet(std::make_unique<MessageSheet>(
        "Restore unsaved work?",
        "Pacini did not end properly. Changes of " +
            (usable->project.empty() ? juce::String("a project that was never saved")
                                     : juce::String::fromUTF8(usable->project.filename().string().c_str())) +
            " from " + when.toString(true, true, false) + " can be restored. Clips: " + names.joinIntoString(", "),
        std::vector<Sheet::Answer>{{"Restore",
                                    [this, entry = *usable]
                                    {
                                        if (const auto done = session.recover(entry); !done)
                                            session.onError("Not restored",
                                                            juce::String::fromUTF8(done.error().text().c_str()));
                                    }},
                                   {"Discard",
                                    [entry = *usable]
                                    {
                                        discardRecoverable(entry);
                                    }},
                                   {"Later", {}}}));
}

// Files.

void EditorView::open(const std::vector<std::filesystem::path>& files)
{
    const bool replaces = std::any_of(files.begin(), files.end(),
                                      [](const std::filesystem::path& file) { return file.extension() == ".pacini"; });
    if (replaces)
        whenSaved([this, files] { session.openFiles(files); });
    else
        session.openFiles(files);
}

void EditorView::filesDropped(const juce::StringArray& files, int, int)
{
    empty.setDropping(false);
    std::vector<std::filesystem::path> paths;
    for (const auto& file : files)
        paths.emplace_back(file.toStdString());
    open(paths);
}

// Menus.

juce::StringArray EditorView::getMenuBarNames()
{
    juce::StringArray names;
    for (const char* name : menuNames)
        names.add(name);
    return names;
}

juce::PopupMenu EditorView::getMenuForIndex(int, const juce::String& name)
{
    juce::PopupMenu menu;
    menu.setLookAndFeel(&look);
    for (const CommandInfo& info : commandTable())
    {
        if (name != info.menu || (info.id == soundDevices && !onDevices) || (info.id == quit && !onQuit))
            continue;
        if (info.lineBefore)
            menu.addSeparator();
        if (info.id == openDemo)
        {
            juce::PopupMenu demoMenu, recentMenu;
            for (std::size_t i = 0; i < demos.size(); ++i)
                demoMenu.addItem(firstDemo + static_cast<int>(i),
                                 juce::String::fromUTF8(demos[i].stem().string().c_str()).replaceCharacter('_', ' '));
            const auto& files = session.recentFiles().files();
            for (std::size_t i = 0; i < files.size(); ++i)
                recentMenu.addItem(firstRecent + static_cast<int>(i), juce::String::fromUTF8(files[i].string().c_str()),
                                   RecentFiles::exists(files[i]));
            if (!files.empty())
            {
                recentMenu.addSeparator();
                recentMenu.addItem(clearRecent, "Forget them");
            }
            menu.addSubMenu("Recent projects", recentMenu, !files.empty());
            menu.addSubMenu(info.name, demoMenu, !demos.empty());
        }
        else
            menu.addCommandItem(&commands, info.id);
    }
    return menu;
}

void EditorView::menuItemSelected(int id, int)
{
    const auto& recent = session.recentFiles().files();
    if (id == clearRecent)
        (void)session.recentFiles().clear();
    else if (id >= firstRecent && static_cast<std::size_t>(id - firstRecent) < recent.size())
        open({recent[static_cast<std::size_t>(id - firstRecent)]});
    else if (id >= firstDemo && static_cast<std::size_t>(id - firstDemo) < demos.size())
        open({demos[static_cast<std::size_t>(id - firstDemo)]});
}

void EditorView::getAllCommands(juce::Array<juce::CommandID>& ids)
{
    for (const CommandInfo& info : commandTable())
        ids.add(info.id);
}

void EditorView::getCommandInfo(juce::CommandID id, juce::ApplicationCommandInfo& result)
{
    const CommandInfo* info = infoOf(id);
    if (info == nullptr)
        return;
    juce::String name = juce::String(info->name).replace("...", juce::String::fromUTF8("…"));
    if (id == undo && session.document().canUndo())
        name << " " << juce::String::fromUTF8(session.document().undoName().c_str()).toLowerCase();
    if (id == redo && session.document().canRedo())
        name << " " << juce::String::fromUTF8(session.document().redoName().c_str()).toLowerCase();
    result.setInfo(name, info->help, info->menu, 0);
    result.setActive(canDo(info->id));
    result.setTicked(isOn(info->id));
    if (info->key != 0)
        result.addDefaultKeypress(info->key, juce::ModifierKeys(info->modifiers));
    if (id == zoomIn)
        result.addDefaultKeypress('=', juce::ModifierKeys());
    if (id == zoomIn)
        result.addDefaultKeypress('+', juce::ModifierKeys(juce::ModifierKeys::shiftModifier));
    if (id == redo)
        result.addDefaultKeypress('y', juce::ModifierKeys(juce::ModifierKeys::commandModifier));
    if (id == deleteSelection)
        result.addDefaultKeypress(juce::KeyPress::backspaceKey, juce::ModifierKeys());
}

bool EditorView::canDo(Command command) const
{
    const Document& document = session.document();
    const bool any = session.clip() != nullptr;
    switch (command)
    {
    case newProject:
    case openFile:
    case quit:
    case lightLook:
    case largerInterface:
    case smallerInterface:
    case soundDevices:
    case shortcuts:
    case decibels:
    case hearHaptic:
    case hearSound:
    case hearBoth:
    case loop:
        return true;
    case openDemo:
        return !demos.empty();
    case editor::undo:
        return document.canUndo();
    case editor::redo:
        return document.canRedo();
    case paste:
        return any && session.canPaste();
    case deleteSelection:
    case selectNone:
        return !pacini::isEmpty(session.selected());
    case trim:
        return any && session.timeRange().has_value();
    case zoomToRange:
        return any && (session.timeRange() || !pacini::isEmpty(session.selected()));
    case nextClip:
        return document.project().clips.size() > 1;
    default:
        return any;
    }
}

bool EditorView::isOn(Command command) const
{
    switch (command)
    {
    case loop:
        return session.isLooping();
    case hearHaptic:
        return session.heard() == Heard::haptic;
    case hearSound:
        return session.heard() == Heard::sound;
    case hearBoth:
        return session.heard() == Heard::both;
    case decibels:
        return session.amplitudesInDecibels();
    case lightLook:
        return !look.isDark();
    default:
        return false;
    }
}

bool EditorView::perform(const InvocationInfo& info)
{
    return doCommand(static_cast<Command>(info.commandID));
}

void EditorView::selectAll()
{
    const auto clip = session.clip();
    Selection all;
    const auto* curve = dynamic_cast<const CurveLane*>(juce::Component::getCurrentlyFocusedComponent());
    if (curve != nullptr)
        all = withPoints({}, curve->lane(), allIndices(curveOf(*clip, curve->lane())->size()));
    else
        all.transients = allIndices(clip->transients.size());
    session.select(std::move(all));
}

void EditorView::playCommand(Command command)
{
    const auto clip = session.clip();
    const double tenth = 0.1 * session.viewWidth() * session.axis().secondsPerPixel;
    const auto range = session.timeRange().value_or(TimeRange{0.0, clip->duration});
    const double here = session.playhead();
    switch (command)
    {
    case playOrPause:
        if (session.isPlaying())
        {
            session.stop();
            session.setPlayhead(here);
        }
        else
            session.play();
        break;
    case toStart:
        session.setPlayhead(0.0);
        break;
    case toEnd:
        session.setPlayhead(clip->duration);
        break;
    case stepBack:
        session.setPlayhead(here - tenth);
        break;
    case stepForward:
        session.setPlayhead(here + tenth);
        break;
    case rangeFromHere:
        session.setTimeRange(TimeRange{here, range.to > here ? range.to : clip->duration});
        break;
    case rangeToHere:
        session.setTimeRange(TimeRange{range.from < here ? range.from : 0.0, here});
        break;
    default:
        break;
    }
}

bool EditorView::doCommand(Command command)
{
    if (!canDo(command))
        return false;
    const auto clip = session.clip();
    switch (command)
    {
    case newProject:
        whenSaved([this] { session.newProject(); });
        break;
    case openFile:
        choose("Open sounds, clips or a project", false, [this](const juce::File& file) { open({pathOf(file)}); });
        break;
    case openDemo:
        open({demos.front()});
        break;
    case save:
        saveThen({});
        break;
    case saveAs:
        askName({});
        break;
    case exportClips:
        showSheet(std::make_unique<ExportSheet>(session));
        break;
    case quit:
        if (onQuit)
            onQuit();
        break;
    case editor::undo:
        session.undo();
        break;
    case editor::redo:
        session.redo();
        break;
    case editor::cut:
        session.cut();
        break;
    case editor::copy:
        session.copy();
        break;
    case editor::paste:
        session.paste();
        break;
    case editor::deleteSelection:
        session.deleteSelection();
        break;
    case editor::selectAll:
        selectAll();
        break;
    case selectNone:
        session.select({});
        break;
    case fadeIn:
        session.edit("Fade in", FadeEdit{session.scope(), FadeDirection::in, FadeShape::linear});
        break;
    case fadeOut:
        session.edit("Fade out", FadeEdit{session.scope(), FadeDirection::out, FadeShape::linear});
        break;
    case reverse:
        session.edit("Reverse", ReverseEdit{});
        break;
    case trim:
    {
        const auto range = *session.timeRange();
        session.setTimeRange(std::nullopt);
        session.edit("Trim", TrimEdit{range});
        break;
    }
    case duplicateClip:
        session.duplicate();
        break;
    case removeClip:
        session.removeClip();
        break;
    case nextClip:
    {
        const auto& items = session.document().project().clips;
        for (std::size_t i = 0; i < items.size(); ++i)
            if (items[i]->id == session.activeId())
            {
                session.show(items[(i + 1) % items.size()]->id);
                break;
            }
        break;
    }
    case loop:
        session.setLooping(!session.isLooping());
        break;
    case hearHaptic:
        session.setHeard(Heard::haptic);
        break;
    case hearSound:
        session.setHeard(Heard::sound);
        break;
    case hearBoth:
        session.setHeard(Heard::both);
        break;
    case zoomIn:
        clipPart.zoomAtPlayhead(1.5);
        break;
    case zoomOut:
        clipPart.zoomAtPlayhead(1.0 / 1.5);
        break;
    case editor::fit:
        session.fit();
        break;
    case zoomToRange:
        session.showRange(session.timeRange().value_or(timeOf(session.selected(), *clip).value_or(TimeRange{})));
        break;
    case tallerLanes:
        session.setLaneHeight(session.laneHeight() + 16);
        break;
    case lowerLanes:
        session.setLaneHeight(session.laneHeight() - 16);
        break;
    case decibels:
        session.setAmplitudesInDecibels(!session.amplitudesInDecibels());
        break;
    case lightLook:
        setDark(!look.isDark());
        break;
    case largerInterface:
        setScale(scaleNow + 0.25);
        break;
    case smallerInterface:
        setScale(scaleNow - 0.25);
        break;
    case soundDevices:
        if (onDevices)
            onDevices();
        break;
    case shortcuts:
        showSheet(std::make_unique<ShortcutsSheet>());
        break;
    default:
        playCommand(command);
    }
    commands.commandStatusChanged();
    return true;
}

} // namespace pacini::editor
