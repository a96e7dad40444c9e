#include "study/Plan.h"

#include "study/StudyTemplates.h"
#include "support/Catch.h"

#include <cmath>
#include <cstdlib>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

using namespace pacini::study;

namespace
{
Study coherence()
{
    auto study = makeStudy("coherence", {"a.wav", "b.wav", "c.wav", "d.wav", "e.wav"});
    REQUIRE(study);
    return *study;
}
} // namespace

TEST_CASE("Every run of as many participants as are planned fills all groups, in an order of its own")
{
    const Study study = coherence();
    std::vector<std::vector<std::size_t>> rounds;
    for (std::size_t round = 0; round < 4; ++round)
    {
        std::map<std::size_t, int> counts;
        rounds.emplace_back();
        for (std::size_t i = 0; i < 33; ++i)
        {
            rounds.back().push_back(groupOfSlot(study, 33 * round + i));
            ++counts[rounds.back().back()];
        }
        for (std::size_t group = 0; group < 3; ++group)
            CHECK(counts[group] == 11);
    }
    CHECK(rounds[0] != rounds[1]);
    Study other = study;
    other.seed = 2;
    std::vector<std::size_t> others;
    for (std::size_t i = 0; i < 33; ++i)
        others.push_back(groupOfSlot(other, i));
    CHECK(others != rounds[0]);
}

TEST_CASE("Williams' squares have each stimulus at each place, and after each other one, equally often")
{
    for (const std::size_t count : {2u, 3u, 5u, 6u, 10u})
    {
        const std::size_t rows = count % 2 == 0 ? count : 2 * count;
        std::map<std::pair<std::size_t, std::size_t>, int> places, pairs;
        for (std::size_t row = 0; row < rows; ++row)
        {
            const auto order = williamsRow(count, row);
            CHECK(std::set<std::size_t>(order.begin(), order.end()).size() == count);
            for (std::size_t i = 0; i < count; ++i)
            {
                ++places[{i, order[i]}];
                if (i > 0)
                    ++pairs[{order[i - 1], order[i]}];
            }
        }
        INFO(count << " stimuli");
        CHECK(places.size() == count * count);
        CHECK(pairs.size() == count * (count - 1));
        for (const auto* counts : {&places, &pairs})
            for (const auto& [key, times] : *counts)
                CHECK(times == counts->begin()->second);
    }
    CHECK(williamsRow(0, 3).empty());
    CHECK(williamsRow(1, 7) == std::vector<std::size_t>{0});
}

TEST_CASE("Orders differ between participants and are the same each time")
{
    const Study study = coherence();
    std::set<std::vector<std::size_t>> orders;
    for (std::size_t slot = 0; slot < 20; ++slot)
    {
        std::vector<std::size_t> order;
        for (const Trial& trial : trialsOf(study, 3, slot))
            order.push_back(trial.stimuli.front());
        CHECK(order.size() == 5);
        CHECK(std::set<std::size_t>(order.begin(), order.end()).size() == 5);
        orders.insert(order);
        std::vector<std::size_t> again;
        for (const Trial& trial : trialsOf(study, 3, slot))
            again.push_back(trial.stimuli.front());
        CHECK(order == again);
    }
    CHECK(orders.size() > 10);
}

TEST_CASE("The right answer of choices lies everywhere equally often, and X is what it says")
{
    using Sounds = std::vector<std::string>;
    for (const auto& [name, sounds] : {std::pair("abx", Sounds{"a.wav"}), std::pair("jnd", Sounds{}),
                                       std::pair("compression", Sounds{"a.wav"}), std::pair("threshold", Sounds{})})
    {
        const auto study = makeStudy(name, sounds);
        REQUIRE(study);
        std::map<int, int> counts;
        int trials = 0;
        for (std::size_t slot = 0; slot < 40; ++slot)
            for (const Trial& trial : trialsOf(*study, 0, slot))
            {
                ++counts[trial.right];
                ++trials;
                if (study->blocks[0].task == Task::abx)
                {
                    REQUIRE(trial.stimuli.size() == 3);
                    CHECK(trial.stimuli[2] == trial.stimuli[static_cast<std::size_t>(trial.right)]);
                    CHECK(trial.stimuli[0] != trial.stimuli[1]);
                }
            }
        INFO(name);
        const int choices = study->blocks[0].task == Task::abx ? 2 : study->blocks[0].intervals;
        CHECK(counts.size() == static_cast<std::size_t>(choices));
        for (const auto& [choice, count] : counts)
            CHECK(std::abs(count - trials / choices) < 4.0 * std::sqrt(trials) / 2.0);
    }
}

TEST_CASE("Pages have everything on them, pairs come once, breaks where they are asked for")
{
    const auto mushra = makeStudy("mushra", {"a.wav"});
    REQUIRE(mushra);
    const auto pages = trialsOf(*mushra, 0, 0);
    REQUIRE(pages.size() == 1);
    CHECK(pages[0].stimuli.size() == 5); // three, the hidden reference, the anchor

    auto similarity = makeStudy("similarity", {"a.wav", "b.wav", "c.wav", "d.wav"});
    REQUIRE(similarity);
    similarity->blocks[0].breakAfter = 2;
    std::set<std::set<std::size_t>> pairs;
    std::vector<bool> breaks;
    for (const Trial& trial : trialsOf(*similarity, 0, 3))
    {
        pairs.insert(std::set<std::size_t>(trial.stimuli.begin(), trial.stimuli.end()));
        breaks.push_back(trial.afterBreak);
    }
    CHECK(pairs.size() == 6);
    CHECK(breaks == std::vector<bool>{false, false, true, false, true, false});
}
