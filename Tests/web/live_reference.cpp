// What the live translator of the audio worklet is to give: live_reference RATE PROFILE.json < mono.f32 > drive.f32, in
// blocks of 128 frames as Web Audio has them.

#include "io/ProfileJson.h"

#include <pacini/realtime/Translator.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <span>
#include <string>

int main(int count, char** arguments)
{
    if (count != 3)
        return 2;
    std::ifstream file(arguments[2]);
    const std::string text((std::istreambuf_iterator<char>(file)), {});
    auto profile = pacini::readProfileJson(text);
    if (!profile)
        return 1;
    pacini::TranslatorSetup setup;
    setup.profile = *profile;
    pacini::ProcessSpec spec;
    spec.sampleRate = std::atof(arguments[1]);
    pacini::Translator translator;
    translator.setSetup(setup);
    translator.prepare(spec);
    translator.reset();
    std::array<float, 128> block{};
    while (const std::size_t n = std::fread(block.data(), sizeof(float), block.size(), stdin))
    {
        const auto frames = std::span(block).first(n);
        translator.process(frames, frames);
        if (std::fwrite(block.data(), sizeof(float), n, stdout) != n)
            return 1;
    }
    return 0;
}
