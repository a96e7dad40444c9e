#include "io/Acf.h"

#include "io/Json5Text.h"
#include "io/JsonText.h"
#include "io/JsonTree.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <optional>
#include <utility>

namespace pacini
{

namespace
{
using Json = nlohmann::json;

constexpr std::array<std::string_view, 4> shapes{"saw", "sine", "square", "triangle"};

/// Reads entries by their path and remembers the first thing that is wrong.
class Reader
{
public:
    explicit Reader(const Json& document) : root(document) {}

    std::optional<Error> error;

    /// The object at a path; null when there is none, which is an error if it is required.
    const Json* object(std::string_view path, bool required = true)
    {
        const Json* found = &root;
        for (std::size_t start = 0; found != nullptr && start <= path.size();)
        {
            const auto end = std::min(path.find('.', start), path.size());
            const auto entry = found->find(std::string(path.substr(start, end - start)));
            if (entry == found->end() || (!required && entry->is_null()))
            {
                if (required)
                    fail(std::string(path.substr(0, end)), "is missing");
                return nullptr;
            }
            if (!entry->is_object())
            {
                fail(std::string(path.substr(0, end)), "must be an object in braces");
                return nullptr;
            }
            found = &*entry;
            start = end + 1;
        }
        return found;
    }

    void number(std::string_view path, const char* name, double& value, double low, double high, bool required)
    {
        const Json* entry = find(path, name, required);
        if (entry == nullptr)
            return;
        if (!entry->is_number())
            return fail(fmt::format("{}.{}", path, name), "must be a number");
        value = entry->get<double>();
        if (!(value >= low && value <= high))
            fail(fmt::format("{}.{}", path, name), fmt::format("must be {} to {}", low, high));
    }

    void text(std::string_view path, const char* name, std::string& value)
    {
        const Json* entry = find(path, name, false);
        if (entry == nullptr)
            return;
        if (!entry->is_string())
            return fail(fmt::format("{}.{}", path, name), "must be a text in quotes");
        value = entry->get<std::string>();
    }

    void shape(std::string_view path, AcfShape& value)
    {
        const Json* entry = find(path, "shape", true);
        if (entry == nullptr)
            return;
        for (std::size_t i = 0; i < shapes.size(); ++i)
            if (*entry == shapes[i])
            {
                value = static_cast<AcfShape>(i);
                return;
            }
        fail(fmt::format("{}.shape", path), "must be saw, sine, square or triangle");
    }

    void fail(std::string where, std::string message)
    {
        if (!error)
            error = Error{ErrorCode::invalidData, std::move(where), std::move(message)};
    }

private:
    const Json* find(std::string_view path, const char* name, bool required)
    {
        const Json* parent = object(path, required);
        if (parent == nullptr)
            return nullptr;
        const auto entry = parent->find(name);
        if (entry == parent->end() && required)
            fail(fmt::format("{}.{}", path, name), "is missing");
        const bool counts = entry != parent->end() && (required || !entry->is_null());
        return counts ? &*entry : nullptr;
    }

    const Json& root;
};
} // namespace

Result<Acf> readAcf(std::string_view text)
{
    const auto json = jsonFromJson5(text, largestAcfText);
    if (!json)
        return json.error();
    // Escapes and added quotes make the strict text longer, at most six bytes for one.
    const auto document = readJsonTree(*json, 6 * largestAcfText);
    if (!document)
        return document.error();
    if (!document->is_object())
        return Error{ErrorCode::invalidData, "", "is not an ACF file, as it is not an object in braces"};

    constexpr bool required = true;
    Acf acf;
    Reader read(*document);
    read.text("metadata", "version", acf.version);
    read.text("metadata", "device", acf.device);
    read.text("metadata", "date", acf.date);
    read.text("metadata", "author", acf.author);
    read.number("continuous", "gain", acf.continuousGain, 0.0, 1.0, !required);
    read.number("continuous", "emphasis_ducking", acf.emphasisDucking, 0.0, 1.0, !required);
    read.number("continuous", "frequency_min", acf.lowFrequency, 1.0, 20000.0, required);
    read.number("continuous", "frequency_max", acf.highFrequency, 1.0, 20000.0, required);
    if (acf.lowFrequency > acf.highFrequency)
        read.fail("continuous.frequency_max", "must not be below frequency_min");
    read.number("emphasis", "gain", acf.emphasisGain, 0.0, 1.0, !required);
    read.number("emphasis", "fade_out_percent", acf.fadeOutPercent, 0.0, 100.0, !required);
    for (std::size_t i = 0; i < acf.ends.size(); ++i)
    {
        const std::string_view path = i == 0 ? "emphasis.frequency_min" : "emphasis.frequency_max";
        read.number(path, "output_frequency", acf.ends[i].frequency, 1.0, 2000.0, required);
        read.number(path, "duration_ms", acf.ends[i].duration, 0.1, 10000.0, required);
        read.shape(path, acf.ends[i].shape);
    }
    if (read.error)
        return *read.error;
    return acf;
}

std::string acfText(const Acf& acf)
{
    const auto quoted = [](const std::string& value)
    {
        return Json(value).dump(-1, ' ', false, Json::error_handler_t::replace);
    };
    std::string metadata;
    for (const auto& [name, value] : {std::pair("version", &acf.version), std::pair("device", &acf.device),
                                      std::pair("date", &acf.date), std::pair("author", &acf.author)})
        if (!value->empty())
            metadata += fmt::format("{}\n    \"{}\": {}", metadata.empty() ? "" : ",", name, quoted(*value));
    const auto end = [](const AcfEmphasisEnd& e)
    {
        return fmt::format("{{ \"output_frequency\": {:.6g}, \"duration_ms\": {:.6g}, \"shape\": \"{}\" }}",
                           e.frequency, e.duration, shapes[static_cast<std::size_t>(e.shape)]);
    };
    return fmt::format("{{\n"
                       "  \"metadata\": {{{}\n  }},\n"
                       "  \"continuous\": {{\n"
                       "    \"gain\": {:.6g},\n"
                       "    \"emphasis_ducking\": {:.6g},\n"
                       "    \"frequency_min\": {:.6g},\n"
                       "    \"frequency_max\": {:.6g}\n"
                       "  }},\n"
                       "  \"emphasis\": {{\n"
                       "    \"gain\": {:.6g},\n"
                       "    \"fade_out_percent\": {:.6g},\n"
                       "    \"frequency_min\": {},\n"
                       "    \"frequency_max\": {}\n"
                       "  }}\n"
                       "}}\n",
                       metadata, acf.continuousGain, acf.emphasisDucking, acf.lowFrequency, acf.highFrequency,
                       acf.emphasisGain, acf.fadeOutPercent, end(acf.ends[0]), end(acf.ends[1]));
}

} // namespace pacini
