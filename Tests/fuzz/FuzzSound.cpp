// Any bytes are refused with a proper error or are a sound, which can be read to its end.

#include "FuzzFile.h"
#include "FuzzText.h"
#include "io/AudioReader.h"

#include <vector>

using namespace pacini;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const FuzzFile file(".wav");
    auto opened = AudioReader::open(file.with(data, size));
    if (!opened)
        return refused(opened.error());
    FUZZ_CHECK(opened->channels() > 0 && opened->sampleRate() > 0);
    std::vector<float> samples(4096 * static_cast<std::size_t>(opened->channels()));
    std::uint64_t frames = 0;
    while (frames < 200'000) // long ones take minutes
    {
        const auto read = opened->read(samples);
        if (!read || *read == 0)
            break;
        frames += *read;
    }
    const double duration = static_cast<double>(frames) / opened->sampleRate();
    double before = 0.0;
    for (const Marker& marker : opened->takeMarkers(duration))
    {
        FUZZ_CHECK(marker.time >= before && marker.time <= duration);
        before = marker.time;
    }
    return 0;
}
