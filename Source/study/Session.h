#pragma once

// A participant's session: the next trial, the answers, and their storage.

#include "study/Plan.h"
#include "study/SessionLog.h"
#include "study/procedures/Staircase.h"

#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace pacini::study
{

/// Parameters of a new session.
struct SessionStart
{
    std::string language = "en";
    std::string consent; ///< text of the consent
    std::string program;
};

/// One thread.
class Session
{
public:
    /// Begins the session of the next free slot in `folder/sessions`, which is made where it is missing. Errors: io,
    /// diskFull; invalidArgument where a study of another content has sessions there.
    [[nodiscard]] static Result<std::unique_ptr<Session>> begin(const Study& study, const std::filesystem::path& folder,
                                                                const SessionStart& start);

    /// Continues the session in a log. Errors: those of readSession(); invalidArgument if the study has changed since;
    /// io.
    [[nodiscard]] static Result<std::unique_ptr<Session>> resume(const Study& study, const std::filesystem::path& log);

    /// The trial that waits for an answer; null after the last one.
    [[nodiscard]] const Trial* trial() const noexcept;

    /// The value that the adaptive trial's staircase requests, in the unit of its variable; none for other trials.
    [[nodiscard]] std::optional<double> level() const;

    /// Stores the answer on the disk, then moves to the next trial; after a drop-out it repeats the trial, at most
    /// three times. Returns whether the choice was right, if there is a right one. Errors: those of SessionLog;
    /// invalidArgument for a questionnaire with a missing or invalid answer; the session is then unchanged.
    [[nodiscard]] Result<std::optional<bool>> answer(const Answer& answer);

    /// Stores another occurrence, such as "stopped".
    [[nodiscard]] Result<void> note(std::string_view event, double exposure = 0.0);

    [[nodiscard]] const SessionHead& head() const noexcept { return first; }
    [[nodiscard]] const std::filesystem::path& path() const noexcept { return file; }

    /// Number of answers so far and, if known, in total.
    [[nodiscard]] std::size_t answered() const noexcept { return count; }
    [[nodiscard]] std::size_t planned() const noexcept { return trials.size(); }

    /// Share that is done, 0 to 1.
    [[nodiscard]] double progress() const noexcept;

    /// So far, m2/s4 s.
    [[nodiscard]] double exposure() const noexcept { return exposed; }

private:
    Session(const Study& ofStudy, SessionHead head, std::filesystem::path path);
    [[nodiscard]] std::optional<bool> take(const Answer& answer);
    void skipDone();
    [[nodiscard]] Staircase& staircase(const Trial& trial);
    [[nodiscard]] const Staircase* staircaseOf(const Trial& trial) const;

    Study study;
    SessionHead first;
    std::filesystem::path file;
    std::vector<Trial> trials;
    std::map<std::pair<std::size_t, std::size_t>, Staircase> staircases; ///< by block and stimulus
    std::optional<SessionLog> log;
    std::size_t next = 0;
    std::size_t count = 0;
    int repeats = 0; ///< of this trial, after something dropped out
    double exposed = 0.0;
};

/// The logs in `folder/sessions`, by name.
[[nodiscard]] std::vector<std::filesystem::path> sessionLogs(const std::filesystem::path& folder);

/// Returns the stimulus of an adaptive or comparing trial that is compared with the reference.
[[nodiscard]] std::size_t testedStimulus(const Trial& trial);

/// Returns the SHA-256 of a study, by which its sessions identify it.
[[nodiscard]] std::string hashOf(const Study& study);

} // namespace pacini::study
