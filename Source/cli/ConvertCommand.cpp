#include "cli/ConvertCommand.h"

#include "cli/InputFiles.h"
#include "io/AcfFile.h"
#include "io/ClipFile.h"
#include "io/ProfileFile.h"

#include <pacini/clip/PackedClip.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <system_error>
#include <vector>

namespace pacini::cli
{

CLI::App* ConvertCommand::declare(CLI::App& app)
{
    auto* command =
        app.add_subcommand("convert", "Convert a clip between JSON and packed, or a profile between JSON and ACF");
    command->add_option("input", input, "Clip or profile to read; its content tells the format, but of .acf")
        ->required()
        ->type_name("IN");
    command->add_option("output", output, "What to write: .json or .pacb for a clip, .json or .acf for a profile")
        ->required()
        ->type_name("OUT");
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
    return hasAcfExtension(input) || isProfile(input) ? convertProfile(console) : convertClip(console);
}

bool ConvertCommand::overwritesInput(Console& console) const
{
    std::error_code unknown;
    if (!std::filesystem::equivalent(input, output, unknown))
        return false;
    console.error(output, {ErrorCode::invalidArgument, "", "is input and output; name another output"});
    return true;
}

Exit ConvertCommand::convertProfile(Console& console)
{
    const bool toAcf = hasAcfExtension(output);
    if (!format.empty() || quantise > 0)
    {
        console.error(input, {ErrorCode::invalidArgument, "", "is a profile; --format and --quantise are for clips"});
        return Exit::usage;
    }
    if (!toAcf && lowerExtension(output) != ".json")
    {
        console.error(output,
                      {ErrorCode::invalidArgument, "", "has neither the extension .json nor .acf, as a profile needs"});
        return Exit::usage;
    }
    std::vector<std::string> warnings;
    const auto read = [&]() -> Result<Profile>
    {
        if (!hasAcfExtension(input))
            return readProfile(input);
        auto imported = readAcfFile(input);
        if (!imported)
            return imported.error();
        warnings = std::move(imported->warnings);
        return std::move(imported->profile);
    };
    const auto profile = read();
    if (!profile)
    {
        console.error(input, profile.error());
        return Exit::failed;
    }
    if (overwritesInput(console))
        return Exit::failed;
    const auto write = [&]
    {
        if (!toAcf)
            return writeProfile(output, *profile);
        const auto exported = acfOfProfile(*profile);
        warnings.insert(warnings.end(), exported.warnings.begin(), exported.warnings.end());
        return writeAcfFile(output, exported.acf);
    };
    const auto written = write();
    if (!written)
    {
        console.error(output, written.error());
        return Exit::failed;
    }
    for (const std::string& warning : warnings)
        console.warning(input, warning);
    if (json)
        console.print(
            nlohmann::ordered_json{{"input", input}, {"output", output}, {"bytes", *written}, {"warnings", warnings}}
                .dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
    else
        console.note(fmt::format("{}: {}", printable(output), bytesText(static_cast<double>(*written))));
    return Exit::ok;
}

Exit ConvertCommand::convertClip(Console& console)
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
    if (overwritesInput(console))
        return Exit::failed;
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
