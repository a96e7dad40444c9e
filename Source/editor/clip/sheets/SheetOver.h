// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Dialog over a component that stays as it is behind it.

#include "editor/clip/sheets/Sheet.h"

#include <functional>
#include <memory>

namespace pacini::editor
{

/// Shows one sheet at a time over a component, which outlives it and all of whose area it takes. [message]
class SheetOver final : private juce::ComponentListener
{
public:
    explicit SheetOver(juce::Component& covered);
    ~SheetOver() override;
    SheetOver(const SheetOver&) = delete;
    SheetOver& operator=(const SheetOver&) = delete;

    std::function<void()> onClosed; ///< where the keyboard goes back to

    void show(std::unique_ptr<Sheet> wanted);
    [[nodiscard]] Sheet* sheet() const noexcept { return now.get(); }

private:
    void componentMovedOrResized(juce::Component&, bool, bool) override;

    juce::Component& behind;
    std::unique_ptr<Sheet> now;
    std::shared_ptr<int> alive = std::make_shared<int>(0);
};

} // namespace pacini::editor
