#include "study/Screening.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace pacini::study
{

std::optional<Screening> screenListeners(std::vector<Rating>& ratings, const ReferenceCriterion& criterion,
                                         const std::function<bool(const Rating&)>& isScreened, bool keep)
{
    using Listener = std::pair<std::string, std::string>;
    Screening screening;
    std::map<Listener, ScreenedListener> listeners;
    std::set<std::string> references;
    for (const Rating& one : ratings)
        if (const auto wanted = criterion(one))
        {
            ScreenedListener& listener = listeners[{one.group, one.participant}];
            listener.group = one.group;
            listener.participant = one.participant;
            ++listener.trials;
            listener.below += one.value < *wanted ? 1u : 0u;
            references.insert(one.stimulus);
        }
    if (listeners.empty())
        return std::nullopt;
    screening.references.assign(references.begin(), references.end());
    std::set<Listener> failed;
    for (const auto& [who, listener] : listeners)
    {
        screening.everyone.push_back(listener);
        if (listener.share() <= screeningShare)
            continue;
        screening.failed.push_back(listener);
        failed.insert(who);
    }
    screening.nobodyPassed = failed.size() == listeners.size();
    screening.kept = keep || screening.nobodyPassed;
    if (!screening.kept)
        std::erase_if(ratings,
                      [&](const Rating& one) {
                          return isScreened(one) && failed.contains({one.group, one.participant});
                      });
    return screening;
}

std::optional<Screening> screenListeners(std::vector<Rating>& ratings, const Study& study, bool keep)
{
    std::map<std::string, const Block*> pages;
    for (const Block& block : study.blocks)
        if (block.task == Task::multiStimulus && !block.reference.empty())
            pages[block.name] = &block;
    const auto criterion = [&](const Rating& one) -> std::optional<double>
    {
        const auto page = pages.find(one.block);
        if (page == pages.end() || one.stimulus != page->second->reference)
            return std::nullopt;
        const RatingScale& scale = page->second->scale;
        return scale.low + screeningLevel * (scale.high - scale.low);
    };
    return screenListeners(
        ratings, criterion, [&](const Rating& one) { return pages.contains(one.block); }, keep);
}

Result<std::optional<Screening>> screenListeners(std::vector<Rating>& ratings,
                                                 const std::vector<std::string>& references, bool keep)
{
    constexpr double best = 100.0;
    const auto isReference = [&](const Rating& one, const std::string& name)
    {
        return one.stimulus == name;
    };
    for (const std::string& name : references)
        if (std::none_of(ratings.begin(), ratings.end(), [&](const Rating& one) { return isReference(one, name); }))
        {
            std::set<std::string> known;
            for (const Rating& one : ratings)
                known.insert(one.stimulus);
            constexpr std::size_t mostShown = 12;
            std::vector<std::string> shown(known.begin(), known.end());
            if (shown.size() > mostShown)
                shown.resize(mostShown);
            return Error{ErrorCode::invalidArgument, "--reference",
                         fmt::format("'{}' is no stimulus of the table; there are {}{}", name, fmt::join(shown, ", "),
                                     known.size() > mostShown ? " and others" : "")};
        }
    if (references.empty())
        return std::optional<Screening>();
    for (const Rating& one : ratings)
        if (one.value < 0.0 || one.value > best)
            return Error{ErrorCode::invalidArgument, "--reference",
                         fmt::format("needs ratings from 0 to 100, as ITU-R BS.1534-3 has them; one of '{}' is {}",
                                     one.stimulus, one.value)};
    const auto criterion = [&](const Rating& one) -> std::optional<double>
    {
        const bool is = std::any_of(references.begin(), references.end(),
                                    [&](const std::string& name) { return isReference(one, name); });
        return is ? std::optional(screeningLevel * best) : std::nullopt;
    };
    return screenListeners(
        ratings, criterion, [](const Rating&) { return true; }, keep);
}

} // namespace pacini::study
