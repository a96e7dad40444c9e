// Sound to clip: encode RATE < mono.f32 > clip.pacb

#include <pacini/analysis/Encoder.h>
#include <pacini/clip/PackedClip.h>

#include <cstdio>
#include <cstdlib>
#include <span>
#include <vector>

int main(int count, char** arguments)
{
    const int rate = count > 1 ? std::atoi(arguments[1]) : 48000;
    pacini::EncoderParams params;
    if (const auto valid = pacini::validate(params); !valid || rate < 8000 || rate > 768000)
        return std::fprintf(stderr, "encode: the rate must be 8000 to 768000 Hz\n"), 2;

    pacini::Encoder encoder(params);
    encoder.start(rate, 1);
    std::vector<float> block(4096);
    while (const std::size_t n = std::fread(block.data(), sizeof(float), block.size(), stdin))
        encoder.push(std::span(block).first(n));
    const pacini::Clip clip = encoder.finish();

    const auto bytes = pacini::packClip(clip, pacini::packParamsFor(clip));
    std::fprintf(stderr, "%.2f s, %zu bands, %zu events, %zu bytes\n", clip.duration, clip.bands.size(),
                 clip.transients.size(), bytes.size());
    return std::fwrite(bytes.data(), 1, bytes.size(), stdout) == bytes.size() ? 0 : 1;
}
