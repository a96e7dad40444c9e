#pragma once

// Session logs: one line of JSON for each occurrence, stored on the disk before the next.

#include "io/FileHandle.h"
#include "io/FileLock.h"
#include "study/Study.h"

#include <pacini/foundation/Result.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace pacini::study
{

inline constexpr std::string_view sessionFormatName = "pacini.session";
inline constexpr int sessionFormatVersion = 1;

/// Participant and study: the first line of a log.
struct SessionHead
{
    std::string study;       ///< its name
    std::string studySha256; ///< of the study's JSON as studyJson() writes it
    std::string participant; ///< a pseudonym such as P007
    std::size_t slot = 0;
    std::string group;
    std::string language;
    std::string started; ///< UTC, ISO 8601
    std::string consent; ///< the text of the consent; empty: not requested
    std::string program; ///< name and version
};

/// An answer, and the start time of its presentation.
struct Answer
{
    std::optional<double> value; ///< on the scale
    std::vector<double> values;  ///< of a page: ratings, places or heaps of the trial's stimuli
    std::optional<int> choice;   ///< from 0
    std::string words;
    std::vector<std::pair<std::string, std::string>> items; ///< of a questionnaire: names and answers
    double seconds = 0.0;                                   ///< from the end of the presentation to the answer
    int replays = 0;
    std::optional<double> soundOnset, touchOnset; ///< s of the device's clock
    int dropouts = 0;                             ///< drop-outs of the device during playback; the trial is repeated
};

/// A line of a log: an answer with its trial.
struct Record
{
    std::size_t trial = 0; ///< counted over the session
    std::string block;
    std::string task;
    std::vector<std::string> stimuli; ///< names, in the order of presentation
    bool training = false;
    std::optional<double> level; ///< value of the staircase's variable, in its unit
    std::optional<bool> correct;
    Answer answer;
    std::string time;                    ///< UTC, ISO 8601
    std::vector<std::string> unreadable; ///< names of entries that are no number, no truth or no text where one belongs
};

/// A log that was read.
struct LoggedSession
{
    SessionHead head;
    std::vector<Record> records;
    bool finished = false;
    double exposure = 0.0;           ///< m2/s4 s: weighted acceleration, squared, over time
    std::vector<std::string> events; ///< other occurrences, such as "stopped"
    std::uint64_t goodBytes = 0;     ///< of whole lines; an incomplete last line does not count
};

/// Reads the text of a log. An incomplete last line is left out. Errors: invalidData at `line 3` for other content,
/// unsupportedVersion.
[[nodiscard]] Result<LoggedSession> sessionOfText(std::string_view text);

/// Reads the log in a file. Errors also as in readWholeFile.
[[nodiscard]] Result<LoggedSession> readSession(const std::filesystem::path& path);

/// Appends to a log. Every line is on the disk (fsync) before the call returns; after an error nothing of the line
/// counts, and it can be tried again. The file is locked: no other program writes to it meanwhile. One thread.
class SessionLog
{
public:
    /// Begins a log, whose file must not exist. Errors: io, diskFull.
    [[nodiscard]] static Result<SessionLog> create(const std::filesystem::path& path, const SessionHead& head);

    /// Continues a log that readSession() has read. Errors: io, also if another program has it open.
    [[nodiscard]] static Result<SessionLog> resume(const std::filesystem::path& path, std::uint64_t goodBytes);

    [[nodiscard]] Result<void> add(const Record& record);

    /// `exposure` is the exposure since the last call, m2/s4 s.
    [[nodiscard]] Result<void> addEvent(std::string_view name, double exposure = 0.0);
    [[nodiscard]] Result<void> finish();

private:
    SessionLog(std::filesystem::path path, std::uint64_t length) : file(std::move(path)), written(length) {}
    [[nodiscard]] Result<void> open(const char* mode);
    [[nodiscard]] Result<void> append(const std::string& line);

    std::filesystem::path file;
    FileHandle stream;
    std::unique_ptr<FileLock> lock;
    std::uint64_t written = 0; ///< bytes of whole lines
};

/// Now, as "2026-11-27T10:00:00.123Z".
[[nodiscard]] std::string utcNow();

} // namespace pacini::study
