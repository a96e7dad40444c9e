// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/session/FilePreview.h"

#include <utility>

namespace pacini::editor
{

FilePreview::FilePreview(EditorModel& project, const Actuators& profiles, const HapticOutputs& hapticOutputs,
                         ClipPlayer& played)
    : model(project), actuators(profiles), outputs(hapticOutputs), player(played)
{
    // What is opened plays from the transport from then on.
    subscriptions.on({&model.opened, &model.shownChanged}, [this] { stop(); });
}

void FilePreview::play(const std::filesystem::path& sound)
{
    if (!model.isEmpty() || model.isShowingUnanalysed() || !outputs.readyToPlay())
        return;
    stop();
    wanted = sound;
    changed.emit();
    jobs.run([sound] { return importFile(sound, {}); },
             [this, sound](Result<Imported> read)
             {
                 if (wanted != sound || !read || !model.isEmpty() || model.isShowingUnanalysed())
                     return;
                 Playback both;
                 both.source = true;
                 both.a = std::make_shared<const Clip>(std::move(read->clip));
                 player.setRow(outputs.row(actuators));
                 player.set(std::move(both));
                 player.setSound(audioOf(read->sound));
                 player.play(0.0);
             });
}

void FilePreview::stop()
{
    if (wanted.empty())
        return;
    wanted.clear();
    player.stop();
    changed.emit();
}

} // namespace pacini::editor
