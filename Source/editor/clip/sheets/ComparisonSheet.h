// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Dialog that shows how a clip differs from its sound, by band and time.

#include "document/SoundComparison.h"
#include "editor/clip/session/Jobs.h"
#include "editor/clip/session/Session.h"
#include "editor/clip/sheets/Sheet.h"

#include <atomic>
#include <memory>
#include <optional>

namespace pacini::editor
{

class ComparisonSheet final : public Sheet
{
public:
    explicit ComparisonSheet(Session& session);
    ~ComparisonSheet() override;

    [[nodiscard]] const std::optional<SoundComparison>& comparison() const noexcept { return found; }

    void paint(juce::Graphics& g) override;
    void mouseMove(const juce::MouseEvent& event) override;

private:
    void showResult(Result<SoundComparison> result);
    [[nodiscard]] juce::Rectangle<int> rowArea(int row) const;
    [[nodiscard]] juce::Rectangle<int> pictureArea(int row) const;
    void paintAxes(juce::Graphics& g) const;

    std::optional<SoundComparison> found;
    juce::String summary;
    juce::Image sound, drive, difference;
    juce::Label place;
    std::shared_ptr<std::atomic<bool>> cancelled = std::make_shared<std::atomic<bool>>(false);
    Jobs jobs;
};

} // namespace pacini::editor
