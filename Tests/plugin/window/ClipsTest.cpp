// Clips that are edited in the plugin's window.

#include "editor/clip/session/ClipSteps.h"
#include "plugin/engine/Rig.h"
#include "plugin/window/PluginWindow.h"
#include "support/HeapGuard.h"

#include <juce_events/juce_events.h>

#include <chrono>
#include <thread>

using namespace pacini;
using namespace pacini::test;
using plugin::ParameterId;

namespace
{
using WindowRig = RigOf<plugin::Plugin>;

/// A steady tone of 200 Hz.
Clip toneClip(double duration)
{
    Clip clip;
    clip.name = "tone";
    clip.duration = duration;
    clip.envelope = {{0.0, 0.5}, {duration, 0.5}};
    Band band;
    band.lowFrequency = 150.0;
    band.highFrequency = 250.0;
    band.centreFrequency = 200.0;
    band.amplitude = {{0.0, 0.5}, {duration, 0.5}};
    clip.bands = {band};
    return clip;
}

void addClip(WindowRig& rig, const Clip& clip)
{
    editor::Imported imported;
    imported.clip = clip;
    rig.plugin.clips().session().sounds.add(std::move(imported));
}

Channels silence(std::size_t frames)
{
    return {std::vector<float>(frames), std::vector<float>(frames)};
}

/// Runs blocks of silence until something is felt; its energy over a second.
double energyOfPreview(WindowRig& rig)
{
    for (int waited = 0; waited < 500; ++waited)
    {
        if (energy(rig.run(silence(512)).haptic[0]) > 1.0)
            return energy(rig.run(silence(48000)).haptic[0]);
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return 0.0;
}
} // namespace

TEST_CASE("A clip that plays in the window takes the place of the live drive until it ends")
{
    const juce::ScopedJuceInitialiser_GUI gui;
    WindowRig rig;
    const auto sound = liveSounds(2, 48000, 7);
    const double live = energy(rig.run(sound).haptic[0]);
    REQUIRE(live > 1.0);
    (void)rig.run(silence(96000)); // it dies away
    addClip(rig, toneClip(3.0));
    auto& session = rig.plugin.clips().session();
    session.transport.play();
    const double played = energyOfPreview(rig);
    CHECK(played == Approx(0.125 * 48000.0).epsilon(0.1)); // a sine of amplitude 0.5
    const auto during = rig.run(sound);
    CHECK(energy(during.haptic[0]) == Approx(played).epsilon(0.1)); // and nothing of the live drive
    session.transport.stop();
    (void)rig.run(sound);
    CHECK(energy(rig.run(sound).haptic[0]) == Approx(live).epsilon(0.05));
}

TEST_CASE("The sound passes untouched while a clip plays")
{
    const juce::ScopedJuceInitialiser_GUI gui;
    WindowRig rig;
    addClip(rig, toneClip(3.0));
    rig.plugin.clips().session().transport.play();
    REQUIRE(energyOfPreview(rig) > 0.0);
    rig.plugin.reset();
    const auto in = liveSounds(2, 24000, 9);
    const auto out = rig.run(in);
    const auto latency = static_cast<std::size_t>(rig.plugin.latency());
    CHECK(out.main[0] == delayed(in[0], latency));
    CHECK(out.main[1] == delayed(in[1], latency));
}

TEST_CASE("The keys of the clip editor work while the header of the window has the focus, and on its page only")
{
    const juce::ScopedJuceInitialiser_GUI gui;
    WindowRig rig;
    plugin::PluginWindow window(rig.plugin);
    addClip(rig, toneClip(3.0));
    auto& model = rig.plugin.clips().session().model;
    const juce::KeyPress keep('k', juce::ModifierKeys::commandModifier, 0);
    CHECK_FALSE(window.keyPressed(keep));
    window.show(plugin::PluginWindow::Page::clips);
    CHECK(window.keyPressed(keep));
    CHECK(model.keptVersion() != nullptr);
    window.show(plugin::PluginWindow::Page::live);
    CHECK_FALSE(window.keyPressed(keep));
}

TEST_CASE("The clips of the window are kept with the session")
{
    const juce::ScopedJuceInitialiser_GUI gui;
    juce::MemoryBlock state;
    Clip edited;
    {
        WindowRig rig;
        rig.plugin.getStateInformation(state);
        CHECK(state.toString().contains("\"clips\"") == false);
        addClip(rig, toneClip(2.0));
        auto& session = rig.plugin.clips().session();
        REQUIRE(editor::editClip(session.model, "Gain", GainEdit{session.clipSelection.scope(), -6.0}));
        edited = *session.model.clip();
        state.reset();
        rig.plugin.getStateInformation(state);
    }
    WindowRig second;
    second.plugin.setStateInformation(state.getData(), static_cast<int>(state.getSize()));
    CHECK(second.plugin.note().isEmpty());
    juce::MemoryBlock again; // before anyone looks at the clips
    second.plugin.getStateInformation(again);
    CHECK(again == state);
    REQUIRE(second.plugin.clips().session().model.clip());
    CHECK(*second.plugin.clips().session().model.clip() == edited);

    WindowRig broken;
    auto text = state.toString().replace("pacini.project", "something else");
    broken.plugin.setStateInformation(text.toRawUTF8(), static_cast<int>(text.getNumBytesAsUTF8()));
    CHECK(broken.plugin.note().contains("clips"));
    CHECK_FALSE(broken.plugin.clips().session().model.clip());
}

TEST_CASE("Playing a clip makes no heap traffic on the audio thread, nor does another rate stop the sound")
{
    const juce::ScopedJuceInitialiser_GUI gui;
    WindowRig rig;
    addClip(rig, toneClip(60.0));
    auto& session = rig.plugin.clips().session();
    session.transport.play();
    REQUIRE(energyOfPreview(rig) > 0.0);
    juce::AudioBuffer<float> buffer(3, 256);
    juce::MidiBuffer midi;
    std::size_t traffic = 0;
    for (int block = 0; block < 400; ++block)
    {
        buffer.clear();
        if (block % 50 == 0)
            editor::editClip(session.model, "Gain",
                             GainEdit{session.clipSelection.scope(), block % 100 == 0 ? -3.0 : 3.0});
        const HeapGuard guard;
        rig.plugin.processBlock(buffer, midi);
        traffic += guard.traffic();
    }
    CHECK(traffic == 0);
    rig.plugin.prepareToPlay(44100.0, 256);
    session.transport.play();
    CHECK(energyOfPreview(rig) > 0.0);
}

TEST_CASE("The window shows the clips in the place of the live controls and back")
{
    const juce::ScopedJuceInitialiser_GUI gui;
    WindowRig rig;
    plugin::PluginWindow window(rig.plugin);
    const auto visible = [&]
    {
        int count = 0;
        for (const auto* child : window.getChildren())
            count += child->isVisible() ? 1 : 0;
        return count;
    };
    const int live = visible();
    CHECK(window.clipEditor() == nullptr);
    window.show(plugin::PluginWindow::Page::clips);
    REQUIRE(window.clipEditor() != nullptr);
    CHECK(window.clipEditor()->isVisible());
    CHECK(visible() < live);
    CHECK(window.getLocalBounds().contains(window.clipEditor()->getBounds()));
    for (const auto* child : window.getChildren())
        if (child->isVisible() && child != window.clipEditor())
            CHECK(child->getBottom() <= window.clipEditor()->getY());
    window.show(plugin::PluginWindow::Page::live);
    CHECK(visible() == live);
}
