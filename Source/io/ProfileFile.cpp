#include "io/ProfileFile.h"

#include "io/InputFile.h"
#include "io/JsonTree.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

namespace pacini
{

namespace fs = std::filesystem;

namespace
{
using Json = nlohmann::json;

constexpr std::size_t largestProfile = std::size_t(1) << 20;

/// Reads members of one object and remembers the first thing that is wrong.
class Members
{
public:
    Members(const Json& objectToRead, std::string path, std::optional<Error>& firstError)
        : object(objectToRead), where(std::move(path)), error(firstError)
    {
    }

    void number(const char* name, double& value, bool required)
    {
        if (const Json* member = find(name, required))
        {
            if (member->is_number())
                value = member->get<double>();
            else
                fail(name, "must be a number");
        }
    }

    std::string text(const char* name, bool required)
    {
        const Json* member = find(name, required);
        if (member != nullptr && !member->is_string())
            fail(name, "must be a text in quotes");
        return member != nullptr && member->is_string() ? member->get<std::string>() : std::string();
    }

    void fail(const char* name, std::string message)
    {
        if (!error)
            error = Error{ErrorCode::invalidData, where.empty() ? name : where + "." + name, std::move(message)};
    }

private:
    const Json* find(const char* name, bool required)
    {
        const auto member = object.find(name);
        if (member != object.end())
            return &*member;
        if (required)
            fail(name, "is missing");
        return nullptr;
    }

    const Json& object;
    std::string where;
    std::optional<Error>& error;
};

EqualizerSection readSection(const Json& json, const std::string& where, std::optional<Error>& error)
{
    EqualizerSection section;
    Members members(json, where, error);
    const std::string type = members.text("type", true);
    const std::pair<const char*, EqualizerType> types[] = {{"peak", EqualizerType::peak},
                                                           {"lowShelf", EqualizerType::lowShelf},
                                                           {"highShelf", EqualizerType::highShelf},
                                                           {"highpass", EqualizerType::highpass}};
    const auto* found =
        std::find_if(std::begin(types), std::end(types), [&](const auto& t) { return type == t.first; });
    if (found == std::end(types))
        members.fail("type", "must be peak, lowShelf, highShelf or highpass");
    else
        section.type = found->second;
    members.number("frequency", section.frequency, true);
    members.number("gain", section.gain, section.type != EqualizerType::highpass);
    members.number("q", section.q, false);
    double order = section.order;
    members.number("order", order, false);
    section.order = order >= 1.0 && order <= 100.0 && order == std::floor(order) ? static_cast<int>(order) : 0;
    return section;
}
} // namespace

Result<Profile> readProfileJson(std::string_view text)
{
    const auto read = readJsonTree(text, largestProfile);
    if (!read)
        return read.error();
    const Json& document = *read;
    if (!document.is_object())
        return Error{ErrorCode::invalidData, "", "is not a profile, which is a JSON object"};

    std::optional<Error> error;
    Profile profile;
    Members members(document, "", error);
    if (members.text("format", true) != "pacini.profile" && !error)
        members.fail("format", "must be \"pacini.profile\"");
    double version = 0.0;
    members.number("version", version, true);
    if (!error && version > 1.0)
        return Error{
            ErrorCode::unsupportedVersion, "version",
            fmt::format("was written by a newer version ({}) of the format; this program reads version 1", version)};
    if (version != 1.0)
        members.fail("version", "must be 1");
    profile.name = members.text("name", true);
    if (const auto resonance = document.find("resonance"); resonance != document.end() && resonance->is_object())
        Members(*resonance, "resonance", error).number("frequency", profile.resonance.frequency, true);
    else
        members.fail("resonance", "must be an object with a frequency");
    if (const auto equalizer = document.find("equalizer"); equalizer != document.end())
    {
        if (!equalizer->is_array())
            members.fail("equalizer", "must be a list of sections");
        else
            for (std::size_t i = 0; i < equalizer->size() && !error; ++i)
            {
                if (i == profile.equalizer.capacity())
                {
                    members.fail("equalizer", "has more than 16 sections");
                    break;
                }
                const auto where = "equalizer[" + std::to_string(i) + "]";
                if (!(*equalizer)[i].is_object())
                    members.fail(where.c_str(), "must be an object");
                else
                    profile.equalizer.pushBack(readSection((*equalizer)[i], where, error));
            }
    }
    if (error)
        return *error;
    if (auto valid = validate(profile); !valid)
        return valid.error();
    return profile;
}

Result<Profile> readProfile(const fs::path& path)
{
    const auto text = readWholeFile(path, largestProfile);
    if (!text)
        return text.error();
    return readProfileJson(*text);
}

Result<fs::path> findProfile(const std::string& name, const fs::path& beside)
{
    std::error_code error;
    if (fs::is_regular_file(name, error))
        return fs::path(name);
    std::vector<std::string> shipped;
    fs::path folder = fs::absolute(beside, error);
    for (int up = 0; up < 6 && !folder.empty(); ++up, folder = folder.parent_path())
        for (const fs::path& place : {folder / "profiles", folder / "share" / "pacini" / "profiles"})
        {
            if (const fs::path path = place / (name + ".json"); fs::is_regular_file(path, error))
                return path;
            for (fs::directory_iterator entry(place, error); !error && entry != fs::directory_iterator();
                 entry.increment(error))
                if (entry->path().extension() == ".json")
                    shipped.push_back(entry->path().stem().string());
        }
    std::string message = "is neither a file nor a shipped profile";
    if (!shipped.empty())
    {
        std::sort(shipped.begin(), shipped.end());
        shipped.erase(std::unique(shipped.begin(), shipped.end()), shipped.end());
        message += "; there are";
        for (const auto& s : shipped)
            message += " " + s;
    }
    return Error{ErrorCode::io, "", message};
}

} // namespace pacini
