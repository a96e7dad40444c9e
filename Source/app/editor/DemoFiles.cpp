// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/editor/DemoFiles.h"

#include "DemoData.h"
#include "editor/Text.h"

#include <algorithm>

namespace pacini::app
{

std::vector<std::filesystem::path> putDemoFiles(const juce::File& folder)
{
    std::vector<std::filesystem::path> sounds;
    if (!folder.createDirectory())
        return sounds;
    for (int i = 0; i < demoData::namedResourceListSize; ++i)
    {
        const char* resource = demoData::namedResourceList[i];
        int size = 0;
        const char* data = demoData::getNamedResource(resource, size);
        const juce::File file = folder.getChildFile(demoData::getNamedResourceOriginalFilename(resource));
        const juce::MemoryBlock wanted(data, static_cast<std::size_t>(size));
        juce::MemoryBlock there;
        if (file.getSize() != size || !file.loadFileAsData(there) || there != wanted)
            if (!file.replaceWithData(data, static_cast<std::size_t>(size)))
                return {};
        if (file.hasFileExtension("flac"))
            sounds.push_back(editor::pathOf(file));
    }
    std::sort(sounds.begin(), sounds.end());
    return sounds;
}

} // namespace pacini::app
