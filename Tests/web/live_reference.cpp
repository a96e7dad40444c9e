// What the live translator of the package is to give: live_reference RATE PROFILE.json [SETTINGS.json] < mono.f32 >
// drive.f32, in blocks of 128 frames as Web Audio has them.

#include "io/LiveSettings.h"
#include "io/ProfileJson.h"

#include <pacini/realtime/Translator.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <span>
#include <string>

namespace
{
std::string textOf(const char* name)
{
    std::ifstream file(name);
    return {std::istreambuf_iterator<char>(file), {}};
}
} // namespace

int main(int count, char** arguments)
{
    if (count != 3 && count != 4)
        return 2;
    auto profile = pacini::readProfileJson(textOf(arguments[2]));
    if (!profile)
        return 1;
    pacini::TranslatorSetup setup;
    setup.profile = *profile;
    pacini::ProcessSpec spec;
    spec.sampleRate = std::atof(arguments[1]);
    pacini::Translator translator;
    translator.setSetup(setup);
    translator.prepare(spec);
    if (count == 4)
    {
        const auto settings = pacini::readSettings(textOf(arguments[3]));
        const auto params =
            settings ? pacini::liveParamsOf(*settings) : pacini::Result<pacini::TranslatorParams>(settings.error());
        if (!params)
            return 1;
        translator.setParams(*params);
    }
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
