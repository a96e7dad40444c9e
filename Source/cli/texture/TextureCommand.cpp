// Command group for textures.

#include "cli/CommandGroup.h"

#include <memory>

namespace pacini::cli
{

namespace
{
/// `pacini texture`: from the recording of a stroke to noise that is played by speed and force.
struct TextureCommand : CommandGroup
{
    CLI::App* declare(CLI::App& app) override;
};
} // namespace

CLI::App* TextureCommand::declare(CLI::App& app)
{
    auto* command = app.add_subcommand("texture", "Make textures of recordings, and play them by speed and force");
    command->require_subcommand(1);
    for (const auto make : {analyseTextureSubcommand, renderTextureSubcommand})
        addStep(*command, make());
    return command->footer("From a recording to a drive signal of any length, which never repeats:\n"
                           "  pacini texture analyse stroke.wav --speed hand.csv -o wood.texture.json\n"
                           "  pacini texture render wood.texture.json --speed \"0:0 .5:1 1:.3\" -o drive.wav");
}

std::unique_ptr<Command> textureCommand()
{
    return std::make_unique<TextureCommand>();
}

} // namespace pacini::cli
