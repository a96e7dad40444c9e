#pragma once

// JSON report of a command (--json): one object of the same structure on success and on failure.

#include <pacini/foundation/Result.h>

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

namespace pacini::cli
{

/// Builder of the object {"pacini", "version", "command", "ok", the command's own members, "written", "failures",
/// "warnings"}; Resources/schema/pacini.report.schema.json describes it.
class JsonReport
{
public:
    using Json = nlohmann::ordered_json;

    /// Version of the structure. It changes when programs that read reports have to change.
    static constexpr int version = 1;

    /// `command` is the command as typed, such as "measure fit"; empty if none was given.
    explicit JsonReport(std::string commandToReport) : command(std::move(commandToReport)) {}

    /// Adds members of the command's own; none may be called like one of every report.
    void add(const Json& members);

    void addWritten(const std::filesystem::path& path);
    void addFailure(std::string_view input, const Error& error);
    void addWarning(std::string_view input, std::string_view message);

    /// The whole report; failures and warnings in order of their input, independent of threads.
    [[nodiscard]] std::string text(bool ok) const;

private:
    std::string command;
    Json own = Json::object();
    Json written = Json::array();
    Json failures = Json::array();
    Json warnings = Json::array();
};

/// {"files": [...]}; of a file that was the only one to ask for, its members stand beside the list as well.
[[nodiscard]] inline nlohmann::ordered_json fileList(nlohmann::ordered_json files, bool alone)
{
    nlohmann::ordered_json list = alone && files.size() == 1 ? files.front() : nlohmann::ordered_json::object();
    list["files"] = std::move(files);
    return list;
}

} // namespace pacini::cli
