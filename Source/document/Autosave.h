#pragma once

// Autosave and recovery of projects: nothing older than a second is ever lost.

#include "document/Document.h"
#include "io/FileLock.h"

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace pacini
{

/// Writes a document that has unsaved changes into a recovery folder, on a thread of its own: at once after a pause,
/// else at most every `interval`. A file is replaced as a whole, so that a program killed at any time leaves a complete
/// one, at most `interval` and the time of writing old (twice that time, where it is the longer). Embedded sounds are
/// written once, beside it. A lock file beside it shows that the program still runs.
class Autosave
{
public:
    /// `folder` is made when it is missing. One Autosave for each open document.
    explicit Autosave(std::filesystem::path folder,
                      std::chrono::milliseconds interval = std::chrono::milliseconds(300));

    /// Waits for a write that is under way. What has been written stays; call discard() when the document was closed
    /// by the user's will.
    ~Autosave();

    Autosave(const Autosave&) = delete;
    Autosave& operator=(const Autosave&) = delete;

    /// Hands over the newest state; call after every change, undo and save. Never waits for the disk. A state that is
    /// not dirty removes the recovery file: the project file has it all. [message]
    void update(DocumentSnapshot snapshot);

    /// Removes the recovery file, and sounds that no other recovery file may need.
    void discard();

    /// Waits until what was handed over is on the disk or has failed.
    void flush();

    /// Why the last write failed (a full disk, say), if it did: to be shown. Writing is tried again with the next
    /// change and every `interval`. [any]
    [[nodiscard]] std::optional<Error> lastError() const;

    [[nodiscard]] const std::filesystem::path& file() const noexcept { return recoveryFile; }

private:
    void run();
    Result<void> put(const DocumentSnapshot& snapshot);
    void forget();

    const std::filesystem::path folder;
    const std::filesystem::path recoveryFile;
    const std::chrono::milliseconds interval;
    FileLock owned; ///< of the thread while it writes, else under `mutex`
    mutable std::mutex mutex;
    std::condition_variable changed;
    std::optional<DocumentSnapshot> waiting;
    std::optional<Error> failure;
    bool writing = false;
    bool flushing = false;
    bool ending = false;
    std::thread thread;
};

/// Writes one recovery file as Autosave does. Errors: io. [worker]
[[nodiscard]] Result<void> writeRecovery(const std::filesystem::path& file, const DocumentSnapshot& snapshot);

/// An unsaved project that a program which is no longer running has left.
struct Recoverable
{
    std::filesystem::path file;     ///< for Document::recover()
    std::filesystem::path project;  ///< its project file; empty: never saved
    double time = 0.0;              ///< s since 1970 (UTC)
    std::vector<std::string> clips; ///< their names
    WorkPlace place = {};           ///< when it was written
    std::optional<Error> problem;   ///< why it cannot be read; it is kept all the same
};

/// What can be restored from a recovery folder, newest first. Files of programs that still run are left out; unfinished
/// temporaries of others are removed.
[[nodiscard]] std::vector<Recoverable> listRecoverable(const std::filesystem::path& folder);

/// Removes a recovery file that was restored or is not wanted.
void discardRecoverable(const Recoverable& entry);

} // namespace pacini
