// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/session/Actuators.h"

#include "document/Amendments.h"

#include <pacini/actuator/ActuatorFit.h>
#include <pacini/foundation/Clamp.h>

#include <algorithm>
#include <utility>

namespace pacini::editor
{

Actuators::Actuators(EditorModel& project, std::vector<NamedProfile> profiles)
    : model(project), list(std::move(profiles))
{
    subscriptions.on({&model.projectChanged}, [this] { follow(); });
}

void Actuators::setUsual(const std::string& name)
{
    if (usualName == name)
        return;
    usualName = name;
    if (model.document().isUntouched() && name != profileName())
        choose(name);
    usualChanged.emit();
}

void Actuators::follow()
{
    if (model.document().isUntouched() && profileName().empty() && !usualName.empty())
        return choose(usualName); // comes back here
    if (known == model.document().project().profile)
        return;
    known = model.document().project().profile;
    changed.emit();
}

void Actuators::addProfile(NamedProfile added, bool use)
{
    const auto same = std::find_if(list.begin(), list.end(),
                                   [&](const NamedProfile& entry) { return entry.own && entry.name == added.name; });
    const std::string name = added.name;
    if (same != list.end())
        *same = std::move(added);
    else
        list.push_back(std::move(added));
    listChanged.emit();
    if (use)
        choose(name); // perhaps another content under its name
}

void Actuators::setProfile(const std::string& name)
{
    if (name != profileName())
        choose(name);
}

void Actuators::choose(const std::string& name)
{
    if (model.document().isUntouched() && usualName != name)
    {
        usualName = name;
        usualChanged.emit();
    }
    ProjectProfile wanted;
    wanted.name = name;
    wanted.strength = strength();
    for (const NamedProfile& entry : list)
        if (entry.name == name && entry.own)
            wanted.embedded = *entry.profile;
    model.change([&](Document& document) { return pacini::setProfile(document, wanted); });
}

void Actuators::setStrength(double wanted)
{
    ProjectProfile chosen = model.document().project().profile;
    wanted = clampTo(wanted, 0.0, 1.0);
    if (std::exchange(chosen.strength, wanted) == wanted)
        return;
    model.change([&](Document& document) { return pacini::setProfile(document, chosen); });
}

bool Actuators::strengthMatters() const
{
    const auto chosen = profile();
    return chosen && tradesStrength(*chosen);
}

std::shared_ptr<const Profile> Actuators::profile() const
{
    const ProjectProfile& chosen = model.document().project().profile;
    if (chosen.embedded)
        return std::make_shared<const Profile>(*chosen.embedded);
    for (const NamedProfile& entry : list)
        if (entry.name == chosen.name)
            return entry.profile;
    return nullptr;
}

} // namespace pacini::editor
