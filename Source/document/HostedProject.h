#pragma once

// The project of a clip editor inside a plugin: stored by the host, played in the host's blocks.

#include "document/ClipPlayer.h"
#include "document/Project.h"

#include <pacini/foundation/Result.h>

#include <atomic>
#include <cstddef>
#include <functional>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <thread>

namespace pacini
{

/// Link between the plugin's processor and an editor, which may not be there (yet).
class HostedProject
{
public:
    /// Texts of projects that are longer are not kept by the host.
    static constexpr std::size_t largestText = std::size_t(32) << 20;

    // The processor's side.

    /// While no block is processed. Playing stops when the rate changes. [any]
    void prepare(double sampleRate);

    /// What the editor plays, up to 64 channels of sound of the length of `haptic`; false, with nothing written, when
    /// it is silent. [audio]
    bool process(std::span<float> haptic, std::span<const std::span<float>> sound) noexcept;

    /// The project for the host to keep; empty: there is none, or it is too large. [any]
    [[nodiscard]] std::string text() const;
    /// A project that the host has kept, empty: none. Errors as in readProjectJson(); nothing changes then. [any]
    Result<void> setText(const std::string& text);

    // The editor's side.

    /// Called when take() has something to do; null: there is no editor. While no other thread calls. [any]
    std::function<void()> onChange;

    /// Whose sound is heard; null: nobody's. It is prepared by take(). [message]
    void setPlayer(ClipPlayer* wanted);

    /// Prepares the player for the host's rate. Returns the project that the host has brought since the last call.
    /// [message]
    [[nodiscard]] std::optional<Project> take();

    /// The project as it is now, for the host to keep. [message]
    void keep(Project project);

private:
    class SpinLock
    {
    public:
        void lock() noexcept
        {
            while (!try_lock())
                std::this_thread::yield();
        }
        [[nodiscard]] bool try_lock() noexcept { return !taken.exchange(true, std::memory_order_acquire); }
        void unlock() noexcept { taken.store(false, std::memory_order_release); }

    private:
        std::atomic<bool> taken{false};
    };

    SpinLock playing; ///< guards what follows; the audio thread only tries it
    ClipPlayer* player = nullptr;
    double preparedRate = 0.0;
    int restBlocks = 0; ///< that are still to be heard after the end

    std::atomic<double> rate{0.0};
    mutable std::mutex mutex; ///< guards what follows
    Project kept;
    std::optional<Project> brought; ///< by the host, for the editor to open
};

} // namespace pacini
