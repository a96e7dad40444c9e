#include "study/Observers.h"

#include "study/statistics/Distributions.h"
#include "study/statistics/TwoSamples.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>

namespace pacini::study
{

namespace
{
constexpr std::size_t forObservers = 2'000'000, forStimuli = 2'000'001, forPower = 2'000'002; // purposes of seeds

/// On the scale: within its ends, at its steps.
double onScale(const RatingScale& scale, double value)
{
    if (scale.step > 0.0)
        value = scale.low + scale.step * std::round((value - scale.low) / scale.step);
    return std::clamp(value, scale.low, scale.high);
}

constexpr double middleShare = 0.7; // of the scale: ratings of what belongs together lie above its middle

/// Elevation of the threshold of touch, dB: least at 250 Hz, 12 dB an octave below and 10 above (after Bolanowski et
/// al. 1988, JASA 84, the Pacinian channel).
double elevationAt(double frequency)
{
    const double octaves = std::log2(frequency / 250.0);
    return octaves < 0.0 ? -12.0 * octaves : 10.0 * octaves;
}

/// An answer that the question allows; of a number within the lower half of its range, as of ages and years.
std::string answerTo(const Item& item, Random& random)
{
    switch (item.kind)
    {
    case QuestionKind::text:
        return "simulated";
    case QuestionKind::choice:
        return item
            .choices[std::min(static_cast<std::size_t>(random.uniform() * static_cast<double>(item.choices.size())),
                              item.choices.size() - 1)]
            .name;
    case QuestionKind::number:
    case QuestionKind::likert:
        break;
    }
    const double range = item.scale.high - item.scale.low, step = item.scale.step > 0.0 ? item.scale.step : 1.0;
    const double most = item.kind == QuestionKind::number ? 0.5 * range : range;
    const double value = item.scale.low + step * std::floor(random.uniform() * (most / step + 1.0));
    return fmt::to_string(std::min(value, item.scale.low + step * std::floor(range / step)));
}

constexpr std::array vocabulary{"pulsing", "rough", "soft",    "short",    "rising",
                                "deep",    "sharp", "humming", "knocking", "smooth"};
} // namespace

Observer::Observer(const Study& ofStudy, const ObserverParams& observerParams, std::size_t slot)
    : study(ofStudy), params(observerParams), random(observerParams.seed ^ seedOf(ofStudy, slot, forObservers))
{
    bias = params.biasSd * normalNumber(random);
    ownThreshold = params.threshold + params.thresholdSd * normalNumber(random);
    isInLastGroup = study.groups.size() > 1 && groupOfSlot(study, slot) + 1 == study.groups.size();
}

double Observer::valueOfStimulus(std::size_t stimulus) const
{
    Random ofStimulus(params.seed ^ seedOf(study, stimulus, forStimuli));
    return params.stimulusSd * normalNumber(ofStimulus);
}

double Observer::rated(const RatingScale& scale, double value)
{
    // Points are tenths of the scale, as on that of the seed.
    const double points = 10.0 * middleShare + value + bias + (isInLastGroup ? params.effect : 0.0) +
                          params.noiseSd * normalNumber(random);
    return onScale(scale, scale.low + (scale.high - scale.low) * points / 10.0);
}

double Observer::thresholdFor(const Block& block, std::size_t stimulus) const
{
    const Adaptive& adaptive = block.adaptive;
    if (adaptive.variable != Variable::level)
    {
        // In the middle of what is asked, each participant elsewhere.
        const double a = strengthOf(adaptive.variable, adaptive.lowest),
                     b = strengthOf(adaptive.variable, adaptive.highest);
        return 0.5 * (a + b) + (ownThreshold - params.threshold);
    }
    const auto& tone = study.stimuli[stimulus].tone;
    return ownThreshold + (tone ? elevationAt(tone->frequency) : 0.0);
}

Answer Observer::answer(const Trial& trial, std::optional<double> level)
{
    const Block& block = study.blocks[trial.block];
    Answer given;
    given.seconds = std::exp(0.7 + 0.4 * normalNumber(random));
    const auto choose = [&](double chance, int choices)
    {
        if (random.uniform() < chance)
            return trial.right;
        const int other = static_cast<int>(random.uniform() * (choices - 1));
        return other < trial.right ? other : other + 1;
    };
    switch (block.task)
    {
    case Task::rating:
        given.value = rated(block.scale, valueOfStimulus(trial.stimuli.front()));
        break;
    case Task::words:
        for (int i = 0; i < 3; ++i)
        {
            const auto word = static_cast<std::size_t>(random.uniform() * static_cast<double>(vocabulary.size()));
            given.words += (i == 0 ? "" : ", ") + std::string(vocabulary[word]);
        }
        break;
    case Task::abx:
        given.choice = choose(params.discrimination, 2);
        break;
    case Task::forcedChoice:
        given.choice = choose(params.discrimination, block.intervals);
        break;
    case Task::staircase:
    {
        const Psychometric felt{thresholdFor(block, testedStimulus(trial)), params.slope, 1.0 / block.intervals,
                                params.lapse};
        given.choice = choose(felt(strengthOf(block.adaptive.variable, level.value_or(0.0))), block.intervals);
        break;
    }
    case Task::multiStimulus:
        for (const std::size_t stimulus : trial.stimuli)
            given.values.push_back(study.stimuli[stimulus].name == block.reference
                                       ? block.scale.high
                                       : rated(block.scale, valueOfStimulus(stimulus)));
        break;
    case Task::ranking:
    {
        std::vector<double> liked;
        for (const std::size_t stimulus : trial.stimuli)
            liked.push_back(-valueOfStimulus(stimulus) - params.noiseSd * normalNumber(random));
        given.values = ranksOf(liked);
        break;
    }
    case Task::similarity:
        given.value = onScale(block.scale, block.scale.low + (block.scale.high - block.scale.low) *
                                                                 (std::abs(valueOfStimulus(trial.stimuli[0]) -
                                                                           valueOfStimulus(trial.stimuli[1])) +
                                                                  0.5 * std::abs(normalNumber(random))) /
                                                                 4.0);
        break;
    case Task::questionnaire:
        for (const Item& item : block.items)
            given.items.emplace_back(item.name, answerTo(item, random));
        break;
    case Task::place:
    {
        // Drawn to the middle, as people are where they do not know.
        constexpr double drawn = 0.8, spread = 0.12;
        const auto& place = study.stimuli[trial.stimuli.front()].place;
        const double felt = 0.5 + drawn * ((place ? place->position : 0.5) - 0.5) + spread * normalNumber(random);
        given.value = onScale(block.scale, block.scale.low + (block.scale.high - block.scale.low) * felt);
        break;
    }
    case Task::side:
        given.choice = trial.right >= 0 ? choose(params.discrimination, 2) : random.uniform() < 0.5 ? 0 : 1;
        break;
    case Task::count:
    {
        const std::vector<int> counts = countsOf(study, block);
        const int miss = random.uniform() < 0.5 ? -1 : 1;
        given.choice = std::clamp(trial.right + (random.uniform() < params.discrimination ? 0 : miss), counts.front(),
                                  counts.back());
        break;
    }
    case Task::which:
    {
        int felt = 0;
        for (std::size_t i = 0; i < eventsOf(study, block).size(); ++i)
            felt |= (trial.right ^ (random.uniform() < params.discrimination ? 0 : 1 << i)) & (1 << i);
        given.choice = felt;
        break;
    }
    case Task::sorting:
        for (const std::size_t stimulus : trial.stimuli)
            given.values.push_back(valueOfStimulus(stimulus) + 0.3 * normalNumber(random) > 0.0 ? 1.0 : 0.0);
        break;
    }
    return given;
}

Result<void> simulateSession(const Study& study, Session& session, const ObserverParams& params)
{
    Observer observer(study, params, session.head().slot);
    while (const Trial* trial = session.trial())
        if (auto kept = session.answer(observer.answer(*trial, session.level())); !kept)
            return kept.error();
    return {};
}

namespace
{
/// Ratings of one stimulus each that a member of the group gives.
std::size_t ratingsBy(const Study& study, const Group& group)
{
    std::size_t count = 0;
    for (const Block& block : study.blocks)
        if (block.task == Task::rating && isFor(block, group.name))
            count += stimuliOf(study, block).size() * static_cast<std::size_t>(block.repeats);
    return count;
}

/// Variance of a participant's mean of so many ratings: of the leaning and of the noise.
double meanVariance(const ObserverParams& params, std::size_t count)
{
    return params.biasSd * params.biasSd + params.noiseSd * params.noiseSd / static_cast<double>(count);
}

/// Two-sided power at 5 %.
double powerAtFivePercent(double degrees, double noncentrality)
{
    return powerOfT(quantileT(0.975, degrees), degrees, noncentrality);
}

/// The effects of a comparison whose standardised effect of 1 is `sd` points, and shifts t by `shift`.
std::vector<EffectPower> effectsOf(double sd, double degrees, double shift, const std::optional<double>& points)
{
    std::vector<EffectPower> effects;
    const auto add = [&](double effect)
    {
        effects.push_back({effect, effect * sd, powerAtFivePercent(degrees, effect * shift)});
    };
    if (points)
    {
        if (sd > 0.0)
            add(*points / sd);
    }
    else
        for (const double effect : tabulatedEffects)
            add(effect);
    return effects;
}
} // namespace

std::vector<DesignPower> powerOfDesign(const Study& study, const ObserverParams& params, std::optional<double> points)
{
    std::vector<DesignPower> designs;
    for (std::size_t g = 0; g + 1 < study.groups.size(); ++g)
    {
        const Group &first = study.groups[g], &last = study.groups.back();
        const std::size_t ofFirst = ratingsBy(study, first), ofLast = ratingsBy(study, last);
        if (ofFirst == 0 || ofLast == 0 || first.size < 2 || last.size < 2)
            continue;
        DesignPower one{first.name, last.name, "", first.size, last.size, ofFirst, {}};
        const auto n1 = static_cast<double>(first.size), n2 = static_cast<double>(last.size);
        const double v1 = meanVariance(params, ofFirst), v2 = meanVariance(params, ofLast);
        const double sd = std::sqrt(((n1 - 1.0) * v1 + (n2 - 1.0) * v2) / (n1 + n2 - 2.0));
        one.effects = effectsOf(sd, n1 + n2 - 2.0, sd > 0.0 ? sd / std::sqrt(v1 / n1 + v2 / n2) : 0.0, points);
        designs.push_back(std::move(one));
    }
    for (const Block& block : study.blocks)
    {
        const bool isPage = block.task == Task::multiStimulus;
        if (block.task != Task::rating && !isPage)
            continue;
        int people = 0;
        for (const Group& group : study.groups)
            people += isFor(block, group.name) ? group.size : 0;
        if (people < 2 || stimuliOf(study, block).size() + (isPage ? block.anchors.size() + 1 : 0) < 2)
            continue;
        const auto trials = static_cast<std::size_t>(block.repeats);
        DesignPower one{"", "", block.name, people, people, trials, {}};
        // The leaning of a person is in both ratings and goes.
        const double sd = params.noiseSd * std::sqrt(2.0 / static_cast<double>(trials));
        one.effects = effectsOf(sd, people - 1.0, std::sqrt(static_cast<double>(people)), points);
        designs.push_back(std::move(one));
    }
    return designs;
}

std::vector<PowerEstimate> estimatePower(const Study& study, const ObserverParams& params, std::size_t runs)
{
    std::vector<PowerEstimate> estimates;
    const auto scaleOf = [&](const Group& group)
    {
        for (const Block& block : study.blocks)
            if (block.task == Task::rating && isFor(block, group.name))
                return block.scale;
        return RatingScale();
    };
    if (study.groups.size() < 2 || runs == 0)
        return estimates;
    const Group& last = study.groups.back();
    for (std::size_t g = 0; g + 1 < study.groups.size(); ++g)
    {
        const Group& other = study.groups[g];
        const std::size_t ofOther = ratingsBy(study, other), ofLast = ratingsBy(study, last);
        if (ofOther == 0 || ofLast == 0 || other.size < 2 || last.size < 2)
            continue;
        Random random(params.seed ^ seedOf(study, g, forPower));
        std::size_t found = 0;
        std::vector<double> values;
        const auto means = [&](const Group& group, std::size_t count, double effect)
        {
            const RatingScale scale = scaleOf(group);
            std::vector<double> made;
            for (int person = 0; person < group.size; ++person)
            {
                const double leaning = params.biasSd * normalNumber(random);
                double sum = 0.0;
                for (std::size_t i = 0; i < count; ++i)
                {
                    const double points = 10.0 * middleShare + values[i % values.size()] + leaning + effect +
                                          params.noiseSd * normalNumber(random);
                    sum += onScale(scale, scale.low + (scale.high - scale.low) * points / 10.0);
                }
                made.push_back(sum / static_cast<double>(count));
            }
            return made;
        };
        for (std::size_t run = 0; run < runs; ++run)
        {
            values.clear();
            for (std::size_t i = 0; i < std::max(ofOther, ofLast); ++i)
                values.push_back(params.stimulusSd * normalNumber(random));
            const auto first = means(other, ofOther, 0.0), second = means(last, ofLast, params.effect);
            found += pooledTTest(first, second).p <= 0.05 ? 1u : 0u;
        }
        PowerEstimate estimate{other.name, last.name};
        estimate.runs = runs;
        estimate.byParticipant = static_cast<double>(found) / static_cast<double>(runs);
        estimate.standardError =
            std::sqrt(estimate.byParticipant * (1.0 - estimate.byParticipant) / static_cast<double>(runs));
        const auto n1 = static_cast<double>(other.size), n2 = static_cast<double>(last.size);
        const double error = std::sqrt(meanVariance(params, ofOther) / n1 + meanVariance(params, ofLast) / n2);
        const double degrees = n1 + n2 - 2.0;
        estimate.analytic = error > 0.0 ? powerAtFivePercent(degrees, params.effect / error) : 1.0;
        estimates.push_back(std::move(estimate));
    }
    return estimates;
}

} // namespace pacini::study
