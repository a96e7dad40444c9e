// What every machine must do to the last bit, by the core alone. Files hold little-endian numbers.
//
//   bytes RATE CHANNELS NAME CLIP DRIVE < SOUND: a sound to a packed clip, and that to a drive at 48 kHz
//
//   bytes again CLIP SAME UNSEALED: a packed clip, unpacked and packed as it is and without its seal
//
//   bytes grids VALUES: every value that a packed clip can hold; of the finest pitches every seventh
//
//   bytes functions VALUES: the portable functions of many arguments

#include <pacini/analysis/Encoder.h>
#include <pacini/clip/PackedClip.h>
#include <pacini/clip/Quantiser.h>
#include <pacini/foundation/Portable.h>
#include <pacini/foundation/Random.h>
#include <pacini/synthesis/CompilePlan.h>
#include <pacini/synthesis/ScenePlayer.h>

#include <complex>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <span>
#include <string>
#include <utility>
#include <vector>
#ifdef _WIN32
#include <fcntl.h>
#include <io.h>
#endif

using namespace pacini;

namespace
{

/// All of a file in pieces of at most `most` items.
template <typename T, typename Take>
void read(std::FILE* file, std::size_t most, Take&& take)
{
    std::vector<T> piece(most);
    while (const std::size_t n = std::fread(piece.data(), sizeof(T), most, file))
        take(std::span<const T>(piece).first(n));
}

template <typename T>
int write(const char* path, const std::vector<T>& content)
{
    std::FILE* file = std::fopen(path, "wb");
    const bool written =
        file != nullptr && std::fwrite(content.data(), sizeof(T), content.size(), file) == content.size();
    return file != nullptr && std::fclose(file) == 0 && written ? 0 : 1;
}

int encode(char** arguments)
{
    const int channels = std::atoi(arguments[1]);
    Encoder encoder(EncoderParams{});
    encoder.start(std::atoi(arguments[0]), channels);
    read<float>(stdin, 4096 * static_cast<std::size_t>(channels), [&](std::span<const float> x) { encoder.push(x); });
    Clip encoded = encoder.finish();
    encoded.source.file = arguments[2];
    encoded.name = encoded.source.file.substr(0, encoded.source.file.rfind('.'));
    const std::vector<std::byte> packed = packClip(encoded, packParamsFor(encoded));

    auto clip = unpackClip(packed);
    if (!clip)
        return 1;
    Scene scene;
    scene.clips = {std::move(*clip)};
    scene.plays = {ScenePlay{}};
    auto plan = compilePlan(scene);
    if (!plan)
        return 1;
    ScenePlayer player(std::move(*plan));
    std::vector<float> drive(static_cast<std::size_t>(player.totalFrames()));
    const std::span<float> channel = drive;
    player.process(std::span(&channel, 1));
    return write(arguments[3], packed) + write(arguments[4], drive);
}

int packAgain(char** arguments)
{
    std::vector<std::byte> packed;
    if (std::FILE* file = std::fopen(arguments[0], "rb"))
    {
        read<std::byte>(file, 4096,
                        [&](std::span<const std::byte> x) { packed.insert(packed.end(), x.begin(), x.end()); });
        std::fclose(file);
    }
    auto clip = unpackClip(packed);
    if (!clip)
        return 1;
    const int written = write(arguments[1], packClip(*clip, packParamsFor(*clip)));
    std::erase_if(clip->encoder, [](const EncoderParameter& parameter) { return parameter.name == "seal"; });
    return written + write(arguments[2], packClip(*clip, packParamsFor(*clip)));
}

int writeGrids(char** arguments)
{
    std::vector<double> values;
    for (int bits = 4; bits <= 16; ++bits)
    {
        const LevelQuantiser levels(bits);
        for (std::int64_t code = 0; code <= 2 * levels.topCode(); ++code)
            values.push_back(levels.value(code));
        const PitchQuantiser pitches(bits);
        const std::int64_t highest = pitches.code(PitchQuantiser::highest);
        for (std::int64_t code = pitches.code(1.0); code <= highest; code += bits > 12 ? 7 : 1)
            values.push_back(pitches.value(code));
    }
    return write(arguments[0], values);
}

int writeFunctions(char** arguments)
{
    std::vector<double> values;
    Random random(46);
    for (int i = 0; i < 20000; ++i)
    {
        const double x = random.uniform(-40.0, 40.0);
        const double y = random.uniform(0.0, 1000.0);
        const std::complex<double> turn = portable::turnBy(x);
        values.insert(values.end(), {turn.real(), turn.imag(), portable::sin(x), portable::cos(x), portable::tan(x),
                                     portable::pow(y, 0.1 * x), portable::exp(x), portable::exp2(x), portable::exp10(x),
                                     portable::log(y), portable::log2(y)});
    }
    return write(arguments[0], values);
}

} // namespace

int main(int count, char** arguments)
{
#ifdef _WIN32
    _setmode(_fileno(stdin), _O_BINARY);
#endif
    const std::string first = count > 1 ? arguments[1] : "";
    if (first == "grids" && count == 3)
        return writeGrids(arguments + 2);
    if (first == "functions" && count == 3)
        return writeFunctions(arguments + 2);
    if (first == "again" && count == 5)
        return packAgain(arguments + 2);
    return count == 6 ? encode(arguments + 1) : 2;
}
