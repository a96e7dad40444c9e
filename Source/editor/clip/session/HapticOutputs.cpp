// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/session/HapticOutputs.h"

#include <pacini/foundation/Clamp.h>

#include <algorithm>
#include <utility>

namespace pacini::editor
{

namespace
{
/// Outputs that stand evenly go on doing so when their number changes.
bool standEvenly(const std::vector<HapticOutput>& outputs)
{
    for (std::size_t i = 0; i < outputs.size(); ++i)
        if (outputs[i].place != RowPlaces::placeOf(i, outputs.size()))
            return false;
    return true;
}

void spread(std::vector<HapticOutput>& outputs)
{
    for (std::size_t i = 0; i < outputs.size(); ++i)
        outputs[i].place = RowPlaces::placeOf(i, outputs.size());
}
} // namespace

void HapticOutputs::setOutputs(std::vector<HapticOutput> wanted)
{
    wanted.resize(std::clamp<std::size_t>(wanted.size(), 1, most));
    for (HapticOutput& output : wanted)
    {
        output.channel = std::max(output.channel, -1);
        output.gain = clampTo(output.gain, leastGain, 0.0);
        output.delay = clampTo(output.delay, 0.0, longestDelay);
        output.place = clampTo(output.place, 0.0, 1.0);
    }
    if (list == wanted)
        return;
    list = std::move(wanted);
    changed.emit();
}

void HapticOutputs::add()
{
    if (list.size() >= most)
        return;
    auto wanted = list;
    HapticOutput added;
    added.channel = freeChannel();
    wanted.push_back(added);
    wanted.back().place = 1.0;
    if (standEvenly(list))
        spread(wanted);
    setOutputs(std::move(wanted));
}

/// Behind the last output, else the first that neither an output nor the sound has; -1: there is none.
int HapticOutputs::freeChannel() const
{
    const int next = list.back().channel + 1;
    if (!device)
        return next;
    const int count = static_cast<int>(device->size());
    for (int i = 0; i < count; ++i)
    {
        const int channel = (next + i) % count;
        const bool ofSound = sound >= 0 && (channel == sound || channel == sound + 1);
        const bool taken = std::any_of(list.begin(), list.end(),
                                       [channel](const HapticOutput& output) { return output.channel == channel; });
        if (!ofSound && !taken && (*device)[static_cast<std::size_t>(channel)])
            return channel;
    }
    return -1;
}

void HapticOutputs::setDevice(std::optional<std::vector<bool>> channelsOn, int soundChannel)
{
    if (device == channelsOn && sound == soundChannel)
        return;
    device = std::move(channelsOn);
    sound = soundChannel;
    changed.emit();
}

int HapticOutputs::channelOf(std::size_t output) const
{
    const auto place = [this](std::size_t i)
    {
        if (!device)
            return list[i].channel;
        const int channel = std::min(list[i].channel, static_cast<int>(device->size()) - 1);
        return channel >= 0 && (*device)[static_cast<std::size_t>(channel)] ? channel : -1;
    };
    const int channel = output < list.size() ? place(output) : -1;
    for (std::size_t i = 0; i < output && channel >= 0; ++i)
        if (place(i) == channel)
            return -1;
    return channel;
}

std::size_t HapticOutputs::playingCount() const
{
    std::size_t count = 0;
    for (std::size_t i = 0; i < list.size(); ++i)
        if (channelOf(i) >= 0)
            ++count;
    return count;
}

bool HapticOutputs::readyToPlay() const
{
    const bool ready = canPlay();
    if (!ready && onNowhere)
        onNowhere();
    return ready;
}

void HapticOutputs::removeLast()
{
    if (list.size() < 2)
        return;
    auto wanted = list;
    wanted.pop_back();
    if (standEvenly(list))
        spread(wanted);
    setOutputs(std::move(wanted));
}

void HapticOutputs::setPan(std::optional<PanLaw> wanted)
{
    if (law == wanted)
        return;
    law = wanted;
    changed.emit();
}

PreviewRow HapticOutputs::row(const Actuators& actuators) const
{
    PreviewRow row;
    row.strength = actuators.strength();
    row.pan = law;
    row.profiles.clear();
    const auto ofProject = actuators.profile();
    for (const HapticOutput& output : list)
    {
        row.places.push_back(output.place);
        const auto& profiles = actuators.profiles();
        const auto named = std::find_if(profiles.begin(), profiles.end(),
                                        [&](const NamedProfile& entry) { return entry.name == output.actuator; });
        row.profiles.push_back(output.actuator == plainDrive ? nullptr
                               : named != profiles.end()     ? named->profile
                                                             : ofProject);
    }
    return row;
}

} // namespace pacini::editor
