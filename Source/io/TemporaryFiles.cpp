#include "io/TemporaryFiles.h"

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <utility>

#if !defined(_WIN32)
#include <signal.h>
#include <unistd.h>
#endif

namespace pacini
{

namespace
{
using Char = std::filesystem::path::value_type;

// A signal handler may neither lock nor allocate: a name is a heap block that belongs to whoever takes it off the list.
std::array<std::atomic<const Char*>, 512> names{};

#if !defined(_WIN32)
static_assert(std::atomic<const Char*>::is_always_lock_free);

extern "C" void removeTemporaries(int signal)
{
    for (auto& name : names)
        if (const Char* taken = name.exchange(nullptr))
            ::unlink(taken);
    ::raise(signal); // held back until this returns; the handler is gone by then
}
#endif
} // namespace

TemporaryEntry::TemporaryEntry(const std::filesystem::path& temporary)
{
    const auto& text = temporary.native();
    auto copy = std::make_unique<Char[]>(text.size() + 1);
    std::copy(text.begin(), text.end(), copy.get());
    for (auto& name : names)
    {
        const Char* nothing = nullptr;
        if (name.compare_exchange_strong(nothing, copy.get()))
        {
            copy.release();
            place = &name;
            return;
        }
    }
}

TemporaryEntry::TemporaryEntry(TemporaryEntry&& other) noexcept : place(std::exchange(other.place, nullptr)) {}

TemporaryEntry::~TemporaryEntry()
{
    if (place != nullptr)
        delete[] place->exchange(nullptr);
}

void removeTemporariesOnSignals() noexcept
{
#if !defined(_WIN32)
    for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    {
        struct sigaction before = {};
        if (sigaction(signal, nullptr, &before) != 0 || before.sa_handler == SIG_IGN)
            continue;
        struct sigaction action = {};
        action.sa_handler = removeTemporaries;
        action.sa_flags = static_cast<int>(SA_RESETHAND);
        sigemptyset(&action.sa_mask);
        sigaction(signal, &action, nullptr);
    }
#endif
}

} // namespace pacini
