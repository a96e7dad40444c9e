#pragma once

// Lock-free hand-over of big objects to the audio thread and back.

#include <atomic>
#include <memory>
#include <utility>

namespace pacini
{

/// Carries objects made on one thread to the audio thread, newest wins, and carries used ones back, so that nothing is
/// allocated or freed there. One sender, one receiver; neither waits: an exchange each, and the list of used objects is
/// pushed by the receiver only and taken as a whole by the sender only.
template <typename T>
class HandOver
{
public:
    /// The object that the receiver holds, and its place in the list of used ones.
    struct Node
    {
        T content;
        Node* next = nullptr;
    };

    HandOver() = default;
    HandOver(const HandOver&) = delete;
    HandOver& operator=(const HandOver&) = delete;
    ~HandOver()
    {
        delete incoming.load(std::memory_order_acquire);
        collect();
    }

    /// Sends an object. It replaces an object that was sent but not yet received. Frees returned objects. [message]
    void send(T content)
    {
        auto node = std::make_unique<Node>(Node{std::move(content), nullptr});
        delete incoming.exchange(node.release(), std::memory_order_acq_rel);
        collect();
    }

    /// Frees returned objects. [message]
    void collect() noexcept
    {
        Node* node = used.exchange(nullptr, std::memory_order_acquire);
        while (node)
            delete std::exchange(node, node->next);
    }

    /// Whether an object is waiting to be received. [audio]
    [[nodiscard]] bool waiting() const noexcept { return incoming.load(std::memory_order_relaxed) != nullptr; }

    /// The newest object, or null; the receiver owns it until it gives it back. [audio]
    [[nodiscard]] Node* receive() noexcept
    {
        if (!waiting()) // an exchange locks the bus, a load does not
            return nullptr;
        return incoming.exchange(nullptr, std::memory_order_acq_rel);
    }

    /// Null is allowed. [audio]
    void giveBack(Node* node) noexcept
    {
        if (!node)
            return;
        node->next = used.load(std::memory_order_relaxed);
        while (!used.compare_exchange_weak(node->next, node, std::memory_order_release, std::memory_order_relaxed))
        {
        }
    }

private:
    std::atomic<Node*> incoming{nullptr};
    std::atomic<Node*> used{nullptr};
};

} // namespace pacini
