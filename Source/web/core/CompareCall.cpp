// The call `compare`: how close a haptic signal is to its sound, by all measures.

#include "web/core/Call.h"

#include <pacini/evaluate/ComparisonReport.h>

#include <cmath>
#include <concepts>
#include <optional>

namespace pacini::web
{

namespace
{
/// Sink of a report that fills an object.
struct JsonSink
{
    Json& object;

    void value(std::string_view name, bool value) { object[std::string(name)] = value; }
    template <typename Value>
    requires std::integral<Value> || std::floating_point<Value>
    void value(std::string_view name, Value value)
    {
        const auto number = static_cast<double>(value);
        object[std::string(name)] = std::isfinite(number) ? Json(number) : Json();
    }
    template <typename Value>
    void value(std::string_view name, const std::optional<Value>& optional)
    {
        if (optional)
            value(name, *optional);
        else
            none(name);
    }
    void none(std::string_view name) { object[std::string(name)] = nullptr; }
    void group(std::string_view name, auto&& fill)
    {
        Json inner = Json::object();
        JsonSink sink{inner};
        fill(sink);
        object[std::string(name)] = std::move(inner);
    }
};
} // namespace

Result<void> compareSounds(Call& call)
{
    const double rate = call.number("sampleRate", 0.0, 2000.0, 768000.0);
    const double candidateRate = call.number("candidateRate", rate, 2000.0, 768000.0);
    const bool allowNan = call.truth("allowNan", false);
    if (call.reader.error)
        return {};
    Comparer comparer(allowNan ? UnsoundFrames::silence : UnsoundFrames::refuse);
    if (auto done = comparer.setReference(call.samples(0), static_cast<int>(rate)); !done)
        return done.error();
    if (auto done = comparer.setCandidate(call.samples(1), static_cast<int>(candidateRate)); !done)
        return done.error();
    JsonSink sink{call.value};
    reportComparison(comparer.compare(), sink);
    return {};
}

} // namespace pacini::web
