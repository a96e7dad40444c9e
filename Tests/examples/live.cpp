// Sound to drive while it plays: live RATE < mono.f32 > drive.f32, in blocks of 64 frames

#include <pacini/realtime/Translator.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <span>

int main(int count, char** arguments)
{
    const double rate = count > 1 ? std::atof(arguments[1]) : 48000.0;
    std::array<float, 64> block;

    pacini::Translator translator; // what follows allocates; process() does not
    translator.prepare({rate, block.size()});
    pacini::TranslatorParams params;
    params.intensity = 3.0; // dB
    translator.setParams(params);
    std::fprintf(stderr, "%zu frames late, %.2f ms\n", translator.latencyFrames(),
                 1000.0 * static_cast<double>(translator.latencyFrames()) / rate);

    while (const std::size_t n = std::fread(block.data(), sizeof(float), block.size(), stdin))
    {
        const auto frames = std::span(block).first(n);
        translator.process(frames, frames);
        if (std::fwrite(block.data(), sizeof(float), n, stdout) != n)
            return 1;
    }
    return 0;
}
