// Command group for textures: from the recording of a stroke to noise that is played by speed and force.

#include "cli/CommandGroup.h"

namespace pacini::cli
{

std::unique_ptr<Command> textureCommand()
{
    return commandGroup("texture", "Make textures of recordings, and play them by speed and force",
                        {analyseTextureSubcommand, renderTextureSubcommand},
                        "From a recording to a drive signal of any length, which never repeats:\n"
                        "  pacini texture analyse stroke.wav --speed hand.csv -o wood.texture.json\n"
                        "  pacini texture render wood.texture.json --speed \"0:0 .5:1 1:.3\" -o drive.wav");
}

} // namespace pacini::cli
