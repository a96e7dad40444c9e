#include "cli/RenderReport.h"

#include "cli/Console.h"
#include "cli/Counted.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <utility>
#include <vector>

namespace pacini::cli
{

namespace
{
using Json = nlohmann::ordered_json;

constexpr std::size_t maxShown = 20;

Json decibels(double value)
{
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}

std::string decibelText(double value)
{
    return std::isfinite(value) ? fmt::format("{:.1f} dB", value) : "nothing lost";
}

Json decoderJson(const DecoderReport& report)
{
    return {{"innerRate", report.innerRate},
            {"carriers", report.carriers},
            {"silentBands", report.silentBands},
            {"noiseBands", report.noiseBands},
            {"levelled", report.levelled},
            {"pulses", report.pulses},
            {"maskedTransients", report.maskedTransients}};
}

/// All decoders as one; silent bands that the plan left out count too.
DecoderReport sumOf(const RenderResult& result)
{
    DecoderReport sum;
    for (const DecodedPlay& play : result.decoded)
    {
        sum.innerRate = std::max(sum.innerRate, play.decoder.innerRate);
        sum.carriers += play.decoder.carriers;
        sum.silentBands += play.decoder.silentBands;
        sum.noiseBands += play.decoder.noiseBands;
        sum.levelled = sum.levelled || play.decoder.levelled;
        sum.pulses += play.decoder.pulses;
        sum.maskedTransients += play.decoder.maskedTransients;
    }
    for (const LeftOut& item : result.leftOut)
        if (item.reason == "is silent" && item.where.find(".bands[") != std::string::npos)
            ++sum.silentBands;
    return sum;
}

std::string playText(const DecodedPlay& play, const std::string& name)
{
    const DecoderReport& d = play.decoder;
    std::string text = fmt::format("plays[{}]{}: {:.3f} s from {:.3f} s on; {}", play.play,
                                   name.empty() ? "" : " \"" + printable(name) + "\"", play.duration, play.start,
                                   counted(d.carriers, "sinusoid", "sinusoids"));
    if (d.noiseBands > 0)
        text += " and " + counted(d.noiseBands, "band of noise", "bands of noise");
    text += fmt::format(" at an inner rate of {:.0f} Hz{}, {}", d.innerRate,
                        d.levelled ? ", levelled to the envelope" : "", counted(d.pulses, "pulse", "pulses"));
    if (d.maskedTransients > 0)
        text += fmt::format(" ({} without a pulse: the bands alone are as strong)",
                            counted(d.maskedTransients, "event", "events"));
    return text;
}

/// Items of one kind (plays, bands or others) with the same reason.
using Kind = std::pair<std::string, std::vector<const LeftOut*>>;

std::vector<Kind> kindsOf(const std::vector<LeftOut>& items)
{
    std::vector<Kind> kinds;
    for (const LeftOut& item : items)
    {
        const auto same = [&](const Kind& kind)
        {
            return kind.first == item.reason && kind.second.front()->isWholePlay() == item.isWholePlay();
        };
        auto found = std::find_if(kinds.begin(), kinds.end(), same);
        if (found == kinds.end())
            found = kinds.insert(kinds.end(), {item.reason, {}});
        found->second.push_back(&item);
    }
    return kinds;
}
} // namespace

nlohmann::ordered_json planJson(const RenderResult& result, const CompileParams& params)
{
    Json plan = decoderJson(sumOf(result));
    plan["actuators"] = result.actuators;
    plan["givenPlays"] = result.givenPlays;
    plan["keptPlays"] = result.keptPlays;
    plan["mostSounding"] = result.maxSounding;
    plan["tolerance"] = params.leaveOut ? Json(params.tolerance) : Json(nullptr);
    plan["predictedError"] = decibels(result.predictedError);
    plan["culledError"] = decibels(result.culledError);
    if (result.measuredError)
        plan["measuredError"] = decibels(*result.measuredError);
    plan["leftOutCount"] = result.leftOut.size();
    if (!result.protection.empty())
        plan["protection"] = result.protection;
    return plan;
}

nlohmann::ordered_json planLists(const RenderResult& result)
{
    Json plays = Json::array(), adaptations = Json::array(), leftOut = Json::array();
    for (const DecodedPlay& play : result.decoded)
    {
        plays.push_back({{"play", play.play},
                         {"name", result.playNames[play.play]},
                         {"start", play.start},
                         {"duration", play.duration}});
        plays.back().update(decoderJson(play.decoder));
    }
    for (const Adaptation& item : result.adaptations)
        adaptations.push_back({{"where", item.where}, {"what", item.what}});
    for (const LeftOut& item : result.leftOut)
    {
        leftOut.push_back({{"where", item.where}, {"reason", item.reason}, {"error", decibels(item.error)}});
        if (item.unplayable)
            leftOut.back()["unplayable"] = true;
    }
    return {{"plays", plays}, {"adaptations", adaptations}, {"leftOut", leftOut}};
}

std::string planText(const RenderResult& result, const CompileParams& params)
{
    std::string text = fmt::format(
        "  {} of {} on {}, at most {} at a time", result.keptPlays, counted(result.givenPlays, "play", "plays"),
        counted(result.actuators, "actuator", "actuators"), counted(result.maxSounding, "decoder", "decoders"));
    for (std::size_t i = 0; i < std::min(result.decoded.size(), maxShown); ++i)
        text += "\n  " + playText(result.decoded[i], result.playNames[result.decoded[i].play]);
    if (result.decoded.size() > maxShown)
        text += fmt::format("\n  and {} more plays; --json lists them", result.decoded.size() - maxShown);

    if (!result.adaptations.empty())
        text += "\n  fitted to the actuator:";
    for (std::size_t i = 0; i < std::min(result.adaptations.size(), maxShown); ++i)
        text += fmt::format("\n    {}: {}", result.adaptations[i].where, result.adaptations[i].what);
    if (result.adaptations.size() > maxShown)
        text += fmt::format("\n    and {} more", result.adaptations.size() - maxShown);
    if (!result.protection.empty())
        text += "\n  protection: " + result.protection;
    text += result.leftOut.empty() ? "\n  nothing is left out" : "\n  left out:";
    for (const auto& [reason, items] : kindsOf(result.leftOut))
    {
        for (std::size_t i = 0; i < std::min(items.size(), maxShown); ++i)
            text += fmt::format("\n    {} {}: {}", items[i]->where, reason, decibelText(items[i]->error));
        if (items.size() > maxShown)
            text += fmt::format("\n    and {} more of the same kind", items.size() - maxShown);
    }
    text += "\n  predicted error: " + decibelText(result.predictedError);
    if (result.predictedError > result.culledError) // and not both that nothing is lost
        text += ", as the actuator cannot play everything; of the rest: " + decibelText(result.culledError);
    if (params.leaveOut)
        text += fmt::format(" (tolerance {:.1f} dB)", params.tolerance);
    if (result.measuredError)
        text += "; measured: " + decibelText(*result.measuredError);
    return text;
}

} // namespace pacini::cli
