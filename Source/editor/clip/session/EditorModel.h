// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Model of the editor: the open project and the clip of it that is edited.

#include "document/Autosave.h"
#include "document/Document.h"
#include "document/RecentFiles.h"
#include "editor/clip/session/Signal.h"
#include "editor/clip/session/Sound.h"

#include <juce_core/juce_core.h>

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace pacini::editor
{

/// Document, files, recovery, undo, and the displayed clip. All changes of the document go through this class, so that
/// autosave and views follow. [message]
class EditorModel
{
public:
    struct Folders
    {
        std::filesystem::path recovery; ///< empty: no autosave
        std::filesystem::path recentList;
    };

    explicit EditorModel(const Folders& folders);

    /// Supplies the place where the user works, for saving; null: only the shown clip is known.
    std::function<WorkPlace()> findPlace;
    /// Goes there, in the clip that is shown by now; null: nobody can.
    std::function<void(const WorkPlace&)> goToPlace;
    /// Keeps for the next time where the user works; also done when another project is opened.
    void keepPlace();
    ~EditorModel();

    /// Another project is open; the signals below follow.
    Signal opened;
    /// Another clip is shown: what belonged to the one before is over. contentChanged follows.
    Signal shownChanged;
    /// The clip that is shown, or which one that is. Where the document has changed, projectChanged follows.
    Signal contentChanged;
    /// Which clips there are, names, file, dirty state, undo, or anything else of the document.
    Signal projectChanged;
    /// What is kept to compare with, or whether it is shown.
    Signal versionChanged;
    Signal sceneOpened; ///< a scene has come from a file

    std::function<void(const juce::String& title, const juce::String& text)> onError;
    void report(const std::string& title, const Error& error) const;
    /// Reports side effects of a command, which need no answer.
    std::function<void(const juce::String& text)> onNotice;
    /// What was written where the user wanted it.
    std::function<void(const std::vector<std::filesystem::path>& files)> onWritten;

    // The project.

    [[nodiscard]] const Document& document() const noexcept { return *open; }
    [[nodiscard]] bool isEmpty() const noexcept { return open->project().clips.empty(); }

    void newProject();
    Result<void> openProject(const std::filesystem::path& file);
    /// One that has no file; a host keeps it.
    void openProject(Project made);
    /// One to look at and try things with: own work does not join its clips, see isSample().
    void openSample(Project made);
    /// Whether the open project is a sample that the user has not made an own one by saving it.
    [[nodiscard]] bool isSample() const noexcept { return sample; }
    Result<void> recover(const Recoverable& entry);
    Result<void> save();
    Result<void> saveAs(const std::filesystem::path& file);
    /// The user does not want what is not saved.
    void discardAutosave();
    [[nodiscard]] RecentFiles& recentFiles() noexcept { return recent; }
    [[nodiscard]] std::vector<Recoverable> recoverable() const;

    // What is shown.

    [[nodiscard]] int activeId() const noexcept { return active; }
    [[nodiscard]] std::shared_ptr<const ClipItem> item() const { return open->clip(active); }
    /// Null when there is none.
    [[nodiscard]] std::shared_ptr<const Clip> clip() const;
    /// s: of the clip, or of the sound that is being analysed; 0: nothing is shown.
    [[nodiscard]] double duration() const;
    void show(int clipId);
    /// Those that are selected in the list of clips; what is done to several at once is done to these.
    /// The shown one alone, where it is none of them.
    [[nodiscard]] std::vector<int> selectedClips() const;
    void selectClips(std::vector<int> ids) { selectedNow = std::move(ids); }

    /// Shows a sound whose analysis is under way, as a clip without curves, until a clip is shown in its place.
    void showUnanalysed(std::shared_ptr<const Sound> read);
    /// Null when a clip is shown, or nothing.
    [[nodiscard]] const std::shared_ptr<const Sound>& unanalysedSound() const noexcept { return unanalysed; }
    [[nodiscard]] bool isShowingUnanalysed() const noexcept { return unanalysed != nullptr; }
    /// Goes back to the clip that was shown before.
    void endUnanalysed();

    // What is shown and heard in place of the clip; the document stays as it is, and undo does not know of it.

    /// What an edit would make of the clip, until null. Selection and view are as before then.
    void setPreview(std::shared_ptr<const Clip> wanted);
    [[nodiscard]] bool isPreviewing() const noexcept { return preview != nullptr; }

    /// Keeps the clip as it is now to compare it with what it becomes.
    void keepVersion();
    /// Null when none was kept of the clip that is shown.
    [[nodiscard]] std::shared_ptr<const ClipItem> keptVersion() const;
    /// The clip whose curves and settings are shown: the kept version while that is compared with. Null: none is.
    [[nodiscard]] std::shared_ptr<const ClipItem> shownItem() const;
    /// The kept version is shown and heard, which cannot be edited, or the clip again; playing goes on.
    void setComparing(bool wanted);
    [[nodiscard]] bool isComparing() const noexcept { return comparing; }

    // Changes; those of a clip are in ClipSteps.h. What fails is told by onError and changes nothing.

    [[nodiscard]] Gesture beginGesture() noexcept { return open->beginGesture(); }
    /// Whether the clip may be edited; not while the kept version is looked at, which is told.
    [[nodiscard]] bool mayEdit(Gesture gesture = 0) const;
    /// See Document::commit().
    bool commit(std::string name, Result<Project> next, Gesture gesture = 0);
    /// What is no step; see Amendments.h.
    bool change(const std::function<Result<void>(Document&)>& amendment);
    /// What adds a clip, which is not shown for it: its id.
    Result<int> insert(const std::function<Result<int>(Document&)>& amendment);
    /// See pacini::openScene(); says sceneOpened.
    Result<void> openScene(const Scene& scene, const std::string& group);
    void undo();
    void redo();
    /// To any state of document().steps().
    void goTo(std::size_t state);

private:
    void take(Document document, const WorkPlace& place = {});
    [[nodiscard]] WorkPlace placeNow() const;
    bool follow(int before);
    void autosaveNow();
    void documentChanged();
    Result<void> saved(Result<void> result);

    std::unique_ptr<Document> open = std::make_unique<Document>();
    bool sample = false;
    std::unique_ptr<Autosave> autosave;
    bool autosaveFailed = false; ///< and it has been told
    const std::filesystem::path recoveryFolder;
    RecentFiles recent;
    int active = 0;
    std::vector<int> selectedNow;
    std::shared_ptr<const Sound> unanalysed; ///< shown in place of a clip: active is 0
    int beforeUnanalysed = 0;
    std::shared_ptr<const Clip> preview;
    std::map<int, std::shared_ptr<const ClipItem>> versions; ///< that were kept, by id of the clip
    bool comparing = false;
};

} // namespace pacini::editor
