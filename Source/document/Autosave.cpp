#include "document/Autosave.h"

#include "document/ProcessId.h"
#include "document/ProjectJson.h"
#include "io/AtomicFile.h"
#include "io/FileLock.h"
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
constexpr std::string_view lockExtension = ".pacini-lock"; // beside each recovery file, held by its program

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

fs::path lockOf(fs::path recoveryFile)
{
    return recoveryFile.replace_extension(lockExtension);
}

/// Whether the program that made a recovery file, or a temporary of it, still runs. Not its id alone: ids are given
/// again, and a killed program keeps its own until its parent has noticed.
bool hasOwner(const fs::path& recoveryFile)
{
    FileLock lock;
    switch (lock.take(lockOf(recoveryFile), FileLock::IfMissing::leave))
    {
    case FileLock::Outcome::heldElsewhere:
        return true;
    case FileLock::Outcome::taken:
    case FileLock::Outcome::missing:
        return false;
    case FileLock::Outcome::unknown:
        break;
    }
    const auto process = processOf(recoveryFile.filename().string());
    return process && isRunning(*process);
}

/// The recovery file that `file` is, or is a temporary or the lock of; empty for others.
fs::path recoveryOf(const fs::path& file)
{
    std::string name = file.filename().string();
    if (!processOf(name))
        return {};
    if (name.starts_with('.'))
        name.erase(0, 1);
    if (name.ends_with(lockExtension))
        name.replace(name.size() - lockExtension.size(), lockExtension.size(), extension);
    const auto end = name.find(extension);
    return end == std::string::npos ? fs::path() : file.parent_path() / name.substr(0, end + extension.size());
}

/// Embedded sounds are written before the project that needs them, under a lock that is there before both.
void removeOrphanedSounds(const fs::path& folder)
{
    const auto files = filesOf(folder);
    const auto mayNeedSounds = [](const fs::path& file)
    {
        return file.extension() == fs::path(extension) || file.extension() == fs::path(lockExtension);
    };
    if (std::any_of(files.begin(), files.end(), mayNeedSounds))
        return;
    std::error_code ignored;
    for (const fs::path& file : files)
        if (file.extension() == fs::path(soundExtension))
            fs::remove(file, ignored);
}

/// With its lock, which must not be held by another program.
void removeRecovery(const fs::path& file)
{
    std::error_code ignored;
    fs::remove(file, ignored);
    fs::remove(lockOf(file), ignored);
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
    const RecoveryNote note{std::string(path.begin(), path.end()), now(), static_cast<double>(processId()),
                            snapshot.place};
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
    forget();
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
        const auto start = std::chrono::steady_clock::now();
        const auto written = put(snapshot);
        const auto taken = std::chrono::steady_clock::now() - start;
        lock.lock();
        writing = false;
        failure = written ? std::nullopt : std::optional(written.error());
        if (failure && !waiting && !ending)
            waiting = snapshot; // to be tried again
        changed.notify_all();
        // The disk rests at least half of the time.
        changed.wait_for(lock, std::max<std::chrono::steady_clock::duration>(interval, taken),
                         [this] { return ending || (flushing && waiting && !failure); });
    }
}

/// On the thread. Where there are no locks, files are written all the same.
Result<void> Autosave::put(const DocumentSnapshot& snapshot)
{
    if (!snapshot.dirty)
    {
        forget();
        return {};
    }
    if (!owned.isHeld())
    {
        std::error_code error;
        fs::create_directories(folder, error);
        // Its name is ours alone: who holds it is a program that looks for stale ones, and lets go at once.
        for (int attempt = 0; attempt < 20; ++attempt)
        {
            if (owned.take(lockOf(recoveryFile), FileLock::IfMissing::create) != FileLock::Outcome::heldElsewhere)
                break;
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
    }
    return writeRecovery(recoveryFile, snapshot);
}

void Autosave::forget()
{
    owned.release();
    removeRecovery(recoveryFile);
}

std::vector<Recoverable> listRecoverable(const fs::path& folder)
{
    std::vector<Recoverable> found;
    const auto files = filesOf(folder);
    for (const fs::path& file : files)
    {
        const fs::path recovery = recoveryOf(file);
        if (recovery.empty() || hasOwner(recovery))
            continue;
        if (file != recovery)
        {
            // A temporary, or the lock of a recovery file that was never written.
            std::error_code ignored;
            if (file.extension() != fs::path(lockExtension) || !fs::exists(recovery, ignored))
                fs::remove(file, ignored);
            continue;
        }
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
                entry.place = read->recovery->place;
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
