#include "editor/measure/MeasurePage.h"

#include "Bench.h"
#include "document/measure/SimulatedMeasureRig.h"
#include "editor/Text.h"
#include "io/AudioFile.h"
#include "io/ProfileFile.h"
#include "io/SweepFile.h"
#include "support/Paths.h"
#include "support/TempFolder.h"

#include <pacini/linearize/SimulatedRig.h>

#include <chrono>
#include <functional>
#include <thread>

using namespace pacini;
using namespace pacini::test;
using editor::MeasurementController;

namespace
{
/// The page on a simulated rig that takes no time.
struct MeasureBench
{
    juce::ScopedJuceInitialiser_GUI gui;
    juce::TemporaryFile temporary{".d"};
    std::filesystem::path folder = editor::pathOf(temporary.getFile());
    editor::Session session{{}, {}};
    editor::EditorView view{session, {}};
    std::shared_ptr<MeasurementController> controller;
    editor::MeasurePage* page = nullptr;

    explicit MeasureBench(RigParams params = {})
    {
        std::filesystem::create_directories(folder);
        const auto wristband = readProfile(sourceFolder() / "profiles/l5-wristband.json");
        REQUIRE(wristband.ok());
        session.actuators.addProfile({"l5-wristband", std::make_shared<const Profile>(*wristband)}, false);
        controller = std::make_shared<MeasurementController>(
            session.actuators, session.transport, MeasurementController::HostServices{nullptr, folder, 0.0, true});
        params.sampleRate = 8000.0;
        controller->useRig(std::make_shared<SimulatedMeasureRig>(params, 0.0));
        MeasureSettings settings = controller->measurement().settings();
        settings.level = -12.0;
        settings.duration = 4.0;
        controller->setSettings(settings);
        auto made = std::make_unique<editor::MeasurePage>(controller, nullptr);
        page = made.get();
        view.setBounds(0, 0, 1280, 800);
        view.showSheet(std::move(made));
    }

    ~MeasureBench()
    {
        view.showSheet(nullptr);
        std::error_code ignored;
        std::filesystem::remove_all(folder, ignored);
    }

    void waitForSweep()
    {
        REQUIRE(controller->isPlaying());
        while (controller->isPlaying())
        {
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
            controller->poll();
        }
    }

    void sweep()
    {
        REQUIRE(page->show(MeasureStep::sweep));
        page->sweepStep().control.button.onClick();
        waitForSweep();
    }
};

/// All visible children of a component, and theirs.
void visit(juce::Component& component, const std::function<void(juce::Component&)>& look)
{
    for (auto* child : component.getChildren())
        if (child->isVisible())
        {
            look(*child);
            visit(*child, look);
        }
}

std::string where(const juce::Component& component)
{
    return (component.getTitle() + " '" + component.getName() + "' " + component.getBounds().toString()).toStdString();
}
} // namespace

TEST_CASE("The measure page leads from set-up to a saved profile that is proved flat within 1 dB", "[measure]")
{
    MeasureBench bench;
    auto& page = *bench.page;
    CHECK(page.step() == MeasureStep::setUp);
    CHECK_FALSE(page.show(MeasureStep::response)); // nothing has been swept
    bench.sweep();
    INFO(bench.controller->sweepProblem());
    REQUIRE(bench.controller->measurement().placements().size() == 1);

    REQUIRE(page.show(MeasureStep::response));
    const auto& curves = page.responseStep().responsePlot().shown();
    REQUIRE(curves.curves.size() == 2);
    CHECK(curves.curves.front().role == editor::ResponsePlot::Role::noise);
    REQUIRE(curves.range.has_value());

    REQUIRE(page.show(MeasureStep::equalizer));
    const std::size_t automatic = bench.controller->measurement().equalizer()->fit.sections.size();
    page.equalizerStep().sections.control.setSelectedId(1, juce::sendNotificationSync);
    REQUIRE(bench.controller->measurement().equalizer() != nullptr);
    CHECK(bench.controller->measurement().equalizer()->fit.sections.size() == 1);
    page.equalizerStep().boost.control.setValue(3.0, juce::sendNotificationSync);
    CHECK(bench.controller->measurement().equalizer()->fit.boost < 3.2);
    page.equalizerStep().boost.control.setValue(12.0, juce::sendNotificationSync);
    page.equalizerStep().sections.control.setSelectedItemIndex(0, juce::sendNotificationSync);
    CHECK(bench.controller->measurement().equalizer()->fit.sections.size() == automatic);

    REQUIRE(page.show(MeasureStep::verify));
    bench.controller->setTolerance(1.0);
    page.verifyStep().control.button.onClick();
    bench.waitForSweep();
    REQUIRE(bench.controller->measurement().verified() != nullptr);
    CHECK(bench.controller->measurement().state(MeasureStep::verify) == MeasureStepState::done);
    CHECK(page.verifyStep().responsePlot().shown().band.has_value());
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
        CHECK(page.verifyStep().meter(axis).isVisible());
        CHECK(page.verifyStep().meter(axis).getName() == page.setUpStep().meter(axis).getName());
    }

    REQUIRE(page.show(MeasureStep::save));
    page.saveStep().name.control.setText("My wristband", juce::dontSendNotification);
    page.saveStep().name.control.onTextChange();
    page.saveStep().saveButton.onClick();
    CAPTURE(page.saveStep().noteBox().getText());
    const auto file = bench.folder / "my-wristband.json";
    const auto saved = readProfile(file);
    REQUIRE(saved.ok());
    CHECK(saved->name == "My wristband");
    REQUIRE(saved->measurement.has_value());
    REQUIRE(saved->measurement->linearity.has_value());
    CHECK(std::abs(saved->measurement->linearity->worstDeviation) <= 1.0);
    CHECK(bench.controller->measurement().state(MeasureStep::save) == MeasureStepState::done);

    // It can be chosen, has been, and goes with the project.
    REQUIRE(bench.session.actuators.profiles().size() == 2);
    CHECK(bench.session.actuators.profiles().back().profile->name == "My wristband");
    CHECK(bench.session.actuators.profileName() == "my-wristband");
    REQUIRE(bench.session.model.document().project().profile.embedded.has_value());
    CHECK(bench.session.model.document().project().profile.embedded->equalizer == saved->equalizer);
    // Again, with another name and the same file: no second entry.
    page.saveStep().name.control.setText("My Wristband", juce::dontSendNotification);
    page.saveStep().name.control.onTextChange();
    page.saveStep().saveButton.onClick();
    REQUIRE(questionOver(page) != nullptr);
    answer(*questionOver(page), "Replace");
    CHECK(bench.session.actuators.profiles().size() == 2);
    CHECK(bench.session.actuators.profile()->name == "My Wristband");
}

TEST_CASE("The measure page says in plain words what is wrong with a sweep", "[measure]")
{
    const auto notes = [](MeasureBench& bench)
    {
        return bench.page->sweepStep().noteBox().getText().toStdString();
    };
    SECTION("nothing is connected to the input")
    {
        MeasureBench bench;
        bench.controller->setWiring({0, {4}});
        bench.sweep();
        CHECK(bench.controller->measurement().placements().empty());
        CHECK(notes(bench).find("No sweep detected on 'Nothing connected'") == 0);
        CHECK_FALSE(bench.page->show(MeasureStep::response));
    }
    SECTION("nothing is connected to the output")
    {
        MeasureBench bench;
        bench.controller->setWiring({1, {0, 1, 2}});
        bench.sweep();
        CHECK(bench.controller->measurement().placements().empty());
        CHECK(notes(bench).find("No sweep detected") == 0);
    }
    SECTION("the input carries the drive")
    {
        MeasureBench bench;
        bench.controller->setWiring({0, {3}});
        bench.sweep();
        CHECK(bench.controller->measurement().placements().empty());
        CHECK(notes(bench).find("'Drive signal' carries the drive signal, not a motion.") == 0);
    }
    SECTION("the sensor is overloaded")
    {
        RigParams narrow;
        narrow.range = 2.0 * standardGravity;
        MeasureBench bench(narrow);
        bench.sweep();
        REQUIRE(bench.controller->measurement().placements().size() == 1);
        CHECK(notes(bench).find("Clipping on '") != std::string::npos);
        CHECK(bench.controller->measurement().state(MeasureStep::sweep) == MeasureStepState::failed);
    }
    SECTION("a second try takes the words away, and placements can be dropped")
    {
        MeasureBench bench;
        bench.controller->setWiring({0, {4}});
        bench.sweep();
        bench.controller->setWiring({0, {0, 1, 2}});
        bench.sweep();
        CHECK(bench.controller->sweepProblem().empty());
        bench.sweep();
        REQUIRE(bench.controller->measurement().placements().size() == 2);
        CHECK(bench.controller->measurement().placements()[1]->name == "Placement 2");
        bench.controller->dropPlacement(0);
        REQUIRE(bench.controller->measurement().placements().size() == 1);
        CHECK(bench.controller->measurement().response() != nullptr);
    }
}

TEST_CASE("Numbers that are rounded to nothing have no sign", "[measure]")
{
    CHECK(editor::numberText(-0.04, 1) == "0.0");
    CHECK(editor::numberText(-0.4, 0) == "0");
    CHECK(editor::numberText(-0.06, 1) == "-0.1");
    CHECK(editor::signedText(-0.04, 1) == "0.0");
    CHECK(editor::signedText(0.04, 1) == "0.0");
    CHECK(editor::signedText(0.06, 1) == "+0.1");
}

TEST_CASE("Escape stops a sweep, and what was measured outlives the page", "[measure]")
{
    MeasureBench bench;
    bench.sweep();
    bench.page->sweepStep().control.button.onClick();
    REQUIRE(bench.controller->isPlaying());
    CHECK(bench.page->keyPressed(juce::KeyPress(juce::KeyPress::escapeKey)));
    CHECK_FALSE(bench.controller->isPlaying());
    CHECK(bench.view.sheet() == bench.page);
    bench.view.showSheet(nullptr);
    CHECK(bench.controller->measurement().placements().size() == 1);
    auto again = std::make_unique<editor::MeasurePage>(bench.controller, nullptr);
    CHECK(again->show(MeasureStep::response));
}

TEST_CASE("The menu opens one measure page", "[measure]")
{
    EditorBench bench;
    REQUIRE(bench.view.doCommand(editor::measureActuator));
    auto* page = dynamic_cast<editor::MeasurePage*>(bench.view.sheet());
    REQUIRE(page != nullptr);
    REQUIRE(bench.view.doCommand(editor::measureActuator));
    CHECK(bench.view.sheet() == page);
}

TEST_CASE("A sweep can be saved and its recording opened", "[measure]")
{
    MeasureBench bench;
    const auto sound = bench.folder / "sweep.wav";
    REQUIRE(bench.controller->saveSweep(sound, false).ok());
    const auto described = readSweepFile(bench.folder / "sweep.json");
    REQUIRE(described.ok());
    CHECK(described->sweep.duration == 4.0);
    const auto played = readAudio(sound);
    REQUIRE(played.ok());
    RigParams rig;
    const auto channels = recordOnRig(played->samples, rig);
    std::vector<float> interleaved(3 * channels.front().size());
    for (std::size_t i = 0; i < interleaved.size(); ++i)
        interleaved[i] = channels[i % 3][i / 3];
    AudioWriteParams writing;
    writing.channels = 3;
    const auto recording = bench.folder / "anna.wav";
    REQUIRE(writeAudio(recording, interleaved, writing).ok());
    bench.controller->readRecording(recording, false);
    INFO(bench.controller->sweepProblem());
    REQUIRE(bench.controller->measurement().placements().size() == 1);
    CHECK(bench.controller->measurement().placements()[0]->name == "anna");
    bench.controller->readRecording(bench.folder / "nobody.wav", false);
    CHECK(bench.controller->sweepProblem().find("Cannot read nobody.wav") == 0);
}

TEST_CASE("Nothing on the measure page is cut off or overlaps, everything has a name and a hint", "[measure]")
{
    MeasureBench bench;
    bench.sweep();
    bench.controller->verify();
    bench.waitForSweep();
    for (const auto size : {juce::Point(880, 560), juce::Point(1280, 800)})
    {
        bench.view.setBounds(0, 0, size.x, size.y);
        for (std::size_t i = 0; i < measureSteps; ++i)
        {
            REQUIRE(bench.page->show(static_cast<MeasureStep>(i)));
            auto& panel = bench.page->panel();
            CAPTURE(size.x, i);
            CHECK(panel.getWidth() <= size.x);
            for (auto* one : panel.getChildren())
            {
                if (!one->isVisible() || one->getBounds().isEmpty())
                    continue;
                CAPTURE(where(*one));
                CHECK(panel.getLocalBounds().contains(one->getBounds()));
                CHECK(one->getHeight() >= 16);
                for (auto* other : panel.getChildren())
                    if (other != one && other->isVisible())
                    {
                        CAPTURE(where(*other));
                        CHECK_FALSE(one->getBounds().intersects(other->getBounds()));
                    }
            }
            visit(panel,
                  [](juce::Component& component)
                  {
                      const bool control = dynamic_cast<juce::Slider*>(&component) != nullptr ||
                                           dynamic_cast<juce::ComboBox*>(&component) != nullptr ||
                                           dynamic_cast<juce::Button*>(&component) != nullptr;
                      auto* tips = dynamic_cast<juce::SettableTooltipClient*>(&component);
                      if (!control || tips == nullptr || dynamic_cast<juce::Slider*>(component.getParentComponent()))
                          return;
                      CAPTURE(where(component));
                      CHECK((component.getTitle() + component.getName()).isNotEmpty());
                      CHECK(tips->getTooltip().isNotEmpty());
                  });
        }
    }
}

TEST_CASE("A plot draws its curve where its scales say", "[measure]")
{
    juce::ScopedJuceInitialiser_GUI gui;
    editor::ResponsePlot plot("Plot", "Help");
    plot.setBounds(0, 0, 600, 300);
    FrequencyResponse line;
    for (int i = 0; i <= 40; ++i)
    {
        line.frequency.push_back(10.0 * std::pow(10.0, i / 20.0));
        line.level.push_back(-20.0 + i);
    }
    editor::ResponsePlot::Content content;
    content.curves = {{"line", line}};
    plot.show(content);
    CHECK(plot.placeOf(100.0, 0.0).x - plot.placeOf(10.0, 0.0).x ==
          Approx(plot.placeOf(1000.0, 0.0).x - plot.placeOf(100.0, 0.0).x).margin(0.01));
    const auto picture = plot.createComponentSnapshot(plot.getLocalBounds(), true, 1.0f);
    const auto accent = editor::paletteFor(plot).accent;
    for (const double f : {20.0, 90.0, 700.0})
    {
        const auto place = plot.placeOf(f, levelAt(line, f)).roundToInt();
        int nearest = 1000;
        for (int dy = -2; dy <= 2; ++dy)
        {
            const auto colour = picture.getPixelAt(place.x, place.y + dy);
            nearest = std::min(nearest, std::abs(colour.getRed() - accent.getRed()) +
                                            std::abs(colour.getGreen() - accent.getGreen()));
        }
        CHECK(nearest < 60);
        CHECK(picture.getPixelAt(place.x, place.y - 20) != accent);
    }
}

TEST_CASE("The measure page asks before a profile or a sweep replaces a file", "[measure][overwrite]")
{
    MeasureBench bench;
    auto& page = *bench.page;
    const auto sound = bench.folder / "sweep.wav", described = bench.folder / "sweep.json";
    put(described, "hers"); // the second file of the sweep
    page.saveSweep(sound, false);
    REQUIRE(questionOver(page) != nullptr);
    CHECK(questionOver(page)->getTitle() == "Replace sweep.json?");
    CHECK(bytesOf(described) == "hers");
    CHECK_FALSE(std::filesystem::exists(sound));
    answer(*questionOver(page), "Replace");
    CHECK(std::filesystem::exists(sound));
    CHECK(readSweepFile(described).ok());

    bench.sweep();
    REQUIRE(page.show(MeasureStep::save));
    const auto file = bench.folder / "mine.json";
    put(file, "hers");
    auto& name = page.saveStep().file.control;
    name.setText(juce::String(file.string()), juce::dontSendNotification);
    name.onTextChange();
    page.saveStep().saveButton.onClick();
    REQUIRE(questionOver(page) != nullptr);
    CHECK(questionOver(page)->getTitle() == "Replace mine.json?");
    CHECK(bytesOf(file) == "hers");
    answer(*questionOver(page), "Replace");
    CHECK(readProfile(file).ok());
}

TEST_CASE("A measurement plays on the output where the actuator is, until the user chooses another", "[measure]")
{
    struct Rig final : MeasureRig
    {
        RigPorts ports() override
        {
            RigPorts found;
            found.outputs = {"1", "2", "3", "4"};
            found.inputs = {"1"};
            found.expectedOutput = expected;
            return found;
        }
        void wire(const RigWiring& wiring) override { wired = wiring.output; }
        Result<void> start(std::vector<float>) override { return {}; }
        void stop() override {}
        [[nodiscard]] RigState state() const override { return RigState::idle; }
        [[nodiscard]] double progress() const override { return 0.0; }
        [[nodiscard]] std::vector<std::vector<float>> takeRecording() override { return {}; }
        [[nodiscard]] float takePeak(std::size_t) override { return 0.0f; }
        void setTone(std::optional<double>) override {}

        std::size_t expected = 2, wired = 99;
    };
    MeasureBench bench;
    auto rig = std::make_shared<Rig>();
    bench.controller->useRig(rig);
    CHECK(rig->wired == 2);
    CHECK(bench.controller->wiring().output == 2);
    rig->expected = 3; // haptic outputs have been set meanwhile
    bench.controller->setOpen(false);
    bench.controller->setOpen(true);
    CHECK(rig->wired == 3);
    RigWiring chosen = bench.controller->wiring();
    chosen.output = 1;
    bench.controller->setWiring(chosen);
    rig->expected = 0;
    bench.controller->setOpen(false);
    bench.controller->setOpen(true);
    CHECK(rig->wired == 1);
    bench.controller->setOpen(false);
}
