#include "document/Autosave.h"

#include "document/ProcessId.h"
#include "document/ProjectJson.h"
#include "io/AtomicFile.h"
#include "io/InputFile.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <charconv>
#include <string_view>
#include <system_error>
#include <utility>

namespace pacini
{

namespace fs = std::filesystem;

namespace
{
constexpr std::string_view extension = ".pacini-recovery";
constexpr std::string_view soundExtension = ".sound";

double now()
{
    using namespace std::chrono;
    return duration<double>(system_clock::now().time_since_epoch()).count();
}

/// `PID-N-T.pacini-recovery`: its own among all documents of all running programs.
std::string newName()
{
    static std::atomic<int> number{0};
    return fmt::format("{}-{}-{:x}{}", processId(), ++number, static_cast<std::uint64_t>(now() * 1e6), extension);
}

/// The process in a name of ours, or of a temporary of it.
std::optional<std::int64_t> processOf(std::string_view name)
{
    if (name.starts_with('.'))
        name.remove_prefix(1);
    std::int64_t id = 0;
    const auto parsed = std::from_chars(name.data(), name.data() + name.size(), id);
    if (parsed.ec != std::errc() || parsed.ptr == name.data() + name.size() || *parsed.ptr != '-')
        return std::nullopt;
    return id;
}

std::vector<fs::path> filesOf(const fs::path& folder)
{
    std::vector<fs::path> files;
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
        files.push_back(entry->path());
    return files;
}

void removeOrphanedSounds(const fs::path& folder)
{
    const auto files = filesOf(folder);
    const auto isRecovery = [](const fs::path& file)
    {
        return file.extension() == fs::path(extension);
    };
    if (std::any_of(files.begin(), files.end(), isRecovery))
        return;
    std::error_code ignored;
    for (const fs::path& file : files)
        if (file.extension() == fs::path(soundExtension))
            fs::remove(file, ignored);
}

void removeRecovery(const fs::path& file)
{
    std::error_code ignored;
    fs::remove(file, ignored);
    removeOrphanedSounds(file.parent_path());
}
} // namespace

Result<void> writeRecovery(const fs::path& file, const DocumentSnapshot& snapshot)
{
    std::error_code error;
    fs::create_directories(file.parent_path(), error);
    for (const AudioReference& source : snapshot.project.sources)
        if (source.embedded)
        {
            const fs::path sound = file.parent_path() / (source.hash + std::string(soundExtension));
            if (fs::exists(sound, error))
                continue;
            if (auto written = writeFileAtomically(sound, std::string_view(*source.embedded)); !written)
                return written.error();
        }
    const auto path = snapshot.path.generic_u8string();
    const RecoveryNote note{std::string(path.begin(), path.end()), now(), static_cast<double>(processId())};
    ProjectTextOptions options;
    options.embed = false;
    options.recovery = &note;
    if (auto written = writeFileAtomically(file, std::string_view(projectJson(snapshot.project, options))); !written)
        return written.error();
    return {};
}

Autosave::Autosave(fs::path recoveryFolder, std::chrono::milliseconds writeInterval)
    : folder(std::move(recoveryFolder)),
      recoveryFile(folder / newName()),
      interval(writeInterval),
      thread([this] { run(); })
{
}

Autosave::~Autosave()
{
    {
        const std::lock_guard lock(mutex);
        ending = true;
    }
    changed.notify_all();
    thread.join();
}

void Autosave::update(DocumentSnapshot snapshot)
{
    {
        const std::lock_guard lock(mutex);
        waiting = std::move(snapshot);
    }
    changed.notify_all();
}

void Autosave::flush()
{
    std::unique_lock lock(mutex);
    flushing = true;
    changed.notify_all();
    changed.wait(lock, [this] { return !writing && (!waiting || failure); });
    flushing = false;
}

void Autosave::discard()
{
    std::unique_lock lock(mutex);
    waiting.reset();
    changed.wait(lock, [this] { return !writing; });
    failure.reset();
    removeRecovery(recoveryFile);
}

std::optional<Error> Autosave::lastError() const
{
    const std::lock_guard lock(mutex);
    return failure;
}

void Autosave::run()
{
    std::unique_lock lock(mutex);
    for (;;)
    {
        changed.wait(lock, [this] { return ending || waiting; });
        if (!waiting)
            return;
        const DocumentSnapshot snapshot = std::move(*waiting);
        waiting.reset();
        writing = true;
        lock.unlock();
        Result<void> written;
        if (snapshot.dirty)
            written = writeRecovery(recoveryFile, snapshot);
        else
            removeRecovery(recoveryFile);
        lock.lock();
        writing = false;
        failure = written ? std::nullopt : std::optional(written.error());
        if (failure && !waiting && !ending)
            waiting = snapshot; // to be tried again
        changed.notify_all();
        changed.wait_for(lock, interval, [this] { return ending || (flushing && waiting && !failure); });
    }
}

std::vector<Recoverable> listRecoverable(const fs::path& folder)
{
    std::vector<Recoverable> found;
    for (const fs::path& file : filesOf(folder))
    {
        const std::string name = file.filename().string();
        const auto process = processOf(name);
        if (!process || isRunning(*process))
            continue;
        if (name.ends_with(".tmp"))
        {
            std::error_code ignored;
            fs::remove(file, ignored);
            continue;
        }
        if (!name.ends_with(extension))
            continue;
        Recoverable entry;
        entry.file = file;
        const auto text = readWholeFile(file, largestProjectText);
        auto read = text ? readProjectJson(*text, folder) : Result<ReadProject>(text.error());
        if (!read)
            entry.problem = read.error();
        else
        {
            if (read->recovery)
            {
                const std::string& path = read->recovery->path;
                entry.project = fs::path(std::u8string(path.begin(), path.end()));
                entry.time = read->recovery->time;
            }
            for (const auto& item : read->project.clips)
                entry.clips.push_back(item->clip->name);
        }
        found.push_back(std::move(entry));
    }
    std::sort(found.begin(), found.end(), [](const Recoverable& a, const Recoverable& b) { return a.time > b.time; });
    return found;
}

void discardRecoverable(const Recoverable& entry)
{
    removeRecovery(entry.file);
}

} // namespace pacini
