// The window, without any screen.

#include "editor/CaptureJob.h"
#include "editor/Pump.h"
#include "editor/Tracks.h"
#include "editor/Unmarked.h"
#include "editor/clip/sheets/OperationSheet.h"
#include "io/ClipFile.h"
#include "io/ClipSeal.h"
#include "io/ShippedProfiles.h"
#include "plugin/engine/Rig.h"
#include "plugin/window/PluginWindow.h"
#include "support/TempFolder.h"

#include <pacini/synthesis/Transparency.h>

#include <array>
#include <atomic>
#include <set>
#include <thread>

using namespace pacini;
using namespace pacini::test;
using plugin::ParameterId;

namespace
{
using WindowRig = RigOf<plugin::Plugin>;

/// Distinct colours in a picture of the window: a blank or broken one has few.
std::size_t colours(plugin::PluginWindow& window)
{
    const auto image = window.createComponentSnapshot(window.getLocalBounds());
    std::set<juce::uint32> seen;
    for (int y = 0; y < image.getHeight(); y += 2)
        for (int x = 0; x < image.getWidth(); x += 2)
            seen.insert(image.getPixelAt(x, y).getARGB());
    return seen.size();
}

template <typename Visit>
void forEachChild(juce::Component& parent, Visit&& visit)
{
    for (juce::Component* child : parent.getChildren())
    {
        visit(*child);
        forEachChild(*child, visit);
    }
}

/// The control of this title; null where there is none.
template <typename Control>
Control* titled(juce::Component& window, const char* title)
{
    Control* found = nullptr;
    forEachChild(window,
                 [&](juce::Component& child)
                 {
                     if (auto* control = dynamic_cast<Control*>(&child); control && control->getTitle() == title)
                         found = control;
                 });
    return found;
}
} // namespace

TEST_CASE("The window draws itself, light and dark, small and large, and its meters move with the sound")
{
    const juce::ScopedJuceInitialiser_GUI gui;
    WindowRig rig;
    plugin::PluginWindow window(rig.plugin);
    for (const bool dark : {false, true})
        for (const auto size : {juce::Point<int>(936, 608), juce::Point<int>(2000, 1300)})
        {
            window.setDark(dark);
            window.setSize(size.x, size.y);
            CHECK(colours(window) > 20);
        }
    const auto before = window.createComponentSnapshot(window.getLocalBounds());
    for (int i = 0; i < 10; ++i)
    {
        (void)rig.run(liveSounds(2, 4800, 3));
        window.refresh();
    }
    const auto after = window.createComponentSnapshot(window.getLocalBounds());
    int changed = 0;
    for (int y = 0; y < before.getHeight(); y += 3)
        for (int x = 0; x < before.getWidth(); x += 3)
            changed += before.getPixelAt(x, y) != after.getPixelAt(x, y) ? 1 : 0;
    CHECK(changed > 500);
}

TEST_CASE("Knobs stay between their names and their values, however tall the window is")
{
    const juce::ScopedJuceInitialiser_GUI gui;
    WindowRig rig;
    plugin::PluginWindow window(rig.plugin);
    for (const auto size : {juce::Point<int>(936, 608), juce::Point<int>(1910, 1040), juce::Point<int>(2400, 1600)})
    {
        window.setSize(size.x, size.y);
        int knobs = 0;
        forEachChild(window,
                     [&](juce::Component& child)
                     {
                         auto* slider = dynamic_cast<juce::Slider*>(&child);
                         if (slider == nullptr || slider->getSliderStyle() == juce::Slider::LinearHorizontal)
                             return;
                         ++knobs;
                         auto* owner = slider->getParentComponent();
                         const auto* name = owner->getChildComponent(0);
                         CAPTURE(size.toString(), slider->getTitle());
                         CHECK(slider->getHeight() <= 120);
                         CHECK(slider->getY() == name->getBottom());
                     });
        CHECK(knobs == 13);
    }
}

TEST_CASE("Names of controls are of one size of type, also where one is long in a language")
{
    const juce::ScopedJuceInitialiser_GUI gui;
    WindowRig rig;
    for (const char* language : {"en", "de", "ja"})
    {
        editor::useLanguage(language);
        plugin::PluginWindow window(rig.plugin);
        editor::useLanguage("en");
        for (const auto size : {juce::Point<int>(936, 608), juce::Point<int>(1280, 800)})
        {
            window.setSize(size.x, size.y);
            forEachChild(window,
                         [&](juce::Component& child)
                         {
                             if (dynamic_cast<editor::ParameterSlider*>(&child) == nullptr)
                                 return;
                             const juce::Label* name = nullptr; // which screen readers have from the slider
                             forEachChild(child,
                                          [&](juce::Component& inside)
                                          {
                                              const auto* label = dynamic_cast<juce::Label*>(&inside);
                                              if (label != nullptr && !label->isAccessible())
                                                  name = label;
                                          });
                             REQUIRE(name != nullptr);
                             CAPTURE(language, size.toString(), name->getText());
                             CHECK(name->getFont().getHeight() == editor::smallFont().getHeight());
                         });
        }
    }
}

TEST_CASE("A window is laid out at every size that a host gives it, also none")
{
    const juce::ScopedJuceInitialiser_GUI gui;
    WindowRig rig;
    plugin::PluginWindow window(rig.plugin);
    for (const int width : {0, 1, 7, 40, 150, 400, 936, 5000})
        for (const int height : {0, 1, 30, 200, 608, 3000})
        {
            window.setSize(width, height);
            CHECK(window.getWidth() == width);
        }
}

TEST_CASE("Text that is no value leaves a control as it is, and its text comes back")
{
    const juce::ScopedJuceInitialiser_GUI gui;
    WindowRig rig;
    plugin::PluginWindow window(rig.plugin);
    window.show(plugin::PluginWindow::Page::actuators);
    for (const auto& row : plugin::parameterTable)
        rig.plugin.parameter(row.parameter).setValueNotifyingHost(0.3f);
    window.refresh();
    const auto before = rig.plugin.values();
    std::size_t boxes = 0;
    forEachChild(window,
                 [&](juce::Component& child)
                 {
                     auto* box = dynamic_cast<juce::Label*>(&child);
                     if (box == nullptr || child.findParentComponentOfClass<juce::Slider>() == nullptr ||
                         !box->isAccessible()) // the name above a track
                         return;
                     ++boxes;
                     const auto shown = box->getText();
                     CAPTURE(child.getParentComponent()->getTitle());
                     for (const char* text : {"abc", "1e9", "123456", ""})
                     {
                         box->setText(text, juce::sendNotificationSync);
                         CHECK(box->getText() == shown);
                     }
                 });
    CHECK(boxes > 40);
    CHECK(rig.plugin.values() == before);
}

TEST_CASE("A preset whose values were changed has a mark until they are back")
{
    const juce::ScopedJuceInitialiser_GUI gui;
    WindowRig rig;
    plugin::PluginWindow window(rig.plugin);
    auto* const presets = titled<juce::ComboBox>(window, "Preset");
    REQUIRE(presets != nullptr);
    for (const int program : {0, 2})
    {
        rig.plugin.applyProgram(program);
        window.refresh();
        const auto name = rig.plugin.getProgramName(program);
        CHECK(presets->getText() == name);
        rig.set(ParameterId::profile, 3.0); // which belongs to no preset
        window.refresh();
        CHECK(presets->getText() == name);
        const double before = rig.plugin.values()[ParameterId::attack];
        rig.set(ParameterId::attack, 55.0);
        window.refresh();
        CHECK(presets->getText() == name + " *");
        rig.set(ParameterId::attack, before);
        window.refresh();
        CHECK(presets->getText() == name);
    }
}

TEST_CASE("The page of the actuators shows each haptic channel that there is, and its level")
{
    const juce::ScopedJuceInitialiser_GUI gui;
    RigLayout layout;
    layout.haptic = 3;
    WindowRig rig(layout);
    plugin::PluginWindow window(rig.plugin);
    window.show(plugin::PluginWindow::Page::actuators);
    rig.set(ParameterId::pan, 1.0);
    rig.set(ParameterId::position, 0.0);
    (void)rig.run(liveSounds(2, 24000, 3));
    window.refresh();
    CHECK(colours(window) > 20);
    if (const char* picture = std::getenv("PACINI_PICTURE"))
    {
        window.setSize(1024, 648);
        juce::File file(picture);
        file.deleteFile();
        juce::FileOutputStream stream(file);
        juce::PNGImageFormat().writeImageToStream(window.createComponentSnapshot(window.getLocalBounds()), stream);
    }
    std::set<juce::String> enabled;
    forEachChild(window,
                 [&](juce::Component& child)
                 {
                     if (auto* box = dynamic_cast<juce::ComboBox*>(&child); box && box->isEnabled())
                         enabled.insert(box->getTitle());
                 });
    CHECK(enabled.count("Actuator 2") == 1);
    CHECK(enabled.count("Actuator 3") == 1);
    CHECK(enabled.count("Actuator 4") == 0);
    window.show(plugin::PluginWindow::Page::live);
    CHECK(colours(window) > 20);
}

TEST_CASE("Every control has a name, a help text and a place that the keyboard reaches")
{
    const juce::ScopedJuceInitialiser_GUI gui;
    WindowRig rig;
    plugin::PluginWindow window(rig.plugin);
    std::size_t controls = 0;
    forEachChild(window,
                 [&](juce::Component& child)
                 {
                     const bool slider = dynamic_cast<juce::Slider*>(&child) != nullptr;
                     const bool other = dynamic_cast<juce::Button*>(&child) || dynamic_cast<juce::ComboBox*>(&child);
                     if (!slider && !other)
                         return;
                     const bool inner = child.findParentComponentOfClass<juce::Slider>() != nullptr;
                     if (inner || !child.isVisible() || !child.isEnabled() ||
                         dynamic_cast<juce::ResizableCornerComponent*>(&child))
                         return;
                     ++controls;
                     const auto* button = dynamic_cast<juce::Button*>(&child);
                     CAPTURE(child.getTitle(), button ? button->getButtonText() : juce::String());
                     CHECK((child.getTitle().isNotEmpty() || (button && button->getButtonText().isNotEmpty())));
                     CHECK(dynamic_cast<juce::SettableTooltipClient&>(child).getTooltip().isNotEmpty());
                     CHECK(child.getWantsKeyboardFocus());
                     CHECK(child.getWidth() >= 24);
                     CHECK(child.getHeight() >= 16);
                 });
    CHECK(controls >= 22);
}

TEST_CASE("Brightness can be turned where Audible leaves it something to play")
{
    const juce::ScopedJuceInitialiser_GUI gui;
    WindowRig rig;
    plugin::PluginWindow window(rig.plugin);
    auto* const brightness = titled<juce::Slider>(window, "Brightness");
    REQUIRE(brightness != nullptr);
    CHECK_FALSE(brightness->isEnabled()); // 100 % from the start
    rig.plugin.parameter(ParameterId::audible).setValueNotifyingHost(0.5f);
    CHECK(pumpUntil([&] { return brightness->isEnabled(); }));
    rig.plugin.parameter(ParameterId::audible).setValueNotifyingHost(1.0f);
    CHECK(pumpUntil([&] { return !brightness->isEnabled(); }));
}

TEST_CASE("No text of the window bypasses the tables of translations")
{
    const juce::ScopedJuceInitialiser_GUI gui;
    const test::MarkedLanguage marked;
    WindowRig rig;
    plugin::PluginWindow window(rig.plugin);
    window.show(plugin::PluginWindow::Page::actuators);
    window.refresh();
    juce::StringArray found;
    juce::StringArray names{
        "Pacini", "L5 wristband", "L5 test jig", "LRA",  "Coin ERM", "iPhone (Taptic)",
        "iPhone", "DualSense",    "Joy-Con",     "Main", "Sidechain"}; // names of buses are the same for all hosts
    names.add(rig.plugin.actuatorName());
    test::addUnmarked(window, names, found);
    INFO(found.joinIntoString("\n"));
    CHECK(found.isEmpty());
}

TEST_CASE("No control lies on another one or outside of the window, at any size")
{
    const juce::ScopedJuceInitialiser_GUI gui;
    WindowRig rig;
    plugin::PluginWindow window(rig.plugin);
    for (const auto size : {juce::Point<int>(936, 608), juce::Point<int>(1024, 648), juce::Point<int>(1700, 1100)})
    {
        window.setSize(size.x, size.y);
        std::vector<juce::Component*> placed;
        for (juce::Component* child : window.getChildren())
            if (child->isVisible() && !dynamic_cast<juce::ResizableCornerComponent*>(child) &&
                !dynamic_cast<juce::TooltipWindow*>(child))
                placed.push_back(child);
        for (std::size_t i = 0; i < placed.size(); ++i)
        {
            CAPTURE(size.x, placed[i]->getTitle(), placed[i]->getBounds().toString());
            CHECK_FALSE(placed[i]->getBounds().isEmpty());
            CHECK(window.getLocalBounds().contains(placed[i]->getBounds()));
            for (std::size_t k = 0; k < i; ++k)
            {
                CAPTURE(placed[k]->getTitle(), placed[k]->getBounds().toString());
                CHECK_FALSE(placed[k]->getBounds().intersects(placed[i]->getBounds()));
            }
        }
    }
}

TEST_CASE("Every slider of the window has a track of 80 points, in every language and size")
{
    const juce::ScopedJuceInitialiser_GUI gui;
    juce::StringArray found;
    auto codes = editor::languages();
    codes.insert(0, "en");
    for (const auto& code : codes)
    {
        useTableOf(code);
        WindowRig rig;
        plugin::PluginWindow window(rig.plugin);
        for (const auto size : {juce::Point<int>(936, 608), juce::Point<int>(1024, 648), juce::Point<int>(1280, 800),
                                juce::Point<int>(1920, 1080), juce::Point<int>(2560, 1440)})
        {
            window.setSize(size.x, size.y);
            addShortTracks(window, code + " " + juce::String(size.x), found);
        }
    }
    editor::useLanguage("en");
    INFO(found.joinIntoString("\n"));
    CHECK(found.isEmpty());
}

TEST_CASE("Windows open and close while sound plays on another thread")
{
    const juce::ScopedJuceInitialiser_GUI gui;
    WindowRig rig;
    std::atomic<bool> playing{true};
    std::thread audio(
        [&]
        {
            while (playing)
                (void)rig.run(liveSounds(2, 512, 3));
        });
    for (int i = 0; i < 10; ++i)
    {
        const std::unique_ptr<juce::AudioProcessorEditor> window(rig.plugin.createEditorIfNeeded());
        REQUIRE(window);
        for (int k = 0; k < 5; ++k)
        {
            rig.set(ParameterId::intensity, -i - k);
            dynamic_cast<plugin::PluginWindow&>(*window).refresh();
        }
        rig.plugin.editorBeingDeleted(window.get());
    }
    playing = false;
    audio.join();
}

TEST_CASE("The size of the window is kept")
{
    const juce::ScopedJuceInitialiser_GUI gui;
    WindowRig rig;
    rig.plugin.setWindowSize(1300, 800);
    plugin::PluginWindow window(rig.plugin);
    CHECK(window.getWidth() == 1300);
    CHECK(window.getHeight() == 800);
    window.setSize(1200, 700);
    CHECK(rig.plugin.windowSize() == juce::Point<int>(1200, 700));
}

TEST_CASE("A capture keeps its sound in the session, and is analysed again from it")
{
    const juce::ScopedJuceInitialiser_GUI gui;
    WindowRig rig;
    (void)rig.run(liveSounds(2, 4 * 48000, 3));
    const auto capture = rig.plugin.capture(2.0);
    auto sound = editor::soundOfCapture(capture, 48000.0, "capture 1");
    REQUIRE(sound);
    CHECK(sound->reference.embedded->substr(0, 4) == "fLaC");
    CHECK(sound->reference.path == "capture 1.flac");
    std::vector<float> read(capture.samples.size());
    sound->audio.readMean(0, read);
    for (std::size_t i = 0; i < read.size(); ++i)
        REQUIRE(read[i] == Approx(capture.samples[i]).margin(1.0 / (1 << 23)));
    // What is beyond full scale stays so.
    Capture loud = capture;
    loud.samples[100] = 1.5f;
    const auto floats = editor::soundOfCapture(loud, 48000.0, "loud");
    REQUIRE(floats);
    CHECK(floats->reference.embedded->substr(0, 4) == "RIFF");
    std::array<float, 1> one{};
    floats->audio.readMean(100, one);
    CHECK(one[0] == 1.5f);

    CHECK(rig.plugin.keepsCaptures());
    plugin::PluginWindow window(rig.plugin);
    window.editCaptured({editor::clipOfCapture(capture, 48000.0, "capture 1").value(), std::move(sound)});
    editor::Session& session = rig.plugin.clips().session();
    REQUIRE(session.model.clip());
    const Clip before = *session.model.clip();
    REQUIRE(session.sounds.soundOfClip());
    // From the session's own text, in another instance.
    juce::MemoryBlock state;
    rig.plugin.getStateInformation(state);
    WindowRig other;
    other.plugin.setStateInformation(state.getData(), static_cast<int>(state.getSize()));
    editor::Session& again = other.plugin.clips().session();
    REQUIRE(again.model.clip());
    CHECK(again.model.clip()->name == before.name);
    CHECK(again.model.clip()->duration == before.duration);
    CHECK(again.model.clip()->envelope == before.envelope);
    CHECK(again.model.clip()->bands == before.bands);
    CHECK(again.model.clip()->transients == before.transients);
    REQUIRE(again.model.document().project().sources.size() == 1);
    EncoderParams finer = again.model.item()->encoder;
    finer.bands += 2;
    REQUIRE(pumpUntil([&] { return again.sounds.soundOfClip() != nullptr; }));
    again.sounds.reanalyse(finer);
    CHECK(pumpUntil([&] { return again.model.clip()->bands.size() != before.bands.size(); }));
    // Not where it is not wanted.
    rig.plugin.setKeepsCaptures(false);
    rig.plugin.getStateInformation(state);
    other.plugin.setStateInformation(state.getData(), static_cast<int>(state.getSize()));
    CHECK_FALSE(other.plugin.keepsCaptures());
}

TEST_CASE("What was heard last becomes a clip")
{
    WindowRig rig;
    const auto in = liveSounds(2, 5 * 48000, 3);
    (void)rig.run(in);
    const auto capture = rig.plugin.capture(2.0);
    REQUIRE(capture.samples.size() == 96000);
    CHECK(capture.samples.back() == Approx(0.5f * (in[0].back() + in[1].back())));
    const auto clip = editor::clipOfCapture(capture, 48000.0, "capture 1");
    REQUIRE(clip);
    CHECK(clip->duration == Approx(2.0).margin(0.05));
    CHECK(clip->bands.size() > 0);
    CHECK(clip->envelope.size() > 5);
    CHECK(sealOf(*clip) == ClipSeal::whole);
    const TempFolder folder;
    REQUIRE(writeClip(folder / "capture.json", *clip, jsonFormat()));
    const auto read = readClip(folder / "capture.json");
    REQUIRE(read);
    CHECK(read->clip == *clip);
    CHECK_FALSE(editor::clipOfCapture({}, 48000.0, "nothing"));
    CHECK_FALSE(editor::clipOfCapture(capture, 768001.0, "too fast"));
}

TEST_CASE("A captured clip is felt as its sound was: with the live share of what is heard and of speech")
{
    const juce::ScopedJuceInitialiser_GUI gui;
    WindowRig rig;
    (void)rig.run(liveSounds(2, 4 * 48000, 3));
    rig.plugin.parameter(ParameterId::audible).setValueNotifyingHost(0.5f);
    rig.plugin.parameter(ParameterId::speech).setValueNotifyingHost(0.0f);
    plugin::CapturePanel panel(rig.plugin);
    std::optional<editor::CapturedClip> edited;
    panel.onEdit = [&](const editor::CapturedClip& captured)
    {
        edited = captured;
    };
    juce::TextButton *capture = nullptr, *edit = nullptr;
    forEachChild(panel,
                 [&](juce::Component& child)
                 {
                     if (auto* button = dynamic_cast<juce::TextButton*>(&child))
                         (button->getButtonText() == "Capture" ? capture
                          : button->getButtonText() == "Edit"  ? edit
                                                               : button) = button;
                 });
    REQUIRE((capture != nullptr && edit != nullptr));
    capture->onClick();
    REQUIRE(pumpUntil([&] { return edit->isEnabled(); }));
    edit->onClick();
    REQUIRE(edited);
    EncoderParams params;
    params.audible = rig.plugin.values()[ParameterId::audible];
    params.speech = 0.0;
    CHECK(params.audible == Approx(0.5));
    CHECK(edited->encoder == params);
    const auto sound = rig.plugin.capture(5.0);
    CHECK(edited->clip == editor::clipOfCapture(sound, 48000.0, "capture 1", params).value());
    CHECK_FALSE(edited->clip == editor::clipOfCapture(sound, 48000.0, "capture 1").value());
}

TEST_CASE(
    "A captured clip can feel on the plugin's actuator as on the one that it was made for, as render --designed-for")
{
    const juce::ScopedJuceInitialiser_GUI gui;
    WindowRig rig;
    const auto& choices = plugin::rowOf(ParameterId::profile).choices;
    std::size_t slot = 0;
    while (profileNameOf(slot) != "l5-wristband")
        REQUIRE(++slot < choices.size());
    rig.plugin.parameter(ParameterId::profile).setPlainNotifyingHost(static_cast<double>(slot));
    (void)rig.run(liveSounds(2, 4 * 48000, 3));
    plugin::PluginWindow window(rig.plugin);
    window.editCaptured({editor::clipOfCapture(rig.plugin.capture(2.0), 48000.0, "capture 1").value(), {}});
    const auto clip = [&]
    {
        return *rig.plugin.clips().session().model.clip();
    };
    const Clip before = clip();
    REQUIRE(window.clipEditor()->doCommand(editor::feelAlike));
    auto* sheet = dynamic_cast<editor::OperationSheet*>(window.clipEditor()->sheet());
    REQUIRE(sheet != nullptr);
    sheet->apply();
    AdaptationParams params;
    params.strength = rig.plugin.values()[ParameterId::strength];
    const auto there = builtInProfile(slot);
    bool asThere = false;
    for (const NamedProfile& named : rig.plugin.clips().session().actuators.profiles())
        if (const auto made = transparentClip(before, *named.profile, *there, params); made && made->clip == clip())
            asThere = named.name != "l5-wristband";
    CHECK(asThere);
    CHECK_FALSE(clip() == before);
}

TEST_CASE("A capture is saved over no other file without a question", "[overwrite]")
{
    const juce::ScopedJuceInitialiser_GUI gui;
    WindowRig rig;
    plugin::PluginWindow window(rig.plugin);
    (void)rig.run(liveSounds(2, 4 * 48000, 3));
    plugin::CapturePanel* panel = nullptr;
    juce::TextButton *capture = nullptr, *save = nullptr;
    editor::NoticeBar* notice = nullptr;
    forEachChild(window,
                 [&](juce::Component& child)
                 {
                     if (auto* found = dynamic_cast<plugin::CapturePanel*>(&child))
                         panel = found;
                     if (auto* found = dynamic_cast<editor::NoticeBar*>(&child))
                         notice = found;
                     if (auto* button = dynamic_cast<juce::TextButton*>(&child))
                         (button->getButtonText() == "Capture"                         ? capture
                          : button->getButtonText() == juce::String::fromUTF8("Save…") ? save
                                                                                       : button) = button;
                 });
    REQUIRE((panel != nullptr && capture != nullptr && save != nullptr && notice != nullptr));
    capture->onClick();
    REQUIRE(pumpUntil([&] { return save->isEnabled(); }));
    const TempFolder folder;
    put(folder / "mine.json", "hers");
    panel->save(juce::File(juce::String((folder / "mine").string()))); // becomes mine.json
    CHECK(bytesOf(folder / "mine.json") == "hers");
    editor::MessageSheet* question = nullptr;
    forEachChild(window,
                 [&](juce::Component& child)
                 {
                     if (auto* found = dynamic_cast<editor::MessageSheet*>(&child))
                         question = found;
                 });
    REQUIRE(question != nullptr);
    CHECK(question->getTitle() == "Replace mine.json?");
    for (juce::Component* child : question->getChildren())
        if (auto* button = dynamic_cast<juce::TextButton*>(child);
            button != nullptr && button->getButtonText() == "Replace")
        {
            button->onClick();
            break;
        }
    CHECK(readClip(folder / "mine.json").ok());
    CHECK(notice->text() == "Written: mine.json");
    panel->save(juce::File(juce::String((folder / "new.pacb").string())));
    CHECK(readClip(folder / "new.pacb").ok());
}

TEST_CASE("In bypass the meters show what leaves the output, which is nothing")
{
    const juce::ScopedJuceInitialiser_GUI gui;
    WindowRig rig;
    (void)rig.run(liveSounds(2, 48000, 3));
    CHECK(rig.plugin.takePeak(0) > 0.01f);
    rig.set(ParameterId::bypass, 1.0);
    (void)rig.run(liveSounds(2, 4800, 3)); // it fades
    (void)rig.plugin.takePeak(0);
    const auto out = rig.run(liveSounds(2, 48000, 3));
    for (const float sample : out.haptic[0])
        REQUIRE(sample == 0.0f);
    CHECK(rig.plugin.takePeak(0) == 0.0f);
    rig.set(ParameterId::bypass, 0.0);
    (void)rig.run(liveSounds(2, 48000, 3));
    CHECK(rig.plugin.takePeak(0) > 0.01f);
    // Nor does anything leave a haptic channel that leads nowhere.
    rig.plugin.setConnected(0);
    (void)rig.plugin.takePeak(0);
    (void)rig.run(liveSounds(2, 48000, 3));
    CHECK(rig.plugin.takePeak(0) == 0.0f);
    rig.set(ParameterId::outputMode, static_cast<double>(plugin::OutputMode::replaceMain));
    (void)rig.run(liveSounds(2, 48000, 3));
    CHECK(rig.plugin.takePeak(0) > 0.01f);
}
