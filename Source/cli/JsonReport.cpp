#include "cli/JsonReport.h"

#include <algorithm>
#include <array>
#include <cassert>

namespace pacini::cli
{

namespace
{
constexpr std::array<const char*, 7> common = {"pacini", "version", "command", "ok", "written", "failures", "warnings"};

JsonReport::Json inOrderOfInput(JsonReport::Json entries)
{
    std::stable_sort(entries.begin(), entries.end(),
                     [](const auto& a, const auto& b)
                     { return a["input"].template get<std::string>() < b["input"].template get<std::string>(); });
    return entries;
}
} // namespace

void JsonReport::add(const Json& members)
{
    assert(std::none_of(common.begin(), common.end(), [&](const char* name) { return members.contains(name); }));
    own.update(members);
}

void JsonReport::addWritten(const std::filesystem::path& path)
{
    written.push_back(path.string());
}

void JsonReport::addFailure(std::string_view input, const Error& error)
{
    failures.push_back({{"input", input}, {"where", error.where}, {"message", error.message}});
}

void JsonReport::addWarning(std::string_view input, std::string_view message)
{
    warnings.push_back({{"input", input}, {"message", message}});
}

std::string JsonReport::text(bool ok) const
{
    Json report{{"pacini", PACINI_VERSION}, {"version", version}, {"command", command}, {"ok", ok}};
    report.update(own);
    report["written"] = written;
    report["failures"] = inOrderOfInput(failures);
    report["warnings"] = inOrderOfInput(warnings);
    return report.dump(2, ' ', false, Json::error_handler_t::replace);
}

} // namespace pacini::cli
