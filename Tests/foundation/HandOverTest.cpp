#include "support/Catch.h"

#include <pacini/foundation/HandOver.h>

#include <atomic>
#include <memory>
#include <thread>

using namespace pacini;

namespace
{
/// Counts how many of it are alive and on which thread they end.
struct Tracked
{
    static inline std::atomic<int> alive{0};
    static inline std::atomic<bool> endedElsewhere{false};
    static inline std::thread::id home;

    explicit Tracked(int n) : number(n) { ++alive; }
    Tracked(const Tracked& other) : number(other.number) { ++alive; }
    Tracked& operator=(const Tracked&) = default;
    ~Tracked()
    {
        --alive;
        if (std::this_thread::get_id() != home)
            endedElsewhere = true;
    }
    int number;
};
} // namespace

TEST_CASE("a hand-over delivers the newest object and frees every other on the sender's thread", "[realtime]")
{
    Tracked::home = std::this_thread::get_id();
    Tracked::alive = 0;
    Tracked::endedElsewhere = false;
    {
        HandOver<Tracked> handOver;
        CHECK(handOver.receive() == nullptr);
        handOver.send(Tracked(1));
        handOver.send(Tracked(2));
        CHECK(handOver.waiting());
        auto* two = handOver.receive();
        REQUIRE(two != nullptr);
        CHECK(two->content.number == 2);
        CHECK(Tracked::alive == 1);
        CHECK_FALSE(handOver.waiting());
        handOver.giveBack(two);
        handOver.giveBack(nullptr);
        handOver.collect();
        CHECK(Tracked::alive == 0);

        std::atomic<int> last{0};
        std::thread audio(
            [&]
            {
                HandOver<Tracked>::Node* held = nullptr;
                while (last.load() < 2000)
                    if (auto* next = handOver.receive())
                    {
                        handOver.giveBack(held);
                        held = next;
                        const int number = next->content.number;
                        if (number <= last.load())
                            last = 1000000; // out of order
                        else
                            last = number;
                    }
                handOver.giveBack(held);
            });
        for (int n = 1; n <= 2000; ++n)
            handOver.send(Tracked(n));
        audio.join();
        CHECK(last == 2000);
        handOver.send(Tracked(3));
    }
    CHECK(Tracked::alive == 0);
    CHECK_FALSE(Tracked::endedElsewhere);
}
