// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/measure/MeasurementController.h"

#include "document/measure/SimulatedMeasureRig.h"
#include "editor/ActuatorItem.h"
#include "editor/Text.h"
#include "editor/Translation.h"
#include "io/AudioFile.h"
#include "io/ProfileFile.h"
#include "io/SweepFile.h"

#include <pacini/linearize/SweepSchedule.h>

#include <algorithm>
#include <utility>

namespace pacini::editor
{

namespace
{
constexpr double soundRate = 48000.0; // Hz, of sweeps for other players
} // namespace

std::filesystem::path MeasurementController::describing(std::filesystem::path sound)
{
    return sound.replace_extension(".json");
}

MeasurementController::MeasurementController(Actuators& profiles, Transport& playing, HostServices wanted)
    : actuators(profiles), transport(playing), around(std::move(wanted))
{
    for (std::size_t i = 0; i < actuators.profiles().size(); ++i)
    {
        const Profile& profile = *actuators.profiles()[i].profile;
        if (profile.body && profile.technology != Technology::erm)
            simulated.push_back(i);
    }
    nextName = tr("Placement {0}", {juce::String(placementNumber)}).toStdString();
    chooseRig(0);
}

MeasurementController::~MeasurementController()
{
    rig->stop();
}

template <typename Work, typename Done>
void MeasurementController::run(Work job, Done done)
{
    if (around.inPlace)
        done(job());
    else
        jobs.run(std::move(job), std::move(done));
}

void MeasurementController::changed()
{
    follow();
    if (onChange)
        onChange();
}

/// Computes what is due, one after the other.
void MeasurementController::follow()
{
    if (computing)
        return;
    auto due = work.due();
    if (!due)
        return;
    computing = true;
    run(std::move(due->work),
        [this, ticket = due->ticket](ActuatorMeasurement::Outcome outcome)
        {
            computing = false;
            work.bring(ticket, std::move(outcome));
            changed();
        });
}

void MeasurementController::setOpen(bool open)
{
    if (!open)
    {
        setTone(false);
        stop();
    }
    rig->setOpen(open);
    if (open)
        connect();
}

// Set up.

std::vector<std::string> MeasurementController::rigNames() const
{
    std::vector<std::string> names;
    if (around.device)
        names.push_back(tr("Audio device").toStdString());
    for (const std::size_t i : simulated)
        names.push_back(tr("Simulated: {0}", {actuatorText(*actuators.profiles()[i].profile)}).toStdString());
    if (names.empty())
        names.push_back(tr("Simulated wristband").toStdString());
    return names;
}

void MeasurementController::chooseRig(std::size_t index)
{
    std::shared_ptr<MeasureRig> wanted;
    std::size_t number = index;
    if (around.device && index == 0)
        wanted = around.device;
    else
    {
        number -= around.device ? 1u : 0u;
        wanted = std::make_shared<SimulatedMeasureRig>(
            number < simulated.size() ? SimulatedMeasureRig::paramsOf(*actuators.profiles()[simulated[number]].profile)
                                      : RigParams(),
            around.simulatedSpeed);
    }
    rigNow = index;
    useRig(std::move(wanted));
}

void MeasurementController::useRig(std::shared_ptr<MeasureRig> wanted)
{
    if (rig)
    {
        setTone(false);
        stop();
        rig->setOpen(false);
    }
    rig = std::move(wanted);
    rig->setOpen(true);
    wiredNow = {};
    outputChosen = false;
    portsNow = rig->ports();
    MeasureSettings settings = work.settings();
    const auto known = rig->fullScale();
    if (known)
        wiredNow.inputs = {0, 1, 2}; // a simulation has three axes
    settings.calibrated = known.has_value();
    settings.fullScale = known.value_or(settings.fullScale);
    work.setSettings(settings);
    connect();
    changed();
}

/// The ports may have changed.
void MeasurementController::connect()
{
    portsNow = rig->ports();
    if (!outputChosen || wiredNow.output >= portsNow.outputs.size())
        wiredNow.output = portsNow.expectedOutput < portsNow.outputs.size() ? portsNow.expectedOutput : 0;
    std::erase_if(wiredNow.inputs, [this](std::size_t input) { return input >= portsNow.inputs.size(); });
    if (wiredNow.inputs.empty() && !portsNow.inputs.empty())
        wiredNow.inputs.push_back(0);
    rig->wire(wiredNow);
    if (work.placements().empty())
        work.setRate(portsNow.sampleRate);
}

void MeasurementController::setWiring(RigWiring wiring)
{
    if (isPlaying() || wiring == wiredNow)
        return;
    // Each input once.
    std::vector<std::size_t> inputs;
    for (const std::size_t input : wiring.inputs)
        if (std::find(inputs.begin(), inputs.end(), input) == inputs.end() && inputs.size() < maxInputs)
            inputs.push_back(input);
    wiring.inputs = std::move(inputs);
    outputChosen = outputChosen || wiring.output != wiredNow.output;
    wiredNow = std::move(wiring);
    connect();
    changed();
}

void MeasurementController::setSettings(const MeasureSettings& settings)
{
    if (settings == work.settings())
        return;
    work.setSettings(settings);
    if (tone)
        rig->setTone(settings.level);
    changed();
}

std::vector<std::string> MeasurementController::profileNames() const
{
    std::vector<std::string> names;
    for (const NamedProfile& entry : actuators.profiles())
        names.push_back(actuatorText(*entry.profile).toStdString());
    return names;
}

void MeasurementController::setBase(std::optional<std::size_t> profile)
{
    baseNow = profile && *profile < actuators.profiles().size() ? profile : std::nullopt;
    work.setBase(baseNow ? actuators.profiles()[*baseNow].profile : nullptr);
    changed();
}

void MeasurementController::setTone(bool on)
{
    if (on == tone || (on && (isPlaying() || !portsNow.problem.empty())))
        return;
    tone = on;
    rig->setTone(on ? std::optional(work.settings().level) : std::nullopt);
    if (onChange)
        onChange();
}

std::string MeasurementController::obstacle() const
{
    if (!portsNow.problem.empty())
        return portsNow.problem;
    if (wiredNow.inputs.empty())
        return "No input chosen. Choose the one the sensor is connected to.";
    const auto valid = validate(sweepOf(work.settings(), portsNow.sampleRate));
    return valid ? std::string()
                 : tr("Invalid sweep settings: {0}.", {translateMessage(toText(valid.error().text()))}).toStdString();
}

double MeasurementController::sweepSeconds() const
{
    const SweepParams params = sweepOf(work.settings(), portsNow.sampleRate);
    return validate(params) ? static_cast<double>(makeSweepSchedule(params).frames) / params.sampleRate : 0.0;
}

std::vector<std::string> MeasurementController::wiredNames() const
{
    std::vector<std::string> names;
    for (const std::size_t input : wiredNow.inputs)
        names.push_back(portsNow.inputs[input]);
    return names;
}

// Sweeps.

void MeasurementController::fail(bool verifying, std::string text)
{
    doing = Activity::none;
    (verifying ? verifyTrouble : sweepTrouble) = std::move(text);
    changed();
}

void MeasurementController::sweep()
{
    if (doing != Activity::none)
        return;
    sweepTrouble.clear();
    connect();
    if (auto reason = obstacle(); !reason.empty())
        return fail(false, std::move(reason));
    transport.stop();
    setTone(false);
    playedSweep = sweepOf(work.settings(), portsNow.sampleRate);
    playedGain = 0.0;
    auto signal = makeSweepSignal(playedSweep);
    if (!signal)
        return fail(false, signal.error().text());
    playingSeconds = static_cast<double>(signal->size()) / portsNow.sampleRate;
    rig->setPlacement(static_cast<std::size_t>(placementNumber - 1));
    if (const auto begun = rig->start(std::move(signal).value()); !begun)
        return fail(false, begun.error().text());
    doing = Activity::sweeping;
    changed();
}

void MeasurementController::verify()
{
    if (doing != Activity::none || work.equalizer() == nullptr)
        return;
    verifyTrouble.clear();
    connect();
    if (auto reason = obstacle(); !reason.empty())
        return fail(true, std::move(reason));
    transport.stop();
    setTone(false);
    auto made = verifyingSweep(proving(), work.equalizer()->fit.sections, portsNow.sampleRate, true);
    if (!made)
        return fail(true, made.error().text());
    playedSweep = made->sweep;
    playedGain = made->gain;
    playingSeconds = static_cast<double>(made->signal.size()) / portsNow.sampleRate;
    rig->setPlacement(work.verifications().size());
    if (const auto begun = rig->start(std::move(made->signal)); !begun)
        return fail(true, begun.error().text());
    doing = Activity::verifying;
    changed();
}

void MeasurementController::stop()
{
    if (!isPlaying())
        return;
    rig->stop();
    doing = Activity::none;
    changed();
}

void MeasurementController::poll()
{
    if (!isPlaying())
    {
        // A device that has come or gone.
        const auto now = rig->ports();
        if (now.problem != portsNow.problem || now.inputs != portsNow.inputs || now.outputs != portsNow.outputs ||
            now.sampleRate != portsNow.sampleRate)
        {
            connect();
            changed();
        }
        return;
    }
    const bool verifying = doing == Activity::verifying;
    switch (rig->state())
    {
    case RigState::playing:
        return;
    case RigState::idle:
    case RigState::lost:
        rig->stop();
        return fail(verifying,
                    "The audio device stopped during the sweep. Check its cable and settings, then sweep again.");
    case RigState::finished:
        break;
    }
    RecordedSweep recorded{rig->takeRecording(), wiredNames(), portsNow.sampleRate, playedSweep, true,
                           playedGain,           verifying};
    analyse(std::move(recorded), {verifying, nextName});
}

void MeasurementController::analyse(RecordedSweep recorded, Target target)
{
    doing = Activity::analysing;
    if (onChange)
        onChange();
    run([recorded = std::move(recorded), settings = work.settings(), name = target.name]
        { return analysePlacement(name, recorded, settings); },
        [this, target, number = ++asked](Result<Placement> placement)
        {
            if (number == asked)
                analysed(std::move(placement), target);
        });
}

void MeasurementController::analysed(Result<Placement> placement, const Target& target)
{
    if (!placement)
        return fail(target.verifying, placement.error().message);
    doing = Activity::none;
    if (target.verifying)
    {
        // The equaliser may have been fitted anew meanwhile.
        if (work.equalizer() == nullptr)
            return fail(true, "The equaliser has changed in the meantime. Sweep again.");
        work.addVerification(std::move(placement).value());
    }
    else
    {
        work.addPlacement(std::move(placement).value());
        nextName = tr("Placement {0}", {juce::String(++placementNumber)}).toStdString();
    }
    changed();
}

void MeasurementController::dropPlacement(std::size_t index)
{
    work.dropPlacement(index);
    changed();
}

void MeasurementController::dropVerifications()
{
    work.dropVerifications();
    verifyTrouble.clear();
    changed();
}

MeasureSettings MeasurementController::proving() const
{
    return provingSettings(work.settings(), work.equalizer()->lowFrequency);
}

// What follows.

void MeasurementController::setRequest(const EqualizerRequest& request)
{
    work.setRequest(request);
    changed();
}

void MeasurementController::setTolerance(double decibels)
{
    work.setTolerance(decibels);
    changed();
}

// What is read and written: sweeps for other players; recordings of theirs; the profile.

Result<void> MeasurementController::saveSweep(const std::filesystem::path& sound, bool throughEqualizer)
{
    if (throughEqualizer && work.equalizer() == nullptr)
        return Error{ErrorCode::invalidArgument, "", "No equaliser yet."};
    SweepFile file;
    if (throughEqualizer)
        file.equalizedFor = "the actuator that is measured";
    auto made = throughEqualizer ? verifyingSweep(proving(), work.equalizer()->fit.sections, soundRate, true)
                                 : verifyingSweep(work.settings(), {}, soundRate);
    if (!made)
        return made.error();
    file.sweep = made->sweep;
    file.gain = made->gain;
    AudioWriteParams writing;
    writing.sampleRate = static_cast<int>(soundRate);
    writing.encoding = SampleEncoding::pcm24;
    writing.expectedFrames = made->signal.size();
    if (const auto written = writeAudio(sound, made->signal, writing); !written)
        return written.error();
    if (const auto written = writeSweepFile(describing(sound), file); !written)
        return written.error();
    return {};
}

void MeasurementController::readRecording(const std::filesystem::path& file, bool throughEqualizer)
{
    if (doing != Activity::none || (throughEqualizer && work.equalizer() == nullptr))
        return;
    (throughEqualizer ? verifyTrouble : sweepTrouble).clear();
    auto audio = readAudio(file);
    if (!audio)
        return fail(throughEqualizer, tr("Cannot read {0}: {1}.",
                                         {pathText(file.filename()), translateMessage(toText(audio.error().text()))})
                                          .toStdString());
    const auto width = static_cast<std::size_t>(audio->channels);
    if (width > maxInputs)
        return fail(throughEqualizer,
                    tr("{0} has {1} channels. Keep only the microphone or the sensor axes, three at most.",
                       {pathText(file.filename()), juce::String(static_cast<int>(width))})
                        .toStdString());
    RecordedSweep recorded{{},
                           {},
                           static_cast<double>(audio->sampleRate),
                           sweepOf(work.settings(), soundRate),
                           false,
                           0.0,
                           throughEqualizer};
    if (throughEqualizer)
        if (const auto made = verifyingSweep(proving(), work.equalizer()->fit.sections, soundRate, true))
        {
            recorded.sweep = made->sweep;
            recorded.gain = made->gain;
        }
    if (const auto described = readSweepFile(describing(file)))
    {
        recorded.sweep = described->sweep;
        recorded.gain = described->gain;
    }
    for (std::size_t c = 0; c < width; ++c)
    {
        auto& channel = recorded.channels.emplace_back(audio->samples.size() / width);
        for (std::size_t i = 0; i < channel.size(); ++i)
            channel[i] = audio->samples[i * width + c];
        recorded.inputs.push_back(width == 1
                                      ? file.filename().string()
                                      : tr("channel {0}", {juce::String(static_cast<int>(c + 1))}).toStdString());
    }
    analyse(std::move(recorded), {throughEqualizer, file.stem().string()});
}

std::filesystem::path MeasurementController::profileFolder() const
{
    return around.profileFolder.empty() ? pathOf(documentsFolder()) : around.profileFolder;
}

Result<void> MeasurementController::save(const std::string& name, const std::filesystem::path& file, bool use)
{
    if (work.equalizer() == nullptr)
        return Error{ErrorCode::invalidArgument, "", work.whyLocked(MeasureStep::save)};
    if (name.empty())
        return Error{ErrorCode::invalidArgument, "", "Give the profile a name."};
    if (file.stem().empty() || file.extension() != ".json")
        return Error{ErrorCode::invalidArgument, "", "The file needs a name that ends with .json."};
    const std::u8string stem = file.stem().u8string();
    const std::string shortName(stem.begin(), stem.end());
    for (const NamedProfile& entry : actuators.profiles())
        if (entry.name == shortName && !entry.own)
            return Error{
                ErrorCode::invalidArgument, "",
                tr("Pacini already comes with an actuator called {0}. Choose another file name.", {toText(shortName)})
                    .toStdString()};
    const Profile profile = work.profile(name);
    std::error_code ignored; // writing says what is wrong
    std::filesystem::create_directories(file.parent_path(), ignored);
    if (const auto written = writeProfile(file, profile); !written)
        return written.error();
    actuators.addProfile({shortName, std::make_shared<const Profile>(profile), true}, use);
    work.setSaved(std::string(reinterpret_cast<const char*>(file.u8string().c_str())));
    changed();
    return {};
}

} // namespace pacini::editor
