// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Transport: what is heard and felt of the clip that is shown, and from where.

#include "document/ClipPlayer.h"
#include "editor/clip/session/Actuators.h"
#include "editor/clip/session/ClipSelection.h"
#include "editor/clip/session/HapticOutputs.h"
#include "editor/clip/session/ProjectSounds.h"

namespace pacini::editor
{

enum class Heard
{
    haptic,
    sound,
    both
};

/// Controls the player by the displayed clip, the selection and the chosen outputs. [message]
class Transport : private juce::Timer
{
public:
    Transport(const EditorModel& project, const ProjectSounds& projectSounds, const Actuators& profiles,
              const HapticOutputs& hapticOutputs, const ClipSelection& selected, ClipPlayer& player);

    Signal changed;     ///< what is heard, playing or not, the playhead when it jumps
    Signal loopChanged; ///< whether the time range is looped
    Signal controlsChanged;

    [[nodiscard]] bool isLooping() const noexcept { return looping; }
    void setLooping(bool wanted);
    [[nodiscard]] Heard heard() const noexcept { return hear; }
    void setHeard(Heard wanted);
    /// Leaves the player to something else, which calls it by itself until it is taken again, with the clip.
    void lendPlayer();
    void takePlayer();
    [[nodiscard]] const Audition& audition() const noexcept { return auditionNow; }
    void setAudition(Audition wanted);

    /// What is changed while it plays, of all that plays; the project knows nothing of it.
    [[nodiscard]] const PlayControls& controls() const noexcept { return live; }
    void setControls(const PlayControls& wanted);

    void play();
    void stop();
    [[nodiscard]] bool isPlaying() const noexcept { return player.isPlaying() && !scrubbing; }
    /// s: of what plays, or where playing will begin.
    [[nodiscard]] double playhead() const;
    void setPlayhead(double time);
    /// The same; while nothing plays, a moment of what is there is heard and felt.
    void scrub(double time);
    /// Whether it is inside of the clip.
    [[nodiscard]] bool canSplit() const;

private:
    void timerCallback() override { endScrub(); }
    void endScrub();
    void reset();
    void send();

    const EditorModel& model;
    const ProjectSounds& sounds;
    const Actuators& actuators;
    const HapticOutputs& outputs;
    const ClipSelection& selection;
    ClipPlayer& player;
    bool looping = false;
    bool lent = false;
    bool scrubbing = false;
    Heard hear = Heard::haptic;
    Audition auditionNow;
    PlayControls live;
    double startTime = 0.0;
    Subscriptions subscriptions;
};

} // namespace pacini::editor
