// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/sheets/AboutSheet.h"

#include "editor/Translation.h"

#include <vector>

namespace pacini::editor
{

std::unique_ptr<Sheet> aboutSheet(const juce::String& version)
{
    const auto text =
        (version.isEmpty() ? juce::String() : tr("Version {0}", {version}) + "\n\n") +
        tr("Sound to touch, after M. Weber, {0}, TU Berlin, 2020.",
           {"A Framework for Audio-Tactile Signal Translation"}) +
        "\n\n" +
        tr("Free software under the GNU General Public License, version 3 or later; the core, the file formats and the "
           "command under the MIT licence.") +
        "\n" + tr("Made with {0}, libsndfile, Eigen, nlohmann-json and fmt.", {juce::SystemStats::getJUCEVersion()});
    return std::make_unique<MessageSheet>("Pacini", text, std::vector<Sheet::Answer>{{"Close", {}}});
}

} // namespace pacini::editor
