#pragma once

// Numbers of handles, the ids of pacini.h, that detect destroyed objects.

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <thread>
#include <utility>
#include <vector>

namespace pacini::library
{

/// The kinds of handles, in their top byte.
enum class HandleKind : std::uint8_t
{
    clip = 0xC1,
    texture = 0xA1,
    engine = 0xE1,
    controller = 0xD1,
    play = 0xB1
};

/// The fields of a play's handle: kind, 6 bits of engine, 12 of the engine's generation, 14 of slot, 24 of generation.
struct PlayHandle
{
    std::uint32_t engine = 0, engineGeneration = 0, slot = 0, generation = 0;

    [[nodiscard]] constexpr std::uint64_t number() const noexcept
    {
        return static_cast<std::uint64_t>(HandleKind::play) << 56 | static_cast<std::uint64_t>(engine & 0x3Fu) << 50 |
               static_cast<std::uint64_t>(engineGeneration & 0xFFFu) << 38 |
               static_cast<std::uint64_t>(slot & 0x3FFFu) << 24 | (generation & 0xFFFFFFu);
    }

    /// Decodes a number of any kind.
    [[nodiscard]] static constexpr PlayHandle of(std::uint64_t number) noexcept
    {
        return {static_cast<std::uint32_t>(number >> 50) & 0x3Fu, static_cast<std::uint32_t>(number >> 38) & 0xFFFu,
                static_cast<std::uint32_t>(number >> 24) & 0x3FFFu, static_cast<std::uint32_t>(number) & 0xFFFFFFu};
    }
};

/// The fields of any other handle: kind, 24 bits of index, 32 bits of generation.
struct Handle
{
    HandleKind kind = HandleKind::clip;
    std::uint32_t index = 0;
    std::uint32_t generation = 0;

    [[nodiscard]] constexpr std::uint64_t number() const noexcept
    {
        return static_cast<std::uint64_t>(kind) << 56 | static_cast<std::uint64_t>(index & 0xFFFFFFu) << 32 |
               generation;
    }

    [[nodiscard]] static constexpr Handle of(std::uint64_t number) noexcept
    {
        return {static_cast<HandleKind>(number >> 56), static_cast<std::uint32_t>(number >> 32) & 0xFFFFFFu,
                static_cast<std::uint32_t>(number)};
    }
};

/// Objects by handle, for one thread at a time.
template <typename T>
class HandleTable
{
public:
    explicit HandleTable(HandleKind kindOfAll, std::size_t most) : kind(kindOfAll), limit(most) {}

    /// Returns a new handle for the object; 0 if there are too many. Allocates.
    [[nodiscard]] std::uint64_t add(T object)
    {
        if (free.empty())
        {
            if (entries.size() >= limit)
                return 0;
            entries.emplace_back();
            free.push_back(static_cast<std::uint32_t>(entries.size() - 1));
        }
        const std::uint32_t index = free.back();
        free.pop_back();
        Entry& entry = entries[index];
        entry.object = std::move(object);
        entry.used = true;
        if (++entry.generation == 0)
            ++entry.generation;
        return Handle{kind, index, entry.generation}.number();
    }

    /// The object, or null for a handle that is not in use.
    [[nodiscard]] T* find(std::uint64_t number) noexcept
    {
        const Handle handle = Handle::of(number);
        if (handle.kind != kind || handle.index >= entries.size())
            return nullptr;
        Entry& entry = entries[handle.index];
        return entry.used && entry.generation == handle.generation ? &entry.object : nullptr;
    }

    /// There must be one.
    void remove(std::uint64_t number)
    {
        const std::uint32_t index = Handle::of(number).index;
        entries[index].object = T();
        entries[index].used = false;
        free.push_back(index);
    }

private:
    struct Entry
    {
        T object{};
        std::uint32_t generation = 0;
        bool used = false;
    };

    HandleKind kind;
    std::size_t limit;
    std::vector<Entry> entries;
    std::vector<std::uint32_t> free;
};

/// A few objects by handle. The audio thread finds them without a lock, and they are not destroyed while it uses them.
template <typename T, std::size_t Count>
class SharedSlots
{
    struct Slot
    {
        std::atomic<T*> object{nullptr};
        std::atomic<std::uint32_t> generation{0};
        std::atomic<std::uint32_t> users{0};
    };

public:
    /// An object in use, or none.
    class Use
    {
    public:
        Use(SharedSlots& all, std::uint32_t at, std::uint32_t generation) noexcept : slot(all.slots[at % Count])
        {
            slot.users.fetch_add(1, std::memory_order_seq_cst);
            if (at < Count && slot.generation.load(std::memory_order_seq_cst) == generation && generation % 2 == 1)
                object = slot.object.load(std::memory_order_acquire);
        }
        ~Use() { slot.users.fetch_sub(1, std::memory_order_release); }
        Use(const Use&) = delete;
        Use& operator=(const Use&) = delete;

        [[nodiscard]] T* get() const noexcept { return object; }

    private:
        typename SharedSlots::Slot& slot;
        T* object = nullptr;
    };

    /// Returns the present generation of a slot, odd while it is in use.
    [[nodiscard]] std::uint32_t generationOf(std::uint32_t at) const noexcept
    {
        return at < Count ? slots[at].generation.load(std::memory_order_relaxed) : 0;
    }

    /// Adds an object. Returns its index and generation, odd while it is in use; index Count if all are taken. One
    /// thread at a time.
    [[nodiscard]] std::pair<std::uint32_t, std::uint32_t> add(T* object) noexcept
    {
        for (std::uint32_t i = 0; i < Count; ++i)
        {
            Slot& slot = slots[i];
            const std::uint32_t generation = slot.generation.load(std::memory_order_relaxed);
            if (generation % 2 == 1)
                continue;
            slot.object.store(object, std::memory_order_release);
            slot.generation.store(generation + 1, std::memory_order_seq_cst);
            return {i, generation + 1};
        }
        return {static_cast<std::uint32_t>(Count), 0};
    }

    /// Removes the object and waits until nobody uses it; null if there is none. One thread at a time.
    [[nodiscard]] T* remove(std::uint32_t at, std::uint32_t generation) noexcept
    {
        if (at >= Count || generation % 2 == 0)
            return nullptr;
        Slot& slot = slots[at];
        std::uint32_t expected = generation;
        if (!slot.generation.compare_exchange_strong(expected, generation + 1, std::memory_order_seq_cst))
            return nullptr;
        while (slot.users.load(std::memory_order_seq_cst) != 0)
            std::this_thread::yield();
        return slot.object.exchange(nullptr, std::memory_order_acq_rel);
    }

private:
    std::array<Slot, Count> slots;
};

} // namespace pacini::library
