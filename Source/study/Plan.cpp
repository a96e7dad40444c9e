#include "study/Plan.h"

#include <pacini/foundation/Random.h>

#include <algorithm>
#include <cassert>
#include <numeric>
#include <utility>

namespace pacini::study
{

namespace
{
constexpr std::size_t ofGroups = 1'000'000; // a purpose that no block has

/// From 0 to below `count`.
std::size_t below(Random& random, std::size_t count)
{
    return std::min(static_cast<std::size_t>(random.uniform() * static_cast<double>(count)), count - 1);
}

/// Fisher and Yates; std::shuffle differs between libraries.
template <typename T>
void shuffle(std::vector<T>& values, Random& random)
{
    for (std::size_t i = values.size(); i > 1; --i)
        std::swap(values[i - 1], values[below(random, i)]);
}

/// The stimuli in the order of presentation, once.
std::vector<std::size_t> ordered(const Study& study, const Block& block, std::vector<std::size_t> stimuli,
                                 std::size_t slot, std::size_t round, Random& random)
{
    if (block.order == Order::random)
        shuffle(stimuli, random);
    if (block.order == Order::latinSquare)
    {
        std::vector<std::size_t> row;
        for (const std::size_t i : williamsRow(stimuli.size(), rowOfSlot(study, slot) + round))
            row.push_back(stimuli[i]);
        return row;
    }
    return stimuli;
}

/// All pairs, each in an order of its own.
std::vector<std::vector<std::size_t>> pairsOf(const std::vector<std::size_t>& stimuli, Random& random)
{
    std::vector<std::vector<std::size_t>> pairs;
    for (std::size_t i = 0; i < stimuli.size(); ++i)
        for (std::size_t k = i + 1; k < stimuli.size(); ++k)
            pairs.push_back(random.uniform() < 0.5 ? std::vector{stimuli[i], stimuli[k]}
                                                   : std::vector{stimuli[k], stimuli[i]});
    return pairs;
}

/// The trial of one stimulus against the block's reference.
Trial comparison(const Study& study, const Block& block, std::size_t stimulus, Random& random)
{
    Trial trial;
    const std::size_t reference = block.reference.empty() ? stimulus : stimulusNamed(study, block.reference);
    if (block.task == Task::abx)
    {
        const bool stimulusFirst = random.uniform() < 0.5;
        trial.stimuli = stimulusFirst ? std::vector{stimulus, reference} : std::vector{reference, stimulus};
        trial.right = random.uniform() < 0.5 ? 0 : 1;
        trial.stimuli.push_back(trial.stimuli[static_cast<std::size_t>(trial.right)]);
        return trial;
    }
    const auto intervals = static_cast<std::size_t>(block.intervals);
    trial.stimuli.assign(intervals, reference);
    trial.right = static_cast<int>(below(random, intervals));
    trial.stimuli[static_cast<std::size_t>(trial.right)] = stimulus;
    trial.adaptive = block.task == Task::staircase;
    return trial;
}

/// Everything on one page: what is to be rated, and of MUSHRA the hidden reference and the anchors.
Trial page(const Study& study, const Block& block, std::vector<std::size_t> stimuli, Random& random)
{
    if (block.task == Task::multiStimulus)
    {
        stimuli.push_back(stimulusNamed(study, block.reference));
        for (const std::string& anchor : block.anchors)
            stimuli.push_back(stimulusNamed(study, anchor));
    }
    shuffle(stimuli, random);
    Trial trial;
    trial.stimuli = std::move(stimuli);
    return trial;
}
} // namespace

std::uint64_t seedOf(const Study& study, std::size_t slot, std::size_t purpose) noexcept
{
    // Each number goes through the generator once, so that neighbours have nothing in common.
    Random mixed(study.seed);
    Random ofSlot(mixed.next() ^ slot);
    Random ofPurpose(ofSlot.next() ^ purpose);
    return ofPurpose.next();
}

std::size_t groupOfSlot(const Study& study, std::size_t slot)
{
    const auto all = static_cast<std::size_t>(participantsOf(study));
    assert(all > 0);
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < study.groups.size(); ++i)
        places.insert(places.end(), static_cast<std::size_t>(study.groups[i].size), i);
    Random random(seedOf(study, slot / all, ofGroups));
    shuffle(places, random);
    return places[slot % all];
}

std::size_t rowOfSlot(const Study& study, std::size_t slot)
{
    const std::size_t group = groupOfSlot(study, slot);
    std::size_t row = 0;
    for (std::size_t i = 0; i < slot; ++i)
        row += groupOfSlot(study, i) == group ? 1u : 0u;
    return row;
}

std::vector<std::size_t> williamsRow(std::size_t count, std::size_t row)
{
    if (count == 0)
        return {};
    // 0, 1, n-1, 2, n-2, ... has each difference once; an odd count needs its mirror image, too.
    std::vector<std::size_t> values;
    for (std::size_t i = 0; i < count; ++i)
        values.push_back(i % 2 == 1 ? (i + 1) / 2 : (count - i / 2) % count);
    const bool mirrored = count % 2 == 1 && row / count % 2 == 1;
    for (std::size_t& value : values)
        value = (value + row) % count;
    if (mirrored)
        std::reverse(values.begin(), values.end());
    return values;
}

std::vector<Trial> trialsOf(const Study& study, std::size_t blockIndex, std::size_t slot)
{
    const Block& block = study.blocks[blockIndex];
    Random random(seedOf(study, slot, blockIndex));
    std::vector<Trial> trials;
    const auto add = [&](Trial trial)
    {
        trial.block = blockIndex;
        trials.push_back(std::move(trial));
    };
    const auto single = [&](std::size_t stimulus)
    {
        if (needsReference(block) || block.task == Task::staircase)
            return comparison(study, block, stimulus, random);
        Trial trial;
        trial.stimuli = {stimulus};
        trial.right = rightAnswer(study, block, stimulus);
        return trial;
    };
    if (block.task == Task::questionnaire)
    {
        add({});
        return trials;
    }
    const bool onOnePage =
        block.task == Task::multiStimulus || block.task == Task::ranking || block.task == Task::sorting;
    if (!onOnePage && block.task != Task::similarity)
        for (const std::string& name : block.training)
        {
            Trial trial = single(stimulusNamed(study, name));
            trial.training = true;
            trial.adaptive = false;
            add(std::move(trial));
        }
    const std::vector<std::size_t> stimuli = stimuliOf(study, block);
    const int rounds = block.task == Task::staircase ? block.adaptive.trials : block.repeats;
    for (int round = 0; round < rounds; ++round)
    {
        if (onOnePage)
            add(page(study, block, stimuli, random));
        else if (block.task == Task::similarity)
        {
            auto pairs = pairsOf(stimuli, random);
            shuffle(pairs, random);
            for (auto& pair : pairs)
            {
                Trial trial;
                trial.stimuli = std::move(pair);
                add(std::move(trial));
            }
        }
        else
            for (const std::size_t stimulus :
                 ordered(study, block, stimuli, slot, static_cast<std::size_t>(round), random))
                add(single(stimulus));
    }
    int sinceBreak = 0;
    for (Trial& trial : trials)
        if (!trial.training && block.breakAfter > 0 && ++sinceBreak > block.breakAfter)
        {
            trial.afterBreak = true;
            sinceBreak = 1;
        }
    return trials;
}

} // namespace pacini::study
