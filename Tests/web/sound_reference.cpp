// What the package is to read of sound files: sound_reference < names > lines of rate, channels, frames, a hash of the
// samples, and the warnings, with tabs between them; or `error` and what is wrong.

#include "io/AudioReader.h"

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <iostream>
#include <span>
#include <string>

int main()
{
    using namespace pacini;
    for (std::string name; std::getline(std::cin, name);)
    {
        auto reader = AudioReader::open(
            name, {.allowTruncated = true, .keepNan = true, .lowestSampleRate = limits::slowestSound});
        std::uint64_t frames = 0;
        std::uint32_t hash = 0x811C9DC5u; // FNV-1a
        const auto add = [&](std::span<const float> block)
        {
            frames += block.size() / static_cast<std::size_t>(reader->channels());
            for (const std::byte one : std::as_bytes(block))
                hash = (hash ^ static_cast<std::uint32_t>(one)) * 0x01000193u;
            return true;
        };
        const auto read = reader ? reader->forEachBlock(4096, add) : Result<void>(reader.error());
        if (!read)
        {
            std::printf("error\t%s\n", read.error().message.c_str());
            continue;
        }
        // Slow sounds are told of where they are raised.
        AudioReader* told = &*reader;
        auto raised = AudioReader::open(name, {.allowTruncated = true, .keepNan = true});
        if (reader->sampleRate() < limits::lowestSampleRate && raised &&
            raised->forEachBlock(4096, [](std::span<const float>) { return true; }))
            told = &*raised;
        std::printf("%d\t%d\t%llu\t%u", reader->sampleRate(), reader->channels(),
                    static_cast<unsigned long long>(frames), hash);
        const auto markers = told->takeMarkers(static_cast<double>(frames) / reader->sampleRate());
        for (const Marker& marker : markers)
            std::printf("\t%.9f %s", marker.time, marker.name.c_str());
        for (const std::string& warning : told->warnings())
            std::printf("\t%s", warning.c_str());
        std::printf("\n");
    }
    return 0;
}
