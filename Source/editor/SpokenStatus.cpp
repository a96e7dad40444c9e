// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/SpokenStatus.h"

#include "editor/Translation.h"
#include "io/ChildProgram.h"

#include <utility>

namespace pacini::editor
{

SpokenStatus::~SpokenStatus()
{
    {
        const std::lock_guard lock(mutex);
        ending = true;
    }
    changed.notify_all();
    if (thread.joinable())
        thread.join();
}

void SpokenStatus::say(const juce::String& text)
{
    constexpr juce::uint32 soon = 1000; // ms
    const auto words = text.replaceCharacters("\r\n\t", "   ").trim().substring(0, longest);
    const auto now = juce::Time::getMillisecondCounter();
    if (words.isEmpty() || (words == last && now - lastTime < soon))
        return;
    last = words;
    lastTime = now;
    {
        const std::lock_guard lock(mutex);
        waiting = Words{words.toStdString(), languageInUse().toStdString()};
    }
    if (!thread.joinable())
        thread = std::thread([this] { run(); });
    changed.notify_all();
}

void SpokenStatus::run()
{
    std::unique_lock lock(mutex);
    for (;;)
    {
        changed.wait(lock, [this] { return ending || waiting; });
        if (ending)
            return;
        const Words words = *std::exchange(waiting, std::nullopt);
        lock.unlock();
        const auto child = ChildProgram::start(program, {"--application-name", "pacini", "--priority", "text",
                                                         "--language", words.language, "--", words.text});
        if (!child || *child == nullptr)
            juce::MessageManager::callAsync(
                [this, watch = std::weak_ptr<bool>(told)]
                {
                    // This is still there when that is.
                    if (const auto was = watch.lock(); was && !std::exchange(*was, true) && onMissing)
                        onMissing();
                });
        else
        {
            constexpr std::size_t most = 4096; // it prints nothing that counts
            (void)allOutput(**child, most);
            (void)(*child)->wait();
        }
        lock.lock();
    }
}

} // namespace pacini::editor
