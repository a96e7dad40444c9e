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
    std::string consent; ///< text that was agreed to
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

    /// Goes on where the session in a log was. Errors: those of readSession(); invalidArgument where the study has
    /// changed since; io.
    [[nodiscard]] static Result<std::unique_ptr<Session>> resume(const Study& study, const std::filesystem::path& log);

    /// The trial that waits for an answer; null when all are done.
    [[nodiscard]] const Trial* trial() const noexcept;

    /// What the adaptive trial's staircase asks for, in the unit of its variable; nothing for other trials.
    [[nodiscard]] std::optional<double> level() const;

    /// Keeps the answer on the disk, then goes on to the next trial; the same again where something dropped out, three
    /// times at most. Whether the choice was right, where one can be. Errors: those of SessionLog, then nothing has
    /// changed.
    [[nodiscard]] Result<std::optional<bool>> answer(const Answer& answer);

    /// Something else worth keeping, such as "stopped".
    [[nodiscard]] Result<void> note(std::string_view event, double exposure = 0.0);

    [[nodiscard]] const SessionHead& head() const noexcept { return first; }
    [[nodiscard]] const std::filesystem::path& path() const noexcept { return file; }

    /// Answers so far and, as far as can be told, in all.
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

/// The stimulus of an adaptive or comparing trial that is held against the reference.
[[nodiscard]] std::size_t testedStimulus(const Trial& trial);

/// SHA-256 of a study, by which its sessions know it.
[[nodiscard]] std::string hashOf(const Study& study);

} // namespace pacini::study
