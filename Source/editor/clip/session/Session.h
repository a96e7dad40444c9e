// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What all parts of an editor's window share: the open project, what of it is shown and selected, what is heard.

#include "document/Autosave.h"
#include "document/ClipPlayer.h"
#include "document/Document.h"
#include "document/Paste.h"
#include "document/ProfileShelf.h"
#include "document/RecentFiles.h"
#include "document/SelectionEdits.h"
#include "document/view/Snap.h"
#include "document/view/TimeAxis.h"
#include "editor/clip/session/Importer.h"
#include "editor/clip/session/Jobs.h"
#include "editor/clip/session/Sound.h"
#include "editor/clip/session/ViewOptions.h"

#include <juce_core/juce_core.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace pacini::editor
{

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
    /// Some sounds of the project are not where they were.
    std::function<void(const std::vector<AudioReference>& missing)> onSoundsMissing;

    // The project.

    [[nodiscard]] const Document& document() const noexcept { return *open; }
    [[nodiscard]] bool isEmpty() const noexcept { return open->project().clips.empty(); }

    /// Reads sounds, clips, projects and folders of sounds and clips in the background, see Importer. A project
    /// replaces the open one.
    void openFiles(const std::vector<std::filesystem::path>& files);
    /// Adds what was read and shows it.
    void add(Imported imported);
    /// The same without showing it.
    Result<int> insert(Imported imported);

    /// What is being read or analysed; nothing when all is done.
    [[nodiscard]] std::optional<WorkState> workNow() const;
    /// What is not done yet is left out.
    void stopWork();

    /// Shows a sound whose analysis is under way, as a clip without curves, until a clip is shown in its place.
    void showUnanalysed(std::shared_ptr<const Sound> read);
    [[nodiscard]] bool isShowingUnanalysed() const noexcept { return unanalysed != nullptr; }
    /// Goes back to the clip that was shown before.
    void endUnanalysed();

    void newProject();
    Result<void> openProject(const std::filesystem::path& file);
    /// One that has no file; a host keeps it.
    void openProject(Project made);
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
    /// Also that of a sound that is being analysed.
    [[nodiscard]] std::shared_ptr<const Sound> soundOfClip() const;
    /// s: of the clip, or of the sound that is being analysed; 0: nothing is shown.
    [[nodiscard]] double duration() const;
    void show(int clipId);

    // Its sound and analysis.

    /// Analyses the sound of the clip with other parameters, in the background; the newest wish counts.
    void reanalyse(const EncoderParams& wanted);
    /// Puts another sound under the edits of the clip, in the background.
    void replaceSound(const std::filesystem::path& file);
    /// Whether a sound is not where it was.
    [[nodiscard]] bool isMissing(int sourceId) const { return missing.contains(sourceId); }
    /// Looks for all missing sounds: `chosen` is one of them, or lies beside them.
    void findSounds(const std::filesystem::path& chosen);
    /// Keeps a copy of a sound inside the project, or no longer.
    void keepSound(int sourceId, bool wanted);

    // What is shown and heard in place of the clip; the document stays as it is, and undo does not know of it.

    /// What an edit would make of the clip, until null. Selection and view are as before then.
    void setPreview(std::shared_ptr<const Clip> wanted);
    [[nodiscard]] bool isPreviewing() const noexcept { return preview != nullptr; }

    /// Keeps the clip as it is now to compare it with what it becomes.
    void keepVersion();
    /// Null when none was kept of the clip that is shown.
    [[nodiscard]] std::shared_ptr<const Clip> keptVersion() const;
    /// The kept version is shown and heard, which cannot be edited, or the clip again; playing goes on.
    void setComparing(bool wanted);
    [[nodiscard]] bool isComparing() const noexcept { return comparing; }
    /// The clip becomes what was kept.
    void takeKeptVersion();

    // Edits. What fails is told by onError and changes nothing.

    [[nodiscard]] Gesture beginGesture() noexcept { return open->beginGesture(); }
    [[nodiscard]] std::shared_ptr<const Clip> gestureStart(Gesture gesture) const;
    bool edit(const char* name, EditOperation operation, Gesture gesture = 0);
    bool setClip(const char* name, Clip edited, Gesture gesture = 0);
    /// An edited clip with where its selection went.
    bool setEdited(const char* name, EditedClip edited, Gesture gesture = 0);
    void undo();
    void redo();
    /// Any other step of the document: what clips are called, their order, groups, notes.
    bool change(const std::function<Result<void>(Document&)>& step);
    void duplicate();
    void removeClip();
    /// Two clips of one, at the playhead.
    void split();
    [[nodiscard]] bool canSplit() const;
    /// The next clip of the project is put behind this one.
    void joinNext();
    [[nodiscard]] int nextClipId() const; ///< 0: none

    void deleteSelection();
    void copy();
    void cut();
    /// At the playhead; a single lane that was copied goes into `into`.
    void paste(const std::optional<Lane>& into = {});
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

    /// Whether a drag in a lane draws a curve.
    [[nodiscard]] bool isDrawing() const noexcept { return drawing; }
    void setDrawing(bool wanted);
    [[nodiscard]] const SnapTargets& snapTargets() const noexcept { return snapNow; }
    void setSnapTargets(const SnapTargets& wanted);
    [[nodiscard]] const ViewOptions& viewOptions() const noexcept { return options; }
    void setViewOptions(const ViewOptions& wanted);

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
    ClipPlayer player;

private:
    friend class Importer;

    /// An analysis for a clip that exists.
    struct Again
    {
        int clip = 0;
        EncoderParams params;
        std::string name; ///< of the step
        std::shared_ptr<Task> task;
    };

    void report(const std::string& title, const Error& error);
    bool take(Result<void> result);
    void changed(unsigned what);
    void take(Document document);
    void step(bool (Document::*through)());
    void follow();
    void sendPlayback();
    [[nodiscard]] bool showsAll() const;
    void keepView(bool showedAll);
    [[nodiscard]] bool mayEdit(Gesture gesture);
    void chooseProfile(const std::string& name);
    void loadSound();
    void checkSounds();
    void analyseAgain(Again wanted, const std::function<Result<Imported>()>& read);
    void putAgain(const Again& done, Result<Imported> analysed, bool otherSound);

    std::unique_ptr<Document> open = std::make_unique<Document>();
    std::unique_ptr<Autosave> autosave;
    bool autosaveFailed = false; ///< and it has been told
    const std::filesystem::path recoveryFolder;
    RecentFiles recent;
    std::vector<NamedProfile> shelf;
    int active = 0;
    std::map<int, std::shared_ptr<const Sound>> sounds; ///< by id of the reference
    std::set<int> missing;                              ///< ids of references
    std::shared_ptr<const Sound> unanalysed;            ///< shown in place of a clip: active is 0
    int beforeUnanalysed = 0;
    std::shared_ptr<Task> again; ///< the newest analysis of a clip that exists
    juce::String againText;
    Selection selectionNow;
    std::optional<Copied> clipboard;
    std::shared_ptr<const Clip> preview;
    Selection beforePreview;
    TimeAxis axisBeforePreview;
    std::map<int, std::shared_ptr<const Clip>> versions; ///< that were kept, by id of the clip
    bool comparing = false;
    bool drawing = false;
    SnapTargets snapNow;
    TimeAxis axisNow;
    double width = 800.0;
    bool decibels = true;
    int laneSize = 48;
    ViewOptions options;
    std::optional<TimeRange> rangeNow;
    bool looping = false;
    Heard hear = Heard::haptic;
    Audition auditionNow;
    double startTime = 0.0;
    std::uint64_t generation = 0; ///< counts the projects that were open
    Jobs jobs;
    Importer importer{*this, jobs};
};

} // namespace pacini::editor
