#include "document/AudioReference.h"

#include "io/AtomicFile.h"
#include "io/InputFile.h"
#include "io/Overwrite.h"

#include <pacini/foundation/SizeInMemory.h>

#include <fmt/format.h>

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace pacini
{

namespace fs = std::filesystem;

namespace
{
constexpr std::size_t largestSound = sizeInMemory(std::uint64_t(4) << 30);

/// FNV-1a with 64 bits of bytes that come in parts.
class ContentHash
{
public:
    void add(std::string_view bytes) noexcept
    {
        for (const char c : bytes)
        {
            hash ^= static_cast<unsigned char>(c);
            hash *= 0x100000001B3ull;
        }
    }
    [[nodiscard]] std::string text() const { return fmt::format("{:016x}", hash); }

private:
    std::uint64_t hash = 0xCBF29CE484222325ull;
};

/// Hash and size of a file, which is never in memory as a whole: it may be much larger than its sound.
struct FileContent
{
    std::uint64_t bytes = 0;
    std::string hash;
};

Result<FileContent> contentOf(const fs::path& path)
{
    const auto file = openRewindable(path);
    if (!file)
        return file.error();
    ContentHash hash;
    FileContent content;
    std::vector<char> part(std::size_t(1) << 16);
    while (const std::size_t got = std::fread(part.data(), 1, part.size(), file->get()))
    {
        hash.add({part.data(), got});
        content.bytes += got;
    }
    if (std::ferror(file->get()) != 0)
        return fileError(errno);
    content.hash = hash.text();
    return content;
}

bool sameContent(const fs::path& path, const AudioReference& reference)
{
    std::error_code error;
    if (!fs::is_regular_file(path, error) || fs::file_size(path, error) != reference.bytes || error)
        return false;
    const auto content = contentOf(path);
    return content && content->hash == reference.hash;
}

/// A folder and those directly inside it.
std::vector<fs::path> withSubfolders(const fs::path& folder)
{
    constexpr std::size_t most = 1000; // a folder with more is not searched to the end: it may be anybody's
    std::vector<fs::path> all = {folder};
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end && all.size() < most;
         entry.increment(error))
        if (std::error_code ignored; entry->is_directory(ignored))
            all.push_back(entry->path());
    return all;
}
} // namespace

bool isFileOf(const AudioReference& reference, const fs::path& path)
{
    return isSameFile(reference.path, path) || sameContent(path, reference);
}

Result<DescribedAudio> describeAudio(const fs::path& path, bool embed)
{
    auto content = contentOf(path);
    if (!content)
        return content.error();
    auto audio = StoredAudio::read(path);
    if (!audio)
        return audio.error();
    DescribedAudio described;
    std::error_code error;
    described.reference.path = fs::absolute(path, error).lexically_normal();
    described.reference.bytes = content->bytes;
    described.reference.hash = std::move(content->hash);
    described.reference.sampleRate = audio->rate();
    described.reference.channels = audio->channels();
    described.reference.duration = audio->duration();
    if (embed)
    {
        auto bytes = readWholeFile(path, largestSound);
        if (!bytes)
            return bytes.error();
        described.reference.embedded = std::make_shared<const std::string>(std::move(*bytes));
    }
    described.audio = std::move(*audio);
    return described;
}

Result<LocatedAudio> locateAudio(const AudioReference& reference, std::span<const fs::path> folders)
{
    if (sameContent(reference.path, reference))
        return LocatedAudio{reference.path, false, false};
    for (const fs::path& folder : folders)
        for (const fs::path& inside : withSubfolders(folder))
            if (const fs::path candidate = inside / reference.path.filename(); sameContent(candidate, reference))
                return LocatedAudio{candidate, true, false};
    std::error_code error;
    if (fs::is_regular_file(reference.path, error))
        return LocatedAudio{reference.path, false, true};
    return Error{ErrorCode::io, reference.path.string(), "is missing; locate the sound to analyse the clip again"};
}

std::vector<AudioReference> foundBy(const fs::path& chosen, std::span<const AudioReference> missing)
{
    std::error_code error;
    const fs::path file = fs::absolute(chosen, error).lexically_normal();
    const std::vector<fs::path> folders = {file.parent_path()};
    std::vector<AudioReference> found;
    for (const AudioReference& sound : missing)
    {
        AudioReference here = sound;
        here.path = file;
        if (!sameContent(file, sound))
        {
            const auto located = locateAudio(sound, folders);
            if (!located || located->changed)
                continue;
            here.path = located->path;
        }
        found.push_back(std::move(here));
    }
    return found;
}

Result<StoredAudio> loadAudio(const AudioReference& reference, std::span<const fs::path> folders,
                              const fs::path& temporaryFolder)
{
    if (!reference.embedded)
    {
        const auto found = locateAudio(reference, folders);
        return found ? StoredAudio::read(found->path) : Result<StoredAudio>(found.error());
    }
    const fs::path file = temporaryFolder / (".sound-" + reference.hash + reference.path.extension().string());
    if (auto written = writeFileAtomically(file, std::string_view(*reference.embedded)); !written)
        return written.error();
    auto audio = StoredAudio::read(file);
    std::error_code ignored;
    fs::remove(file, ignored);
    return audio;
}

} // namespace pacini
