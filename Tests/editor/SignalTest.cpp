#include "editor/clip/session/Signal.h"

#include "support/Catch.h"

#include <memory>
#include <string>

using namespace pacini;
using editor::Signal;
using editor::Subscriptions;

TEST_CASE("A signal calls its followers in their order, until they are gone")
{
    Signal first, second;
    std::string calls;
    auto a = std::make_unique<Subscriptions>();
    Subscriptions b;
    a->on({&first, &second}, [&] { calls += 'a'; });
    b.on({&first}, [&] { calls += 'b'; });
    first.emit();
    second.emit();
    CHECK(calls == "aba");
    a.reset();
    first.emit();
    second.emit();
    CHECK(calls == "abab");
}

TEST_CASE("Followers may come and go while a signal calls them")
{
    Signal signal;
    std::string calls;
    auto later = std::make_unique<Subscriptions>();
    Subscriptions first;
    auto self = std::make_unique<Subscriptions>();
    first.on({&signal},
             [&]
             {
                 calls += '1';
                 later.reset();
                 first.on({&signal}, [&] { calls += '+'; });
             });
    self->on({&signal},
             [&]
             {
                 self.reset();
                 calls += '2';
             });
    later->on({&signal}, [&] { calls += 'x'; });
    signal.emit();
    CHECK(calls == "12");
}

TEST_CASE("A subscription may outlive what it followed")
{
    int calls = 0;
    Subscriptions subscriptions;
    {
        const Signal gone;
        subscriptions.on({&gone}, [&calls] { ++calls; });
        gone.emit();
    }
    CHECK(calls == 1);
    const Signal next;
    subscriptions.on({&next}, [&calls] { calls += 10; });
    next.emit();
    CHECK(calls == 11);
}
