#include "study/Stimuli.h"

#include "io/ClipFile.h"
#include "io/SoundEncoder.h"
#include "study/Exposure.h"

#include <pacini/actuator/FeltModel.h>
#include <pacini/actuator/MeasuredFelt.h>
#include <pacini/clip/PackedClip.h>
#include <pacini/filters/Resampler.h>
#include <pacini/synthesis/ActuatorOutput.h>
#include <pacini/synthesis/PlayTimeline.h>
#include <pacini/synthesis/RenderScene.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>
#include <variant>

namespace pacini::study
{

namespace
{
constexpr double longestStimulus = 60.0; // s
constexpr Seconds lookAhead{0.001};

double peakOf(const std::vector<float>& samples)
{
    double peak = 0.0;
    for (const float sample : samples)
        peak = std::max(peak, std::abs(static_cast<double>(sample)));
    return peak;
}

void scale(std::vector<float>& samples, double gain)
{
    for (float& sample : samples)
        sample = static_cast<float>(gain * static_cast<double>(sample));
}

std::vector<float> toneOf(const Tone& tone, int sampleRate)
{
    const double fs = sampleRate;
    std::vector<float> samples(static_cast<std::size_t>(std::llround(tone.duration * fs)));
    const double amplitude = Decibels(tone.level).gain();
    for (std::size_t n = 0; n < samples.size(); ++n)
    {
        const double t = static_cast<double>(n) / fs;
        const double fromEnd = std::min(t, tone.duration - t);
        const double ramp =
            fromEnd < tone.fade ? 0.5 - 0.5 * std::cos(std::numbers::pi * std::max(fromEnd, 0.0) / tone.fade) : 1.0;
        samples[n] = static_cast<float>(amplitude * ramp * std::sin(2.0 * std::numbers::pi * tone.frequency * t));
    }
    return samples;
}

Result<std::vector<float>> monoOfFile(const std::filesystem::path& path, int sampleRate, int lowestRate)
{
    AudioReadOptions options;
    options.lowestSampleRate = lowestRate;
    auto audio = readAudio(path, options);
    if (!audio)
        return audio.error();
    const std::vector<float> mono = monoMix(audio->samples, static_cast<std::size_t>(audio->channels));
    return resample<float>(mono, audio->sampleRate, sampleRate);
}

void vary(Stimulus& stimulus, const Variation& variation)
{
    switch (variation.variable)
    {
    case Variable::level: // of what is at full drive by itself
        stimulus.sensationLevel = stimulus.acceleration = std::nullopt;
        if (stimulus.tone)
            stimulus.tone->level = std::min(0.0, variation.value);
        else
            stimulus.touchLevel = variation.value;
        break;
    case Variable::levelDifference:
        stimulus.touchLevel += variation.value;
        break;
    case Variable::frequency:
        if (stimulus.tone)
            stimulus.tone->frequency *= 1.0 + variation.value / 100.0;
        break;
    case Variable::bands:
        stimulus.bands = std::round(std::clamp(variation.value, 1.0, 32.0));
        break;
    case Variable::breakpoints:
        stimulus.breakpoints = std::clamp(variation.value, 0.5, 1000.0);
        break;
    case Variable::bits:
        stimulus.bits = std::round(std::clamp(variation.value, 4.0, 16.0));
        break;
    case Variable::delay:
        break; // of the trial
    }
}
} // namespace

void protectDrive(std::vector<float>& samples, const std::optional<Profile>& profile, int sampleRate)
{
    constexpr std::size_t blockFrames = 4096;
    RenderPlan plan;
    plan.profile = profile;
    ProcessSpec spec;
    spec.sampleRate = sampleRate;
    spec.maxBlockFrames = blockFrames;
    ActuatorOutput output(plan, spec, true, lookAhead, true);
    const std::size_t late = output.latencyFrames();
    samples.resize(samples.size() + late, 0.0f);
    for (std::size_t n = 0; n < samples.size(); n += blockFrames)
        output.process(std::span(samples).subspan(n, std::min(blockFrames, samples.size() - n)));
    samples.erase(samples.begin(), samples.begin() + static_cast<std::ptrdiff_t>(late));
}

bool knowsFelt(const std::optional<Profile>& profile) noexcept
{
    return profile && (profile->body || hasMeasuredAcceleration(*profile));
}

std::vector<float> feltOf(const std::vector<float>& drive, const std::optional<Profile>& profile, int sampleRate)
{
    std::vector<float> felt = drive;
    const auto params = profile ? feltModelParams(*profile) : std::nullopt;
    if (!params && profile && hasMeasuredAcceleration(*profile))
    {
        MeasuredFelt model(profile->measurement->points, sampleRate);
        felt.resize(drive.size() + model.latencyFrames(), 0.0f);
        model.process(felt, felt);
        felt.erase(felt.begin(), felt.begin() + static_cast<std::ptrdiff_t>(model.latencyFrames()));
        return felt;
    }
    if (!params)
    {
        scale(felt, assumedAcceleration);
        return felt;
    }
    scale(felt, profile->drive.overdrive);
    FeltModel model;
    ProcessSpec spec;
    spec.sampleRate = sampleRate;
    spec.maxBlockFrames = std::max<std::size_t>(felt.size(), 1);
    model.prepare(spec);
    model.setParams(*params);
    model.reset();
    model.process(felt, felt);
    return felt;
}

double largestDose(const std::vector<float>& touch, const std::vector<std::vector<float>>& more,
                   const std::optional<Profile>& profile, int sampleRate, ExposedPart part)
{
    double largest = doseOf(feltOf(touch, profile, sampleRate), sampleRate, part);
    for (const std::vector<float>& drive : more)
        largest = std::max(largest, doseOf(feltOf(drive, profile, sampleRate), sampleRate, part));
    return largest;
}

Result<std::vector<float>> StimulusMaker::soundOf(const Stimulus& stimulus) const
{
    if (stimulus.sound.empty())
        return std::vector<float>();
    auto sound = monoOfFile(settings.folder / stimulus.sound, settings.sampleRate, limits::lowestSampleRate);
    if (!sound)
        return Error{sound.error().code, stimulus.sound, sound.error().text()};
    scale(*sound, Decibels(stimulus.soundLevel + whole.soundLevel).gain());
    return sound;
}

Result<std::vector<float>> StimulusMaker::rendered(const Clip& clip) const
{
    RenderParams params;
    params.compile.sampleRate = settings.sampleRate;
    auto drive = renderScene(sceneOf(clip), settings.profile ? &*settings.profile : nullptr, params);
    if (!drive)
        return drive.error();
    return std::move(drive->samples);
}

Result<std::vector<float>> StimulusMaker::translated(const Stimulus& stimulus) const
{
    SoundEncoderParams params;
    if (!stimulus.method.empty())
    {
        const auto method = methodNamed(stimulus.method);
        if (!method)
            return Error{ErrorCode::invalidArgument, "method", fmt::format("'{}' is not known", stimulus.method)};
        params.method = *method;
    }
    if (stimulus.bands)
        params.params.bands = static_cast<int>(*stimulus.bands);
    if (stimulus.breakpoints)
        params.params.breakpoints = *stimulus.breakpoints;
    if (stimulus.bits)
        params.params.quantise = static_cast<int>(*stimulus.bits);
    const std::filesystem::path path = settings.folder / stimulus.sound;
    auto reader = AudioReader::open(path);
    if (!reader)
        return Error{reader.error().code, stimulus.sound, reader.error().text()};
    SoundEncoder encoder(params);
    Stopwatch ignored;
    const std::function<void(double)> nobody = [](double) {
    };
    if (methodInfo(params.method).output == MethodOutput::signal)
    {
        SoundFileParts parts(*reader, nobody);
        const auto signal =
            encoder.signalOf({reader->sampleRate(), reader->channels(), 0, std::nullopt}, parts, ignored);
        if (!signal)
            return Error{signal.error().code, stimulus.sound, signal.error().text()};
        auto drive = resample<float>(*signal, reader->sampleRate(), settings.sampleRate);
        if (drive)
            protectDrive(*drive, settings.profile, settings.sampleRate);
        return drive;
    }
    auto clip = encoder.clipOf(*reader, path, nobody, ignored);
    if (!clip)
        return Error{clip.error().code, stimulus.sound, clip.error().text()};
    if (stimulus.bits) // the other methods have grids of their own
    {
        setQuantise(*clip, params.params.quantise);
        return rendered(onGrids(std::move(*clip)));
    }
    return rendered(*clip);
}

Result<std::vector<float>> StimulusMaker::touchOf(const Stimulus& stimulus) const
{
    const bool calibrated = stimulus.sensationLevel || stimulus.acceleration;
    const double gain = calibrated ? 1.0 : Decibels(stimulus.touchLevel + whole.touchLevel).gain();
    const auto asIs = [&](std::vector<float> samples)
    {
        scale(samples, gain);
        protectDrive(samples, settings.profile, settings.sampleRate);
        return samples;
    };
    if (stimulus.silence)
        return std::vector<float>(static_cast<std::size_t>(std::llround(*stimulus.silence * settings.sampleRate)),
                                  0.0f);
    if (stimulus.tone)
        return asIs(toneOf(*stimulus.tone, settings.sampleRate));
    if (!stimulus.drive.empty())
    {
        auto drive = monoOfFile(settings.folder / stimulus.drive, settings.sampleRate, limits::lowestWrittenRate);
        if (!drive)
            return Error{drive.error().code, stimulus.drive, drive.error().text()};
        // The file is the drive: the room for overdrive is in it already.
        scale(*drive, settings.profile ? settings.profile->drive.overdrive : 1.0);
        return asIs(std::move(*drive));
    }
    Result<std::vector<float>> touch = std::vector<float>();
    if (!stimulus.clip.empty())
    {
        auto read = readClip(settings.folder / stimulus.clip);
        if (!read)
            return Error{read.error().code, stimulus.clip, read.error().text()};
        touch = rendered(read->clip);
    }
    else
        touch = translated(stimulus);
    // It was protected at the level of the clip; what is louder has to be once more.
    if (touch && gain != 1.0)
    {
        scale(*touch, gain * (settings.profile ? settings.profile->drive.overdrive : 1.0));
        protectDrive(*touch, settings.profile, settings.sampleRate);
    }
    return touch;
}

/// Brings the peak of a touch to what the stimulus asks for; what is wrong, if anything is.
std::optional<Error> StimulusMaker::calibrate(std::vector<float>& touch, const Stimulus& stimulus) const
{
    const char* name = stimulus.sensationLevel ? "sensationLevel" : "acceleration";
    const auto problem = [&](std::string message)
    {
        return Error{ErrorCode::invalidArgument, name, std::move(message)};
    };
    if (!settings.profile)
        return problem("needs the profile of the actuator, to know what is felt");
    if (stimulus.acceleration && !knowsFelt(settings.profile))
        return problem("needs a profile with a body or a calibrated measurement, to know the felt acceleration");
    const double wanted =
        stimulus.sensationLevel
            ? Decibels(*stimulus.sensationLevel - settings.profile->range.dynamicRange + stimulus.touchLevel).gain()
            : *stimulus.acceleration * Decibels(stimulus.touchLevel).gain();
    const double overdrive = settings.profile->drive.overdrive;
    const auto reached = [&]
    {
        return stimulus.sensationLevel ? overdrive * peakOf(touch) // re full drive without it
                                       : peakOf(feltOf(touch, settings.profile, settings.sampleRate));
    };
    // A spinning motor's force is not in proportion to its drive, and protection takes what is too much: in proportion
    // at first, then between what was too weak and too strong.
    const std::vector<float> asItWas = touch;
    constexpr int attempts = 24;
    constexpr double closeEnough = 0.01;
    double gain = 1.0, nearest = 0.0;
    std::optional<double> tooWeak, tooStrong;
    for (int attempt = 0; attempt < attempts; ++attempt)
    {
        const double now = reached();
        if (std::abs(now - wanted) < std::abs(nearest - wanted))
            nearest = now;
        if (!(now > 0.0) || std::abs(now / wanted - 1.0) < closeEnough)
            break;
        (now < wanted ? tooWeak : tooStrong) = gain;
        gain = tooWeak && tooStrong ? std::sqrt(*tooWeak * *tooStrong) : gain * wanted / now;
        touch = asItWas;
        scale(touch, gain * overdrive);
        protectDrive(touch, settings.profile, settings.sampleRate);
    }
    const double now = reached();
    if (std::abs(now / wanted - 1.0) <= 0.05)
        return std::nullopt;
    return stimulus.sensationLevel
               ? problem(fmt::format("is {} dB, but the actuator's whole range is {} dB", *stimulus.sensationLevel,
                                     settings.profile->range.dynamicRange))
               : problem(fmt::format(
                     "is {:.3g} m/s2, but the nearest that the actuator does within its limits is {:.3g} m/s2", wanted,
                     nearest));
}

Result<PreparedStimulus> StimulusMaker::made(const Stimulus& stimulus) const
{
    if (!stimulus.mix.empty())
        return mixed(stimulus);
    auto sound = soundOf(stimulus);
    if (!sound)
        return sound.error();
    auto touch = touchOf(stimulus);
    if (!touch)
        return touch.error();
    if (stimulus.sensationLevel || stimulus.acceleration)
        if (auto problem = calibrate(*touch, stimulus))
            return *problem;
    if (static_cast<double>(std::max(sound->size(), touch->size())) > longestStimulus * settings.sampleRate)
        return Error{ErrorCode::tooLarge, "", fmt::format("lasts longer than {} s", longestStimulus)};
    return placed(std::move(*sound), *touch, stimulus);
}

/// The touch on every actuator of the row, by the pan laws of scenes; delays are whole frames. No actuator gets more
/// than the touch alone, so that all stay within the limits of the profile.
PreparedStimulus StimulusMaker::placed(std::vector<float> sound, const std::vector<float>& touch,
                                       const Stimulus& stimulus) const
{
    const auto actuators = static_cast<std::size_t>(whole.row.actuators);
    const Place place = stimulus.place.value_or(Place{0.5, PanLaw::delay}); // of delay: the same level for all
    const double longest = stimulus.place && place.by != PanLaw::constantPower ? whole.row.delay : 0.0;
    std::vector<std::size_t> delays;
    for (std::size_t a = 0; a < actuators; ++a)
        delays.push_back(static_cast<std::size_t>(
            std::llround(panDelay(place.position, a, actuators, longest) * settings.sampleRate)));
    const std::size_t frames = std::max(sound.size(), touch.size() + *std::max_element(delays.begin(), delays.end()));
    PreparedStimulus prepared{std::move(sound), {}, {}};
    prepared.sound.resize(frames, 0.0f);
    for (std::size_t a = 0; a < actuators; ++a)
    {
        const double gain = panGain(place.by, place.position, a, actuators);
        std::vector<float> drive(frames, 0.0f);
        for (std::size_t n = 0; n < touch.size(); ++n)
            drive[n + delays[a]] = static_cast<float>(gain * static_cast<double>(touch[n]));
        if (a == 0)
            prepared.touch = std::move(drive);
        else
            prepared.more.push_back(std::move(drive));
    }
    return prepared;
}

/// All at once, each at its own place; what is too much for an actuator is limited once more.
Result<PreparedStimulus> StimulusMaker::mixed(const Stimulus& stimulus) const
{
    PreparedStimulus sum;
    const auto add = [](std::vector<float>& to, const std::vector<float>& from)
    {
        to.resize(std::max(to.size(), from.size()), 0.0f);
        for (std::size_t n = 0; n < from.size(); ++n)
            to[n] += from[n];
    };
    sum.more.resize(static_cast<std::size_t>(whole.row.actuators) - 1);
    for (const std::string& name : stimulus.mix)
    {
        const auto part = made(whole.stimuli[stimulusNamed(whole, name)]);
        if (!part)
            return Error{part.error().code, fmt::format("mix (\"{}\")", name), part.error().text()};
        add(sum.sound, part->sound);
        add(sum.touch, part->touch);
        for (std::size_t a = 0; a < sum.more.size(); ++a)
            add(sum.more[a], part->more[a]);
    }
    scale(sum.sound, Decibels(stimulus.soundLevel).gain());
    const double overdrive = settings.profile ? settings.profile->drive.overdrive : 1.0;
    const auto finish = [&](std::vector<float>& drive)
    {
        drive.resize(sum.sound.size(), 0.0f);
        scale(drive, Decibels(stimulus.touchLevel).gain() * overdrive);
        protectDrive(drive, settings.profile, settings.sampleRate);
    };
    finish(sum.touch);
    for (std::vector<float>& drive : sum.more)
        finish(drive);
    return sum;
}

Result<PreparedStimulus> StimulusMaker::make(std::size_t index, const std::optional<Variation>& variation)
{
    if (!variation)
        if (const auto found = kept.find(index); found != kept.end())
            return found->second;
    Stimulus stimulus = whole.stimuli[index];
    if (variation)
        vary(stimulus, *variation);
    auto prepared = made(stimulus);
    if (!prepared)
    {
        const Error& error = prepared.error();
        return Error{error.code, fmt::format("stimuli[{}] (\"{}\")", index, whole.stimuli[index].name), error.text()};
    }
    if (!variation)
        kept.insert_or_assign(index, *prepared);
    return prepared;
}

} // namespace pacini::study
