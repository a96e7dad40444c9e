// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What all parts of an editor's window share: the open project, what of it is shown and selected, what is heard.

#include "document/Autosave.h"
#include "document/Document.h"
#include "document/RecentFiles.h"
#include "document/SelectionEdits.h"
#include "document/view/TimeAxis.h"
#include "editor/clip/session/Jobs.h"
#include "editor/clip/session/Player.h"
#include "editor/clip/session/Sound.h"

#include <juce_core/juce_core.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace pacini::editor
{

/// An actuator that can be chosen.
struct NamedProfile
{
    std::string name; ///< such as l5-wristband
    std::shared_ptr<const Profile> profile;
    bool own = false; ///< not one of those that come with Pacini: projects carry it with them
};

enum class Heard
{
    haptic,
    sound,
    both
};

/// One open project on the message thread. Parts of the window listen to what changes; everything that changes the
/// document goes through here, so that autosave, playback and views follow. [message]
class Session
{
public:
    /// What has changed; several at once.
    enum Change : unsigned
    {
        project = 1,   ///< which clips there are, names, file, dirty state, undo
        content = 2,   ///< the clip that is shown, or which one that is
        selection = 4, ///< of points and transients
        view = 8,      ///< the time axis
        range = 16,    ///< the time range and whether it is looped
        sound = 32,    ///< the sound of the clip has been read
        playback = 64, ///< what is heard, the actuator, playing or not, the playhead when it jumps
        work = 128,    ///< reading and analysing has begun or ended
        look = 256,    ///< how lanes are shown
        profileList = 512
    };

    class Listener
    {
    public:
        virtual ~Listener() = default;
        virtual void sessionChanged(unsigned changes) = 0;
    };

    /// Calls all, also when some are removed meanwhile.
    class Listeners
    {
    public:
        void add(Listener* one) { list.push_back(one); }
        void remove(Listener* one) { std::erase(list, one); }
        void call(unsigned changes) const
        {
            const auto now = list;
            for (Listener* one : now)
                if (std::find(list.begin(), list.end(), one) != list.end())
                    one->sessionChanged(changes);
        }

    private:
        std::vector<Listener*> list;
    };

    struct Folders
    {
        std::filesystem::path recovery; ///< empty: no autosave
        std::filesystem::path recentList;
    };

    Session(const Folders& folders, std::vector<NamedProfile> profiles);
    ~Session();

    Listeners listeners;
    std::function<void(const juce::String& title, const juce::String& text)> onError;

    // The project.

    [[nodiscard]] const Document& document() const noexcept { return *open; }
    [[nodiscard]] bool isEmpty() const noexcept { return open->project().clips.empty(); }

    /// Reads sounds, clips and projects; what takes long is done in the background. A project replaces the open one.
    void openFiles(const std::vector<std::filesystem::path>& files);
    void add(Imported imported);
    [[nodiscard]] juce::String workText() const { return busy; } ///< what is being read; empty: nothing

    void newProject();
    Result<void> openProject(const std::filesystem::path& file);
    Result<void> recover(const Recoverable& entry);
    Result<void> save();
    Result<void> saveAs(const std::filesystem::path& file);
    /// The user does not want what is not saved.
    void discardAutosave();
    [[nodiscard]] RecentFiles& recentFiles() noexcept { return recent; }
    [[nodiscard]] std::vector<Recoverable> recoverable() const;

    // The clip that is shown.

    [[nodiscard]] int activeId() const noexcept { return active; }
    [[nodiscard]] std::shared_ptr<const ClipItem> item() const { return open->clip(active); }
    /// Null when there is none.
    [[nodiscard]] std::shared_ptr<const Clip> clip() const;
    [[nodiscard]] std::shared_ptr<const Sound> soundOfClip() const;
    void show(int clipId);

    // Edits. What fails is told by onError and changes nothing.

    [[nodiscard]] Gesture beginGesture() noexcept { return open->beginGesture(); }
    [[nodiscard]] std::shared_ptr<const Clip> gestureStart(Gesture gesture) const;
    bool edit(const char* name, EditOperation operation, Gesture gesture = 0);
    bool setClip(const char* name, Clip edited, Gesture gesture = 0);
    /// An edited clip with where its selection went.
    bool setEdited(const char* name, EditedClip edited, Gesture gesture = 0);
    void undo();
    void redo();
    void duplicate();
    void removeClip();

    void deleteSelection();
    void copy();
    void cut();
    /// At the playhead.
    void paste();
    [[nodiscard]] bool canPaste() const noexcept { return clipboard.has_value(); }
    /// The scope of edits of a stretch, see scopeOf().
    [[nodiscard]] EditScope scope() const;

    // Selection and view.

    [[nodiscard]] const Selection& selected() const noexcept { return selectionNow; }
    void select(Selection wanted);
    [[nodiscard]] const TimeAxis& axis() const noexcept { return axisNow; }
    [[nodiscard]] double viewWidth() const noexcept { return width; } ///< pixels
    void setViewWidth(double pixels);
    void setAxis(TimeAxis wanted);
    void zoom(double factor, double x);
    void fit();
    void showRange(TimeRange wanted);

    [[nodiscard]] bool amplitudesInDecibels() const noexcept { return decibels; }
    void setAmplitudesInDecibels(bool wanted);
    [[nodiscard]] int laneHeight() const noexcept { return laneSize; } ///< pixels of a band
    void setLaneHeight(int wanted);

    // Playback.

    [[nodiscard]] const std::optional<TimeRange>& timeRange() const noexcept { return rangeNow; }
    void setTimeRange(std::optional<TimeRange> wanted);
    [[nodiscard]] bool isLooping() const noexcept { return looping; }
    void setLooping(bool wanted);
    [[nodiscard]] Heard heard() const noexcept { return hear; }
    void setHeard(Heard wanted);
    [[nodiscard]] const Audition& audition() const noexcept { return auditionNow; }
    void setAudition(Audition wanted);
    [[nodiscard]] const std::vector<NamedProfile>& profiles() const noexcept { return shelf; }
    /// In the place of one of its name that is not Pacini's, or behind the others; `use` chooses it at once.
    void addProfile(NamedProfile added, bool use);
    /// Of the project; empty: the plain drive signal.
    [[nodiscard]] const std::string& profileName() const noexcept { return open->project().profile.name; }
    void setProfile(const std::string& name);
    [[nodiscard]] std::shared_ptr<const Profile> profile() const;

    void play();
    void stop();
    [[nodiscard]] bool isPlaying() const noexcept { return player.isPlaying(); }
    /// s: of what plays, or where playing will begin.
    [[nodiscard]] double playhead() const;
    void setPlayhead(double time);

    /// Runs in the callback of a device.
    Player player;

private:
    void report(const std::string& title, const Error& error);
    bool take(Result<void> result);
    void changed(unsigned what);
    void take(Document document);
    void step(bool (Document::*through)());
    void follow();
    void sendPlayback();
    void chooseProfile(const std::string& name);
    void loadSound();
    void readNext();

    std::unique_ptr<Document> open = std::make_unique<Document>();
    std::unique_ptr<Autosave> autosave;
    const std::filesystem::path recoveryFolder;
    RecentFiles recent;
    std::vector<NamedProfile> shelf;
    int active = 0;
    std::map<int, std::shared_ptr<const Sound>> sounds; ///< by id of the reference
    Selection selectionNow;
    std::optional<Fragment> clipboard;
    TimeAxis axisNow;
    double width = 800.0;
    bool decibels = true;
    int laneSize = 48;
    std::optional<TimeRange> rangeNow;
    bool looping = false;
    Heard hear = Heard::haptic;
    Audition auditionNow;
    double startTime = 0.0;
    std::vector<std::filesystem::path> waiting;
    juce::String busy;
    Jobs jobs;
};

} // namespace pacini::editor
