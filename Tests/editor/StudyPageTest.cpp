// A study's pages by a game controller: what its buttons mean on each.

#include "editor/study/StudyPage.h"

#include "editor/Bench.h"
#include "editor/Pump.h"
#include "editor/Translation.h"
#include "study/StudyTemplates.h"
#include "support/TempFolder.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <string>
#include <utility>
#include <vector>

using namespace pacini;
using namespace pacini::test;

namespace
{
/// Plays at once, to the end.
class InstantDevice final : public study::TrialPlayer
{
public:
    [[nodiscard]] int sampleRate() const override { return 48000; }
    void play(study::TrialSound) override
    {
        ++plays;
        last = {};
        last.complete = true;
        last.dropouts = dropouts;
    }
    void stop() override { ++stops; }
    [[nodiscard]] study::PlaybackReport report() const override { return last; }
    int plays = 0, stops = 0;
    int dropouts = 0; ///< in each trial

private:
    study::PlaybackReport last;
};

study::Study twoTones()
{
    study::Study study;
    study.name = "tones";
    study.groups = {{"all", 1}};
    for (const char* name : {"weak", "strong"})
    {
        study::Stimulus tone;
        tone.name = name;
        tone.tone = study::Tone{160.0, 0.2, 0.05, name == std::string("weak") ? -12.0 : -3.0};
        study.stimuli.push_back(tone);
    }
    study::Block block;
    block.name = "rated";
    block.question = {{"en", "How strong?"}};
    study.blocks = {block};
    study.welcome = {{"en", "Hello"}};
    study.consent = {{"en", "Is that fine?"}};
    return study;
}

juce::Slider* sliderIn(juce::Component& within)
{
    for (auto* child : within.getChildren())
    {
        if (auto* slider = dynamic_cast<juce::Slider*>(child); slider != nullptr)
            return slider;
        if (auto* deeper = sliderIn(*child); deeper != nullptr)
            return deeper;
    }
    return nullptr;
}

editor::LargeButton* buttonNamed(juce::Component& page, const juce::String& text)
{
    for (auto* child : page.getChildren())
        if (auto* button = dynamic_cast<editor::LargeButton*>(child);
            button != nullptr && button->getButtonText() == text)
            return button;
    return nullptr;
}

void agree(juce::Component& page)
{
    auto* button = buttonNamed(page, "I agree");
    REQUIRE(button != nullptr);
    button->triggerClick();
}
} // namespace

TEST_CASE("No key that goes on elsewhere agrees, or finds comfortable what was not felt")
{
    const TempFolder folder;
    InstantDevice device;
    editor::StudyServices services;
    services.player = &device;
    study::Study study = twoTones();
    study.comfort = {"strong"};
    editor::StudyPage page({study, folder.path()}, services);
    page.setSize(960, 720);
    using State = editor::StudyPage::State;
    const auto goOn = [&]
    {
        for (int i = 0; i < 3; ++i)
        {
            page.keyPressed(juce::KeyPress(juce::KeyPress::returnKey));
            page.keyPressed(juce::KeyPress(juce::KeyPress::spaceKey));
            page.control(editor::Control::next);
            pumpFor(0.05);
        }
    };
    page.control(editor::Control::next);
    REQUIRE(pumpUntil([&] { return page.state() == State::welcome; }));
    goOn();
    REQUIRE(page.state() == State::consent);
    CHECK(page.run()->session().head().consent.empty());
    agree(page);
    REQUIRE(pumpUntil([&] { return page.state() == State::comfort; }));
    page.keyPressed(juce::KeyPress(juce::KeyPress::returnKey));
    page.control(editor::Control::next);
    pumpFor(0.1);
    CHECK(page.state() == State::comfort);
    CHECK(device.plays == 0);
    page.control(editor::Control::play);
    REQUIRE(pumpUntil([&] { return device.plays == 1; }));
    page.control(editor::Control::next);
    CHECK(pumpUntil([&] { return page.state() == State::trial; }));
}

TEST_CASE("A game controller goes through a study from its welcome to its end")
{
    const TempFolder folder;
    InstantDevice device;
    editor::StudyServices services;
    services.player = &device;
    editor::StudyPage page({twoTones(), folder.path()}, services);
    page.setSize(960, 720);
    using State = editor::StudyPage::State;
    const auto goesTo = [&](editor::Control control, State wanted)
    {
        page.control(control);
        return pumpUntil([&] { return page.state() == wanted; });
    };
    REQUIRE(page.state() == State::setUp);
    REQUIRE(goesTo(editor::Control::next, State::welcome));
    REQUIRE(goesTo(editor::Control::next, State::consent));
    agree(page);
    REQUIRE(pumpUntil([&] { return page.state() == State::trial; }));
    // Nothing is answered before it was felt.
    page.control(editor::Control::next);
    pumpFor(0.1);
    CHECK(page.run()->session().answered() == 0);
    page.control(editor::Control::play);
    REQUIRE(pumpUntil([&] { return device.plays == 1 && page.run()->canAnswer(); }));
    page.control(editor::Control::next);
    pumpFor(0.1);
    CHECK(page.run()->session().answered() == 0); // nor without an answer
    auto* slider = sliderIn(page);
    REQUIRE(slider != nullptr);
    REQUIRE(slider->keyPressed(juce::KeyPress(juce::KeyPress::rightKey)));
    REQUIRE(pumpUntil(
        [&]
        {
            page.control(editor::Control::next);
            return page.run()->session().answered() == 1;
        }));
    // The second is stopped, and goes on.
    const int stopped = device.stops;
    REQUIRE(goesTo(editor::Control::stop, State::stopped));
    CHECK(device.stops > stopped);
    REQUIRE(goesTo(editor::Control::next, State::trial));
    pumpFor(0.6); // it may play by itself
    page.control(editor::Control::play);
    REQUIRE(pumpUntil([&] { return page.run()->canAnswer(); }));
    REQUIRE(sliderIn(page)->keyPressed(juce::KeyPress(juce::KeyPress::leftKey)));
    REQUIRE(pumpUntil(
        [&]
        {
            if (page.state() == State::trial)
                page.control(editor::Control::next);
            return page.state() == State::goodbye;
        }));
    // Without anything focused, directions do no harm on any page.
    for (const auto control :
         {editor::Control::left, editor::Control::right, editor::Control::up, editor::Control::down})
        page.control(control);
    CHECK(page.state() == State::goodbye);
}

TEST_CASE("The set-up tells how many of the planned participants there were, and a trial that is repeated says why")
{
    const TempFolder folder;
    InstantDevice device;
    editor::StudyServices services;
    services.player = &device;
    study::Study study = twoTones();
    study.consent = {};
    study.groups = {{"all", 12}};
    editor::StudyPage page({study, folder.path()}, services);
    page.setSize(960, 720);
    using State = editor::StudyPage::State;
    const auto texts = [&page]
    {
        juce::String all;
        for (auto* child : page.getChildren())
            if (const auto* shown = dynamic_cast<editor::Paragraph*>(child))
                all << shown->text() << "\n";
        return all;
    };
    CHECK(texts().contains("Participants so far: 0 of 12."));
    page.control(editor::Control::next);
    REQUIRE(pumpUntil([&] { return page.state() == State::welcome; }));
    page.control(editor::Control::next);
    REQUIRE(pumpUntil([&] { return page.state() == State::trial; }));
    const juce::String told = "had a gap, so this one comes once more";
    const auto answerOne = [&](int gaps)
    {
        device.dropouts = gaps;
        page.control(editor::Control::play);
        REQUIRE(pumpUntil([&] { return page.run()->canAnswer(); }));
        REQUIRE(sliderIn(page)->keyPressed(juce::KeyPress(juce::KeyPress::rightKey)));
        const auto before = page.run()->session().answered();
        REQUIRE(pumpUntil(
            [&]
            {
                page.control(editor::Control::next);
                return page.run()->session().answered() > before;
            }));
    };
    const auto* const first = page.run()->trial();
    answerOne(2);
    CHECK(page.run()->trial() == first);
    CHECK(texts().contains(told));
    answerOne(0);
    CHECK(page.run()->trial() != first);
    CHECK_FALSE(texts().contains(told));
    const editor::StudyPage another({study, folder.path()}, services);
    juce::String setUp;
    for (auto* child : another.getChildren())
        if (const auto* shown = dynamic_cast<editor::Paragraph*>(child))
            setUp << shown->text();
    CHECK(setUp.contains("Participants so far: 1 of 12."));
}

namespace
{
/// What can be seen of a page, without what is said below now and then.
juce::Rectangle<int> seenOn(const editor::StudyPage& page)
{
    juce::Rectangle<int> all;
    for (auto* child : page.getChildren())
    {
        const auto* text = dynamic_cast<const editor::Paragraph*>(child);
        if (child->isVisible() && (text == nullptr || text->text().isNotEmpty()))
            all = all.isEmpty() ? child->getBoundsInParent() : all.getUnion(child->getBoundsInParent());
    }
    return all;
}

/// The buttons that look like the one to press.
juce::StringArray primaryOn(const editor::StudyPage& page)
{
    juce::StringArray names;
    for (auto* child : page.getChildren())
        if (auto* button = dynamic_cast<editor::LargeButton*>(child);
            button != nullptr && button->isEnabled() && button->getProperties().contains("primary"))
            names.add(button->getButtonText());
    return names;
}
} // namespace

TEST_CASE("A study's page stands in the middle of any window, with one button to press at a time")
{
    const TempFolder folder;
    InstantDevice device;
    editor::StudyServices services;
    services.player = &device;
    study::Study study = twoTones();
    study.consent = {};
    editor::StudyPage page({study, folder.path()}, services);
    using State = editor::StudyPage::State;
    const auto checkPlace = [&]
    {
        for (const auto& [width, height] :
             {std::pair(640, 520), std::pair(1280, 800), std::pair(1920, 1080), std::pair(3840, 2160)})
        {
            CAPTURE(width, height);
            page.setSize(width, height);
            const auto all = seenOn(page);
            CHECK(page.getLocalBounds().contains(all));
            CHECK(std::abs(all.getCentreX() - width / 2) <= 2);
            const double room = height - all.getHeight();
            CHECK(all.getY() > 0.25 * room);
            CHECK(all.getY() <= 0.5 * room);
            // Large windows have large letters, not small ones in a void.
            CHECK(all.getWidth() >= std::min(width, 2 * height) / 3);
        }
    };
    checkPlace();
    CHECK(primaryOn(page) == juce::StringArray{"New participant"});
    page.control(editor::Control::next);
    REQUIRE(pumpUntil([&] { return page.state() == State::welcome; }));
    checkPlace();
    CHECK(primaryOn(page) == juce::StringArray{"Continue"});
    page.control(editor::Control::next);
    REQUIRE(pumpUntil([&] { return page.state() == State::trial; }));
    checkPlace();
    CHECK(primaryOn(page) == juce::StringArray{"Play (space)"});
    page.control(editor::Control::play);
    REQUIRE(pumpUntil([&] { return page.run()->canAnswer(); }));
    REQUIRE(sliderIn(page)->keyPressed(juce::KeyPress(juce::KeyPress::rightKey)));
    REQUIRE(pumpUntil([&] { return primaryOn(page) == juce::StringArray{"Next"}; }));
}

// For somebody who looks at all of them: PACINI_LOOK=folder build/release/bin/pacini_editor_tests "[look-study]"
TEST_CASE("Pictures of a study's pages in three sizes and two languages", "[.look-study]")
{
    const char* const wanted = std::getenv("PACINI_LOOK");
    REQUIRE(wanted != nullptr);
    const juce::File to(wanted);
    REQUIRE(to.createDirectory());
    const juce::ScopedJuceInitialiser_GUI gui;
    using State = editor::StudyPage::State;
    for (const char* language : {"en", "de"})
        for (const auto& [width, height] : {std::pair(1280, 800), std::pair(1920, 1080), std::pair(640, 520)})
            for (const auto& one : study::studyTemplates())
            {
                editor::useLanguage(language);
                const TempFolder folder;
                InstantDevice device;
                editor::StudyServices services;
                services.player = &device;
                services.outputNames = []
                {
                    return juce::StringArray{"1", "2", "3", "4"};
                };
                services.wire = [](int, int, int) {
                };
                std::vector<std::string> sounds;
                for (const char* name : {"knock_wood_bridge", "impact_boom", "click_clock", "texture_river"})
                    if (one.mostSounds > 0)
                        sounds.push_back(demoSound(name).string());
                auto study = study::makeStudy(one.name, sounds);
                REQUIRE(study);
                editor::StudyPage page({*study, folder.path()}, services);
                page.setSize(width, height);
                const auto keep = [&](const juce::String& name)
                {
                    pumpFor(0.1);
                    const auto file = to.getChildFile("study-" + juce::String(one.name.data()) + "-" + name + "-" +
                                                      language + "-" + juce::String(width) + ".png");
                    file.deleteFile();
                    juce::FileOutputStream out(file);
                    REQUIRE(juce::PNGImageFormat().writeImageToStream(
                        page.createComponentSnapshot(page.getLocalBounds(), true, 1.0f), out));
                };
                const bool all = one.name == "mushra";
                if (all)
                    keep("set-up");
                for (int step = 0; step < 6 && page.state() != State::trial; ++step)
                {
                    const State before = page.state();
                    if (before == State::consent)
                        for (auto* child : page.getChildren())
                        {
                            auto* button = dynamic_cast<editor::LargeButton*>(child);
                            if (button != nullptr && button->getButtonText() == editor::tr("I agree"))
                                button->triggerClick();
                        }
                    if (before == State::comfort)
                        page.control(editor::Control::play);
                    pumpFor(0.1);
                    page.control(editor::Control::next);
                    (void)pumpUntil([&] { return page.state() != before; });
                    if (all && page.state() != State::trial)
                        keep("step-" + juce::String(step));
                }
                keep("trial");
                page.control(editor::Control::play);
                keep("played");
            }
    editor::useLanguage("en");
}
