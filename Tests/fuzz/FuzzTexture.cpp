// Any text is refused with a proper error or describes a texture, comes back from its own text, and can be played.

#include "FuzzText.h"
#include "io/TextureFile.h"

#include <pacini/texture/TexturePlayer.h>

#include <array>
#include <cmath>
#include <memory>

using namespace pacini;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    return fuzzReader(
        data, size, [](std::string_view given) { return readTextureJson(given); },
        [](const Texture& texture, std::string_view)
        {
            FUZZ_CHECK(validate(texture).ok());
            const auto again = readTextureJson(textureJson(texture));
            FUZZ_CHECK(again.ok() && *again == texture);
            TexturePlayer player(std::make_shared<const TextureTable>(texture, 8000.0));
            std::array<float, 400> played{};
            for (const double speed : {1.0, 1e-6, 0.3})
            {
                player.setSpeed(speed);
                player.process(played);
                for (const float sample : played)
                    FUZZ_CHECK(std::isfinite(sample));
            }
        });
}
