#include "web/core/Call.h"

#include "io/ErrorCodeName.h"
#include "io/JsonTree.h"
#include "io/ProfileJson.h"
#include "io/formats/ClipFormat.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <utility>

namespace pacini::web
{

std::string_view Call::text(std::size_t input) const
{
    const auto bytes = given[input];
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::span<const float> Call::samples(std::size_t input) const
{
    // What allocate() gives is aligned for any type.
    const auto bytes = given[input];
    return {reinterpret_cast<const float*>(bytes.data()), bytes.size() / sizeof(float)};
}

void Call::put(std::string_view bytes)
{
    const auto all = std::as_bytes(std::span(bytes));
    outputs.emplace_back(all.begin(), all.end());
}

void Call::put(std::span<const float> samples)
{
    const auto all = std::as_bytes(samples);
    outputs.emplace_back(all.begin(), all.end());
}

double Call::number(const char* name, double usual, double low, double high)
{
    return optionalNumber(name, low, high).value_or(usual);
}

std::optional<double> Call::optionalNumber(const char* name, double low, double high)
{
    std::optional<double> value;
    reader.optionalNumber(name, value);
    if (value && !(*value >= low && *value <= high))
        reader.fail(name, fmt::format("must be {} to {}", low, high), ErrorCode::invalidArgument);
    return value;
}

bool Call::truth(const char* name, bool usual)
{
    reader.truth(name, usual);
    return usual;
}

std::string Call::word(const char* name, std::string_view usual)
{
    std::string value;
    reader.optionalText(name, value);
    return value.empty() ? std::string(usual) : value;
}

Result<void> Call::finishOptions()
{
    reader.finish();
    if (!reader.error)
        return {};
    reader.error->code = ErrorCode::invalidArgument;
    return *reader.error;
}

Result<Clip> clipOf(const Call& call, std::size_t input, std::string_view extension)
{
    const ClipFormat* format = clipFormatOf(extension, call.text(input));
    if (format == nullptr || !format->isRead())
        return Error{ErrorCode::invalidData, "",
                     format == nullptr ? "is no clip in a format that is read"
                                       : fmt::format("is of the format {}, which is only written", format->name)};
    auto read = format->read(call.text(input));
    if (!read)
        return read.error();
    return std::move(read->clip);
}

Result<Profile> profileOf(const Call& call, std::size_t input)
{
    return readProfileJson(call.text(input));
}

namespace
{
/// Result of the last call: its text is the value or the error.
struct Reply
{
    std::string text;
    std::vector<std::vector<std::byte>> outputs;
};

Reply& reply()
{
    static Reply last;
    return last;
}

Result<void> perform(std::string_view name, std::string_view options, std::vector<std::span<const std::byte>> inputs,
                     Pull pull)
{
    constexpr std::size_t longestOptions = 1'000'000;
    for (const NamedHandler& one : handlers())
    {
        if (one.name != name)
            continue;
        const auto document = readJsonTree(options, longestOptions);
        if (!document)
            return document.error();
        if (!document->is_object())
            return Error{ErrorCode::invalidArgument, "options", "must be an object"};
        Call call(*document, std::move(inputs), std::move(pull));
        call.value = Json::object();
        const auto done = one.handler(call);
        if (call.reader.error)
            return *call.reader.error;
        if (!done)
            return done;
        reply().text = call.value.dump(-1, ' ', false, Json::error_handler_t::replace);
        reply().outputs = std::move(call.outputs);
        return {};
    }
    return Error{ErrorCode::invalidArgument, std::string(name), "is no call"};
}
} // namespace

} // namespace pacini::web

// What the module exports, and what it imports beside the system's clock. One call at a time.
extern "C"
{
    /// Fills `samples`, which has room for so many frames, with the next of the sound of a call; how many came.
    [[clang::import_module("pacini"), clang::import_name("pull")]] std::uint32_t paciniPull(float* samples,
                                                                                            std::uint32_t frames);

    /// `inputs`: pairs of an address and a length. 0: done, else what is wrong is told as the value would be.
    [[clang::export_name("call")]] std::uint32_t paciniCall(const char* name, std::uint32_t nameLength,
                                                            const char* options, std::uint32_t optionsLength,
                                                            const std::uint32_t* inputs, std::uint32_t count,
                                                            std::uint32_t channels)
    {
        using namespace pacini;
        std::vector<std::span<const std::byte>> given;
        for (std::uint32_t i = 0; i < count; ++i)
            given.emplace_back(reinterpret_cast<const std::byte*>(inputs[2 * i]), inputs[2 * i + 1]);
        const auto pull = [channels](std::span<float> samples) -> std::size_t
        {
            return paciniPull(samples.data(), static_cast<std::uint32_t>(samples.size() / channels));
        };
        web::reply() = {};
        const auto done = web::perform({name, nameLength}, {options, optionsLength}, std::move(given), pull);
        if (done)
            return 0;
        const web::Json error{{"code", errorCodeName(done.error().code)},
                              {"where", done.error().where},
                              {"message", done.error().message}};
        web::reply().text = error.dump(-1, ' ', false, web::Json::error_handler_t::replace);
        return 1;
    }

    [[clang::export_name("replyText")]] const char* paciniReplyText()
    {
        return pacini::web::reply().text.data();
    }
    [[clang::export_name("replyTextLength")]] std::uint32_t paciniReplyTextLength()
    {
        return static_cast<std::uint32_t>(pacini::web::reply().text.size());
    }
    [[clang::export_name("replyOutputs")]] std::uint32_t paciniReplyOutputs()
    {
        return static_cast<std::uint32_t>(pacini::web::reply().outputs.size());
    }
    [[clang::export_name("replyOutput")]] const std::byte* paciniReplyOutput(std::uint32_t index)
    {
        return pacini::web::reply().outputs[index].data();
    }
    [[clang::export_name("replyOutputLength")]] std::uint32_t paciniReplyOutputLength(std::uint32_t index)
    {
        return static_cast<std::uint32_t>(pacini::web::reply().outputs[index].size());
    }
}
