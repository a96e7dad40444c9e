#include "io/StoredAudio.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>
#include <utility>

namespace pacini
{

namespace
{
constexpr float scale16 = 32768.0f;
constexpr float scale24 = 8388608.0f;

/// Whether `sample` is an integer of that many steps to full scale, and nothing else: -0 is not.
bool isExact(float sample, float scale)
{
    const float steps = sample * scale;
    return steps >= -scale && steps < scale && steps == std::nearbyint(steps) &&
           !(steps == 0.0f && std::signbit(sample));
}

std::int32_t integer24(const std::byte* bytes) noexcept
{
    const auto byte = [bytes](int i)
    {
        return std::to_integer<std::uint32_t>(bytes[i]);
    };
    // In the upper three bytes, so that the sign comes down with the shift.
    return std::bit_cast<std::int32_t>((byte(0) << 8u) | (byte(1) << 16u) | (byte(2) << 24u)) >> 8;
}
} // namespace

StoredAudio::StoredAudio(const AudioData& audio) : StoredAudio(audio.sampleRate, audio.channels)
{
    append(audio.samples);
    close();
    doubts = audio.warnings;
}

Result<StoredAudio> StoredAudio::read(const std::filesystem::path& path)
{
    auto opened = AudioReader::open(path, {.allowTruncated = true});
    if (!opened)
        return opened.error();
    StoredAudio sound(opened->sampleRate(), opened->channels());
    const auto channels = static_cast<std::size_t>(sound.channelCount);
    bool fits = true;
    const auto done = opened->forEachBlock(pieceSize / channels,
                                           [&](std::span<const float> block)
                                           {
                                               fits = sound.frames() + block.size() / channels <= limits::audioFrames;
                                               if (fits)
                                                   sound.append(block);
                                               return fits;
                                           });
    if (!done)
        return done.error();
    if (!fits)
        return tooManyFrames(limits::audioFrames);
    sound.close();
    sound.marked = opened->takeMarkers(sound.duration());
    sound.doubts = opened->warnings();
    return sound;
}

StoredAudio::Piece StoredAudio::packed(std::span<const float> samples)
{
    Piece piece;
    const auto all = [samples](auto&& is)
    {
        return std::all_of(samples.begin(), samples.end(), is);
    };
    if (all([](float s) { return std::bit_cast<std::uint32_t>(s) == 0; }))
        return piece;
    if (all([](float s) { return isExact(s, scale16); }))
    {
        piece.width = 2;
        piece.data.resize(2 * samples.size());
        for (std::size_t i = 0; i < samples.size(); ++i)
        {
            const auto value = static_cast<std::int16_t>(samples[i] * scale16);
            std::memcpy(piece.data.data() + 2 * i, &value, 2);
        }
        return piece;
    }
    if (all([](float s) { return isExact(s, scale24); }))
    {
        piece.width = 3;
        piece.data.resize(3 * samples.size());
        for (std::size_t i = 0; i < samples.size(); ++i)
        {
            const auto value = static_cast<std::uint32_t>(static_cast<std::int32_t>(samples[i] * scale24));
            for (std::size_t k = 0; k < 3; ++k)
                piece.data[3 * i + k] = static_cast<std::byte>((value >> (8u * k)) & 0xFFu);
        }
        return piece;
    }
    piece.width = 4;
    piece.data.resize(4 * samples.size());
    std::memcpy(piece.data.data(), samples.data(), piece.data.size());
    return piece;
}

void StoredAudio::append(std::span<const float> interleaved)
{
    assert(total % pieceSize == open.size());
    while (!interleaved.empty())
    {
        if (open.capacity() < pieceSize)
            open.reserve(pieceSize);
        const auto part = interleaved.first(std::min(interleaved.size(), pieceSize - open.size()));
        open.insert(open.end(), part.begin(), part.end());
        total += part.size();
        interleaved = interleaved.subspan(part.size());
        if (open.size() == pieceSize)
        {
            pieces.push_back(std::make_shared<const Piece>(packed(open)));
            open.clear();
        }
    }
}

/// The rest of a sound that has ended need not be floats.
void StoredAudio::close()
{
    if (open.empty())
        return;
    pieces.push_back(std::make_shared<const Piece>(packed(open)));
    std::vector<float>().swap(open); // an assignment would keep its memory
}

std::size_t StoredAudio::bytes() const noexcept
{
    std::size_t sum = open.capacity() * sizeof(float);
    for (const auto& piece : pieces)
        sum += piece->data.size();
    return sum;
}

void StoredAudio::Piece::unpack(std::size_t first, std::span<float> samples) const noexcept
{
    const std::byte* from = data.data() + width * first;
    switch (width)
    {
    case 0:
        std::fill(samples.begin(), samples.end(), 0.0f);
        break;
    case 2:
        for (std::size_t i = 0; i < samples.size(); ++i)
        {
            std::int16_t value = 0;
            std::memcpy(&value, from + 2 * i, 2);
            samples[i] = static_cast<float>(value) / scale16;
        }
        break;
    case 3:
        for (std::size_t i = 0; i < samples.size(); ++i)
            samples[i] = static_cast<float>(integer24(from + 3 * i)) / scale24;
        break;
    default:
        std::memcpy(samples.data(), from, 4 * samples.size());
    }
}

void StoredAudio::read(std::size_t first, std::span<float> interleaved) const noexcept
{
    std::uint64_t sample = std::uint64_t{first} * static_cast<std::uint64_t>(channelCount);
    while (!interleaved.empty())
    {
        const auto index = static_cast<std::size_t>(sample / pieceSize);
        const auto place = static_cast<std::size_t>(sample % pieceSize);
        const auto part = interleaved.first(std::min(interleaved.size(), pieceSize - place));
        if (index < pieces.size())
            pieces[index]->unpack(place, part);
        else
            std::copy_n(open.begin() + static_cast<std::ptrdiff_t>(place), part.size(), part.begin());
        sample += part.size();
        interleaved = interleaved.subspan(part.size());
    }
}

template <typename Reduce>
void StoredAudio::readMono(std::int64_t first, std::span<float> out, Reduce reduce) const noexcept
{
    std::array<float, 1024> buffer; // at least 16 frames: files have 64 channels at most
    const auto width = static_cast<std::size_t>(channelCount);
    const auto end = static_cast<std::int64_t>(frames());
    std::size_t done = 0;
    const auto silent = [&](std::int64_t count)
    {
        const auto n = std::min(out.size() - done, sizeInMemory(count));
        const auto part = out.subspan(done, n);
        std::fill(part.begin(), part.end(), 0.0f);
        done += n;
    };
    silent(-first);
    while (done < out.size())
    {
        const std::int64_t from = first + static_cast<std::int64_t>(done);
        if (from >= end)
            return silent(static_cast<std::int64_t>(out.size()));
        const std::size_t n = std::min({buffer.size() / width, out.size() - done, sizeInMemory(end - from)});
        read(static_cast<std::size_t>(from), std::span(buffer).first(n * width));
        for (std::size_t i = 0; i < n; ++i)
            out[done + i] = reduce(buffer.data() + i * width);
        done += n;
    }
}

void StoredAudio::readChannel(std::size_t channel, std::int64_t first, std::span<float> out) const noexcept
{
    readMono(first, out, [channel](const float* frame) { return frame[channel]; });
}

void StoredAudio::readMean(std::int64_t first, std::span<float> out) const noexcept
{
    readMono(first, out,
             [width = channelCount](const float* frame)
             {
                 float sum = 0.0f;
                 for (int c = 0; c < width; ++c)
                     sum += frame[c];
                 return sum / static_cast<float>(width);
             });
}

} // namespace pacini
