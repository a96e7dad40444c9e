#include "io/CueChunks.h"
#include "io/formats/ForeignText.h"
#include "io/formats/samples/DriveSamples.h"
#include "io/formats/samples/PcmFormat.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <utility>

namespace pacini
{

namespace
{
constexpr int usualRate = 8000;

void putLittleEndian(std::string& bytes, std::uint32_t value, int count)
{
    for (int i = 0; i < count; ++i)
        bytes += static_cast<char>((value >> (8 * i)) & 0xFFu);
}

/// `sample` in whole steps of full scale / 2^(bits - 1); 1 is one step too large and becomes the largest.
int stepsOf(float sample, int bits)
{
    const int full = 1 << (bits - 1);
    return std::min(static_cast<int>(std::lround(static_cast<double>(sample) * full)), full - 1);
}

std::string pcmBytes(const std::vector<float>& samples, int bits, bool isSigned)
{
    std::string bytes;
    bytes.reserve(samples.size() * static_cast<std::size_t>(bits / 8));
    const int offset = isSigned ? 0 : 1 << (bits - 1);
    for (const float sample : samples)
        putLittleEndian(bytes, static_cast<std::uint32_t>(stepsOf(sample, bits) + offset), bits / 8);
    return bytes;
}

/// A WAV file in memory (RIFF, format 1).
Result<std::string> wavBytes(const DriveSamples& drive, int bits, const std::vector<Marker>& markers)
{
    const std::string data = pcmBytes(drive.samples, bits, bits > 8);
    const std::string cues = cueChunks(markers, drive.sampleRate);
    constexpr std::size_t largest = 0xFFFF0000u;
    if (data.size() + cues.size() > largest)
        return Error{ErrorCode::tooLarge, "duration", "makes more than 4 GB"};
    const auto size = static_cast<std::uint32_t>(data.size());
    const auto frameBytes = static_cast<std::uint32_t>(bits / 8);
    const auto rate = static_cast<std::uint32_t>(drive.sampleRate);
    std::string wav = "RIFF";
    putLittleEndian(wav, 36 + size + (size & 1u) + static_cast<std::uint32_t>(cues.size()), 4);
    wav += "WAVEfmt ";
    putLittleEndian(wav, 16, 4);
    putLittleEndian(wav, 1, 2); // PCM
    putLittleEndian(wav, 1, 2); // channel
    putLittleEndian(wav, rate, 4);
    putLittleEndian(wav, rate * frameBytes, 4);
    putLittleEndian(wav, frameBytes, 2);
    putLittleEndian(wav, static_cast<std::uint32_t>(bits), 2);
    wav += "data";
    putLittleEndian(wav, size, 4);
    wav += data;
    if (size & 1u)
        wav += '\0'; // chunks have even lengths
    return wav + cues;
}

std::string upperCase(std::string name)
{
    for (char& c : name)
        c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    return name;
}
} // namespace

Result<ExportedClip> writeWav(const Clip& clip, const ExportParams& params, int bits)
{
    Clip rest = clip; // what is lost of it
    rest.markers.clear();
    auto drive = driveSamples(rest, params, usualRate);
    if (!drive)
        return drive.error();
    auto wav = wavBytes(*drive, bits, clip.markers);
    if (!wav)
        return wav.error();
    return oneFile(std::move(*wav), std::move(drive->losses));
}

Result<ExportedClip> writeRaw(const Clip& clip, const ExportParams& params, int bits)
{
    auto drive = driveSamples(clip, params, usualRate);
    if (!drive)
        return drive.error();
    return oneFile(pcmBytes(drive->samples, bits, true), std::move(drive->losses));
}

Result<ExportedClip> writeCArray(const Clip& clip, const ExportParams& params)
{
    auto drive = driveSamples(clip, params, usualRate);
    if (!drive)
        return drive.error();
    const std::string name = identifierOf(nameOfClip(clip, params.name));
    const std::vector<float> silence{0.0f}; // C has no empty arrays
    const std::vector<float>& samples = drive->samples.empty() ? silence : drive->samples;
    return oneFile(fmt::format("#ifndef HAPTIC_{0}_H\n#define HAPTIC_{0}_H\n\n#include <stdint.h>\n\n"
                               "#define HAPTIC_{0}_SAMPLE_RATE {1}\n#define HAPTIC_{0}_LENGTH {2}\n\n"
                               "static const int8_t haptic_{3}[HAPTIC_{0}_LENGTH] = {{{4}\n}};\n\n#endif\n",
                               upperCase(name), drive->sampleRate, samples.size(), name,
                               numbersInLines(samples, 20, [](float x) { return fmt::format("{}", stepsOf(x, 8)); })),
                   std::move(drive->losses));
}

} // namespace pacini
