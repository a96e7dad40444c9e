// Any text is refused with a proper error or is a state of the plugin, which comes back from its own text.

#include "FuzzText.h"
#include "plugin/engine/PluginState.h"

using namespace pacini;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::string_view text = fuzzedText(data, size);
    if (!isReadOrRefused(text, [](std::string_view given) { return plugin::readState(given); }))
        return 0;
    const auto read = plugin::readState(text);
    const std::string written = plugin::stateText(read->state);
    const auto again = plugin::readState(written);
    FUZZ_CHECK(again.ok());
    FUZZ_CHECK(plugin::stateText(again->state) == written);
    return 0;
}
