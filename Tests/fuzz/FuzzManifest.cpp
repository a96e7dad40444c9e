// Any bytes are no manifest, or one whose own text says the same.

#include "FuzzFile.h"
#include "cli/Manifest.h"

using namespace pacini;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const FuzzFile file(".json");
    const auto manifest = cli::readManifest(file.with(data, size));
    if (!manifest)
        return 0;
    const std::string text = cli::manifestText(*manifest);
    const auto again = cli::readManifest(file.with(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
    FUZZ_CHECK(again.has_value());
    FUZZ_CHECK(cli::manifestText(*again) == text);
    return 0;
}
