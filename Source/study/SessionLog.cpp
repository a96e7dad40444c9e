#include "study/SessionLog.h"

#include "io/InputFile.h"
#include "io/JsonTree.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cerrno>
#include <chrono>
#include <cmath>
#include <optional>
#include <system_error>
#include <type_traits>
#include <utility>

namespace pacini::study
{

namespace fs = std::filesystem;

namespace
{
using Json = nlohmann::json;
// Entries in the order in which they are written, for whoever looks at a log.
using Line = nlohmann::ordered_json;

constexpr std::size_t largestLog = 256'000'000; // bytes
constexpr std::size_t largestLine = 1'000'000;

/// The entry of that type, if there is one; a number within the range of T.
template <typename T>
std::optional<T> entryOf(const Json& entry)
{
    if constexpr (std::is_same_v<T, std::string>)
        return entry.is_string() ? std::optional(entry.get<std::string>()) : std::nullopt;
    else if constexpr (std::is_same_v<T, bool>)
        return entry.is_boolean() ? std::optional(entry.get<bool>()) : std::nullopt;
    else
    {
        if (!entry.is_number())
            return std::nullopt;
        const double number = entry.get<double>();
        if (!std::isfinite(number))
            return std::nullopt;
        if constexpr (std::is_floating_point_v<T>)
            return static_cast<T>(number);
        else
        {
            constexpr double most = 1e9; // of whole numbers in a log
            const bool fits =
                number == std::floor(number) && number >= (std::is_signed_v<T> ? -most : 0.0) && number <= most;
            return fits ? std::optional(static_cast<T>(number)) : std::nullopt;
        }
    }
}

template <typename T>
T valueOr(const Json& line, const char* name, T otherwise)
{
    const auto entry = line.find(name);
    return entry == line.end() ? otherwise : entryOf<T>(*entry).value_or(std::move(otherwise));
}

/// Reads a line's entries, and keeps the names of those that are there and are not what they should be.
class Entries
{
public:
    Entries(const Json& ofLine, std::vector<std::string>& toNote) : line(ofLine), unreadable(toNote) {}

    template <typename T>
    std::optional<T> get(const char* name)
    {
        const auto entry = line.find(name);
        if (entry == line.end())
            return std::nullopt;
        auto value = entryOf<T>(*entry);
        if (!value)
            unreadable.emplace_back(name);
        return value;
    }

    template <typename T>
    std::vector<T> list(const char* name)
    {
        std::vector<T> values;
        const auto entries = line.find(name);
        if (entries == line.end())
            return values;
        bool whole = entries->is_array();
        if (whole)
            for (const Json& entry : *entries)
            {
                auto value = entryOf<T>(entry);
                whole = whole && value.has_value();
                values.push_back(value.value_or(T{}));
            }
        if (!whole)
            unreadable.emplace_back(name);
        return values;
    }

private:
    const Json& line;
    std::vector<std::string>& unreadable;
};

Record recordOf(const Json& line)
{
    Record record;
    Entries entries(line, record.unreadable);
    record.trial = entries.get<std::size_t>("trial").value_or(0);
    record.block = valueOr(line, "block", std::string());
    record.task = valueOr(line, "task", std::string());
    record.stimuli = entries.list<std::string>("stimuli");
    record.training = entries.get<bool>("training").value_or(false);
    record.level = entries.get<double>("level");
    record.correct = entries.get<bool>("correct");
    record.answer.value = entries.get<double>("value");
    record.answer.values = entries.list<double>("values");
    record.answer.choice = entries.get<int>("choice");
    record.answer.words = entries.get<std::string>("words").value_or(std::string());
    if (const auto items = line.find("items"); items != line.end() && items->is_object())
        for (const auto& [name, text] : items->items())
            record.answer.items.emplace_back(name, text.is_string() ? text.get<std::string>() : text.dump());
    record.answer.seconds = valueOr(line, "seconds", 0.0);
    record.answer.replays = valueOr(line, "replays", 0);
    record.answer.soundOnset = entries.get<double>("soundOnset");
    record.answer.touchOnset = entries.get<double>("touchOnset");
    record.answer.dropouts = entries.get<int>("dropouts").value_or(0);
    record.time = valueOr(line, "time", std::string());
    return record;
}

Result<SessionHead> headOf(const Json& line, std::string_view where)
{
    if (valueOr(line, "format", std::string()) != sessionFormatName)
        return Error{ErrorCode::invalidData, std::string(where),
                     fmt::format("is not a session of a study: \"format\" must be \"{}\"", sessionFormatName)};
    if (const int version = valueOr(line, "version", 0); version > sessionFormatVersion)
        return Error{ErrorCode::unsupportedVersion, std::string(where),
                     fmt::format("was written by a newer version ({}) of the format; this program reads version {}",
                                 version, sessionFormatVersion)};
    SessionHead head;
    head.study = valueOr(line, "study", std::string());
    head.studySha256 = valueOr(line, "studySha256", std::string());
    head.participant = valueOr(line, "participant", std::string());
    head.slot = valueOr(line, "slot", std::size_t(0));
    head.group = valueOr(line, "group", std::string());
    head.language = valueOr(line, "language", std::string());
    head.started = valueOr(line, "started", std::string());
    head.consent = valueOr(line, "consent", std::string());
    head.program = valueOr(line, "program", std::string());
    return head;
}

Line lineOf(const Record& record)
{
    Line line{{"type", "answer"},
              {"trial", record.trial},
              {"block", record.block},
              {"task", record.task},
              {"stimuli", record.stimuli}};
    if (record.training)
        line["training"] = true;
    if (record.level)
        line["level"] = *record.level;
    const Answer& answer = record.answer;
    if (answer.value)
        line["value"] = *answer.value;
    if (!answer.values.empty())
        line["values"] = answer.values;
    if (answer.choice)
        line["choice"] = *answer.choice;
    if (record.correct)
        line["correct"] = *record.correct;
    if (!answer.words.empty())
        line["words"] = answer.words;
    for (const auto& [name, text] : answer.items)
        line["items"][name] = text;
    line["seconds"] = answer.seconds;
    line["replays"] = answer.replays;
    if (answer.soundOnset)
        line["soundOnset"] = *answer.soundOnset;
    if (answer.touchOnset)
        line["touchOnset"] = *answer.touchOnset;
    if (answer.dropouts > 0)
        line["dropouts"] = answer.dropouts;
    line["time"] = record.time;
    return line;
}

std::string textOf(const Line& line)
{
    return line.dump(-1, ' ', false, Line::error_handler_t::replace) + '\n';
}
} // namespace

std::string utcNow()
{
    const auto now = std::chrono::floor<std::chrono::milliseconds>(std::chrono::system_clock::now());
    const auto milliseconds = now.time_since_epoch().count() % 1000;
    return fmt::format("{:%Y-%m-%dT%H:%M:%S}.{:03}Z", fmt::gmtime(std::chrono::system_clock::to_time_t(now)),
                       milliseconds);
}

Result<LoggedSession> readSession(const fs::path& path)
{
    const auto text = readWholeFile(path, largestLog);
    return text ? sessionOfText(*text) : text.error();
}

Result<LoggedSession> sessionOfText(std::string_view text)
{
    LoggedSession session;
    std::size_t start = 0, number = 0;
    while (start < text.size())
    {
        const std::size_t end = text.find('\n', start);
        if (end == std::string_view::npos)
            break; // was being written when the program ended
        const std::string where = fmt::format("line {}", ++number);
        const auto line = readJsonTree(text.substr(start, end - start), largestLine);
        if (!line || !line->is_object())
            return Error{ErrorCode::invalidData, where, line ? "is not a JSON object" : line.error().text()};
        const std::string type = valueOr(*line, "type", std::string());
        if (number == 1)
        {
            auto head = headOf(*line, where);
            if (!head)
                return head.error();
            session.head = std::move(*head);
        }
        else if (type == "answer")
            session.records.push_back(recordOf(*line));
        else if (type == "finished")
            session.finished = true;
        else if (type == "event")
        {
            session.events.push_back(valueOr(*line, "name", std::string()));
            session.exposure += valueOr(*line, "exposure", 0.0);
        }
        start = end + 1;
        session.goodBytes = start;
    }
    if (number == 0)
        return Error{ErrorCode::invalidData, "", "is not a session of a study: it is empty"};
    return session;
}

Result<void> SessionLog::open(const char* mode)
{
    lock = std::make_unique<FileLock>();
    fs::path beside = file;
    beside.replace_filename("." + file.filename().string() + ".lock");
    if (lock->take(beside, FileLock::IfMissing::create) == FileLock::Outcome::heldElsewhere)
        return Error{ErrorCode::io, "", "is open in another program; close that first"};
    stream = openStream(file, mode);
    if (!stream)
        return fileError(errno);
    // Nothing waits in the memory of this process, to be written a second time after a failure.
    std::setvbuf(stream.get(), nullptr, _IONBF, 0);
    return {};
}

Result<SessionLog> SessionLog::create(const fs::path& path, const SessionHead& head)
{
    SessionLog log(path, 0);
    if (auto opened = log.open("wbx"); !opened)
        return opened.error();
    const Line line{{"type", "session"},
                    {"format", sessionFormatName},
                    {"version", sessionFormatVersion},
                    {"study", head.study},
                    {"studySha256", head.studySha256},
                    {"participant", head.participant},
                    {"slot", head.slot},
                    {"group", head.group},
                    {"language", head.language},
                    {"started", head.started},
                    {"consent", head.consent},
                    {"program", head.program}};
    if (auto added = log.append(textOf(line)); !added)
    {
        log.stream.reset();
        std::error_code ignored;
        fs::remove(path, ignored);
        return added.error();
    }
    return log;
}

Result<SessionLog> SessionLog::resume(const fs::path& path, std::uint64_t goodBytes)
{
    SessionLog log(path, goodBytes);
    if (auto opened = log.open("r+b"); !opened)
        return opened.error();
    std::error_code failed;
    fs::resize_file(path, goodBytes, failed);
    if (failed)
        return fileError(failed.value());
    return log;
}

Result<void> SessionLog::append(const std::string& line)
{
    errno = 0;
    const bool done = seekStream(stream.get(), static_cast<std::int64_t>(written), SEEK_SET) &&
                      std::fwrite(line.data(), 1, line.size(), stream.get()) == line.size() && syncStream(stream.get());
    if (done)
    {
        written += line.size();
        return {};
    }
    const Error error = fileError(errno != 0 ? errno : EIO);
    std::clearerr(stream.get());
    std::error_code ignored;
    fs::resize_file(file, written, ignored);
    return error;
}

Result<void> SessionLog::add(const Record& record)
{
    return append(textOf(lineOf(record)));
}

Result<void> SessionLog::addEvent(std::string_view name, double exposure)
{
    Line line{{"type", "event"}, {"name", name}};
    if (exposure > 0.0)
        line["exposure"] = exposure;
    line["time"] = utcNow();
    return append(textOf(line));
}

Result<void> SessionLog::finish()
{
    return append(textOf({{"type", "finished"}, {"time", utcNow()}}));
}

} // namespace pacini::study
