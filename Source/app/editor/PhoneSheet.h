// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Dialog to connect phones: QR code, and list of connected phones.

#include "app/editor/PhoneOutput.h"
#include "editor/clip/sheets/Sheet.h"
#include "phone/QrText.h"

#include <array>
#include <cstddef>
#include <string>
#include <utility>

namespace pacini::app
{

class PhoneSheet final : public editor::Sheet, private juce::Timer
{
public:
    explicit PhoneSheet(PhoneOutput& wanted);

private:
    void layOut(juce::Rectangle<int> area) override;
    void timerCallback() override;
    void paintOverChildren(juce::Graphics& g) override;
    void refresh();
    /// Returns a message about phones that were refused since the last call; empty if none was.
    [[nodiscard]] juce::String newRefusal(const phone::PhoneServer& server);

    PhoneOutput& output;
    phone::QrModules modules;
    std::string shown;
    std::array<std::pair<phone::Refusal, std::size_t>, 3> refusals{
        {{phone::Refusal::usedCode, 0}, {phone::Refusal::wrongCode, 0}, {phone::Refusal::full, 0}}};
    juce::String notice; ///< in place of the status
    int noticeGlances = 0;
    juce::Rectangle<int> picture;
    juce::TextEditor help, address;
    juce::Label status;
    juce::TextButton endButton;
};

} // namespace pacini::app
