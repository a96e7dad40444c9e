#include "cli/live/LiveFile.h"

#include "io/FileHandle.h"

#include <bit>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace pacini::cli
{

namespace
{
void append(std::string& bytes, std::uint32_t value, int count)
{
    for (int i = 0; i < count; ++i)
        bytes += static_cast<char>(value >> (8 * i) & 0xFFu);
}

/// The header of a WAV of unknown length.
std::string endlessHeader(std::uint32_t rate)
{
    std::string bytes = "RIFF";
    append(bytes, 0xFFFFFFFFu, 4);
    bytes += "WAVEfmt ";
    append(bytes, 16, 4);
    append(bytes, 3, 2); // floats
    append(bytes, 1, 2); // channel
    append(bytes, rate, 4);
    append(bytes, 4 * rate, 4);
    append(bytes, 4, 2);
    append(bytes, 32, 2);
    bytes += "data";
    append(bytes, 0xFFFFFFFFu, 4);
    return bytes;
}

Result<void> toStandardOutput(std::string_view bytes)
{
    if (std::fwrite(bytes.data(), 1, bytes.size(), stdout) != bytes.size() || std::fflush(stdout) != 0)
        return fileError(errno);
    return {};
}
} // namespace

Result<std::unique_ptr<LiveFile>> LiveFile::create(const std::filesystem::path& path, Existing existing,
                                                   live::LiveDrive& drive, double sampleRate)
{
    std::unique_ptr<LiveFile> file(new LiveFile(drive));
    const auto rate = static_cast<int>(std::lround(sampleRate));
    if (path == "-")
    {
        if (const auto done = toStandardOutput(endlessHeader(static_cast<std::uint32_t>(rate))); !done)
            return done.error();
    }
    else
    {
        AudioWriteParams params;
        params.sampleRate = rate;
        params.existing = existing;
        params.expectedFrames = AudioWriteParams::endless;
        auto created = AudioWriter::create(path, params);
        if (!created)
            return created.error();
        file->folder = std::filesystem::absolute(path).parent_path();
        file->writer.emplace(std::move(*created));
    }
    file->thread = std::thread([self = file.get()] { self->work(); });
    return file;
}

LiveFile::~LiveFile()
{
    dropped.store(true);
    if (thread.joinable())
        thread.join();
}

void LiveFile::work()
{
    std::vector<float> block(4096);
    while (!dropped.load())
    {
        const bool over = source.isOver(); // before the last look
        const std::size_t got = source.take(block);
        if (got == 0)
        {
            if (over)
                return;
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
            continue;
        }
        if (!result)
            continue; // whoever pushes must not wait for ever
        result = hasRoom(got) ? write(std::span(block).first(got))
                              : Error{ErrorCode::diskFull, "", "ends here, since the disk is full but for 16 MB"};
        if (result)
            frames += got;
        else
            failed.store(true, std::memory_order_release);
    }
}

bool LiveFile::hasRoom(std::size_t samples)
{
    constexpr std::size_t between = std::size_t{1} << 18; // samples, 1 MB
    constexpr std::uintmax_t least = 16'000'000;
    sinceLook += samples;
    if (!writer || sinceLook < between)
        return true;
    sinceLook = 0;
    std::error_code unknown;
    const auto space = std::filesystem::space(folder, unknown);
    return unknown || space.available >= least;
}

Result<void> LiveFile::write(std::span<const float> samples)
{
    if (writer)
        return writer->write(samples);
    std::string bytes;
    bytes.reserve(4 * samples.size());
    for (const float sample : samples)
        append(bytes, std::bit_cast<std::uint32_t>(sample), 4);
    return toStandardOutput(bytes);
}

Result<std::uint64_t> LiveFile::finish()
{
    if (thread.joinable())
        thread.join();
    // A recording that ended early is kept.
    if (writer)
        if (const auto done = writer->finish(); !done)
            return done.error();
    if (!writer && !result)
        return result.error();
    return frames;
}

} // namespace pacini::cli
