// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Controller of a measurement: playing on its rig, analysis in the background, saving of the results.

#include "document/FilesInTheWay.h"
#include "document/measure/ActuatorMeasurement.h"
#include "document/measure/MeasureRig.h"
#include "editor/clip/session/Transport.h"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace pacini::editor
{

/// Lives on when its page is closed, so that nothing that was measured gets lost. [message]
class MeasurementController
{
public:
    struct HostServices
    {
        std::shared_ptr<MeasureRig> device;  ///< null: only simulated actuators
        std::filesystem::path profileFolder; ///< where profiles are written at first
        double simulatedSpeed = 8.0;         ///< see SimulatedMeasureRig
        bool inPlace = false;                ///< work is done at once instead of in the background
    };

    static constexpr std::size_t maxInputs = 3; ///< one sensor of three axes

    MeasurementController(Actuators& profiles, Transport& playing, HostServices around);
    ~MeasurementController();

    std::function<void()> onChange; ///< anything but meters and progress

    /// The page has been opened or closed: inputs are heard only while it is open.
    void setOpen(bool open);
    /// To be called 10 times a second or more often while the page is open.
    void poll();

    [[nodiscard]] const ActuatorMeasurement& measurement() const noexcept { return work; }
    /// Of the open project, which no measurement replaces.
    [[nodiscard]] ProjectFileSet neededFiles() const { return filesOf(actuators.document()); }

    // Set up.

    /// The names of what can be measured with; the device first, where there is one.
    [[nodiscard]] std::vector<std::string> rigNames() const;
    [[nodiscard]] std::size_t rigIndex() const noexcept { return rigNow; }
    void chooseRig(std::size_t index);
    /// In place of all others; for tests.
    void useRig(std::shared_ptr<MeasureRig> rig);
    [[nodiscard]] const RigPorts& ports() const noexcept { return portsNow; }
    [[nodiscard]] const RigWiring& wiring() const noexcept { return wiredNow; }
    void setWiring(RigWiring wiring);
    void setSettings(const MeasureSettings& settings);
    [[nodiscard]] std::vector<std::string> profileNames() const; ///< short ones of the session's profiles
    /// One of them, to take limits from; nothing: an unknown actuator.
    void setBase(std::optional<std::size_t> profile);
    [[nodiscard]] std::optional<std::size_t> base() const noexcept { return baseNow; }
    [[nodiscard]] bool isToneOn() const noexcept { return tone; }
    void setTone(bool on);
    /// The largest magnitude at a wired input since the last call.
    [[nodiscard]] float takePeak(std::size_t input) { return rig->takePeak(input); }
    /// Why no sweep can be played, in plain words; empty: it can.
    [[nodiscard]] std::string obstacle() const;
    [[nodiscard]] double sweepSeconds() const; ///< of all that is played

    // Sweeps.

    enum class Activity
    {
        none,
        sweeping,
        verifying,
        analysing
    };
    [[nodiscard]] Activity activity() const noexcept { return doing; }
    [[nodiscard]] bool isPlaying() const noexcept
    {
        return doing == Activity::sweeping || doing == Activity::verifying;
    }
    [[nodiscard]] double progress() const { return isPlaying() ? rig->progress() : 0.0; }
    [[nodiscard]] double secondsLeft() const { return (1.0 - progress()) * playingSeconds; }
    [[nodiscard]] std::string nextPlacementName() const { return nextName; }
    void setNextPlacementName(const std::string& name) { nextName = name; }
    void sweep();
    void verify();
    void stop();
    void dropPlacement(std::size_t index);
    void dropVerifications();
    /// What went wrong with the last sweep, or the last through the equaliser; empty: nothing.
    [[nodiscard]] const std::string& sweepProblem() const noexcept { return sweepTrouble; }
    [[nodiscard]] const std::string& verifyProblem() const noexcept { return verifyTrouble; }

    /// The file beside a sweep's sound that describes it.
    [[nodiscard]] static std::filesystem::path describing(std::filesystem::path sound);
    /// The sweep as a sound, and beside it what was in it as .json.
    [[nodiscard]] Result<void> saveSweep(const std::filesystem::path& sound, bool throughEqualizer);
    /// A recording that was made elsewhere, of the sweep of the settings, or of that described in a .json of its name.
    void readRecording(const std::filesystem::path& file, bool throughEqualizer);

    // What follows.

    void setRequest(const EqualizerRequest& request);
    void setTolerance(double decibels);

    // Save.

    [[nodiscard]] std::filesystem::path profileFolder() const;
    /// Writes the profile and makes it one of the session's actuators; `use` chooses it at once.
    [[nodiscard]] Result<void> save(const std::string& name, const std::filesystem::path& file, bool use);

private:
    struct Target
    {
        bool verifying = false;
        std::string name;
    };

    void changed();
    [[nodiscard]] MeasureSettings proving() const;
    void follow();
    void connect();
    void analyse(RecordedSweep recorded, Target target);
    void analysed(Result<Placement> placement, const Target& target);
    void fail(bool verifying, std::string text);
    [[nodiscard]] std::vector<std::string> wiredNames() const;
    template <typename Work, typename Done>
    void run(Work work, Done done);

    Actuators& actuators;
    Transport& transport;
    const HostServices around;
    ActuatorMeasurement work;
    std::vector<std::size_t> simulated; ///< profiles of the session that can be simulated
    std::size_t rigNow = 0;
    std::shared_ptr<MeasureRig> rig;
    RigPorts portsNow;
    RigWiring wiredNow;
    bool outputChosen = false; ///< by the user; else it is where the actuator is expected
    std::optional<std::size_t> baseNow;
    bool tone = false;
    Activity doing = Activity::none;
    SweepParams playedSweep;
    double playedGain = 0.0; ///< dB, see VerifyingSweep
    double playingSeconds = 0.0;
    int placementNumber = 1;
    std::string nextName;
    std::string sweepTrouble, verifyTrouble;
    bool computing = false;
    unsigned asked = 0; ///< number of the recording that is analysed
    Jobs jobs;
};

} // namespace pacini::editor
