#pragma once

// An editor without a screen, and a mouse for it.

#include "editor/clip/EditorView.h"
#include "io/ProfileFile.h"
#include "support/Catch.h"
#include "support/Paths.h"
#include "support/ShippedProfile.h"

#include <array>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>

namespace pacini::test
{

inline std::filesystem::path demoSound(const std::string& name)
{
    return sourceFolder() / "Resources/demo" / (name + ".flac");
}

inline NamedProfile shipped(const std::string& name)
{
    return {name, std::make_shared<const Profile>(shippedProfile(name))};
}

/// The first component of a kind with that title inside another.
template <typename Kind>
Kind* find(juce::Component& inside, const juce::String& title)
{
    for (juce::Component* child : inside.getChildren())
    {
        if (auto* found = dynamic_cast<Kind*>(child); found != nullptr && child->getTitle() == title)
            return found;
        if (auto* found = find<Kind>(*child, title))
            return found;
    }
    return nullptr;
}

template <typename Kind>
Kind& get(juce::Component& inside, const juce::String& title)
{
    auto* found = find<Kind>(inside, title);
    INFO(title);
    REQUIRE(found != nullptr);
    return *found;
}

/// Clicks the button of a sheet that has this text.
inline void answer(juce::Component& sheet, const juce::String& text)
{
    for (juce::Component* child : sheet.getChildren())
        if (auto* button = dynamic_cast<juce::TextButton*>(child); button != nullptr && button->getButtonText() == text)
            return button->onClick();
    FAIL("no button " << text);
}

/// The question in front of a sheet or page, or null.
inline editor::MessageSheet* questionOver(juce::Component& page)
{
    for (juce::Component* child : page.getChildren())
        if (auto* found = dynamic_cast<editor::MessageSheet*>(child))
            return found;
    return nullptr;
}

constexpr Lane envelope{LaneKind::envelope, 0};

/// The commands that open a sheet.
inline constexpr auto sheetCommands =
    std::to_array<std::pair<const char*, editor::Command>>({{"export", editor::exportClips},
                                                            {"shortcuts", editor::shortcuts},
                                                            {"preferences", editor::preferences},
                                                            {"gain", editor::changeGain},
                                                            {"quantise", editor::quantise},
                                                            {"humanise", editor::humanise},
                                                            {"thin out", editor::thinOut},
                                                            {"transpose", editor::transposePitch},
                                                            {"stretch", editor::stretch},
                                                            {"repeat", editor::repeatClipTimes},
                                                            {"feel as on", editor::feelAlike},
                                                            {"measure", editor::measureActuator},
                                                            {"new study", editor::newStudy},
                                                            {"scene", editor::editScene},
                                                            {"palette", editor::searchCommands},
                                                            {"comparison", editor::compareWithTheSound},
                                                            {"manual", editor::manual},
                                                            {"about", editor::about}});

/// A session with one clip in a window of 1280 x 800.
struct EditorBench
{
    juce::ScopedJuceInitialiser_GUI gui;
    editor::Session session;
    editor::EditorView view{session, {}};

    explicit EditorBench(std::vector<NamedProfile> profiles = {}) : session({}, std::move(profiles))
    {
        view.setBounds(0, 0, 1280, 800);
    }

    void openDemo(const std::string& name)
    {
        EncoderParams bands; // a clip with something in every lane
        bands.audible = 0.0;
        auto imported = editor::importFile(demoSound(name), bands);
        REQUIRE(imported.ok());
        session.sounds.add(std::move(imported).value());
    }

    [[nodiscard]] Clip clip() const { return *session.model.clip(); }
    [[nodiscard]] editor::PlotLane& row(Lane lane)
    {
        auto* found = view.clipView().rowOf(lane);
        REQUIRE(found != nullptr);
        return *found;
    }
};

/// Lets the message thread run until something holds. Once for each JUCE.
class Waiting final : private juce::Timer
{
public:
    bool until(std::function<bool()> wanted)
    {
        condition = std::move(wanted);
        startTimer(5);
        juce::MessageManager::getInstance()->runDispatchLoop();
        return condition();
    }

private:
    void timerCallback() override
    {
        if (condition() || ++calls > 4000)
        {
            stopTimer();
            juce::MessageManager::getInstance()->stopDispatchLoop();
        }
    }
    std::function<bool()> condition;
    int calls = 0;
};

/// One gesture with the left button.
class Mouse
{
public:
    explicit Mouse(juce::Component& wanted, int flags = 0)
        : component(wanted), modifiers(flags | juce::ModifierKeys::leftButtonModifier)
    {
    }

    void press(juce::Point<float> where, int clicks = 1)
    {
        start = where;
        component.mouseDown(at(where, clicks, false));
    }
    void drag(juce::Point<float> to) { component.mouseDrag(at(to, 1, true)); }
    void release(juce::Point<float> where) { component.mouseUp(at(where, 1, where != start)); }
    void move(juce::Point<float> where) { component.mouseMove(at(where, 0, false)); }
    void doubleClick(juce::Point<float> where)
    {
        press(where);
        release(where);
        press(where, 2);
        component.mouseDoubleClick(at(where, 2, false));
        release(where);
    }
    void dragFromTo(juce::Point<float> from, juce::Point<float> to, int steps = 5)
    {
        press(from);
        for (int i = 1; i <= steps; ++i)
            drag(from + (to - from) * (static_cast<float>(i) / static_cast<float>(steps)));
        release(to);
    }

private:
    [[nodiscard]] juce::MouseEvent at(juce::Point<float> where, int clicks, bool dragged) const
    {
        const auto now = juce::Time::getCurrentTime();
        return {juce::Desktop::getInstance().getMainMouseSource(),
                where,
                modifiers,
                1.0f,
                0.0f,
                0.0f,
                0.0f,
                0.0f,
                &component,
                &component,
                now,
                start,
                now,
                clicks,
                dragged};
    }

    juce::Component& component;
    juce::ModifierKeys modifiers;
    juce::Point<float> start;
};

/// Where a point of a curve lies in its row, on the scale of 60 dB that levels have.
inline juce::Point<float> placeOf(const editor::PlotLane& row, const editor::Session& session, Breakpoint p)
{
    const auto plot = row.plotArea();
    const double decibels = p.value > 0.0 ? std::max(-60.0, 20.0 * std::log10(p.value)) : -60.0;
    return {static_cast<float>(plot.getX() +
                               (p.time - session.viewState.axis().start) / session.viewState.axis().secondsPerPixel),
            static_cast<float>(plot.getY() - plot.getHeight() * decibels / 60.0)};
}

} // namespace pacini::test
