#include "study/PersonalProfile.h"

#include <pacini/actuator/Equalizer.h>
#include <pacini/foundation/Units.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <string>
#include <utility>
#include <vector>

namespace pacini::study
{

namespace
{
constexpr double designRate = 48000.0; // Hz; the sections do not depend on it below 1 kHz

const Block* detectionBlock(const Study& study, const std::string& name)
{
    for (const Block& block : study.blocks)
        if (block.name == name && block.task == Task::staircase && block.adaptive.variable == Variable::level)
            return &block;
    return nullptr;
}
} // namespace

Result<Profile> personalProfile(const Profile& profile, const StudyResults& results, std::string_view participant)
{
    const BiquadCascadeCoefficients equalizer = designEqualizer(profile.equalizer, designRate);
    std::vector<double> ranges;
    std::string frequencies;
    for (const PersonalThreshold& one : results.thresholds)
    {
        const Block* block = one.participant == participant ? detectionBlock(results.study, one.block) : nullptr;
        const std::size_t index = stimulusNamed(results.study, one.stimulus);
        if (block == nullptr || index == noStimulus || !results.study.stimuli[index].tone)
            continue;
        const double frequency = results.study.stimuli[index].tone->frequency;
        if (frequency < profile.range.lowFrequency || frequency > profile.range.highFrequency)
            continue;
        if (one.estimate.strength95.high >= block->adaptive.highest)
            return Error{ErrorCode::invalidArgument, one.stimulus,
                         fmt::format("was hardly felt by {} at full drive: the threshold is not known", participant)};
        const double gain = Decibels::fromGain(std::abs(equalizer.response(Hertz(frequency), designRate))).value;
        ranges.push_back(gain - one.estimate.strength);
        frequencies += fmt::format("{}{}", frequencies.empty() ? "" : ", ", frequency);
    }
    if (ranges.empty())
        return Error{ErrorCode::invalidArgument, "",
                     fmt::format("has no threshold of '{}' within {} to {} Hz; pacini study new --template threshold "
                                 "makes a study that finds them",
                                 participant, profile.range.lowFrequency, profile.range.highFrequency)};
    Profile personal = profile;
    personal.name = fmt::format("{}, {}", profile.name, participant);
    if (!profile.shortName.empty())
        personal.shortName = fmt::format("{}, {}", profile.shortName, participant);
    personal.range.dynamicRange = std::clamp(meanOf(ranges), 1.0, 140.0);
    std::erase_if(personal.sources, [](const ProfileSource& source) { return source.path == "range.dynamicRange"; });
    personal.sources.push_back(
        {"range.dynamicRange",
         fmt::format("thresholds of {} at {} Hz in the study \"{}\", {} trials each at most", participant, frequencies,
                     results.study.name,
                     std::max_element(results.thresholds.begin(), results.thresholds.end(),
                                      [](const auto& a, const auto& b) { return a.trials < b.trials; })
                         ->trials)});
    std::sort(personal.sources.begin(), personal.sources.end(),
              [](const auto& a, const auto& b) { return a.path < b.path; });
    if (auto valid = validate(personal); !valid)
        return valid.error();
    return personal;
}

} // namespace pacini::study
