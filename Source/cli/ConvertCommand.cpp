#include "cli/ConvertCommand.h"

#include "cli/InputFiles.h"
#include "io/ClipFile.h"

#include <pacini/clip/PackedClip.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <system_error>

namespace pacini::cli
{

CLI::App* ConvertCommand::declare(CLI::App& app)
{
    auto* command = app.add_subcommand("convert", "Convert a clip between JSON and packed");
    command->add_option("input", input, "Clip to read; its content tells the format")->required()->type_name("IN");
    command->add_option("output", output, "Clip to write: .json or .pacb")->required()->type_name("OUT");
    command->add_option("--format", format, "json or packed [by the extension of OUT]")
        ->check(CLI::IsMember({"json", "packed"}));
    command
        ->add_option("--quantise", quantise,
                     "Bits of each value of a packed clip, 4 to 16 [those the clip was encoded with, else 12]")
        ->check(CLI::Range(4, 16));
    command->add_flag("--json", json, "Print a report as one JSON object");
    return command;
}

Exit ConvertCommand::run(Console& console)
{
    ClipFormat target = ClipFormat::json;
    const std::string extension = lowerExtension(output);
    if (format == "packed" || (format.empty() && extension == ".pacb"))
        target = ClipFormat::packed;
    else if (format.empty() && extension != ".json")
    {
        console.error(output, {ErrorCode::invalidArgument, "",
                               "has neither the extension .json nor .pacb; say --format json or --format packed"});
        return Exit::usage;
    }
    auto clip = readClip(input);
    if (!clip)
    {
        console.error(input, clip.error());
        return Exit::failed;
    }
    if (std::error_code unknown; std::filesystem::equivalent(input, output, unknown))
    {
        console.error(output, {ErrorCode::invalidArgument, "", "is input and output; name another output"});
        return Exit::failed;
    }
    if (quantise > 0)
        setQuantise(*clip, quantise);
    const auto written = writeClip(output, *clip, target);
    if (!written)
    {
        console.error(output, written.error());
        return Exit::failed;
    }
    if (json)
        console.print(nlohmann::ordered_json{
            {"input", input}, {"output", output}, {"bytes", *written}, {"duration", clip->duration}}
                          .dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
    else
        console.note(fmt::format("{}: {}", printable(output), bytesText(static_cast<double>(*written))));
    return Exit::ok;
}

} // namespace pacini::cli
