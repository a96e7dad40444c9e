#include "study/StudyFile.h"

#include "io/FieldsDocument.h"
#include "io/FieldsWriter.h"
#include "io/InputFile.h"
#include "study/StudyFields.h"

#include <pacini/analysis/methods/Method.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

namespace pacini::study
{

namespace
{
constexpr double largestSeed = 0x1.0p53;
constexpr double mostLevel = 200.0; // dB, either way

/// Collects the first thing that is wrong.
class Rules
{
public:
    std::optional<Error> broken;

    void that(bool kept, const std::string& where, const std::string& message)
    {
        if (!kept && !broken)
            broken = Error{ErrorCode::invalidArgument, where, message};
    }
    void range(double value, double low, double high, const std::string& where, std::string_view unit = "")
    {
        that(value >= low && value <= high, where, fmt::format("must be {} to {}{}", low, high, unit));
    }
    template <typename List>
    void uniqueNames(const List& list, const std::string& where)
    {
        std::set<std::string> names;
        for (std::size_t i = 0; i < list.size(); ++i)
        {
            const std::string place = fmt::format("{}[{}].name", where, i);
            that(!list[i].name.empty(), place, "must say something");
            that(names.insert(list[i].name).second, place,
                 fmt::format("is \"{}\", which another one is called, too", shownText(list[i].name)));
        }
    }
    void stimuliNamed(const Study& study, const std::vector<std::string>& names, const std::string& where)
    {
        for (std::size_t i = 0; i < names.size(); ++i)
            stimulus(study, names[i], fmt::format("{}[{}]", where, i));
    }
    void stimulus(const Study& study, const std::string& name, const std::string& where)
    {
        that(stimulusNamed(study, name) != noStimulus, where,
             fmt::format("is \"{}\", which no stimulus is called", shownText(name)));
    }
};

/// Parts of a mix are single stimuli, each once.
void checkMix(Rules& rules, const Study& study, const Stimulus& stimulus, const std::string& where)
{
    rules.stimuliNamed(study, stimulus.mix, where + ".mix");
    if (rules.broken || stimulus.mix.empty())
        return;
    rules.that(stimulus.mix.size() >= 2, where + ".mix", "needs two stimuli at least");
    rules.that(stimulus.sound.empty(), where, "has both sound and mix; the sounds of a mix are those of its stimuli");
    rules.that(!stimulus.place, where, "has both place and mix; each stimulus of a mix has its own place");
    rules.that(!stimulus.sensationLevel && !stimulus.acceleration, where,
               "has a level that is felt and a mix; each stimulus of a mix has its own level");
    for (std::size_t i = 0; i < stimulus.mix.size(); ++i)
    {
        const std::string place = fmt::format("{}.mix[{}]", where, i);
        const Stimulus& part = study.stimuli[stimulusNamed(study, stimulus.mix[i])];
        rules.that(part.mix.empty() && !part.silence, place,
                   fmt::format("is \"{}\", which is not a single event", shownText(part.name)));
        rules.that(std::count(stimulus.mix.begin(), stimulus.mix.end(), part.name) == 1, place,
                   fmt::format("is \"{}\", which is in the mix twice", shownText(part.name)));
    }
}

void checkItem(Rules& rules, const Item& item, const std::string& where)
{
    rules.that(!item.question.empty(), where + ".question", "is missing");
    rules.that(std::isfinite(item.scale.low) && std::isfinite(item.scale.high) && item.scale.low < item.scale.high,
               where + ".scale.high", "must be above low");
    rules.range(item.scale.step, 0.0, item.scale.high - item.scale.low, where + ".scale.step");
    rules.that((item.kind == QuestionKind::choice) == !item.choices.empty(), where + ".choices",
               "belong to kind choice, which needs them");
    rules.that(item.kind != QuestionKind::choice || item.choices.size() >= 2, where + ".choices",
               "needs two at least, to choose from");
    rules.uniqueNames(item.choices, where + ".choices");
    constexpr double mostPoints = 20.0;
    if (item.kind == QuestionKind::likert)
        rules.that(item.scale.step > 0.0 && (item.scale.high - item.scale.low) / item.scale.step < mostPoints,
                   where + ".scale.step", "must make a scale of at most 20 points, such as 1 from low 1 to high 5");
}

void checkStimulus(Rules& rules, const Study& study, const Stimulus& stimulus, const std::string& where)
{
    const int felt = (stimulus.clip.empty() ? 0 : 1) + (stimulus.drive.empty() ? 0 : 1) + (stimulus.tone ? 1 : 0) +
                     (stimulus.silence ? 1 : 0) + (stimulus.mix.empty() ? 0 : 1);
    rules.that(felt <= 1, where, "has more than one of clip, drive, tone, silence and mix");
    rules.that(felt == 1 || !stimulus.sound.empty(), where,
               "has nothing to feel or hear: sound, clip, drive, tone, silence, mix");
    checkMix(rules, study, stimulus, where);
    if (stimulus.place)
    {
        rules.range(stimulus.place->position, 0.0, 1.0, where + ".place.position");
        rules.that(study.row.actuators >= 2, where + ".place",
                   "needs two actuators at least: \"row\": {\"actuators\": 2}");
    }
    rules.range(stimulus.soundLevel, -mostLevel, 40.0, where + ".soundLevel", " dB");
    rules.range(stimulus.touchLevel, -mostLevel, 40.0, where + ".touchLevel", " dB");
    rules.that(!stimulus.sensationLevel || !stimulus.acceleration, where,
               "has both sensationLevel and acceleration, which each say how strong it is");
    if (stimulus.sensationLevel)
        rules.range(*stimulus.sensationLevel, -40.0, 140.0, where + ".sensationLevel", " dB");
    if (stimulus.acceleration)
        rules.range(*stimulus.acceleration, 0.001, 1000.0, where + ".acceleration", " m/s2");
    if (stimulus.silence)
        rules.range(*stimulus.silence, 0.01, 60.0, where + ".silence", " s");
    if (stimulus.tone)
    {
        rules.range(stimulus.tone->frequency, 1.0, 1000.0, where + ".tone.frequency", " Hz");
        rules.range(stimulus.tone->duration, 0.01, 60.0, where + ".tone.duration", " s");
        rules.range(stimulus.tone->fade, 0.0, 0.5 * stimulus.tone->duration, where + ".tone.fade", " s");
        rules.range(stimulus.tone->level, -mostLevel, 0.0, where + ".tone.level", " dB");
    }
    rules.that(
        stimulus.method.empty() || methodNamed(stimulus.method), where + ".method",
        fmt::format("'{}' is not a translation method; see pacini encode --list-methods", shownText(stimulus.method)));
    if (stimulus.bands)
        rules.range(*stimulus.bands, 1.0, 32.0, where + ".bands");
    if (stimulus.breakpoints)
        rules.range(*stimulus.breakpoints, 0.5, 1000.0, where + ".breakpoints", " per second and band");
    if (stimulus.bits)
        rules.range(*stimulus.bits, 4.0, 16.0, where + ".bits");
}

void checkAdaptive(Rules& rules, const Adaptive& adaptive, const std::string& where)
{
    rules.that(adaptive.lowest < adaptive.highest && std::isfinite(adaptive.highest - adaptive.lowest),
               where + ".highest", "must be above lowest");
    rules.range(adaptive.start, adaptive.lowest, adaptive.highest, where + ".start");
    rules.that(adaptive.step > 0.0 && std::isfinite(adaptive.step), where + ".step", "must be above 0");
    rules.that(adaptive.finalStep > 0.0 && adaptive.finalStep <= adaptive.step, where + ".finalStep",
               "must be above 0 and at most step");
    rules.range(adaptive.down, 1, 4, where + ".down");
    rules.range(adaptive.reversals, 2, 100, where + ".reversals");
    rules.range(adaptive.trials, 5, 1000, where + ".trials");
    if (adaptive.variable == Variable::level)
        rules.range(adaptive.highest, -mostLevel, 0.0, where + ".highest", " dB re full drive");
    else
        rules.that(adaptive.lowest > 0.0, where + ".lowest", "must be above 0");
}

/// Tasks about places and about events at once need stimuli that have such.
void checkSpace(Rules& rules, const Study& study, const Block& block, const std::string& where)
{
    if (block.task == Task::place || block.task == Task::side)
        for (const std::size_t index : stimuliOf(study, block))
            rules.that(
                study.stimuli[index].place.has_value(), where + ".stimuli",
                fmt::format("has \"{}\" without the place that is asked for", shownText(study.stimuli[index].name)));
    if (block.task != Task::count && block.task != Task::which)
        return;
    const std::size_t events = eventsOf(study, block).size();
    rules.that(events >= 2, where + ".stimuli", "needs two events at least, to tell how many or which");
    rules.that(events <= studyLimits::events, where + ".stimuli",
               fmt::format("has {} different events; {} are the most", events, studyLimits::events));
}

void checkBlock(Rules& rules, const Study& study, const Block& block, const std::string& where)
{
    for (std::size_t i = 0; i < block.groups.size(); ++i)
        rules.that(std::any_of(study.groups.begin(), study.groups.end(),
                               [&](const Group& group) { return group.name == block.groups[i]; }),
                   fmt::format("{}.groups[{}]", where, i),
                   fmt::format("is \"{}\", which no group is called", shownText(block.groups[i])));
    rules.stimuliNamed(study, block.stimuli, where + ".stimuli");
    rules.stimuliNamed(study, block.training, where + ".training");
    rules.stimuliNamed(study, block.anchors, where + ".anchors");
    if (!block.reference.empty())
        rules.stimulus(study, block.reference, where + ".reference");
    if (needsReference(block))
        rules.that(!block.reference.empty(), where + ".reference",
                   fmt::format("is missing, which {} is held against", nameOf(block.task, fields::tasks)));
    rules.that((block.task == Task::questionnaire) == !block.items.empty(), where + ".items",
               "belong to the task questionnaire, which needs them");
    rules.uniqueNames(block.items, where + ".items");
    for (std::size_t i = 0; i < block.items.size(); ++i)
        checkItem(rules, block.items[i], fmt::format("{}.items[{}]", where, i));
    if (rules.broken || !hasStimuli(block))
        return;
    checkSpace(rules, study, block, where);
    const std::size_t count = stimuliOf(study, block).size();
    rules.that(count > 0, where + ".stimuli", "leaves nothing to present");
    if (block.task == Task::similarity || block.task == Task::ranking || block.task == Task::sorting)
        rules.that(count >= 2, where + ".stimuli", "needs two at least");
    constexpr std::size_t mostAtOnce = 30; // on one page
    if (block.task == Task::multiStimulus || block.task == Task::ranking || block.task == Task::sorting)
        rules.that(count <= mostAtOnce, where + ".stimuli",
                   fmt::format("has more than {}, too many for one page", mostAtOnce));
    rules.that(block.scale.low < block.scale.high && std::isfinite(block.scale.high - block.scale.low),
               where + ".scale.high", "must be above low");
    rules.range(block.scale.step, 0.0, block.scale.high - block.scale.low, where + ".scale.step");
    rules.range(block.intervals, 2, 3, where + ".intervals");
    rules.range(block.repeats, 1, 1000, where + ".repeats");
    rules.range(block.replays, -1, 1000, where + ".replays");
    rules.range(block.breakAfter, 0, 1000, where + ".breakAfter");
    rules.range(block.delay, -2.0, 2.0, where + ".delay", " s");
    rules.range(block.pause, 0.0, 10.0, where + ".pause", " s");
    checkAdaptive(rules, block.adaptive, where + ".adaptive");
}
} // namespace

Result<void> validate(const Study& study)
{
    Rules rules;
    rules.that(!study.name.empty(), "name", "must say something");
    rules.that(static_cast<double>(study.seed) <= largestSeed, "seed", "must be 0 to 2^53");
    rules.that(!study.groups.empty(), "groups", "has none; a study of everybody has one");
    rules.that(!study.stimuli.empty() || std::none_of(study.blocks.begin(), study.blocks.end(), hasStimuli), "stimuli",
               "has none");
    rules.that(!study.blocks.empty(), "blocks", "has none");
    rules.uniqueNames(study.groups, "groups");
    rules.uniqueNames(study.stimuli, "stimuli");
    rules.uniqueNames(study.blocks, "blocks");
    for (std::size_t i = 0; i < study.groups.size(); ++i)
        rules.range(study.groups[i].size, 1, studyLimits::participants, fmt::format("groups[{}].size", i));
    for (std::size_t i = 0; i < study.stimuli.size(); ++i)
        checkStimulus(rules, study, study.stimuli[i], fmt::format("stimuli[{}]", i));
    rules.stimuliNamed(study, study.comfort, "comfort");
    for (std::size_t i = 0; i < study.blocks.size(); ++i)
        checkBlock(rules, study, study.blocks[i], fmt::format("blocks[{}]", i));
    rules.range(study.touchLevel, -mostLevel, 40.0, "touchLevel", " dB");
    rules.range(study.soundLevel, -mostLevel, 40.0, "soundLevel", " dB");
    rules.range(study.masking.level, -mostLevel, 0.0, "masking.level", " dB");
    rules.range(study.masking.lowFrequency, 1.0, 20000.0, "masking.lowFrequency", " Hz");
    rules.range(study.masking.highFrequency, study.masking.lowFrequency, 20000.0, "masking.highFrequency", " Hz");
    // Above the limit value of the directive nobody may be exposed, whatever a file says.
    rules.range(study.limits.daily, 0.0, limitValue(study.limits.part), "limits.daily", " m/s2");
    rules.range(study.limits.minutes, 1.0, 480.0, "limits.minutes");
    rules.range(study.limits.soundLevel.value_or(usualSoundLevel), 0.0, 100.0, "limits.soundLevel", " dB(A)");
    rules.range(study.limits.soundDaily.value_or(usualSoundDaily), 0.0, 87.0, "limits.soundDaily", " dB(A)");
    rules.range(study.limits.loudness.value_or(0.0), -70.0, 0.0, "limits.loudness", " LUFS");
    rules.range(study.row.actuators, 1, mostActuators, "row.actuators");
    rules.range(study.row.delay, 0.0, 0.1, "row.delay", " s");
    if (study.calibration)
    {
        rules.range(study.calibration->tone, -100.0, 0.0, "calibration.tone", " dB re full scale");
        rules.range(study.calibration->level, 0.0, 140.0, "calibration.level", " dB SPL");
    }
    if (rules.broken)
        return *rules.broken;
    return {};
}

Result<Study> readStudyJson(std::string_view text, ReadWarnings* warnings)
{
    return validated(readDocument<Study>(text, {"a study", studyFormatName, studyFormatVersion, largestStudyText},
                                         warnings,
                                         [](auto& study, auto& reader)
                                         {
                                             double seed = static_cast<double>(study.seed);
                                             reader.number("seed", seed, Need::usual);
                                             if (!(seed >= 0.0 && seed <= largestSeed && std::trunc(seed) == seed))
                                                 reader.fail("seed", "must be a whole number, 0 to 2^53");
                                             else
                                                 study.seed = static_cast<std::uint64_t>(seed);
                                             fields::visitStudy(study, reader);
                                         }));
}

Result<Study> readStudy(const std::filesystem::path& path, ReadWarnings* warnings)
{
    const auto text = readWholeFile(path, largestStudyText);
    return text ? readStudyJson(*text, warnings) : text.error();
}

std::string studyJson(const Study& study)
{
    FieldsWriter writer(FieldsWriter::Layout::lines);
    writer.format({studyFormatName, studyFormatVersion});
    writer.integer("seed", study.seed);
    fields::visitStudy(study, writer);
    return std::move(writer).document();
}

} // namespace pacini::study
