#include "study/StudyCheck.h"

#include "study/Exposure.h"
#include "study/Plan.h"

#include <pacini/foundation/Units.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace pacini::study
{

namespace
{
/// s that an answer takes, from pilot experience with such tasks: assumed.
double answerSeconds(const Block& block, std::size_t stimuli)
{
    switch (block.task)
    {
    case Task::words:
        return 20.0;
    case Task::multiStimulus:
    case Task::ranking:
    case Task::sorting:
        return 10.0 * static_cast<double>(stimuli);
    case Task::rating:
    case Task::similarity:
        return 5.0;
    case Task::questionnaire:
        return 10.0 * static_cast<double>(block.items.size());
    case Task::which:
    case Task::place:
        return 5.0;
    case Task::side:
    case Task::count:
    case Task::abx:
    case Task::forcedChoice:
    case Task::staircase:
        return 2.0;
    }
    return 5.0;
}

constexpr double replayShare = 0.5;  // of trials, played once more
constexpr double sameBelow = -30.0;  // dB; smaller differences than 3 % of the amplitude are below all JNDs of level
constexpr double longSession = 60.0; // minutes
constexpr double longStretch = 30.0; // minutes without a break (ITU-R BS.1116-3: sessions of 20 to 30)
constexpr double evenLoudness = 6.0; // LU, +-3 as in Weber (2020), 5.1.2
constexpr std::size_t mostCompared = 40; // stimuli of a block, each with each

/// Prepared stimuli, and their exposure.
struct MadeStimulus
{
    double seconds = 0.0;
    double dose = 0.0;
    double soundDose = 0.0; ///< squared sound pressure re 20 uPa, A-weighted, over time, s
    PreparedStimulus prepared;
};

class Check
{
public:
    Check(const Study& toCheck, const StimulusParams& params, const std::function<void(double)>& toTell)
        : study(toCheck), maker(toCheck, params), progress(toTell)
    {
    }

    StudyCheck run()
    {
        result.exposureIsAssumed = !knowsFelt(maker.params().profile);
        makeAll();
        checkExposedPart();
        checkSoundAsWhole();
        checkGroups();
        checkTexts();
        for (std::size_t i = 0; i < study.blocks.size(); ++i)
            checkBlock(i);
        if (made.size() == study.stimuli.size())
            for (const Group& group : study.groups)
                addLoad(group);
        return std::move(result);
    }

private:
    void spoils(std::string where, std::string message)
    {
        result.findings.push_back({true, std::move(where), std::move(message)});
    }
    void doubts(std::string where, std::string message)
    {
        result.findings.push_back({false, std::move(where), std::move(message)});
    }

    void makeAll()
    {
        for (std::size_t i = 0; i < study.stimuli.size(); ++i)
        {
            progress(static_cast<double>(i) / static_cast<double>(study.stimuli.size()));
            auto prepared = maker.make(i);
            if (!prepared)
            {
                spoils(prepared.error().where, prepared.error().message);
                continue;
            }
            const int fs = maker.params().sampleRate;
            MadeStimulus one;
            one.seconds = static_cast<double>(prepared->touch.size()) / fs;
            one.dose = largestDose(prepared->touch, prepared->more, maker.params().profile, fs, study.limits.part);
            const auto isStill = [](const std::vector<float>& drive)
            {
                return std::all_of(drive.begin(), drive.end(), [](float x) { return x == 0.0f; });
            };
            const bool silent =
                isStill(prepared->touch) && std::all_of(prepared->more.begin(), prepared->more.end(), isStill);
            if (silent && !study.stimuli[i].silence)
                doubts(fmt::format("stimuli[{}]", i), fmt::format("\"{}\" has nothing to feel", study.stimuli[i].name));
            checkSound(i, prepared->sound, one);
            one.prepared = std::move(*prepared);
            made.emplace(i, std::move(one));
        }
    }

    /// Whether some block, or the check of comfort, plays the sound of a stimulus.
    [[nodiscard]] bool isHeard(std::size_t index) const
    {
        const std::string& name = study.stimuli[index].name;
        const auto has = [&](const std::vector<std::string>& names)
        {
            return std::find(names.begin(), names.end(), name) != names.end();
        };
        const auto plays = [&](const Block& block)
        {
            const auto own = stimuliOf(study, block);
            return hasStimuli(block) && block.presentation != Presentation::touch &&
                   (std::find(own.begin(), own.end(), index) != own.end() || has(block.training) ||
                    has(block.anchors) || block.reference == name);
        };
        return has(study.comfort) || std::any_of(study.blocks.begin(), study.blocks.end(), plays);
    }

    /// Notes the level of a sound and holds it against the limits.
    void checkSound(std::size_t index, const std::vector<float>& sound, MadeStimulus& one)
    {
        if (std::all_of(sound.begin(), sound.end(), [](float x) { return x == 0.0f; }) || !isHeard(index))
            return;
        HeardStimulus heard;
        heard.stimulus = study.stimuli[index].name;
        heard.levels = levelsOf(sound, maker.params().sampleRate);
        const std::string where = fmt::format("stimuli[{}]", index);
        if (study.calibration)
        {
            heard.soundPressure = heardLevel(*study.calibration, heard.levels.rms);
            heard.weighted = heardLevel(*study.calibration, heard.levels.weighted);
            one.soundDose = Decibels(*heard.weighted).gain() * Decibels(*heard.weighted).gain() * one.seconds;
            const double most = study.limits.soundLevel.value_or(usualSoundLevel);
            if (*heard.weighted > most)
                spoils(where, fmt::format("\"{}\" is heard at {:.1f} dB(A), {:.1f} are allowed (limits.soundLevel); "
                                          "lower soundLevel",
                                          heard.stimulus, *heard.weighted, most));
        }
        if (study.limits.loudness && heard.levels.loudness && *heard.levels.loudness > *study.limits.loudness)
            spoils(where, fmt::format("\"{}\" has {:.1f} LUFS, {:.1f} are allowed (limits.loudness); lower soundLevel",
                                      heard.stimulus, *heard.levels.loudness, *study.limits.loudness));
        if (heard.levels.clipped)
            doubts(where, fmt::format("\"{}\" is louder than full scale and will be clipped; lower soundLevel",
                                      heard.stimulus));
        result.heard.push_back(std::move(heard));
    }

    void checkExposedPart()
    {
        if (!maker.params().profile)
            return;
        const auto shaken = exposedPartOf(*maker.params().profile);
        if (!shaken || *shaken == study.limits.part)
            return;
        const bool isSeat = *shaken == ExposedPart::wholeBody;
        doubts("limits.part",
               fmt::format("is {}, but '{}' shakes {}, whose exposure {} limits to {:g} m/s2; state \"limits\": "
                           "{{\"part\": \"{}\"}}",
                           isSeat ? "the hand" : "the whole body", maker.params().profile->name,
                           isSeat ? "the whole body" : "a hand", standardOf(*shaken), actionValue(*shaken),
                           isSeat ? "wholeBody" : "hand"));
    }

    void checkSoundAsWhole()
    {
        if (!study.calibration && (study.limits.soundLevel || study.limits.soundDaily))
            spoils("limits", "has a limit in dB(A), which nothing can be held against without a calibration; play "
                             "the tone of pacini study tone, measure its level at the ear and enter it as "
                             "\"calibration\": {\"level\": 70}");
        if (study.limits.loudness && !knowsLoudness())
            spoils("limits.loudness", "cannot be checked, as this program was built without libebur128");
        std::optional<double> least, most;
        for (const HeardStimulus& one : result.heard)
            if (one.levels.loudness)
            {
                least = std::min(least.value_or(*one.levels.loudness), *one.levels.loudness);
                most = std::max(most.value_or(*one.levels.loudness), *one.levels.loudness);
            }
        if (least && *most - *least > evenLoudness)
            doubts("stimuli",
                   fmt::format("are unequally loud: {:.1f} to {:.1f} LUFS; soundLevel of each makes them alike", *least,
                               *most));
    }

    void checkGroups()
    {
        int smallest = study.groups.front().size, largest = smallest;
        for (const Group& group : study.groups)
        {
            smallest = std::min(smallest, group.size);
            largest = std::max(largest, group.size);
        }
        if (smallest != largest)
            doubts("groups",
                   fmt::format("are uneven: {} to {} participants; comparisons are strongest between equal ones",
                               smallest, largest));
        if (smallest < 2)
            doubts("groups", "has one with a single participant, about which no statistics can be made");
    }

    void checkTexts()
    {
        std::set<std::string> languages;
        const auto collect = [&](const Text& text)
        {
            for (const auto& [code, said] : text)
                languages.insert(code);
        };
        collect(study.welcome);
        for (const Block& block : study.blocks)
        {
            collect(block.question);
            for (const Item& item : block.items)
                collect(item.question);
        }
        const auto demand = [&](const Text& text, const std::string& where, bool needed)
        {
            if (text.empty())
            {
                if (needed)
                    spoils(where, "is missing: participants would not know what to do");
                return;
            }
            for (const std::string& language : languages)
                if (std::none_of(text.begin(), text.end(), [&](const auto& pair) { return pair.first == language; }))
                    doubts(where, fmt::format("has no text in \"{}\", in which other texts are", language));
        };
        demand(study.welcome, "welcome", false);
        demand(study.consent, "consent", false);
        demand(study.goodbye, "goodbye", false);
        for (std::size_t i = 0; i < study.blocks.size(); ++i)
        {
            const std::string where = fmt::format("blocks[{}]", i);
            demand(study.blocks[i].question, where + ".question", hasStimuli(study.blocks[i]));
            for (std::size_t k = 0; k < study.blocks[i].items.size(); ++k)
            {
                const Item& item = study.blocks[i].items[k];
                const std::string place = fmt::format("{}.items[{}]", where, k);
                demand(item.question, place + ".question", true);
                for (std::size_t c = 0; c < item.choices.size(); ++c)
                    demand(item.choices[c].text, fmt::format("{}.choices[{}].text", place, c), false);
            }
            demand(study.blocks[i].scale.lowLabel, where + ".scale.lowLabel", false);
            demand(study.blocks[i].scale.highLabel, where + ".scale.highLabel", false);
        }
        if (study.consent.empty())
            doubts("consent", "is missing; most committees ask for one");
    }

    void checkBlock(std::size_t index)
    {
        const Block& block = study.blocks[index];
        const std::string where = fmt::format("blocks[{}]", index);
        const std::vector<std::size_t> stimuli = stimuliOf(study, block);
        const std::size_t rows = stimuli.size() % 2 == 0 ? stimuli.size() : 2 * stimuli.size();
        if (block.order == Order::latinSquare)
            for (const Group& group : study.groups)
                if (isFor(block, group.name) && group.size % static_cast<int>(rows) != 0)
                    doubts(where + ".order", fmt::format("is balanced for multiples of {} participants; {} has {}",
                                                         rows, group.name, group.size));
        for (const Group& group : study.groups)
            if (std::none_of(study.blocks.begin(), study.blocks.end(),
                             [&](const Block& one) { return isFor(one, group.name); }))
                spoils("groups", fmt::format("has \"{}\", for which there is no block", group.name));
        if (!hasStimuli(block))
            return;
        if (block.presentation == Presentation::touch && !block.masking)
            doubts(where + ".masking", "is off: participants may hear the actuator");
        // Only what is presented as it is; a staircase varies one stimulus.
        if (block.task != Task::staircase && stimuli.size() <= mostCompared)
            for (std::size_t i = 0; i < stimuli.size(); ++i)
                for (std::size_t k = i + 1; k < stimuli.size(); ++k)
                    compare(where, stimuli[i], stimuli[k], block);
        if (!block.reference.empty() && block.task != Task::staircase)
            for (const std::size_t stimulus : stimuli)
                compare(where, stimulus, stimulusNamed(study, block.reference), block);
    }

    void compare(const std::string& where, std::size_t i, std::size_t k, const Block& block)
    {
        const auto a = made.find(i), b = made.find(k);
        if (i == k || a == made.end() || b == made.end())
            return;
        double difference = -std::numeric_limits<double>::infinity();
        if (block.presentation != Presentation::sound)
            difference = touchDifference(a->second.prepared, b->second.prepared);
        if (block.presentation != Presentation::touch)
            difference = std::max(difference, differenceDecibels(a->second.prepared.sound, b->second.prepared.sound));
        if (difference < sameBelow)
            doubts(where, fmt::format("\"{}\" and \"{}\" can hardly be told apart: they differ by {:.0f} dB",
                                      study.stimuli[i].name, study.stimuli[k].name, difference));
    }

    void addLoad(const Group& group)
    {
        std::size_t slot = 0;
        while (study.groups[groupOfSlot(study, slot)].name != group.name)
            ++slot;
        GroupLoad load;
        load.group = group.name;
        double seconds = 0.0, dose = 0.0, soundDose = 0.0;
        for (std::size_t index = 0; index < study.blocks.size(); ++index)
        {
            const Block& block = study.blocks[index];
            if (!isFor(block, group.name))
                continue;
            for (const Trial& trial : trialsOf(study, index, slot))
            {
                ++load.trials;
                double playing = 0.0;
                for (const std::size_t stimulus : trial.stimuli)
                {
                    const MadeStimulus& one = made.at(stimulus);
                    playing +=
                        one.seconds * (block.presentation == Presentation::consecutive ? 2.0 : 1.0) + block.pause;
                    if (block.presentation != Presentation::sound)
                        dose += one.dose * (1.0 + replayShare);
                    if (block.presentation != Presentation::touch)
                        soundDose += one.soundDose * (1.0 + replayShare);
                    if (study.calibration && block.masking && block.presentation != Presentation::simultaneous &&
                        block.presentation != Presentation::sound)
                    {
                        // Unweighted, which is never less.
                        const double noise = Decibels(heardLevel(*study.calibration, study.masking.level)).gain();
                        soundDose += noise * noise * (one.seconds + block.pause) * (1.0 + replayShare);
                    }
                }
                seconds += playing * (1.0 + replayShare) + answerSeconds(block, trial.stimuli.size());
            }
        }
        load.minutes = seconds / 60.0;
        load.exposure = dailyExposure(dose);
        if (soundDose > 0.0)
        {
            load.soundDaily = Decibels::fromPower(soundDose / (8.0 * 3600.0)).value;
            const double most = study.limits.soundDaily.value_or(usualSoundDaily);
            if (*load.soundDaily > most)
                spoils("limits.soundDaily",
                       fmt::format("would be passed: group {} is exposed to L_EX,8h = {:.1f} dB(A), {:.1f} are allowed",
                                   group.name, *load.soundDaily, most));
        }
        if (load.exposure > study.limits.daily)
            spoils("limits.daily",
                   fmt::format("would be passed: group {} is exposed to A(8) = {:.2f} m/s2, {:.2f} are allowed ({})",
                               group.name, load.exposure, study.limits.daily, standardOf(study.limits.part)));
        if (load.minutes > study.limits.minutes)
            spoils("limits.minutes",
                   fmt::format("would be passed: group {} takes some {:.0f} minutes, {:.0f} are allowed", group.name,
                               load.minutes, study.limits.minutes));
        else if (load.minutes > longSession)
            doubts("blocks", fmt::format("take some {:.0f} minutes in group {}; people tire after an hour",
                                         load.minutes, group.name));
        else if (load.minutes > longStretch && !hasBreaks(group))
            doubts(
                "blocks",
                fmt::format("are {} trials and some {:.0f} minutes in group {} without a break; breakAfter makes some",
                            load.trials, load.minutes, group.name));
        result.loads.push_back(std::move(load));
    }

    [[nodiscard]] bool hasBreaks(const Group& group) const
    {
        return std::any_of(study.blocks.begin(), study.blocks.end(),
                           [&](const Block& one) { return isFor(one, group.name) && one.breakAfter > 0; });
    }

    const Study& study;
    StimulusMaker maker;
    const std::function<void(double)>& progress;
    std::map<std::size_t, MadeStimulus> made;
    StudyCheck result;
};
} // namespace

namespace
{
/// Energies of a difference, and of the mean of both.
struct DifferenceSum
{
    double difference = 0.0, energy = 0.0;

    void add(const std::vector<float>& a, const std::vector<float>& b);
    [[nodiscard]] double decibels() const
    {
        return difference > 0.0 ? Decibels::fromPower(difference / energy).value
                                : -std::numeric_limits<double>::infinity();
    }
};

void DifferenceSum::add(const std::vector<float>& a, const std::vector<float>& b)
{
    for (std::size_t n = 0; n < std::max(a.size(), b.size()); ++n)
    {
        const double x = n < a.size() ? static_cast<double>(a[n]) : 0.0,
                     y = n < b.size() ? static_cast<double>(b[n]) : 0.0;
        difference += (x - y) * (x - y);
        energy += 0.5 * (x * x + y * y);
    }
}
} // namespace

double differenceDecibels(const std::vector<float>& a, const std::vector<float>& b)
{
    DifferenceSum sum;
    sum.add(a, b);
    return sum.decibels();
}

double touchDifference(const PreparedStimulus& a, const PreparedStimulus& b)
{
    DifferenceSum sum;
    sum.add(a.touch, b.touch);
    for (std::size_t i = 0; i < std::min(a.more.size(), b.more.size()); ++i)
        sum.add(a.more[i], b.more[i]);
    return sum.decibels();
}

StudyCheck checkStudy(const Study& study, const StimulusParams& params, const std::function<void(double)>& progress)
{
    return Check(study, params, progress).run();
}

} // namespace pacini::study
