// Any text is refused with a proper error or is a state of the plugin, which comes back from its own text.

#include "FuzzText.h"
#include "plugin/engine/PluginState.h"

using namespace pacini;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    return fuzzReader(
        data, size, [](std::string_view given) { return plugin::readState(given); },
        [](const auto& read, std::string_view)
        {
            const std::string written = plugin::stateText(read.state);
            const auto again = plugin::readState(written);
            FUZZ_CHECK(again.ok());
            FUZZ_CHECK(plugin::stateText(again->state) == written);
        });
}
