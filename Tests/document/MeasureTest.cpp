#include "document/measure/ActuatorMeasurement.h"
#include "document/measure/MeasureCallback.h"
#include "document/measure/MeasureWords.h"
#include "document/measure/SimulatedMeasureRig.h"
#include "io/ProfileFile.h"
#include "io/ProfileJson.h"
#include "support/Catch.h"
#include "support/HeapGuard.h"
#include "support/Paths.h"

#include <pacini/actuator/Wearer.h>
#include <pacini/linearize/SweepSchedule.h>

#include <array>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <thread>

using namespace pacini;
using namespace pacini::test;

namespace
{
MeasureSettings shortSettings()
{
    MeasureSettings settings;
    settings.level = -12.0;
    settings.duration = 4.0;
    settings.calibrated = true;
    return settings;
}

RigParams usualRig()
{
    RigParams rig;
    rig.sampleRate = 8000.0;
    return rig;
}

RecordedSweep recordedOn(SimulatedMeasureRig& rig, std::vector<float> signal, const SweepParams& sweep,
                         const std::vector<std::size_t>& inputs)
{
    rig.wire({0, inputs});
    REQUIRE(rig.start(std::move(signal)).ok());
    while (rig.state() == RigState::playing)
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    REQUIRE(rig.state() == RigState::finished);
    RecordedSweep recorded{rig.takeRecording(), {}, sweep.sampleRate, sweep, true, 0.0};
    for (const std::size_t input : inputs)
        recorded.inputs.push_back(rig.ports().inputs[input]);
    CHECK(rig.state() == RigState::idle);
    return recorded;
}

Placement placementOf(SimulatedMeasureRig& rig, std::size_t wearer, const MeasureSettings& settings)
{
    rig.setPlacement(wearer);
    const SweepParams sweep = sweepOf(settings, rig.ports().sampleRate);
    auto placement = analysePlacement("Wearer " + std::to_string(wearer),
                                      recordedOn(rig, makeSweepSignal(sweep).value(), sweep, {0, 1, 2}), settings);
    REQUIRE(placement.ok());
    return std::move(placement).value();
}

void compute(ActuatorMeasurement& work)
{
    while (const auto due = work.due())
        work.bring(due->ticket, due->work());
}
} // namespace

TEST_CASE("An actuator is measured, flattened and proved flat within 1 dB, and becomes a profile", "[measure]")
{
    SimulatedMeasureRig rig(usualRig(), 0.0);
    ActuatorMeasurement work;
    work.setSettings(shortSettings());
    work.setRate(8000.0);
    CHECK(work.state(MeasureStep::response) == MeasureStepState::locked);
    CHECK(work.whyLocked(MeasureStep::response) == "Sweep the actuator first.");

    work.addPlacement(placementOf(rig, 0, work.settings()));
    CHECK(work.state(MeasureStep::response) == MeasureStepState::working);
    compute(work);
    REQUIRE(work.response() != nullptr);
    // The resonance of the device on the arm, by its equations of motion.
    CHECK(std::abs(levelAt(work.response()->average.response, 100.0) - rigLevel(usualRig(), 100.0)) < 0.3);
    REQUIRE(work.equalizer() != nullptr);
    CHECK(std::abs(work.equalizer()->predictedLinearity.worstDeviation) < 1.0);
    CHECK(work.state(MeasureStep::verify) == MeasureStepState::open);

    const auto through = verifyingSweep(work.settings(), work.equalizer()->fit.sections, 8000.0).value();
    rig.setPlacement(0);
    work.addVerification(
        analysePlacement("proof", recordedOn(rig, through.signal, through.sweep, {0, 1, 2}), work.settings()).value());
    work.setTolerance(1.0);
    compute(work);
    REQUIRE(work.verified() != nullptr);
    CAPTURE(work.verified()->linearity.worstDeviation, work.verified()->linearity.worstFrequency);
    CHECK(work.verified()->linearity.passed());
    CHECK(std::abs(work.verified()->before.worstDeviation) > 3.0);
    CHECK(work.state(MeasureStep::verify) == MeasureStepState::done);

    const Profile profile = work.profile("Wristband");
    REQUIRE(validate(profile).ok());
    CHECK(profile.name == "Wristband");
    CHECK(profile.equalizer == work.equalizer()->fit.sections);
    REQUIRE(profile.measurement.has_value());
    CHECK(profile.measurement->drive == -12.0);
    REQUIRE(profile.measurement->linearity.has_value());
    CHECK(std::abs(profile.measurement->linearity->worstDeviation) < 1.0);
    const auto back = readProfileJson(profileJson(profile));
    REQUIRE(back.ok());
    CHECK(back->measurement->points.size() == profile.measurement->points.size());
}

TEST_CASE("The sweep that proves an equaliser begins a little below the range that was asked for", "[measure]")
{
    const auto jig = readProfile(sourceFolder() / "profiles/l5-test-jig.json").value();
    SimulatedMeasureRig rig(SimulatedMeasureRig::paramsOf(jig), 0.0);
    MeasureSettings settings;
    settings.duration = 8.0;
    settings.calibrated = true;
    const double rate = rig.ports().sampleRate;
    ActuatorMeasurement work;
    work.setSettings(settings);
    work.setRate(rate);
    EqualizerRequest wish;
    wish.lowFrequency = 100.0;
    work.setRequest(wish);
    work.addPlacement(placementOf(rig, 0, settings));
    compute(work);
    REQUIRE(work.equalizer() != nullptr);
    const MeasureSettings proving = provingSettings(settings, work.equalizer()->lowFrequency);
    CHECK(proving.lowFrequency == Approx(80.0));
    const auto through = verifyingSweep(proving, work.equalizer()->fit.sections, rate, true).value();
    rig.setPlacement(0);
    auto recorded = recordedOn(rig, through.signal, through.sweep, {0, 1, 2});
    recorded.gain = through.gain;
    auto proof = analysePlacement("proof", recorded, settings);
    REQUIRE(proof.ok());
    work.addVerification(std::move(proof).value());
    compute(work);
    REQUIRE(work.verified() != nullptr);
    CAPTURE(work.verified()->linearity.worstDeviation, work.verified()->linearity.worstFrequency);
    CHECK(std::abs(work.verified()->linearity.worstDeviation) < 1.0);
}

TEST_CASE("What changes before a step makes the step forget its result, and late results are not taken", "[measure]")
{
    SimulatedMeasureRig rig(usualRig(), 0.0);
    ActuatorMeasurement work;
    work.setSettings(shortSettings());
    work.setRate(8000.0);
    work.addPlacement(placementOf(rig, 0, work.settings()));
    compute(work);
    const Placement proof = *work.placements().front();
    work.addVerification(proof);
    compute(work);
    REQUIRE(work.verified() != nullptr);
    CHECK_FALSE(work.verified()->linearity.passed()); // it went through no equaliser
    CHECK(work.state(MeasureStep::verify) == MeasureStepState::failed);
    work.setSaved("somewhere.json");

    EqualizerRequest wish;
    wish.sections = 2;
    work.setRequest(wish);
    CHECK(work.equalizer() == nullptr);
    CHECK(work.verifications().empty());
    CHECK(work.saved().empty());
    CHECK(work.response() != nullptr);
    const auto late = work.due();
    REQUIRE(late.has_value());
    wish.sections = 4;
    work.setRequest(wish);
    work.bring(late->ticket, late->work());
    CHECK(work.equalizer() == nullptr);
    compute(work);
    REQUIRE(work.equalizer() != nullptr);
    CHECK(work.equalizer()->fit.sections.size() == 4);

    // Range and calibration belong to the placements that are there.
    MeasureSettings other = work.settings();
    other.lowFrequency = 40.0;
    other.fullScale = 10.0;
    other.level = -20.0;
    work.setSettings(other);
    CHECK(work.settings().lowFrequency == 10.0);
    CHECK(work.settings().fullScale == shortSettings().fullScale);
    CHECK(work.settings().level == -20.0);
    work.dropPlacement(0);
    CHECK(work.state(MeasureStep::equalizer) == MeasureStepState::locked);
    CHECK_FALSE(work.due().has_value());
    work.setSettings(other);
    CHECK(work.settings().lowFrequency == 40.0);
}

TEST_CASE("The loose one of five placements is named and left out of the average", "[measure]")
{
    ActuatorMeasurement work;
    work.setSettings(shortSettings());
    work.setRate(8000.0);
    for (std::size_t wearer = 0; wearer < 5; ++wearer)
    {
        RigParams params = usualRig();
        params.contact = wearer == 3 ? -9.0 : 0.0;
        SimulatedMeasureRig rig(params, 0.0);
        work.addPlacement(placementOf(rig, wearer, work.settings()));
    }
    compute(work);
    REQUIRE(work.response() != nullptr);
    CHECK(work.response()->findings.outliers == std::set<std::size_t>{3});
    REQUIRE_FALSE(work.response()->notes.empty());
    CHECK(work.response()->notes.front().find("'Wearer 3' differs from the others") == 0);
    CHECK(work.profile("x").measurement->placements == 4);
}

TEST_CASE("At the settings a person starts with no simulated actuator clips, on whomever it is worn", "[measure]")
{
    MeasureSettings settings;
    settings.duration = 2.0;
    int swept = 0;
    for (const auto& entry : std::filesystem::directory_iterator(sourceFolder() / "profiles"))
    {
        const auto profile = readProfile(entry.path());
        if (!profile || !profile->body || profile->technology == Technology::erm)
            continue;
        RigParams params = SimulatedMeasureRig::paramsOf(*profile);
        params.sampleRate = 8000.0;
        params.noiseDensity *= 0.05;
        SimulatedMeasureRig rig(params, 0.0);
        for (unsigned wearer = 0; wearer <= simulatedWearers; ++wearer)
        {
            RigParams worn = params;
            worn.body = bodyOn(wearer, *params.body);
            double most = 0.0; // dB re 1 m/s^2 at full drive
            for (double f = settings.lowFrequency; f < settings.highFrequency; f *= 1.01)
                most = std::max(most, rigLevel(worn, f));
            CAPTURE(profile->name, wearer);
            CHECK(Decibels(settings.level + most).gain() + standardGravity < params.range);
        }
        for (const std::size_t wearer : {std::size_t(0), std::size_t(3), std::size_t(9)})
        {
            CAPTURE(profile->name, wearer);
            for (const std::string& note : placementOf(rig, wearer, settings).notes)
                CHECK(note.find("clips") == std::string::npos);
            ++swept;
        }
    }
    CHECK(swept >= 30);
}

TEST_CASE("A proof that is flat is not taken for the drive signal", "[measure]")
{
    // A sensor that hears the same at every frequency is on the wrong input, unless an equaliser was to make it so.
    SimulatedMeasureRig rig(usualRig(), 0.0);
    const SweepParams sweep = sweepOf(shortSettings(), 8000.0);
    RecordedSweep recorded = recordedOn(rig, makeSweepSignal(sweep).value(), sweep, {3});
    recorded.inputs = {"Sensor"};
    CHECK_FALSE(analysePlacement("x", recorded, shortSettings()).ok());
    recorded.equalized = true;
    const auto proof = analysePlacement("x", recorded, shortSettings());
    REQUIRE(proof.ok());
    for (const std::string& note : proof->notes)
        CHECK(note.find("drive signal") == std::string::npos);
}

TEST_CASE("What goes wrong with a sweep is said in plain words with the name of the input", "[measure]")
{
    const MeasureSettings settings = shortSettings();
    const SweepParams sweep = sweepOf(settings, 8000.0);
    const auto signal = makeSweepSignal(sweep).value();
    const auto failure = [&](SimulatedMeasureRig& rig, const std::vector<std::size_t>& inputs)
    {
        const auto placement = analysePlacement("x", recordedOn(rig, signal, sweep, inputs), settings);
        REQUIRE_FALSE(placement.ok());
        CHECK(placement.error().where.empty());
        UNSCOPED_INFO(placement.error().message);
        return placement.error().message;
    };
    SimulatedMeasureRig rig(usualRig(), 0.0);

    SECTION("nothing is connected")
    {
        CHECK(failure(rig, {4}).find("No sweep detected on 'Nothing connected'") == 0);
    }
    SECTION("the input carries the drive")
    {
        CHECK(failure(rig, {3}).find("'Drive signal' carries the drive signal, not a motion") == 0);
    }
    SECTION("the sensor is overloaded")
    {
        RigParams narrow = usualRig();
        narrow.range = 2.0 * standardGravity;
        SimulatedMeasureRig small(narrow, 0.0);
        const auto placement = analysePlacement("x", recordedOn(small, signal, sweep, {0, 1, 2}), settings);
        REQUIRE(placement.ok());
        REQUIRE_FALSE(placement->notes.empty());
        CHECK(placement->notes.front().find("Clipping on '") != std::string::npos);
        CHECK(placement->notes.front().find("record or drive at a lower level") != std::string::npos);
        // Nothing that is made of it is done.
        ActuatorMeasurement work;
        work.setSettings(settings);
        work.setRate(8000.0);
        work.addPlacement(*placement);
        compute(work);
        REQUIRE(work.equalizer() != nullptr);
        for (const MeasureStep step : {MeasureStep::sweep, MeasureStep::response, MeasureStep::equalizer})
            CHECK(work.state(step) == MeasureStepState::failed);
        CHECK(work.state(MeasureStep::verify) == MeasureStepState::open);
        work.addVerification(*placement);
        compute(work);
        CHECK(work.state(MeasureStep::verify) == MeasureStepState::failed);
        work.dropPlacement(0);
        CHECK(work.state(MeasureStep::sweep) == MeasureStepState::open);
        // Something so strong that nothing is seen of the sweep.
        RecordedSweep drowned = recordedOn(small, signal, sweep, {0});
        for (std::size_t n = 0; n < drowned.channels.front().size(); ++n)
            drowned.channels.front()[n] = n / 40 % 2 == 0 ? 1.0f : -1.0f;
        const auto nothing = analysePlacement("x", drowned, settings);
        REQUIRE_FALSE(nothing.ok());
        CHECK(nothing.error().message.find("Clipping on '") != std::string::npos);
    }
    SECTION("the recording ends too early")
    {
        RecordedSweep recorded = recordedOn(rig, signal, sweep, {0});
        recorded.channels.front().resize(8000);
        const auto placement = analysePlacement("x", recorded, settings);
        REQUIRE_FALSE(placement.ok());
        CHECK(placement.error().message.find("The recording is too short") == 0);
    }
    SECTION("settings that make no sweep")
    {
        SweepParams wrong = sweep;
        wrong.highFrequency = 7000.0;
        const auto error = validate(wrong).error();
        CHECK(explain({error.code, "sweep." + error.where, error.message}, {}) ==
              "The highest frequency must be 1.5 times the low frequency to 0.45 of the sample rate.");
    }
}

TEST_CASE("A sweep through an equaliser that raises it beyond full scale is played softer", "[measure]")
{
    MeasureSettings settings = shortSettings();
    settings.level = -3.0;
    EqualizerSections sections;
    sections.pushBack({EqualizerType::peak, 200.0, 10.0, 1.0, 2});
    const auto made = verifyingSweep(settings, sections, 8000.0);
    REQUIRE(made.ok());
    const float peak = std::abs(*std::max_element(made->signal.begin(), made->signal.end(),
                                                  [](float a, float b) { return std::abs(a) < std::abs(b); }));
    CHECK(peak <= 1.0f);
    CHECK(peak > 0.7f);
    CHECK(made->sweep.levels.front() < -9.0);
    // One that lowers it is made up for, by a gain that the analysis knows.
    EqualizerSections lowering;
    lowering.pushBack({EqualizerType::highShelf, 2.0, -40.0, 0.7, 2});
    const auto soft = verifyingSweep(settings, lowering, 8000.0);
    const auto loud = verifyingSweep(settings, lowering, 8000.0, true);
    CHECK(soft->gain == 0.0);
    CHECK(std::abs(*std::max_element(soft->signal.begin(), soft->signal.end())) < 0.1f);
    CHECK(loud->gain > 17.0);
    CHECK(std::abs(*std::max_element(loud->signal.begin(), loud->signal.end()) - 0.708f) < 0.02f);
    SimulatedMeasureRig rig(usualRig(), 0.0);
    auto recorded = recordedOn(rig, loud->signal, loud->sweep, {0, 1, 2});
    recorded.gain = loud->gain;
    const auto heard = analysePlacement("x", recorded, settings);
    REQUIRE(heard.ok());
    const double expected = rigLevel(usualRig(), 100.0) + equalizerLevel(lowering, 100.0, 8000.0);
    CHECK(std::abs(levelAt(heard->measurement.response(), 100.0) - expected) < 0.3);
    CHECK(verifyingSweep(settings, {}, 8000.0)->sweep.levels.front() == -3.0);
}

TEST_CASE("The test tone comes and goes without a click, is silent during sweeps, and allocates nothing", "[measure]")
{
    constexpr double rate = 8000.0;
    MeasureCallback callback;
    callback.prepare(rate);
    std::array<float, 400> block{};
    const std::array<float, 400> heard{};
    const std::span<const float> inputs[] = {heard};
    callback.setTone(-6.0);
    float largest = 0.0f, step = 0.0f, before = 0.0f;
    const HeapGuard guard;
    for (int i = 0; i < 4; ++i)
    {
        callback.process(inputs, block);
        for (const float v : block)
        {
            largest = std::max(largest, std::abs(v));
            step = std::max(step, std::abs(v - before));
            before = v;
        }
    }
    CHECK(guard.traffic() == 0);
    CHECK(std::abs(largest - 0.501f) < 0.005f);
    CHECK(step < 0.05f); // 2 pi 100 / 8000 of the amplitude
    callback.setTone(std::nullopt);
    callback.process(inputs, block);
    callback.process(inputs, block);
    CHECK(block.back() == 0.0f);

    callback.setTone(-6.0);
    callback.process(inputs, block);
    REQUIRE(callback.sweeps().prepare(std::vector<float>(300, 0.25f), rate, 1, 0.0).ok());
    callback.sweeps().start();
    callback.process(inputs, std::span(block).first(300));
    for (std::size_t n = 0; n < 300; ++n)
        REQUIRE(block[n] == 0.25f);
    CHECK(callback.sweeps().state() == PlayAndRecordState::finished);
}

TEST_CASE("A simulated sweep takes its time, shows levels, and can be stopped", "[measure]")
{
    SimulatedMeasureRig rig(usualRig(), 1.0);
    rig.wire({0, {0, 3}});
    CHECK(rig.takePeak(1) < 1e-3f);
    rig.setTone(-6.0);
    CHECK(rig.takePeak(1) > 0.5f);
    rig.setTone(std::nullopt);
    const SweepParams sweep = sweepOf(shortSettings(), 8000.0);
    REQUIRE(rig.start(makeSweepSignal(sweep).value()).ok());
    CHECK(rig.state() == RigState::playing);
    CHECK(rig.progress() < 0.5);
    rig.stop();
    CHECK(rig.state() == RigState::idle);
    CHECK(rig.progress() == 0.0);
}
