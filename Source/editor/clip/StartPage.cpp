// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/StartPage.h"

#include "editor/Controls.h"
#include "editor/Text.h"
#include "editor/Theme.h"
#include "editor/Translation.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace pacini::editor
{

namespace
{
constexpr std::size_t maxRecent = 5;
constexpr int startRowHeight = 4 * grid;
constexpr int tileHeight = 7 * grid;
constexpr int tallestTile = 12 * grid;
constexpr int tileWidth = 200; // at least
constexpr int leftWidth = 34 * grid;
constexpr int dropHeight = 19 * grid, lowDropHeight = 15 * grid;
constexpr int roomForAll = 56 * grid;
constexpr int signWidth = 4 * grid; // of a tile: a click there plays it
constexpr int hoverDelay = 250;     // ms

/// A sound that comes with the program: its file in Resources/library or Resources/demo without the ending, and words
/// to find it by.
struct LibraryEntry
{
    std::string_view file;
    const char* name;
    const char* tags;
};

constexpr std::array<LibraryEntry, 18> library{{
    {"ui_click", "UI click", "interface, button, tap"},
    {"notification", "Notification", "interface, message, bell"},
    {"heartbeat", "Heartbeat", "body, pulse, slow"},
    {"footsteps", "Footsteps", "walk, ground, gravel"},
    {"weapon", "Weapon", "shot, gun, recoil"},
    {"explosion", "Explosion", "blast, debris, rumble"},
    {"engine_loop", "Engine loop", "motor, car, loop"},
    {"rain", "Rain", "weather, water, drops"},
    {"texture", "Texture", "surface, friction, rough"},
    {"music_bed", "Music bed", "music, beat, bass"},
    {"click_clock", "Clock", "recording, ticks, mechanism"},
    {"drums_tabla_pattern", "Tabla", "recording, drums, rhythm"},
    {"impact_boom", "Boom", "recording, impact, low"},
    {"iter_drum_roll", "Drum roll", "recording, drum, repeated"},
    {"knock_wood_bridge", "Knocks on wood", "recording, wood, hits"},
    {"pluck_guitar_harmonics", "Guitar harmonics", "recording, strings, plucked"},
    {"sweep_spring_up", "Spring", "recording, rising, metal"},
    {"texture_river", "River", "recording, water, flow"},
}};

/// A target for clips: a name and its profile.
struct FeltByChoice
{
    const char* name;
    const char* help;
    const char* profile;
};

constexpr std::array<FeltByChoice, 4> feltByChoices{{
    {"Just listen", "New sounds are not fitted to an actuator", ""},
    {"Phone", "New sounds are fitted to a phone's actuator", "phone-taptic"},
    {"Wristband", "New sounds are fitted to a wristband's actuator", "l5-wristband"},
    {"Game controller", "New sounds are fitted to a game controller's actuators", "dualsense-voice-coil"},
}};
} // namespace

/// A sound that comes with the program: a click opens it, the pointer or the space bar plays it.
class StartPage::Tile final : public juce::Button, private juce::Timer
{
public:
    Tile(FilePreview& playing, std::filesystem::path sound, const juce::String& title, const juce::String& found,
         const juce::Button& byHover)
        : juce::Button(title), preview(playing), file(std::move(sound)), tags(found), hover(byHover)
    {
        setTitle(title);
        setDescription(tags);
        setTooltip(tr("Click: opens it; triangle or Space: plays it"));
        setWantsKeyboardFocus(true);
    }

    [[nodiscard]] bool fits(const juce::StringArray& wanted, const juce::String& english) const
    {
        const juce::String all = getTitle() + " " + tags + " " + english;
        return std::all_of(wanted.begin(), wanted.end(),
                           [&](const juce::String& word) { return all.containsIgnoreCase(word); });
    }

    void paintButton(juce::Graphics& g, bool over, bool down) override
    {
        const Palette& p = paletteFor(*this);
        const auto area = getLocalBounds().toFloat().reduced(1.0f);
        const bool plays = preview.file() == file;
        g.setColour(down ? p.line : p.well);
        g.fillRoundedRectangle(area, 6.0f);
        g.setColour(plays ? p.accent : over ? p.dim : p.line);
        g.drawRoundedRectangle(area, 6.0f, plays ? 2.0f : 1.0f);
        auto inner = getLocalBounds().reduced(grid, 0).withSizeKeepingCentre(getWidth() - 2 * grid, tileHeight - grid);
        auto symbol = inner.removeFromLeft(2 * grid).toFloat().withSizeKeepingCentre(10.0f, 12.0f);
        g.setColour(plays ? p.accent : p.dim);
        juce::Path shape;
        if (plays)
            shape.addRectangle(symbol.withSizeKeepingCentre(10.0f, 10.0f));
        else
            shape.addTriangle(symbol.getTopLeft(), symbol.getBottomLeft(), {symbol.getRight(), symbol.getCentreY()});
        g.fillPath(shape);
        inner.removeFromLeft(grid);
        g.setColour(p.text);
        g.setFont(usualFont());
        g.drawText(getTitle(), inner.removeFromTop(inner.getHeight() / 2), juce::Justification::bottomLeft, true);
        g.setColour(p.dim);
        g.setFont(smallFont());
        g.drawText(tags, inner, juce::Justification::topLeft, true);
        drawFocusRing(g, *this, getLocalBounds().toFloat());
    }

    const std::filesystem::path& sound() const noexcept { return file; }

private:
    void mouseEnter(const juce::MouseEvent& event) override
    {
        juce::Button::mouseEnter(event);
        if (hover.getToggleState())
            startTimer(hoverDelay);
    }
    void mouseExit(const juce::MouseEvent& event) override
    {
        juce::Button::mouseExit(event);
        stopTimer();
        if (hover.getToggleState() && preview.file() == file)
            preview.stop();
    }
    bool keyPressed(const juce::KeyPress& key) override
    {
        if (key != juce::KeyPress::spaceKey)
            return juce::Button::keyPressed(key);
        hear();
        return true;
    }
    void mouseDown(const juce::MouseEvent& event) override
    {
        if (event.x < signWidth)
            hear();
        else
            juce::Button::mouseDown(event);
    }
    void mouseUp(const juce::MouseEvent& event) override
    {
        if (event.getMouseDownX() >= signWidth)
            juce::Button::mouseUp(event);
    }
    void hear() { preview.file() == file ? preview.stop() : preview.play(file); }

    void timerCallback() override
    {
        stopTimer();
        if (isShowing())
            preview.play(file);
    }

    FilePreview& preview;
    const std::filesystem::path file;
    const juce::String tags;
    const juce::Button& hover;
};

StartPage::StartPage(EditorModel& project, Actuators& profiles, FilePreview& playing,
                     const std::vector<std::filesystem::path>& sounds)
    : model(project),
      actuators(profiles),
      preview(playing),
      openButton(toText("Open…")),
      outputsButton(toText("Outputs…")),
      hoverButton("Play on hover")
{
    setTitle("Start");
    setFocusContainerType(FocusContainerType::focusContainer);
    for (const FeltByChoice& choice : feltByChoices)
    {
        auto button = std::make_unique<juce::TextButton>(choice.name);
        prepareButton(*button, choice.help, [this, name = choice.profile] { actuators.setUsual(name); });
        button->setTitle(choice.name);
        button->setRadioGroupId(1, juce::dontSendNotification);
        addAndMakeVisible(*button);
        feltBy.push_back(std::move(button));
    }
    makePrimary(openButton);
    prepareButton(openButton, "Opens sounds, clips and projects (Ctrl+O)", [this] { onOpen(); });
    addAndMakeVisible(openButton);
    prepareButton(outputsButton, "Chooses which output plays on which actuator",
                  [this]
                  {
                      if (onOutputs)
                          onOutputs();
                  });
    addAndMakeVisible(outputsButton);
    words.setTitle("Search sounds");
    words.setJustification(juce::Justification::centredLeft);
    words.setFont(usualFont());
    words.setIndents(grid, 0);
    words.showWhenEmpty(tr("Search sounds"));
    words.onTextChange = [this]
    {
        search();
    };
    words.onEscapeKey = [this]
    {
        words.clear();
    };
    addAndMakeVisible(words);
    hoverButton.setTitle("Play on hover");
    hoverButton.setClickingTogglesState(true);
    prepareButton(hoverButton, "Plays sounds under the pointer", [this] { preview.stop(); });
    addAndMakeVisible(hoverButton);
    viewport.setViewedComponent(&tileArea, false);
    viewport.setScrollBarsShown(true, false);
    viewport.setWantsKeyboardFocus(false);
    addAndMakeVisible(viewport);
    const auto add = [this](const std::filesystem::path& file, const juce::String& name, const juce::String& tags)
    {
        auto tile = std::make_unique<Tile>(preview, file, name, tags, hoverButton);
        tile->onClick = [this, file]
        {
            preview.stop();
            onFile(file);
        };
        tileArea.addAndMakeVisible(*tile);
        tiles.push_back(std::move(tile));
    };
    const auto entryOf = [](const std::filesystem::path& file)
    {
        return std::find_if(library.begin(), library.end(),
                            [&](const LibraryEntry& entry) { return file.stem() == entry.file; });
    };
    for (const LibraryEntry& entry : library)
        for (const auto& file : sounds)
            if (file.stem() == entry.file)
                add(file, tr(entry.name), tr(entry.tags));
    for (const auto& file : sounds)
        if (entryOf(file) == library.end())
            add(file, pathText(file.stem()).replaceCharacter('_', ' '), tr("recording"));
    for (juce::Component* part : std::initializer_list<juce::Component*>{&words, &hoverButton, &viewport})
        part->setVisible(!tiles.empty());
    subscriptions.on({&model.projectChanged}, [this] { fillRecent(); });
    subscriptions.on({&actuators.usualChanged}, [this] { followActuator(); });
    subscriptions.on({&preview.changed}, [this] { tileArea.repaint(); });
    followActuator();
    fillRecent();
}

StartPage::~StartPage() = default;

void StartPage::followActuator()
{
    for (std::size_t i = 0; i < feltBy.size(); ++i)
        feltBy[i]->setToggleState(actuators.usual() == feltByChoices[i].profile, juce::dontSendNotification);
}

void StartPage::visibilityChanged()
{
    constexpr int poll = 1000;                    // ms
    isVisible() ? startTimer(poll) : stopTimer(); // who looks may be told later
}

void StartPage::timerCallback()
{
    findDevices();
}

void StartPage::findDevices()
{
    if (!foundDevices)
        return;
    auto now = foundDevices();
    const bool same = std::equal(now.begin(), now.end(), devices.begin(), devices.end(),
                                 [](const FoundDevice& a, const FoundDevice& b) { return a.name == b.name; });
    devices = std::move(now);
    if (!same)
    {
        found.clear();
        for (std::size_t i = 0; i < devices.size(); ++i)
        {
            auto button = std::make_unique<juce::TextButton>(tr("{0} (connected)", {devices[i].name}));
            button->setTitle(button->getButtonText());
            prepareButton(*button, "Plays along, and new sounds are fitted to it", [this, i] { chooseDevice(i); });
            addAndMakeVisible(*button);
            found.push_back(std::move(button));
        }
        resized();
        repaint();
    }
    for (std::size_t i = 0; i < found.size(); ++i)
        found[i]->setToggleState(devices[i].chosen, juce::dontSendNotification);
}

void StartPage::chooseDevice(std::size_t index)
{
    if (const auto done = devices[index].choose(); !done)
        return model.report(tr("{0} not opened", {devices[index].name}).toStdString(), done.error());
    if (!devices[index].profile.empty())
        actuators.setUsual(devices[index].profile);
    findDevices();
}

void StartPage::fillRecent()
{
    recentButtons.clear();
    for (const auto& file : model.recentFiles().files())
        if (recentButtons.size() < maxRecent && RecentFiles::exists(file))
        {
            auto button = std::make_unique<juce::TextButton>(pathText(file.stem()).replaceCharacter('_', ' '));
            prepareButton(*button, tr("Opens the project {0}", {pathText(file)}), [this, file] { onFile(file); });
            addAndMakeVisible(*button);
            recentButtons.push_back(std::move(button));
        }
    resized();
    repaint();
}

void StartPage::search()
{
    const auto parts = juce::StringArray::fromTokens(words.getText(), " ", {});
    for (const auto& tile : tiles)
    {
        juce::String english = pathText(tile->sound().stem());
        for (const LibraryEntry& entry : library)
            if (tile->sound().stem() == entry.file)
                english << " " << entry.name << " " << entry.tags;
        tile->setVisible(tile->fits(parts, english));
    }
    const bool any = std::any_of(tiles.begin(), tiles.end(), [](const auto& tile) { return tile->isVisible(); });
    nothingFound = any ? juce::String() : tr("No sound fits: {0}", {words.getText()});
    layOutTiles();
    repaint();
}

juce::StringArray StartPage::shownSounds() const
{
    juce::StringArray names;
    for (const auto& tile : tiles)
        if (tile->isVisible())
            names.add(tile->getTitle());
    return names;
}

void StartPage::setDropping(bool dropping)
{
    dropNow = dropping;
    repaint();
}

juce::Rectangle<int> StartPage::left() const
{
    auto area = getLocalBounds().reduced(3 * grid, 3 * grid);
    return tiles.empty() ? area.withSizeKeepingCentre(leftWidth, area.getHeight()) : area.removeFromLeft(leftWidth);
}

juce::Rectangle<int> StartPage::dropArea() const
{
    auto area = left();
    return area.withHeight(area.getHeight() < roomForAll ? lowDropHeight : dropHeight);
}

juce::Rectangle<int> StartPage::right() const
{
    return getLocalBounds().reduced(3 * grid, 3 * grid).withTrimmedLeft(leftWidth + 4 * grid);
}

void StartPage::paint(juce::Graphics& g)
{
    const Palette& p = paletteFor(*this);
    g.fillAll(p.background);
    const auto heading = [&](const juce::Component& above, const juce::String& text)
    {
        g.setColour(p.text);
        g.setFont(usualFont().boldened());
        g.drawText(text,
                   above.getBounds().withWidth(leftWidth).withHeight(3 * grid).translated(0, -3 * grid - grid / 2),
                   juce::Justification::centredLeft);
    };
    heading(*feltBy.front(), tr("What will feel it?"));
    if (!recentButtons.empty() && recentButtons.front()->isVisible())
        heading(*recentButtons.front(), tr("Recent projects"));

    const auto drop = dropArea();
    g.setColour(dropNow ? p.accent.withAlpha(0.15f) : p.card);
    g.fillRoundedRectangle(drop.toFloat(), 10.0f);
    juce::Path outline, dashes;
    outline.addRoundedRectangle(drop.toFloat().reduced(1.0f), 10.0f);
    const float lengths[] = {8.0f, 6.0f};
    juce::PathStrokeType(1.5f).createDashedStroke(dashes, outline, lengths, 2);
    g.setColour(dropNow ? p.accent : p.line);
    g.fillPath(dashes);
    auto text = drop.reduced(2 * grid).withTrimmedBottom(startRowHeight);
    if (drop.getHeight() < dropHeight)
        text.translate(0, -grid);
    g.setColour(p.text);
    const auto invitation = tr("Drop a sound or a clip here");
    g.setFont(fittingFont(invitation, text.getWidth(), {titleFont(), usualFont().boldened()}));
    g.drawFittedText(invitation, text.removeFromTop(4 * grid), juce::Justification::centred, 1);
    g.setColour(p.dim);
    g.setFont(smallFont());
    g.drawFittedText(tr("It becomes curves and events to shape, feel and export."), text.removeFromTop(4 * grid),
                     juce::Justification::centred, 2, 1.0f);
    if (tiles.empty())
        return;
    const auto head = right().removeFromTop(4 * grid).withRight(words.getX() - grid);
    g.setColour(p.text);
    g.setFont(usualFont().boldened());
    g.drawText(tr("Or begin with one of these"), head, juce::Justification::centredLeft);
    if (nothingFound.isNotEmpty())
    {
        g.setColour(p.dim);
        g.setFont(usualFont());
        g.drawText(nothingFound, right().withTrimmedTop(6 * grid).removeFromTop(4 * grid),
                   juce::Justification::centredLeft);
    }
}

void StartPage::resized()
{
    auto area = left();
    openButton.setBounds(dropArea().reduced(2 * grid).removeFromBottom(startRowHeight));
    area.removeFromTop(dropArea().getHeight() + (area.getHeight() < roomForAll ? 4 : 6) * grid);
    // In a low window, what has no room is left out, the list of all outputs last.
    const auto place = [&area](juce::Component& button, int below)
    {
        const bool fits = area.getHeight() >= startRowHeight + below;
        button.setVisible(fits);
        button.setBounds(fits ? area.removeFromTop(startRowHeight) : juce::Rectangle<int>());
        area.removeFromTop(fits ? grid / 2 : 0);
    };
    constexpr int roomForOutputs = startRowHeight + 3 * grid / 2;
    for (const auto& button : feltBy)
        place(*button, roomForOutputs);
    for (const auto& button : found)
        place(*button, roomForOutputs);
    area.removeFromTop(grid); // it is no choice of these
    place(outputsButton, 0);
    area.removeFromTop(9 * grid / 2);
    for (const auto& button : recentButtons)
        place(*button, 0);
    auto beside = right();
    auto head = beside.removeFromTop(4 * grid);
    hoverButton.setBounds(head.removeFromRight(15 * grid));
    head.removeFromRight(grid);
    const int heading = usualFont().boldened().getStringWidth(tr("Or begin with one of these")) + 2 * grid;
    words.setBounds(head.removeFromRight(std::clamp(head.getWidth() - heading, 10 * grid, 30 * grid)));
    beside.removeFromTop(grid);
    viewport.setBounds(beside);
    layOutTiles();
}

void StartPage::layOutTiles()
{
    const auto columnsIn = [](int room)
    {
        return std::max(1, room / (tileWidth + grid));
    };
    // Room for the scroll bar only where there is one: else the tiles end where the head above them does.
    const int fewest = columnsIn(viewport.getWidth());
    const int lowest = (static_cast<int>(tiles.size()) + fewest - 1) / fewest * (tileHeight + grid);
    const bool scrolls = lowest > viewport.getHeight();
    const int width = viewport.getWidth() - (scrolls ? viewport.getScrollBarThickness() : 0);
    const int columns = columnsIn(width);
    const int each = (width - (columns - 1) * grid) / columns;
    // In a tall window all tiles together fill it, up to a height.
    const auto shown =
        static_cast<int>(std::count_if(tiles.begin(), tiles.end(), [](const auto& tile) { return tile->isVisible(); }));
    const int rows = std::max(1, (static_cast<int>(tiles.size()) + columns - 1) / columns);
    const int high = std::clamp(viewport.getHeight() / rows - grid, tileHeight, tallestTile);
    int i = 0;
    for (const auto& tile : tiles)
        if (tile->isVisible())
        {
            tile->setBounds(i % columns * (each + grid), i / columns * (high + grid), each, high);
            ++i;
        }
    tileArea.setSize(width, (shown + columns - 1) / columns * (high + grid));
}

} // namespace pacini::editor
