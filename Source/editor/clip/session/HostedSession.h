// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A session inside of a plugin: it is kept by the host, and its clips are heard in the host's blocks.

#include "editor/clip/session/Session.h"

#include <juce_events/juce_events.h>

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>

namespace pacini::editor
{

/// There is no session, and so no thread of its own, before anyone asks for it.
class HostedSession final : private juce::AsyncUpdater
{
public:
    using ProfileList = std::function<std::vector<NamedProfile>()>;

    /// Texts of projects that are longer are not kept by the host.
    static constexpr std::size_t largestText = std::size_t(32) << 20;

    explicit HostedSession(ProfileList profiles) : listProfiles(std::move(profiles)) {}
    ~HostedSession() override;

    /// Made at the first call. [message]
    [[nodiscard]] Session& session();

    /// While no block is processed. Playing stops when the rate changes. [any]
    void prepare(double sampleRate);

    /// What the session plays, up to 64 channels of sound of the length of `haptic`; false, with nothing written, when
    /// it is silent. [audio]
    bool process(std::span<float> haptic, std::span<const std::span<float>> sound) noexcept;

    /// The project for the host to keep; empty: there is none, or it is too large. [any]
    [[nodiscard]] std::string text() const;
    /// A project that the host has kept, empty: none. Errors as in readProjectJson(); nothing changes then. [any]
    Result<void> setText(const std::string& text);

private:
    void keep();
    void handleAsyncUpdate() override;
    void update();

    const ProfileList listProfiles;
    std::unique_ptr<Session> open;

    juce::SpinLock playing; ///< the audio thread only tries it
    double preparedRate = 0.0;
    int restBlocks = 0; ///< that are still to be heard after the end

    std::atomic<double> rate{0.0};
    mutable std::mutex mutex; ///< guards what follows
    Project kept;
    std::optional<Project> brought; ///< by the host, for the message thread to open
    Subscriptions subscriptions;
};

} // namespace pacini::editor
