// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// List of actuators that can be chosen, and the choice of the project.

#include "editor/clip/session/EditorModel.h"
#include "io/ShippedProfiles.h"

#include <memory>
#include <string>
#include <vector>

namespace pacini::editor
{

/// [message]
class Actuators
{
public:
    Actuators(EditorModel& project, std::vector<NamedProfile> profiles);

    Signal changed; ///< which one the project has, what it is, or its strength
    Signal listChanged;
    Signal usualChanged;

    [[nodiscard]] const Document& document() const noexcept { return model.document(); }
    [[nodiscard]] const std::vector<NamedProfile>& profiles() const noexcept { return list; }
    /// In the place of one of its name that is not Pacini's, or behind the others; `use` chooses it at once.
    void addProfile(NamedProfile added, bool use);
    /// Of the project; empty: the plain drive signal.
    [[nodiscard]] const std::string& profileName() const noexcept { return model.document().project().profile.name; }
    void setProfile(const std::string& name);
    /// That of projects which are begun: an empty one has it, so that what is heard before anything is opened is within
    /// its limits, too. Choosing one while the project is empty chooses this. Empty: none.
    [[nodiscard]] const std::string& usual() const noexcept { return usualName; }
    void setUsual(const std::string& name);
    [[nodiscard]] std::shared_ptr<const Profile> profile() const;

    /// Of the project, 0 to 1, see fitActuator(); clamped when it is set.
    [[nodiscard]] double strength() const noexcept { return model.document().project().profile.strength; }
    void setStrength(double wanted);
    /// Whether the chosen actuator is played differently with another strength.
    [[nodiscard]] bool strengthMatters() const;

private:
    void choose(const std::string& name);
    void follow();

    EditorModel& model;
    std::vector<NamedProfile> list;
    std::string usualName;
    ProjectProfile known; ///< to see when the project has another
    Subscriptions subscriptions;
};

} // namespace pacini::editor
