// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Dialog that lets a phone in: the picture that it scans, and who is there.

#include "app/editor/PhoneOutput.h"
#include "editor/clip/sheets/Sheet.h"
#include "phone/QrText.h"

#include <string>

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

    PhoneOutput& output;
    phone::QrModules modules;
    std::string shown;
    juce::Rectangle<int> picture;
    juce::TextEditor help, address;
    juce::Label status;
    juce::TextButton endButton;
};

} // namespace pacini::app
