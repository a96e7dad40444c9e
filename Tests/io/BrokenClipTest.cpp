#include "io/formats/json/ClipJson.h"
#include "support/Catch.h"
#include "support/Paths.h"
#include "support/TempFolder.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <map>
#include <set>
#include <string>

using namespace pacini;
using test::bytesOf;

namespace fs = std::filesystem;

namespace
{
const fs::path folder = testFolder() / "io/broken";

const std::map<std::string, ErrorCode> codes{
    {"invalidData", ErrorCode::invalidData},
    {"unsupportedVersion", ErrorCode::unsupportedVersion},
    {"notFinite", ErrorCode::notFinite},
    {"tooLarge", ErrorCode::tooLarge},
};
} // namespace

TEST_CASE("Every broken document is refused at the place of its fault", "[io][json]")
{
    const auto table = nlohmann::json::parse(bytesOf(folder / "table.json"));
    std::set<std::string> listed{"table.json"};
    for (const auto& entry : table)
    {
        const auto name = entry["file"].get<std::string>();
        CAPTURE(name);
        listed.insert(name);
        const auto text = bytesOf(folder / name);
        const auto clip = readClipJson(text);
        REQUIRE_FALSE(clip.ok());
        const Error& error = clip.error();
        CAPTURE(error.message);
        CHECK(error.where == entry["where"].get<std::string>());
        CHECK(error.code == codes.at(entry["code"].get<std::string>()));
        CHECK(error.text().find('\n') == std::string::npos);
        if (entry.contains("message"))
            CHECK(error.message == entry["message"].get<std::string>());
    }
    for (const auto& entry : fs::directory_iterator(folder))
        CHECK(listed.count(entry.path().filename().string()) == 1);
}
