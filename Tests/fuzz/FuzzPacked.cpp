// Any bytes are either refused with a proper error or are a clip that packs and unpacks to itself. The first byte
// chooses whether the rest is a whole file or a payload that gets a valid header: a checksum would keep the fuzzer out.

#include "FuzzText.h"

#include <pacini/clip/PackedClip.h>

#include <cstddef>
#include <cstdint>
#include <vector>

using namespace pacini;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    if (size == 0)
        return 0;
    const std::vector<std::byte> rest(reinterpret_cast<const std::byte*>(data) + 1,
                                      reinterpret_cast<const std::byte*>(data) + size);
    const auto clip = unpackClip((data[0] & 1u) != 0 ? rest : detail::withHeader(rest));
    if (!clip)
        return refused(clip.error());
    FUZZ_CHECK(validate(*clip).ok());
    // A few random bytes can hold thousands of points; packing those again teaches nothing new and takes longest.
    if (breakpointCount(*clip) > 200)
        return 0;
    const PackParams params{16, 1000};
    const auto packed = packClip(*clip, params);
    const auto again = unpackClip(packed);
    FUZZ_CHECK(again.ok());
    FUZZ_CHECK(packClip(*again, params) == packed);
    FUZZ_CHECK(breakpointCount(*again) == breakpointCount(*clip));
    return 0;
}
