// The calls `read`, `write`, `formats`, `exportParameters`, `profile` and `lint`: conversion of clips between formats,
// with the losses.

#include "io/formats/ClipFormat.h"
#include "io/formats/ExportParameters.h"
#include "web/core/Call.h"

#include <optional>
#include <string>
#include <utility>

namespace pacini::web
{

namespace
{
Json lossesOf(const std::vector<FormatLoss>& losses)
{
    Json list = Json::array();
    for (const FormatLoss& loss : losses)
        list.push_back({{"kind", lossName(loss.kind)},
                        {"time", loss.time},
                        {"duration", loss.duration},
                        {"error", loss.error},
                        {"message", loss.message}});
    return list;
}

/// The export that a call asks for: the clip is the first input, the profile, where there is one, the second.
Result<ExportedClip> exported(Call& call)
{
    const std::string name = call.word("format", "json");
    const ClipFormat* format = clipFormatNamed(name);
    if (format == nullptr || !format->isWritten())
        return Error{ErrorCode::invalidArgument, "format",
                     fmt::format("'{}' is not a format that can be written; formats() lists them", name)};
    GivenParameters given;
    readParameters(call.reader, exportParameterInfos(), given);
    const std::string title = call.word("name", "");
    const std::string extension = call.word("extension", "");
    if (auto known = call.finishOptions(); !known)
        return known.error();
    std::optional<Profile> profile;
    if (call.inputs() > 1)
    {
        auto read = profileOf(call, 1);
        if (!read)
            return read.error();
        profile = std::move(*read);
    }
    auto params = exportParamsOf(*format, given, std::move(profile));
    if (!params)
        return params.error();
    params->name = title;
    const auto clip = clipOf(call, 0, extension);
    if (!clip)
        return clip.error();
    return format->write(*clip, *params);
}
} // namespace

Result<void> readClipBytes(Call& call)
{
    const std::string extension = call.word("extension", "");
    const ClipFormat* format = clipFormatOf(extension, call.text(0));
    if (format == nullptr || !format->isRead())
        return Error{ErrorCode::invalidData, "", "is no clip in a format that is read"};
    auto read = format->read(call.text(0), call.truth("strict", false));
    if (!read)
        return read.error();
    const auto json = jsonFormat().write(read->clip);
    if (!json)
        return json.error();
    call.put(json->files.front().bytes);
    call.value["format"] = format->name;
    call.value["warnings"] = read->warnings;
    return {};
}

Result<void> writeClipBytes(Call& call)
{
    const auto made = exported(call);
    if (!made)
        return made.error();
    Json suffixes = Json::array();
    for (const ExportedFile& file : made->files)
    {
        call.put(file.bytes);
        suffixes.push_back(file.suffix);
    }
    call.value["suffixes"] = std::move(suffixes);
    call.value["losses"] = lossesOf(made->losses);
    return {};
}

Result<void> listFormats(Call& call)
{
    Json list = Json::array();
    for (const FormatDescription& format : formatDescriptions())
        list.push_back({{"name", format.name},
                        {"title", format.title},
                        {"extension", format.extension},
                        {"keeps", format.keeps},
                        {"reads", format.isRead},
                        {"writes", format.isWritten},
                        {"samples", format.isSamples}});
    call.value["formats"] = std::move(list);
    return {};
}

Result<void> describeExports(Call& call)
{
    call.value["parameters"] = exportDescriptionsJson();
    return {};
}

Result<void> describeProfile(Call& call)
{
    const auto profile = profileOf(call, 0);
    if (!profile)
        return profile.error();
    call.value = {{"name", profile->name},
                  {"low", profile->range.lowFrequency},
                  {"high", profile->range.highFrequency},
                  {"dynamicRange", profile->range.dynamicRange},
                  {"felt", profile->body.has_value()}};
    return {};
}

Result<void> lintClip(Call& call)
{
    const auto made = exported(call);
    if (!made)
        return made.error();
    call.value["losses"] = lossesOf(made->losses);
    return {};
}

} // namespace pacini::web
