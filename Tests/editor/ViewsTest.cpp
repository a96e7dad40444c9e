// What the rows of the sound and of the actuator show, and how the view follows.

#include "editor/Bench.h"
#include "editor/clip/session/ClipSteps.h"

#include <array>

using namespace pacini;
using namespace pacini::test;

namespace
{
juce::Image pictureOf(juce::Component& component)
{
    return component.createComponentSnapshot(component.getLocalBounds(), true, 1.0f);
}

/// The mean brightness of a stretch of a picture.
double brightness(const juce::Image& image, juce::Rectangle<int> area)
{
    double sum = 0.0;
    for (int y = area.getY(); y < area.getBottom(); ++y)
        for (int x = area.getX(); x < area.getRight(); ++x)
            sum += static_cast<double>(image.getPixelAt(x, y).getBrightness());
    return sum / (area.getWidth() * area.getHeight());
}

/// Sees what is to be drawn anew.
class Repaints final : public juce::CachedComponentImage
{
public:
    explicit Repaints(juce::RectangleList<int>& to) : list(to) {}
    void paint(juce::Graphics&) override {}
    bool invalidateAll() override
    {
        list.add(0, 0, 100000, 100000);
        return true;
    }
    bool invalidate(const juce::Rectangle<int>& area) override
    {
        list.add(area);
        return true;
    }
    void releaseResources() override {}

private:
    juce::RectangleList<int>& list;
};

int areaOf(const juce::RectangleList<int>& list)
{
    int sum = 0;
    for (const auto& area : list)
        sum += area.getWidth() * area.getHeight();
    return sum;
}

/// 4 s with a tone of 100 Hz that begins after 2 s, as a sound and as a clip of two bands.
editor::Imported toneFrom2s()
{
    editor::Imported imported;
    AudioData audio;
    audio.sampleRate = 8000;
    audio.channels = 1;
    audio.samples.assign(32000, 0.0f);
    for (std::size_t i = 16000; i < audio.samples.size(); ++i)
        audio.samples[i] =
            static_cast<float>(0.5 * std::sin(2.0 * 3.14159265358979 * 100.0 * static_cast<double>(i) / 8000.0));
    imported.sound = std::make_shared<const editor::Sound>(StoredAudio(audio));
    imported.reference.id = 1;
    imported.reference.path = "/tone.wav";
    imported.reference.duration = 4.0;
    imported.reference.sampleRate = 8000.0;
    imported.reference.channels = 1;
    imported.clip.name = "tone";
    imported.clip.duration = 4.0;
    imported.clip.envelope = {{0.0, 0.0}, {2.0, 0.0}, {2.0, 0.5}, {4.0, 0.5}};
    imported.clip.bands = {{90.0, 100.0, 110.0, 0, {{0.0, 0.0}, {2.0, 0.0}, {2.0, 0.5}, {4.0, 0.5}}, {}},
                           {900.0, 1000.0, 1100.0, 0, {{0.0, 0.0}, {2.0, 0.0}, {2.0, 0.1}, {4.0, 0.1}}, {}}};
    return imported;
}
} // namespace

TEST_CASE("The spectrogram is bright where a tone sounds and nowhere else, and is chosen by menu or button")
{
    EditorBench bench;
    bench.session.sounds.add(toneFrom2s());
    auto& row = bench.view.clipView().soundRow();
    const int before = row.getHeight();
    REQUIRE(bench.view.doCommand(editor::showSpectrum));
    CHECK(row.getHeight() > before);
    Waiting waiting;
    pictureOf(row);
    REQUIRE(waiting.until([&] { return row.isComplete(); }));
    const auto image = pictureOf(row);
    // 100 Hz lies at log(100 / 20) / log(2000 / 20) of the height.
    const int y = juce::roundToInt((1.0 - std::log(5.0) / std::log(100.0)) * (row.getHeight() - 1));
    const auto xOf = [&](double time)
    {
        return 144 + juce::roundToInt(bench.session.viewState.axis().xOf(time));
    };
    const double tone = brightness(image, {xOf(2.5), y - 2, 200, 4});
    CHECK(tone > 0.7);
    CHECK(brightness(image, {xOf(0.6), y - 2, 200, 4}) < 0.3);
    CHECK(brightness(image, {xOf(2.5), 5, 200, 4}) < 0.3);
    // The button goes on to both, then to the waveform.
    juce::Button* button = nullptr;
    for (auto* child : row.getChildren())
        if (child->getTitle().startsWith("View of the sound"))
            button = dynamic_cast<juce::Button*>(child);
    REQUIRE(button != nullptr);
    button->onClick();
    CHECK(bench.session.viewState.viewOptions().sound == editor::SoundView::both);
    button->onClick();
    CHECK(bench.session.viewState.viewOptions().sound == editor::SoundView::waveform);
    CHECK(row.getHeight() == before);
}

TEST_CASE("The actuator's rows tell that none is chosen, then what it plays and what is lost and why")
{
    EditorBench bench({shipped("lra-175")});
    bench.session.sounds.add(toneFrom2s());
    auto& row = bench.view.clipView().actuatorRow();
    const int low = row.getHeight();
    CHECK(row.trace() == nullptr);
    bench.session.actuators.setProfile("lra-175");
    CHECK(row.getHeight() > low);
    Waiting waiting;
    REQUIRE(waiting.until([&] { return row.trace() != nullptr; }));
    CHECK(row.trace()->sources.size() == 2);
    const auto textAt = [&](double time, int y)
    {
        return row.textAt(
            {144.0f + static_cast<float>(bench.session.viewState.axis().xOf(time)), static_cast<float>(y)});
    };
    const int bottom = row.getHeight();
    CHECK(textAt(3.0, 20).contains("dB re full drive"));
    CHECK(textAt(1.0, 20).contains("silent"));
    // High bands are above: 1 kHz is far out of the range of such an actuator, or plays with another's voice.
    CHECK(textAt(3.0, bottom - 40).startsWith("3.0"));
    CHECK(textAt(3.0, bottom - 40).contains("1.00 kHz: out of range: 1.00 kHz is played at"));
    CHECK(textAt(3.0, bottom - 8).contains("100 Hz: "));
    CHECK(textAt(1.0, bottom - 8).contains("silent"));
    // Drawn: the shaded band differs from silence.
    const auto image = pictureOf(row);
    const auto xOf = [&](double time)
    {
        return 144 + juce::roundToInt(bench.session.viewState.axis().xOf(time));
    };
    CHECK(brightness(image, {xOf(2.5), bottom - 45, 100, 10}) >
          brightness(image, {xOf(0.5), bottom - 45, 100, 10}) + 0.2);
    bench.session.actuators.setProfile({});
    CHECK(row.trace() == nullptr);
    CHECK(row.getHeight() == low);
}

TEST_CASE("An edit is rendered anew once the clip rests, and meanwhile the old is shown")
{
    EditorBench bench({shipped("wideband-exciter")});
    bench.session.actuators.setProfile("wideband-exciter");
    bench.session.sounds.add(toneFrom2s());
    auto& row = bench.view.clipView().actuatorRow();
    Waiting waiting;
    std::shared_ptr<const ActuatorTrace> first;
    const bool second = waiting.until(
        [&]
        {
            if (!first && row.trace())
            {
                first = row.trace();
                Clip edited = bench.clip();
                edited.envelope = {{0.0, 0.1}, {4.0, 0.1}};
                edited.bands[0].amplitude = {{0.0, 0.1}, {4.0, 0.1}};
                editor::setClip(bench.session.model, "Edit", edited);
                CHECK(row.trace() == first);
            }
            return first && row.trace() != first && row.trace();
        });
    REQUIRE(second);
    CHECK(first->peaks[100] < 1e-3f);
    CHECK(row.trace()->peaks[100] > 1e-3f);
}

TEST_CASE("Follow goes through the view's commands, and the view stays when it is off")
{
    EditorBench bench;
    bench.openDemo("knock_wood_bridge");
    CHECK(bench.session.viewState.viewOptions().follow == Follow::page);
    REQUIRE(bench.view.doCommand(editor::followSmooth));
    CHECK(bench.session.viewState.viewOptions().follow == Follow::smooth);
    REQUIRE(bench.view.doCommand(editor::followOff));
    CHECK(bench.session.viewState.viewOptions().follow == Follow::off);
    const auto height = bench.view.clipView().actuatorRow().isVisible();
    REQUIRE(bench.view.doCommand(editor::showActuator));
    CHECK(bench.view.clipView().actuatorRow().isVisible() != height);
}

TEST_CASE("The meters get the peak of what is played, once")
{
    EditorBench bench;
    bench.session.sounds.add(toneFrom2s());
    bench.session.player.prepare(8000.0);
    bench.session.transport.setPlayhead(2.2);
    bench.session.transport.play();
    std::array<float, 256> block{};
    float heard = 0.0f;
    for (int i = 0; i < 400 && heard < 0.1f; ++i)
    {
        const std::span<float> drive = block;
        bench.session.player.process(std::span(&drive, 1), {});
        for (const float sample : block)
            heard = std::max(heard, std::abs(sample));
        juce::Thread::sleep(5);
    }
    REQUIRE(heard > 0.1f);
    CHECK(bench.session.player.takeMeters().peak == Approx(static_cast<double>(heard)));
    CHECK(bench.session.player.takeMeters().peak == 0.0);
}

TEST_CASE("Moving one point redraws what lies about it and nothing else")
{
    EditorBench bench;
    bench.openDemo("drums_tabla_pattern");
    auto& view = bench.view.clipView();
    pictureOf(view);
    const Clip before = bench.clip();
    const std::size_t k = before.envelope.size() / 2;
    Clip edited = before;
    edited.envelope[k].value *= 0.5;
    juce::RectangleList<int> dirty;
    view.setCachedComponentImage(new Repaints(dirty));
    dirty.clear(); // of having been set
    editor::setClip(bench.session.model, "Edit", edited);
    view.setCachedComponentImage(nullptr);
    const auto& row = bench.row({LaneKind::envelope, 0});
    const auto place = view.getLocalPoint(&row, placeOf(row, bench.session, before.envelope[k])).roundToInt();
    CHECK(dirty.containsRectangle(juce::Rectangle<int>(8, 8).withCentre(place)));
    // The overview, and a strip of the lane.
    for (const auto& area : dirty)
        UNSCOPED_INFO(area.toString());
    INFO(areaOf(dirty) << " of " << view.getWidth() * view.getHeight());
    CHECK(areaOf(dirty) < view.getWidth() * 40 + 200 * 80);
}

TEST_CASE("A point more is told in the head, and bands that stay as they are are not drawn anew")
{
    EditorBench bench;
    bench.openDemo("drums_tabla_pattern");
    auto& view = bench.view.clipView();
    pictureOf(view);
    Clip edited = bench.clip();
    const std::size_t high = edited.bands.size() - 1;
    edited.bands[high].amplitude.push_back({edited.duration, 0.1});
    edited.envelope.push_back({edited.duration, 0.1});
    juce::RectangleList<int> dirty;
    view.setCachedComponentImage(new Repaints(dirty));
    dirty.clear(); // of having been set
    editor::setClip(bench.session.model, "Edit", edited);
    view.setCachedComponentImage(nullptr);
    const auto headOf = [&](Lane lane)
    {
        auto& row = bench.row(lane);
        return view.getLocalArea(&row, row.getLocalBounds().withWidth(100));
    };
    CHECK(dirty.containsRectangle(headOf({LaneKind::envelope, 0})));
    CHECK(!dirty.intersectsRectangle(headOf({LaneKind::centroid, 0})));
    const auto& other = bench.row({LaneKind::amplitude, high - 1});
    CHECK(!dirty.intersectsRectangle(view.getLocalArea(&other, other.getLocalBounds().reduced(1))));
    const auto& changed = bench.row({LaneKind::amplitude, high});
    CHECK(dirty.intersectsRectangle(view.getLocalArea(&changed, changed.getLocalBounds())));
}

TEST_CASE("Lanes of noise are named by their frequencies")
{
    EditorBench bench;
    editor::Imported imported = toneFrom2s();
    const Curve level = {{0.0, 0.1}, {4.0, 0.2}};
    imported.clip.noise = {{40.0, 125.0, level}, {500.0, 2000.0, level}};
    bench.session.sounds.add(std::move(imported));
    const auto title = [&](std::size_t k)
    {
        return bench.row({LaneKind::noise, k}).getTitle();
    };
    CHECK(title(0) == juce::String::fromUTF8("Noise 40–125 Hz"));
    CHECK(title(1) == juce::String::fromUTF8("Noise 0.50–2.0 kHz"));
    Clip edited = bench.clip();
    edited.noise[0].highFrequency = 130.0;
    editor::setClip(bench.session.model, "Edit", edited);
    CHECK(title(0) == juce::String::fromUTF8("Noise 40–130 Hz"));
}

TEST_CASE("Lanes fill a tall window, keep their height in a low one, and grow on from where they are")
{
    EditorBench bench;
    bench.openDemo("knock_wood_bridge");
    auto& lanes = bench.view.clipView();
    const auto bottom = [&]
    {
        int most = 0;
        for (auto* child : bench.row(envelope).getParentComponent()->getChildren())
            most = std::max(most, child->getBottom());
        return most;
    };
    bench.view.setSize(1280, 700);
    CHECK(lanes.shownLaneHeight() == bench.session.viewState.laneHeight());
    bench.view.setSize(1280, 3000);
    CHECK(lanes.shownLaneHeight() > 60);
    const auto* viewport = bench.row(envelope).findParentComponentOfClass<juce::Viewport>();
    REQUIRE(viewport != nullptr);
    CHECK(bottom() == viewport->getHeight());
    const int before = lanes.shownLaneHeight();
    REQUIRE(bench.view.doCommand(editor::tallerLanes));
    CHECK(lanes.shownLaneHeight() > before);
    CHECK(bottom() > viewport->getHeight());
}

TEST_CASE("The side panel is as wide as it was drawn, at most half the window, and can be put away")
{
    EditorBench bench;
    bench.openDemo("knock_wood_bridge");
    auto& side = bench.view.sidePanel();
    auto& divider = get<editor::SideDivider>(bench.view, "Width of the side panel");
    CHECK(side.getWidth() == editor::EditorView::usualSideWidth);
    Mouse(divider).dragFromTo({3.0f, 300.0f}, {-97.0f, 300.0f}, 1);
    CHECK(side.getWidth() == editor::EditorView::usualSideWidth + 100);
    CHECK(bench.view.clipView().getRight() == side.getX());
    bench.view.setSideWidth(5000);
    CHECK(side.getWidth() == 640);
    Mouse(divider).doubleClick({3.0f, 300.0f});
    CHECK(side.getWidth() == editor::EditorView::usualSideWidth);
    REQUIRE(bench.view.doCommand(editor::showSidePanel));
    CHECK_FALSE(side.isVisible());
    CHECK_FALSE(divider.isVisible());
    CHECK(bench.view.clipView().getWidth() == 1280);
    REQUIRE(bench.view.doCommand(editor::showSidePanel));
    CHECK(side.isVisible());
}

TEST_CASE("A scale that the window has no room for is drawn as large as fits, and every menu of the toolbar stays")
{
    EditorBench bench;
    bench.openDemo("knock_wood_bridge");
    bench.view.setScale(1.5);
    CHECK(bench.view.shownScale() == 1.5);
    bench.view.setSize(880, 568);
    CHECK(bench.view.scale() == 1.5); // comes back with the room
    CHECK(bench.view.shownScale() < 1.3);
    CHECK(bench.view.shownScale() > 1.1);
    for (const char* menu : {"Clip", "Monitor", "Actuator"})
    {
        CAPTURE(menu);
        CHECK(get<juce::ComboBox>(bench.view, menu).getWidth() >= 70);
    }
    bench.view.setSize(1280, 800);
    CHECK(bench.view.shownScale() == 1.5);
    CHECK(get<juce::Button>(bench.view, "Zoom in").isVisible());
}
