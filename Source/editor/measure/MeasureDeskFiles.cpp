// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/Text.h"
#include "editor/measure/MeasureDesk.h"
#include "io/AudioFile.h"
#include "io/ProfileFile.h"
#include "io/SweepFile.h"

#include <utility>

// What a measurement reads and writes: sweeps for other players, recordings of theirs, the profile.

namespace pacini::editor
{

namespace
{
constexpr double soundRate = 48000.0; // Hz, of sweeps for other players

std::filesystem::path describing(std::filesystem::path sound)
{
    return sound.replace_extension(".json");
}
} // namespace

Result<void> MeasureDesk::saveSweep(const std::filesystem::path& sound, bool throughEqualizer)
{
    if (throughEqualizer && work.equalizer() == nullptr)
        return Error{ErrorCode::invalidArgument, "", "There is no equaliser yet."};
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

void MeasureDesk::readRecording(const std::filesystem::path& file, bool throughEqualizer)
{
    if (doing != Activity::none || (throughEqualizer && work.equalizer() == nullptr))
        return;
    (throughEqualizer ? verifyTrouble : sweepTrouble).clear();
    auto audio = readAudio(file);
    if (!audio)
        return fail(throughEqualizer, file.filename().string() + " was not read: " + audio.error().text() + ".");
    const auto width = static_cast<std::size_t>(audio->channels);
    if (width > mostInputs)
        return fail(throughEqualizer,
                    file.filename().string() + " has " + std::to_string(width) +
                        " channels. Keep those of the microphone or of the axes of the sensor, three at most.");
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
        recorded.inputs.push_back(width == 1 ? file.filename().string() : "channel " + std::to_string(c + 1));
    }
    analyse(std::move(recorded), {throughEqualizer, file.stem().string()});
}

std::filesystem::path MeasureDesk::profileFolder() const
{
    return around.profileFolder.empty() ? pathOf(juce::File::getSpecialLocation(juce::File::userDocumentsDirectory))
                                        : around.profileFolder;
}

Result<void> MeasureDesk::save(const std::string& name, const std::filesystem::path& file, bool use)
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
            return Error{ErrorCode::invalidArgument, "",
                         "An actuator that comes with Pacini is called " + shortName + "; choose another file name."};
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
